//! How a cluster is brought to any time before its plan ends, and what it costs.

use super::cluster::Plan;
use super::crossing::{Polynomial, ROWS};
use super::series::{NEGLIGIBLE, Series, lanes};
use super::{Exact, Gap, Mode, PADDING, Room};
use crate::physics::flight::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::power_law::Spring;

/// Lengths and speeds below that matter to nothing, and would decay into subnormal
/// numbers, which are slow.
const NOTHING: f64 = 1e-200;

/// A gap and its rate, brought to `t`: zero where they are nothing.
pub(super) fn brought((g, w): (f64, f64), t: f64) -> Gap {
    let flush = |x: f64| if x.abs() < NOTHING { 0.0 } else { x };
    let (g, w) = (flush(g), flush(w));
    Gap { g, w, t }
}

impl<G: Ground> Exact<G> {
    /// Ends the plan of the cluster that starts at `low`, at its end `t`; what changes.
    pub(super) fn finish(&mut self, low: usize, t: f64) -> Option<(usize, Mode)> {
        // A contact that goes by itself is deepest within its plan.
        let alone = match self.plans[low] {
            Plan::Encounter(i) => Some(i),
            Plan::Landing => Some(0),
            _ => None,
        };
        if let Some((i, contact)) = alone.and_then(|i| Some((i, self.encounters[i].as_ref()?))) {
            let deepest = self.gaps[i].w * contact.depth;
            self.state.books.measure(std::iter::once(deepest));
        }
        let change = match self.plans[low] {
            Plan::Flight => Some((low, Mode::Pushing)),
            Plan::Series { change, .. } => change,
            Plan::Encounter(i) => Some((i, Mode::Open)),
            Plan::Landing => Some((0, Mode::Open)),
            Plan::Rest => None,
        };
        self.bring(low, t);
        change
    }

    /// Brings the cluster that starts at `low` to time `t`, before its plan ends or then.
    pub(super) fn bring(&mut self, low: usize, t: f64) {
        let mut room = std::mem::take(&mut self.room);
        let mut ledger = std::mem::take(&mut self.state.books.ledger);
        self.account(low, t, &mut ledger, &mut room);
        self.state.books.ledger = ledger;
        let high = self.end[low];
        self.at(low, t, &mut room.a, &mut room.b);
        if G::PULLS && low == 0 && self.modes[0] == Mode::Pushing {
            self.centre = self.centre_at(t, &room.a, &room.b);
        }
        let moved = room.a.iter().zip(&room.b);
        for (gap, (&g, &w)) in self.gaps[low..high].iter_mut().zip(moved) {
            *gap = brought((g, w), t);
        }
        self.room = room;
        if !matches!(self.plans[low], Plan::Flight) {
            let Self { state, gaps, .. } = self;
            state.books.measure(gaps[low..high].iter().map(|gap| gap.g));
        }
    }

    /// How far into its series the cluster that starts at `low` is at `t`, in units of
    /// `h`: to the last bit at its end, whose time is rounded.
    pub(super) fn progress(&self, low: usize, t: f64, h: f64, reach: f64) -> f64 {
        if t >= self.queue.get(low) {
            reach
        } else {
            ((t - self.gaps[low].t) / h).min(reach)
        }
    }

    /// The series of the cluster that starts at `low`.
    pub(super) fn series(&self, low: usize, h: f64) -> Series<'_> {
        let lanes = lanes(self.end[low] - low);
        Series::new(&self.coefficients[2 * ROWS * low..], lanes, h)
    }

    /// Gaps and rates of the cluster that starts at `low`, at `t`; and zeros behind, in
    /// rows that have room for whole lanes.
    pub(super) fn at(&self, low: usize, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        match self.plans[low] {
            Plan::Flight => (gaps[0], rates[0]) = self.flight(low, t),
            Plan::Series { h, reach, .. } => {
                let s = self.progress(low, t, h, reach);
                self.series(low, h).evaluate(s, gaps, rates);
            }
            Plan::Encounter(i) => self.at_encounter(low, i, t, gaps, rates),
            Plan::Landing => self.at_landing(t, gaps, rates),
            Plan::Rest => self.at_rest(t, gaps, rates),
        }
    }

    /// All gaps and rates at `t`.
    pub(super) fn gaps_and_rates(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let n = self.gaps.len();
        let row = || vec![0.0; n + PADDING];
        let (mut gaps, mut rates) = (row(), row());
        self.all_at(t, &mut gaps, &mut rates);
        gaps.truncate(n);
        rates.truncate(n);
        (gaps, rates)
    }

    /// All gaps and rates at `t`, in rows as long as [`Room`]'s.
    pub(super) fn all_at(&self, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let mut i = 0;
        while i < self.gaps.len() {
            // Upwards, so that what is written behind a cluster is written over.
            self.at(i, t, &mut gaps[i..], &mut rates[i..]);
            i = self.end[i];
        }
    }

    /// Gap `i`, in flight, and its rate at `t`.
    pub(super) fn flight(&self, i: usize, t: f64) -> (f64, f64) {
        self.gaps[i].flown(&self.ground, i == 0, t)
    }

    /// Books what the cluster that starts at `low` has lost, and the plate's work on
    /// it, from its own time up to `t`.
    pub(super) fn account(&self, low: usize, t: f64, ledger: &mut Ledger, room: &mut Room) {
        let (h, reach) = match self.plans[low] {
            Plan::Flight => return,
            Plan::Series { h, reach, .. } => (h, reach),
            Plan::Encounter(i) => return self.account_encounter(low, i, t, ledger),
            Plan::Landing => return self.account_landing(t, ledger),
            Plan::Rest => return self.account_rest(t, ledger),
        };
        let series = self.series(low, h);
        let s = self.progress(low, t, h, reach);
        room.a[..lanes(self.end[low] - low)].fill(0.0);
        for (j, i) in (low..self.end[low]).enumerate() {
            let Spring {
                stiffness, dashpot, ..
            } = self.springs[i];
            match self.modes[i] {
                Mode::Open => {}
                Mode::Pushing => room.a[j] = dashpot,
                Mode::Idle => {
                    // Where the attraction is cut off the spring relaxes without work.
                    let g = series.gap(j, 1.0, s).iter().sum::<f64>();
                    let squares = (self.gaps[i].g - g) * (self.gaps[i].g + g);
                    ledger.lost.add(0.5 * stiffness * squares);
                }
            }
        }
        let lost = series.dissipation(s, &room.a, &mut room.b, &mut room.series);
        ledger.lost.add(lost);
        if G::MOVES && low == 0 && self.modes[0] == Mode::Pushing {
            let force = series.force(0, self.springs[0], 1.0, s);
            ledger.plate_work.add(self.plate_work(&force, h, s));
        }
    }

    /// ∫ F ż₀ dt from 0 to `s`, F the force on the floor as a series in s'/s.
    fn plate_work(&self, force: &Polynomial, h: f64, s: f64) -> f64 {
        let mut motion = [0.0; ROWS];
        self.ground.motion(self.gaps[0].t, h, &mut motion);
        // The plate's own phase x over h is small mostly: x^j/j! soon is nothing.
        let x = self.ground.plate(0.0).omega * h;
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
