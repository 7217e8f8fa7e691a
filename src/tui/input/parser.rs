//! Bytes of a terminal, as keys and receipts.
//!
//! The grammar of control sequences is [`vte`]'s, a terminal emulator's; here is what a
//! terminal sends in it. A sequence that does not end in time is dropped, an unknown one
//! ignored: neither swallows the keys that follow, nor acts as one.

mod listener;

use std::time::{Duration, Instant};

use crossterm::event::Event;
use listener::{LastByte, Listener};

/// A lone Esc is a key after this time. A terminal sends its sequences at once.
const ESCAPE: Duration = Duration::from_millis(50);
/// A sequence that has not ended after this time will not.
const SEQUENCE: Duration = Duration::from_millis(250);
/// Links deliver long pastes in pieces.
const PASTE: Duration = Duration::from_millis(400);

const ESC: u8 = 0x1b;
const CTRL_C: u8 = 3;

/// What a terminal has said.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Said {
    /// A key, or a paste.
    Event(Event),
    /// It has read all that was written before the question.
    Receipt,
}

/// The beginning of a sequence.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Default)]
enum Pending {
    /// None.
    #[default]
    Nothing,
    /// Esc alone.
    Escape,
    /// Esc at the end of a string, whose terminator it begins.
    End,
    /// Esc and a character that begins a sequence, or was typed with Alt.
    Introduced(u8),
    /// More of it.
    Open,
}

/// Takes bytes apart.
pub struct Parser {
    grammar: vte::Parser,
    pending: Pending,
    /// When the last sequence began.
    since: Instant,
    /// When the last text came.
    pasted: Instant,
    listener: Listener,
}

impl Parser {
    /// One that has heard nothing.
    pub fn new(now: Instant) -> Parser {
        Parser {
            grammar: vte::Parser::new(),
            pending: Pending::Nothing,
            since: now,
            pasted: now,
            listener: Listener::default(),
        }
    }

    /// What further bytes say.
    pub fn feed(&mut self, bytes: &[u8], now: Instant) -> Vec<Said> {
        if self.deadline().is_some_and(|deadline| now >= deadline) {
            self.give_up();
        }
        for &byte in bytes {
            if byte == ESC {
                self.since = now;
            }
            self.take(byte);
            // An answer in its midst does not make a paste last.
            if self.listener.last_byte != LastByte::Receipt && self.pending == Pending::Nothing {
                self.pasted = now;
            }
        }
        self.said()
    }

    /// When to wait no longer for the rest of what has begun; for ever if nothing has.
    pub fn deadline(&self) -> Option<Instant> {
        match self.pending {
            Pending::Escape | Pending::End => Some(self.since + ESCAPE),
            Pending::Introduced(_) | Pending::Open => Some(self.since + SEQUENCE),
            Pending::Nothing if self.listener.paste.is_some() => Some(self.pasted + PASTE),
            Pending::Nothing if self.listener.skip > 0 => Some(self.since + SEQUENCE),
            Pending::Nothing => None,
        }
    }

    /// What it means that nothing has come until the deadline.
    pub fn expire(&mut self) -> Vec<Said> {
        self.give_up();
        self.said()
    }

    fn said(&mut self) -> Vec<Said> {
        std::mem::take(&mut self.listener.said)
    }

    fn give_up(&mut self) {
        match self.pending {
            Pending::Escape => self.listener.escape(),
            Pending::Introduced(byte) => self.listener.with_alt(byte),
            Pending::Nothing => self.listener.end_paste(),
            Pending::End | Pending::Open => {}
        }
        self.restart();
    }

    fn restart(&mut self) {
        self.grammar = vte::Parser::new();
        self.pending = Pending::Nothing;
        self.listener.skip = 0;
        self.listener.third = false;
    }

    fn take(&mut self, byte: u8) {
        if byte == CTRL_C {
            // Nothing keeps it from stopping the program, not even an open string.
            self.restart();
            self.listener.paste = None;
        } else if self.pending == Pending::Escape {
            match byte {
                ESC => self.listener.escape(),
                // These would begin a sequence that no terminal sends.
                b' '..=b'/' => {
                    self.restart();
                    return self.listener.with_alt(byte);
                }
                // A key of its own after Esc.
                0..=0x1f | 0x7f.. => {
                    self.listener.escape();
                    self.restart();
                }
                _ => {}
            }
        }
        if byte == ESC {
            self.listener.skip = 0;
            self.listener.third = false;
        }
        self.listener.last_byte = LastByte::Nothing;
        self.grammar.advance(&mut self.listener, &[byte]);
        self.pending = match (self.listener.last_byte, self.pending) {
            (LastByte::String, _) if byte == ESC => Pending::End,
            _ if byte == ESC => Pending::Escape,
            (LastByte::Introducer, _) | (LastByte::Nothing, Pending::Escape) => {
                Pending::Introduced(byte)
            }
            (LastByte::Nothing, Pending::Introduced(_) | Pending::Open | Pending::End) => {
                Pending::Open
            }
            // A control character acts in the midst of a sequence, and ends none.
            (LastByte::Control, pending) => pending,
            _ => Pending::Nothing,
        };
    }
}

#[cfg(test)]
mod tests;
