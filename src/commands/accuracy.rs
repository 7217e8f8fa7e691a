//! `beadlab accuracy`: error against run time.

use super::progress::Waiting;
use super::report::Destination;
use super::{Failure, bad_input, load, note};
use crate::cli::AccuracyArgs;
use crate::scene::{MethodName, Preset};
use crate::study::accuracy::{AccuracyError, Effort, accuracy};
use std::time::Duration;

/// Wall-clock time of a report where nobody says otherwise.
const TIME: Duration = Duration::from_secs(20);
const PLATE_TIME: Duration = Duration::from_secs(60);
const QUICK_TIME: Duration = Duration::from_secs(4);

/// Runs `beadlab accuracy`.
///
/// # Errors
/// [`Failure::BadInput`] for a scene that cannot be compared or a folder that cannot
/// be written, [`Failure::Failed`] when the reference run fails.
pub fn run(args: &AccuracyArgs) -> Result<(), Failure> {
    let preset = soft(args)?;
    let destination = Destination::open(&args.report)?;
    let common = match preset.scene.gravity {
        _ if args.report.quick => QUICK_TIME,
        Some(_) => PLATE_TIME,
        None => TIME,
    };
    let effort = Effort {
        quick: args.report.quick,
        time: args.budget.map_or(common, Duration::from_secs_f64),
    };
    let mut waiting = Waiting::new();
    let report = accuracy(&preset.scene, effort, &mut |what, part| {
        waiting.show(what, part);
    })
    .map_err(|error| match error {
        AccuracyError::Scene(error) => bad_input(error),
        AccuracyError::Lattice => bad_input(error),
        error => Failure::Failed(error.to_string()),
    })?;
    drop(waiting);
    destination.write(&report.of(&preset.scene, &preset.name))
}

/// The preset asked for, or the soft one beside it if its spheres are hard.
fn soft(args: &AccuracyArgs) -> Result<Preset, Failure> {
    let asked = Preset::load(&args.preset).map_err(bad_input)?;
    if asked.scene.is_md() {
        return load(&args.preset, None, &args.settings);
    }
    match asked.beside {
        Some(beside) => {
            let name = asked.name;
            note(&format!(
                "{name} has hard spheres: {beside}, beside it, is compared"
            ));
            load(&beside, None, &args.settings)
        }
        None => load(&args.preset, Some(MethodName::Exact), &args.settings),
    }
}
