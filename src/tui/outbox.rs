//! Frames on their way to the terminal.
//!
//! A thread of its own writes them, so that keys work while a terminal takes no bytes. After
//! each frame the terminal is asked how it is: its answer is the receipt for all that came
//! before, however many queues lie between.

use std::io::{self, Write};
use std::sync::Arc;
use std::sync::atomic::{AtomicU64, Ordering};
use std::thread;

use crossbeam_channel::{Receiver, Sender, unbounded};
use crossterm::Command;
use crossterm::clipboard::CopyToClipboard;

/// How the terminal is asked for a receipt (device status report, `CSI 5 n`; it answers
/// `CSI 0 n`): tmux and screen answer themselves, long before the terminal that shows them
/// has read anything, unless the question is wrapped to be passed on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum StatusRequest {
    /// To the terminal itself.
    Plain,
    /// Through tmux, whose pane must allow it.
    Tmux,
    /// Through screen.
    Screen,
}

impl StatusRequest {
    /// The one that suits the variables of the environment.
    pub fn detect(variable: impl Fn(&str) -> Option<String>) -> StatusRequest {
        let is_set = |name| variable(name).is_some_and(|value| !value.is_empty());
        if is_set("TMUX") {
            StatusRequest::Tmux
        } else if is_set("STY") {
            StatusRequest::Screen
        } else {
            StatusRequest::Plain
        }
    }

    /// As it is written.
    pub fn bytes(self) -> Vec<u8> {
        self.wrapped(b"\x1b[5n")
    }

    /// A sequence on its way to the terminal itself.
    fn wrapped(self, sequence: &[u8]) -> Vec<u8> {
        match self {
            StatusRequest::Plain => sequence.to_vec(),
            StatusRequest::Tmux => {
                let doubled = sequence.iter().flat_map(|&byte| {
                    let count = if byte == 0x1b { 2 } else { 1 };
                    std::iter::repeat_n(byte, count)
                });
                let inner: Vec<u8> = doubled.collect();
                [&b"\x1bPtmux;"[..], &inner, b"\x1b\\"].concat()
            }
            StatusRequest::Screen => [&b"\x1bP"[..], sequence, b"\x1b\\"].concat(),
        }
    }
}

/// Where frames are put; clones lead to the same terminal.
#[derive(Debug, Clone)]
pub struct Outbox {
    frames: Sender<Vec<u8>>,
    frame: Vec<u8>,
    question: StatusRequest,
    sent: Arc<AtomicU64>,
    written: Arc<AtomicU64>,
}

impl Outbox {
    /// An outbox, and the frames that are put into it.
    pub fn new(question: StatusRequest) -> (Outbox, Receiver<Vec<u8>>) {
        let (frames, receiver) = unbounded();
        let outbox = Outbox {
            frames,
            frame: Vec::new(),
            question,
            sent: Arc::default(),
            written: Arc::default(),
        };
        (outbox, receiver)
    }

    /// An outbox whose frames a thread puts on the terminal by `write`, whole; what
    /// comes after a failed write is dropped.
    ///
    /// # Errors
    /// When the system refuses a thread.
    pub fn spawn(
        question: StatusRequest,
        mut write: impl FnMut(&[u8]) -> io::Result<()> + Send + 'static,
    ) -> io::Result<Outbox> {
        let (outbox, frames) = Outbox::new(question);
        let told = outbox.clone();
        thread::Builder::new()
            .name("output".into())
            .spawn(move || {
                for frame in frames {
                    if write(&frame).is_err() {
                        return;
                    }
                    told.wrote(frame.len());
                }
            })?;
        Ok(outbox)
    }

    /// Asks for a receipt of what was sent so far.
    pub fn ask(&mut self) {
        self.send(self.question.bytes());
    }

    /// Asks the terminal to keep a text for pasting (OSC 52). Terminals that do not know
    /// this, or are told not to, do nothing.
    pub fn copy(&mut self, text: &str) {
        let mut sequence = String::new();
        let command = CopyToClipboard::to_clipboard_from(text);
        if command.write_ansi(&mut sequence).is_ok() {
            // A string terminator would end what it is wrapped in; a bell ends it as well.
            let open = sequence.strip_suffix("\x1b\\").unwrap_or(&sequence);
            self.send(self.question.wrapped(format!("{open}\x07").as_bytes()));
        }
    }

    /// So many more bytes have been written.
    pub(super) fn wrote(&self, bytes: usize) {
        self.written.fetch_add(bytes as u64, Ordering::Release);
    }

    /// Bytes that were sent so far.
    pub fn sent(&self) -> u64 {
        self.sent.load(Ordering::Acquire)
    }

    /// Whether the terminal's nearest queue has taken all that was sent.
    pub fn is_written(&self) -> bool {
        self.written.load(Ordering::Acquire) >= self.sent()
    }

    fn send(&mut self, frame: Vec<u8>) {
        self.sent.fetch_add(frame.len() as u64, Ordering::AcqRel);
        // A thread that has ended had a dead terminal, and that is noticed elsewhere.
        let _ = self.frames.send(frame);
    }
}

impl Write for Outbox {
    fn write(&mut self, buffer: &[u8]) -> io::Result<usize> {
        self.frame.extend_from_slice(buffer);
        Ok(buffer.len())
    }

    /// Sends what was written since the last time as a frame, and asks for its receipt.
    fn flush(&mut self) -> io::Result<()> {
        if !self.frame.is_empty() {
            let mut frame = std::mem::take(&mut self.frame);
            frame.extend_from_slice(&self.question.bytes());
            self.send(frame);
        }
        Ok(())
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// What is to be pasted later comes whole to the terminal behind tmux and screen: within
    /// the wrapping, which ends at the first string terminator, there is none.
    #[test]
    fn what_is_copied_ends_within_its_wrapping() {
        let copied = |question| {
            let (mut outbox, frames) = Outbox::new(question);
            outbox.copy("beadlab fig5b");
            String::from_utf8(frames.recv().expect("a frame")).expect("ASCII")
        };
        let plain = copied(StatusRequest::Plain);
        // "beadlab fig5b" in base 64.
        assert_eq!(plain, "\x1b]52;c;YmVhZGxhYiBmaWc1Yg==\x07");
        let screen = copied(StatusRequest::Screen);
        assert_eq!(screen, format!("\x1bP{plain}\x1b\\"));
        let tmux = copied(StatusRequest::Tmux);
        assert_eq!(tmux, format!("\x1bPtmux;\x1b{plain}\x1b\\"));
    }
}
