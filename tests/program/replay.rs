//! `beadlab replay`: tapes that are played without pictures.

use crate::program::{beadlab, file, file_text, no_file, printed, refused, table};

/// A tape with edits, a step back and another edit, as the explorer wrote it on one machine.
const TAPE: &str = include_str!("session.tape");

/// What `replay` prints as JSON.
fn report_of(arguments: &[&str]) -> serde_json::Value {
    let text = printed(&[arguments, &["--format", "json"]].concat());
    serde_json::from_str(&text).expect("one JSON object")
}

#[test]
fn a_tape_is_played_and_its_states_compared() {
    let tape = file("session.tape", TAPE);
    let text = printed(&["replay", &tape]);
    assert!(text.contains("compared, all as on the tape"), "{text}");
    let report = report_of(&["replay", &tape]);
    assert_eq!(report["edits"], 3);
    assert!(report["states_compared"].as_u64() > Some(2));
    assert_eq!(report["columns"][1]["method"], "ed");
    // The same bytes, wherever they go.
    let out = no_file("session.csv");
    let motion = ["replay", &tape, "--format", "csv", "--every", "0.01"];
    let rows = printed(&motion);
    printed(&[&motion[..], &["--out", &out]].concat());
    assert_eq!(file_text(&out), rows);
    let (header, rows) = table(&rows);
    assert_eq!((header[0].as_str(), header.len()), ("time", 15));
    assert!(rows.len() > 10);
    let until = report_of(&["replay", &tape, "--until", "0.05"]);
    assert_eq!(until["time"], 0.05);
}

/// Frames have as many lines as they say, and their times are multiples of the interval.
#[test]
fn a_tape_is_written_as_frames() {
    let tape = file("frames.tape", TAPE);
    let arguments = [
        "replay", &tape, "--format", "xyz", "--every", "0.02", "--column", "2",
    ];
    let text = printed(&arguments);
    let lines: Vec<&str> = text.lines().collect();
    assert_eq!(lines.len() % 12, 0);
    for (k, frame) in (0u8..).zip(lines.chunks(12)) {
        assert_eq!(frame[0], "10");
        let time = frame[1]
            .split("Time=")
            .nth(1)
            .and_then(|rest| rest.split(' ').next());
        let time: f64 = time.and_then(|time| time.parse().ok()).expect("a time");
        assert!((time - 0.02 * f64::from(k)).abs() < 1e-12);
        // Beads that rest on one another are a diameter apart; none is below another.
        let heights = frame[2..].iter().map(|line| {
            let word = line.split(' ').nth(3).expect("a height");
            word.parse::<f64>().expect("a number")
        });
        let heights: Vec<f64> = heights.collect();
        assert!(heights.windows(2).all(|pair| pair[1] - pair[0] > 0.999e-3));
    }
}

#[test]
fn bad_tapes_are_refused_in_a_line() {
    let (first, rest) = TAPE.split_once('\n').expect("lines");
    let newer = first.replace("\"version\":1", "\"version\":9");
    for (name, text, words) in [
        ("newer", format!("{newer}\n{rest}"), "version 9"),
        ("other", "{\"a\":1}\n".to_owned(), "line 1: this is no tape"),
        ("empty", String::new(), "nothing to play"),
        ("altered", TAPE.replacen("0.13", "0.14", 1), "was altered"),
    ] {
        let line = refused(&["replay", &file(&format!("{name}.tape"), text)]);
        assert!(line.contains(words), "{line}");
    }
    let tape = file("good.tape", TAPE);
    for (arguments, words) in [
        (vec!["--format", "xyz"], "needs --every"),
        (vec!["--every", "0.1"], "no motion"),
        (vec!["--format", "csv", "--every", "1e-12"], "rows"),
        (vec!["--until", "-1"], "--until"),
        (vec!["--column", "3"], "--column"),
    ] {
        let line = refused(&[&["replay", &tape][..], &arguments].concat());
        assert!(line.contains(words), "{line}");
    }
    assert!(refused(&["replay", &no_file("no.tape")]).contains("no.tape"));
}

#[test]
fn a_cut_tape_is_played_up_to_there_and_says_so() {
    let cut = &TAPE[..TAPE.len() - 20];
    let output = beadlab(&["replay", &file("cut.tape", cut)]);
    assert_eq!(output.status.code(), Some(0));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("the tape is cut at line"), "{said}");
}

/// The words of the tape are as they were written, but a state is another: the program that
/// wrote it moved the columns otherwise. The lines' sums hold.
#[test]
fn another_state_fails_and_is_named() {
    let other = file("other-state.tape", include_str!("other_state.tape"));
    let output = beadlab(&["replay", &other]);
    assert_eq!(output.status.code(), Some(1));
    let said = String::from_utf8_lossy(&output.stderr).into_owned();
    assert!(said.contains("t = 0.05 s: column 1"), "{said}");
}
