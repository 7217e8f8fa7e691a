//! The run in the shadow of a soft column, seen through the channels of the simulation
//! thread. Most of these tests step a paused simulation, so that nothing depends on the
//! machine's speed.

use std::cell::RefCell;
use std::sync::Arc;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::time::Duration;

use crate::play::{Behind, Fault, MEMORY, faulty, load, preset, real, sweep, twins, until};
use beadlab::live::{self, Accuracy, Build, Distance, Frame, Leap, Live, Order, reference};
use beadlab::physics::{self, Engine, Handover, Outcome, State};
use beadlab::scene::{
    Facts, GridSettings, Integrator, Method, MethodName, Scene, Soft, Solver, parameters,
};
use beadlab::study::vary;

/// Fig. 1(b) by another solver: ten beads meet a floor within 0.2 ms.
fn fig1b(solver: Solver) -> Scene {
    let mut facts: Facts = preset("fig1b").scene.facts().clone();
    if let Method::Soft(Soft { solver: own, .. }) = &mut facts.method {
        *own = solver;
    }
    Scene::new(facts).expect("the preset allows every solver of its law")
}

fn coarse_verlet() -> Scene {
    fig1b(Solver::Grid(GridSettings {
        integrator: Integrator::Verlet,
        steps_per_contact: 20.0,
    }))
}

fn send(live: &Live, order: Order) {
    live.orders
        .send(order)
        .expect("the simulation thread listens");
}

fn follows(frame: &Frame) -> Option<(f64, Distance)> {
    match frame.sides.first()?.accuracy {
        Some(Accuracy::Follows {
            since,
            distance: Some(distance),
        }) => Some((since, distance)),
        _ => None,
    }
}

fn is_given_up(frame: &Frame) -> bool {
    matches!(frame.sides[0].accuracy, Some(Accuracy::GivenUp(_)))
}

/// Steps a paused simulation to `time`; the distance there.
fn step_to(live: &Live, from: f64, time: f64) -> Distance {
    send(live, Order::Leap(Leap::By(time - from)));
    let frame = until(live, |frame| {
        let compared = follows(frame).map(|(_, distance)| distance.time);
        frame.time >= time * (1.0 - 1e-12) && compared == Some(frame.sides[0].seen.time)
    });
    follows(&frame).expect("just seen").1
}

/// A column in the midst of its collision, paused, and a shadow that starts there.
fn in_the_midst(scene: Scene, build: Build) -> Live {
    let live = live::spawn(build, MEMORY).expect("threads are to be had");
    load(&live, vec![scene], sweep(3e-4, false), 1e-5, false);
    send(&live, Order::Leap(Leap::By(3e-5)));
    until(&live, |frame| frame.time >= 3e-5);
    send(&live, Order::Shadow(true));
    live
}

/// What comes of the real engines, and how many engines to be exact there are now and
/// were in all. They never get anywhere where they are `stuck`.
fn counted(stuck: bool) -> (Build, [Arc<AtomicUsize>; 2]) {
    let counts: [Arc<AtomicUsize>; 2] = Default::default();
    let [now, ever] = counts.clone();
    let build = move |scene: &Scene, from: Option<&State>| -> (Box<dyn Engine>, Handover) {
        let (engine, handover) = physics::build(scene, from);
        if scene.method.name() != MethodName::Exact {
            return (engine, handover);
        }
        ever.fetch_add(1, Ordering::SeqCst);
        let counted = Counted::new(&now);
        let advance = Arc::new(move |_| {
            // The engine's life is this closure's.
            let _ = &counted;
            stuck.then_some(Ok(Outcome::OutOfBudget))
        });
        (Box::new(Behind { engine, advance }), handover)
    };
    (Box::new(build), counts)
}

/// One more, as long as it lives.
struct Counted(Arc<AtomicUsize>);

impl Counted {
    fn new(count: &Arc<AtomicUsize>) -> Self {
        count.fetch_add(1, Ordering::SeqCst);
        Self(count.clone())
    }
}

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.fetch_sub(1, Ordering::SeqCst);
    }
}

#[test]
fn a_coarse_grid_strays_and_an_exact_column_does_not() {
    let live = in_the_midst(coarse_verlet(), real());
    let times = [3e-5, 5e-5, 1e-4, 2e-4, 4e-4];
    let strayed: Vec<Distance> = times
        .windows(2)
        .map(|pair| step_to(&live, pair[0], pair[1]))
        .collect();
    // Twenty steps a contact are off by (π/20)²/24 = 1e-3 of the motion, which is 1e-6 m.
    assert!(strayed[0].height > 1e-11, "{strayed:?}");
    // After the collision it is off by its velocities, and so ever more.
    assert!(strayed[3].height > 1.5 * strayed[2].height, "{strayed:?}");
    assert!(strayed[3].height < 1e-5, "{strayed:?}");
    assert!(
        strayed[3].energy > 1e-6 && strayed[3].energy < 0.1,
        "{strayed:?}"
    );
    let live = in_the_midst(fig1b(Solver::Exact), real());
    for pair in times.windows(2) {
        let distance = step_to(&live, pair[0], pair[1]);
        // Rounding of heights of 1e-4 m, 1e-20 m, and what ten contacts make of it.
        assert!(
            distance.height < 1e-17 && distance.energy < 1e-11,
            "{distance:?}"
        );
    }
}

