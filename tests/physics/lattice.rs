//! The lattice of Sec. IV C: its limits, its books, and what it is held against.

use crate::scenes::{INTEGRATORS, collide, engine, exact, fig1, look, rebound, soft};
use beadlab::physics::{Outcome, build, floor_restitution};
use beadlab::scene::{Arrangement, Facts, FloorContact, Integrator, Launch, Method, Scene, Start};

const CONTACT_TIME: f64 = 1e-5;

/// `rows` of 13 beads, ε = 0.9, t_c = 10 µs, without jitter or tangential damping.
fn lattice(method: Method, rows: usize, s0: f64, v0: f64) -> Facts {
    Facts {
        arrangement: Arrangement::Lattice {
            columns: 13,
            tangential: 0.0,
        },
        n: 13 * rows,
        start: Start::Launched(Launch {
            s0,
            jitter: false,
            v0,
        }),
        ..fig1(method, s0)
    }
}

fn verlet(steps: f64) -> Method {
    soft(Integrator::Verlet, CONTACT_TIME, steps)
}

/// The same with every bead shifted at random.
fn shifted(mut facts: Facts, seed: u64) -> Facts {
    if let Start::Launched(Launch { jitter, .. }) = &mut facts.start {
        *jitter = true;
    }
    facts.seed = seed;
    facts
}

fn with_drag(mut facts: Facts, tangential: f64) -> Facts {
    facts.arrangement = Arrangement::Lattice {
        columns: 13,
        tangential,
    };
    facts
}

#[test]
fn one_row_rebounds_as_a_single_bead() {
    for integrator in INTEGRATORS {
        for floor_contact in [FloorContact::SameSpring, FloorContact::SameRestitution] {
            for s0 in [0.0, 1e-6] {
                let facts = Facts {
                    floor_contact,
                    ..lattice(soft(integrator, CONTACT_TIME, 1000.0), 1, s0, -0.1)
                };
                let wall = floor_restitution(&Scene::new(facts.clone()).expect("a scene"));
                let (eps, relative) = rebound(facts);
                // The force jumps at the first touch: an error of the order μ h ≈ 1e-4.
                assert!((eps - wall).abs() < 2e-4, "{integrator:?}: {eps}, {wall}");
                // All thirteen alike, to rounding.
                assert!(relative < 1e-28, "{relative}");
            }
        }
    }
}

/// ε_eff of a chain of `rows` equal beads that touch, its floor having stiffness and
/// dashpot 1 times and its pairs 3/2 times those of a pair, and `drag`/2 more: what rows
/// that move as one are to each other, two contacts a bead at 60°. By the midpoint rule
/// with steps so short that its first-order error is below 1e-5.
fn chain(rows: usize, restitution: f64, drag: f64) -> f64 {
    let mu = -restitution.ln();
    let stiffness = 0.5 * (std::f64::consts::PI.powi(2) + mu * mu);
    let push = |i: usize, g: f64, w: f64| {
        let (k, c) = if i == 0 {
            (stiffness, mu)
        } else {
            (1.5 * stiffness, 1.5 * mu + 0.5 * drag)
        };
        if g <= 0.0 { -k * g - c * w } else { 0.0 }
    };
    let h = 1e-5;
    let (mut gaps, mut rates) = (vec![0.0; rows], vec![0.0; rows]);
    rates[0] = -1.0;
    let accelerations = |gaps: &[f64], rates: &[f64]| -> Vec<f64> {
        let forces: Vec<f64> = (0..=rows)
            .map(|i| {
                if i < rows {
                    push(i, gaps[i], rates[i])
                } else {
                    0.0
                }
            })
            .collect();
        let bead = |i: usize| forces[i] - forces[i + 1];
        (0..rows)
            .map(|i| bead(i) - if i == 0 { 0.0 } else { bead(i - 1) })
            .collect()
    };
    // All contacts are over long before four contact times a bead.
    for _ in 0..400_000 * rows {
        let a = accelerations(&gaps, &rates);
        let half = |x: &[f64], y: &[f64]| -> Vec<f64> {
            x.iter().zip(y).map(|(x, y)| x + 0.5 * h * y).collect()
        };
        let (g, w) = (half(&gaps, &rates), half(&rates, &a));
        let a = accelerations(&g, &w);
        for i in 0..rows {
            gaps[i] += h * w[i];
            rates[i] += h * a[i];
        }
    }
    let mut v = 0.0;
    let squares = rates.iter().map(|w| {
        v += w;
        v * v
    });
    (squares.sum::<f64>() / rows as f64).sqrt()
}

