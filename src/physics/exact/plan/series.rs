//! Any cluster, by the Taylor series of its gaps: contact changes are located on it.

use super::super::centre_of_mass::Centre;
use super::super::cluster::Cluster;
use super::super::polynomial::{Polynomial, ROWS, first_below_zero};
use super::super::taylor::{Coupling, NEGLIGIBLE, PHASE, TaylorSeries, expand, lanes};
use super::super::workspace::Workspace;
use super::{ClusterPlan, ContactMode};
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::spring::Spring;

/// A cluster that moves by its series in s = τ/h.
#[derive(Clone, Debug)]
pub(in super::super) struct SeriesPlan {
    series: TaylorSeries,
    /// Where the plan ends, in units of h.
    reach: f64,
    /// Which gap changes there, counted from the floor, and to what.
    change: Option<(usize, ContactMode)>,
}

impl SeriesPlan {
    /// Expands a cluster, up to its first contact change or as far as the series is good.
    pub fn of<G: Ground>(cluster: &Cluster<G>, work: &mut Workspace) -> Self {
        let lanes = lanes(cluster.gaps.len());
        let h = PHASE / fastest(cluster);
        couple(cluster, h, &mut work.coupling);
        let mut rows = work.take_rows(ROWS * lanes);
        rows[..2 * lanes].fill(0.0);
        for (j, gap) in cluster.gaps.iter().enumerate() {
            rows[j] = gap.g;
            rows[lanes + j] = gap.w * h;
        }
        let pull = cluster.ground.bends(cluster.low).then(|| {
            let mut pull = [0.0; ROWS];
            cluster.ground.pull(cluster.began(), h, &mut pull);
            pull.map(|c| c * h * h)
        });
        let forces = &mut work.a[..lanes + 2];
        expand(&mut rows, &work.coupling, pull.as_ref(), forces);
        let series = TaylorSeries::new(rows, lanes, h);
        let (reach, change) = first_change(cluster, &series, work);
        Self {
            series,
            reach,
            change,
        }
    }

    /// Its coefficients' buffer, for another series.
    pub fn into_rows(self) -> Vec<f64> {
        self.series.into_rows()
    }

    /// How far the cluster has come at `t`, in units of h. The end of the plan is rounded as
    /// a time, but here it is `reach` to the last bit.
    fn progress<G: Ground>(&self, cluster: &Cluster<G>, t: f64) -> f64 {
        if t >= cluster.ends {
            self.reach
        } else {
            ((t - cluster.began()) / self.series.h).min(self.reach)
        }
    }

    /// Work of the plate, ∫ F ż₀ dt from 0 to `s`. F is the force on the floor, as a series
    /// in s'/s.
    fn plate_work<G: Ground>(&self, cluster: &Cluster<G>, force: &Polynomial, s: f64) -> f64 {
        let h = self.series.h;
        let mut motion = [0.0; ROWS];
        cluster.ground.motion(cluster.began(), h, &mut motion);
        // Term j of the plate's velocity is at most x^j/j! of it, x = ωh. A contact is short
        // against the plate's period, x is small, and few terms matter.
        let x = cluster.ground.plate(0.0).omega * h;
        let (mut bound, mut power, mut work) = (1.0, s * h, 0.0);
        for (j, v) in motion.iter().enumerate() {
            if bound < NEGLIGIBLE {
                break;
            }
            bound *= x / (j + 1) as f64;
            // ∫ (s'/s)^k s'^j ds' = s^{j+1}/(k+j+1).
            let terms = force.iter().zip(&ONE_OVER[j..]);
            work += v * power * terms.map(|(f, over)| f * over).sum::<f64>();
            power *= s;
        }
        work
    }
}

/// Fills in what couples the cluster's gaps, in units of `h`.
fn couple<G: Ground>(cluster: &Cluster<G>, h: f64, coupling: &mut Coupling) {
    coupling.clear(lanes(cluster.gaps.len()));
    for (j, mode) in cluster.modes.iter().enumerate() {
        let i = cluster.low + j;
        if *mode == ContactMode::Pushing {
            let spring = cluster.constants.column.springs[i];
            coupling.stiffness[j] = spring.stiffness * h * h;
            coupling.dashpot[j] = spring.dashpot * h;
        }
        (coupling.below[j], coupling.above[j]) = cluster.constants.inverse_masses(i);
    }
}

/// A bound on the rates at which a cluster moves, 1/s.
///
/// Gershgorin's circles bound the eigenvalues of the springs, k, and of the dashpots, 2μ. A
/// mode's rate is at most μ + √(μ² − k) where it is overdamped, √k where it is not.
fn fastest<G: Ground>(cluster: &Cluster<G>) -> f64 {
    let (mut stiffness, mut dashpot) = (0.0_f64, 0.0_f64);
    let last = cluster.gaps.len() - 1;
    for j in 0..=last {
        let (below, above) = cluster.constants.inverse_masses(cluster.low + j);
        let mut row = (0.0, 0.0);
        let mut add = |j: usize, factor: f64| {
            if cluster.modes[j] == ContactMode::Pushing {
                let spring = &cluster.constants.column.springs[cluster.low + j];
                row.0 += factor * spring.stiffness;
                row.1 += factor * spring.dashpot;
            }
        };
        add(j, below + above);
        if j > 0 {
            add(j - 1, below);
        }
        if j < last {
            add(j + 1, above);
        }
        stiffness = stiffness.max(row.0);
        dashpot = dashpot.max(row.1);
    }
    let damping = 0.5 * dashpot;
    let excess = damping * damping - stiffness;
    let own = if excess > 0.0 {
        damping + excess.sqrt()
    } else {
        stiffness.sqrt()
    };
    let driven = if cluster.low == 0 {
        cluster.ground.plate(0.0).omega
    } else {
        0.0
    };
    own.max(driven).max(cluster.constants.slowest)
}

