//! The exact method on its way: gaps and rates of short scenes with gravity and plates
//! against the reference of 32 digits.

use crate::oracle::Oracle;
use crate::scenes::{G, exact, fig1, shaken};
use beadlab::physics::{LinearLaw, Observation, build};
use beadlab::scene::{Facts, Floor, Launch, MethodName, Preset, Scene, Shake, Start, angular};
use beadlab::study::{Drive, measure};
use std::ops::ControlFlow;

/// What a motion must keep to, over the largest gap and rate that it has had: the
/// scenes are so short that they amplify rounding by some thousands at most.
const ALLOWED: f64 = 1e-11;

/// Follows a scene for `duration` s, looking at it `looks` times, from gaps and rates
/// changed by `change`. The reference's contact changes and shortest contact.
fn follow(
    what: &str,
    facts: Facts,
    duration: f64,
    looks: u32,
    change: impl Fn(&mut Vec<f64>, &mut Vec<f64>),
) -> (u64, f64) {
    let contact_time = facts.contact_time().expect("soft contacts");
    let scene = Scene::new(facts).expect("a valid scene");
    let mut state = build(&scene, None).0.state();
    let state_now = &mut state;
    change(&mut state_now.gaps, &mut state_now.rates);
    let (mut engine, _) = build(&scene, Some(&state));
    let mut oracle = Oracle::new(&scene, &state);
    // The plate's place is known to a rounding of A₀, which a contact feels as a kick.
    let amplitude = match scene.floor {
        Floor::Vibrating(Shake { amplitude, .. }) => amplitude,
        Floor::Fixed => 0.0,
    };
    let place = 2.0 * f64::EPSILON * amplitude;
    let kick = place * std::f64::consts::PI / contact_time;
    let (mut far, mut fast) = (0.0_f64, f64::MIN_POSITIVE);
    for look in 0..=looks {
        let until = duration * f64::from(look) / f64::from(looks);
        engine.advance(until, 20_000_000).expect("a sound run");
        assert_eq!(engine.time(), until, "{what}: the engine is too slow");
        oracle.advance(until);
        let seen = engine.state();
        let (gaps, rates) = (oracle.gaps(), oracle.rates());
        let largest = |x: &[f64], most: f64| x.iter().fold(most, |most, x| most.max(x.abs()));
        fast = largest(&rates, fast).max(state.rates[0].abs());
        far = largest(&gaps, far).max(fast * contact_time);
        for i in 0..gaps.len() {
            let errors = (
                ((seen.gaps[i] - gaps[i]).abs() - place) / far,
                ((seen.rates[i] - rates[i]).abs() - kick) / fast,
            );
            assert!(
                errors.0 <= ALLOWED && errors.1 <= ALLOWED,
                "{what}, gap {i} at {until:e} s: off by {:.1e} of {far:.1e} m and {:.1e} of \
                 {fast:.1e} m/s after {} changes",
                errors.0,
                errors.1,
                oracle.changes
            );
        }
    }
    (oracle.changes, oracle.shortest_contact)
}

fn as_built(_: &mut Vec<f64>, _: &mut Vec<f64>) {}

/// `facts` on a plate of reduced acceleration α and frequency f, from rest.
fn on_plate(n: usize, contact_time: f64, alpha: f64, frequency: f64) -> Facts {
    Facts {
        n,
        floor: Floor::Vibrating(Shake {
            amplitude: alpha * G / angular(frequency).powi(2),
            frequency,
        }),
        ..shaken(exact(contact_time), 2.0)
    }
}

fn dropped(n: usize, contact_time: f64, s0: f64, v0: f64) -> Facts {
    Facts {
        n,
        gravity: Some(G),
        duration: Some(1.0),
        start: Start::Launched(Launch {
            s0,
            jitter: false,
            v0,
        }),
        ..fig1(exact(contact_time), 0.0)
    }
}

