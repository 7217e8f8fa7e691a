//! `beadlab sweep`: a scene at every point of a product of ranges, into a CSV file.

mod file;
mod resume;
mod rows;

use super::progress::RowsDone;
use super::signals::Interrupt;
use super::{Failure, bad_input, layer};
use crate::cli::SweepArgs;
use crate::scene::Preset;
use crate::scene::words::{one_line, quote};
use crate::study::sweep::{self, Sweep, SweepAxis, measure_unless};
use file::{FileMode, RowsFile};
use rows::{PointRow, RowFormat};
use std::ops::ControlFlow;
use std::thread;

/// Runs `beadlab sweep`.
///
/// # Errors
/// [`Failure::BadInput`] for arguments that make no sweep and files that are not its
/// own or cannot be opened, [`Failure::Failed`] when writing fails on the way or rows
/// have no results, [`Failure::Interrupted`] after a signal.
pub fn run(args: &SweepArgs) -> Result<(), Failure> {
    let sweep = prepare(args)?;
    let format = RowFormat::of(&sweep, args);
    let mode = match (args.resume, args.overwrite) {
        (true, _) => FileMode::Resume,
        (_, true) => FileMode::Overwrite,
        _ => FileMode::New,
    };
    let (mut file, before) = RowsFile::open(&args.out, mode, &format, &sweep)?;
    let mut failed = before.failed;
    let interrupt = Interrupt::watch();
    let progress = RowsDone::new(before.rows, sweep.rows());
    let mut broken = None;
    let handed = sweep::run(
        before.rows..sweep.rows(),
        jobs(args),
        interrupt.flag(),
        |row| {
            let scene = sweep.scene(row);
            let mut row = progress.row(&scene);
            let outcome = measure_unless(&scene, interrupt.flag(), &mut |time| row.show(time))?;
            row.done();
            Some(PointRow::of(outcome))
        },
        |row, measured| match file.push(&RowFormat::line(&sweep.values(row), &measured)) {
            Ok(()) => {
                failed += usize::from(measured.failed());
                ControlFlow::Continue(())
            }
            Err(failure) => {
                broken = Some(failure);
                ControlFlow::Break(())
            }
        },
    );
    drop(progress);
    let closed = file.finish();
    let done = before.rows + handed;
    let name = one_line(&args.out.to_string_lossy());
    let kept = format!("{done} of {} rows are in {name}", sweep.rows());
    let go_on = if args.overwrite {
        "the same command with --resume in place of --overwrite goes on"
    } else {
        "the same command with --resume goes on"
    };
    if let Some(Failure::Failed(reason)) = broken.or(closed.err()) {
        return Err(Failure::Failed(format!("{reason}; {kept}, {go_on}")));
    }
    if done < sweep.rows() {
        let message = format!("stopped: {kept}; {go_on}");
        return Err(Failure::Interrupted(message, interrupt.signal()));
    }
    if failed > 0 {
        let rows = if failed == 1 { "row has" } else { "rows have" };
        return Err(Failure::Failed(format!(
            "{failed} {rows} no results, for the reason in the column note; {kept}"
        )));
    }
    Ok(())
}

/// Everything that can be wrong about the arguments, found before anything runs.
fn prepare(args: &SweepArgs) -> Result<Sweep, Failure> {
    let preset = Preset::load(&args.preset).map_err(bad_input)?;
    let settings = layer(&args.settings)?;
    let axes = args
        .over
        .iter()
        .map(|text| {
            SweepAxis::parse(text)
                .map_err(|error| bad_input(format!("--over {}: {error}", quote(text))))
        })
        .collect::<Result<Vec<_>, _>>()?;
    Sweep::new(preset, args.method, settings, axes).map_err(bad_input)
}

fn jobs(args: &SweepArgs) -> usize {
    match args.jobs {
        Some(jobs) => usize::from(jobs),
        None => thread::available_parallelism().map_or(1, usize::from),
    }
}
