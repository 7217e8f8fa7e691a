//! The terminal is given back as it was found, whatever happens.

use std::io;
use std::panic;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Mutex, OnceLock, TryLockError};
use std::thread;
use std::time::{Duration, Instant};

use super::tty::Tty;

/// Alternate screen, no cursor, pastes marked as such; empty, since a terminal without
/// an alternate screen (the Linux console) still shows what was there.
const ENTER: &[u8] = b"\x1b[?1049h\x1b[?25l\x1b[?2004h\x1b[2J";
/// The frame that may be open, then the same way back.
const LEAVE: &[u8] = b"\x1b[?2026l\x1b[?2004l\x1b[0m\x1b[?25h\x1b[?1049l";

/// A terminal that takes no bytes for so long gets no farewell.
const FAREWELL: Duration = Duration::from_millis(300);
/// How soon to look again whether the terminal takes bytes.
const RETRY: Duration = Duration::from_millis(20);

/// Whether the alternate screen is shown, and frames may be written.
static SHOWN: AtomicBool = AtomicBool::new(false);
/// Whether the terminal is in raw mode.
static RAW: AtomicBool = AtomicBool::new(false);
static TERMINAL: OnceLock<Tty> = OnceLock::new();
/// Held while a frame is written. What is written without it comes in a panic, or from
/// whoever can wait no longer.
static WRITING: Mutex<()> = Mutex::new(());

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
        let terminal = Tty::open()?;
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

/// Raw mode and the alternate screen.
///
/// # Errors
/// When the terminal refuses.
pub fn enter() -> io::Result<()> {
    let Some(terminal) = TERMINAL.get() else {
        return Ok(());
    };
    RAW.store(true, Ordering::SeqCst);
    terminal.make_raw()?;
    SHOWN.store(true, Ordering::SeqCst);
    put(terminal, ENTER, || SHOWN.load(Ordering::SeqCst))
}

/// Writes a frame, whole, unless the screen is left meanwhile: then what is left of it is
/// dropped.
///
/// # Errors
/// When the terminal has gone.
pub fn write(frame: &[u8]) -> io::Result<()> {
    let _writing = WRITING.lock();
    TERMINAL.get().map_or(Ok(()), |terminal| {
        put(terminal, frame, || SHOWN.load(Ordering::SeqCst))
    })
}

/// Writes bytes `while` it is worth waiting for the terminal to take them.
fn put(terminal: &Tty, mut bytes: &[u8], going_on: impl Fn() -> bool) -> io::Result<()> {
    while !bytes.is_empty() && going_on() {
        match terminal.write(bytes) {
            Ok(count) => bytes = &bytes[count..],
            Err(error) if error.kind() == io::ErrorKind::Interrupted => {}
            Err(error) if error.kind() == io::ErrorKind::WouldBlock => terminal.wait(RETRY),
            Err(error) => return Err(error),
        }
    }
    Ok(())
}

/// The screen as it was. The terminal stays in raw mode, so that its last answers are not
/// taken for what somebody types to the shell. May be called at any time and more than once;
/// a dead terminal is no reason to complain.
pub fn leave_screen() {
    if SHOWN.swap(false, Ordering::SeqCst)
        && let Some(terminal) = TERMINAL.get()
    {
        let start = Instant::now();
        let patient = || start.elapsed() < FAREWELL;
        // A frame that is being written notices soon.
        let mut writing = WRITING.try_lock();
        while matches!(writing, Err(TryLockError::WouldBlock)) && patient() {
            thread::sleep(RETRY / 4);
            writing = WRITING.try_lock();
        }
        // Bytes that wait on a slow link belong to the screen that is being left, and the
        // way back shall not wait for them.
        terminal.drop_queue();
        let _ = put(terminal, LEAVE, patient);
    }
}

/// Everything as it was.
pub fn leave() {
    leave_screen();
    leave_without_writing();
}

/// For a terminal that takes no more bytes: its mode only, which needs none.
pub fn leave_without_writing() {
    if RAW.swap(false, Ordering::SeqCst)
        && let Some(terminal) = TERMINAL.get()
    {
        terminal.restore();
    }
}

/// All that is possible from within a signal's handler, where nothing may be waited for, and
/// nothing allocated: [`Tty::write`] and [`Tty::restore`] are single calls of the system.
pub fn leave_at_once() {
    if let Some(terminal) = TERMINAL.get() {
        if SHOWN.swap(false, Ordering::SeqCst) {
            let _ = terminal.write(LEAVE);
        }
        if RAW.swap(false, Ordering::SeqCst) {
            terminal.restore();
        }
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
        } else if !SHOWN.load(Ordering::SeqCst) {
            told(panic);
        }
    }));
}
