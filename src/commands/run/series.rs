//! The motion of a run: a moment at every multiple of an interval.

use crate::commands::Failure;
use crate::commands::output::Output;
use crate::physics::Observation;
use crate::scene::Scene;
use crate::scene::parameters::Value;
use crate::study::export::{Begin, MotionWriter, is_finite};
use crate::study::{Drive, RunError};
use std::io;
use std::time::{Duration, Instant};

/// More rows than that are a slip of the hand.
const MOST_ROWS: f64 = 1e8;

/// Rows are passed on at least that often, for a reader who watches.
const PATIENCE: Duration = Duration::from_millis(200);

/// Refuses an interval that makes absurdly many rows in `time`, s.
pub(in crate::commands) fn check(time: f64, every: f64) -> Result<(), Failure> {
    if time / every <= MOST_ROWS {
        return Ok(());
    }
    Err(Failure::BadInput(format!(
        "--every {}: makes {:.0e} rows in {} s, more than {MOST_ROWS:e}",
        Value::Number(every),
        time / every,
        Value::Number(time)
    )))
}

/// The number of the last row up to `end`, s, the first being 0: one that rounding would lose
/// is wanted.
pub(in crate::commands) fn last_row(end: f64, every: f64) -> f64 {
    (end / every * (1.0 + 1e-12)).floor()
}

/// Why rows come to an end before the run does.
enum Stop {
    Run(Failure),
    Output(io::Error),
}

impl From<RunError> for Stop {
    fn from(error: RunError) -> Self {
        Self::Run(error.into())
    }
}

impl From<io::Error> for Stop {
    fn from(error: io::Error) -> Self {
        Self::Output(error)
    }
}

/// Prints the motion until the scene's duration, or without gravity until the
/// floor collision is over if that comes first.
pub(super) fn print(
    scene: &Scene,
    drive: Drive,
    every: f64,
    begin: Begin,
    mut output: Output,
) -> Result<(), Failure> {
    let written = begin(scene, &mut output)
        .map_err(Stop::Output)
        .and_then(|motion| moments(scene, drive, every, motion));
    match written {
        Ok(()) => output.finish(),
        Err(Stop::Run(failure)) => Err(failure),
        Err(Stop::Output(error)) => output.judge(Err(error)),
    }
}

fn moments(
    scene: &Scene,
    mut drive: Drive,
    every: f64,
    mut motion: Box<dyn MotionWriter + '_>,
) -> Result<(), Stop> {
    let end = scene.duration.unwrap_or(f64::INFINITY);
    let most = last_row(end, every);
    let mut now = Observation::default();
    let mut flushed = Instant::now();
    let mut row = 0.0;
    loop {
        drive.observe(&mut now);
        if !is_finite(&now) {
            return Err(failed(format!(
                "the run failed: the motion at {:e} s is not finite",
                now.time
            )));
        }
        motion.moment(&now)?;
        if flushed.elapsed() > PATIENCE {
            motion.flush()?;
            flushed = Instant::now();
        }
        row += 1.0;
        let over = scene.gravity.is_none() && drive.is_over();
        if over || row > most {
            break;
        }
        if row > MOST_ROWS {
            let time = drive.time();
            return Err(failed(format!(
                "{MOST_ROWS:e} rows are written and the collision is not over at {time:e} s"
            )));
        }
        drive.advance(end.min(row * every))?;
    }
    Ok(motion.flush()?)
}

fn failed(reason: String) -> Stop {
    Stop::Run(Failure::Failed(reason))
}
