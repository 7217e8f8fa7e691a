//! Back in what was, and on again: the same as the first time, to the last bit.

use beadlab::live::{Frame, Leap, Order, Way};
use beadlab::physics::{self, Observation};
use beadlab::scene::parameters::Value;
use beadlab::scene::{MethodName, Scene};
use beadlab::study::vary;

use crate::play::{Act, COLOURS, MEMORY, Session, play, preset, real, sweep, twins, until};
use crossterm::event::KeyCode::{Char, End, Home};

/// A session that stands still at t = 0.
fn paused(scenes: Vec<Scene>, memory: usize) -> Session {
    Session::paused(scenes, sweep(0.2, false), memory)
}

fn leap(live: &Session, leap: Leap) -> Frame {
    live.ask(Order::Leap(leap))
}

/// What there is to see of all columns.
fn seen(frame: &Frame) -> Vec<Observation> {
    frame.sides.iter().map(|side| side.seen.clone()).collect()
}

/// The order that sets a parameter of all columns.
fn set(scenes: &mut Vec<Scene>, name: &'static str, value: f64) -> Order {
    let edited = scenes
        .iter()
        .map(|scene| vary(scene, None, &[(name, Value::Number(value))]).expect("an allowed value"));
    *scenes = edited.collect();
    Order::Edit {
        scenes: scenes.clone(),
        from: (0..scenes.len()).collect(),
    }
}

/// A session with edits of a contact, of the plate and of the method, and what was seen on the
/// way after each part of it.
fn session(live: &Session, mut scenes: Vec<Scene>) -> Vec<(f64, Vec<Scene>, Vec<Observation>)> {
    let mut way = Vec::new();
    for part in 0..8 {
        let mut frame = leap(live, Leap::By(0.0137));
        let order = match part {
            1 => Some(set(&mut scenes, "restitution", 0.7)),
            3 => Some(set(&mut scenes, "alpha", 2.6)),
            5 => {
                scenes[0] = scenes[0].with_method(MethodName::Exact).expect("it may");
                let (scenes, from) = (scenes.clone(), vec![0, 1]);
                Some(Order::Edit { scenes, from })
            }
            _ => None,
        };
        if let Some(order) = order {
            frame = live.ask(order);
        }
        way.push((frame.time, frame.scenes.clone(), seen(&frame)));
    }
    way
}

/// However it is gone to, a time shows what was seen then: the same observation to the last
/// bit, books and counters included, so there is no tolerance. With memory for a few moments
/// only most of it is simulated again.
#[test]
fn a_time_shows_what_was_seen_then() {
    for memory in [MEMORY, 1 << 18] {
        let live = paused(twins("fig5b"), memory);
        let way = session(&live, twins("fig5b"));
        let end = way.last().expect("eight parts").0;
        let mut now = end;
        for k in [6, 2, 3, 0, 5, 1, 7, 4] {
            let (time, scenes, then) = &way[k];
            // A time in between first, so that the way there is another one.
            leap(&live, Leap::By(0.4 * (time - now)));
            let frame = leap(&live, Leap::To(*time));
            assert_eq!(frame.time.to_bits(), time.to_bits());
            assert_eq!(frame.end.to_bits(), end.to_bits());
            assert_eq!(&seen(&frame), then, "at {time} s");
            assert_eq!(&frame.scenes, scenes, "at {time} s");
            now = *time;
        }
        // Through all edits to the end again.
        leap(&live, Leap::To(0.0));
        let frame = leap(&live, Leap::End);
        assert_eq!(seen(&frame), way[7].2);
        // And on, as a session that never went back.
        let on = seen(&leap(&live, Leap::By(0.02)));
        let other = paused(twins("fig5b"), MEMORY);
        session(&other, twins("fig5b"));
        assert_eq!(seen(&leap(&other, Leap::By(0.02))), on);
    }
}

#[test]
fn going_on_with_an_edit_drops_what_was_later() {
    let live = paused(twins("fig5b"), MEMORY);
    let mut scenes = twins("fig5b");
    leap(&live, Leap::By(0.03));
    live.ask(set(&mut scenes, "restitution", 0.9));
    leap(&live, Leap::By(0.03));
    let back = leap(&live, Leap::By(-0.045));
    assert!(back.end > 0.0599 && back.time < 0.0151);
    let mut scenes = twins("fig5b");
    assert_eq!(back.scenes, scenes, "the edit was not made yet");
    let forked = live.ask(set(&mut scenes, "restitution", 0.3));
    assert_eq!(forked.end.to_bits(), forked.time.to_bits());
    assert!(forked.notes.iter().any(|note| note.contains("dropped")));
    let on = leap(&live, Leap::By(0.03));
    assert_eq!(on.scenes, scenes);
    // A session that was never anywhere else.
    let other = paused(twins("fig5b"), MEMORY);
    leap(&other, Leap::To(forked.time));
    let mut scenes = twins("fig5b");
    other.ask(set(&mut scenes, "restitution", 0.3));
    assert_eq!(seen(&leap(&other, Leap::By(0.03))), seen(&on));
}

/// What a fresh engine of the scene has counted by `time`, s.
fn counted(scene: &Scene, time: f64) -> (u64, u64) {
    let mut engine = physics::build(scene, None).0;
    engine.advance(time, u64::MAX).expect("a sound run");
    let mut seen = Observation::default();
    engine.observe(&mut seen);
    (seen.changes, seen.landings)
}

