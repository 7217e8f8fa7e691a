//! `beadlab speed`: how fast the engines are here.

use super::Failure;
use super::progress::Waiting;
use super::report::Destination;
use crate::cli::ReportArgs;
use crate::study::speed::speed;

/// Runs `beadlab speed`.
///
/// # Errors
/// [`Failure::BadInput`] for a folder that cannot be written.
pub fn run(args: &ReportArgs) -> Result<(), Failure> {
    let destination = Destination::open(args)?;
    let mut waiting = Waiting::new();
    let report = speed(args.quick, &mut |what: &str, part| {
        waiting.show(what, part);
    });
    drop(waiting);
    destination.write(&report)
}
