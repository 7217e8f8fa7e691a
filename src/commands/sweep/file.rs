//! A file that grows by whole rows, and can be gone on with after any end.

use super::rows::Format;
use crate::commands::Failure;
use crate::scene::words::one_line;
use crate::study::sweep::Sweep;
use std::fs::{File, TryLockError};
use std::io::{self, ErrorKind, Read, Seek, SeekFrom, Write};
use std::path::Path;
use std::time::{Duration, Instant};

/// Rows are forced to the disk this often; a kill loses none, but a power cut may.
const SYNC: Duration = Duration::from_secs(1);

/// What may be done with a file that is there already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Mode {
    /// Nothing.
    New,
    /// Go on with it.
    Resume,
    /// Empty it.
    Overwrite,
}

/// What a file held before.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Before {
    /// Whole rows.
    pub rows: usize,
    /// Those of them without results.
    pub failed: usize,
}

/// The file, open behind its last whole row.
pub(super) struct RowsFile {
    file: File,
    name: String,
    /// Length up to the last whole row; a device has none.
    length: Option<u64>,
    synced: Instant,
}

impl RowsFile {
    /// Opens the file and writes the header, or reads the rows that are there.
    pub fn open(
        path: &Path,
        mode: Mode,
        format: &Format,
        sweep: &Sweep,
    ) -> Result<(Self, Before), Failure> {
        let name = one_line(&path.to_string_lossy());
        let refuse = |what: &str| Err(Failure::BadInput(format!("--out {name}: {what}")));
        let unwritable = |error: io::Error| Failure::BadInput(unwritable(&name, &error));
        let found = path.metadata().ok();
        let regular = found.as_ref().is_none_or(std::fs::Metadata::is_file);
        if mode == Mode::New && found.is_some_and(|found| found.is_file()) {
            return refuse("is there already; --resume goes on with it, --overwrite begins again");
        }
        let mut options = File::options();
        options.write(true).read(regular);
        let opened = match mode {
            _ if !regular => options.open(path),
            Mode::New => options.create_new(true).open(path),
            Mode::Resume | Mode::Overwrite => options.create(true).truncate(false).open(path),
        };
        let mut file = opened.map_err(unwritable)?;
        if regular && matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return refuse("another sweep is writing it");
        }
        let mut before = Before::default();
        let mut length = 0;
        if regular && mode == Mode::Resume {
            let mut text = Vec::new();
            file.read_to_end(&mut text).map_err(unwritable)?;
            match whole_rows(&text, format, sweep) {
                Ok((rows, end)) => (before, length) = (rows, end),
                Err(what) => return refuse(&what),
            }
        }
        let mut file = Self {
            file,
            name,
            length: regular.then_some(length as u64),
            synced: Instant::now(),
        };
        file.cut().map_err(|error| file.unwritable(&error))?;
        if length == 0 {
            file.push(format.header())?;
        }
        Ok((file, before))
    }

    /// Adds a line, whole or not at all.
    pub fn push(&mut self, line: &str) -> Result<(), Failure> {
        let mut written = self.file.write_all(line.as_bytes());
        if written.is_ok() && self.synced.elapsed() > SYNC {
            written = self.sync();
        }
        if let Err(error) = written {
            // What cannot be cut off is dropped by the next --resume.
            let _ = self.cut();
            return Err(self.unwritable(&error));
        }
        if let Some(length) = &mut self.length {
            *length += line.len() as u64;
        }
        Ok(())
    }

    /// Forces the last rows to the disk.
    pub fn finish(mut self) -> Result<(), Failure> {
        self.sync().map_err(|error| self.unwritable(&error))
    }

    fn sync(&mut self) -> io::Result<()> {
        self.synced = Instant::now();
        match self.length {
            Some(_) => self.file.sync_data(),
            None => Ok(()),
        }
    }

    /// Drops what is behind the last whole row.
    fn cut(&mut self) -> io::Result<()> {
        if let Some(length) = self.length {
            self.file.set_len(length)?;
            self.file.seek(SeekFrom::Start(length))?;
        }
        Ok(())
    }

    fn unwritable(&self, error: &io::Error) -> Failure {
        Failure::Failed(unwritable(&self.name, error))
    }
}

fn unwritable(name: &str, error: &io::Error) -> String {
    let reason = match error.kind() {
        ErrorKind::NotFound => "there is no such folder".to_owned(),
        _ => one_line(&error.to_string()),
    };
    format!("--out {name}: cannot be written: {reason}")
}

/// The rows of a file that this sweep began, and where the last whole one ends; or
/// what is wrong with the file.
fn whole_rows(text: &[u8], format: &Format, sweep: &Sweep) -> Result<(Before, usize), String> {
    let header = format.header().as_bytes();
    // The end may have come before the header was whole.
    if header.starts_with(text) && text.len() < header.len() {
        return Ok((Before::default(), 0));
    }
    let Some(rows) = text.strip_prefix(header) else {
        return Err(difference(text, format.header()));
    };
    let mut before = Before::default();
    let mut end = header.len();
    for line in rows.split_inclusive(|&byte| byte == b'\n') {
        let Some(whole) = line.strip_suffix(b"\n") else {
            // Half a line, the last one.
            break;
        };
        let row = before.rows;
        let known = (row < sweep.rows())
            .then(|| std::str::from_utf8(whole).ok())
            .flatten()
            .and_then(|line| Format::recognise(line, &sweep.values(row)));
        let Some(has_results) = known else {
            let line = format.header().lines().count() + row + 1;
            return Err(format!("line {line} is not row {} of this sweep", row + 1));
        };
        before.rows += 1;
        before.failed += usize::from(!has_results);
        end += line.len();
    }
    Ok((before, end))
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
