//! When an inelastic collapse is closed, so that its beads go on together.
//!
//! In a collapse a pair of beads collides infinitely often in finite time. At first it looks
//! like a long sequence that ends. Only the depth to which gaps and rates shrink tells them
//! apart. Hard spheres have no scale, so a sequence can come back from any depth, but the
//! deeper it is the rarer that is. Every sequence is followed with all its digits until a pair
//! meets at 2^−[`DEEP`] of the scene's own speed. There it is closed.
//!
//! Closing takes 10⁻⁶⁰ of the energy, since no contact can push beads apart faster than they
//! met. It may also change the order of the collisions to come. A run in which something was
//! closed is therefore done again to half the depth, and the difference counts as
//! sensitivity.
//!
//! Some collapses are closed earlier:
//!
//! - Equal beads with Σ(1 − ε) ≥ [`WHOLE`] above a floor come to rest as a whole, whatever the
//!   depth at which they are closed. Collapse begins near Σ(1 − ε) = π there (Bernu & Mazighi
//!   1990: ε < tan²(π/4 (1 − 1/N))). The longest finite sequence known, of 2·10⁷ collisions,
//!   has 3.7. Unequal beads do so from [`UNEQUAL`] on, but for a light one that may get away.
//! - In columns longer than [`LONG`] the cost would grow as N³, and the depth is less. Their
//!   cascades of touching beads with Σ(1 − ε) ≥ [`ABSORBING`] are closed after
//!   [`Closing::cascade`] collisions. A wave that crosses such beads and comes back has fallen
//!   by e^{−Σ(1−ε)}, its energy by 10⁻¹².
//! - Beads that gravity presses onto the floor are closed by [`Closing::rest_time`].

use super::Pair;
use crate::physics::state::{Depth, State};
use crate::scene::Scene;

/// Powers of two between the scene's own speed and that of a pair that is closed. Of 200
/// columns of equal beads near collapse that came back none had been as deep. Of 1500 columns
/// of unequal beads 1 % had. Gaps fall as the third or fourth power of speeds.
const DEEP: i32 = 100;
/// Σ(1 − ε) from which on equal beads come to rest as a whole.
const WHOLE: f64 = 5.0;
/// The same of unequal beads.
const UNEQUAL: f64 = 8.0;
/// Beads of the longest column that is followed to full depth.
const LONG: usize = 64;
/// Σ(1 − ε) of touching beads that no wave crosses and comes back from.
const ABSORBING: f64 = 14.0;
/// Powers of two between √(d/g) and the rest time.
const REST: i32 = 22;
/// Power of two, in units, near which the gaps of a column without gravity start.
const WIDEST: i32 = 500;

/// What counts as no motion.
#[derive(Clone)]
pub(super) struct Closing {
    /// Approaches slower than this, m/s, are none.
    pub speed: f64,
    /// The rest time, s: 2·10⁻⁷ of √(d/g). A bead on the floor rests when all its bounces to
    /// come last less. They are lower than 10⁻¹⁴ d.
    pub rest_time: f64,
    /// Whether long cascades are closed before they are slow.
    long: bool,
    depth: Depth,
}

impl Closing {
    /// For a scene with these pairs, to a depth.
    pub fn of(scene: &Scene, pairs: &[Pair], depth: Depth) -> Self {
        let launched = scene.launch().map_or(0.0, |launch| launch.v0.abs());
        let gravity = scene.gravity;
        let fall = gravity.map_or(0.0, |gravity| (gravity * scene.diameter).sqrt());
        let time = gravity.map_or(0.0, |gravity| (scene.diameter / gravity).sqrt());
        Self {
            speed: fall.max(launched) * below(depth.of(powers(scene, pairs))),
            rest_time: time * below(depth.of(REST)),
            long: scene.n > LONG,
            depth,
        }
    }

    /// Collisions after which a cascade of these touching pairs is closed; None where it is
    /// followed to its end. A wave crosses k pairs in k collisions: these are some twenty waves.
    pub fn cascade(&self, touching: &[Pair]) -> Option<i32> {
        let absorbs = self.long && absorbed(touching) >= ABSORBING;
        absorbs.then(|| {
            let k = i32::try_from(touching.len()).unwrap_or(i32::MAX);
            self.depth.of(k.saturating_mul(20).saturating_add(10_000))
        })
    }

    /// Units of length in a metre, and of time in a second: a power of two. Without gravity
    /// the widest gap of the state is about 2^[`WIDEST`] units, so that gaps can fall by 1500
    /// powers of two before they underflow.
    pub fn scale(scene: &Scene, state: &State) -> f64 {
        if scene.gravity.is_some() {
            return 1.0;
        }
        let widest = state.gaps.iter().fold(0.0_f64, |widest, &g| widest.max(g));
        let length = if widest > 0.0 { widest } else { scene.diameter };
        power_of_two(WIDEST - exponent(length))
    }
}

/// Powers of two between the scene's own speed and that of a pair that is closed, in this
/// column.
fn powers(scene: &Scene, pairs: &[Pair]) -> i32 {
    let whole = absorbed(pairs) >= if scene.width == 0.0 { WHOLE } else { UNEQUAL };
    if whole || scene.n > LONG {
        // Short columns cost little and go deep, long ones less so.
        DEEP.min(12 + 700 / i32::try_from(scene.n).unwrap_or(i32::MAX))
    } else {
        DEEP
    }
}

/// Σ(1 − ε).
fn absorbed(pairs: &[Pair]) -> f64 {
    pairs.iter().map(|pair| 1.0 - pair.restitution).sum()
}

fn below(powers: i32) -> f64 {
    power_of_two(-powers)
}

/// 2ᵏ for a k that a normal double has.
fn power_of_two(k: i32) -> f64 {
    f64::from_bits(u64::try_from(k + 1023).unwrap_or(0) << 52)
}

/// The power of two below `x`, a positive number.
fn exponent(x: f64) -> i32 {
    i32::try_from((x.to_bits() >> 52) & 0x7ff).unwrap_or(0) - 1023
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_two_are_exact() {
        for k in [-1022, -100, 0, 1, 500, 1023] {
            assert!((power_of_two(k) / 2.0_f64.powi(k) - 1.0).abs() == 0.0);
            assert_eq!(exponent(1.5 * power_of_two(k)), k);
        }
    }
}
