//! The explorer on a real pseudo-terminal: what it writes, and how it leaves.
use std::os::unix::process::ExitStatusExt;
use std::thread;
use std::time::{Duration, Instant};

use crate::session::{Session, Setup, wait, winsize};
use rustix::process::Signal;
use rustix::termios::tcsetwinsize;

#[test]
fn q_gives_the_terminal_back() {
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(3000);
    assert!(!session.is_cooked());
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
    wait(
        || session.was_left().then_some(()),
        "the alternate screen to be left",
    );
    assert!(session.is_cooked());
}

#[test]
fn signals_end_it_with_their_number_and_a_clean_terminal() {
    for (signal, code) in [
        (Signal::TERM, 143),
        (Signal::INT, 130),
        (Signal::HUP, 129),
        (Signal::QUIT, 131),
        (Signal::USR1, 138),
        (Signal::XCPU, 152),
    ] {
        let mut session = Session::start(&[], true);
        session.wait_for_bytes(3000);
        session.signal(signal);
        assert_eq!(session.wait_for_end().code(), Some(code));
        wait(
            || session.was_left().then_some(()),
            "the alternate screen to be left",
        );
        assert!(session.is_cooked());
    }
}

#[test]
fn a_signal_ends_it_although_nobody_reads() {
    let mut session = Session::start_unread();
    let start = Instant::now();
    session.signal(Signal::TERM);
    assert_eq!(session.wait_for_end().code(), Some(143));
    assert!(start.elapsed() < Duration::from_secs(1));
    assert!(session.is_cooked());
}

#[test]
fn keys_leave_it_although_nobody_reads() {
    for key in ["q", "\x03"] {
        let mut session = Session::start_unread();
        // Pastes and what is not understood change nothing.
        session.type_keys("\x1b[200~n=3\x1b[201~\x1b]11;rgb:0/0/0\x07");
        let start = Instant::now();
        session.type_keys(key);
        assert_eq!(session.wait_for_end().code(), Some(0));
        assert!(start.elapsed() < Duration::from_secs(1));
        assert!(session.is_cooked());
    }
}

#[test]
fn a_vanished_terminal_ends_it_at_once() {
    let mut session = Session::start(&[], false);
    wait(
        || (!session.is_cooked()).then_some(()),
        "the program to begin",
    );
    let start = Instant::now();
    session.screen = None;
    let status = session.wait_for_end();
    assert!(start.elapsed() < Duration::from_secs(1));
    assert!(
        status.code() == Some(129) || status.signal() == Some(1),
        "{status}"
    );
}

