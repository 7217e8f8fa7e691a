//! `beadlab stability`: where each method breaks.

use super::Failure;
use super::progress::Waiting;
use super::report::Destination;
use crate::cli::StabilityArgs;
use crate::study::accuracy::Report;
use crate::study::stability::{grid, steps_table};
use std::time::Duration;

/// Wall-clock time of one run where nobody says otherwise.
const TIME: Duration = Duration::from_secs(2);
const QUICK_TIME: Duration = Duration::from_millis(100);

/// Runs `beadlab stability`.
///
/// # Errors
/// [`Failure::BadInput`] for a folder that cannot be written.
pub fn run(args: &StabilityArgs) -> Result<(), Failure> {
    let destination = Destination::open(&args.report)?;
    let quick = args.report.quick;
    let common = if quick { QUICK_TIME } else { TIME };
    let budget = args.budget.map_or(common, Duration::from_secs_f64);
    let mut waiting = Waiting::new();
    let mut tell = |what: &str, part: f64| waiting.show(what, part);
    let mut tables = Vec::new();
    if !args.steps {
        tables.push(grid(quick, budget, &mut tell));
    }
    tables.push(steps_table(quick, &mut tell));
    drop(waiting);
    let plots = Vec::new();
    destination.write(&Report { tables, plots })
}
