//! A gap in flight.

use super::super::cluster::Cluster;
use super::super::workspace::Workspace;
use super::{ClusterPlan, ContactMode};
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;

/// A gap that no force acts on: only gravity and plate bend the lowest one.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Flight;

impl<G: Ground> ClusterPlan<G> for Flight {
    fn ends(&self, cluster: &Cluster<G>) -> f64 {
        cluster.ground.closes(cluster.low, &cluster.gaps[0])
    }

    fn change(&self, cluster: &Cluster<G>) -> Option<(usize, ContactMode)> {
        Some((cluster.low, ContactMode::Pushing))
    }

    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        (gaps[0], rates[0]) = cluster.ground.flown(cluster.low, &cluster.gaps[0], t);
    }

    fn account(&self, _: &Cluster<G>, _: f64, _: &mut Ledger, _: &mut Workspace) {}
}
