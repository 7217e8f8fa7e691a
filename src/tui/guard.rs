//! The terminal is given back as it was found, whatever happens.

use std::fs::File;
use std::io::{self, Write};
use std::panic;
use std::sync::OnceLock;
use std::sync::atomic::{AtomicBool, Ordering};
use std::thread;

use crossterm::terminal::{disable_raw_mode, enable_raw_mode};

/// Alternate screen, no cursor, pastes marked as such; empty, since a terminal without
/// an alternate screen (the Linux console) still shows what was there.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[2J";
/// The frame that may be open, then the same way back.
const LEAVE: &[u8] = b"\x1b[?2026l\x1b[?2004l\x1b[0m\x1b[?25h\x1b[?1049l";

static ENTERED: AtomicBool = AtomicBool::new(false);

/// The terminal, written to without locks: a panic may come while one is held.
static TERMINAL: OnceLock<File> = OnceLock::new();

/// Holds the terminal in raw mode on the alternate screen; gives it back when
/// dropped.
#[derive(Debug)]
pub struct Guard(());

impl Guard {
    /// Takes the terminal.
    ///
    /// # Errors
    /// When it cannot be had.
    pub fn take() -> io::Result<Guard> {
        let terminal = terminal()?;
        if TERMINAL.set(terminal).is_err() {
            // Taken before in this process: the same terminal serves.
        }
        enter()?;
        Ok(Guard(()))
    }
}

impl Drop for Guard {
    fn drop(&mut self) {
        leave();
    }
}

/// The terminal as a file of its own.
///
/// # Errors
/// When the process has no room for another file.
#[cfg(unix)]
pub fn terminal() -> io::Result<File> {
    use std::os::fd::AsFd;
    Ok(File::from(io::stdout().as_fd().try_clone_to_owned()?))
}

/// The terminal as a file of its own.
///
/// # Errors
/// When the process has no room for another file.
#[cfg(windows)]
pub fn terminal() -> io::Result<File> {
    use std::os::windows::io::AsHandle;
    Ok(File::from(io::stdout().as_handle().try_clone_to_owned()?))
}

/// Raw mode and the alternate screen.
///
/// # Errors
/// When the terminal refuses.
pub fn enter() -> io::Result<()> {
    ENTERED.store(true, Ordering::SeqCst);
    enable_raw_mode()?;
    TERMINAL
        .get()
        .map_or(Ok(()), |mut terminal| terminal.write_all(ENTER))
}

/// Everything as it was. May be called at any time and more than once; a dead
/// terminal is no reason to complain.
pub fn leave() {
    if ENTERED.swap(false, Ordering::SeqCst) {
        drop_queue();
        if let Some(mut terminal) = TERMINAL.get() {
            let _ = terminal.write_all(LEAVE);
        }
        let _ = disable_raw_mode();
    }
}

/// Drops the bytes that wait on a slow link: they belong to a screen that is being
/// left, and the way back shall not wait for them.
pub fn drop_queue() {
    #[cfg(unix)]
    let _ = rustix::termios::tcflush(io::stdout(), rustix::termios::QueueSelector::OFlush);
}

/// For a terminal that takes no more bytes: its mode only, which needs none.
pub fn leave_without_writing() {
    if ENTERED.swap(false, Ordering::SeqCst) {
        let _ = disable_raw_mode();
    }
}

/// A panic of this thread gives the terminal back before it is told. A panic of
/// another thread is told on the screen by whoever looks after that thread, and
/// must not touch the terminal.
pub fn hook_panics() {
    let screen_thread = thread::current().id();
    let told = panic::take_hook();
    panic::set_hook(Box::new(move |panic| {
        if thread::current().id() == screen_thread {
            leave();
            told(panic);
        } else if !ENTERED.load(Ordering::SeqCst) {
            told(panic);
        }
    }));
}
