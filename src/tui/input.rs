//! What the terminal says: keys, pastes, and receipts, which are no keys.

#[cfg(unix)]
mod parser;

use std::io;
use std::thread;
use std::time::Instant;

use crossbeam_channel::{Receiver, Sender, bounded, unbounded};
use crossterm::event::Event;

use super::keys;

/// Keys that wait for a busy screen: more than anybody types, since what is not read has no
/// time, by which an Esc alone is told from a sequence, and the end of a paste.
const KEYS: usize = 1 << 16;

/// What is heard of the terminal.
#[derive(Debug)]
pub struct Heard {
    /// Keys, pastes and sizes; ends with the terminal.
    pub events: Receiver<Event>,
    /// Answers to the question how the terminal is.
    pub receipts: Receiver<()>,
    /// Ctrl-C, which does not wait for the keys before it.
    pub leave: Receiver<()>,
}

/// Listens to the terminal in a thread of its own.
///
/// # Errors
/// When the system refuses one.
pub fn listen() -> io::Result<Heard> {
    let (events, heard) = bounded(KEYS);
    let (receipts, given) = unbounded();
    let (leave, left) = unbounded();
    thread::Builder::new()
        .name("input".into())
        .spawn(move || read(&events, &receipts, &leave))?;
    Ok(Heard {
        events: heard,
        receipts: given,
        leave: left,
    })
}

/// Reads until the terminal or the screen thread has gone. The question whether there is
/// something to read is asked each time anew, so that no wake-up can be missed.
#[cfg(unix)]
fn read(events: &Sender<Event>, receipts: &Sender<()>, leave: &Sender<()>) {
    use parser::{Parser, Said};
    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::io::Errno;

    let terminal = rustix::stdio::stdin();
    let mut parser = Parser::new(Instant::now());
    let mut buffer = [0; 4096];
    loop {
        let limit = parser.deadline().map(|deadline| {
            let left = deadline.saturating_duration_since(Instant::now());
            Timespec {
                tv_sec: 0,
                tv_nsec: left.subsec_nanos().into(),
            }
        });
        let mut watched = [PollFd::new(&terminal, PollFlags::IN)];
        let said = match poll(&mut watched, limit.as_ref()) {
            Ok(0) => parser.expire(),
            Ok(_) => match rustix::io::read(terminal, &mut buffer) {
                Ok(count @ 1..) => parser.feed(&buffer[..count], Instant::now()),
                Err(Errno::INTR | Errno::AGAIN) => continue,
                // Its end, or that it has gone.
                Ok(0) | Err(_) => return,
            },
            Err(Errno::INTR) => continue,
            Err(_) => return,
        };
        for said in said {
            let sent = match said {
                Said::Event(event) if keys::is_ctrl_c(&event) => leave.send(()).is_ok(),
                Said::Event(event) => events.send(event).is_ok(),
                Said::Receipt => receipts.send(()).is_ok(),
            };
            if !sent {
                return;
            }
        }
    }
}

#[cfg(not(unix))]
fn read(events: &Sender<Event>, _receipts: &Sender<()>, leave: &Sender<()>) {
    while let Ok(event) = crossterm::event::read() {
        let sent = if keys::is_ctrl_c(&event) {
            leave.send(()).is_ok()
        } else {
            events.send(event).is_ok()
        };
        if !sent {
            return;
        }
    }
}
