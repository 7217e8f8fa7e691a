//! What must hold for every engine, whatever the scene: the energy ledger, exact
//! conservation at ε = 1, the laws of single contacts, rest.

use crate::scenes::{
    ED, G, INTEGRATORS, collide, engine, fig1, hard_scenes, look, md, rebound, run, shaken, soft,
};
use beadlab::scene::{
    Facts, Floor, FloorContact, GridSettings, Integrator, Launch, Law, Method, Soft, Solver, Start,
};

#[test]
fn the_ledger_of_hard_spheres_closes() {
    for (name, facts) in hard_scenes() {
        let drift = look(&*run(facts, 1.0)).energy.drift;
        // Exact flights leave only rounding.
        assert!(drift.abs() < 1e-12, "{name}: {drift:.1e}");
    }
}

#[test]
fn the_ledger_of_fixed_steps_closes_in_first_order() {
    for integrator in INTEGRATORS {
        let drifts: Vec<f64> = [50.0, 100.0, 200.0, 400.0, 800.0, 1600.0]
            .iter()
            .map(|&steps| {
                let plate = shaken(soft(integrator, 1e-4, steps), 3.0);
                look(&*run(plate, 0.25)).energy.drift.abs()
            })
            .collect();
        println!("{integrator:?}: {drifts:?}");
        // Unevenly, since contact changes fall between steps: over five halvings the
        // drift must fall by 32 in proportion; half of that is asked for.
        assert!(
            drifts[0] < 0.2 && drifts[5] < drifts[0] / 16.0,
            "{integrator:?}: {drifts:?}"
        );
    }
}

#[test]
fn the_error_of_fixed_steps_falls_with_the_step() {
    // Converged values; s₀ = 1e-6 m lies between the limits.
    for (s0, truth) in [(0.0, 0.966_687), (1e-6, 0.539_255), (1e-5, 0.341_547)] {
        for integrator in INTEGRATORS {
            let error = |steps: f64| (rebound(fig1(md(integrator, steps), s0)).0 - truth).abs();
            // Means over neighbouring ladders, since a single step hits a contact change
            // by luck; first order asks for a factor of 20.
            let mean = |steps: [f64; 4]| steps.map(error).iter().sum::<f64>() / 4.0;
            let (coarse, fine) = (
                mean([50.0, 57.0, 64.0, 71.0]),
                mean([1000.0, 1140.0, 1280.0, 1420.0]),
            );
            assert!(
                fine < coarse / 5.0 && fine > coarse / 500.0,
                "{integrator:?} {s0}: {coarse:.1e} {fine:.1e}"
            );
        }
    }
}

#[test]
fn elastic_beads_conserve_energy() {
    for s0 in [0.0, 1e-6, 1e-3] {
        let (eps, _) = rebound(Facts {
            restitution: 1.0,
            ..fig1(ED, s0)
        });
        assert!((eps - 1.0).abs() < 1e-14, "ED, s0 {s0}: {eps}");
        for integrator in INTEGRATORS {
            let facts = Facts {
                restitution: 1.0,
                ..fig1(md(integrator, 400.0), s0)
            };
            let (eps, _) = rebound(facts);
            // Springs alone: the force is continuous, errors are of second order at
            // touch and release, (π/400)² of one part in N.
            assert!((eps - 1.0).abs() < 1e-5, "{integrator:?}, s0 {s0}: {eps}");
        }
    }
    let dropped = Facts {
        restitution: 1.0,
        gravity: Some(G),
        duration: Some(1.0),
        start: Start::Launched(Launch {
            s0: 1e-3,
            jitter: true,
            v0: -0.1,
        }),
        ..fig1(ED, 0.0)
    };
    let start = look(&*engine(dropped.clone())).energy;
    let end = look(&*run(dropped, 2.0)).energy;
    let change = (end.kinetic + end.potential) / (start.kinetic + start.potential) - 1.0;
    assert!(change.abs() < 1e-12, "{change}");
}

#[test]
fn one_bead_rebounds_as_its_law_says() {
    for restitution in [0.05, 0.6, 0.9] {
        for floor_contact in [FloorContact::SameSpring, FloorContact::SameRestitution] {
            let facts = |method| Facts {
                n: 1,
                restitution,
                floor_contact,
                ..fig1(method, 1e-6)
            };
            let law = beadlab::physics::LinearLaw::new(restitution, 0.7e-5);
            let expected = match floor_contact {
                FloorContact::SameSpring => law.floor_restitution(),
                FloorContact::SameRestitution => restitution,
            };
            assert!((rebound(facts(ED)).0 - expected).abs() < 1e-15);
            for integrator in INTEGRATORS {
                let (eps, _) = rebound(facts(md(integrator, 2000.0)));
                // First order at touch and release: 2 steps of 2000 at most.
                assert!(
                    (eps - expected).abs() < 2e-3,
                    "{integrator:?} ε {restitution}: {eps} {expected}"
                );
            }
        }
    }
}

#[test]
fn a_soft_bead_stays_in_contact_for_its_contact_time() {
    // Same-restitution floor: t_c by construction, Eq. (6).
    let facts = |method| Facts {
        n: 1,
        floor_contact: FloorContact::SameRestitution,
        ..fig1(method, 1e-6)
    };
    for integrator in INTEGRATORS {
        let (_, end) = collide(facts(md(integrator, 1000.0)));
        let duration = end
            .floor_left
            .zip(end.floor_touched)
            .map(|(last, first)| last - first);
        // A step at either end.
        assert!(
            (duration.expect("one contact") / 0.7e-5 - 1.0).abs() < 2.1e-3,
            "{integrator:?}: {duration:?}"
        );
    }
}

