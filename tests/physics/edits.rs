//! One state, many engines: runs in pieces, runs resumed, edits, changes of method.

use std::f64::consts::TAU;

use crate::scenes::{ED, G, INTEGRATORS, engine, exact, hard_scenes, look, run, shaken, soft};
use beadlab::physics::{Engine, Outcome, State, build};
use beadlab::scene::{
    Exponents, Facts, Floor, Integrator, Law, Method, PowerLaw, Scene, Shake, Soft, Solver, angular,
};

#[test]
fn splitting_a_run_changes_no_bit() {
    let soft_scenes =
        INTEGRATORS.map(|integrator| ("soft", shaken(soft(integrator, 1e-4, 40.0), 3.0)));
    for (name, facts) in hard_scenes().into_iter().chain(soft_scenes) {
        let whole = run(facts.clone(), 0.2).state();
        let mut split = engine(facts);
        let mut until: f64 = 0.0;
        while split.time() < 0.2 && until < 0.2 {
            until = (until + 0.000_371).min(0.2);
            while split.advance(until, 7).expect("a sound run") == Outcome::OutOfBudget {}
        }
        assert_eq!(split.state(), whole, "{name}");
    }
}

#[test]
fn a_run_goes_on_from_its_state() {
    for facts in [
        shaken(soft(Integrator::Verlet, 1e-4, 100.0), 2.0),
        shaken(ED, 3.0),
    ] {
        let scene = Scene::new(facts.clone()).expect("a valid scene");
        let half = run(facts.clone(), 0.07).state();
        let (mut resumed, handover) = build(&scene, Some(&half));
        assert_eq!(handover.describe(), None);
        resumed.advance(0.1, u64::MAX).expect("a sound run");
        let whole = look(&*run(facts, 0.1));
        let resumed = look(&*resumed);
        for (a, b) in whole.reduced.iter().zip(&resumed.reduced) {
            // Not the same bits: the MD grid starts anew, and phases are rounded anew.
            assert!((a - b).abs() < 1e-5, "{a} {b}");
        }
        assert!((whole.energy.drift - resumed.energy.drift).abs() < 1e-3);
    }
}

fn positions(state: &State) -> Vec<f64> {
    let mut height = 0.0;
    state
        .gaps
        .iter()
        .map(|g| {
            height += g;
            height
        })
        .collect()
}

#[test]
fn edits_move_neither_beads_nor_plate() {
    let soft_facts = shaken(soft(Integrator::Gear, 1e-4, 50.0), 2.0);
    for facts in [soft_facts, shaken(ED, 2.0)] {
        let engine = run(facts.clone(), 0.033);
        let before = look(&*engine);
        let Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }) = facts.floor
        else {
            unreachable!("shaken")
        };
        let edited = [
            Facts {
                floor: Floor::Vibrating(Shake {
                    amplitude: 1.5 * amplitude,
                    frequency,
                }),
                ..facts.clone()
            },
            Facts {
                floor: Floor::Vibrating(Shake {
                    amplitude,
                    frequency: 2.0 * frequency,
                }),
                ..facts.clone()
            },
            Facts {
                restitution: 0.9,
                ..facts.clone()
            },
        ];
        for facts in edited {
            let scene = Scene::new(facts).expect("a valid scene");
            let (edited, _) = build(&scene, Some(&engine.state()));
            let after = look(&*edited);
            assert!((before.floor - after.floor).abs() < 1e-15);
            for (a, b) in before.reduced.iter().zip(&after.reduced) {
                // Stiffer contacts take a smaller overlap: below a hundredth of a micron here.
                assert!((a - b).abs() < 1e-8, "{a} {b}");
            }
            for (a, b) in before.velocities.iter().zip(&after.velocities) {
                // A resting hard bead meets the new plate velocity at the next event, not before.
                assert!((a - b).abs() < 1e-12, "{a} {b}");
            }
            assert!(
                (before.energy.drift - after.energy.drift).abs() < 1e-3,
                "an edit is no error"
            );
        }
    }
}

