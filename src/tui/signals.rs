//! Signals, and a terminal that goes away.

/// What the system asks of the screen thread.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Signal {
    /// Give the terminal back and stop.
    Stop,
    /// Stopped before, running again.
    Continue,
    /// Give the terminal back and end, with exit code 128 + n.
    End(i32),
}

/// What a vanished terminal counts as.
pub const HANGUP: i32 = 1;

#[cfg(unix)]
pub use unix::{stop_job, stop_now, watch};

#[cfg(unix)]
mod unix {
    use std::io;
    use std::thread;
    use std::time::Duration;

    use crossbeam_channel::{Receiver, Sender, bounded};
    use rustix::event::{PollFd, PollFlags, poll};
    use rustix::process::{getpid, kill_current_process_group, kill_process};
    use signal_hook::consts::{SIGCONT, SIGHUP, SIGINT, SIGTERM, SIGTSTP};
    use signal_hook::iterator::Signals;
    use signal_hook::low_level::emulate_default_handler;

    use super::{HANGUP, Signal};
    use crate::tui::guard;

    /// The screen thread has this long to end by itself, twice.
    const PATIENCE: Duration = Duration::from_millis(300);

    /// Starts to watch signals and the terminal.
    ///
    /// # Errors
    /// When the system refuses a handler or a thread.
    pub fn watch() -> io::Result<Receiver<Signal>> {
        let (sender, receiver) = bounded(16);
        let mut signals = Signals::new([SIGTERM, SIGINT, SIGHUP, SIGTSTP, SIGCONT])?;
        let hangups = sender.clone();
        thread::Builder::new()
            .name("signals".into())
            .spawn(move || {
                for signal in signals.forever() {
                    match signal {
                        SIGTSTP => tell(&sender, Signal::Stop),
                        SIGCONT => tell(&sender, Signal::Continue),
                        number => end(&sender, number),
                    }
                }
            })?;
        thread::Builder::new()
            .name("hangup".into())
            .spawn(move || {
                wait_for_hangup();
                end(&hangups, HANGUP);
            })?;
        Ok(receiver)
    }

    fn tell(sender: &Sender<Signal>, signal: Signal) {
        // A full channel holds the same already.
        let _ = sender.try_send(signal);
    }

    /// Asks the screen thread to end. When it waits for a terminal that takes no more
    /// bytes, what is queued is dropped; when that does not help, the process ends.
    fn end(sender: &Sender<Signal>, number: i32) {
        tell(sender, Signal::End(number));
        let _ = thread::Builder::new()
            .name("impatience".into())
            .spawn(move || {
                thread::sleep(PATIENCE);
                guard::drop_queue();
                // Room in the queue wakes no writer, but a signal does.
                let _ = kill_process(getpid(), rustix::process::Signal::CONT);
                thread::sleep(PATIENCE);
                guard::leave_without_writing();
                std::process::exit(128 + number);
            });
    }

    /// Returns when the terminal has gone. No event is asked for, so that only its
    /// end wakes this thread.
    fn wait_for_hangup() {
        let terminal = rustix::stdio::stdin();
        loop {
            let mut watched = [PollFd::new(&terminal, PollFlags::empty())];
            match poll(&mut watched, None) {
                Ok(0) | Err(rustix::io::Errno::INTR) => {}
                Ok(_) | Err(_) => return,
            }
        }
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
pub use elsewhere::{stop_job, stop_now, watch};

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

    /// There are no jobs to stop.
    pub fn stop_job() {}

    /// There are no jobs to stop.
    pub fn stop_now() {}
}
