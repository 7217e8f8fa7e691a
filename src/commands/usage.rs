//! clap's answers: help as it is, errors on one line.

use super::{Failure, printed};
use crate::scene::words::one_line;
use clap::error::ErrorKind;
use std::io::{self, Write};

/// Prints help or the version; turns anything else into bad input.
pub(super) fn answer(error: &clap::Error) -> Result<(), Failure> {
    match error.kind() {
        ErrorKind::DisplayHelp | ErrorKind::DisplayVersion => {
            // clap decides about colours.
            printed(error.print().and_then(|()| io::stdout().flush()))
        }
        _ => Err(Failure::BadInput(condensed(&error.to_string()))),
    }
}

/// clap's paragraphs on one line, without the usage that follows them.
fn condensed(report: &str) -> String {
    let report = report.strip_prefix("error: ").unwrap_or(report);
    // What is "used with" a preset's name was not meant as a subcommand.
    let report = report.strip_prefix("the subcommand ").unwrap_or(report);
    let parts: Vec<String> = report
        .lines()
        .map(str::trim)
        .take_while(|line| !line.starts_with("Usage:") && !line.starts_with("For more information"))
        .map(|line| one_line(line.strip_prefix("tip: ").unwrap_or(line)))
        .filter(|line| !line.is_empty())
        .collect();
    parts.join("; ").replace(":; ", ": ") + " (see --help)"
}
