//! Plans: how a cluster moves until its next contact change, if nothing reaches it before.
//!
//! A plan owns all that it needs beside the cluster as it was when the plan began. Each
//! kind is a file of its own and answers as a [`ClusterPlan`]. Another kind takes a file, a
//! variant of [`Plan`] and its two lines in [`Plan::of`] and [`Plan::of_cluster`].

mod collision;
mod flight;
mod rest;
mod series;
mod touchdown;

pub(super) use collision::Collision;
pub(super) use flight::Flight;
use rest::Rest;
pub(super) use rest::Stacks;
use series::SeriesPlan;
use touchdown::Touchdown;

use super::ContactMode;
use super::centre_of_mass::Centre;
use super::cluster::Cluster;
use super::workspace::Workspace;
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;

/// How a cluster moves.
///
/// Times are in seconds from the epoch, between the plan's beginning and its end.
pub(super) trait ClusterPlan<G: Ground> {
    /// When the plan ends.
    fn ends(&self, cluster: &Cluster<G>) -> f64;

    /// Which gap changes at the end, counted from the floor, and to what; None where the
    /// cluster only needs a new plan.
    fn change(&self, cluster: &Cluster<G>) -> Option<(usize, ContactMode)>;

    /// Writes the gaps, m, and their rates, m/s, at `t`. The rows begin with the cluster's
    /// lowest gap and have room for whole lanes; what lies behind its highest may be
    /// overwritten.
    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]);

    /// Books what the contacts lose, and the work of the plate, from the beginning to `t`.
    fn account(&self, cluster: &Cluster<G>, t: f64, ledger: &mut Ledger, work: &mut Workspace);

    /// The least gap between beginning and end, m, if that is not at either.
    fn deepest(&self) -> Option<f64> {
        None
    }

    /// The centre of mass at `t`, from what it was at the beginning. Asked of the lowest
    /// cluster where the floor pushes under gravity, with its gaps and rates at `t`.
    fn pushed(&self, _: &Cluster<G>, centre: Centre, _: f64, _: &[f64], _: &[f64]) -> Centre {
        centre
    }
}

/// The kinds of plans.
#[derive(Clone, Debug)]
pub(super) enum Plan {
    /// One gap in flight, until it closes.
    Flight(Flight),
    /// Any cluster, by a Taylor series.
    Series(SeriesPlan),
    /// One contact whose two bodies meet alone, until it opens.
    Collision(Collision),
    /// Bead 1 alone on the floor under gravity, until it leaves.
    Touchdown(Box<Touchdown>),
    /// A stack at rest on the floor, while no contact of it can open.
    Rest(Box<Rest>),
}

impl Plan {
    /// The cheapest plan that fits a cluster.
    pub fn of<G: Ground>(
        cluster: &Cluster<G>,
        stacks: &mut Stacks,
        workspace: &mut Workspace,
    ) -> Self {
        if cluster.flies() {
            Self::Flight(Flight)
        } else if let Some(collision) = Collision::plan(cluster) {
            Self::Collision(collision)
        } else if let Some(touchdown) = Touchdown::plan(cluster) {
            Self::Touchdown(Box::new(touchdown))
        } else if let Some(rest) = Rest::plan(cluster, stacks) {
            Self::Rest(Box::new(rest))
        } else {
            Self::Series(SeriesPlan::of(cluster, workspace))
        }
    }

    /// The plan as what answers for its cluster.
    pub fn of_cluster<G: Ground>(&self) -> &dyn ClusterPlan<G> {
        match self {
            Self::Flight(flight) => flight,
            Self::Series(series) => series,
            Self::Collision(collision) => collision,
            Self::Touchdown(touchdown) => touchdown.as_ref(),
            Self::Rest(rest) => rest.as_ref(),
        }
    }

    /// Whether it counts as a step of the method.
    pub fn is_step(&self) -> bool {
        matches!(self, Self::Series(_))
    }

    /// Gives its buffers back at its end.
    pub fn retire(self, workspace: &mut Workspace) {
        if let Self::Series(series) = self {
            workspace.keep_rows(series.into_rows());
        }
    }
}