#[test]
fn a_change_of_method_resolves_overlaps() {
    let facts = shaken(soft(Integrator::Gear, 1e-3, 50.0), 2.0);
    let mut engine = engine(facts.clone());
    while look(&*engine).gaps.iter().filter(|g| **g < 0.0).count() < 5 {
        engine
            .advance(engine.time() + 1e-3, u64::MAX)
            .expect("a sound run");
    }
    let (before, state) = (look(&*engine), engine.state());
    let hard = Scene::new(Facts {
        method: ED,
        ..facts.clone()
    })
    .expect("a valid scene");
    let (mut hard, handover) = build(&hard, Some(&state));
    assert!(
        handover.overlaps_removed >= 5 && handover.deepest > 0.0,
        "{handover:?}"
    );
    assert!(
        handover
            .describe()
            .is_some_and(|text| text.contains("overlap"))
    );
    let after = hard.state();
    assert!(after.gaps.iter().all(|g| *g >= 0.0));
    let moved = positions(&after)
        .last()
        .zip(positions(&state).last())
        .map(|(a, b)| a - b);
    let overlap: f64 = before.gaps.iter().filter(|g| **g < 0.0).sum();
    assert!(
        (moved.expect("beads") + overlap).abs() < 1e-12,
        "beads rise by the overlaps and no more"
    );
    hard.advance(hard.time() + 0.05, u64::MAX)
        .expect("a sound run");
    let back = Scene::new(facts).expect("a valid scene");
    let (mut soft, _) = build(&back, Some(&hard.state()));
    soft.advance(soft.time() + 0.05, u64::MAX)
        .expect("a sound run");
    assert!(look(&*soft).energy.kinetic.is_finite());
}

#[test]
fn splitting_just_before_an_event_changes_no_bit() {
    let scene = Scene::new(shaken(ED, 2.0)).expect("a valid scene");
    for k in 1..40 {
        // After an edit times are sums, which round.
        let edited = run(shaken(ED, 2.0), 0.003_7 * f64::from(k)).state();
        let mut whole = build(&scene, Some(&edited)).0;
        let mut split = build(&scene, Some(&edited)).0;
        let until = whole.time() + 0.1;
        whole.advance(until, u64::MAX).expect("a sound run");
        while let Some(next) = split.next_event().filter(|next| *next <= until) {
            split
                .advance(next.next_down(), u64::MAX)
                .expect("a sound run");
            split.advance(next, u64::MAX).expect("a sound run");
        }
        split.advance(until, u64::MAX).expect("a sound run");
        assert_eq!(split.state(), whole.state(), "edit {k}");
    }
}

/// Every kind of engine for a shaken column.
fn methods() -> Vec<(&'static str, Method)> {
    let power = Method::Soft(Soft {
        law: Law::Power(PowerLaw {
            exponents: Exponents::Taguchi,
            stiffness: 1e11,
            damping: 1e6,
        }),
        solver: Solver::Adaptive { tolerance: 1e-9 },
        attraction: true,
    });
    vec![
        ("ED", ED),
        ("Gear", soft(Integrator::Gear, 1e-4, 50.0)),
        ("Verlet", soft(Integrator::Verlet, 1e-4, 50.0)),
        ("exact", exact(1e-4)),
        ("adaptive", power),
    ]
}

/// The column on a plate of that α and frequency.
fn on_plate(facts: &Facts, alpha: f64, frequency: f64) -> Scene {
    let amplitude = alpha * G / angular(frequency).powi(2);
    Scene::new(Facts {
        floor: Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }),
        ..facts.clone()
    })
    .expect("a valid scene")
}

fn edit(engine: &mut Box<dyn Engine>, scene: &Scene) {
    *engine = build(scene, Some(&engine.state())).0;
}

/// Edits, and when: α and frequency. The last two come while the one before is under way.
const EDITS: [(f64, f64, f64); 6] = [
    (0.033, 3.0, 20.0),
    (0.21, 3.0, 31.0),
    (0.43, 0.0, 31.0),
    (0.6, 2.0, 31.0),
    (0.64, 1.0, 12.0),
    (0.65, 2.0, 20.0),
];

#[test]
fn edits_of_the_plate_are_smooth_and_alike_for_every_engine() {
    for (name, method) in methods() {
        let facts = shaken(method, 2.0);
        let mut engine = engine(facts.clone());
        let mut hard = crate::scenes::engine(shaken(ED, 2.0));
        let (mut edits, mut before) = (EDITS.iter().peekable(), look(&*engine));
        for k in 1..2500 {
            let until = 4e-4 * f64::from(k);
            engine.advance(until, u64::MAX).expect("a sound run");
            let after = look(&*engine);
            hard.advance(after.time, u64::MAX).expect("a sound run");
            let other = look(&*hard);
            // Bits of the time, which at some metres a second are so many of the place.
            assert!(
                (after.floor - other.floor).abs() < 1e-14,
                "{name} at {until}"
            );
            assert!((after.floor_velocity - other.floor_velocity).abs() < 1e-12);
            // No jump: velocity changes by no more than 3 g dt, place as velocity says.
            let dt = after.time - before.time;
            let gained = after.floor_velocity - before.floor_velocity;
            assert!(
                gained.abs() <= 3.0 * G * dt * (1.0 + 1e-9),
                "{name} at {until}: {gained}"
            );
            let middle = 0.5 * (after.floor_velocity + before.floor_velocity);
            let moved = after.floor - before.floor;
            assert!(
                (moved - middle * dt).abs() < 3.0 * G * dt * dt,
                "{name} at {until}"
            );
            before = after;
            if let Some((_, alpha, frequency)) = edits.next_if(|edit| edit.0 <= until) {
                let (soft, rigid) = (engine.state(), hard.state());
                let latest = soft.time.max(rigid.time).max(until);
                let change = |mut state: State, facts: &Facts| {
                    state.settle(latest);
                    build(&on_plate(facts, *alpha, *frequency), Some(&state)).0
                };
                engine = change(soft, &facts);
                hard = change(rigid, &shaken(ED, 2.0));
            }
        }
        assert!(edits.next().is_none());
    }
}

