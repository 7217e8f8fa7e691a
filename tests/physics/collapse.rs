//! Hard spheres near inelastic collapse: sequences that end are followed to their end,
//! with all their digits, whatever the scale they are played on.

use crate::dice::Dice;
use crate::double_double::Double;
use crate::scenes::{ED, fig1, look};
use beadlab::physics::{Outcome, build};
use beadlab::scene::{Facts, FloorContact, Launch, Scene, Start, diameters, initial_gaps};

/// What a floor collision comes to.
#[derive(Debug, Clone, Copy, PartialEq)]
struct End {
    eps_eff: f64,
    er_over_ef: f64,
    collisions: u64,
}

/// N, ε, and what an event loop in quadruple precision finds, which moves all gaps at every
/// collision. Its ε is the decimal number; that of the engine is the double next to it,
/// which at N(1 − ε) ≈ 3 changes ε_eff by some 10⁻¹² of itself.
const REFERENCE: [(usize, f64, End); 5] = [
    (
        10,
        0.9,
        End {
            eps_eff: 0.341_547_467_016_566_7,
            er_over_ef: 0.016_525_085_586_441_34,
            collisions: 100,
        },
    ),
    (
        15,
        0.8,
        End {
            eps_eff: 1.853_430_172_920_635e-6,
            er_over_ef: 0.885_377_922_988_349_3,
            collisions: 5753,
        },
    ),
    (
        25,
        0.9,
        End {
            eps_eff: 0.011_242_628_964_983_73,
            er_over_ef: 0.420_930_638_612_889_9,
            collisions: 1023,
        },
    ),
    (
        30,
        0.9,
        End {
            eps_eff: 5.878_347_422_869_371e-5,
            er_over_ef: 0.951_707_723_629_166_2,
            collisions: 38_691,
        },
    ),
    (
        35,
        0.9,
        End {
            eps_eff: 6.567_888_105_460_064e-4,
            er_over_ef: 0.966_830_244_481_599_9,
            collisions: 2_574_958,
        },
    ),
];

fn launched(n: usize, restitution: f64, s0: f64, v0: f64) -> Facts {
    Facts {
        n,
        restitution,
        start: Start::Launched(Launch {
            s0,
            jitter: false,
            v0,
        }),
        ..fig1(ED, s0)
    }
}

/// Runs a floor collision to its end, of so many collisions at most.
fn end(facts: Facts, most: u64) -> Option<End> {
    end_and_closed(facts, most).map(|(end, _)| end)
}

/// The same, and how many collapses were closed on the way.
fn end_and_closed(facts: Facts, most: u64) -> Option<(End, u64)> {
    let Start::Launched(Launch { s0, v0, .. }) = facts.start else {
        return None;
    };
    let scene = Scene::new(facts).expect("a valid scene");
    let (mut engine, _) = build(&scene, None);
    let before = look(&*engine).energy.kinetic;
    let mut until = s0.max(1e-12) / v0.abs();
    loop {
        let outcome = engine.advance(until, most).expect("a sound run");
        let now = look(&*engine);
        if outcome == Outcome::Over {
            let end = End {
                eps_eff: (now.energy.kinetic / before).sqrt(),
                er_over_ef: now.energy.relative / now.energy.kinetic,
                collisions: now.events,
            };
            return Some((end, now.closed));
        }
        if now.events >= most {
            return None;
        }
        until *= 2.0;
    }
}

fn off(found: f64, truth: f64) -> f64 {
    (found / truth - 1.0).abs()
}

#[test]
fn the_reference_in_quadruple_precision() {
    for (n, restitution, truth) in REFERENCE {
        for (s0, v0) in [(1e-6, -0.2), (10.0, -1e6)] {
            let found = end(launched(n, restitution, s0, v0), u64::MAX).expect("no budget");
            let case = format!("N {n}, eps {restitution}, s0 {s0}: {found:?}");
            assert_eq!(found.collisions, truth.collisions, "{case}");
            assert!(off(found.eps_eff, truth.eps_eff) < 2e-12, "{case}");
            assert!(off(found.er_over_ef, truth.er_over_ef) < 2e-12, "{case}");
        }
    }
}

