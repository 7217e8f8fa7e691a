//! The simulation thread, seen through its channels.

use std::cell::RefCell;
use std::time::Duration;

use crate::play::{Fault, MEMORY, faulty, load, real, sweep, twins, until};
use beadlab::live::{self, Frame, Leap, Order, Status, Way};
use beadlab::study::vary;

#[test]
fn no_order_is_lost() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("shaken"), sweep(0.3, false), 0.05, true);
    for k in 0..2000 {
        let order = if k % 2 == 0 {
            Order::Run(false)
        } else {
            Order::Speed(0.05)
        };
        live.orders
            .send(order)
            .expect("the simulation thread listens");
    }
    let frame = until(&live, |frame| frame.orders == 2001);
    assert!(frame.paused);
}

#[test]
fn paused_means_silent() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("shaken"), sweep(0.3, false), 0.05, false);
    let frame = until(&live, |frame| frame.orders == 1);
    assert!(frame.paused && frame.time == 0.0);
    assert!(
        live.frames
            .recv_timeout(Duration::from_millis(300))
            .is_err()
    );
}

#[test]
fn a_step_goes_so_far_and_no_further() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("shaken"), sweep(0.3, false), 0.05, false);
    live.orders
        .send(Order::Leap(Leap::By(0.0123)))
        .expect("the simulation thread listens");
    let frame = until(&live, |frame| {
        frame.time > 0.0 && frame.paused && frame.time >= 0.0123
    });
    assert_eq!(frame.time.to_bits(), 0.0123f64.to_bits());
    // The soft column stops at its last step before, the hard one there.
    let times: Vec<f64> = frame.sides.iter().map(|side| side.seen.time).collect();
    assert!(times[0] <= 0.0123 && times[0] > 0.0123 - 1e-6);
    assert_eq!(times[1].to_bits(), 0.0123f64.to_bits());
    assert!(
        live.frames
            .recv_timeout(Duration::from_millis(200))
            .is_err()
    );
}

#[test]
fn events_are_met_one_after_the_other() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("fig1b"), sweep(3e-4, true), 1e-5, false);
    let mut events = Vec::new();
    for k in 0..5 {
        live.orders
            .send(Order::Leap(Leap::Change(Way::On)))
            .expect("the simulation thread listens");
        let frame = until(&live, |frame| {
            frame.orders == 2 + k && frame.towards.is_none()
        });
        // Contacts of the soft column and collisions of the hard one.
        let changes: u64 = frame.sides.iter().map(|side| side.seen.changes).sum();
        events.push((frame.time, changes));
    }
    let later = |pair: &[(f64, u64)]| pair[0].0 < pair[1].0 && pair[0].1 < pair[1].1;
    assert!(events.windows(2).all(later), "{events:?}");
}

#[test]
fn a_screen_that_looks_away_misses_nothing_that_it_could_show() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("shaken"), sweep(0.3, false), 0.2, true);
    until(&live, |frame| frame.time > 0.0);
    std::thread::sleep(Duration::from_millis(700));
    let frame = live.frames.recv().expect("a frame waits");
    let times: Vec<f64> = frame.history.iter().map(|sample| sample.time).collect();
    assert!(
        times.len() > 10 && times.len() <= 60,
        "{} samples",
        times.len()
    );
    let interval = 0.3 / 60.0;
    for pair in times.windows(2) {
        assert!((pair[1] - pair[0] - interval).abs() < 1e-9, "{times:?}");
    }
    assert!(frame.time - times[times.len() - 1] <= interval * 1.001);
}

#[test]
fn a_full_page_is_held() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    load(&live, twins("fig1a"), sweep(2e-4, true), 1e-3, true);
    let frame = until(&live, |frame| frame.held);
    assert!(frame.paused && frame.time < 2e-4);
    assert!(frame.sides.iter().all(|side| side.status == Status::Over));
    live.orders
        .send(Order::Run(true))
        .expect("the simulation thread listens");
    until(&live, |frame| frame.time > 2e-4);
}

#[test]
fn edits_go_on_and_change_what_moves() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    let scenes = twins("shaken");
    load(&live, scenes.clone(), sweep(0.3, false), 0.1, true);
    let before = until(&live, |frame| frame.time > 0.02);
    let value = beadlab::scene::parameters::Value::Number(0.9);
    let edited = scenes
        .iter()
        .map(|scene| vary(scene, None, &[("restitution", value)]).expect("0.9 is allowed"))
        .collect();
    live.orders
        .send(Order::Edit {
            scenes: edited,
            from: vec![0, 1],
        })
        .expect("the simulation thread listens");
    let after = until(&live, |frame| frame.orders == 2);
    assert!(after.time >= before.time && after.time < before.time + 0.1);
    // The other way round: the hard column takes the soft one's place, and says so.
    let swapped = vec![scenes[1].clone()];
    live.orders
        .send(Order::Edit {
            scenes: swapped,
            from: vec![0],
        })
        .expect("the simulation thread listens");
    let single = until(&live, |frame| frame.orders == 3);
    assert_eq!(single.sides.len(), 1);
}

