//! Two beads, or a bead and a floor without gravity, that meet alone: in closed form,
//! at the cost of a hard collision.

use std::f64::consts::PI;

use super::{Exact, Gap, Mode};
use crate::math;
use crate::physics::column::reduced_mass;
use crate::physics::flight::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::power_law::Spring;

/// How a contact goes when its beads meet alone, with overlap w₀/ω e^{−μτ} sin ωτ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Encounter {
    /// Reduced mass, in mean bead masses.
    pub reduced: f64,
    /// K, 1/s².
    pub stiffness: f64,
    /// μ, 1/s.
    pub mu: f64,
    /// ω, 1/s.
    pub omega: f64,
    /// π/ω, s.
    pub lasts: f64,
    /// exp(−μπ/ω).
    pub restitution: f64,
    /// The deepest overlap over the speed at which it closes, s.
    pub depth: f64,
}

impl Encounter {
    /// Of every contact; none where it is overdamped and never ends.
    pub fn all(springs: &[Spring], masses: &[f64]) -> Vec<Option<Self>> {
        let springs = springs.iter().enumerate();
        springs
            .map(|(i, spring)| Self::new(*spring, reduced_mass(masses, i)))
            .collect()
    }

    fn new(spring: Spring, reduced: f64) -> Option<Self> {
        let mu = 0.5 * spring.dashpot / reduced;
        let squared = spring.stiffness / reduced - mu * mu;
        let omega = squared.sqrt();
        let lasts = PI / omega;
        (squared > 0.0).then(|| Self {
            reduced,
            stiffness: spring.stiffness,
            mu,
            omega,
            lasts,
            restitution: math::exp(-mu * lasts),
            depth: math::exp(-mu / omega * math::atan(omega / mu)) / math::hypot(omega, mu),
        })
    }

    /// Gap and rate a time `tau` after it closed at a rate of `w`.
    pub fn at(&self, w: f64, tau: f64) -> (f64, f64) {
        if tau >= self.lasts {
            return (0.0, -self.restitution * w);
        }
        let (sin, cos) = math::sin_cos(self.omega * tau);
        let now = w * math::exp(-self.mu * tau);
        let over = now * sin / self.omega;
        (over, now * cos - self.mu * over)
    }

    /// What it has lost then, m²/s².
    pub fn lost(&self, w: f64, tau: f64) -> f64 {
        let (g, now) = self.at(w, tau);
        0.5 * self.reduced * (w - now) * (w + now) - 0.5 * self.stiffness * g * g
    }
}

impl<G: Ground> Exact<G> {
    /// How long the cluster `low..high` is one contact that has just closed and that
    /// nothing else reaches before it opens; with the contact.
    pub(super) fn plan_encounter(&self, low: usize, high: usize) -> Option<(usize, f64)> {
        if high - low > 3 || !self.attraction {
            return None;
        }
        let pushing = |i: &usize| self.modes[*i] == Mode::Pushing;
        let i = (low..high).find(pushing)?;
        let Gap { g, w, .. } = self.gaps[i];
        // Beside it are open gaps only, or there is none: else the cluster is longer, or
        // has a second contact.
        let alone = i <= low + 1 && (i + 1..high).all(|j| self.modes[j] == Mode::Open);
        let heavy = G::PULLS && i == 0;
        if !alone || heavy || g != 0.0 || w >= 0.0 {
            return None;
        }
        let lasts = self.encounters[i].as_ref()?.lasts;
        let beside = |j: usize| j == i || self.stays_open(i, j, self.gaps[j], w, lasts);
        (low..high).all(beside).then_some((i, lasts))
    }

    /// Whether gap `j` beside contact `i`, just closed at a rate of `w`, is open until
    /// that opens. The overlap pushes it open; without that it would change at a constant
    /// rate, gap 0 with at most g + Aω² less: it is least at either end.
    pub(super) fn stays_open(&self, i: usize, j: usize, gap: Gap, w: f64, lasts: f64) -> bool {
        let falls = if G::PULLS && j == 0 { self.pull } else { 0.0 };
        let rate = gap.w + self.share(i, j) * w;
        gap.g > 0.0 && gap.g + (rate - 0.5 * falls * lasts) * lasts > 0.0
    }

    /// Part of contact `i`'s relative acceleration that the bead between it and gap `j`
    /// beside it has.
    fn share(&self, i: usize, j: usize) -> f64 {
        let reduced = self.encounters[i].as_ref().map_or(0.0, |e| e.reduced);
        reduced * self.inverse[if j > i { i } else { j }]
    }

    /// Gaps and rates of the cluster at `low` at `t`, while contact `i` goes on alone.
    pub(super) fn at_encounter(
        &self,
        low: usize,
        i: usize,
        t: f64,
        gaps: &mut [f64],
        rates: &mut [f64],
    ) {
        let Some(encounter) = self.encounters[i].as_ref() else {
            return;
        };
        let tau = self.since(low, t, encounter.lasts);
        let w = self.gaps[i].w;
        let now = encounter.at(w, tau);
        for j in low..self.end[low] {
            (gaps[j - low], rates[j - low]) = self.beside(i, j, tau, w, now);
        }
    }

    /// Gap `j` and its rate a time `tau` after contact `i` closed at a rate of `w`, being
    /// `now` with its rate.
    pub(super) fn beside(
        &self,
        i: usize,
        j: usize,
        tau: f64,
        w: f64,
        now: (f64, f64),
    ) -> (f64, f64) {
        if j == i {
            return now;
        }
        let Gap { g, w: rate, t: t0 } = self.gaps[j];
        let (g, rate) = if G::PULLS && j == 0 {
            self.ground.fall(t0, g, rate, t0 + tau)
        } else {
            (g + rate * tau, rate)
        };
        let (over, now) = now;
        let share = self.share(i, j);
        (g + share * (w * tau - over), rate + share * (w - now))
    }

    /// Books what contact `i` has lost up to `t`.
    pub(super) fn account_encounter(&self, low: usize, i: usize, t: f64, ledger: &mut Ledger) {
        if let Some(encounter) = self.encounters[i].as_ref() {
            let tau = self.since(low, t, encounter.lasts);
            ledger.lost.add(encounter.lost(self.gaps[i].w, tau));
        }
    }

    /// Time since the plan of the cluster at `low` began, s; all of it, to the last bit,
    /// at its end, whose time is rounded.
    pub(super) fn since(&self, low: usize, t: f64, lasts: f64) -> f64 {
        if t >= self.queue.get(low) {
            lasts
        } else {
            (t - self.gaps[low].t).min(lasts)
        }
    }
}