/// The same collision by the plainest of means, in twice the digits: all gaps are moved to
/// the next collision, one after another.
fn plainly(facts: &Facts, most: u64) -> Option<End> {
    let wide = Double::from;
    let Start::Launched(Launch { v0, .. }) = facts.start else {
        return None;
    };
    let masses: Vec<Double> = diameters(facts)
        .iter()
        .map(|&d| {
            let d = wide(d) / wide(facts.diameter);
            d * d * d
        })
        .collect();
    let reduced = |i: usize| match i {
        0 => masses[0],
        i => masses[i] * masses[i - 1] / (masses[i] + masses[i - 1]),
    };
    // ε of a contact with the mean pair's spring and dashpot, from Eqs. (6) and (7).
    let damping = -wide(facts.restitution).ln() / Double::PI;
    let share = damping * damping / (Double::ONE + damping * damping);
    let rebound = |part: f64, reduced: Double| {
        let part = wide(part);
        let rest = wide(0.5) / reduced - part * part * share;
        if rest.hi <= 0.0 {
            return Double::ZERO;
        }
        (-(Double::PI * part * (share / rest).sqrt())).exp()
    };
    let restitution = |i: usize| match (i, facts.floor_contact) {
        (0, FloorContact::SameRestitution) => wide(facts.restitution),
        (0, FloorContact::SameSpring) => rebound(0.5, masses[0]),
        (i, _) => rebound(1.0, reduced(i)),
    };
    let n = facts.n;
    let restitutions: Vec<Double> = (0..n).map(restitution).collect();
    let mut gaps: Vec<Double> = initial_gaps(facts).into_iter().map(wide).collect();
    let mut rates = vec![Double::ZERO; n];
    rates[0] = wide(v0);
    let before = energies(&rates, &masses).0;
    for collisions in 0..most {
        let next = (0..n).filter(|&i| rates[i].hi < 0.0);
        let next = next.map(|i| (i, -gaps[i] / rates[i]));
        let Some((i, time)) = next.reduce(|a, b| if b.1 < a.1 { b } else { a }) else {
            let (kinetic, relative) = energies(&rates, &masses);
            return Some(End {
                eps_eff: (kinetic / before).sqrt().hi,
                er_over_ef: (relative / kinetic).hi,
                collisions,
            });
        };
        // A collapse, as far as this loop can tell: it has no end.
        if rates[i].hi > 1e-30 * v0 {
            return None;
        }
        for (gap, &rate) in gaps.iter_mut().zip(&rates) {
            *gap += rate * time;
        }
        gaps[i] = Double::ZERO;
        let change = -(Double::ONE + restitutions[i]) * rates[i];
        rates[i] = -restitutions[i] * rates[i];
        if i > 0 {
            rates[i - 1] += -(change * reduced(i) / masses[i - 1]);
        }
        if i + 1 < n {
            rates[i + 1] += -(change * reduced(i) / masses[i]);
        }
    }
    None
}

/// E and E_r.
fn energies(rates: &[Double], masses: &[Double]) -> (Double, Double) {
    let mut velocity = Double::ZERO;
    let velocities: Vec<Double> = rates
        .iter()
        .map(|&rate| {
            velocity += rate;
            velocity
        })
        .collect();
    let sum = |of: &dyn Fn(usize) -> Double| {
        let mut sum = Double::ZERO;
        for i in 0..rates.len() {
            sum += of(i);
        }
        sum
    };
    let centre = sum(&|i| masses[i] * velocities[i]) / sum(&|i| masses[i]);
    let about = |origin: Double| {
        sum(&|i| masses[i] * (velocities[i] - origin) * (velocities[i] - origin))
            * Double::from(0.5)
    };
    (about(Double::ZERO), about(centre))
}

