//! Nothing that is typed, pasted or resized kills the keyboard: after any of it the keys that
//! leave work.
use std::thread;
use std::time::{Duration, Instant};

use crate::dice::Dice;
use crate::play::{Act, COLOURS, play, real};
use crate::session::{Session, winsize};
use crossterm::event::KeyCode;
use rustix::process::Signal;
use rustix::termios::tcsetwinsize;

/// Sequences whole and broken, of keys and of answers, and what is between them.
const PIECES: &[&str] = &[
    "\x1b[A",
    "\x1b[B",
    "\x1b[C",
    "\x1b[D",
    "\x1bOA",
    "\x1b[5~",
    "\x1b[1;2C",
    "\x1b",
    "\x1b\x1b",
    "\x1b[",
    "\x1b[1;",
    "\x1b]11;rgb:00",
    "\x1b\\",
    "\x07",
    "\x1bP>|x",
    "\x1b_G",
    "\x1b[0n",
    "\x1b[24;80R",
    "\x1b[?62c",
    "\x1b[M",
    "\x1b[<0;1;1M",
    "\x1b[200~n=3\r",
    "\x1b[201~",
    "\x1b[116;4u",
    "\x1b[[A",
    "\r",
    "\t",
    "\x7f",
    ":",
    ":n=5\r",
    ":ε=0.7\r",
    "p",
    "?",
    " ",
    "m",
    "w",
    "x",
    "e",
    "E",
    "t",
    "T",
    "a",
    "A",
    "f",
    "F",
    "u",
    "U",
    "0",
    ".",
    ">",
    "[",
    "]",
    "r",
    "g",
    "\x0c",
    "ü",
    "中",
    "\u{202e}",
];

/// A whole number below `count`.
fn below(dice: &mut Dice, count: u16) -> u16 {
    dice.roll();
    u16::try_from((dice.0 >> 33) % u64::from(count)).expect("it is below one")
}

/// Any bytes but those that leave, and those that write files.
fn noise(dice: &mut Dice) -> Vec<u8> {
    let count = 1 + below(dice, 12);
    let bytes: Vec<u8> = (0..count)
        .map(|_| below(dice, 256).to_le_bytes()[0])
        .collect();
    bytes
        .into_iter()
        .filter(|byte| !matches!(byte, b'q' | b's' | b'R' | b'P' | 0x03 | 0x1a))
        .collect()
}

fn pieces(dice: &mut Dice, count: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..count {
        if dice.chance(0.1) {
            bytes.extend(noise(dice));
        } else {
            let k = below(dice, u16::try_from(PIECES.len()).expect("few"));
            bytes.extend(PIECES[usize::from(k)].as_bytes());
        }
    }
    bytes
}

/// Types so many pieces in bursts with resizes between them, then leaves.
fn torment(seed: u64, count: usize, leave: &str) {
    const BURST: usize = 400;
    let mut dice = Dice(seed);
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(2000);
    for _ in 0..count.div_ceil(BURST) {
        let bytes = pieces(&mut dice, BURST);
        session.type_bytes(&bytes);
        let screen = session.screen.as_ref().expect("the terminal is there");
        let (columns, rows) = (1 + below(&mut dice, 130), 1 + below(&mut dice, 60));
        tcsetwinsize(screen, winsize(columns, rows)).expect("it takes a size");
        session.signal(Signal::WINCH);
    }
    // What has begun ends in time; Esc closes what lies over the screen.
    thread::sleep(Duration::from_millis(450));
    let start = Instant::now();
    if leave == "q" {
        session.type_keys("\x1b");
        thread::sleep(Duration::from_millis(100));
    }
    session.type_keys(leave);
    assert_eq!(session.wait_for_end().code(), Some(0), "seed {seed}");
    let took = start.elapsed();
    assert!(took < Duration::from_secs(8), "seed {seed}: {took:?}");
}

#[test]
fn after_any_input_the_keys_that_leave_work() {
    torment(1, 4_000, "q");
    torment(2, 4_000, "\x03");
}

/// The same through the loop alone, without a terminal: any key, any size.
fn torment_loop(seed: u64, count: usize) {
    let mut dice = Dice(seed);
    let codes = [
        KeyCode::Esc,
        KeyCode::Enter,
        KeyCode::Tab,
        KeyCode::Backspace,
        KeyCode::Delete,
        KeyCode::Up,
        KeyCode::Down,
        KeyCode::Left,
        KeyCode::Right,
        KeyCode::Home,
        KeyCode::End,
        KeyCode::PageUp,
        KeyCode::PageDown,
    ];
    let script = (0..count).map(|_| match below(&mut dice, 40) {
        0 => Act::Resize(1 + below(&mut dice, 200), 1 + below(&mut dice, 80)),
        k @ 1..14 => Act::Key(codes[usize::from(k - 1)]),
        _ => {
            let c = char::from(b' ' + below(&mut dice, 95).to_le_bytes()[0]);
            Act::Key(KeyCode::Char(if c == 'q' { 'e' } else { c }))
        }
    });
    // It ends by itself and asserts that it was left by the key.
    let rows = play("shaken", COLOURS, (80, 24), real(), script.collect());
    assert_eq!(rows.len(), 24);
}

#[test]
fn after_any_keys_the_loop_can_be_left() {
    torment_loop(3, 5_000);
}

#[test]
#[ignore = "minutes"]
fn after_a_million_keys_the_loop_can_be_left() {
    for seed in 0..10 {
        torment_loop(200 + seed, 100_000);
    }
}

/// Two million keys, sequences and pieces of them; some minutes.
#[test]
#[ignore = "minutes"]
fn after_two_million_keys_too() {
    for seed in 0..20 {
        torment(
            100 + seed,
            100_000,
            if seed % 2 == 0 { "q" } else { "\x03" },
        );
    }
}
