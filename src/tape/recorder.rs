//! What writes a tape as the session goes.

use super::Edit;
use super::line::{Sums, TapeLine, VERSION};
use crate::scene::Scene;
use std::io::{self, Write};

/// Writes a tape, a line at a time, each handed to the system at once: what was written stays
/// whatever becomes of the program.
pub struct Recorder {
    sink: Box<dyn Write + Send>,
    sums: Sums,
}

impl Recorder {
    /// Begins a tape.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn begin(sink: Box<dyn Write + Send>) -> io::Result<Recorder> {
        let mut recorder = Recorder {
            sink,
            sums: Sums::default(),
        };
        recorder.write(&TapeLine::Tape {
            version: VERSION,
            program: env!("CARGO_PKG_VERSION").to_owned(),
        })?;
        Ok(recorder)
    }

    /// Columns start at t = 0.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn start(&mut self, scenes: &[Scene]) -> io::Result<()> {
        let columns = texts(scenes);
        self.write(&TapeLine::Start { columns })
    }

    /// An edit acts.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn edit(&mut self, edit: &Edit) -> io::Result<()> {
        self.write(&TapeLine::Edit {
            time: edit.time,
            columns: texts(&edit.scenes),
            from: edit.from.clone(),
        })
    }

    /// The session goes on from `time`, s, after so many edits.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn back(&mut self, time: f64, edits: usize) -> io::Result<()> {
        self.write(&TapeLine::Back { time, edits })
    }

    /// The columns have come to `time`, s, and are in these states.
    ///
    /// # Errors
    /// When it cannot be written.
    pub fn state(&mut self, time: f64, hashes: Vec<String>) -> io::Result<()> {
        self.write(&TapeLine::State { time, hashes })
    }

    fn write(&mut self, line: &TapeLine) -> io::Result<()> {
        let text = self.sums.write(line);
        self.sink.write_all(text.as_bytes())?;
        self.sink.flush()
    }
}

fn texts(scenes: &[Scene]) -> Vec<String> {
    scenes.iter().map(Scene::to_toml).collect()
}
