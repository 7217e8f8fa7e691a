//! One collision of two bodies under a power law, by itself.
//!
//! In units of the undamped penetration x_max and of x_max/v the contact obeys
//! ξ'' = −2δ ξ^γ ξ' − a ξ^(1+β), a = 1 + β/2, ξ'(0) = 1. With the energy's polar
//! coordinates ξ' = ρ cos φ, ξ^a = ρ sin φ it runs from φ = 0 to π, and ρ ends as ε.

use crate::math;
use std::f64::consts::{FRAC_PI_2, PI};

use super::PowerLaw;

/// The angle as a function of s ∈ (−∞, ∞) that takes the fractional powers at both ends
/// of a contact out of every integral (the double-exponential substitution).
struct Angle {
    sin: f64,
    cos: f64,
    /// dφ/ds.
    slope: f64,
}

impl Angle {
    fn at(s: f64) -> Self {
        let u = FRAC_PI_2 * math::sinh(s);
        let outer = PI / (1.0 + math::exp(2.0 * u.abs()));
        let (sin, cos) = math::sin_cos(outer);
        Self {
            sin,
            cos: if s > 0.0 { -cos } else { cos },
            slope: 2.0 * outer * (1.0 - outer / PI) * FRAC_PI_2 * math::cosh(s),
        }
    }
}

/// I(β) = t_c v/x_max of an undamped contact, Eq. (A2): π for β = 0, 2.94 for β = ½.
pub(super) fn undamped_shape(beta: f64) -> f64 {
    // Beyond |s| = 6 nothing is left for any β that a scene may have.
    const POINTS: i32 = 96;
    const STEP: f64 = 1.0 / 16.0;
    let a = 1.0 + 0.5 * beta;
    let sum: f64 = (-POINTS..=POINTS)
        .map(|k| {
            let angle = Angle::at(f64::from(k) * STEP);
            // The ends underflow to 0 · ∞.
            if angle.slope > 0.0 {
                angle.slope * math::powf(angle.sin, -0.5 * beta / a)
            } else {
                0.0
            }
        })
        .sum();
    sum * STEP / a
}

/// Restitution of a pair that meets at `speed`, m/s, under a power law, with or without
/// the attractive end of the contact. 0 for a pair so damped that it never parts.
pub fn rebound(law: &PowerLaw, attraction: bool, speed: f64) -> f64 {
    let (beta, gamma) = (law.exponents.beta(), law.exponents.gamma());
    let depth = law.penetration(speed);
    let contact = Contact {
        beta,
        gamma,
        a: 1.0 + 0.5 * beta,
        delta: law.damping * math::powf(depth, gamma) * (depth / speed),
        attraction,
    };
    // Two runs of fourth order, and what they say together.
    match (contact.end(STEPS), contact.end(2 * STEPS)) {
        (Some(rough), Some(fine)) => math::exp(fine + (fine - rough) / 15.0),
        _ => 0.0,
    }
}

/// Steps of the rougher run; with them ε is right to about 10⁻¹⁰.
const STEPS: u32 = 300;

/// The dimensionless contact.
struct Contact {
    beta: f64,
    gamma: f64,
    a: f64,
    delta: f64,
    attraction: bool,
}

impl Contact {
    /// d ln ρ/ds; none where the motion creeps and never comes to the end.
    fn slope(&self, s: f64, ln_rho: f64) -> Option<f64> {
        let Angle { sin, cos, slope } = Angle::at(s);
        let xi = math::powf(math::exp(ln_rho) * sin, 1.0 / self.a);
        let stiff = self.a * math::powf(xi, 0.5 * self.beta);
        let elastic = stiff * sin;
        let full = elastic + 2.0 * self.delta * math::powf(xi, self.gamma) * cos;
        let force = if self.attraction { full } else { full.max(0.0) };
        let turn = stiff * cos * cos + sin * force;
        if slope == 0.0 {
            return Some(0.0);
        }
        let change = slope * cos * (elastic - force) / turn;
        (turn > 0.0 && change.is_finite()).then_some(change)
    }