#[test]
fn both_columns_stand_on_one_plate_after_edits_of_it() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    let scenes = twins("shaken");
    load(&live, scenes.clone(), sweep(0.3, false), 0.1, true);
    let shake = scenes[0].shake().expect("the columns are shaken");
    let (frequency, own) = (shake.frequency, shake.amplitude);
    let mut time = 0.0;
    for (k, factor) in [3.0, 0.2, 1.5, 1.0].into_iter().enumerate() {
        until(&live, |frame| frame.time > time + 0.043);
        let value = beadlab::scene::parameters::Value::Number(factor * own);
        let edited = scenes
            .iter()
            .map(|scene| vary(scene, None, &[("amplitude", value)]).expect("an allowed amplitude"));
        let order = Order::Edit {
            scenes: edited.collect(),
            from: vec![0, 1],
        };
        live.orders
            .send(order)
            .expect("the simulation thread listens");
        let orders = u64::try_from(k).expect("a few") + 2;
        let frame = until(&live, |frame| frame.orders == orders);
        let told = frame
            .notes
            .iter()
            .any(|note| note.contains("passes its middle"));
        // The last one may take back what has not begun.
        assert!(
            told || factor == 1.0,
            "when it acts is told: {:?}",
            frame.notes
        );
        time = frame.time;
        assert_one_plate(&frame);
    }
    // A passage that was under way is ended, and the next one begins a period later.
    live.orders
        .send(Order::Leap(Leap::By(6.0 / frequency)))
        .expect("the simulation thread listens");
    let goal = time + 6.0 / frequency;
    let frame = until(&live, |frame| frame.paused && frame.time >= goal);
    assert_one_plate(&frame);
    for side in &frame.sides {
        let formula = own * (std::f64::consts::TAU * frequency * side.seen.time).sin();
        assert!((side.seen.floor - formula).abs() < 1e-14);
    }
}

/// The soft column is seen at its last step: the plate has moved on by a little since.
fn assert_one_plate(frame: &Frame) {
    let [soft, hard] = &frame.sides[..] else {
        panic!("two columns");
    };
    let (dt, moved) = (
        hard.seen.time - soft.seen.time,
        hard.seen.floor - soft.seen.floor,
    );
    // The plate never accelerates faster than 10 g.
    let gained = 98.1 * dt;
    assert!((moved - hard.seen.floor_velocity * dt).abs() <= gained * dt.abs() + 1e-14);
    assert!((hard.seen.floor_velocity - soft.seen.floor_velocity).abs() <= gained.abs() + 1e-12);
}

#[test]
fn one_engine_may_fail_and_the_other_goes_on() {
    for fault in [Fault::Panics, Fault::Errs] {
        let live = live::spawn(faulty(fault, 0.01), MEMORY).expect("threads are to be had");
        load(&live, twins("shaken"), sweep(0.3, false), 0.1, true);
        let frame = until(&live, |frame| !frame.notes.is_empty());
        assert!(
            frame.notes[0].starts_with("MD stopped: "),
            "{:?}",
            frame.notes
        );
        let samples = RefCell::new(Vec::new());
        let later = until(&live, |frame| {
            let of_soft = frame
                .history
                .iter()
                .map(|sample| (sample.time, sample.rows[0].is_some()));
            samples.borrow_mut().extend(of_soft);
            frame.time > 0.03
        });
        assert!(matches!(&later.sides[0].status, Status::Failed(_)));
        assert_eq!(later.sides[1].status, Status::Running);
        let samples = samples.into_inner();
        assert!(samples.iter().any(|(time, _)| *time > 0.02), "{samples:?}");
        let is_right = |(time, soft): &(f64, bool)| *time < 0.009 || !soft;
        assert!(samples.iter().all(is_right), "{samples:?}");
    }
}

#[test]
fn speed_is_kept_and_measured() {
    let live = live::spawn(real(), MEMORY).expect("threads are to be had");
    let hard = vec![twins("shaken").remove(1)];
    load(&live, hard, sweep(0.3, false), 0.2, true);
    // Other programs may hold this one up for a while, but not for ever.
    let kept = |achieved: f64| (achieved / 0.2 - 1.0).abs() < 0.15;
    until(&live, |frame| frame.achieved.is_some_and(kept));
}
