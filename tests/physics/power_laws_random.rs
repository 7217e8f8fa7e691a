//! Random scenes under power laws: whatever comes, none hangs, and the ledger closes.

use crate::dice::Dice;
use crate::scenes::{G, fig1, look};
use beadlab::physics::build;
use beadlab::scene::{
    Exponents, Facts, Floor, Launch, Law, Method, PowerLaw, Scene, Shake, Soft, Solver, Start,
};

/// A scene of any kind, with contacts of any shape.
fn any(seed: u64) -> Facts {
    let mut dice = Dice(seed.wrapping_mul(0x9E37_79B9_7F4A_7C15));
    dice.roll();
    let exponents = Exponents::Free {
        beta: 3.0 * dice.roll(),
        gamma: if dice.roll() < 0.3 {
            0.0
        } else {
            3.0 * dice.roll()
        },
    };
    let speed = dice.decades(-6.0, 1.0);
    let linear = PowerLaw::linear(dice.decades(-1.5, 0.0), dice.decades(-8.0, -3.0));
    let law = linear.like(exponents, speed);
    let method = Method::Soft(Soft {
        law: Law::Power(law),
        solver: Solver::Adaptive { tolerance: 1e-8 },
        attraction: dice.roll() < 0.5,
    });
    let contact_time = law.contact_time(speed);
    let n = [1, 2, 3, 4, 5, 6, 7, 8]
        .into_iter()
        .find(|&n| dice.roll() < 0.2 || n == 8)
        .unwrap_or(8);
    let launched = Facts {
        n,
        width: if dice.roll() < 0.5 {
            0.0
        } else {
            1.8e-3 * dice.roll()
        },
        start: Start::Launched(Launch {
            s0: if dice.roll() < 0.3 {
                0.0
            } else {
                speed * contact_time * dice.decades(-3.0, 2.0)
            },
            jitter: dice.roll() < 0.3,
            v0: -speed,
        }),
        ..fig1(method, 0.0)
    };
    match dice.roll() {
        r if r < 0.5 => launched,
        r => Facts {
            start: if r < 0.7 {
                Start::Resting
            } else {
                launched.start
            },
            gravity: Some(G),
            floor: Floor::Vibrating(Shake {
                amplitude: speed / 100.0,
                frequency: 100.0 / std::f64::consts::TAU,
            }),
            duration: Some(1.0),
            ..launched
        },
    }
}

#[test]
fn no_scene_hangs_or_leaves_physics() {
    let mut run = 0;
    for seed in 0..120 {
        let facts = any(seed);
        let Ok(scene) = Scene::new(facts) else {
            continue;
        };
        let contact_time = scene.contact_time().expect("soft");
        let (mut engine, _) = build(&scene, None);
        let start = look(&*engine);
        let outcome = engine.advance(300.0 * contact_time, 20_000);
        assert!(outcome.is_ok(), "seed {seed}: {outcome:?} {scene:?}");
        let end = look(&*engine);
        assert!(end.gaps.iter().all(|g| g.is_finite()), "seed {seed}");
        // Steps of 1e-8, thousands of them.
        assert!(
            end.energy.drift.abs() < 1e-6,
            "seed {seed}: {:e} {scene:?}",
            end.energy.drift
        );
        assert!(end.time > start.time, "seed {seed}");
        run += 1;
    }
    assert!(run > 100, "{run} of 120 are scenes");
}
