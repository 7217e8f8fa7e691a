//! `beadlab stability`: where each method breaks.

use super::Failure;
use super::progress::Waiting;
use super::report::Destination;
use crate::cli::StabilityArgs;
use crate::study::SLICE;
use crate::study::accuracy::Report;
use crate::study::stability::{grid, steps_table};

/// Work of one run where nobody says otherwise, s on an ordinary machine.
const WORK: f64 = 5.0;
const QUICK_WORK: f64 = 0.1;

/// Runs `beadlab stability`.
///
/// # Errors
/// [`Failure::BadInput`] for a folder that cannot be written.
pub fn run(args: &StabilityArgs) -> Result<(), Failure> {
    let destination = Destination::open(&args.report)?;
    let quick = args.report.quick;
    let common = if quick { QUICK_WORK } else { WORK };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a positive number; one too large is as good as endless"
    )]
    let slices = (args.budget.unwrap_or(common) / SLICE).ceil() as u64;
    let mut waiting = Waiting::new();
    let mut tell = |what: &str, part| waiting.show(what, part);
    let mut tables = Vec::new();
    if !args.steps {
        tables.push(grid(quick, slices, &mut tell));
    }
    tables.push(steps_table(quick, &mut tell));
    drop(waiting);
    let plots = Vec::new();
    destination.write(&Report { tables, plots })
}
