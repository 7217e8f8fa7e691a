//! The explorer on a real pseudo-terminal: what it writes, and how it leaves.
#![cfg(target_os = "linux")]

use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::process::{CommandExt, ExitStatusExt};
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{LocalModes, Winsize, tcgetattr, tcsetwinsize};

const LEFT: &[u8] = b"\x1b[?25h\x1b[?1049l";

/// The program on a terminal of 80 columns and 24 rows.
struct Session {
    child: Child,
    screen: Option<File>,
    terminal: File,
    written: Arc<Mutex<Vec<u8>>>,
}

fn winsize(columns: u16, rows: u16) -> Winsize {
    Winsize {
        ws_row: rows,
        ws_col: columns,
        ws_xpixel: 0,
        ws_ypixel: 0,
    }
}

impl Session {
    fn start(arguments: &[&str], reads: bool) -> Session {
        Session::start_with(arguments, &[], reads)
    }

    /// Starts the program with further variables; nobody `reads` what it writes, or
    /// somebody does.
    fn start_with(arguments: &[&str], variables: &[(&str, &str)], reads: bool) -> Session {
        let master = openpt(OpenptFlags::RDWR | OpenptFlags::NOCTTY | OpenptFlags::CLOEXEC)
            .expect("a pseudo-terminal is to be had");
        grantpt(&master).expect("it is ours");
        unlockpt(&master).expect("it is ours");
        let name = ptsname(&master, Vec::new()).expect("it has a name");
        let path = name.into_string().expect("its name is a path");
        let terminal = File::options()
            .read(true)
            .write(true)
            .open(path)
            .expect("it opens");
        tcsetwinsize(&terminal, winsize(80, 24)).expect("it has a size");
        let end = || Stdio::from(terminal.try_clone().expect("files are to be had"));
        let child = Command::new(env!("CARGO_BIN_EXE_beadlab"))
            .args(arguments)
            .env("TERM", "xterm-256color")
            .env("LC_ALL", "C.UTF-8")
            .env_remove("NO_COLOR")
            .envs(variables.iter().copied())
            .stdin(end())
            .stdout(end())
            .stderr(end())
            .process_group(0)
            .spawn()
            .expect("the program starts");
        let screen = File::from(master);
        let written = Arc::new(Mutex::new(Vec::new()));
        if reads {
            let (mut eye, seen) = (
                screen.try_clone().expect("files are to be had"),
                Arc::clone(&written),
            );
            thread::spawn(move || {
                let mut buffer = [0; 4096];
                while let Ok(count @ 1..) = eye.read(&mut buffer) {
                    seen.lock()
                        .expect("nobody panics with it")
                        .extend_from_slice(&buffer[..count]);
                }
            });
        }
        Session {
            child,
            screen: Some(screen),
            terminal,
            written,
        }
    }

    fn type_keys(&mut self, keys: &str) {
        let screen = self.screen.as_mut().expect("the terminal is there");
        screen
            .write_all(keys.as_bytes())
            .expect("the terminal takes keys");
    }

    fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).expect("the program is there");
    }

    fn count(&self) -> usize {
        self.written.lock().expect("nobody panics with it").len()
    }

    fn bytes(&self) -> Vec<u8> {
        self.written.lock().expect("nobody panics with it").clone()
    }

    /// Waits until so many bytes are written.
    fn wait_for_bytes(&self, count: usize) {
        wait(
            || (self.count() >= count).then_some(()),
            "the program to draw",
        );
    }

    fn wait_for_end(&mut self) -> ExitStatus {
        wait(
            || {
                self.child
                    .try_wait()
                    .expect("the program can be waited for")
            },
            "the program to end",
        )
    }

    /// Whether the terminal is in the mode in which it was found.
    fn is_cooked(&self) -> bool {
        let modes = tcgetattr(&self.terminal)
            .expect("the terminal is there")
            .local_modes;
        modes.contains(LocalModes::ICANON | LocalModes::ECHO)
    }

    fn was_left(&self) -> bool {
        self.bytes()
            .windows(LEFT.len())
            .any(|window| window == LEFT)
    }

    /// Letter of the process's state, and CPU time used, s.
    fn process(&self) -> (String, f64) {
        let stat = fs::read_to_string(format!("/proc/{}/stat", self.child.id()))
            .expect("the program is there");
        let fields: Vec<&str> = stat
            .rsplit(')')
            .next()
            .unwrap_or_default()
            .split_whitespace()
            .collect();
        let ticks: f64 = [11, 12]
            .iter()
            .map(|&k: &usize| fields[k].parse::<f64>().expect("ticks"))
            .sum();
        (fields[0].to_owned(), ticks / 100.0)
    }
}

impl Drop for Session {
    fn drop(&mut self) {
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

fn wait<T>(mut ready: impl FnMut() -> Option<T>, what: &str) -> T {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(10) {
        if let Some(result) = ready() {
            return result;
        }
        thread::sleep(Duration::from_millis(5));
    }
    panic!("waited in vain for {what}");
}

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
    for (signal, code) in [(Signal::TERM, 143), (Signal::INT, 130), (Signal::HUP, 129)] {
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
    let mut session = Session::start(&["--speed", "0.2"], false);
    // The queue of the terminal is full, and the program waits in a write.
    thread::sleep(Duration::from_secs(4));
    let start = Instant::now();
    session.signal(Signal::TERM);
    assert_eq!(session.wait_for_end().code(), Some(143));
    assert!(start.elapsed() < Duration::from_secs(1));
    assert!(session.is_cooked());
}

#[test]
fn a_vanished_terminal_ends_it_at_once() {
    let mut session = Session::start(&[], false);
    thread::sleep(Duration::from_millis(700));
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
    let again = session.bytes()[before..].to_vec();
    assert!(again.windows(8).any(|window| window == b"\x1b[?1049h"));
    assert!(
        again.windows(4).any(|window| window == b"\x1b[2J"),
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
        tcsetwinsize(screen, winsize(columns, rows)).expect("it takes a size");
        session.signal(Signal::WINCH);
        thread::sleep(Duration::from_millis(120));
    }
    session.type_keys("q");
    assert_eq!(session.wait_for_end().code(), Some(0));
}

#[test]
fn it_writes_little_and_nothing_when_paused() {
    let mut session = Session::start(&[], true);
    thread::sleep(Duration::from_secs(2));
    let before = session.count();
    thread::sleep(Duration::from_secs(4));
    let rate = (session.count() - before) / 4;
    assert!((500..10_000).contains(&rate), "{rate} bytes per second");
    session.type_keys(" ");
    thread::sleep(Duration::from_millis(400));
    let (paused, cpu) = (session.count(), session.process().1);
    thread::sleep(Duration::from_millis(1500));
    assert_eq!(session.count(), paused, "paused, and it writes");
    assert!(session.process().1 - cpu < 0.02, "paused, and it computes");
}

#[test]
fn ascii_and_no_colours_are_to_be_had() {
    let mut session = Session::start_with(&["--ascii"], &[("NO_COLOR", "1")], true);
    session.wait_for_bytes(3000);
    let bytes = session.bytes();
    assert!(bytes.is_ascii());
    let text = String::from_utf8_lossy(&bytes).into_owned();
    let codes = text.split("\x1b[").filter_map(|rest| rest.split_once('m'));
    for (code, _) in codes.filter(|(code, _)| code.chars().all(|c| c.is_ascii_digit() || c == ';'))
    {
        assert!(
            code.split(';').all(|part| part.len() < 2),
            "a colour: {code}"
        );
    }
    session.type_keys("q");
    session.wait_for_end();
}
