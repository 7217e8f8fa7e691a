//! Power laws, Eq. (8): the adaptive engine against closed forms, quadrature, the linear
//! engines and itself.

mod support;

use beadlab::physics::{Observation, Outcome, build, floor_restitution};
use beadlab::scene::{
    Exponents, Facts, Floor, FloorContact, GridSettings, Launch, Law, Method, PowerLaw, Scene,
    Soft, Solver, Start, rebound,
};
use support::{G, collide, engine, fig1, look, run, shaken};

const HERTZ: PowerLaw = PowerLaw {
    exponents: Exponents::Hertz,
    stiffness: 2e12,
    damping: 2e3,
};
const HKK: PowerLaw = PowerLaw {
    exponents: Exponents::HertzKuwabaraKono,
    stiffness: 2e12,
    damping: 1e5,
};
const TAGUCHI: PowerLaw = PowerLaw {
    exponents: Exponents::Taguchi,
    stiffness: 2e12,
    damping: 5e4,
};
const FREE: PowerLaw = PowerLaw {
    exponents: Exponents::Free {
        beta: 0.8,
        gamma: 1.3,
    },
    stiffness: 2e14,
    damping: 1e11,
};

fn adaptive(law: PowerLaw, tolerance: f64) -> Method {
    Method::Soft(Soft {
        law: Law::Power(law),
        solver: Solver::Adaptive { tolerance },
        attraction: true,
    })
}

/// The column of Fig. 3.
fn fig3(method: Method, n: usize) -> Facts {
    Facts {
        n,
        start: Start::Launched(Launch {
            s0: 0.0,
            jitter: false,
            v0: -0.05,
        }),
        ..fig1(method, 0.0)
    }
}

/// ε_eff and E_r/E_f.
fn shares(facts: Facts) -> (f64, f64) {
    support::rebound(facts)
}

#[test]
fn one_bead_rebounds_as_the_quadrature_says() {
    for law in [HERTZ, HKK, TAGUCHI, FREE] {
        for contact in [FloorContact::SameSpring, FloorContact::SameRestitution] {
            for attraction in [true, false] {
                let method = Method::Soft(Soft {
                    law: Law::Power(law),
                    solver: Solver::Adaptive { tolerance: 1e-12 },
                    attraction,
                });
                let facts = Facts {
                    floor_contact: contact,
                    ..fig3(method, 1)
                };
                let scene = Scene::new(facts.clone()).expect("a scene");
                let expected = floor_restitution(&scene);
                if contact == FloorContact::SameRestitution {
                    assert_eq!(expected, scene.restitution);
                    assert_eq!(expected, rebound(&law, attraction, 0.05));
                }
                let (found, _) = shares(facts);
                // Where the force is cut off it has a kink, over which the quadrature
                // loses its order.
                let tolerance = if attraction { 1e-10 } else { 1e-4 };
                assert!(
                    (found - expected).abs() < tolerance,
                    "{law:?} {contact:?} {attraction}: {found} {expected}"
                );
            }
        }
    }
}

#[test]
fn undamped_contacts_obey_the_appendix() {
    for beta in [0.0, 0.5, 1.5, 3.0] {
        for v0 in [-1e-3, -0.05, -10.0] {
            let law = PowerLaw {
                exponents: Exponents::Free { beta, gamma: 0.0 },
                stiffness: 2e9 * 1e6f64.powf(beta),
                damping: 0.0,
            };
            let facts = Facts {
                floor_contact: FloorContact::SameRestitution,
                start: Start::Launched(Launch {
                    s0: 0.0,
                    jitter: false,
                    v0,
                }),
                ..fig3(adaptive(law, 1e-12), 1)
            };
            // (A1) with γ and η out of the way, and (A2).
            let depth = ((1.0 + 0.5 * beta) / law.stiffness * v0 * v0).powf(1.0 / (2.0 + beta));
            let half = 0.5 * law.contact_time(v0.abs());
            let deepest = look(&*run(facts.clone(), half));
            // At the turning point the rate is that times the error of the time.
            assert!(
                (-deepest.gaps[0] / depth - 1.0).abs() < 1e-10,
                "β {beta} {v0}"
            );
            assert!(deepest.velocities[0].abs() < 1e-9 * v0.abs());
            let (_, end) = collide(facts);
            let lasted = end.floor_left.expect("left") - end.floor_touched.expect("touched");
            assert!((lasted / (2.0 * half) - 1.0).abs() < 1e-10, "β {beta} {v0}");
        }
    }
}