#[test]
fn cutting_the_attraction_off_raises_the_rebound() {
    // 0.3415 becomes 0.3500 at σ = 7 (four digits; this converges to 0.35014).
    let method = Method::Soft(Soft {
        law: Law::Hooke {
            contact_time: 0.7e-5,
        },
        solver: Solver::Grid(GridSettings {
            integrator: Integrator::Verlet,
            steps_per_contact: 2000.0,
        }),
        attraction: false,
    });
    let (eps, _) = rebound(fig1(method, 1e-5));
    assert!((eps - 0.3500).abs() < 2e-4, "{eps}");
}

#[test]
fn a_resting_soft_column_stays_at_rest() {
    for integrator in INTEGRATORS {
        let facts = Facts {
            floor: Floor::Fixed,
            ..shaken(soft(integrator, 1e-3, 50.0), 2.0)
        };
        let start = look(&*engine(facts.clone()));
        let end = look(&*run(facts, 0.5));
        for (a, b) in start.reduced.iter().zip(&end.reduced) {
            // Static equilibrium up to rounding of overlaps of some µm.
            assert!((a - b).abs() < 1e-17, "{integrator:?}: {a} {b}");
        }
        assert!(start.reduced[0] < 0.0, "the load compresses the contacts");
    }
}

#[test]
fn below_alpha_1_soft_beads_never_leave_the_plate() {
    for integrator in INTEGRATORS {
        let mut engine = engine(shaken(soft(integrator, 1e-4, 50.0), 0.9));
        for k in 1..400 {
            engine
                .advance(f64::from(k) * 1e-3, u64::MAX)
                .expect("a sound run");
            let seen = look(&*engine);
            assert!(
                seen.contacts.iter().all(|&closed| closed),
                "{integrator:?} at {}",
                seen.time
            );
        }
    }
}

#[test]
fn one_two_and_a_thousand_beads_run() {
    for n in [1, 2, 1000] {
        for s0 in [0.0, 1e-6] {
            let (_, end) = collide(Facts { n, ..fig1(ED, s0) });
            assert!(end.energy.kinetic.is_finite() && end.reduced.len() == n);
        }
        let (eps, _) = rebound(Facts {
            n,
            ..fig1(md(Integrator::Verlet, 20.0), 0.0)
        });
        assert!(eps > 0.8 && eps < 1.0, "N {n}: {eps}");
        for method in [ED, soft(Integrator::Gear, 1e-4, 20.0)] {
            let seen = look(&*run(
                Facts {
                    n,
                    ..shaken(method, 2.0)
                },
                0.1,
            ));
            assert!(
                seen.centre.is_finite() && seen.energy.drift.abs() < 0.1,
                "N {n}: {:?}",
                seen.energy
            );
        }
    }
}

#[test]
fn too_few_steps_are_reported_not_shown() {
    let facts = Facts {
        n: 50,
        ..shaken(soft(Integrator::Verlet, 1e-4, 2.0), 2.0)
    };
    let mut engine = engine(facts);
    let error = engine
        .advance(10.0, u64::MAX)
        .expect_err("two steps in a contact blow up");
    assert!(error.to_string().contains("unstable"), "{error}");
}

#[test]
fn soft_and_hard_agree_where_sigma_is_large() {
    // σ₀ = 1e3: every contact is a pair's own, t_c apart from all others.
    let facts = |method| Facts {
        start: Start::Launched(Launch {
            s0: 1.4e-3,
            jitter: true,
            v0: -0.2,
        }),
        ..fig1(method, 0.0)
    };
    let hard = rebound(facts(ED)).0;
    let soft = rebound(facts(md(Integrator::Gear, 500.0))).0;
    assert!((hard - soft).abs() < 1e-3, "{hard} {soft}");
}

#[test]
fn overdamped_pairs_do_not_keep_a_collision_from_ending() {
    // Heavy pairs share K and D_n with the mean one and creep together for ever.
    let facts = Facts {
        restitution: 0.01,
        width: 5e-4,
        ..fig1(md(Integrator::Gear, 200.0), 1e-6)
    };
    let (_, end) = collide(facts);
    assert!(
        end.contacts.iter().any(|&closed| closed),
        "the case is here for these"
    );
    assert!(end.energy.elastic <= 1e-12 * end.energy.kinetic);
}

#[test]
fn a_column_that_is_put_down_gently_is_no_failure() {
    // It has no energy at all at first, against which to measure an error.
    let start = Start::Launched(Launch {
        s0: 0.0,
        jitter: false,
        v0: 0.0,
    });
    let facts = Facts {
        start,
        gravity: Some(G),
        duration: Some(1.0),
        ..fig1(soft(Integrator::Gear, 1e-4, 100.0), 0.0)
    };
    // It settles into its overlaps: ten beads no faster than g N t_c.
    let most = 10.0 * 0.5 * (G * 10.0 * 1e-4_f64).powi(2);
    assert!(look(&*run(facts, 0.1)).energy.kinetic < most);
}
