//! What is read of a file that a sweep is to go on with.

use super::rows::RowFormat;
use crate::scene::words::{one_line, quote};
use crate::study::sweep::Sweep;
use std::io::{self, BufRead, Read};

/// What a file held before.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Before {
    /// Whole rows.
    pub rows: usize,
    /// Those of them without results.
    pub failed: usize,
    /// Where the last whole one ends, in bytes; 0 without a whole header.
    pub end: u64,
}

/// The rows of a file that this sweep began.
///
/// # Errors
/// What is wrong with the file: the first line that is not this sweep's.
pub(super) fn read(
    mut file: impl BufRead,
    format: &RowFormat,
    sweep: &Sweep,
) -> Result<Before, String> {
    let unreadable = |error: io::Error| format!("cannot be read: {error}");
    let header = format.header();
    let mut found = Vec::new();
    // What is behind the header of another file is nobody's business.
    file.by_ref()
        .take(header.len() as u64)
        .read_to_end(&mut found)
        .map_err(unreadable)?;
    if found != header.as_bytes() {
        // The end may have come before the header was whole.
        let is_begun = header.as_bytes().starts_with(&found);
        return is_begun
            .then(Before::default)
            .ok_or_else(|| difference(&found, header));
    }
    let mut before = Before {
        end: header.len() as u64,
        ..Before::default()
    };
    let mut line = Vec::new();
    loop {
        line.clear();
        file.read_until(b'\n', &mut line).map_err(unreadable)?;
        if line.is_empty() {
            return Ok(before);
        }
        let number = header.lines().count() + before.rows + 1;
        if before.rows == sweep.rows() {
            return Err(format!(
                "line {number}: is one too many, since this sweep has {} rows",
                sweep.rows()
            ));
        }
        let values = sweep.values(before.rows);
        let Some(whole) = line.strip_suffix(b"\n") else {
            // Half a row, the last one.
            return if RowFormat::is_begun(&line, &values) {
                Ok(before)
            } else {
                let text = String::from_utf8_lossy(&line);
                let row = before.rows + 1;
                Err(format!(
                    "line {number}: `{}` is not the beginning of row {row} of this sweep",
                    quote(&text)
                ))
            };
        };
        let has_results = format
            .check(whole, &values)
            .map_err(|wrong| format!("line {number}{wrong}"))?;
        before.rows += 1;
        before.failed += usize::from(!has_results);
        before.end += line.len() as u64;
    }
}

/// The first line in which a file's header is not the one that it should be.
fn difference(text: &[u8], header: &str) -> String {
    let text = String::from_utf8_lossy(text);
    let mut found = text.lines();
    for (number, wanted) in header.lines().enumerate() {
        let line = found.next().unwrap_or("");
        if line != wanted {
            return format!(
                "is of another sweep: line {} is `{}`, but here it would be `{}`",
                number + 1,
                one_line(line),
                one_line(wanted)
            );
        }
    }
    "is of another sweep".to_owned()
}
