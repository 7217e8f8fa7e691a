//! The built program on a real pseudo-terminal.

use std::fs::{self, File};
use std::io::{Read, Write};
use std::os::unix::process::CommandExt;
use std::process::{Child, Command, ExitStatus, Stdio};
use std::sync::{Arc, Mutex};
use std::thread;
use std::time::{Duration, Instant};

use rustix::process::{Pid, Signal, kill_process};
use rustix::pty::{OpenptFlags, grantpt, openpt, ptsname, unlockpt};
use rustix::termios::{LocalModes, Winsize, tcgetattr, tcsetwinsize};

const LEFT: &[u8] = b"\x1b[?25h\x1b[?1049l";

const QUESTION: &[u8] = b"\x1b[5n";

/// Bytes that the near end of a terminal's queue holds.
const FULL: u64 = 4095;

/// The program on a terminal of 80 columns and 24 rows.
pub struct Session {
    pub child: Child,
    pub screen: Option<File>,
    pub terminal: File,
    pub written: Arc<Mutex<Vec<u8>>>,
}

/// Reads what is written, and answers the question how the terminal is.
fn watch(mut eye: File, seen: &Mutex<Vec<u8>>, answers: bool) {
    let mut buffer = [0; 4096];
    while let Ok(count @ 1..) = eye.read(&mut buffer) {
        let part = &buffer[..count];
        let mut all = seen.lock().expect("nobody panics with it");
        // A question may come in two parts.
        let before = all.len().saturating_sub(QUESTION.len() - 1);
        all.extend_from_slice(part);
        let asked = all[before..].windows(QUESTION.len());
        let asked = asked.filter(|window| *window == QUESTION).count();
        drop(all);
        for _ in 0..if answers { asked } else { 0 } {
            let _ = eye.write_all(b"\x1b[0n");
        }
    }
}

pub fn winsize(columns: u16, rows: u16) -> Winsize {
    Winsize {
        ws_row: rows,
        ws_col: columns,
        ws_xpixel: 0,
        ws_ypixel: 0,
    }
}

/// How a program is started.
pub struct Setup<'a> {
    pub program: &'a str,
    pub arguments: &'a [&'a str],
    pub variables: &'a [(&'a str, &'a str)],
    /// Whether somebody reads what it writes.
    pub reads: bool,
    /// Whether the terminal says how it is when it is asked.
    pub answers: bool,
    /// Columns and rows.
    pub size: (u16, u16),
    /// Whether it leads its session, so that no shell looks after it.
    pub leads: bool,
}

impl Default for Setup<'_> {
    fn default() -> Self {
        Setup {
            program: env!("CARGO_BIN_EXE_beadlab"),
            arguments: &[],
            variables: &[],
            reads: true,
            answers: true,
            size: (80, 24),
            leads: false,
        }
    }
}

impl Session {
    pub fn start(arguments: &[&str], reads: bool) -> Session {
        Session::start_as(&Setup {
            arguments,
            reads,
            ..Setup::default()
        })
    }

    /// One that nobody reads: the first picture is more than the queue of the terminal holds,
    /// which is full, so that the program waits in a write.
    pub fn start_unread() -> Session {
        let session = Session::start_as(&Setup {
            arguments: &["--speed", "0.2"],
            reads: false,
            size: (250, 80),
            ..Setup::default()
        });
        let screen = session.screen.as_ref().expect("the terminal is there");
        let is_full = || {
            let waiting = rustix::io::ioctl_fionread(screen).expect("it is a terminal");
            (waiting >= FULL).then_some(())
        };
        wait(is_full, "the queue to be full");
        session
    }

    pub fn start_as(setup: &Setup) -> Session {
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
        tcsetwinsize(&terminal, winsize(setup.size.0, setup.size.1)).expect("it has a size");
        let end = || Stdio::from(terminal.try_clone().expect("files are to be had"));
        let program = setup.program;
        let mut command = if setup.leads {
            let mut command = Command::new("setsid");
            command.args(["-c", program]);
            command
        } else {
            let mut command = Command::new(program);
            command.process_group(0);
            command
        };
        let child = command
            .args(setup.arguments)
            .env("TERM", "xterm-256color")
            .env("LC_ALL", "C.UTF-8")
            .env_remove("NO_COLOR")
            .env_remove("TMUX")
            .env_remove("STY")
            .envs(setup.variables.iter().copied())
            .stdin(end())
            .stdout(end())
            .stderr(end())
            .spawn()
            .expect("the program starts");
        let screen = File::from(master);
        let written = Arc::new(Mutex::new(Vec::new()));
        if setup.reads {
            let eye = screen.try_clone().expect("files are to be had");
            let (seen, answers) = (Arc::clone(&written), setup.answers);
            thread::spawn(move || watch(eye, &seen, answers));
        }
        Session {
            child,
            screen: Some(screen),
            terminal,
            written,
        }
    }

    pub fn type_keys(&mut self, keys: &str) {
        self.type_bytes(keys.as_bytes());
    }

    pub fn type_bytes(&mut self, bytes: &[u8]) {
        let screen = self.screen.as_mut().expect("the terminal is there");
        screen.write_all(bytes).expect("the terminal takes keys");
    }

    pub fn signal(&self, signal: Signal) {
        kill_process(Pid::from_child(&self.child), signal).expect("the program is there");
    }

    /// Whether a text stands on the screen of 80 columns and 24 rows now.
    pub fn shows(&self, text: &str) -> bool {
        let mut screen = vt100::Parser::new(24, 80, 0);
        screen.process(&self.bytes());
        screen.screen().contents().contains(text)
    }

    pub fn count(&self) -> usize {
        self.written.lock().expect("nobody panics with it").len()
    }

    pub fn bytes(&self) -> Vec<u8> {
        self.written.lock().expect("nobody panics with it").clone()
    }

    /// Whether this was written after so many bytes.
    pub fn wrote_since(&self, count: usize, part: &[u8]) -> bool {
        let bytes = self.bytes();
        bytes[count..]
            .windows(part.len())
            .any(|window| window == part)
    }

    /// Waits until so many bytes are written.
    pub fn wait_for_bytes(&self, count: usize) {
        wait(
            || (self.count() >= count).then_some(()),
            "the program to draw",
        );
    }

    pub fn wait_for_end(&mut self) -> ExitStatus {
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
    pub fn is_cooked(&self) -> bool {
        let modes = tcgetattr(&self.terminal)
            .expect("the terminal is there")
            .local_modes;
        modes.contains(LocalModes::ICANON | LocalModes::ECHO)
    }

    pub fn was_left(&self) -> bool {
        self.bytes()
            .windows(LEFT.len())
            .any(|window| window == LEFT)
    }

    /// Letter of the process's state, and CPU time used, s.
    pub fn process(&self) -> (String, f64) {
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

pub fn wait<T>(mut ready: impl FnMut() -> Option<T>, what: &str) -> T {
    let start = Instant::now();
    while start.elapsed() < Duration::from_secs(10) {
        if let Some(result) = ready() {
            return result;
        }
        thread::sleep(Duration::from_millis(5));
    }
    panic!("waited in vain for {what}");
}
