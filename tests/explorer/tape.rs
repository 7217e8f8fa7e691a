//! Sessions on tape: what is recorded of edits, steps back and forks is played again to the
//! same states.

use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use beadlab::live::{Frame, Leap, Order, Recording, Way};
use beadlab::scene::parameters::{self, Value};
use beadlab::scene::{MethodName, Scene};
use beadlab::study::vary;
use beadlab::tape::{Replay, Tape};

use crate::dice::Dice;
use crate::play::{MEMORY, Session, preset, sweep, twins};

/// A file in memory.
#[derive(Clone, Default)]
struct Paper(Arc<Mutex<Vec<u8>>>);

impl Paper {
    fn text(&self) -> String {
        let bytes = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        String::from_utf8(bytes.clone()).expect("a tape is text")
    }
}

impl Write for Paper {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        let mut paper = self.0.lock().unwrap_or_else(PoisonError::into_inner);
        paper.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        Ok(())
    }
}

/// A session that stands still at t = 0 and is recorded.
struct Recorded {
    session: Session,
    paper: Paper,
}

impl Recorded {
    fn begin(scenes: Vec<Scene>) -> Recorded {
        let session = Session::paused(scenes, sweep(0.02, false), MEMORY);
        let paper = Paper::default();
        let recording = Recording::new(Box::new(paper.clone()));
        session.ask(Order::Record(Some(recording)));
        Recorded { session, paper }
    }

    fn ask(&self, order: Order) -> Frame {
        self.session.ask(order)
    }

    /// The tape, ended.
    fn tape(&self) -> String {
        self.ask(Order::Record(None));
        self.paper.text()
    }
}

/// An edit at random: of a contact, of the plate, or of the method.
fn edit(dice: &mut Dice, scenes: &mut Vec<Scene>) -> Order {
    let from: Vec<usize> = (0..scenes.len()).collect();
    let choice = dice.below(5);
    if choice == 4 {
        let methods = [MethodName::Gear, MethodName::Verlet, MethodName::Exact];
        let method = methods[dice.below(3)];
        scenes[0] = scenes[0].with_method(method).expect("a soft column may");
    } else {
        let (name, scale) = [
            ("restitution", 1.0),
            ("contact_time", 2e-4),
            ("amplitude", 2e-3),
            ("frequency", 40.0),
        ][choice];
        let value = scale * (0.3 + 0.69 * dice.roll());
        let edited = scenes.iter().map(|scene| {
            // Hard spheres have no contact time.
            let row = parameters::find(name).expect("a parameter");
            if row.applies(scene.facts()) {
                vary(scene, None, &[(name, Value::Number(value))]).expect("an allowed value")
            } else {
                scene.clone()
            }
        });
        *scenes = edited.collect();
    }
    let scenes = scenes.clone();
    Order::Edit { scenes, from }
}

/// A column and its twin, small and soft, so that ten thousand sessions take minutes.
fn small() -> Vec<Scene> {
    let layer = [
        ("n", Value::Whole(4)),
        ("contact_time", Value::Number(1e-4)),
    ];
    let soft = vary(&preset("fig5b").scene, None, &layer).expect("an allowed scene");
    let hard = soft
        .with_method(MethodName::Ed)
        .expect("every scene can be hard");
    vec![soft, hard]
}

/// Edits, steps on and back, and forks, as the dice have them; recorded, read and played
/// again. Every state is a hash of all bits: they are the same or not.
fn sessions(count: u64) {
    let mut compared = 0;
    for seed in 0..count {
        let mut dice = Dice(seed + 1);
        let mut scenes = small();
        let session = Recorded::begin(scenes.clone());
        for _ in 0..4 + dice.below(8) {
            let frame = match dice.below(8) {
                0..=3 => session.ask(Order::Leap(Leap::By(0.02 * dice.roll()))),
                4 => session.ask(Order::Leap(Leap::By(-0.03 * dice.roll()))),
                5 => session.ask(Order::Leap(Leap::Landing(Way::Back))),
                6 => session.ask(Order::Leap(Leap::End)),
                _ => session.ask(edit(&mut dice, &mut scenes)),
            };
            scenes = frame.scenes;
        }
        let text = session.tape();
        let tape = Tape::read(&text).unwrap_or_else(|error| panic!("{error}\n{text}"));
        assert_eq!(tape.cut, None);
        let mut replay = Replay::new(&tape);
        replay.go(&tape, tape.end(), &mut |_| {});
        assert_eq!(replay.differs, None, "seed {seed}\n{text}");
        assert_eq!(replay.edits, tape.edits.len());
        compared += replay.compared;
    }
    assert!(compared as u64 > count / 2, "{compared} states");
}

