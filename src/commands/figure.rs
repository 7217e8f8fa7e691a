//! `beadlab figure`: the paper's figures, tables and sentences, computed anew.

use super::progress::Waiting;
use super::report::{Destination, Part};
use super::{Failure, bad_input};
use crate::cli::FigureArgs;
use crate::study::figures::{Figure, FigureError, Pains, Sheet, claims, named, summary};
use std::num::NonZero;

/// Runs `beadlab figure`.
///
/// # Errors
/// [`Failure::BadInput`] for a figure that there is not or a folder that cannot be
/// written, [`Failure::Failed`] when a run fails.
pub fn run(args: &FigureArgs) -> Result<(), Failure> {
    let figures = named(&args.name).map_err(bad_input)?;
    let destination = Destination::open(&args.report)?;
    let pains = Pains {
        quick: args.report.quick,
        threads: std::thread::available_parallelism().map_or(1, NonZero::get),
    };
    let mut waiting = Waiting::new();
    let sheets = figures
        .iter()
        .enumerate()
        .map(|(k, figure)| {
            let before = match figures.len() {
                1 => String::new(),
                all => format!("{} of {all} figures; ", k + 1),
            };
            let mut tell = |what: &str, part| waiting.show(&format!("{before}{what}"), part);
            let sheet = figure.make(pains, &mut tell)?;
            Ok((figure, sheet))
        })
        .collect::<Result<Vec<_>, FigureError>>()
        .map_err(|error| Failure::Failed(error.to_string()))?;
    drop(waiting);
    destination.write_parts(&parts(&sheets))
}

/// Figure by figure: its plots, what it says, and its numbers; all claims at the end.
fn parts(sheets: &[(&Figure, Sheet)]) -> Vec<Part> {
    let mut parts = Vec::new();
    for (figure, sheet) in sheets {
        parts.extend(sheet.plots.iter().cloned().map(Part::Drawn));
        parts.push(Part::Shown(claims(figure, sheet)));
        parts.extend(sheet.data.iter().cloned().map(Part::Filed));
    }
    if sheets.len() > 1 {
        parts.push(Part::Shown(summary(sheets)));
    }
    parts
}
