//! What is random in a scene, and where its column starts.

use super::{Facts, Launch, Start};
use crate::math;
use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Streams of one seed: what one draws does not shift what another gets.
const DIAMETERS: u64 = 0;
const JITTER: u64 = 1;

/// Diameters dᵢ of the beads from below, m: equal, or uniform in d ± w/2.
pub fn diameters(facts: &Facts) -> Vec<f64> {
    if facts.width == 0.0 {
        return vec![facts.diameter; facts.n];
    }
    let smallest = facts.diameter - facts.width / 2.0;
    uniform(facts.seed, DIAMETERS)
        .take(facts.n)
        .map(|u| smallest + facts.width * u)
        .collect()
}

/// Gaps gᵢ at the start from below, m.
///
/// Separated: s₀ each; with jitter bead i at z = i s₀ is shifted by up to ±s₀/2,
/// so that gaps lie between 0 and 2 s₀. Resting: 0, without the overlaps of the
/// static equilibrium, which belong to the contact law.
pub fn initial_gaps(facts: &Facts) -> Vec<f64> {
    match facts.start {
        Start::Resting => vec![0.0; facts.n],
        Start::Launched(Launch {
            s0, jitter: false, ..
        }) => vec![s0; facts.n],
        Start::Launched(Launch {
            s0, jitter: true, ..
        }) => {
            let mut below = 0.5; // The floor is not shifted.
            uniform(facts.seed, JITTER)
                .take(facts.n)
                .map(|u| {
                    let gap = s0 * (1.0 + (u - below));
                    below = u;
                    gap
                })
                .collect()
        }
    }
}

/// Uniform numbers in [0, 1), the same on every machine.
pub(super) fn uniform(seed: u64, stream: u64) -> impl Iterator<Item = f64> {
    let mut rng = ChaCha8Rng::seed_from_u64(seed);
    rng.set_stream(stream);
    let spacing = math::powi(0.5, 53);
    std::iter::repeat_with(move || (rng.next_u64() >> 11) as f64 * spacing)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::validate::example;

    fn jittered(n: usize, width: f64, seed: u64) -> Facts {
        Facts {
            n,
            width,
            seed,
            start: Start::Launched(Launch {
                s0: 1e-6,
                jitter: true,
                v0: -0.2,
            }),
            ..example()
        }
    }

    #[test]
    fn diameters_fill_their_width_and_nothing_else() {
        let facts = jittered(2000, 4e-4, 7);
        let drawn = diameters(&facts);
        let (low, high) = (8e-4, 1.2e-3);
        assert!(drawn.iter().all(|&d| (low..high).contains(&d)));
        let mean = drawn.iter().sum::<f64>() / 2000.0;
        // Three standard errors of a uniform distribution's mean.
        assert!(
            (mean - 1e-3).abs() < 3.0 * 4e-4 / 12f64.sqrt() / 2000f64.sqrt(),
            "{mean}"
        );
        assert!(drawn.iter().any(|&d| d < low + 4e-6) && drawn.iter().any(|&d| d > high - 4e-6));
    }

    #[test]
    fn jitter_shifts_each_bead_by_at_most_half_a_separation() {
        let gaps = initial_gaps(&jittered(2000, 0.0, 7));
        let mut height = 0.0;
        for (i, gap) in gaps.iter().enumerate() {
            height += gap;
            let shift = height - (i + 1) as f64 * 1e-6;
            assert!(
                *gap >= 0.0 && shift.abs() <= 0.5e-6 * (1.0 + 1e-9),
                "bead {i}: {shift}"
            );
        }
    }

    #[test]
    fn width_and_jitter_are_independent_and_the_seed_decides() {
        assert_eq!(
            initial_gaps(&jittered(10, 0.0, 3)),
            initial_gaps(&jittered(10, 4e-4, 3))
        );
        assert_ne!(
            initial_gaps(&jittered(10, 0.0, 3)),
            initial_gaps(&jittered(10, 0.0, 4))
        );
        assert_ne!(
            diameters(&jittered(10, 4e-4, 3)),
            diameters(&jittered(10, 4e-4, 4))
        );
        // A longer column starts with the same beads.
        assert_eq!(
            diameters(&jittered(10, 4e-4, 3)),
            diameters(&jittered(20, 4e-4, 3))[..10]
        );
    }

    #[test]
    fn the_first_bits_never_change() {
        let first: Vec<u64> = uniform(1, DIAMETERS).take(2).map(f64::to_bits).collect();
        assert_eq!(
            first,
            [4_600_922_157_057_517_826, 4_590_456_677_328_490_120]
        );
    }
}
