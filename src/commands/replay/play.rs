//! A tape that is played without pictures.

use crate::commands::Failure;
use crate::commands::output::Output;
use crate::commands::progress::Waiting;
use crate::physics::Observation;
use crate::scene::Scene;
use crate::study::export::{Format, is_finite};
use crate::tape::{Replay, Tape};
use std::io::{self, Write};

/// More rows than that are a slip of the hand.
const MOST_ROWS: f64 = 1e8;

/// Whether all was as on the tape.
pub(super) fn verdict(replay: &Replay) -> Result<(), Failure> {
    match replay.differs {
        None => Ok(()),
        Some((time, column)) => Err(Failure::Failed(format!(
            "t = {time} s: column {column} is in another state than on the tape"
        ))),
    }
}

/// Moves on to `until`, s, of `end`, through all that the tape has on the way.
fn go(replay: &mut Replay, tape: &Tape, until: f64, end: f64, waiting: &mut Waiting) {
    replay.go(tape, until, &mut |time| {
        waiting.show("playing", Some(time / end));
    });
}

/// Plays to `end`, s.
pub(super) fn to_the_end(tape: &Tape, end: f64, waiting: &mut Waiting) -> Replay {
    let mut played = Replay::new(tape);
    go(&mut played, tape, end, end, waiting);
    played
}

/// Plays to `end`, s, and writes the motion of a column at every so many seconds.
pub(super) fn motion(
    tape: &Tape,
    end: f64,
    (every, column): (f64, u32),
    format: Format,
    mut output: Output,
    waiting: &mut Waiting,
) -> Result<(), Failure> {
    let rows = (end / every * (1.0 + 1e-12)).floor();
    if rows > MOST_ROWS {
        return Err(Failure::BadInput(format!(
            "--every {every}: makes {rows:.0e} rows, more than {MOST_ROWS:e}"
        )));
    }
    let index = column as usize - 1;
    let Some(scene) = tape.scenes.get(index) else {
        return Err(Failure::BadInput(format!(
            "--column {column}: the tape begins with {} column",
            tape.scenes.len()
        )));
    };
    let mut played = Replay::new(tape);
    let mut rows_of = MotionRows {
        index,
        every,
        count: rows,
        end,
    };
    let written = rows_of.write(scene, &mut played, tape, format, &mut output, waiting);
    if written.is_err() {
        return output.judge(written);
    }
    output.finish()?;
    verdict(&played)
}

/// The rows of a motion.
struct MotionRows {
    index: usize,
    every: f64,
    count: f64,
    end: f64,
}

impl MotionRows {
    fn write(
        &mut self,
        scene: &Scene,
        played: &mut Replay,
        tape: &Tape,
        format: Format,
        output: &mut dyn Write,
        waiting: &mut Waiting,
    ) -> io::Result<()> {
        let Some(begin) = format.motion else {
            return Ok(());
        };
        let mut writer = begin(scene, output)?;
        let mut now = Observation::default();
        let mut row = 0.0;
        while row <= self.count {
            let until = (row * self.every).min(self.end);
            go(played, tape, until, self.end, waiting);
            // A column that is taken away, or has stopped, has no more rows.
            let there = played.player.observe(self.index, &mut now);
            if there && is_finite(&now) && now.reduced.len() == scene.n {
                writer.moment(&now)?;
            }
            row += 1.0;
        }
        go(played, tape, self.end, self.end, waiting);
        writer.flush()
    }
}
