//! Runs under power laws: the ledger closes, slices and edits change nothing, and what cannot
//! end says so.

use beadlab::physics::{Observation, Outcome, build};
use beadlab::scene::{
    Facts, Floor, FloorContact, Launch, Law, Method, PowerLaw, Scene, Soft, Solver, Start, rebound,
};

use crate::power_laws::{FREE, HERTZ, HKK, TAGUCHI, adaptive, fig3};
use crate::scenes::{G, engine, fig1, look, run, shaken};

/// Scenes of every kind.
fn scenes() -> Vec<(String, Facts)> {
    let mut scenes = Vec::new();
    for law in [HERTZ, HKK, TAGUCHI, FREE] {
        for attraction in [true, false] {
            let method = Method::Soft(Soft {
                law: Law::Power(law),
                solver: Solver::Adaptive { tolerance: 1e-10 },
                attraction,
            });
            let dropped = Facts {
                gravity: Some(G),
                duration: Some(1.0),
                start: Start::Launched(Launch {
                    s0: 2e-4,
                    jitter: true,
                    v0: 0.0,
                }),
                ..fig1(method, 0.0)
            };
            let thrown = Facts {
                start: Start::Launched(Launch {
                    s0: 1e-5,
                    jitter: false,
                    v0: -0.3,
                }),
                ..shaken(method, 2.0)
            };
            let unequal = |facts: Facts| Facts {
                n: 5,
                width: 5e-4,
                floor_contact: FloorContact::SameRestitution,
                ..facts
            };
            for (name, facts) in [
                ("fig3", fig3(method, 10)),
                ("unequal", unequal(fig3(method, 10))),
                ("apart", fig1(method, 1e-6)),
                (
                    "shaken",
                    Facts {
                        n: 5,
                        ..shaken(method, 2.0)
                    },
                ),
                ("unequal, shaken", unequal(shaken(method, 1.5))),
                ("dropped", Facts { n: 4, ..dropped }),
                ("thrown", Facts { n: 4, ..thrown }),
                (
                    "at rest",
                    Facts {
                        floor: Floor::Fixed,
                        ..shaken(method, 1.0)
                    },
                ),
            ] {
                scenes.push((format!("{name} {law:?} {attraction}"), facts));
            }
        }
    }
    scenes
}

#[test]
fn the_ledger_closes() {
    for (name, facts) in scenes() {
        let seen = look(&*run(facts, 0.03));
        // Steps of 1e-10, thousands of them.
        assert!(
            seen.energy.drift.abs() < 1e-8,
            "{name}: {:e}",
            seen.energy.drift
        );
        assert!(seen.gaps.iter().all(|g| g.is_finite()));
    }
}

#[test]
fn slices_do_not_change_a_bit() {
    for (name, facts) in scenes().into_iter().step_by(3) {
        let until = 0.012;
        let whole = look(&*run(facts.clone(), until));
        let mut sliced = engine(facts);
        let mut look_at = Observation::default();
        for k in 1..=97 {
            let until = if k == 97 {
                until
            } else {
                until * f64::from(k) / 97.0
            };
            while sliced.advance(until, 5).expect("sound") == Outcome::OutOfBudget {}
            sliced.observe(&mut look_at);
            assert_eq!(look_at.time, until, "{name}");
        }
        assert_eq!(look_at, whole, "{name}");
    }
}

#[test]
fn a_resting_column_stays_where_it_is() {
    for law in [HERTZ, HKK, FREE] {
        let facts = Facts {
            floor: Floor::Fixed,
            ..shaken(adaptive(law, 1e-10), 1.0)
        };
        let (start, end) = (look(&*engine(facts.clone())), look(&*run(facts, 0.01)));
        assert!(start.gaps.iter().all(|&g| g < 0.0));
        for (a, b) in start.gaps.iter().zip(&end.gaps) {
            assert!((a / b - 1.0).abs() < 1e-6, "{law:?}: {a} {b}");
        }
    }
}

#[test]
fn an_edit_of_the_law_stores_up_no_energy() {
    let laws = [
        Law::Hooke { contact_time: 7e-5 },
        Law::Power(HERTZ),
        Law::Power(HKK),
        Law::Power(PowerLaw {
            stiffness: 4e12,
            ..HERTZ
        }),
    ];
    let method = |law: Law| {
        Method::Soft(Soft {
            law,
            solver: law.locating(),
            attraction: true,
        })
    };
    for from in laws {
        let scene = |law| Scene::new(fig3(method(law), 10)).expect("a scene");
        let (mut engine, _) = build(&scene(from), None);
        engine.advance(2e-4, u64::MAX).expect("sound");
        let before = look(&*engine);
        assert!(before.energy.elastic > 0.0);
        for to in laws {
            let (edited, _) = build(&scene(to), Some(&engine.state()));
            let after = look(&*edited);
            let more = after.energy.elastic / before.energy.elastic - 1.0;
            assert!(more < 1e-12, "{from:?} {to:?}: {more}");
            assert_eq!(after.energy.kinetic, before.energy.kinetic);
            // An edit is no error of the ledger.
            assert!(after.energy.drift.abs() < 1e-9);
        }
    }
}

#[test]
fn a_contact_that_never_ends_does_not_hang() {
    // Hertz's spring with a strong dashpot creeps back as t^-2 and never lets go.
    let law = PowerLaw {
        damping: 3e5,
        ..HERTZ
    };
    assert_eq!(rebound(&law, true, 0.05), 0.0);
    let mut engine = engine(fig3(adaptive(law, 1e-8), 5));
    let error = engine
        .advance(1e9, u64::MAX)
        .expect_err("a collision without an end");
    assert!(error.to_string().contains("creep"), "{error}");
    assert!(look(&*engine).gaps.iter().all(|g| g.is_finite()));
}
