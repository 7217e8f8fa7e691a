//! Preset files, read with bounds.

use super::PresetError;
use crate::scene::words::one_line;
use std::fs::File;
use std::io::{self, ErrorKind, Read};
use std::path::{MAIN_SEPARATOR, Path};

/// No preset is larger; a file that is cannot be one.
const LARGEST_FILE: u64 = 1 << 20;

/// Whether the name can only be meant as a file, or is one.
pub(super) fn looks_like_path(name: &str) -> bool {
    let path = Path::new(name);
    path.extension()
        .is_some_and(|extension| extension.eq_ignore_ascii_case("toml"))
        || name.contains(['/', MAIN_SEPARATOR])
        || path.exists()
}

/// The file's name without folder and ending.
pub(super) fn stem(path: &str) -> String {
    let stem = Path::new(path).file_stem().unwrap_or_default();
    one_line(&stem.to_string_lossy())
}

pub(super) fn read(path: &str) -> Result<String, PresetError> {
    let unreadable = |reason: String| PresetError::Unreadable {
        path: one_line(path),
        reason,
    };
    let bytes = read_bounded(path).map_err(|error| unreadable(describe(&error)))?;
    if bytes.len() as u64 > LARGEST_FILE {
        return Err(unreadable(
            "is larger than 1 MiB, so it is no preset".to_owned(),
        ));
    }
    String::from_utf8(bytes).map_err(|error| {
        let good = &error.as_bytes()[..error.utf8_error().valid_up_to()];
        let line = good.split(|&byte| byte == b'\n').count();
        unreadable(format!("is not UTF-8 text (line {line})"))
    })
}

/// At most one byte more than allowed, also from a file without an end.
fn read_bounded(path: &str) -> io::Result<Vec<u8>> {
    let mut bytes = Vec::new();
    File::open(path)?
        .take(LARGEST_FILE + 1)
        .read_to_end(&mut bytes)?;
    Ok(bytes)
}

fn describe(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "no such file".to_owned(),
        ErrorKind::IsADirectory => "is a directory, not a preset file".to_owned(),
        ErrorKind::PermissionDenied => "may not be read (permission denied)".to_owned(),
        _ => one_line(&error.to_string()),
    }
}
