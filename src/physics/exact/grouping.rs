//! How gaps form clusters, and clusters get their plans.

use super::cluster::Cluster;
use super::plan::Plan;
use super::{ContactMode, Exact};
use crate::physics::ground::Ground;

impl<G: Ground> Exact<G> {
    /// The cluster that starts at `low`.
    pub(super) fn cluster(&self, low: usize) -> Cluster<'_, G> {
        Cluster::of(
            &self.ground,
            &self.constants,
            low..self.clusters.end(low),
            (&self.gaps, &self.modes),
            self.queue.get(low),
        )
    }

    /// Whether a force couples gaps `i` and `i` + 1: one of them is a contact.
    fn coupled(&self, i: usize) -> bool {
        self.modes[i] != ContactMode::Open || self.modes[i + 1] != ContactMode::Open
    }

    /// Forms clusters of gaps `low..high`, which have all been brought to `t`, and of what
    /// they are coupled to now, and gives each a plan.
    pub(super) fn regroup(&mut self, mut low: usize, mut high: usize, t: f64) {
        let n = self.gaps.len();
        if low > 0 && self.coupled(low - 1) {
            low = self.clusters.start(low - 1);
            self.bring(low, t);
        }
        if high < n && self.coupled(high - 1) {
            self.bring(high, t);
            high = self.clusters.end(high);
        }
        let mut start = low;
        for i in low..high {
            self.queue.write(i, f64::INFINITY);
            if i + 1 == high || !self.coupled(i) {
                self.clusters.join(start, i + 1);
                self.plan(start);
                start = i + 1;
            }
        }
        self.queue.play_again(low, high - 1);
    }

    /// Plans the cluster that starts at `low`. Its matches in the queue are left to play.
    fn plan(&mut self, low: usize) {
        let cluster = Cluster::of(
            &self.ground,
            &self.constants,
            low..self.clusters.end(low),
            (&self.gaps, &self.modes),
            f64::INFINITY,
        );
        let plan = Plan::of(&cluster, &mut self.stacks, &mut self.workspace);
        self.books.steps += u64::from(plan.is_step());
        let ends = plan.of_cluster().ends(&cluster);
        self.queue.write(low, ends);
        self.plans[low] = plan;
    }
}
