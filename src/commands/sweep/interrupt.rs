//! Signals that end a sweep at a row.

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
        use signal_hook::consts::{SIGHUP, SIGINT, SIGTERM};
        use signal_hook::flag;

        for signal in [SIGINT, SIGTERM, SIGHUP] {
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
