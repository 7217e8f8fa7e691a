//! Signals, and a terminal that goes away.

/// What the system asks of the screen thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Give the terminal back and stop.
    Stop,
    /// Stopped before, running again.
    Continue,
    /// The terminal has another size.
    Resized,
    /// Give the terminal back and end, with exit code 128 + n.
    End(i32),
}

/// What a vanished terminal counts as.
pub const HANGUP: i32 = 1;

#[cfg(unix)]
pub use unix::{can_be_continued, stop_job, stop_now, watch};

#[cfg(unix)]
mod unix {
    use std::io;
    use std::thread;
    use std::time::Duration;

    use crossbeam_channel::{Receiver, Sender, bounded};
    use nix::unistd::{getpgrp, getsid};
    use rustix::process::kill_current_process_group;
    use signal_hook::consts::{
        SIGABRT, SIGALRM, SIGCONT, SIGHUP, SIGINT, SIGPROF, SIGQUIT, SIGTERM, SIGTSTP, SIGUSR1,
        SIGUSR2, SIGVTALRM, SIGWINCH, SIGXCPU, SIGXFSZ,
    };
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::{emulate_default_handler, register};

    use super::Signal;
    use crate::tui::guard;

    /// Signals that would end the program, and do so after the terminal is given back.
    const ENDS: &[i32] = &[
        SIGTERM, SIGINT, SIGHUP, SIGQUIT, SIGUSR1, SIGUSR2, SIGALRM, SIGVTALRM, SIGPROF, SIGXCPU,
        SIGXFSZ,
    ];

    /// The screen thread has this long to end by itself.
    const PATIENCE: Duration = Duration::from_millis(1500);

    /// Starts to watch signals.
    ///
    /// # Errors
    /// When the system refuses a handler or a thread.
    pub fn watch() -> io::Result<Receiver<Signal>> {
        let (sender, receiver) = bounded(16);
        let mut signals = Signals::new([SIGTSTP, SIGCONT, SIGWINCH].iter().chain(ENDS))?;
        thread::Builder::new()
            .name("signals".into())
            .spawn(move || {
                for signal in signals.forever() {
                    match signal {
                        SIGTSTP => tell(&sender, Signal::Stop),
                        SIGCONT => tell(&sender, Signal::Continue),
                        SIGWINCH => tell(&sender, Signal::Resized),
                        number => end(&sender, number),
                    }
                }
            })?;
        leave_on_abort()?;
        Ok(receiver)
    }

    /// Has a failed allocation, which ends the program by SIGABRT at once, leave the terminal
    /// whole: no other thread gets a chance after the handler returns.
    #[allow(unsafe_code, reason = "proved below")]
    fn leave_on_abort() -> io::Result<()> {
        let give_back_and_end = || {
            guard::leave_at_once();
            // Somebody else's signal does not end the program by itself any more.
            let _ = emulate_default_handler(SIGABRT);
        };
        // SAFETY: a handler must do only what is safe at any point of the program.
        // `leave_at_once` reads and swaps atomics, and calls write(2), tcflush(3) and
        // tcsetattr(3), all on POSIX's list of functions that are; it allocates nothing, takes
        // no lock, and does not panic. `emulate_default_handler` is documented to be safe in a
        // handler. Neither returns to a program whose state is in doubt.
        unsafe { register(SIGABRT, give_back_and_end) }.map(|_| ())
    }

    fn tell(sender: &Sender<Signal>, signal: Signal) {
        // A full channel holds the same already.
        let _ = sender.try_send(signal);
    }

    /// Asks the screen thread to end; when it does not, the process ends.
    fn end(sender: &Sender<Signal>, number: i32) {
        tell(sender, Signal::End(number));
        let _ = thread::Builder::new()
            .name("impatience".into())
            .spawn(move || {
                thread::sleep(PATIENCE);
                guard::leave_without_writing();
                std::process::exit(128 + number);
            });
    }

    /// Whether a shell looks after this job, and can have it go on once it has stopped. The
    /// group of the session's leader (`ssh -t host beadlab`, `xterm -e beadlab`) is nobody's job.
    /// A leader or a group in another process namespace (a container's `unshare`, `nsenter`) has
    /// the number 0 here: where both are there, nothing is known, and the answer is no.
    pub fn can_be_continued() -> bool {
        getsid(None).is_ok_and(|leader| leader != getpgrp())
    }

    /// Stops the whole job, as Ctrl-Z does on a terminal that is not in raw mode:
    /// whoever started this program stops with it.
    pub fn stop_job() {
        if kill_current_process_group(rustix::process::Signal::TSTP).is_err() {
            stop_now();
        }
    }

    /// Stops this process.
    pub fn stop_now() {
        let _ = emulate_default_handler(SIGTSTP);
    }
}

#[cfg(not(unix))]
pub use elsewhere::{can_be_continued, stop_job, stop_now, watch};

#[cfg(not(unix))]
mod elsewhere {
    use std::io;

    use crossbeam_channel::{Receiver, never};

    use super::Signal;

    /// There are no signals to watch.
    ///
    /// # Errors
    /// None.
    pub fn watch() -> io::Result<Receiver<Signal>> {
        Ok(never())
    }

    /// There are no jobs.
    pub fn can_be_continued() -> bool {
        false
    }

    /// There are no jobs to stop.
    pub fn stop_job() {}

    /// There are no jobs to stop.
    pub fn stop_now() {}
}
