//! Bead 1 that touches down on the floor alone, under gravity: in closed form, whatever the
//! plate does.

use nalgebra::Complex;

use super::super::Gap;
use super::super::centre_of_mass::Centre;
use super::super::cluster::Cluster;
use super::super::oscillator::Oscillator;
use super::super::workspace::Workspace;
use super::{ClusterPlan, ContactMode};
use crate::math;
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::plate::Plate;

/// The largest p/(ωu) of a touchdown, p = g + Aω² and u the rebound speed without p.
///
/// p changes the gap by at most 2p/ω² and its rate by at most 2p/ω, a fifth of u. So the gap
/// stays closed until ωτ = π − 0.2 and opens once before π + 0.2.
const WEAK: f64 = 0.1;

/// A Newton step of this part of the time is the last: what it leaves is its square.
const HALF_THE_DIGITS: f64 = 1e-8;

/// Newton steps at most; two or three do.
const NEWTON: usize = 8;

/// A contact of bead 1 with the floor that began at τ = 0.
///
/// Its gap is Re(C e^{λτ}) + Im(Y e^{iΩτ}) − g/ω₀²: its own swing, its answer to the plate
/// (of angular frequency Ω), and its sag.
#[derive(Clone, Debug)]
pub(in super::super) struct Touchdown {
    oscillator: Oscillator,
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
    /// Z, m/s²: the plate's acceleration is Im(Z e^{iΩτ}).
    drive: Complex<f64>,
    /// g/ω₀², m.
    sag: f64,
    /// How long the contact lasts, s.
    lasts: f64,
}

impl Touchdown {
    /// The touchdown that a cluster is: gap 0, whose contact has just closed and that nothing
    /// else reaches before it opens, and perhaps gap 1, which is open.
    pub fn plan<G: Ground>(cluster: &Cluster<G>) -> Option<Self> {
        let constants = cluster.constants;
        let Gap { g, w, t } = cluster.gaps[0];
        let on_floor = G::PULLS && constants.attraction && cluster.low == 0;
        let alone = matches!(
            cluster.modes,
            [ContactMode::Pushing] | [ContactMode::Pushing, ContactMode::Open]
        );
        if !on_floor || !alone || g != 0.0 || w >= 0.0 {
            return None;
        }
        let oscillator = constants.oscillators[0].as_ref()?;
        let plate = cluster.ground.plate(t);
        let touchdown = Self::new(oscillator, w, constants.column.gravity, plate)?;
        let lasts = touchdown.lasts;
        // The floor's push only widens gap 1, and is left out: bead 1 then falls on by at
        // most g + Aω².
        let stays_open = |gap: &Gap| {
            let rate = gap.w + w - 0.5 * constants.pull * lasts;
            gap.g > 0.0 && gap.g + rate * lasts > 0.0
        };
        cluster.gaps[1..]
            .iter()
            .all(stays_open)
            .then_some(touchdown)
    }

    /// A touchdown at rate `w`, if it is weakly driven and its end is found.
    fn new(oscillator: &Oscillator, w: f64, gravity: f64, plate: Plate) -> Option<Self> {
        let Oscillator {
            mu,
            omega,
            restitution,
            ..
        } = *oscillator;
        let squared = mu * mu + omega * omega;
        let shake = plate.amplitude * plate.omega * plate.omega;
        let weak = gravity + shake <= WEAK * omega * restitution * -w;
        // Far from resonance no denominator below is small.
        if !weak || 2.0 * plate.omega > omega {
            return None;
        }
        let drive = math::cis(plate.phase) * -shake;
        let resistance = Complex::new(squared - plate.omega * plate.omega, 2.0 * mu * plate.omega);
        let (answer, sag) = (-drive / resistance, gravity / squared);
        let start = sag - answer.im;
        let turn = (w + mu * start - plate.omega * answer.re) / omega;
        let mut touchdown = Self {
            oscillator: *oscillator,
            w,
            gravity,
            plate,
            lambda: Complex::new(-mu, omega),
            own: Complex::new(start, -turn),
            answer,
            drive,
            sag,
            lasts: oscillator.lasts,
        };
        // Newton's method from the end without drive.
        for _ in 0..NEWTON {
            let (g, w) = touchdown.gap_and_rate(touchdown.lasts);
            let step = g / w;
            touchdown.lasts -= step;
            if step.abs() <= HALF_THE_DIGITS * touchdown.lasts {
                return Some(touchdown);
            }
        }
        None
    }

    /// Gap, m, and rate, m/s, at τ.
    fn gap_and_rate(&self, tau: f64) -> (f64, f64) {
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

    /// Whether the floor is a plate that moves.
    fn moves(&self) -> bool {
        self.plate.amplitude != 0.0
    }

    /// Energy that the contact has lost up to τ, and the work of the plate on the bead, m²/s².
    /// Both follow from the balance of kinetic energy, spring and drive in the plate's frame.
    fn spent(&self, tau: f64) -> (f64, f64) {
        let (m, stiffness) = (self.oscillator.reduced, self.oscillator.stiffness);
        let (g, w) = self.gap_and_rate(tau);
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

    /// ∫ ġ z̈₀ dτ from 0 to τ, m²/s².
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

impl<G: Ground> ClusterPlan<G> for Touchdown {
    fn ends(&self, cluster: &Cluster<G>) -> f64 {
        cluster.began() + self.lasts
    }

    fn change(&self, _: &Cluster<G>) -> Option<(usize, ContactMode)> {
        Some((0, ContactMode::Open))
    }

    fn at(&self, cluster: &Cluster<G>, t: f64, gaps: &mut [f64], rates: &mut [f64]) {
        let tau = cluster.elapsed(t, self.lasts);
        let (g, w) = self.gap_and_rate(tau);
        (gaps[0], rates[0]) = (g, w);
        if let Some(above) = cluster.gaps.get(1) {
            let t0 = cluster.began();
            let (fallen, falls) = cluster.ground.fall(t0, 0.0, self.w, t0 + tau);
            gaps[1] = above.g + above.w * tau + (fallen - g);
            rates[1] = above.w + (falls - w);
        }
    }

    fn account(&self, cluster: &Cluster<G>, t: f64, ledger: &mut Ledger, _: &mut Workspace) {
        let (lost, work) = self.spent(cluster.elapsed(t, self.lasts));
        ledger.lost.add(lost);
        if G::MOVES {
            ledger.plate_work.add(work);
        }
    }

    fn deepest(&self) -> Option<f64> {
        Some(self.w * self.oscillator.depth)
    }

    fn pushed(
        &self,
        cluster: &Cluster<G>,
        centre: Centre,
        t: f64,
        gaps: &[f64],
        rates: &[f64],
    ) -> Centre {
        centre.carried(cluster, t, &gaps[..1], rates)
    }
}
