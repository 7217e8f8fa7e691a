//! Random scenes of hard spheres: whatever comes, every state is one that can be, and
//! the ledger closes.

use std::f64::consts::PI;

use crate::dice::Dice;
use crate::scenes::{ED, G, fig1, look, shaken};
use beadlab::physics::build;
use beadlab::scene::{
    Facts, Floor, FloorContact, GridSettings, Integrator, Launch, Law, Method, Scene, Shake, Soft,
    Solver, Start, angular,
};

/// Hard beads of any kind of scene.
pub fn hard_beads(dice: &mut Dice) -> Facts {
    let gravity = dice.chance(0.7).then_some(G);
    let (frequency, alpha) = (dice.decades(0.0, 3.0), dice.decades(-1.0, 3.0));
    let floor = if gravity.is_some() && dice.chance(0.8) {
        Floor::Vibrating(Shake {
            amplitude: alpha * G / angular(frequency).powi(2),
            frequency,
        })
    } else {
        Floor::Fixed
    };
    let start = if gravity.is_some() && dice.chance(0.4) {
        Start::Resting
    } else {
        let s0 = if dice.chance(0.2) {
            0.0
        } else {
            dice.decades(-12.0, -1.0)
        };
        Start::Launched(Launch {
            s0,
            jitter: dice.chance(0.5),
            v0: -dice.decades(-4.0, 0.0),
        })
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "1 to 20"
    )]
    let n = 1 + (20.0 * dice.roll()) as usize;
    let restitution = if dice.chance(0.1) { 0.0 } else { dice.roll() };
    let floor_contact = if dice.chance(0.5) {
        FloorContact::SameSpring
    } else {
        FloorContact::SameRestitution
    };
    let width = if dice.chance(0.3) {
        5e-4 * dice.roll()
    } else {
        0.0
    };
    let duration = gravity.map(|_| 1.0);
    Facts {
        n,
        restitution,
        floor_contact,
        width,
        start,
        gravity,
        floor,
        duration,
        ..fig1(ED, 0.0)
    }
}

#[test]
fn every_state_is_one_that_can_be() {
    let mut dice = Dice(1);
    for k in 0..200 {
        let facts = hard_beads(&mut dice);
        let scene = Scene::new(facts.clone()).expect("a valid scene");
        let (mut engine, _) = build(&scene, None);
        let until = match scene.period() {
            Some(period) => 10.0 * period,
            None => 1.0,
        };
        engine.advance(until, 500_000).expect("a sound run");
        let seen = look(&*engine);
        let drift = seen.energy.drift;
        // Rounding of up to half a million collisions, in energies that may be a
        // millionth of what there was.
        assert!(
            drift.abs() < 1e-10,
            "scene {k}: drift {drift:.1e} at {}: {facts:?}",
            seen.time
        );
        // A gap may be negative by a rounding of its last flight's length.
        assert!(
            seen.gaps.iter().all(|g| *g > -1e-13),
            "scene {k}: {:?}: {facts:?}",
            seen.gaps
        );
        let velocities = seen.velocities.iter().all(|v| v.is_finite());
        assert!(
            velocities && seen.energy.relative >= 0.0,
            "scene {k}: {facts:?}"
        );
    }
}

#[test]
fn edits_in_any_order_keep_the_column_whole() {
    let mut dice = Dice(2);
    for k in 0..40 {
        let contact_time = dice.decades(-5.0, -3.0);
        let soft = Method::Soft(Soft {
            law: Law::Hooke { contact_time },
            solver: Solver::Grid(GridSettings {
                integrator: Integrator::Verlet,
                steps_per_contact: 40.0,
            }),
            attraction: true,
        });
        let alpha = dice.decades(0.0, 1.0);
        let mut facts = shaken(soft, alpha);
        // Gravity and the plate's largest acceleration until now.
        let mut felt = G * (1.0 + alpha);
        let mut engine = crate::scenes::engine(facts.clone());
        for edit in 0..30 {
            engine
                .advance(engine.time() + 0.01 * dice.roll(), 200_000)
                .expect("a sound run");
            let before = look(&*engine);
            facts.method = if dice.chance(0.4) { ED } else { soft };
            facts.restitution = 0.05 + 0.95 * dice.roll();
            let (amplitude, frequency) = (dice.decades(-4.0, -2.0), 5.0 + 45.0 * dice.roll());
            facts.floor = Floor::Vibrating(Shake {
                amplitude,
                frequency,
            });
            let scene = Scene::new(facts.clone()).expect("a valid scene");
            engine = build(&scene, Some(&engine.state())).0;
            let after = look(&*engine);
            let felt_before = felt;
            felt = felt.max(G + amplitude * (2.0 * PI * frequency).powi(2));
            let overlaps = |gaps: &[f64]| -> f64 { gaps.iter().map(|g| g.min(0.0).abs()).sum() };
            // Hard spheres have none, and soft ones that rest on a plate have those under
            // which they carry what is above: beads move by what comes and goes, no further.
            let room = overlaps(&before.gaps) + overlaps(&after.gaps) + 1e-12;
            if overlaps(&before.gaps) == 0.0 {
                // Contact i of N carries N − i beads, by springs of π²/(2 t_c²) or stiffer.
                let most = 55.0 * felt_before * 2.0 * (contact_time / PI).powi(2);
                assert!(
                    overlaps(&after.gaps) <= most * (1.0 + 1e-9),
                    "case {k}, edit {edit}: {after:?}"
                );
            }
            assert!(
                (before.floor - after.floor).abs() < 1e-12,
                "case {k}, edit {edit}: the plate jumps"
            );
            for (a, b) in before.reduced.iter().zip(&after.reduced) {
                assert!(
                    (a - b).abs() < room,
                    "case {k}, edit {edit}: a bead jumps by {}",
                    a - b
                );
            }
            for (a, b) in before.velocities.iter().zip(&after.velocities) {
                assert!(
                    (a - b).abs() < 1e-9,
                    "case {k}, edit {edit}: a bead is kicked by {}",
                    a - b
                );
            }
            // The error stays what it is; the energy it is related to may halve, as when
            // overlaps are removed.
            let (old, new) = (before.energy.drift, after.energy.drift);
            assert!(
                new.abs() < 2.0 * old.abs() + 1e-9,
                "case {k}, edit {edit}: drift {old:.1e} {new:.1e}"
            );
        }
    }
}
