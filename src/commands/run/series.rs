//! The motion of a run as CSV: a row at every multiple of an interval.

use crate::commands::Failure;
use crate::commands::output::Output;
use crate::physics::Observation;
use crate::scene::Scene;
use crate::scene::parameters::Value;
use crate::study::{Drive, RunError, natural_time};
use std::io;
use std::time::{Duration, Instant};

/// More rows than that are a slip of the hand.
const MOST_ROWS: f64 = 1e8;

/// Rows are passed on at least that often, for a reader who watches.
const PATIENCE: Duration = Duration::from_millis(200);

/// Refuses an interval that makes absurdly many rows.
pub(super) fn check(scene: &Scene, every: f64) -> Result<(), Failure> {
    let time = scene.duration.unwrap_or_else(|| natural_time(scene));
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

/// Why rows come to an end before the run does.
enum Stop {
    Run(Failure),
    Output(io::Error),
}

impl From<Failure> for Stop {
    fn from(failure: Failure) -> Self {
        Self::Run(failure)
    }
}

impl From<RunError> for Stop {
    fn from(error: RunError) -> Self {
        Self::Run(error.into())
    }
}

impl From<csv::Error> for Stop {
    fn from(error: csv::Error) -> Self {
        Self::Output(match error.into_kind() {
            csv::ErrorKind::Io(error) => error,
            other => io::Error::other(format!("{other:?}")),
        })
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
    mut output: Output,
) -> Result<(), Failure> {
    match rows(scene, drive, every, csv::Writer::from_writer(&mut output)) {
        Ok(()) => output.finish(),
        Err(Stop::Run(failure)) => Err(failure),
        Err(Stop::Output(error)) => output.judge(Err(error)),
    }
}

fn rows(
    scene: &Scene,
    mut drive: Drive,
    every: f64,
    mut writer: csv::Writer<&mut Output>,
) -> Result<(), Stop> {
    let end = scene.duration.unwrap_or(f64::INFINITY);
    // A last row that rounding would lose is wanted.
    let most = (end / every * (1.0 + 1e-12)).floor();
    let mut now = Observation::default();
    let mut flushed = Instant::now();
    let mut row = 0.0;
    writer.write_record(header(scene))?;
    loop {
        drive.observe(&mut now);
        writer.serialize(cells(scene, &now)?)?;
        if flushed.elapsed() > PATIENCE {
            writer.flush()?;
            flushed = Instant::now();
        }
        row += 1.0;
        let over = scene.gravity.is_none() && drive.is_over();
        if over || row > most {
            break;
        }
        if row > MOST_ROWS {
            let time = drive.time();
            return Err(Stop::Run(Failure::Failed(format!(
                "{MOST_ROWS:e} rows are written and the collision is not over at {time:e} s"
            ))));
        }
        drive.advance(end.min(row * every))?;
    }
    Ok(writer.flush()?)
}

/// Names of the columns; a lattice also has the places of its beads across.
fn header(scene: &Scene) -> Vec<String> {
    let each = |name: &'static str, n: usize| (1..=n).map(move |bead| format!("{name}{bead}"));
    let across = if scene.sites().is_some() { scene.n } else { 0 };
    let beads = each("x", across).chain(each("z", scene.n));
    let head = ["time", "floor"].map(String::from);
    let tail = ["kinetic", "relative", "sigma"].map(String::from);
    head.into_iter().chain(beads).chain(tail).collect()
}

/// The numbers of a row; σ may be none.
fn cells(scene: &Scene, now: &Observation) -> Result<Vec<Option<f64>>, Failure> {
    let sigma = now
        .free_flight
        .zip(scene.contact_time())
        .map(|(flight, t_c)| flight / t_c);
    let head = [now.time, now.floor];
    let tail = [now.energy.kinetic, now.energy.relative];
    let cells: Vec<_> = head
        .iter()
        .chain(now.discs.iter().flat_map(|discs| &discs.x))
        .chain(&now.reduced)
        .chain(&tail)
        // −0 is a sign that means nothing.
        .map(|&x| Some(x + 0.0))
        .chain([sigma])
        .collect();
    if cells.iter().flatten().all(|x| x.is_finite()) {
        return Ok(cells);
    }
    Err(Failure::Failed(format!(
        "the run failed: the motion at {:e} s is not finite",
        now.time
    )))
}
