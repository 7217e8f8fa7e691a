//! Two beads that meet alone, or a bead and a floor without gravity: in closed form, at the
//! cost of a hard collision.

use super::super::Gap;
use super::super::cluster::Cluster;
use super::super::constants::Constants;
use super::super::oscillator::Oscillator;
use super::super::workspace::Workspace;
use super::{ClusterPlan, ContactMode};
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;

/// A contact that closes and opens while nothing else touches its two bodies. The gaps
/// beside it fly, but for what the contact does to the bead that they share with it.
#[derive(Debug, Clone, Copy)]
pub(in super::super) struct Collision {
    /// Its gap, counted from the floor.
    pub contact: usize,
    /// Rate at which it closed, m/s.
    pub w: f64,
    pub oscillator: Oscillator,
}

impl Collision {
    /// Contact `contact` closing at rate `w`; None where it is overdamped.
    pub fn new(constants: &Constants, contact: usize, w: f64) -> Option<Self> {
        let oscillator = constants.oscillators[contact]?;
        Some(Self {
            contact,
            w,
            oscillator,
        })
    }

    /// The collision that a cluster is: one contact that has just closed, and that nothing
    /// else reaches before it opens.
    pub fn plan<G: Ground>(cluster: &Cluster<G>) -> Option<Self> {
        let constants = cluster.constants;
        if cluster.gaps.len() > 3 || !constants.attraction {
            return None;
        }
        let pushing = |mode: &ContactMode| *mode == ContactMode::Pushing;
        let place = cluster.modes.iter().position(pushing)?;
        let Gap { g, w, .. } = cluster.gaps[place];
        // A cluster of more than one contact has a contact above this one, or is longer.
        let above = &cluster.modes[place + 1..];
        let alone = place <= 1 && above.iter().all(|mode| *mode == ContactMode::Open);
        let contact = cluster.low + place;
        if !alone || cluster.ground.bends(contact) || g != 0.0 || w >= 0.0 {
            return None;
        }
        let collision = Self::new(constants, contact, w)?;
        let mut gaps = (cluster.low..).zip(cluster.gaps);
        let apart = gaps.all(|(j, gap)| j == contact || collision.leaves_open(constants, j, *gap));
        apart.then_some(collision)
    }

    /// Whether `gap`, number `j` beside the contact, stays open as long as the contact lasts.
    ///
    /// The overlap only widens it, and is left out. Then its rate is constant, or falls by at
    /// most g + Aω² for gap 0, so that it is least at the beginning or the end.
    pub fn leaves_open(&self, constants: &Constants, j: usize, gap: Gap) -> bool {
        let lasts = self.oscillator.lasts;
        let falls = if j == 0 { constants.pull } else { 0.0 };
        let rate = gap.w + self.share(constants, j) * self.w;
        gap.g > 0.0 && gap.g + (rate - 0.5 * falls * lasts) * lasts > 0.0
    }

    /// Part of the contact's relative acceleration that goes to the bead between it and gap
    /// `j` beside it.
    fn share(&self, constants: &Constants, j: usize) -> f64 {
        self.oscillator.reduced * constants.inverse_mass_between(self.contact, j)
    }

    /// Gap `j` of the column, which was `gap` when the contact closed, and its rate a time
    /// `tau` later. The contact's own gap and rate then are `now`.
    pub fn gap_after<G: Ground>(
        &self,
        (ground, constants): (&G, &Constants),
        (j, gap): (usize, Gap),
        tau: f64,
        now: (f64, f64),
    ) -> (f64, f64) {
        if j == self.contact {
            return now;
        }
        let (g, rate) = ground.after(j, &gap, tau);
        let (over, now) = now;
        let share = self.share(constants, j);
        (
            g + share * (self.w * tau - over),
            rate + share * (self.w - now),
        )
    }
}

impl<G: Ground> ClusterPlan<G> for Collision {
    fn ends(&self, cluster: &Cluster<G>) -> f64 {
        cluster.began() + self.oscillator.lasts
    }

    fn change(&self, _: &Cluster<G>) -> Option<(usize, ContactMode)> {
        Some((self.contact, ContactMode::Open))
    }

    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let tau = cluster.elapsed(t, self.oscillator.lasts);
        let now = self.oscillator.at(self.w, tau);
        let column = (cluster.ground, cluster.constants);
        for (k, gap) in cluster.gaps.iter().enumerate() {
            let place = (cluster.low + k, *gap);
            (gaps[k], rates[k]) = self.gap_after(column, place, tau, now);
        }
    }

    fn account(&self, cluster: &Cluster<G>, t: f64, ledger: &mut Ledger, _: &mut Workspace) {
        let tau = cluster.elapsed(t, self.oscillator.lasts);
        ledger.lost.add(self.oscillator.lost(self.w, tau));
    }

    fn deepest(&self) -> Option<f64> {
        Some(self.w * self.oscillator.depth)
    }
}
