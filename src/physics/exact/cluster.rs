//! Clusters: runs of gaps that forces couple, each with a plan of its own.

use std::ops::Range;

use super::constants::Constants;
use super::{ContactMode, Gap};
use crate::physics::ground::Ground;

/// Which gaps form clusters.
#[derive(Clone, Debug)]
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

    /// The lowest gap of the cluster that gap `i` is in.
    pub fn start(&self, i: usize) -> usize {
        self.first[i]
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

impl<'a, G> Cluster<'a, G> {
    /// Of these gaps of the column.
    pub fn of(
        ground: &'a G,
        constants: &'a Constants,
        which: Range<usize>,
        (gaps, modes): (&'a [Gap], &'a [ContactMode]),
        ends: f64,
    ) -> Self {
        Self {
            ground,
            constants,
            low: which.start,
            gaps: &gaps[which.clone()],
            modes: &modes[which],
            ends,
        }
    }
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
