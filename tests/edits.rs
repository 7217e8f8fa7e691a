//! One state, many engines: runs in pieces, runs resumed, edits, changes of method.

mod support;

use beadlab::physics::{Outcome, State, build};
use beadlab::scene::{Facts, Floor, Integrator, Scene};
use support::{ED, INTEGRATORS, engine, hard_scenes, look, run, shaken, soft};

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
        let Floor::Vibrating {
            amplitude,
            frequency,
        } = facts.floor
        else {
            unreachable!("shaken")
        };
        let edited = [
            Facts {
                floor: Floor::Vibrating {
                    amplitude: 1.5 * amplitude,
                    frequency,
                },
                ..facts.clone()
            },
            Facts {
                floor: Floor::Vibrating {
                    amplitude,
                    frequency: 2.0 * frequency,
                },
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