#[test]
fn rows_that_touch_move_as_the_chain_they_are() {
    for (rows, restitution, drag) in [(2, 0.9, 0.0), (4, 0.6, 0.0), (4, 0.9, 0.5)] {
        let expected = chain(rows, restitution, drag);
        for integrator in INTEGRATORS {
            let method = soft(integrator, CONTACT_TIME, 1000.0);
            let facts = Facts {
                restitution,
                ..lattice(method, rows, 0.0, -1e-6)
            };
            let (eps, _) = rebound(with_drag(facts, drag / CONTACT_TIME));
            // First order: some μ h, as for a single row.
            let difference = eps - expected;
            assert!(difference.abs() < 6e-4, "{rows} rows: {eps}, {expected}");
        }
    }
}

#[test]
fn overlaps_of_1e_17_m_keep_their_digits() {
    let eps = |v0: f64| rebound(lattice(verlet(100.0), 6, 0.0, v0)).0;
    // Overlaps of 1e-12 m and 1e-17 m: the bend of the contacts changes the force by an
    // overlap over a diameter, 1e-9. Places on a lattice some millimetres high are
    // rounded to 1e-18 m: forces computed from them would be off by a tenth.
    let (shallow, shallower) = (eps(-1e-7), eps(-1e-12));
    assert!((shallow - shallower).abs() < 1e-8, "{shallow} {shallower}");
}

#[test]
fn both_limits_are_near_those_of_a_column_of_that_height() {
    let of_column = |s0| {
        rebound(Facts {
            start: Start::Launched(Launch {
                s0,
                jitter: false,
                v0: -0.1,
            }),
            ..fig1(exact(CONTACT_TIME), s0)
        })
    };
    // σ = 0: the rows' two contacts are 3/2 times as stiff as the floor's one, which moves
    // 1 − ε_eff by less than a tenth: 0.0316 against 0.0333.
    let (eps, (column, _)) = (
        rebound(lattice(verlet(200.0), 10, 0.0, -0.1)).0,
        of_column(0.0),
    );
    assert!((eps - column).abs() < 0.003, "{eps}, column {column}");
    // σ = 30: contacts at 60° are no head-on collisions, but ten rows at ε = 0.9 come to
    // nearly the same. Over seeds ε_eff spreads by 0.01 about a value 0.03 above.
    let s0 = 30.0 * 0.1 * CONTACT_TIME;
    let seeds = [1, 2, 3];
    let mean = seeds
        .iter()
        .map(|&seed| rebound(shifted(lattice(verlet(50.0), 10, s0, -0.1), seed)).0)
        .sum::<f64>()
        / seeds.len() as f64;
    let (column, _) = of_column(s0);
    assert!((mean - column).abs() < 0.06, "{mean}, column {column}");
}

#[test]
fn the_ledger_is_kept_better_with_shorter_steps() {
    for integrator in INTEGRATORS {
        for (s0, drag) in [(0.0, 0.0), (1e-6, 0.0), (1e-6, 1e4)] {
            let drift = |steps| {
                let facts = lattice(soft(integrator, CONTACT_TIME, steps), 5, s0, -0.1);
                let facts = with_drag(shifted(facts, 1), drag);
                collide(facts).1.energy.drift.abs()
            };
            let (coarse, fine) = (drift(50.0), drift(800.0));
            // First order, but the errors of single contacts have either sign: at least
            // the square root of the sixteenth.
            assert!(
                fine < 0.25 * coarse && fine < 1e-4,
                "{integrator:?}: {coarse} {fine}"
            );
        }
    }
}

#[test]
fn nothing_pushes_the_lattice_aside() {
    for integrator in INTEGRATORS {
        let facts = shifted(
            lattice(soft(integrator, CONTACT_TIME, 100.0), 5, 1e-6, -0.1),
            3,
        );
        let n = facts.n;
        let mut engine = engine(facts);
        while engine
            .advance(engine.time() + 1e-4, u64::MAX)
            .expect("sound")
            != Outcome::Over
        {}
        let rates = engine.state().rates;
        let (across, up) = rates.split_at(n);
        let sideways = across.iter().sum::<f64>();
        assert!(across.iter().any(|u| u.abs() > 1e-4) && up.iter().sum::<f64>() > 0.0);
        // Roundings of some ten thousand pushes.
        assert!(sideways.abs() < 1e-13, "{sideways}");
    }
}

