//! What is written of a session, and what is compared with one that was.

use std::fmt;
use std::io::{self, Write};
use std::sync::{Arc, Mutex, PoisonError};

use super::past::Position;
use super::runner::Runner;
use crate::scene::Scene;
use crate::tape::{self, Edit, Recorder, StateMark, Tape};

/// Where a tape is to be written, to be taken once.
#[derive(Clone)]
pub struct Recording(Arc<Mutex<Option<Box<dyn Write + Send>>>>);

impl Recording {
    /// A tape that is written there.
    pub fn new(sink: Box<dyn Write + Send>) -> Recording {
        Recording(Arc::new(Mutex::new(Some(sink))))
    }

    fn take(&self) -> Option<Box<dyn Write + Send>> {
        self.0.lock().unwrap_or_else(PoisonError::into_inner).take()
    }
}

impl fmt::Debug for Recording {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Recording")
    }
}

/// The states of all columns, as hashes.
fn hashes(position: &mut Position) -> Vec<String> {
    tape::hashes(position.runners.iter_mut().map(Runner::state))
}

/// A tape that is being written.
pub(super) struct Written {
    recorder: Recorder,
    /// Time between two states, s.
    every: f64,
    /// Up to when it is written, s.
    to: f64,
}

impl Written {
    /// Begins with what was so far: the scenes at the start, and edits up to `end`, s.
    pub fn begin(
        recording: &Recording,
        scenes: &[Scene],
        edits: &[Edit],
        end: f64,
        every: f64,
    ) -> io::Result<Option<Written>> {
        let Some(sink) = recording.take() else {
            return Ok(None);
        };
        let mut recorder = Recorder::begin(sink)?;
        recorder.start(scenes)?;
        edits.iter().try_for_each(|edit| recorder.edit(edit))?;
        Ok(Some(Written {
            recorder,
            every,
            to: end,
        }))
    }

    /// Columns start anew.
    pub fn start(&mut self, scenes: &[Scene], every: f64) -> io::Result<()> {
        (self.every, self.to) = (every, 0.0);
        self.recorder.start(scenes)
    }

    /// An edit acts; before it all went back to here, or not.
    pub fn edit(&mut self, edit: &Edit, edits: usize, forked: bool) -> io::Result<()> {
        if forked {
            self.to = edit.time;
            self.recorder.back(edit.time, edits)?;
        }
        self.recorder.edit(edit)
    }

    /// Up to when it is written, s.
    pub fn to(&self) -> f64 {
        self.to
    }

    /// The time at which a state is due next, s.
    pub fn next(&self) -> f64 {
        ((self.to / self.every * (1.0 + 1e-12)).floor() + 1.0) * self.every
    }

    /// Writes the state that the columns are in, if it is a new one.
    pub fn state(&mut self, position: &mut Position) -> io::Result<()> {
        if position.reached <= self.to {
            return Ok(());
        }
        self.to = position.reached;
        self.recorder.state(position.reached, hashes(position))
    }
}

/// A tape that is played again.
pub(super) struct Played {
    marks: Vec<StateMark>,
    /// Whether a state was another one than on the tape.
    pub differs: bool,
}

impl Played {
    pub fn new(tape: &Tape) -> Played {
        Played {
            marks: tape.marks.clone(),
            differs: false,
        }
    }

    /// The next time after `reached`, s, at which the tape has states.
    pub fn next(&self, reached: f64) -> f64 {
        let after = self.marks.partition_point(|mark| mark.time <= reached);
        self.marks
            .get(after)
            .map_or(f64::INFINITY, |mark| mark.time)
    }

    /// Compares the columns with what the tape has of this time; a sentence on the first
    /// difference.
    pub fn compare(&mut self, position: &mut Position) -> Option<String> {
        let (time, edits) = (position.reached, position.edits);
        let from = self.marks.partition_point(|mark| mark.time < time);
        let mut here = self.marks[from..]
            .iter()
            .take_while(|mark| mark.time == time);
        let mark = here.find(|mark| mark.edits == edits)?;
        if self.differs || mark.hashes == hashes(position) {
            return None;
        }
        self.differs = true;
        Some(format!("t = {time} s: other states than on the tape"))
    }

    /// What was played up to these columns goes on otherwise.
    pub fn fork(&mut self, position: &Position) {
        let (time, edits) = (position.reached, position.edits);
        self.marks
            .retain(|mark| mark.time <= time && mark.edits <= edits);
    }
}
