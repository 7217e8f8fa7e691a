//! Everything with everything: each law under each solver, each floor, start, arrangement and
//! attraction, as far as a scene may have them together.

use crate::scenes::{G, fig1, look};
use beadlab::physics::{Engine, Observation, Outcome, build};
use beadlab::scene::{
    Arrangement, CollisionRule, Exponents, Facts, Floor, FloorContact, GridSettings, Integrator,
    Launch, Law, Method, PowerLaw, Scene, Shake, Soft, Solver, Start, angular,
};

/// How long scenes with gravity are followed, s: a period of the plate, in which a column that
/// it throws has landed again.
const LONG: f64 = 0.02;

/// A collision without gravity is over by then, s: the way to the floor and back.
const OVER: f64 = 1e-3;

/// Names and methods: both rules of hard spheres; and all laws, under all solvers, with the
/// attraction and without.
fn methods() -> Vec<(String, Method)> {
    let power = |exponents, stiffness, damping| {
        Law::Power(PowerLaw {
            exponents,
            stiffness,
            damping,
        })
    };
    let free = Exponents::Free {
        beta: 0.8,
        gamma: 1.3,
    };
    let laws = [
        Law::Hooke { contact_time: 1e-4 },
        power(Exponents::Hertz, 2e11, 2e3),
        power(Exponents::HertzKuwabaraKono, 2e11, 1e5),
        power(Exponents::Taguchi, 2e11, 5e4),
        power(free, 2e13, 1e10),
    ];
    let grid = |integrator| {
        Solver::Grid(GridSettings {
            integrator,
            steps_per_contact: 100.0,
        })
    };
    let solvers = [
        grid(Integrator::Gear),
        grid(Integrator::Verlet),
        Solver::Exact,
        Solver::Adaptive { tolerance: 1e-10 },
    ];
    let rules = [CollisionRule::Lrv, CollisionRule::Tc { contact_time: 1e-5 }];
    let mut methods: Vec<Method> = rules.map(Method::Hard).to_vec();
    for law in laws {
        for solver in solvers {
            methods.extend([true, false].map(|attraction| {
                Method::Soft(Soft {
                    law,
                    solver,
                    attraction,
                })
            }));
        }
    }
    methods
        .into_iter()
        .map(|method| (format!("{method:?}"), method))
        .collect()
}

/// All frames: arrangement, gravity, floor and start.
fn frames(method: Method) -> Vec<Facts> {
    let (frequency, alpha) = (1.0 / LONG, 2.0);
    let plate = Floor::Vibrating(Shake {
        amplitude: alpha * G / angular(frequency).powi(2),
        frequency,
    });
    let launched = |s0, jitter| {
        Start::Launched(Launch {
            s0,
            jitter,
            v0: -0.2,
        })
    };
    let column = Facts {
        n: 3,
        restitution: 0.8,
        ..fig1(method, 0.0)
    };
    let lattice = |tangential| Facts {
        arrangement: Arrangement::Lattice {
            columns: 3,
            tangential,
        },
        n: 6,
        ..column.clone()
    };
    let unequal = Facts {
        width: 5e-4,
        floor_contact: FloorContact::SameRestitution,
        ..column.clone()
    };
    let mut frames = Vec::new();
    for arranged in [column.clone(), unequal, lattice(0.0), lattice(1e3)] {
        for gravity in [None, Some(G)] {
            for floor in [Floor::Fixed, plate] {
                for start in [Start::Resting, launched(0.0, false), launched(2e-5, true)] {
                    frames.push(Facts {
                        gravity,
                        floor,
                        start,
                        duration: gravity.map(|_| LONG),
                        ..arranged.clone()
                    });
                }
            }
        }
    }
    frames
}

/// How far the books of a run of so few contacts may be off.
fn promised(method: Method) -> f64 {
    match method {
        // Rounding.
        Method::Hard(_) => 1e-12,
        Method::Soft(soft) => match soft.solver {
            Solver::Exact => 1e-11,
            // Some hundred steps.
            Solver::Adaptive { tolerance } => 100.0 * tolerance,
            // First order, since contacts begin between two steps.
            Solver::Grid(grid) => 5.0 / grid.steps_per_contact,
        },
    }
}

/// Runs to `until` at once.
fn whole(scene: &Scene, until: f64) -> Box<dyn Engine> {
    let mut engine = build(scene, None).0;
    engine.advance(until, u64::MAX).expect("a sound run");
    engine
}

