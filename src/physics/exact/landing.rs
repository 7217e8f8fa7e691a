//! Bead 1 meets the floor alone, under gravity: in closed form, whatever the plate does.

use nalgebra::Complex;

use super::encounter::Encounter;
use super::{Exact, Gap, Mode};
use crate::math;
use crate::physics::flight::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::plate::Plate;

/// Part of the rebound that weight and plate may take for the contact to be one swing.
/// With p the most that they accelerate the gap, they change it by at most 2p/ω² and its
/// rate by 2p/ω: where that is a fifth of the rebound, the gap stays closed until
/// ωτ = π ± 0.2, and opens there for good.
const WEAK: f64 = 0.1;
/// A Newton step of this part of the time leaves its square.
const HALF_THE_DIGITS: f64 = 1e-8;

/// Newton steps at most; two or three do.
const NEWTON: usize = 8;

/// A contact with the floor that began at τ = 0, with gap
/// Re(C e^{λτ}) + Im(Y e^{iΩτ}) − g/ω₀²: its own swing, its answer to the plate, its sag.
#[derive(Debug, Clone, Copy)]
pub(super) struct Landing {
    constants: Encounter,
    /// Rate at which it began, m/s.
    w: f64,
    gravity: f64,
    /// The plate at τ = 0.
    plate: Plate,
    /// λ = −μ + iω, 1/s.
    lambda: Complex<f64>,
    /// C, m.
    own: Complex<f64>,
    /// Y, m.
    answer: Complex<f64>,
    /// Z of the plate's acceleration Im(Z e^{iΩτ}), m/s².
    drive: Complex<f64>,
    /// g/ω₀², m.
    sag: f64,
    /// s.
    lasts: f64,
}

impl Landing {
    /// A landing at rate `w`, if its end can be told at once.
    fn new(constants: &Encounter, w: f64, gravity: f64, plate: Plate) -> Option<Self> {
        let Encounter {
            mu,
            omega,
            restitution,
            ..
        } = *constants;
        let squared = mu * mu + omega * omega;
        let shake = plate.amplitude * plate.omega * plate.omega;
        let weak = gravity + shake <= WEAK * omega * restitution * -w;
        // Off resonance.
        if !weak || 2.0 * plate.omega > omega {
            return None;
        }
        let drive = math::cis(plate.phase) * -shake;
        let resistance = Complex::new(squared - plate.omega * plate.omega, 2.0 * mu * plate.omega);
        let (answer, sag) = (-drive / resistance, gravity / squared);
        let start = sag - answer.im;
        let turn = (w + mu * start - plate.omega * answer.re) / omega;
        let mut landing = Self {
            constants: *constants,
            w,
            gravity,
            plate,
            lambda: Complex::new(-mu, omega),
            own: Complex::new(start, -turn),
            answer,
            drive,
            sag,
            lasts: constants.lasts,
        };
        for _ in 0..NEWTON {
            let (g, w) = landing.at(landing.lasts);
            let step = g / w;
            landing.lasts -= step;
            if step.abs() <= HALF_THE_DIGITS * landing.lasts {
                return Some(landing);
            }
        }
        None
    }

    /// Gap and rate at τ.
    fn at(&self, tau: f64) -> (f64, f64) {
        let own = self.own * math::complex_exp(self.lambda * tau);
        let answer = if self.moves() {
            self.answer * math::cis(self.plate.omega * tau)
        } else {
            Complex::ZERO
        };
        (
            own.re + answer.im - self.sag,
            (self.lambda * own).re + self.plate.omega * answer.re,
        )
    }

    fn moves(&self) -> bool {
        self.plate.amplitude != 0.0
    }

    /// What it has lost at τ, and the plate's work on the bead, m²/s².
    fn spent(&self, tau: f64) -> (f64, f64) {
        let (m, stiffness) = (self.constants.reduced, self.constants.stiffness);
        let (g, w) = self.at(tau);
        let shared = self.shared(tau);
        let kinetic = 0.5 * m * (self.w - w) * (self.w + w);
        let lost = kinetic - 0.5 * stiffness * g * g - m * (self.gravity * g + shared);
        if !self.moves() {
            return (lost, 0.0);
        }
        let (plate, then) = (self.plate, self.plate.later(tau));
        let ((low, from), (high, to)) = (plate.motion(), then.motion());
        let lifted = high - low;
        let swung = w * to - self.w * from - shared;
        let work = swung + self.gravity * lifted + 0.5 * (to - from) * (to + from);
        (lost, m * work)
    }

    /// ∫ ġ z̈₀ dτ, m²/s².
    fn shared(&self, tau: f64) -> f64 {
        if !self.moves() {
            return 0.0;
        }
        let beat = Complex::new(0.0, self.plate.omega);
        // ∫ e^{aτ} dτ.
        let integral = |a: Complex<f64>| (math::complex_exp(a * tau) - 1.0) / a;
        let (own, lambda, drive) = (self.own * self.lambda, self.lambda, self.drive);
        let swing = own * drive * integral(lambda + beat)
            + own.conj() * drive * integral(lambda.conj() + beat);
        let answer = self.answer * beat;
        let steady = answer * drive.conj() * tau - answer * drive * integral(2.0 * beat);
        0.5 * (swing.im + steady.re)
    }
}

impl<G: Ground> Exact<G> {
    /// How long the cluster of gap 0, and of gap 1 that is open, is a contact of bead 1
    /// with the floor that has just begun and that nothing else reaches.
    pub(super) fn plan_landing(&mut self, low: usize, high: usize) -> Option<f64> {
        let Gap { g, w, t } = self.gaps[0];
        let alone = G::PULLS && self.attraction && low == 0 && high <= 2;
        if !alone || self.modes[0] != Mode::Pushing || g != 0.0 || w >= 0.0 {
            return None;
        }
        if high == 2 && self.modes[1] != Mode::Open {
            return None;
        }
        let constants = self.encounters[0].as_ref()?;
        let landing = Landing::new(constants, w, self.gravity, self.ground.plate(t))?;
        let lasts = landing.lasts;
        // The floor's push opens gap 1; without it bead 1 falls on.
        let stays_open = |gap: &Gap| {
            let rate = gap.w + w - 0.5 * self.pull * lasts;
            gap.g > 0.0 && gap.g + rate * lasts > 0.0
        };
        if !self.gaps[1..high].iter().all(stays_open) {
            return None;
        }
        self.landing = Some(landing);
        Some(lasts)
    }

    /// Gaps and rates of the cluster at `t`, while bead 1 lands.
    pub(super) fn at_landing(&self, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let Some(landing) = &self.landing else { return };
        let tau = self.since(0, t, landing.lasts);
        let (g, w) = landing.at(tau);
        (gaps[0], rates[0]) = (g, w);
        if self.end[0] == 2 {
            let t0 = self.gaps[0].t;
            let (fallen, falls) = self.ground.fall(t0, 0.0, landing.w, t0 + tau);
            let Gap {
                g: gap, w: rate, ..
            } = self.gaps[1];
            gaps[1] = gap + rate * tau + (fallen - g);
            rates[1] = rate + (falls - w);
        }
    }

    /// Books what the landing has lost up to `t`, and the plate's work.
    pub(super) fn account_landing(&self, t: f64, ledger: &mut Ledger) {
        let Some(landing) = &self.landing else { return };
        let (lost, work) = landing.spent(self.since(0, t, landing.lasts));
        ledger.lost.add(lost);
        if G::MOVES {
            ledger.plate_work.add(work);
        }
    }
}