/// How far a cluster's series may be used, and which gap changes there.
fn first_change<G: Ground>(
    cluster: &Cluster<G>,
    series: &TaylorSeries,
    work: &mut Workspace,
) -> (f64, Option<(usize, ContactMode)>) {
    let mut reach = series.reach(&work.coupling.stiffness);
    let sign = |mode: &ContactMode| {
        if *mode == ContactMode::Open {
            1.0
        } else {
            -1.0
        }
    };
    work.signs.clear();
    work.signs.extend(cluster.modes.iter().map(sign));
    work.signs.resize(lanes(cluster.gaps.len()), 0.0);
    series.least_sums(&work.signs, reach, &mut work.a, &mut work.b);
    let mut first = None;
    for (j, mode) in cluster.modes.iter().enumerate() {
        let i = cluster.low + j;
        let unsure = work.b[j] < 0.0;
        let gap = |sign| series.gap(j, sign, reach);
        let force = |sign| series.force(j, cluster.constants.column.springs[i], sign, reach);
        // What changes the gap, as functions that fall below zero there.
        let bounds = match mode {
            ContactMode::Open if unsure => [Some((gap(1.0), ContactMode::Pushing)), None],
            ContactMode::Pushing if !cluster.constants.attraction => {
                [Some((force(1.0), ContactMode::Idle)), None]
            }
            ContactMode::Pushing if unsure => [Some((gap(-1.0), ContactMode::Open)), None],
            ContactMode::Idle => [
                Some((gap(-1.0), ContactMode::Open)),
                Some((force(-1.0), ContactMode::Pushing)),
            ],
            ContactMode::Open | ContactMode::Pushing => continue,
        };
        let changes = bounds.iter().flatten();
        let found = changes.filter_map(|(q, to)| first_below_zero(q).map(|s| (s, *to)));
        if let Some((s, to)) = found.min_by(|a, b| a.0.total_cmp(&b.0)) {
            reach *= s;
            first = Some((i, to));
        }
    }
    (reach, first)
}

impl<G: Ground> ClusterPlan<G> for SeriesPlan {
    fn ends(&self, cluster: &Cluster<G>) -> f64 {
        cluster.began() + self.series.h * self.reach
    }

    fn change(&self, _: &Cluster<G>) -> Option<(usize, ContactMode)> {
        self.change
    }

    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let s = self.progress(cluster, t);
        self.series.evaluate(s, gaps, rates);
    }

    fn account(&self, cluster: &Cluster<G>, t: f64, ledger: &mut Ledger, work: &mut Workspace) {
        let s = self.progress(cluster, t);
        work.a[..lanes(cluster.gaps.len())].fill(0.0);
        for (j, mode) in cluster.modes.iter().enumerate() {
            let Spring {
                stiffness, dashpot, ..
            } = cluster.constants.column.springs[cluster.low + j];
            match mode {
                ContactMode::Open => {}
                ContactMode::Pushing => work.a[j] = dashpot,
                ContactMode::Idle => {
                    // The spring relaxes, and does no work.
                    let before = cluster.gaps[j].g;
                    let g = self.series.gap(j, 1.0, s).iter().sum::<f64>();
                    let squares = (before - g) * (before + g);
                    ledger.lost.add(0.5 * stiffness * squares);
                }
            }
        }
        let Workspace { a, b, series, .. } = work;
        ledger.lost.add(self.series.dissipation(s, a, b, series));
        if G::MOVES && cluster.low == 0 && cluster.modes[0] == ContactMode::Pushing {
            let force = self
                .series
                .force(0, cluster.constants.column.springs[0], 1.0, s);
            ledger.plate_work.add(self.plate_work(cluster, &force, s));
        }
    }

    fn pushed(
        &self,
        cluster: &Cluster<G>,
        mut centre: Centre,
        t: f64,
        _: &[f64],
        _: &[f64],
    ) -> Centre {
        let s = self.progress(cluster, t);
        let push = self
            .series
            .force(0, cluster.constants.column.springs[0], 1.0, s);
        let tau = s * self.series.h;
        centre.fall(tau, cluster.constants.column.gravity);
        centre.add_push(tau, &push);
        centre.t = t;
        centre
    }
}

/// 1/(k + 1).
const ONE_OVER: [f64; 2 * ROWS] = {
    let mut table = [0.0; 2 * ROWS];
    let mut k = 0;
    while k < 2 * ROWS {
        table[k] = 1.0 / (k + 1) as f64;
        k += 1;
    }
    table
};
