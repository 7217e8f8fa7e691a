//! The integral over time of the column's height, in closed form.
//!
//! Contacts between beads do not act on the centre of mass. It falls freely, but for the
//! push of the floor, whose moments follow from the plan of the floor's cluster.

use super::cluster::Cluster;
use super::workspace::PADDING;
use super::{ContactMode, Exact};
use crate::physics::ground::Ground;
use crate::physics::ledger::Sum;
use crate::physics::observation::Integrals;
use crate::physics::shell::Mover;

/// Moves of the epoch after which the centre of mass is computed anew from the beads, which
/// ends the sum of rounding errors.
const AGE: u32 = 64;

/// The centre of mass at a time of its own, and the integral of its height up to there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Centre {
    /// s from the epoch. While the floor pushes, it is not after the time of the lowest gap.
    pub t: f64,
    /// Moves of the epoch since it was last computed from the beads.
    aged: u32,
    mass: f64,
    /// Σ m z and Σ m v.
    moment: f64,
    momentum: f64,
    /// ∫ Σ m z dt.
    height: Sum,
}

impl Centre {
    /// Falls for `tau` s.
    pub fn fall(&mut self, tau: f64, gravity: f64) {
        let (pull, p) = (self.mass * gravity * tau, self.momentum);
        self.height
            .add(tau * (self.moment + tau * (0.5 * p - pull / 6.0)));
        self.moment += tau * (p - 0.5 * pull);
        self.momentum -= pull;
        self.t += tau;
    }

    /// Adds what a push of Σ f_k (τ/tau)^k has done over the last `tau` s.
    pub fn add_push(&mut self, tau: f64, push: &[f64]) {
        let (mut moments, mut k) = ([0.0; 3], 0.0);
        for f in push {
            let once = f / (k + 1.0);
            let twice = once / (k + 2.0);
            moments[0] += once;
            moments[1] += twice;
            moments[2] += twice / (k + 3.0);
            k += 1.0;
        }
        self.momentum += tau * moments[0];
        self.moment += tau * tau * moments[1];
        self.height.add(tau * tau * tau * moments[2]);
    }

    /// The centre of mass at `t`. The lowest beads of `cluster`, whose gaps and rates then
    /// are given, have been a stack of closed contacts, and all beads above them fell.
    ///
    /// F_i = −(K_i g_i + c_i ġ_i) is what the stack from bead i up gains in momentum. Solved
    /// for g_i and integrated, it gives the integrals of the gaps from what they are at both
    /// ends.
    pub fn carried<G: Ground>(
        &self,
        cluster: &Cluster<G>,
        t: f64,
        gaps: &[f64],
        rates: &[f64],
    ) -> Self {
        let (ground, constants) = (cluster.ground, cluster.constants);
        let m = gaps.len();
        let t0 = cluster.began();
        let tau = t - t0;
        let from = ground.plate(t0);
        // Height and velocity of a bead at both ends.
        let mut before = from.motion();
        let mut after = if G::MOVES {
            ground.plate(t).motion()
        } else {
            before
        };
        let (mut others, mut stack) = (*self, Self::default());
        let mut gained = vec![0.0; m];
        for i in 0..m {
            let gap = cluster.gaps[i];
            before = (before.0 + gap.g, before.1 + gap.w);
            after = (after.0 + gaps[i], after.1 + rates[i]);
            let bead = constants.column.masses[i];
            others.mass -= bead;
            others.moment -= bead * before.0;
            others.momentum -= bead * before.1;
            stack.mass += bead;
            stack.moment += bead * after.0;
            stack.momentum += bead * after.1;
            gained[i] = bead * (after.1 - before.1 + constants.column.gravity * tau);
        }
        others.fall(tau, constants.column.gravity);
        let mut height = stack.mass * from.swept(tau).0;
        let (mut push, mut above) = (0.0, 0.0);
        for i in (0..m).rev() {
            push += gained[i];
            above += constants.column.masses[i];
            let spring = constants.column.springs[i];
            let damped = spring.dashpot * (gaps[i] - cluster.gaps[i].g);
            height -= above * (push + damped) / spring.stiffness;
        }
        others.height.add(height);
        Self {
            t,
            aged: self.aged,
            mass: self.mass,
            moment: others.moment + stack.moment,
            momentum: others.momentum + stack.momentum,
            height: others.height,
        }
    }
}

impl<G: Ground> Exact<G> {
    /// The centre of mass at `t`, within the plan of the floor's cluster, whose gaps and
    /// rates then are given.
    pub(super) fn centre_at(&self, t: f64, gaps: &[f64], rates: &[f64]) -> Centre {
        let gravity = self.constants.column.gravity;
        let mut centre = self.centre;
        if self.modes[0] != ContactMode::Pushing {
            centre.fall(t - centre.t, gravity);
            return centre;
        }
        let cluster = self.cluster(0);
        centre.fall(cluster.began() - centre.t, gravity);
        let plan = self.plans[0].of_cluster();
        plan.pushed(&cluster, centre, t, gaps, rates)
    }

    /// Follows the epoch, which has moved on by `shift` s. Every [`AGE`] moves, as soon as
    /// the whole column flies, the centre is computed anew.
    pub(super) fn shift_centre(&mut self, shift: f64) {
        self.centre.t -= shift;
        self.centre.aged = self.centre.aged.saturating_add(1);
        let due = G::PULLS && self.centre.aged >= AGE;
        if !due || !self.books.contacts.all_open() {
            return;
        }
        self.centre = self.weighed(self.centre_now().height);
    }

    /// The centre of mass now.
    fn centre_now(&self) -> Centre {
        let row = || vec![0.0; self.clusters.end(0) + PADDING];
        let (mut gaps, mut rates) = (row(), row());
        self.at(0, self.clock.now, &mut gaps, &mut rates);
        self.centre_at(self.clock.now, &gaps, &rates)
    }

    /// The centre of mass now, computed from the beads, with this integral so far.
    pub(super) fn weighed(&self, height: Sum) -> Centre {
        let now = self.now();
        let (mut z, mut v) = (now.plate.position(), now.plate.velocity());
        let mut centre = Centre {
            t: self.clock.now,
            height,
            ..Centre::default()
        };
        for ((g, w), m) in now
            .gaps
            .iter()
            .zip(&now.rates)
            .zip(&self.constants.column.masses)
        {
            z += g;
            v += w;
            centre.mass += m;
            centre.moment += m * z;
            centre.momentum += m * v;
        }
        centre
    }

    /// The integral from the start to now; None without gravity.
    pub(super) fn integrals(&self) -> Option<Integrals> {
        G::PULLS.then(|| {
            let centre = self.centre_now();
            Integrals {
                height: centre.height.total() / centre.mass,
                energies: None,
            }
        })
    }
}