/// A leap to a contact change or a landing comes to the first time at which one more of them
/// has happened: an engine that comes from the start has fewer just before, and so many then.
#[test]
fn leaps_come_to_where_it_happens() {
    for (name, method) in [
        ("fig5b", MethodName::Ed),
        ("fig5b", MethodName::Exact),
        ("fig5b", MethodName::Verlet),
        ("fig3-hertz", MethodName::Exact),
    ] {
        let scene = preset(name).scene.with_method(method).expect("it may");
        for kind in [Leap::Change, Leap::Landing] {
            let live = paused(vec![scene.clone()], MEMORY);
            let count = |time| match kind(Way::On) {
                Leap::Change(_) => counted(&scene, time).0,
                _ => counted(&scene, time).1,
            };
            let case = format!("{name} {method:?} {:?}", kind(Way::On));
            let times: Vec<f64> = (0..3).map(|_| leap(&live, kind(Way::On)).time).collect();
            let mut distinct = times.clone();
            distinct.dedup();
            // A column that touches its floor from the start has landed.
            distinct.retain(|time| *time > 0.0);
            let landed = matches!(kind(Way::On), Leap::Landing(_)) && name == "fig3-hertz";
            assert_eq!(distinct.is_empty(), landed, "{case}");
            for time in &distinct {
                assert!(count(time.next_down()) < count(*time), "{case}: {time}");
            }
            // Back over the same times, and to the start at last.
            for time in distinct.iter().rev().skip(1) {
                let frame = leap(&live, kind(Way::Back));
                assert_eq!(frame.time.to_bits(), time.to_bits(), "{case}");
            }
            assert_eq!(leap(&live, kind(Way::Back)).time, 0.0, "{case}");
        }
    }
}

/// Keys that come at once are followed one after another: an edit, and going on, act at the
/// time that was gone to, not on the way there.
#[test]
fn what_follows_at_once_acts_where_it_was_gone_to() {
    let live = paused(twins("fig5b"), MEMORY);
    leap(&live, Leap::By(0.06));
    let mut scenes = twins("fig5b");
    let edit = set(&mut scenes, "restitution", 0.9);
    live.tell(Order::Leap(Leap::To(0.0321)));
    let forked = live.ask(edit);
    assert_eq!(forked.time.to_bits(), 0.0321f64.to_bits());
    assert_eq!(forked.scenes, scenes);
    live.tell(Order::Leap(Leap::To(0.02)));
    live.tell(Order::Run(true));
    let running = until(&live.thread, |frame| !frame.paused);
    assert!(running.time >= 0.02, "{} s", running.time);
}

#[test]
fn a_period_back_and_on() {
    let scenes = twins("fig5b");
    let period = scenes[0].period().expect("a plate");
    let live = paused(scenes, MEMORY);
    let on = leap(&live, Leap::Period(Way::On));
    assert_eq!(on.time.to_bits(), period.to_bits());
    assert_eq!(leap(&live, Leap::Period(Way::Back)).time, 0.0);
    let fixed = paused(twins("fig1a"), MEMORY);
    let told = leap(&fixed, Leap::Period(Way::On));
    assert!(told.notes[0].contains("no plate"), "{:?}", told.notes);
}

/// Whether a second landing has been drawn: the time is past 0.06 s.
fn has_landed(screen: &str) -> bool {
    let time = screen.split(" t 0.").nth(1).and_then(|rest| rest.get(..3));
    time.and_then(|digits| digits.parse::<u32>().ok()) > Some(60)
}

/// All that the tape has on the screen, key by key, through the real loop.
#[test]
fn keys_go_back_and_on() {
    play(
        "fig5b",
        COLOURS,
        (80, 24),
        real(),
        vec![
            Act::Until(has_landed),
            Act::Key(Char(' ')),
            Act::See(&["‖ paused"]),
            Act::Key(Char(',')),
            Act::See(&["‖ back", "◂ back at 0.", "●", "landing"]),
            Act::Key(Home),
            Act::See(&["◂ back at 0.000 s", "drift 0.0e0"]),
            Act::Key(Char(')')),
            Act::See(&["◂ back at 0.050 s"]),
            Act::Key(Char('(')),
            Act::See(&["◂ back at 0.000 s"]),
            Act::Key(Char('}')),
            Act::Until(|screen| !screen.contains("back at 0.000 s")),
            Act::Key(Char('{')),
            Act::See(&["◂ back at 0.000 s"]),
            Act::Key(Char(' ')),
            Act::See(&["▶ again, 1/20"]),
            Act::Key(End),
            Act::See(&["‖ paused"]),
            // An edit, and back before it: the screen has the value in force then.
            Act::Key(Char('e')),
            Act::See(&["ε 0.60 → 0.59"]),
            Act::Key(Char(',')),
            Act::See(&["◂ back at", "restitution      0.60"]),
            Act::Key(Char('E')),
            Act::See(&["restitution      0.61", "dropped"]),
            Act::Key(Char('y')),
            Act::See(&["beadlab fig5b --set restitution=0.61"]),
            Act::Key(Char('s')),
            Act::See(&["saved as fig5b"]),
            Act::Key(Char('R')),
            Act::See(&["● rec", "recording to fig5b"]),
            Act::Key(Char('R')),
            Act::See(&["is written"]),
            // Into the next landing, and out again.
            Act::Key(Char('z')),
            Act::See(&["1/200 000", "µs", "gap×"]),
            Act::Key(Char('z')),
            Act::Until(|screen| screen.contains("1/20 ")),
        ],
    );
}
