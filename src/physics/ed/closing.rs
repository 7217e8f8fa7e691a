//! When a collapse is closed.
//!
//! In inelastic collapse a pair of beads collides infinitely often in finite time.
//! Only the depth to which gaps and rates shrink tells it from a sequence that is long
//! and ends: hard spheres have no scale, so a sequence can come back from any depth,
//! though the less likely the deeper it is. Both are followed, with all their digits,
//! until a pair meets at [`DEEP`] of the scene's own speed; then the two go on together.
//!
//! What this takes from the energy is 10⁻⁶⁰ of it: no contact can push beads apart faster
//! than they met. What else it can change is the order of collisions to come. That is
//! measured, not argued: a run in which something was closed is done again to half the
//! depth, and the difference counts as sensitivity.
//!
//! Some collapses are closed earlier:
//!
//! - Equal beads with Σ(1 − ε) ≥ [`WHOLE`] above a floor come to rest as a whole. Collapse
//!   begins near π there (Bernu & Mazighi 1990: ε < tan²(π/4 (1 − 1/N))), and the longest
//!   finite sequence known, of 2·10⁷ collisions, has 3.7. Nothing is left of the energy at
//!   whatever depth it is closed, so that depth decides about the cost only. So do unequal
//!   ones with [`UNEQUAL`], but for a light bead that gets away.
//! - Columns longer than [`LONG`], whose cost would grow as N³. Their cascades of touching
//!   beads with Σ(1 − ε) ≥ [`ABSORBING`], too, after [`Closing::cascade`] collisions: what a
//!   wave carries through them and back has fallen by e^{−Σ(1−ε)}, its energy by 10⁻¹².
//! - Beads on the floor that gravity presses together: [`Closing::rest_time`].

use super::Pair;
use crate::physics::state::{Depth, State};
use crate::scene::Scene;

/// Powers of two between the scene's own speed and that of a pair that is closed: of 200
/// columns of equal beads near collapse that came back none had been as deep, of 1500 of
/// unequal ones 1 %. Gaps fall as the third or fourth power of speeds.
const DEEP: i32 = 100;
/// Σ(1 − ε) from which equal beads come to rest as a whole, and unequal ones collapse at
/// once, but for a light one that gets away.
const WHOLE: f64 = 5.0;
const UNEQUAL: f64 = 8.0;
/// The longest column that is followed to full depth.
const LONG: usize = 64;
/// Σ(1 − ε) of touching beads through which nothing comes back.
const ABSORBING: f64 = 14.0;
/// Powers of two between √(d/g) and what is left of a bouncing sequence at rest.
const REST: i32 = 22;
/// Power of two near which gaps without gravity start.
const ROOM: i32 = 500;

/// What counts as no motion.
pub(super) struct Closing {
    /// Approaches slower than this, m/s, are none.
    pub speed: f64,
    /// A bead on the floor rests when all its bounces to come, 2u/(a(1 − ε)), last less
    /// than this, s: 2·10⁻⁷ of √(d/g). Meanwhile it
    /// cannot rise higher than 10⁻¹⁴ d.
    pub rest_time: f64,
    /// Whether long cascades are closed before they are slow.
    long: bool,
    depth: Depth,
}

impl Closing {
    /// Of a scene with these pairs, to a depth.
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

    /// Collisions after which a cascade of these touching pairs is closed. Waves cross k
    /// pairs in k collisions; these are some twenty waves.
    pub fn cascade(&self, touching: &[Pair]) -> Option<i32> {
        let absorbs = self.long && absorbed(touching) >= ABSORBING;
        absorbs.then(|| {
            let k = i32::try_from(touching.len()).unwrap_or(i32::MAX);
            self.depth.of(k.saturating_mul(20).saturating_add(10_000))
        })
    }

    /// Units of length in a metre, a power of two: without gravity such that the widest
    /// gap of the state is about 2⁵⁰⁰, and gaps can fall by 1500 powers of two.
    pub fn room(scene: &Scene, state: &State) -> f64 {
        if scene.gravity.is_some() {
            return 1.0;
        }
        let widest = state.gaps.iter().fold(0.0_f64, |widest, &g| widest.max(g));
        let length = if widest > 0.0 { widest } else { scene.diameter };
        power_of_two(ROOM - exponent(length))
    }
}

/// Powers of two to which a pair's speed is followed down.
fn powers(scene: &Scene, pairs: &[Pair]) -> i32 {
    let whole = absorbed(pairs) >= if scene.width == 0.0 { WHOLE } else { UNEQUAL };
    if whole || scene.n > LONG {
        // Short columns cost little; of long ones what waves between ends can still do.
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
