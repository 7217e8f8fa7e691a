//! Files that are written into the present folder, each of a new name.

use std::fs::File;
use std::io::{ErrorKind, Write};

/// So many names are tried.
const NAMES: u32 = 1000;

/// A file of the first name that is free of `STEM-1.ENDING`, `STEM-2.ENDING`, ..., and the name.
///
/// # Errors
/// When there can be none, in a line.
pub(super) fn create_new(stem: &str, ending: &str) -> Result<(String, File), String> {
    for number in 1..=NAMES {
        let name = format!("{stem}-{number}.{ending}");
        match File::create_new(&name) {
            Ok(file) => return Ok((name, file)),
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(format!("{name}: {error}")),
        }
    }
    Err(format!(
        "{stem}-1.{ending} to {stem}-{NAMES}.{ending} are there: nothing is written"
    ))
}

/// Writes a file of a new name, as [`create_new`] has it; its name.
///
/// # Errors
/// When it cannot be written, in a line.
pub(super) fn write_new(stem: &str, ending: &str, text: &str) -> Result<String, String> {
    let (name, mut file) = create_new(stem, ending)?;
    match file.write_all(text.as_bytes()) {
        Ok(()) => Ok(name),
        Err(error) => Err(format!("{name}: {error}")),
    }
}
