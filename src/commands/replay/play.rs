//! A tape that is played without pictures.

use crate::commands::Failure;
use crate::commands::output::Output;
use crate::commands::progress::Waiting;
use crate::commands::run::series;
use crate::physics::Observation;
use crate::scene::Scene;
use crate::study::export::{Begin, MotionWriter, is_finite};
use crate::tape::{Replay, Tape};
use std::io;

/// A tape on its way to `end`, s.
pub(super) struct Playback<'a> {
    tape: &'a Tape,
    end: f64,
    replay: Replay,
    waiting: Waiting,
}

impl<'a> Playback<'a> {
    pub fn new(tape: &'a Tape, end: f64) -> Self {
        Self {
            tape,
            end,
            replay: Replay::new(tape),
            waiting: Waiting::new(),
        }
    }

    /// Moves on to `until`, s, through all that the tape has on the way.
    fn go(&mut self, until: f64) {
        let (end, waiting) = (self.end, &mut self.waiting);
        self.replay.go(self.tape, until, &mut |time| {
            waiting.show("playing", Some(time / end));
        });
    }

    /// Plays to the end.
    pub fn finish(mut self) -> Replay {
        self.go(self.end);
        self.replay
    }

    /// Plays to the end, and writes the motion of a column, the first being 1, at every so
    /// many seconds.
    pub fn motion(
        mut self,
        every: f64,
        column: u32,
        begin: Begin,
        mut output: Output,
    ) -> Result<(), Failure> {
        series::check(self.end, every)?;
        let index = column as usize - 1;
        let Some(scene) = self.tape.scenes.get(index) else {
            return Err(Failure::BadInput(format!(
                "--column {column}: the tape begins with {} column",
                self.tape.scenes.len()
            )));
        };
        let written =
            begin(scene, &mut output).and_then(|writer| self.moments(every, index, scene, writer));
        if written.is_err() {
            return output.judge(written);
        }
        output.finish()?;
        verdict(&self.replay)
    }

    fn moments(
        &mut self,
        every: f64,
        index: usize,
        scene: &Scene,
        mut writer: Box<dyn MotionWriter + '_>,
    ) -> io::Result<()> {
        let (mut now, mut row) = (Observation::default(), 0.0);
        while row <= series::last_row(self.end, every) {
            self.go((row * every).min(self.end));
            // A column that is taken away, or has stopped, has no more rows.
            let there = self.replay.player.observe(index, &mut now);
            if there && is_finite(&now) && now.reduced.len() == scene.n {
                writer.moment(&now)?;
            }
            row += 1.0;
        }
        self.go(self.end);
        writer.flush()
    }
}

/// Whether all was as on the tape.
pub(super) fn verdict(replay: &Replay) -> Result<(), Failure> {
    match replay.differs {
        None => Ok(()),
        Some((time, column)) => Err(Failure::Failed(format!(
            "t = {time} s: column {column} is in another state than on the tape"
        ))),
    }
}