#[test]
fn a_column_falls_and_settles() {
    for (n, restitution, contact_time, s0) in [
        (1, 0.9, 1e-4, 1e-4),
        (2, 0.5, 1e-3, 1e-5),
        (5, 0.6, 1e-3, 0.0),
        (5, 0.9, 1e-2, 1e-4),
    ] {
        let facts = Facts {
            restitution,
            ..dropped(n, contact_time, s0, -0.01)
        };
        let (changes, _) = follow("dropped", facts, 100.0 * contact_time, 50, as_built);
        assert!(changes > 0, "the case is here to test contacts");
    }
}

#[test]
fn a_column_is_thrown_by_a_plate() {
    // α just above 1, twice and twenty times; stiff and soft; faster than its contacts.
    for (n, contact_time, alpha, frequency, periods) in [
        (1, 1e-4, 1.001, 20.0, 2.0),
        (1, 1e-3, 3.0, 20.0, 4.0),
        (2, 1e-3, 2.0, 20.0, 2.0),
        (5, 1e-3, 1.01, 20.0, 1.0),
        (3, 1e-2, 2.0, 20.0, 4.0),
        (5, 1e-3, 20.0, 20.0, 1.0),
        (2, 1e-2, 3.0, 500.0, 20.0),
        (3, 1e-2, 50.0, 1000.0, 40.0),
    ] {
        let facts = on_plate(n, contact_time, alpha, frequency);
        let what = format!("N {n}, t_c {contact_time}, α {alpha}, {frequency} Hz");
        let (changes, _) = follow(&what, facts, periods / frequency, 40, as_built);
        // Soft contacts swallow a plate that is faster than they are.
        let soft = angular(frequency) * contact_time > 10.0;
        assert!(changes > 0 || soft, "{what}: it should take off");
    }
}

#[test]
fn a_bead_lands_alone_whatever_the_plate_does_meanwhile() {
    let contact_time = 1e-3;
    // Plates that hardly move in a contact, that turn a quarter, and that swing through.
    for (turns, restitution, n) in [(0.0, 0.9, 1), (0.02, 0.3, 1), (0.1, 0.9, 2), (0.3, 0.6, 2)] {
        let shaken = on_plate(n, contact_time, 2.0, f64::max(turns, 1e-3) / contact_time);
        let fixed = turns == 0.0;
        let facts = Facts {
            restitution,
            floor: if fixed { Floor::Fixed } else { shaken.floor },
            start: Start::Launched(Launch {
                s0: 3e-3,
                jitter: false,
                v0: -2.0,
            }),
            ..shaken
        };
        let what = format!("{turns} turns of the plate in a contact");
        let (changes, _) = follow(&what, facts, 5.0 * contact_time, 100, as_built);
        assert!(changes >= 2, "{what}: it should land and leave");
    }
}

#[test]
fn beads_ride_a_plate_that_cannot_throw_them() {
    for n in [1, 4] {
        let facts = on_plate(n, 1e-4, 0.9, 20.0);
        let (changes, _) = follow("resting", facts, 0.05, 40, as_built);
        // Starting with the plate's speed, the column oscillates a little in its contacts.
        assert_eq!(changes, 0, "N {n}");
    }
}

#[test]
fn a_long_column_at_rest_costs_nothing_once_it_is_still() {
    let facts = Facts {
        restitution: 0.05,
        ..on_plate(66, 7e-6, 0.9, 20.0)
    };
    // Its slowest oscillation loses e^{-120 t}: 10⁻¹⁴ of it are left after 0.3 s.
    let mut engine = crate::scenes::run(facts, 0.5);
    let mut seen = Observation::default();
    engine.observe(&mut seen);
    let steps = seen.steps;
    engine.advance(300.0, u64::MAX).expect("a sound run");
    engine.observe(&mut seen);
    assert_eq!(seen.steps, steps);
    assert!(steps > 0 && seen.contacts.iter().all(|&closed| closed));
    // Rounding of the plate's work, period by period.
    assert!(seen.energy.drift.abs() < 1e-12, "{}", seen.energy.drift);
}

