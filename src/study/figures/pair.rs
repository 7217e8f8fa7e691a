//! One collision of one pair: what the appendix is about.

use super::FigureError;
use super::runs::{looks, results};
use crate::math;
use crate::scene::{
    Arrangement, Exponents, Facts, Floor, FloorContact, Launch, Law, Method, PowerLaw, Scene, Soft,
    Solver, Start,
};

/// Tolerance of the adaptive method.
const TOLERANCE: f64 = 1e-12;

/// Looks in a contact; the depth between two of them is interpolated to 10⁻¹⁰ of itself.
const LOOKS: u32 = 400;

/// A collision.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Hit {
    /// Largest overlap x_max, m.
    pub depth: f64,
    /// Contact time t_c, s.
    pub contact_time: f64,
    /// Restitution ε.
    pub restitution: f64,
}

/// The law with those exponents and K/m, whose pair at `speed` has a dashpot of strength
/// δ = D_n x_max^γ x_max/v: the part of its speed that it loses, roughly over π.
pub(super) fn law(
    (beta, gamma): (f64, f64),
    stiffness: f64,
    strength: f64,
    speed: f64,
) -> PowerLaw {
    let undamped = PowerLaw {
        exponents: Exponents::Free { beta, gamma },
        stiffness,
        damping: 0.0,
    };
    let depth = undamped.penetration(speed);
    PowerLaw {
        damping: strength * speed / math::powf(depth, 1.0 + gamma),
        ..undamped
    }
}

/// A bead against a floor that acts on it as a second bead does: the relative coordinate
/// of a pair obeys the same equation, Eq. (8).
fn scene(law: PowerLaw, speed: f64) -> Result<Scene, FigureError> {
    Ok(Scene::new(Facts {
        arrangement: Arrangement::Column,
        n: 1,
        diameter: 1e-3,
        width: 0.0,
        seed: 1,
        // It follows from the law.
        restitution: 1.0,
        floor_contact: FloorContact::SameRestitution,
        start: Start::Launched(Launch {
            s0: 0.0,
            jitter: false,
            v0: -speed,
        }),
        gravity: None,
        floor: Floor::Fixed,
        method: Method::Soft(Soft {
            law: Law::powers(law),
            solver: Solver::Adaptive {
                tolerance: TOLERANCE,
            },
            attraction: true,
        }),
        duration: None,
    })?)
}

/// Runs the collision of a pair that meets at `speed`, m/s.
pub(super) fn hit(law: PowerLaw, speed: f64) -> Result<Hit, FigureError> {
    let scene = scene(law, speed)?;
    let results = results(&scene)?;
    let end = law.contact_time(speed);
    let mut before = (0.0, speed);
    let mut depth: f64 = 0.0;
    looks(&scene, end, LOOKS, |seen| {
        // Overlap and its rate; the floor does not move.
        let now = (-seen.gaps[0], -seen.velocities[0]);
        if before.1 > 0.0 && now.1 <= 0.0 {
            depth = summit(before, now, end / f64::from(LOOKS));
        }
        before = now;
    })?;
    Ok(Hit {
        depth,
        contact_time: results.contact_duration.unwrap_or(f64::NAN),
        restitution: results.eps_eff.unwrap_or(f64::NAN),
    })
}

/// The highest point of the cubic with these values and slopes at both ends of an interval.
fn summit(from: (f64, f64), to: (f64, f64), width: f64) -> f64 {
    let (rise, a, b) = (to.0 - from.0, from.1 * width, to.1 * width);
    // Slope a + 2(3 rise − 2a − b)u + 3(a + b − 2 rise)u² = 0, without cancellation.
    let (half, square) = (3.0 * rise - 2.0 * a - b, 3.0 * (a + b - 2.0 * rise));
    let u = a / ((half * half - a * square).max(0.0).sqrt() - half);
    let u = u.clamp(0.0, 1.0);
    from.0 + u * (a + u * (half + u * square / 3.0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_linear_pair_has_closed_forms() {
        // Eqs. (5)-(7); ε = 0.9 and t_c = 7 µs at 0.2 m/s.
        let (restitution, contact_time, speed) = (0.9_f64, 7e-6, 0.2);
        let (omega, mu) = (
            std::f64::consts::PI / contact_time,
            -restitution.ln() / contact_time,
        );
        let found = hit(PowerLaw::linear(restitution, contact_time), speed).expect("it runs");
        // To the tolerance of the method.
        assert!((found.restitution - restitution).abs() < 1e-10);
        assert!((found.contact_time / contact_time - 1.0).abs() < 1e-10);
        // x is largest at tan ωt = ω/μ.
        let time = (omega / mu).atan() / omega;
        let depth = speed / omega * (-mu * time).exp() * (omega * time).sin();
        assert!(
            (found.depth / depth - 1.0).abs() < 1e-9,
            "{found:?} {depth}"
        );
    }

    #[test]
    fn the_summit_of_a_parabola() {
        // 2u − u² over half the way and over an interval of 2 s.
        assert!((summit((0.0, 1.0), (0.0, -1.0), 2.0) - 0.5).abs() < 1e-15);
        assert!((summit((1.0, 2.0), (2.0, 0.0), 1.0) - 2.0).abs() < 1e-15);
    }
}
