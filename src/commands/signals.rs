//! Signals that end a command: a sweep at a row, all others at once, but with nothing
//! left behind that is not finished.

use super::Failure;
use super::output;
use std::io::{self, IsTerminal, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};

/// Whether a signal came, and which.
pub(super) struct Interrupt {
    flag: Arc<AtomicBool>,
    signal: Arc<AtomicUsize>,
}

impl Interrupt {
    /// Begins to listen. A second signal ends the program at once, which costs no row.
    pub fn watch() -> Self {
        let interrupt = Self {
            flag: Arc::default(),
            signal: Arc::default(),
        };
        interrupt.register();
        interrupt
    }

    /// Set once a signal came; may be set for other reasons too.
    pub fn flag(&self) -> &AtomicBool {
        &self.flag
    }

    /// The signal's number; 2 before one came.
    pub fn signal(&self) -> u8 {
        match u8::try_from(self.signal.load(Ordering::Relaxed)) {
            Ok(number) if number > 0 => number,
            _ => 2,
        }
    }

    #[cfg(unix)]
    fn register(&self) {
        use signal_hook::flag;

        for signal in unix::heeded() {
            let number = usize::try_from(signal).unwrap_or(0);
            // Where the system refuses, the signal ends the program as it always did.
            let _ =
                flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&self.flag))
                    .and_then(|_| flag::register_usize(signal, Arc::clone(&self.signal), number))
                    .and_then(|_| flag::register(signal, Arc::clone(&self.flag)));
        }
    }

    #[cfg(not(unix))]
    fn register(&self) {}
}

/// From now on a signal ends the program with the files removed that are not finished;
/// a second one ends it at once.
///
/// # Errors
/// [`Failure::Failed`] when the system refuses a handler or a thread.
#[cfg(unix)]
pub(super) fn leave_nothing_behind() -> Result<(), Failure> {
    unix::watch().map_err(|error| Failure::Failed(format!("signals cannot be watched: {error}")))
}

/// There are no signals to watch.
///
/// # Errors
/// None.
#[cfg(not(unix))]
pub(super) fn leave_nothing_behind() -> Result<(), Failure> {
    Ok(())
}

#[cfg(unix)]
mod unix {
    use super::{Arc, AtomicBool, IsTerminal, Write, io, output};
    use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
    use signal_hook::flag;
    use signal_hook::iterator::Signals;
    use std::thread;

    /// The signals that end a command: not those that whoever started it wants ignored,
    /// as `nohup` does with SIGHUP, and a shell with SIGINT of what runs behind a script.
    pub fn heeded() -> Vec<i32> {
        let ignored = ignored();
        let is_heeded = |signal: &i32| ignored & (1 << (signal - 1)) == 0;
        let ending = [SIGINT, SIGTERM, SIGHUP];
        ending.into_iter().filter(is_heeded).collect()
    }

    /// A bit for every signal that is ignored, the lowest for signal 1. Only Linux tells
    /// this without a call that is unsafe; elsewhere none is known to be.
    fn ignored() -> u64 {
        let status = std::fs::read_to_string("/proc/self/status").unwrap_or_default();
        let mask = status.lines().find_map(|line| line.strip_prefix("SigIgn:"));
        mask.and_then(|mask| u64::from_str_radix(mask.trim(), 16).ok())
            .unwrap_or(0)
    }

    pub fn watch() -> io::Result<()> {
        let came = Arc::new(AtomicBool::new(false));
        for signal in heeded() {
            flag::register_conditional_shutdown(signal, 128 + signal, Arc::clone(&came))?;
            flag::register(signal, Arc::clone(&came))?;
        }
        let mut signals = Signals::new(heeded())?;
        let wait = move || {
            if let Some(signal) = signals.forever().next() {
                end(signal);
            }
        };
        thread::Builder::new()
            .name("signals".into())
            .spawn(wait)
            .map(drop)
    }

    fn end(signal: i32) {
        let removed = output::remove_unfinished();
        let mut stderr = io::stderr();
        // Over a bar that may be there.
        let clear = if stderr.is_terminal() {
            "\r\x1b[2K"
        } else {
            ""
        };
        let kept = if removed > 0 {
            ": no file is changed"
        } else {
            ""
        };
        // Nobody may be listening any more.
        let _ = writeln!(stderr, "{clear}beadlab: stopped{kept}");
        std::process::exit(128 + signal);
    }
}