/// Runs to `until` in stretches that no step or event divides, few steps at a time.
fn in_pieces(scene: &Scene, until: f64) -> Box<dyn Engine> {
    let mut engine = build(scene, None).0;
    for part in [0.013_7, 0.113, 0.271_8, 0.577_2, 0.901, 1.0] {
        while engine.advance(part * until, 97).expect("a sound run") == Outcome::OutOfBudget {}
    }
    engine
}

/// Whether nothing is anything but a number.
fn is_in_numbers(seen: &Observation) -> bool {
    let energy = [
        seen.energy.kinetic,
        seen.energy.relative,
        seen.energy.potential,
        seen.energy.elastic,
        seen.energy.lost,
        seen.energy.plate_work,
        seen.energy.drift,
    ];
    let places = [seen.time, seen.floor, seen.centre, seen.centre_velocity];
    let lists = [&seen.reduced, &seen.velocities, &seen.gaps].map(Vec::as_slice);
    let mut all = lists.into_iter().chain([&energy[..], &places[..]]);
    all.all(|list| list.iter().all(|x| x.is_finite()))
}

/// Whether beads meet: all but those that lie on a floor that does not move.
fn has_contacts_to_come(scene: &Scene) -> bool {
    (scene.floor, scene.start) != (Floor::Fixed, Start::Resting)
}

/// What is wrong with a column as it is seen at the end: its books do not close, or beads are
/// where none can be.
fn wrong(scene: &Scene, seen: &Observation) -> Vec<String> {
    let mut wrong = Vec::new();
    let mut check = |is_so: bool, what: &str, x: f64| {
        if !is_so {
            wrong.push(format!("{what}: {x:e}"));
        }
    };
    check(is_in_numbers(seen), "no number", f64::NAN);
    check(
        seen.reduced.len() == scene.n,
        "beads",
        seen.reduced.len() as f64,
    );
    let drift = seen.energy.drift;
    check(drift.abs() <= promised(scene.method), "drift", drift);
    let (lost, least) = (seen.energy.lost, 1e-12);
    let has_met = lost > least && seen.steps + seen.events > 0;
    let is_as_expected = if has_contacts_to_come(scene) {
        has_met
    } else {
        lost.abs() < least
    };
    check(is_as_expected, "lost", lost);
    // Hard beads overlap by rounding; soft ones by some part of a diameter.
    let most = if scene.is_md() {
        0.05 * scene.diameter
    } else {
        1e-13
    };
    let smallest = seen.gaps.iter().copied().fold(f64::INFINITY, f64::min);
    check(smallest >= -most, "gap", smallest);
    check(seen.deepest <= most, "deepest", seen.deepest);
    let top = seen.reduced.iter().copied().fold(f64::MIN, f64::max);
    let room = scene.layers() as f64 * most;
    let between = seen.floor - room..=top + room;
    check(between.contains(&seen.centre), "centre", seen.centre);
    wrong
}

#[test]
fn everything_that_a_scene_allows_runs() {
    let (mut allowed, mut refused, mut failed) = (0, 0, Vec::new());
    for (name, method) in methods() {
        for facts in frames(method) {
            let Ok(scene) = Scene::new(facts.clone()) else {
                refused += 1;
                continue;
            };
            allowed += 1;
            let until = if facts.gravity.is_some() { LONG } else { OVER };
            let engine = whole(&scene, until);
            let seen = look(&*engine);
            let mut wrong = wrong(&scene, &seen);
            for (how, again) in [
                ("again", whole(&scene, until)),
                ("in pieces", in_pieces(&scene, until)),
            ] {
                if look(&*again) != seen || again.state() != engine.state() {
                    wrong.push(format!("other bits {how}"));
                }
            }
            if !wrong.is_empty() {
                failed.push(format!(
                    "{wrong:?}: {name}, {:?}, width {}, gravity {:?}, {:?}, {:?}",
                    facts.arrangement, facts.width, facts.gravity, facts.floor, facts.start
                ));
            }
        }
    }
    assert!(
        failed.is_empty(),
        "{}:\n{}",
        failed.len(),
        failed.join("\n")
    );
    // Of 42 methods in 48 frames. A column has 2 hard methods, 6 linear ones and 24 under power
    // laws, in 8 frames: plates and rest need gravity. A lattice has the grids' 20, without
    // gravity, a plate or rest: 2 frames. Of each there are two.
    assert_eq!((allowed, refused), (2 * (32 * 8 + 20 * 2), 2016 - 592));
}