#[test]
fn drag_across_contacts_takes_energy() {
    let facts = shifted(lattice(verlet(100.0), 10, 1e-5, -0.1), 1);
    let damping = (1.0 / 0.9_f64).ln() / CONTACT_TIME;
    let (without, _) = rebound(facts.clone());
    let (with, _) = rebound(with_drag(facts, damping));
    assert!(with < without - 0.05, "{with}, {without}");
}

#[test]
fn the_same_seed_gives_the_same_bits_however_it_is_advanced() {
    for integrator in INTEGRATORS {
        let facts = shifted(
            lattice(soft(integrator, CONTACT_TIME, 50.0), 4, 3e-6, -0.1),
            7,
        );
        let until = 3e-3;
        let mut whole = engine(facts.clone());
        whole.advance(until, u64::MAX).expect("sound");
        let mut sliced = engine(facts.clone());
        let mut time = 0.0;
        while time < until {
            time = until.min(time + 1.7e-6 + 0.01 * time);
            while sliced.advance(time, 5).expect("sound") == Outcome::OutOfBudget {}
        }
        assert_eq!(look(&*whole), look(&*sliced));
        assert_eq!(whole.state(), sliced.state());
        let mut other = engine(Facts { seed: 8, ..facts });
        other.advance(until, u64::MAX).expect("sound");
        assert_ne!(whole.state().gaps, other.state().gaps);
    }
}

#[test]
fn a_lattice_starts_without_overlap_and_shifted_by_half_a_separation() {
    for seed in 0..20 {
        for s0 in [1e-9, 1e-6, 1e-3] {
            let facts = shifted(lattice(verlet(100.0), 10, s0, -0.1), seed);
            let n = facts.n;
            let engine = engine(facts);
            let seen = look(&*engine);
            let discs = seen.discs.expect("a plane");
            assert!(discs.contacts.is_empty() && seen.energy.elastic == 0.0);
            let shifts = engine.state().gaps;
            let most = shifts.iter().fold(0.0, |most: f64, x| most.max(x.abs()));
            assert!(most <= 0.5 * s0 && most > 0.45 * s0);
            // Every pair, every image.
            for i in 0..n {
                for j in 0..i {
                    let x = discs.x[j] - discs.x[i];
                    let x = x - discs.period * (x / discs.period).round();
                    let distance = x.hypot(discs.heights[j] - discs.heights[i]);
                    assert!(distance > discs.diameter * (1.0 - 1e-13), "{i} {j}");
                }
            }
        }
    }
}

#[test]
fn a_lattice_that_just_touches_has_overlaps_of_exactly_nothing() {
    let seen = look(&*engine(lattice(verlet(100.0), 10, 0.0, -0.1)));
    let discs = seen.discs.expect("a plane");
    // Every bead touches both beside it and two above: 13 · (10 + 2 · 9) pairs.
    assert_eq!(discs.contacts.len(), 364);
    assert!(discs.touching.iter().all(|&touches| touches));
    assert_eq!(seen.energy.elastic, 0.0);
    assert!(seen.reduced.iter().all(|&z| z == 0.0));
    assert!((discs.heights[129] - (0.5e-3 + 9e-3 * 0.75f64.sqrt())).abs() < 1e-17);
}

#[test]
fn a_column_has_no_discs() {
    let seen = look(&*engine(fig1(verlet(100.0), 0.0)));
    assert_eq!(seen.discs, None);
}

#[test]
fn an_edit_goes_on_from_the_state() {
    let facts = shifted(lattice(verlet(100.0), 4, 1e-6, -0.1), 1);
    let scene = Scene::new(facts.clone()).expect("a scene");
    let mut before = engine(facts.clone());
    before.advance(5e-5, u64::MAX).expect("sound");
    let state = before.state();
    let harder = Scene::new(Facts {
        method: soft(Integrator::Verlet, 0.5 * CONTACT_TIME, 100.0),
        ..facts
    });
    for edited in [scene, harder.expect("a scene")] {
        let mut after = build(&edited, Some(&state)).0;
        let (was, is) = (look(&*before), look(&*after));
        assert_eq!((was.time, &was.reduced), (is.time, &is.reduced));
        // A rate is kept half a step back, and rounded on the way.
        assert!((was.energy.kinetic / is.energy.kinetic - 1.0).abs() < 1e-14);
        assert_eq!(was.discs, is.discs);
        // The error made so far stays, and edits make none.
        assert!((was.energy.drift - is.energy.drift).abs() < 1e-3);
        after.advance(1e-2, u64::MAX).expect("sound");
        assert!(look(&*after).energy.drift.abs() < 1e-2);
    }
}
