//! Power laws, Eq. (8): the adaptive engine against closed forms, quadrature, the linear
//! engines and itself.

use crate::scenes::{INTEGRATORS, collide, fig1, look, run, shaken};
use beadlab::physics::floor_restitution;
use beadlab::scene::{
    Exponents, Facts, FloorContact, GridSettings, Launch, Law, Method, PowerLaw, Scene, Soft,
    Solver, Start, rebound,
};

pub const HERTZ: PowerLaw = PowerLaw {
    exponents: Exponents::Hertz,
    stiffness: 2e12,
    damping: 2e3,
};
pub const HKK: PowerLaw = PowerLaw {
    exponents: Exponents::HertzKuwabaraKono,
    stiffness: 2e12,
    damping: 1e5,
};
pub const TAGUCHI: PowerLaw = PowerLaw {
    exponents: Exponents::Taguchi,
    stiffness: 2e12,
    damping: 5e4,
};
pub const FREE: PowerLaw = PowerLaw {
    exponents: Exponents::Free {
        beta: 0.8,
        gamma: 1.3,
    },
    stiffness: 2e14,
    damping: 1e11,
};

pub fn adaptive(law: PowerLaw, tolerance: f64) -> Method {
    Method::Soft(Soft {
        law: Law::Power(law),
        solver: Solver::Adaptive { tolerance },
        attraction: true,
    })
}

/// The column of Fig. 3.
pub fn fig3(method: Method, n: usize) -> Facts {
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
    crate::scenes::rebound(facts)
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
        // The expected figures have six digits.
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

#[test]
fn fixed_steps_converge_to_the_adaptive_result() {
    for law in [HERTZ, HKK, TAGUCHI, FREE] {
        let converged = shares(fig3(adaptive(law, 1e-12), 5));
        for integrator in INTEGRATORS {
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
