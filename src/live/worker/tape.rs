//! The tape: what is written of the session, and what is played again.

use std::io;

use super::Worker;
use crate::live::past::Position;
use crate::live::recording::{Played, Recording, Written};
use crate::live::runner::Runner;
use crate::tape::Tape;

impl Worker {
    /// Time between two states on a tape: a period of the plate, or else the first page.
    pub(super) fn marks_apart(&self) -> f64 {
        let scene = self.position.runners.first().map(Runner::scene);
        let period = scene.and_then(|scene| scene.period());
        period.unwrap_or(self.sweep.span)
    }

    /// Writes a tape from now on, of all that was too; or ends the one that is written.
    pub(super) fn record(&mut self, recording: Option<&Recording>) {
        self.end_tape();
        let Some(recording) = recording else {
            return;
        };
        let (scenes, edits, end) = (self.past.scenes(), self.past.edits(), self.past.end());
        match Written::begin(recording, scenes, edits, end, self.marks_apart()) {
            Ok(written) => self.written = written,
            Err(error) => self.notes.push(format!("no recording: {error}")),
        }
    }

    /// The state that the columns have come to is the last on the tape.
    pub(super) fn end_tape(&mut self) {
        if self.written.is_some() {
            self.align();
            // Gone back, it is in a state that is on the tape already, or between two.
            if self.position.reached >= self.past.end() {
                self.write(Written::state);
            }
            self.written = None;
        }
    }

    /// Writes on, where a tape is written; one that takes no more is ended.
    pub(super) fn write(
        &mut self,
        what: impl FnOnce(&mut Written, &mut Position) -> io::Result<()>,
    ) {
        let Some(written) = &mut self.written else {
            return;
        };
        if let Err(error) = what(written, &mut self.position) {
            self.written = None;
            self.notes.push(format!("the recording ends here: {error}"));
        }
    }

    /// Plays a tape from its start.
    pub(super) fn play(&mut self, tape: &Tape) {
        self.restart(tape.scenes.clone());
        self.past.foretell(tape);
        self.played = Some(Played::new(tape));
    }

    /// The next time at which states are written or compared, s.
    pub(super) fn next_mark(&self) -> f64 {
        let reached = self.position.reached;
        let written = self.written.as_ref().map_or(f64::INFINITY, Written::next);
        let played = self.played.as_ref().map(|played| played.next(reached));
        let later = if written > reached {
            written
        } else {
            f64::INFINITY
        };
        later.min(played.unwrap_or(f64::INFINITY))
    }

    /// Writes and compares the states that are due now.
    pub(super) fn mark(&mut self) {
        let due = |written: &Written| written.next() <= self.position.reached;
        if self.written.as_ref().is_some_and(due) {
            self.write(Written::state);
        }
        if let Some(played) = &mut self.played {
            self.notes.extend(played.compare(&mut self.position));
        }
    }
}
