//! Clusters: gaps that are coupled by forces, and what each plans to do next.

use super::crossing::{ROWS, first_below_zero};
use super::series::{PHASE, Series, expand, lanes};
use super::{Exact, Mode};
use crate::physics::flight::Ground;

/// What a cluster does until its plan ends.
#[derive(Debug, Clone, Copy)]
pub(super) enum Plan {
    /// A gap in free flight, until it closes.
    Flight,
    /// A Taylor series in s = τ/h up to `reach`, where a gap may change.
    Series {
        /// Unit of time of the series, s.
        h: f64,
        /// Where the plan ends, in units of h.
        reach: f64,
        /// Which gap changes there, and to what.
        change: Option<(usize, Mode)>,
    },
    /// One contact, just closed, whose beads meet alone until it opens.
    Encounter(usize),
    /// Bead 1 alone on the floor under gravity, its contact just closed, until it opens.
    Landing,
    /// A stack at rest on the floor, in which nothing can open before the plan ends.
    Rest,
}

impl<G: Ground> Exact<G> {
    /// Whether gaps `i` and `i` + 1 feel each other: one of them is a contact.
    fn coupled(&self, i: usize) -> bool {
        self.modes[i] != Mode::Open || self.modes[i + 1] != Mode::Open
    }

    /// Plans gaps `low..high`, all brought to `t`, in clusters anew, together with
    /// what they have become coupled to.
    pub(super) fn regroup(&mut self, mut low: usize, mut high: usize, t: f64) {
        let n = self.gaps.len();
        if low > 0 && self.coupled(low - 1) {
            low = self.first[low - 1];
            self.bring(low, t);
        }
        if high < n && self.coupled(high - 1) {
            self.bring(high, t);
            high = self.end[high];
        }
        let mut start = low;
        for i in low..high {
            self.queue.write(i, f64::INFINITY);
            self.first[i] = start;
            if i + 1 == high || !self.coupled(i) {
                self.end[start] = i + 1;
                self.plan(start, i + 1);
                start = i + 1;
            }
        }
        self.queue.play_again(low, high - 1);
    }

    /// Plans one cluster, whose matches in the queue are left to play.
    fn plan(&mut self, low: usize, high: usize) {
        let t = self.gaps[low].t;
        let until = if high == low + 1 && self.modes[low] == Mode::Open {
            self.plans[low] = Plan::Flight;
            self.closes(low)
        } else if let Some((i, lasts)) = self.plan_encounter(low, high) {
            self.plans[low] = Plan::Encounter(i);
            t + lasts
        } else if let Some(lasts) = self.plan_landing(low, high) {
            self.plans[low] = Plan::Landing;
            t + lasts
        } else if let Some(until) = self.plan_rest(low, high) {
            self.plans[low] = Plan::Rest;
            until
        } else {
            self.plan_series(low, high)
        };
        self.queue.write(low, until);
    }

    /// When gap `i`, in flight, closes.
    pub(super) fn closes(&self, i: usize) -> f64 {
        self.gaps[i].closes(&self.ground, i == 0)
    }

    /// 1/m of the beads below (0: the floor) and above gap `i`.
    fn inverse_masses(&self, i: usize) -> (f64, f64) {
        let below = if i == 0 { 0.0 } else { self.inverse[i - 1] };
        (below, self.inverse[i])
    }

    /// Constants of the cluster's contacts in units of `h`, zero where no force acts.
    fn couple(&mut self, low: usize, high: usize, h: f64) {
        let lanes = lanes(high - low);
        self.coupling.clear(lanes);
        for i in low..high {
            let j = i - low;
            if self.modes[i] == Mode::Pushing {
                self.coupling.stiffness[j] = self.springs[i].stiffness * h * h;
                self.coupling.dashpot[j] = self.springs[i].dashpot * h;
            }
            (self.coupling.below[j], self.coupling.above[j]) = self.inverse_masses(i);
        }
    }

    /// A bound on the rates at which a cluster moves, 1/s (Gershgorin).
    fn fastest(&self, low: usize, high: usize) -> f64 {
        let (mut stiffness, mut dashpot) = (0.0_f64, 0.0_f64);
        let acting = |i: usize| self.modes[i] == Mode::Pushing;
        for i in low..high {
            let (below, above) = self.inverse_masses(i);
            let mut row = (0.0, 0.0);
            let mut add = |i: usize, factor: f64| {
                if acting(i) {
                    row.0 += factor * self.springs[i].stiffness;
                    row.1 += factor * self.springs[i].dashpot;
                }
            };
            add(i, below + above);
            if i > low {
                add(i - 1, below);
            }
            if i + 1 < high {
                add(i + 1, above);
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
        let driven = if low == 0 {
            self.ground.plate(0.0).omega
        } else {
            0.0
        };
        // A cluster in which no force acts goes on for a tick at most.
        own.max(driven).max(PHASE / self.tick)
    }

    /// Expands the cluster in a series and finds its first change; when the plan ends.
    fn plan_series(&mut self, low: usize, high: usize) -> f64 {
        self.state.books.steps += 1;
        let lanes = lanes(high - low);
        let h = PHASE / self.fastest(low, high);
        self.couple(low, high, h);
        let rows = &mut self.coefficients[2 * ROWS * low..][..ROWS * lanes];
        rows[..2 * lanes].fill(0.0);
        for (j, gap) in self.gaps[low..high].iter().enumerate() {
            rows[j] = gap.g;
            rows[lanes + j] = gap.w * h;
        }
        let pull = (G::PULLS && low == 0).then(|| {
            let mut pull = [0.0; ROWS];
            self.ground.pull(self.gaps[0].t, h, &mut pull);
            pull.map(|c| c * h * h)
        });
        let room = &mut self.room.a[..lanes + 2];
        expand(rows, &self.coupling, pull.as_ref(), room);
        let (reach, change) = self.first_change(low, high, h);
        self.plans[low] = Plan::Series { h, reach, change };
        self.gaps[low].t + h * reach
    }

    /// How far the cluster's series may be used, and which gap changes there.
    fn first_change(&mut self, low: usize, high: usize, h: f64) -> (f64, Option<(usize, Mode)>) {
        let lanes = lanes(high - low);
        let series = Series::new(&self.coefficients[2 * ROWS * low..], lanes, h);
        let mut reach = series.reach(&self.coupling.stiffness);
        let room = &mut self.room;
        room.sign.clear();
        let sign = |mode: &Mode| if *mode == Mode::Open { 1.0 } else { -1.0 };
        room.sign.extend(self.modes[low..high].iter().map(sign));
        room.sign.resize(lanes, 0.0);
        series.least_sums(&room.sign, reach, &mut room.a, &mut room.b);
        let mut first = None;
        for (j, i) in (low..high).enumerate() {
            let unsure = self.room.b[j] < 0.0;
            let gap = |sign| series.gap(j, sign, reach);
            let force = |sign| series.force(j, self.springs[i], sign, reach);
            let bounds = match self.modes[i] {
                Mode::Open if unsure => [Some((gap(1.0), Mode::Pushing)), None],
                Mode::Pushing if !self.attraction => [Some((force(1.0), Mode::Idle)), None],
                Mode::Pushing if unsure => [Some((gap(-1.0), Mode::Open)), None],
                Mode::Idle => [
                    Some((gap(-1.0), Mode::Open)),
                    Some((force(-1.0), Mode::Pushing)),
                ],
                Mode::Open | Mode::Pushing => continue,
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
}
