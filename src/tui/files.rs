//! Files that are written into the present folder, each of a new name.

use std::fs::File;
use std::io::{ErrorKind, Write};

/// So many names are tried.
const NAMES: u32 = 1000;

/// Writes a file of the first name that is free of `STEM-1.ENDING`, `STEM-2.ENDING`, ...; its
/// name.
///
/// # Errors
/// When it cannot be written, in a line.
pub(super) fn write_new(stem: &str, ending: &str, text: &str) -> Result<String, String> {
    for number in 1..=NAMES {
        let name = format!("{stem}-{number}.{ending}");
        match File::create_new(&name) {
            Ok(mut file) => {
                let written = file.write_all(text.as_bytes());
                return match written {
                    Ok(()) => Ok(name),
                    Err(error) => Err(format!("{name}: {error}")),
                };
            }
            Err(error) if error.kind() == ErrorKind::AlreadyExists => {}
            Err(error) => return Err(format!("{name}: {error}")),
        }
    }
    Err(format!(
        "{stem}-1.{ending} to {stem}-{NAMES}.{ending} are there: nothing is written"
    ))
}