/// A column whose N(1 − ε) is up to `absorbed`, where sequences become long.
fn column(dice: &mut Dice, most: usize, absorbed: f64, seed: u64) -> Facts {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "5 to `most`"
    )]
    let n = 5 + ((most - 4) as f64 * dice.roll()) as usize;
    let restitution = 1.0 - (0.5 + (absorbed - 0.5) * dice.roll()) / n as f64;
    Facts {
        restitution: restitution.max(0.05),
        width: if dice.chance(0.5) {
            0.0
        } else {
            1e-3 * dice.roll()
        },
        seed,
        floor_contact: if dice.chance(0.5) {
            FloorContact::SameSpring
        } else {
            FloorContact::SameRestitution
        },
        start: Start::Launched(Launch {
            s0: 1e-6,
            jitter: dice.chance(0.5),
            v0: -0.2,
        }),
        ..launched(n, 0.5, 1e-6, -0.2)
    }
}

#[test]
fn a_plain_event_loop_with_twice_the_digits() {
    let mut dice = Dice(5);
    let mut compared = 0;
    for seed in 0..60 {
        let facts = column(&mut dice, 20, 3.0, seed);
        let Some(truth) = plainly(&facts, 20_000) else {
            continue;
        };
        let found = end(facts.clone(), u64::MAX).expect("no budget");
        let case = format!("{found:?}, not {truth:?}: {facts:?}");
        assert_eq!(found.collisions, truth.collisions, "{case}");
        // Energies fall by up to fifteen decades, and each restitution is rounded once.
        assert!(off(found.eps_eff, truth.eps_eff) < 1e-11, "{case}");
        assert!(off(found.er_over_ef, truth.er_over_ef) < 1e-11, "{case}");
        compared += 1;
    }
    assert!(compared >= 40, "{compared}");
}

/// Hard spheres have no scale of length and none of speed: every column comes to the same
/// end on all of these. Where a collapse is closed, the number of collisions is that of the
/// rule, which rounding can shift.
fn scale_invariance(columns: u64, longest: usize, seed: u64) {
    let mut dice = Dice(seed);
    let mut ended = 0;
    for k in 0..columns {
        let facts = column(&mut dice, longest, 3.7, k);
        let Start::Launched(Launch { jitter, .. }) = facts.start else {
            continue;
        };
        let on = |(s0, v0): (f64, f64), most| {
            let start = Start::Launched(Launch { s0, jitter, v0 });
            let facts = Facts {
                start,
                ..facts.clone()
            };
            end_and_closed(facts, most)
        };
        let Some((first, closed)) = on((1e-6, -0.2), 30_000_000) else {
            continue;
        };
        for scale in [(1e-12, -1e6), (1e-3, -1e-6), (10.0, -3.0)] {
            let (other, _) = on(scale, 60_000_000).expect("not many more collisions");
            let case = format!("column {k} on {scale:?}: {other:?}, not {first:?}: {facts:?}");
            if first.eps_eff == 0.0 {
                assert_eq!(other.eps_eff, 0.0, "{case}");
                continue;
            }
            if closed == 0 {
                assert_eq!(other.collisions, first.collisions, "{case}");
            }
            // Rounding of velocities that fall by up to twenty decades: 4·10⁻¹² is the
            // worst of 800 columns.
            assert!(off(other.eps_eff, first.eps_eff) < 1e-11, "{case}");
            assert!(off(other.er_over_ef, first.er_over_ef) < 1e-11, "{case}");
        }
        ended += 1;
    }
    assert!(ended > columns / 2, "{ended}");
}

#[test]
fn no_scale_of_length_or_speed() {
    scale_invariance(25, 24, 1);
}

#[test]
#[ignore = "minutes"]
fn no_scale_of_length_or_speed_in_five_hundred_columns() {
    scale_invariance(500, 40, 2);
}

#[test]
fn a_collapse_ends_in_finite_work() {
    // N(1 − ε) far above π: nothing is left.
    for (n, restitution, s0) in [
        (40, 0.6, 1e-6),
        (40, 0.84, 1e-12),
        (200, 0.9, 1e-3),
        (60, 0.5, 0.0),
    ] {
        let found = end(launched(n, restitution, s0, -0.2), 50_000_000);
        let found = found.unwrap_or_else(|| panic!("N {n}, eps {restitution}: no end"));
        assert_eq!(found.eps_eff, 0.0, "N {n}, eps {restitution}: {found:?}");
    }
}
