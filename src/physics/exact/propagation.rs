//! How clusters are brought to a time before their plans end, or then.

use super::cluster::Cluster;
use super::plan::{Flight, Plan};
use super::{ContactMode, Exact, Gap};
use crate::physics::ground::Ground;

/// Lengths, m, and speeds, m/s, below this are set to zero: they would decay into subnormal
/// numbers, which are slow.
const NOTHING: f64 = 1e-200;

/// A gap and its rate at `t`.
pub(super) fn brought((g, w): (f64, f64), t: f64) -> Gap {
    let flush = |x: f64| if x.abs() < NOTHING { 0.0 } else { x };
    let (g, w) = (flush(g), flush(w));
    Gap { g, w, t }
}

impl<G: Ground> Exact<G> {
    /// Ends the plan of the cluster that starts at `low`, at its end `t`. Which gap changes
    /// then, and to what.
    pub(super) fn finish(&mut self, low: usize, t: f64) -> Option<(usize, ContactMode)> {
        let plan = self.plans[low].of_cluster();
        let (deepest, change) = (plan.deepest(), plan.change(&self.cluster(low)));
        self.books.measure(deepest.into_iter());
        self.bring(low, t);
        change
    }

    /// Brings the cluster that starts at `low` to time `t`, before its plan ends or then.
    /// Its plan is spent, and it needs another.
    pub(super) fn bring(&mut self, low: usize, t: f64) {
        let gaps = low..self.clusters.end(low);
        // Not `self.cluster(low)`: the workspace is written to beside it.
        let cluster = Cluster::of(
            &self.ground,
            &self.constants,
            gaps.clone(),
            (&self.gaps, &self.modes),
            self.queue.get(low),
        );
        let (plan, work) = (self.plans[low].of_cluster(), &mut self.workspace);
        plan.account(&cluster, t, &mut self.books.ledger, work);
        plan.at(&cluster, t, &mut work.a, &mut work.b);
        let flies = cluster.flies();
        if G::PULLS && low == 0 && self.modes[0] == ContactMode::Pushing {
            self.centre = self.centre_at(t, &self.workspace.a, &self.workspace.b);
        }
        let work = &mut self.workspace;
        let moved = work.a.iter().zip(&work.b);
        for (gap, (&g, &w)) in self.gaps[gaps.clone()].iter_mut().zip(moved) {
            *gap = brought((g, w), t);
        }
        if !flies {
            let gaps = self.gaps[gaps].iter().map(|gap| gap.g);
            self.books.measure(gaps);
        }
        let spent = std::mem::replace(&mut self.plans[low], Plan::Flight(Flight));
        spent.retire(work);
    }

    /// Writes gaps and rates of the cluster that starts at `low`, at `t`, to the beginning
    /// of rows that have room for whole lanes.
    pub(super) fn at(&self, low: usize, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let plan = self.plans[low].of_cluster();
        plan.at(&self.cluster(low), t, gaps, rates);
    }

    /// Writes all gaps and rates at `t`, to rows as long as those of the workspace.
    pub(super) fn all_at(&self, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        // Upwards: what a cluster overwrites behind its end is written next.
        for low in self.clusters.starts() {
            self.at(low, t, &mut gaps[low..], &mut rates[low..]);
        }
    }

    /// Gap `i`, in flight, and its rate at `t`.
    pub(super) fn flight(&self, i: usize, t: f64) -> (f64, f64) {
        self.ground.flown(i, &self.gaps[i], t)
    }
}