#[test]
fn the_stiffest_contacts_are_followed_too() {
    let facts = dropped(3, 1e-9, 1e-12, -1e-2);
    let (changes, _) = follow("stiff", facts, 1e-7, 40, as_built);
    assert!(changes > 3, "the case is here to test contacts");
}

/// The least of `f` from 0 to `end`: by samples, then by thirds.
fn least(end: f64, f: impl Fn(f64) -> f64) -> f64 {
    let samples = 10_000;
    let at = |k: i32| end * f64::from(k) / f64::from(samples);
    let lowest = (1..samples)
        .min_by(|&a, &b| f(at(a)).total_cmp(&f(at(b))))
        .expect("there are samples");
    let (mut low, mut high) = (at(lowest - 1), at(lowest + 1));
    for _ in 0..100 {
        let third = (high - low) / 3.0;
        if f(low + third) < f(high - third) {
            high -= third;
        } else {
            low += third;
        }
    }
    f(low)
}

/// How far below 0 a graze goes, over the length that it is measured by.
const DEPTHS: [f64; 6] = [1e-4, 1e-7, 1e-10, -1e-10, -1e-7, -1e-4];

#[test]
fn a_bead_in_flight_grazes_the_plate() {
    let contact_time = 1e-3;
    let facts = Facts {
        start: Start::Launched(Launch {
            s0: 1e-3,
            jitter: false,
            v0: 0.0,
        }),
        ..on_plate(1, contact_time, 20.0, 20.0)
    };
    let (amplitude, omega) = (20.0 * G / angular(20.0).powi(2), angular(20.0));
    // Up with the plate at first, which turns before it meets the bead.
    let rate = -0.4 * amplitude * omega;
    let moves = |t: f64| {
        let plate = amplitude * ((omega * t).sin() - omega * t);
        (rate - 0.5 * G * t) * t - plate
    };
    let end = 0.25 * std::f64::consts::TAU / omega;
    let lowest = least(end, moves);
    for depth in DEPTHS {
        let what = format!("depth {depth:e}");
        let start = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
            gaps[0] = -lowest - depth * amplitude;
            rates[0] = rate;
        };
        let (changes, shortest) = follow(&what, facts.clone(), end, 40, start);
        assert_eq!(changes, if depth > 0.0 { 2 } else { 0 }, "{what}");
        if depth > 0.0 && depth < 1e-9 {
            assert!(shortest < 0.01 * contact_time, "{shortest:e}");
        }
    }
}

#[test]
fn a_bead_of_a_cluster_grazes_the_floor() {
    let (contact_time, restitution) = (1e-3, 0.2_f64);
    let start = Start::Launched(Launch {
        s0: 1e-3,
        jitter: false,
        v0: -1.0,
    });
    let facts = Facts {
        n: 2,
        restitution,
        start,
        ..fig1(exact(contact_time), 0.0)
    };
    let (mu, omega) = (
        -restitution.ln() / contact_time,
        std::f64::consts::PI / contact_time,
    );
    let overlap = 1e-6;
    let centre = 0.26 * omega * overlap;
    // The beads part: the pair rises, the lower one is pushed down at first, and pulled up
    // again by the attractive end of the contact.
    let pair = |t: f64| {
        let (sin, cos) = (omega * t).sin_cos();
        let size = overlap * (-mu * t).exp();
        (
            -size * (cos + mu / omega * sin),
            size * (omega + mu * mu / omega) * sin,
        )
    };
    let (gap, rate) = pair(0.35 * contact_time);
    let lowest = least(0.3 * contact_time, |t| {
        centre * t - 0.5 * (pair(0.35 * contact_time + t).0 - gap)
    });
    for depth in DEPTHS {
        let what = format!("depth {depth:e}");
        let start = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
            (gaps[0], gaps[1]) = (-lowest - depth * overlap, gap);
            (rates[0], rates[1]) = (centre - 0.5 * rate, rate);
        };
        let (changes, _) = follow(&what, facts.clone(), contact_time, 40, start);
        // Once the pair parts; and the graze begins and ends.
        assert_eq!(changes, if depth > 0.0 { 3 } else { 1 }, "{what}");
    }
}