#[test]
fn ctrl_z_stops_it_with_a_clean_terminal_and_it_comes_back() {
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(3000);
    session.type_keys("\x1a");
    wait(
        || (session.process().0 == "T").then_some(()),
        "the program to stop",
    );
    assert!(session.is_cooked());
    wait(
        || session.was_left().then_some(()),
        "the alternate screen to be left",
    );
    let before = session.count();
    session.signal(Signal::CONT);
    session.wait_for_bytes(before + 2000);
    assert!(!session.is_cooked());
    assert!(session.wrote_since(before, b"\x1b[?1049h"));
    assert!(
        session.wrote_since(before, b"\x1b[2J"),
        "everything is drawn anew"
    );
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

#[test]
fn it_follows_any_size() {
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(3000);
    for (columns, rows) in [(1, 1), (200, 60), (20, 5), (3, 50), (80, 24)] {
        let screen = session.screen.as_ref().expect("the terminal is there");
        let before = session.count();
        tcsetwinsize(screen, winsize(columns, rows)).expect("it takes a size");
        session.signal(Signal::WINCH);
        let anew = || session.wrote_since(before, b"\x1b[2J").then_some(());
        wait(anew, "the screen to be drawn in its new size");
    }
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

#[test]
fn it_writes_little_and_nothing_when_paused() {
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(3000);
    let before = session.count();
    thread::sleep(Duration::from_secs(2));
    let rate = (session.count() - before) / 2;
    assert!((500..10_000).contains(&rate), "{rate} bytes per second");
    session.type_keys(" ");
    wait(|| session.shows("paused").then_some(()), "the pause");
    // What was on its way by then arrives, and nothing after it.
    thread::sleep(Duration::from_millis(200));
    let (paused, cpu) = (session.count(), session.process().1);
    thread::sleep(Duration::from_secs(1));
    assert_eq!(session.count(), paused, "paused, and it writes");
    assert!(session.process().1 - cpu < 0.02, "paused, and it computes");
}

#[test]
fn ascii_and_no_colours_are_to_be_had() {
    let mut session = Session::start_as(&Setup {
        arguments: &["--ascii"],
        variables: &[("NO_COLOR", "1")],
        ..Setup::default()
    });
    session.wait_for_bytes(3000);
    let bytes = session.bytes();
    assert!(bytes.is_ascii());
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let codes = text.split("\x1b[").filter_map(|rest| rest.split_once('m'));
    let is_code = |code: &str| code.chars().all(|c| c.is_ascii_digit() || c == ';');
    let codes: Vec<&str> = codes.map(|(code, _)| code).filter(|c| is_code(c)).collect();
    assert!(!codes.is_empty(), "bold and dim are no colours");
    for code in codes {
        assert!(
            code.split(';').all(|part| part.len() < 2),
            "a colour: {code}"
        );
    }
    session.type_keys("q");
    session.wait_for_end();
}

/// A failed allocation ends the program by this signal.
#[test]
fn an_abort_leaves_the_terminal_whole() {
    let mut session = Session::start(&[], true);
    session.wait_for_bytes(3000);
    session.signal(Signal::ABORT);
    assert_eq!(session.wait_for_end().signal(), Some(6));
    wait(
        || session.was_left().then_some(()),
        "the alternate screen to be left",
    );
    assert!(session.is_cooked());
}

/// Nobody could continue the leader of a session.
#[test]
fn ctrl_z_where_no_shell_is_says_so() {
    let mut session = Session::start_as(&Setup {
        leads: true,
        ..Setup::default()
    });
    session.wait_for_bytes(3000);
    for stop in ["\x1a", ""] {
        let before = session.count();
        if stop.is_empty() {
            session.signal(Signal::TSTP);
        } else {
            session.type_keys(stop);
        }
        let told = || {
            let text = session.bytes().split_off(before);
            let text = String::from_utf8_lossy(&text).into_owned();
            text.contains("not stopped").then_some(())
        };
        wait(told, "the reason why it goes on");
        let before = session.count();
        session.type_keys("\x1b[A");
        session.wait_for_bytes(before + 1);
        assert_ne!(session.process().0, "T");
    }
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

/// What stands on a screen of that width: as far as texts go, the last written ones.
fn widest_column(bytes: &[u8]) -> usize {
    let text = String::from_utf8_lossy(bytes);
    let moves = text.split("\x1b[").filter_map(|rest| rest.split_once('H'));
    let columns = moves.filter_map(|(place, rest)| {
        let (_, column) = place.split_once(';')?;
        let run = rest.split('\x1b').next().unwrap_or_default();
        Some(column.parse::<usize>().ok()? + run.chars().count())
    });
    columns.max().unwrap_or(0)
}

/// Terminals of containers start without a size, and get one a moment later.
#[test]
fn a_size_that_comes_late_is_followed() {
    for delay in [0, 5, 15, 30, 60] {
        let mut session = Session::start_as(&Setup {
            size: (0, 0),
            ..Setup::default()
        });
        thread::sleep(Duration::from_millis(delay));
        let screen = session.screen.as_ref().expect("the terminal is there");
        tcsetwinsize(screen, winsize(150, 40)).expect("it takes a size");
        session.signal(Signal::WINCH);
        let is_wide = || (widest_column(&session.bytes()) > 140).then_some(());
        wait(is_wide, "the page to be as wide as the terminal");
        session.type_keys("q");
        assert_eq!(session.wait_for_end().code(), Some(0));
    }
}

#[test]
fn a_terminal_without_a_size_gets_a_page() {
    let mut session = Session::start_as(&Setup {
        size: (0, 0),
        ..Setup::default()
    });
    let is_drawn = || (widest_column(&session.bytes()) > 70).then_some(());
    wait(is_drawn, "80 columns to be drawn");
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

/// Sixty thousand columns and rows are four thousand million cells.
#[test]
fn impossible_sizes_are_drawn_in_part() {
    let mut session = Session::start_as(&Setup {
        size: (60_000, 60_000),
        ..Setup::default()
    });
    session.wait_for_bytes(3000);
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

/// Whoever reads the terminal next must not get its answers.
#[test]
fn no_answer_is_left_behind() {
    for _ in 0..3 {
        let mut session = Session::start(&[], true);
        session.wait_for_bytes(6000);
        session.type_keys("q");
        assert_eq!(session.wait_for_end().code(), Some(0));
        let asked = session
            .bytes()
            .windows(4)
            .filter(|window| *window == b"\x1b[5n")
            .count();
        assert!(asked > 2);
        // Back in its own mode the terminal would have a line with it; none comes.
        let waiting = rustix::io::ioctl_fionread(&session.terminal).expect("it is a terminal");
        assert_eq!(waiting, 0);
    }
}

#[test]
fn a_terminal_that_cannot_move_its_cursor_is_told_so() {
    for term in ["dumb", ""] {
        let mut session = Session::start_as(&Setup {
            variables: &[("TERM", term)],
            ..Setup::default()
        });
        assert_eq!(session.wait_for_end().code(), Some(2));
        // It may end before its last line has been read.
        let told = || Some(session.bytes()).filter(|bytes| bytes.ends_with(b"\n"));
        let text = String::from_utf8_lossy(&wait(told, "the reason")).into_owned();
        assert_eq!(text.trim_end().lines().count(), 1, "{text}");
        assert!(text.contains("TERM"), "{text}");
    }
}

/// A terminal that gives no receipts gets less, but goes on to get it, and keys work.
#[test]
fn a_silent_terminal_gets_a_careful_rate() {
    let mut session = Session::start_as(&Setup {
        answers: false,
        ..Setup::default()
    });
    session.wait_for_bytes(3000);
    // The picture is all that it gets until the first receipt is given up.
    thread::sleep(Duration::from_millis(500));
    session.wait_for_bytes(session.count() + 1);
    let before = session.count();
    thread::sleep(Duration::from_secs(4));
    let rate = (session.count() - before) / 4;
    assert!((300..1_500).contains(&rate), "{rate} bytes per second");
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

/// Killed at some moment, a recording is a tape up to its last whole line.
fn killed_while_recording(moments: u32) {
    for k in 0..moments {
        let folder = std::env::temp_dir();
        let path = folder.join(format!("beadlab-killed-{}-{k}.tape", std::process::id()));
        let path = path.to_str().expect("a UTF-8 path").to_owned();
        // A file of a run that was stopped; there is none otherwise.
        let _ = std::fs::remove_file(&path);
        let arguments = ["fig5b", "--speed", "1", "--record", &path];
        let mut session = Session::start(&arguments, true);
        wait(
            || {
                let text = std::fs::read_to_string(&path).unwrap_or_default();
                (text.lines().count() > 2).then_some(())
            },
            "the recording to begin",
        );
        session.type_keys("eE");
        thread::sleep(Duration::from_micros(u64::from(k) * 7919 % 90_000));
        session.signal(Signal::KILL);
        session.wait_for_end();
        let text = std::fs::read_to_string(&path).expect("a tape");
        let tape = beadlab::tape::Tape::read(&text).expect("a tape up to there");
        assert!(tape.marks.len() + tape.edits.len() > 0, "{text}");
        let mut replay = beadlab::tape::Replay::new(&tape);
        replay.go(&tape, tape.end(), &mut |_| {});
        assert_eq!(replay.differs, None, "{text}");
        std::fs::remove_file(&path).expect("the tape is there");
    }
}

#[test]
fn a_killed_recording_is_played_up_to_there() {
    killed_while_recording(3);
}

#[test]
#[ignore = "fifty sessions take half a minute"]
fn fifty_killed_recordings_are_played_up_to_there() {
    killed_while_recording(50);
}
