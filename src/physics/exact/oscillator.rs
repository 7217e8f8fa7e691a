//! A linear contact that nothing else touches: a damped harmonic oscillator.

use std::f64::consts::PI;

use crate::math;
use crate::physics::spring::Spring;

/// An underdamped contact. After it closes at rate w₀ its gap is w₀/ω e^{−μτ} sin ωτ.
#[derive(Debug, Clone, Copy)]
pub(super) struct Oscillator {
    /// Reduced mass, in mean bead masses.
    pub reduced: f64,
    /// K, 1/s².
    pub stiffness: f64,
    /// μ, 1/s.
    pub mu: f64,
    /// ω, 1/s.
    pub omega: f64,
    /// π/ω, s: half a swing, after which the contact opens.
    pub lasts: f64,
    /// exp(−μπ/ω), the ratio of the rates at its end and its beginning.
    pub restitution: f64,
    /// The deepest overlap over the closing speed, s.
    pub depth: f64,
}

impl Oscillator {
    /// None where the contact is overdamped: then it never opens.
    pub fn new(spring: Spring, reduced: f64) -> Option<Self> {
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

    /// Gap, m, and rate, m/s, a time `tau` after it closed at rate `w`.
    pub fn at(&self, w: f64, tau: f64) -> (f64, f64) {
        if tau >= self.lasts {
            return (0.0, -self.restitution * w);
        }
        let (sin, cos) = math::sin_cos(self.omega * tau);
        let now = w * math::exp(-self.mu * tau);
        let over = now * sin / self.omega;
        (over, now * cos - self.mu * over)
    }

    /// Energy that it has lost a time `tau` after it closed at rate `w`, m²/s².
    pub fn lost(&self, w: f64, tau: f64) -> f64 {
        let (g, now) = self.at(w, tau);
        0.5 * self.reduced * (w - now) * (w + now) - 0.5 * self.stiffness * g * g
    }
}