#[test]
fn contacts_change_at_once_and_briefly() {
    let facts = |n| Facts {
        n,
        restitution: 0.7,
        ..fig1(exact(1e-3), 1e-3)
    };
    // A column in mid-air, the same from above and from below.
    let mirrored = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
        gaps.copy_from_slice(&[1e-1, 1e-6, 2e-6, 1e-6, 2e-6, 1e-6]);
        rates.copy_from_slice(&[1.0, -0.2, -0.1, -0.3, -0.1, -0.2]);
    };
    let (changes, _) = follow("mirrored", facts(6), 1e-2, 40, mirrored);
    assert!(changes > 8, "{changes}");
    // All contacts touch, and every other one parts at once.
    let parting = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
        gaps.fill(0.0);
        rates.copy_from_slice(&[-0.1, 0.1, -0.1, 0.1, -0.1, 0.1]);
    };
    follow("parting", facts(6), 1e-2, 40, parting);
    // Overlaps of a millionth of what the rates cover in a contact time.
    let leaving = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
        gaps.copy_from_slice(&[1e-9, -1e-10, -1e-12, -1e-14, 1e-9, -1e-9]);
        rates.copy_from_slice(&[-0.1, 0.1, 0.2, 0.3, -0.1, -0.1]);
    };
    let (_, shortest) = follow("leaving", facts(6), 1e-2, 40, leaving);
    assert!(shortest < 1e-5, "{shortest:e}");
    // Nothing overlaps and nothing approaches; then only the lowest, from zero.
    let touching = |gaps: &mut Vec<f64>, rates: &mut Vec<f64>| {
        gaps.fill(0.0);
        rates.fill(0.0);
        rates[0] = -1e-2;
    };
    follow("touching", facts(6), 1e-2, 40, touching);
}

/// What a landing with many meetings leaves is read where the column is then: as with
/// Gear's steps, of a column of loose beads that has landed once.
#[test]
fn the_last_bounce_is_that_of_a_grid() {
    let bounce = |method| {
        let scene = Preset::load("dropped").expect("embedded").scene;
        let scene = scene.with_method(method).expect("it is soft");
        let (mut engine, _) = build(&scene, None);
        engine.advance(0.05, u64::MAX).expect("a sound run");
        let mut seen = Observation::default();
        engine.observe(&mut seen);
        seen.bounce.expect("it has landed")
    };
    let (exact, grid) = (bounce(MethodName::Exact), bounce(MethodName::Gear));
    // The grid's error of first order, grown by the collisions of one landing.
    assert!((exact - grid).abs() < 2e-3, "{exact} {grid}");
}

/// The lowest contact of a stack at rest carries all N beads: its overlap is N g/K, and on a
/// plate that shakes it slowly (1 + α) N g/K.
#[test]
fn a_stack_at_rest_is_as_deep_as_its_load() {
    const CONTACT_TIME: f64 = 1e-4;
    let deepest = |facts: Facts| {
        let scene = Scene::new(facts).expect("a scene");
        let stiffness = LinearLaw::new(scene.restitution, CONTACT_TIME).stiffness();
        let mut watch = |_| ControlFlow::Continue(());
        let results = measure(&scene, &mut Drive::new(&scene, &mut watch)).expect("it is measured");
        let overlap = results.overlap_max.expect("soft contacts") * scene.diameter;
        overlap * stiffness / (scene.n as f64 * G)
    };
    let still = deepest(Facts {
        floor: Floor::Fixed,
        ..shaken(exact(CONTACT_TIME), 0.5)
    });
    // Ten loads are added up.
    assert!((still - 1.0).abs() < 1e-13, "{still}");
    let shaken = deepest(shaken(exact(CONTACT_TIME), 0.5));
    // The column's slowest mode is some fifty times as fast as the plate.
    assert!((shaken / 1.5 - 1.0).abs() < 2e-3, "{shaken}");
}
