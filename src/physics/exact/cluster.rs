//! Clusters: runs of gaps that forces couple, each with a plan of its own.

use super::constants::Constants;
use super::plan::Plan;
use super::{ContactMode, Exact, Gap};
use crate::physics::flight::Ground;

/// Which gaps form clusters.
#[derive(Debug)]
pub(super) struct Clusters {
    /// The lowest gap of the cluster that each gap is in.
    first: Vec<usize>,
    /// One past the highest gap of the cluster that starts at each gap.
    end: Vec<usize>,
}

impl Clusters {
    /// Each of `n` gaps by itself.
    pub fn alone(n: usize) -> Self {
        Self {
            first: (0..n).collect(),
            end: (1..=n).collect(),
        }
    }

    /// Makes gaps `low..high` a cluster.
    pub fn join(&mut self, low: usize, high: usize) {
        self.first[low..high].fill(low);
        self.end[low] = high;
    }

    /// One past the highest gap of the cluster that starts at `low`.
    pub fn end(&self, low: usize) -> usize {
        self.end[low]
    }

    /// The lowest gap of each cluster, upwards.
    pub fn starts(&self) -> impl Iterator<Item = usize> {
        let next = |&low: &usize| Some(self.end[low]).filter(|&i| i < self.end.len());
        std::iter::successors(Some(0), next)
    }
}

/// A cluster as it was when its plan began.
pub(super) struct Cluster<'a, G> {
    pub ground: &'a G,
    pub constants: &'a Constants,
    /// Its lowest gap, counted from the floor.
    pub low: usize,
    /// Its gaps, all at the time when the plan began.
    pub gaps: &'a [Gap],
    /// What each of them does during the plan.
    pub modes: &'a [ContactMode],
    /// When the plan ends, s from the epoch; infinite before there is a plan.
    pub ends: f64,
}

impl<G: Ground> Cluster<'_, G> {
    /// When the plan began, s from the epoch.
    pub fn began(&self) -> f64 {
        self.gaps[0].t
    }

    /// Whether it is one gap in flight.
    pub fn flies(&self) -> bool {
        self.modes == [ContactMode::Open]
    }

    /// Time between the beginning of a plan that lasts `lasts` s and `t`, s. The end of a
    /// plan is rounded as a time, but here it is `lasts` to the last bit.
    pub fn elapsed(&self, t: f64, lasts: f64) -> f64 {
        if t >= self.ends {
            lasts
        } else {
            (t - self.began()).min(lasts)
        }
    }
}

impl<G: Ground> Exact<G> {
    /// The cluster that starts at `low`.
    pub(super) fn cluster(&self, low: usize) -> Cluster<'_, G> {
        let gaps = low..self.clusters.end(low);
        Cluster {
            ground: &self.ground,
            constants: &self.constants,
            low,
            gaps: &self.gaps[gaps.clone()],
            modes: &self.modes[gaps],
            ends: self.queue.get(low),
        }
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
            low = self.clusters.first[low - 1];
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
        let gaps = low..self.clusters.end(low);
        let cluster = Cluster {
            ground: &self.ground,
            constants: &self.constants,
            low,
            gaps: &self.gaps[gaps.clone()],
            modes: &self.modes[gaps],
            ends: f64::INFINITY,
        };
        let plan = Plan::of(&cluster, &mut self.stacks, &mut self.workspace);
        self.state.books.steps += u64::from(plan.is_step());
        let ends = plan.of_cluster().ends(&cluster);
        self.queue.write(low, ends);
        self.plans[low] = plan;
    }
}