#[test]
fn a_recorded_session_is_played_again() {
    sessions(100);
}

#[test]
#[ignore = "ten thousand sessions take minutes"]
fn ten_thousand_recorded_sessions_are_played_again() {
    sessions(10_000);
}

/// A tape of a session with an edit and a fork.
fn tape() -> String {
    let mut scenes = twins("fig5b");
    let mut dice = Dice(7);
    let session = Recorded::begin(scenes.clone());
    session.ask(Order::Leap(Leap::By(0.06)));
    session.ask(edit(&mut dice, &mut scenes));
    session.ask(Order::Leap(Leap::By(0.12)));
    session.ask(Order::Leap(Leap::By(-0.05)));
    session.ask(edit(&mut dice, &mut scenes));
    session.ask(Order::Leap(Leap::By(0.06)));
    session.tape()
}

#[test]
fn a_tape_that_is_cut_is_played_up_to_there() {
    let text = tape();
    let whole = Tape::read(&text).expect("a tape");
    assert_eq!(whole.edits.len(), 2);
    // Two lines make a start; from then on every cut leaves something to play.
    let start = text.match_indices('\n').nth(1).expect("a start").0 + 1;
    for end in (start..=text.len()).step_by(13) {
        let tape = Tape::read(&text[..end]).expect("a part of a tape");
        assert_eq!(tape.cut.is_some(), !text[..end].ends_with('\n'), "at {end}");
        let mut replay = Replay::new(&tape);
        replay.go(&tape, tape.end().min(0.02), &mut |_| {});
        assert_eq!(replay.differs, None);
    }
    assert!(Tape::read(&text[..start - 1]).is_err());
}

#[test]
fn an_altered_tape_is_refused_at_its_line() {
    let text = tape();
    let lines: Vec<&str> = text.lines().collect();
    for (k, line) in lines.iter().enumerate().skip(1) {
        // A digit is another.
        let altered = line.replacen(|c: char| c.is_ascii_digit(), "x", 1);
        let mut others = lines.clone();
        others[k] = &altered;
        let error = Tape::read(&(others.join("\n") + "\n")).expect_err("altered");
        assert!(
            error.to_string().starts_with(&format!("line {}:", k + 1)),
            "{error}"
        );
        // A line is missing: the next one tells.
        if k + 1 < lines.len() {
            let mut others = lines.clone();
            others.remove(k);
            let error = Tape::read(&(others.join("\n") + "\n")).expect_err("shorter");
            assert!(
                error.to_string().starts_with(&format!("line {}:", k + 1)),
                "{error}"
            );
        }
    }
    let newer = text.replacen("\"version\":1", "\"version\":2", 1);
    let error = Tape::read(&newer).expect_err("newer");
    assert!(error.to_string().contains("version 2"), "{error}");
    assert!(Tape::read("once upon a time\n").is_err() && Tape::read("").is_err());
}

/// A state that is another than on the tape is named with its time and column.
#[test]
fn another_state_is_named_with_its_time() {
    let tape = Tape::read(&tape()).expect("a tape");
    let mut other = tape.clone();
    let mark = &mut other.marks[1];
    mark.hashes[1] = "0123456789abcdef".into();
    let time = mark.time;
    let mut replay = Replay::new(&other);
    replay.go(&other, other.end(), &mut |_| {});
    assert_eq!(replay.differs, Some((time, 2)));
    assert_eq!(replay.compared, tape.marks.len());
}