#[test]
fn a_plate_comes_back_to_where_its_formula_has_it() {
    for (name, method) in methods() {
        let facts = shaken(method, 2.0);
        let mut engine = engine(facts.clone());
        for (k, alpha) in [3.0, 0.5, 0.0, 4.0, 2.0].into_iter().enumerate() {
            engine
                .advance(0.137 * (k + 1) as f64, u64::MAX)
                .expect("a sound run");
            edit(&mut engine, &on_plate(&facts, alpha, 20.0));
        }
        engine.advance(0.9, u64::MAX).expect("a sound run");
        let seen = look(&*engine);
        let amplitude = 2.0 * G / angular(20.0).powi(2);
        let formula = amplitude * (TAU * 20.0 * seen.time).sin();
        assert!(
            (seen.floor - formula).abs() < 1e-13 * amplitude.max(1.0),
            "{name}"
        );
    }
}

#[test]
fn what_rests_goes_on_resting_while_the_plate_is_edited() {
    let edits = [
        (0.95, 20.0),
        (0.1, 20.0),
        (0.95, 20.0),
        (0.95, 40.0),
        (0.5, 13.0),
        (0.0, 13.0),
        (0.9, 13.0),
        (0.4, 13.0),
        (0.4, 40.0),
        (0.7, 20.0),
    ];
    for (name, method) in methods() {
        let facts = shaken(method, 0.7);
        let mut engine = engine(facts.clone());
        // Under its own weight, the plate passing its centre.
        let sag = look(&*engine).reduced;
        let mut until = 0.0;
        for (alpha, frequency) in edits {
            edit(&mut engine, &on_plate(&facts, alpha, frequency));
            for _ in 0..2000 {
                until += 2.1e-4 / 2.0;
                engine.advance(until, u64::MAX).expect("a sound run");
                let seen = look(&*engine);
                assert!(
                    seen.contacts.iter().all(|&closed| closed),
                    "{name} at {until}"
                );
                for (z, sag) in seen.reduced.iter().zip(&sag) {
                    // A load put on at once presses twice as deep, and waves add a little.
                    let sunk = seen.floor - z;
                    assert!(
                        sunk >= 0.0 && sunk <= -2.2 * 1.95 * sag,
                        "{name} at {until}: {sunk}"
                    );
                }
            }
        }
        assert_eq!(look(&*engine).events, 0, "{name}");
        assert!(look(&*engine).energy.drift.abs() < 1e-3);
    }
}

#[test]
fn splitting_an_edited_run_changes_no_bit() {
    for (name, method) in methods() {
        let facts = shaken(method, 2.0);
        let start = run(facts.clone(), 0.033).state();
        let scene = on_plate(&facts, 3.0, 31.0);
        let mut whole = build(&scene, Some(&start)).0;
        whole.advance(0.2, u64::MAX).expect("a sound run");
        let mut split = build(&scene, Some(&start)).0;
        for k in 1..=500 {
            let until = 0.0004 * f64::from(k);
            while split.advance(until, 7).expect("a sound run") == Outcome::OutOfBudget {}
        }
        assert_eq!(split.state(), whole.state(), "{name}");
        // The same goes on under another method, the way not yet gone included.
        let (half, _) = build(&scene, Some(&start));
        let hard = Scene::new(Facts {
            method: ED,
            ..scene.facts().clone()
        })
        .expect("a scene");
        let mut other = build(&hard, Some(&half.state())).0;
        other.advance(0.2, u64::MAX).expect("a sound run");
        let (a, b) = (look(&*whole), look(&*other));
        assert!(
            (a.floor - b.floor).abs() <= 2.0 * (a.time - b.time).abs() + 1e-14,
            "{name}"
        );
    }
}
