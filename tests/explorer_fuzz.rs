//! Nothing that is typed, pasted or resized kills the keyboard: after any of it the keys that
//! leave work.
#![cfg(target_os = "linux")]

#[path = "support/dice.rs"]
mod dice;
#[path = "support/session.rs"]
mod session;
mod support;

use std::thread;
use std::time::{Duration, Instant};

use dice::Dice;
use rustix::process::Signal;
use rustix::termios::tcsetwinsize;
use session::{Session, winsize};

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
    "\x0c",
    "ü",
    "中",
    "\u{202e}",
];

/// A whole number below `count`.
fn below(dice: &mut Dice, count: u16) -> u16 {
    (dice.roll() * f64::from(count)) as u16
}

/// Any bytes but those that leave.
fn noise(dice: &mut Dice) -> Vec<u8> {
    let count = 1 + below(dice, 12);
    let bytes: Vec<u8> = (0..count).map(|_| below(dice, 256) as u8).collect();
    bytes
        .into_iter()
        .filter(|byte| !matches!(byte, b'q' | 0x03 | 0x1a))
        .collect()
}

fn pieces(dice: &mut Dice, count: usize) -> Vec<u8> {
    let mut bytes = Vec::new();
    for _ in 0..count {
        if dice.chance(0.1) {
            bytes.extend(noise(dice));
        } else {
            let k = below(dice, PIECES.len() as u16);
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
    thread::sleep(Duration::from_millis(600));
    let start = Instant::now();
    if leave == "q" {
        session.type_keys("\x1b");
        thread::sleep(Duration::from_millis(100));
    }
    session.type_keys(leave);
    assert_eq!(session.wait_for_end().code(), Some(0), "seed {seed}");
    let took = start.elapsed();
    assert!(took < Duration::from_secs(4), "seed {seed}: {took:?}");
}

#[test]
fn after_any_input_the_keys_that_leave_work() {
    torment(1, 4_000, "q");
    torment(2, 4_000, "\x03");
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