#[test]
fn the_linear_law_as_a_power_law() {
    let law = PowerLaw::linear(0.9, 0.7e-5);
    for (s0, eps_eff, share) in [
        (0.0, 0.966_687, 0.033_859),
        (1e-6, 0.539_255, 0.021_337),
        (1e-5, 0.341_547, 0.016_525),
    ] {
        let (e, r) = shares(fig1(adaptive(law, 1e-12), s0));
        // The figures of the design have six digits.
        assert!(
            (e - eps_eff).abs() < 1e-6 && (r - share).abs() < 1e-6,
            "{s0}"
        );
        let exact = Method::Soft(Soft {
            law: Law::Hooke {
                contact_time: 0.7e-5,
            },
            solver: Solver::Exact,
            attraction: true,
        });
        let (exact_e, exact_r) = shares(fig1(exact, s0));
        assert!((e / exact_e - 1.0).abs() < 1e-9, "{s0}: {e} {exact_e}");
        assert!((r / exact_r - 1.0).abs() < 1e-9, "{s0}: {r} {exact_r}");
    }
}

#[test]
fn a_shaken_column_moves_as_the_exact_engine_says() {
    // Two landings; later any two right methods part.
    let until = 0.06;
    for width in [0.0, 4e-4] {
        let with = |method| Facts {
            n: 3,
            width,
            ..shaken(method, 2.0)
        };
        let linear = PowerLaw::linear(0.6, 1e-4);
        let exact = Method::Soft(Soft {
            law: Law::Hooke { contact_time: 1e-4 },
            solver: Solver::Exact,
            attraction: true,
        });
        let (ours, theirs) = (
            look(&*run(with(adaptive(linear, 1e-12)), until)),
            look(&*run(with(exact), until)),
        );
        for (a, b) in ours.reduced.iter().zip(&theirs.reduced) {
            // Errors of 1e-13 of a landing grow by the landings themselves.
            assert!((a - b).abs() < 1e-9 * 1e-3, "width {width}: {a} {b}");
        }
    }
}

/// ε_eff and E_r/E_f of Fig. 3's columns at a tolerance against a tighter one.
fn agrees_with_itself(n: usize) {
    for law in [HERTZ, HKK] {
        let (coarse, fine) = (
            shares(fig3(adaptive(law, 1e-10), n)),
            shares(fig3(adaptive(law, 1e-12), n)),
        );
        let off = |a: f64, b: f64| if a == b { 0.0 } else { (a / b - 1.0).abs() };
        assert!(
            off(coarse.0, fine.0) < 1e-9,
            "{law:?} {n}: {coarse:?} {fine:?}"
        );
        assert!(
            off(coarse.1, fine.1) < 1e-9,
            "{law:?} {n}: {coarse:?} {fine:?}"
        );
    }
}

#[test]
fn fig3_agrees_with_itself() {
    for n in [1, 2, 5, 10, 20, 50] {
        agrees_with_itself(n);
    }
}

#[test]
#[ignore = "half a minute: the longest columns of Fig. 3"]
fn fig3_agrees_with_itself_to_the_end() {
    for n in [100, 200] {
        agrees_with_itself(n);
    }
}

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
    let method = |law| {
        Method::Soft(Soft {
            law,
            solver: match law {
                Law::Hooke { .. } => Solver::Exact,
                Law::Power(_) => Solver::Adaptive { tolerance: 1e-10 },
            },
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

#[test]
fn fixed_steps_converge_to_the_adaptive_result() {
    for law in [HERTZ, HKK, TAGUCHI, FREE] {
        let converged = shares(fig3(adaptive(law, 1e-12), 5));
        for integrator in support::INTEGRATORS {
            for attraction in [true, false] {
                let with = |solver| {
                    let method = Method::Soft(Soft {
                        law: Law::Power(law),
                        solver,
                        attraction,
                    });
                    shares(fig3(method, 5))
                };
                let truth = if attraction {
                    converged
                } else {
                    with(Solver::Adaptive { tolerance: 1e-12 })
                };
                let error = |steps_per_contact| {
                    let (e, r) = with(Solver::Grid(GridSettings {
                        integrator,
                        steps_per_contact,
                    }));
                    (e - truth.0).abs().max((r - truth.1).abs())
                };
                // First order at worst: the dashpot of Hertz's law sets in with a jump.
                let (coarse, fine) = (error(100.0), error(6400.0));
                assert!(coarse < 2e-2, "{law:?} {integrator:?}: {coarse:e}");
                assert!(fine < 2e-4, "{law:?} {integrator:?}: {fine:e}");
                assert!(
                    fine < 0.2 * coarse,
                    "{law:?} {integrator:?}: {fine:e} {coarse:e}"
                );
            }
        }
    }
}