    /// ln ε, by Runge and Kutta's classical method.
    fn end(&self, steps: u32) -> Option<f64> {
        const FAR: f64 = 4.5;
        let h = 2.0 * FAR / f64::from(steps);
        let mut y = 0.0;
        for k in 0..steps {
            let s = -FAR + f64::from(k) * h;
            let k1 = self.slope(s, y)?;
            let k2 = self.slope(s + 0.5 * h, y + 0.5 * h * k1)?;
            let k3 = self.slope(s + 0.5 * h, y + 0.5 * h * k2)?;
            let k4 = self.slope(s + h, y + h * k3)?;
            y += h / 6.0 * (k1 + 2.0 * (k2 + k3) + k4);
        }
        Some(y)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::law::Exponents;

    fn free(beta: f64, gamma: f64, stiffness: f64, damping: f64) -> PowerLaw {
        PowerLaw {
            exponents: Exponents::Free { beta, gamma },
            stiffness,
            damping,
        }
    }

    #[test]
    fn the_shape_of_the_appendix() {
        assert!((undamped_shape(0.0) - PI).abs() < 1e-13);
        // √π Γ(2/5)/((5/4) Γ(9/10)), the gamma functions from a table to ten digits.
        let exact = PI.sqrt() * 2.218_159_543_757_688 / (1.25 * 1.068_628_702_119_319_4);
        assert!((undamped_shape(0.5) / exact - 1.0).abs() < 1e-12);
        // β = 2: 2∫du/√(1−u⁴) is twice the lemniscate's quarter, 2.622…
        assert!((undamped_shape(2.0) - 2.622_057_554_292_119).abs() < 1e-12);
        // β = 10: 2∫du/√(1−u¹²) = √π Γ(1/12)/(6 Γ(7/12)) is near 2 and above it.
        let flat = undamped_shape(10.0);
        assert!(flat > 2.0 && flat < 2.3, "{flat}");
    }

    #[test]
    fn where_the_law_has_a_closed_form() {
        // β = 2γ is linear in ξ^(1+γ): ε = exp(−πδ/√(a(1+γ) − δ²)) at any speed.
        for (gamma, damping) in [(0.0, 3.17e3), (0.25, 1e3), (0.25, 2e4), (1.0, 1e9)] {
            let law = free(2.0 * gamma, gamma, 2e9 * 1e6f64.powf(2.0 * gamma), damping);
            for speed in [0.02, 0.5] {
                let depth = law.penetration(speed);
                let delta = law.damping * depth.powf(1.0 + gamma) / speed;
                let omega = ((1.0 + gamma) * (1.0 + gamma) - delta * delta).sqrt();
                let exact = (-PI * delta / omega).exp();
                let found = rebound(&law, true, speed);
                // The fourth order of the quadrature, extrapolated once.
                assert!((found - exact).abs() < 1e-9, "γ {gamma}: {found} {exact}");
            }
        }
    }

    #[test]
    fn without_attraction_less_is_lost() {
        // Linear: the force vanishes at tan ωt = 2μω/(μ² − ω²)…; there the velocity is
        // v exp(−(μ/ω)(π − 2 atan(μ/ω)))(…): the known ε = exp(−2 (μ/ω) acot(μ/ω)).
        let law = PowerLaw::linear(0.6, 7e-6);
        let ratio = -0.6f64.ln() / PI;
        let exact = (-ratio * (PI - 2.0 * ratio.atan())).exp();
        let found = rebound(&law, false, 0.1);
        // A kink inside a step leaves an error of second order in it.
        assert!((found - exact).abs() < 1e-4, "{found} {exact}");
    }

    #[test]
    fn an_overdamped_pair_never_parts() {
        let law = free(0.0, 0.0, 2e9, 5e4);
        assert!(rebound(&law, true, 0.1) == 0.0);
        assert!(rebound(&law, false, 0.1) > 0.0);
        assert!((rebound(&free(0.5, 0.5, 2e12, 0.0), true, 0.1) - 1.0).abs() < 1e-15);
    }
}
