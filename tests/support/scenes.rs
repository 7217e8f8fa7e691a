//! Scenes and runs that several tests share.
#![allow(dead_code, reason = "every room uses its own part of this")]

use beadlab::physics::{Engine, Observation, Outcome, build};
use beadlab::scene::{
    Arrangement, CollisionRule, Facts, Floor, FloorContact, GridSettings, Integrator, Launch, Law,
    Method, Scene, Shake, Soft, Solver, Start, angular,
};

/// g of all presets, m/s².
pub const G: f64 = 9.81;

/// The floor collision of Fig. 1: N = 10, ε = 0.9, v₀ = −0.2 m/s, no gravity.
pub fn fig1(method: Method, s0: f64) -> Facts {
    Facts {
        arrangement: Arrangement::Column,
        n: 10,
        diameter: 1e-3,
        width: 0.0,
        seed: 1,
        restitution: 0.9,
        floor_contact: FloorContact::SameSpring,
        start: Start::Launched(Launch {
            s0,
            jitter: false,
            v0: -0.2,
        }),
        gravity: None,
        floor: Floor::Fixed,
        method,
        duration: None,
    }
}

/// A column of N = 10 beads, ε = 0.6, that rests on a plate at 20 Hz.
pub fn shaken(method: Method, alpha: f64) -> Facts {
    let frequency = 20.0;
    let floor = Floor::Vibrating(Shake {
        amplitude: alpha * G / angular(frequency).powi(2),
        frequency,
    });
    Facts {
        restitution: 0.6,
        start: Start::Resting,
        gravity: Some(G),
        floor,
        duration: Some(1.0),
        ..fig1(method, 0.0)
    }
}

/// Soft contacts with the paper's t_c.
pub fn md(integrator: Integrator, steps_per_contact: f64) -> Method {
    Method::Soft(Soft {
        law: Law::Hooke {
            contact_time: 0.7e-5,
        },
        solver: Solver::Grid(GridSettings {
            integrator,
            steps_per_contact,
        }),
        attraction: true,
    })
}

/// Hard spheres.
pub const ED: Method = Method::Hard(CollisionRule::Lrv);

/// The engine of these facts, at their start.
pub fn engine(facts: Facts) -> Box<dyn Engine> {
    build(&Scene::new(facts).expect("a valid scene"), None).0
}

/// What is seen of an engine now.
pub fn look(engine: &dyn Engine) -> Observation {
    let mut seen = Observation::default();
    engine.observe(&mut seen);
    seen
}

/// Runs a floor collision to its end; start and end.
pub fn collide(facts: Facts) -> (Observation, Observation) {
    let mut engine = engine(facts);
    let start = look(&*engine);
    let mut until = 1e-3;
    while engine.advance(until, u64::MAX).expect("a sound run") != Outcome::Over {
        until *= 2.0;
        assert!(until < 1e9, "the collision never ends");
    }
    (start, look(&*engine))
}

/// ε_eff and E_r/E_f of a floor collision.
pub fn rebound(facts: Facts) -> (f64, f64) {
    let (start, end) = collide(facts);
    let (first, last) = (start.energy, end.energy);
    (
        (last.kinetic / first.kinetic).sqrt(),
        last.relative / last.kinetic,
    )
}

/// Both fixed-step integrators.
pub const INTEGRATORS: [Integrator; 2] = [Integrator::Gear, Integrator::Verlet];

/// Soft contacts.
pub fn soft(integrator: Integrator, contact_time: f64, steps_per_contact: f64) -> Method {
    Method::Soft(Soft {
        law: Law::Hooke { contact_time },
        solver: Solver::Grid(GridSettings {
            integrator,
            steps_per_contact,
        }),
        attraction: true,
    })
}

/// Soft contacts, exactly.
pub fn exact(contact_time: f64) -> Method {
    Method::Soft(Soft {
        law: Law::Hooke { contact_time },
        solver: Solver::Exact,
        attraction: true,
    })
}

/// The engine of these facts, advanced to `until`.
pub fn run(facts: Facts, until: f64) -> Box<dyn Engine> {
    let mut engine = engine(facts);
    engine.advance(until, u64::MAX).expect("a sound run");
    engine
}

/// Every kind of scene that hard spheres have.
pub fn hard_scenes() -> Vec<(&'static str, Facts)> {
    let dropped = Facts {
        gravity: Some(G),
        duration: Some(1.0),
        restitution: 0.8,
        start: Start::Launched(Launch {
            s0: 1e-3,
            jitter: true,
            v0: 0.0,
        }),
        ..fig1(ED, 0.0)
    };
    let tc = Method::Hard(CollisionRule::Tc { contact_time: 1e-5 });
    vec![
        ("floor collision", fig1(ED, 1e-6)),
        ("touching", fig1(ED, 0.0)),
        (
            "unequal beads",
            Facts {
                width: 5e-4,
                ..fig1(ED, 1e-6)
            },
        ),
        (
            "collapse",
            Facts {
                n: 60,
                restitution: 0.5,
                ..fig1(ED, 1e-5)
            },
        ),
        ("dropped", dropped.clone()),
        (
            "dropped, unequal",
            Facts {
                width: 1e-3,
                ..dropped.clone()
            },
        ),
        (
            "dropped, TC",
            Facts {
                method: tc,
                ..dropped
            },
        ),
        ("shaken", shaken(ED, 2.0)),
        (
            "shaken, unequal",
            Facts {
                width: 1e-3,
                ..shaken(ED, 2.0)
            },
        ),
        ("shaken, TC", shaken(tc, 2.0)),
        (
            "shaken hard",
            Facts {
                restitution: 0.92,
                ..shaken(ED, 20.0)
            },
        ),
        (
            "shaken to pieces",
            Facts {
                restitution: 0.97,
                ..shaken(ED, 1000.0)
            },
        ),
        (
            "elastic",
            Facts {
                restitution: 1.0,
                ..shaken(ED, 3.0)
            },
        ),
    ]
}