#[test]
fn what_cannot_keep_up_is_given_up_until_it_is_asked_for_again() {
    let (build, _) = counted(true);
    let live = in_the_midst(coarse_verlet(), build);
    // Its patience is counted in turns of the loop, so no machine is too fast for it.
    send(&live, Order::Leap(Leap::By(5e-5)));
    let frame = until(&live, is_given_up);
    assert!(frame.time >= 8e-5 * (1.0 - 1e-12), "the column went on");
    // An edit does not bring it back.
    let orders = frame.orders;
    send(
        &live,
        Order::Edit {
            scenes: vec![coarse_verlet()],
            from: vec![0],
        },
    );
    assert!(is_given_up(&until(&live, |frame| frame.orders > orders)));
    send(&live, Order::Shadow(true));
    until(&live, |frame| follows(frame).is_some());
    send(&live, Order::Leap(Leap::By(5e-5)));
    until(&live, is_given_up);
}

#[test]
fn a_shadow_that_stops_says_why_and_the_column_goes_on() {
    let mut build = faulty(Fault::Errs, 6e-5);
    let mixed: Build = Box::new(move |scene, from| {
        if scene.method.name() == MethodName::Exact {
            build(scene, from)
        } else {
            physics::build(scene, from)
        }
    });
    let live = in_the_midst(coarse_verlet(), mixed);
    send(&live, Order::Leap(Leap::By(5e-5)));
    let frame = until(&live, is_given_up);
    let why = &frame.sides[0].accuracy;
    assert!(
        matches!(why, Some(Accuracy::GivenUp(why)) if why.contains("unstable")),
        "{why:?}"
    );
    assert_eq!(frame.sides[0].status, live::Status::Running);
}

#[test]
fn an_edit_starts_it_again() {
    let live = in_the_midst(coarse_verlet(), real());
    step_to(&live, 3e-5, 8e-5);
    let value = parameters::Value::Number(0.8);
    let edited = vary(&coarse_verlet(), None, &[("restitution", value)]).expect("it is allowed");
    send(
        &live,
        Order::Edit {
            scenes: vec![edited],
            from: vec![0],
        },
    );
    let frame = until(&live, |frame| !frame.notes.is_empty());
    assert!(frame.notes[0].contains("starts again"), "{:?}", frame.notes);
    let compared = follows(&frame);
    let (since, distance) = compared
        .or_else(|| follows(&until(&live, |frame| follows(frame).is_some())))
        .expect("just seen");
    // The grid's last point before 8e-5 s.
    assert!((since - 8e-5).abs() < 4e-7, "{since}");
    // The same gaps; two engines add the energies of ten beads up in their own ways.
    assert!(
        distance.height == 0.0 && distance.energy < 1e-14,
        "{distance:?}"
    );
}

#[test]
fn pause_freezes_it_and_off_is_off() {
    let (build, [now, ever]) = counted(false);
    let live = live::spawn(build, MEMORY).expect("threads are to be had");
    load(&live, twins("shaken"), sweep(0.3, false), 0.05, true);
    let frame = until(&live, |frame| frame.time > 0.01);
    assert!(frame.sides.iter().all(|side| side.accuracy.is_none()));
    assert_eq!(ever.load(Ordering::SeqCst), 0);

    send(&live, Order::Shadow(true));
    let frame = until(&live, |frame| follows(frame).is_some());
    assert!(frame.sides[1].accuracy.is_none(), "hard spheres have none");
    assert_eq!(now.load(Ordering::SeqCst), 1);
    send(&live, Order::Run(false));
    until(&live, |frame| {
        let compared = follows(frame).map(|(_, distance)| distance.time);
        frame.paused && compared == Some(frame.sides[0].seen.time)
    });
    let quiet = Duration::from_millis(300);
    assert!(live.frames.recv_timeout(quiet).is_err());

    send(&live, Order::Shadow(false));
    let frame = until(&live, |frame| frame.sides[0].accuracy.is_none());
    assert!(frame.paused);
    assert_eq!(now.load(Ordering::SeqCst), 0);
    send(&live, Order::Run(true));
    let errors = RefCell::new(Vec::new());
    until(&live, |later| {
        let rows =
            |sample: &live::Sample| sample.rows.iter().flatten().any(|row| row.error.is_some());
        let new = later
            .history
            .iter()
            .filter(|sample| sample.time > frame.time);
        errors.borrow_mut().extend(new.map(rows));
        later.time > frame.time + 0.02
    });
    let errors = errors.into_inner();
    assert!(
        !errors.is_empty() && errors.iter().all(|error| !error),
        "{errors:?}"
    );
    assert_eq!(ever.load(Ordering::SeqCst), 1);
}

#[test]
fn power_laws_are_held_against_a_tighter_tolerance() {
    let tolerance = |scene: &Scene| match scene.method {
        Method::Soft(Soft {
            solver: Solver::Adaptive { tolerance },
            ..
        }) => tolerance,
        _ => f64::NAN,
    };
    let scene = preset("fig3-hertz").scene;
    let tighter = reference(&scene).expect("there is a tighter one");
    assert!(tolerance(&tighter) <= 0.01 * tolerance(&scene));
    let grid = scene.with_method(MethodName::Gear).expect("Gear has laws");
    assert!(tolerance(&reference(&grid).expect("a grid has one")) <= 1e-12);
    // 1e-14 is the least that there is.
    let least = reference(&tighter).expect("tighter still");
    assert!(reference(&least).is_err());
    let hard = scene.with_method(MethodName::Ed).expect("it can be hard");
    assert!(reference(&hard).is_err());
}
