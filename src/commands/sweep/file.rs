//! A file that grows by whole rows, and can be gone on with after any end.

use super::resume::{self, Before};
use super::rows::RowFormat;
use crate::commands::Failure;
use crate::commands::output::unwritable;
use crate::scene::words::one_line;
use crate::study::sweep::Sweep;
use std::fs::{File, TryLockError};
use std::io::{self, BufReader, Seek, SeekFrom, Write};
use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

/// Rows are forced to the disk this often; a kill loses none, but a power cut may.
const SYNC: Duration = Duration::from_secs(1);

/// What may be done with a file that is there already.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum FileMode {
    /// Nothing.
    New,
    /// Go on with it.
    Resume,
    /// Empty it.
    Overwrite,
}

/// The file, open behind its last whole row.
pub(super) struct RowsFile {
    file: File,
    path: PathBuf,
    /// Length up to the last whole row; a device has none.
    length: Option<u64>,
    synced: Instant,
}

impl RowsFile {
    /// Opens the file and writes the header, or reads the rows that are there.
    pub fn open(
        path: &Path,
        mode: FileMode,
        format: &RowFormat,
        sweep: &Sweep,
    ) -> Result<(Self, Before), Failure> {
        let name = one_line(&path.to_string_lossy());
        let refuse = |what: &str| Err(Failure::BadInput(format!("--out {name}: {what}")));
        let found = path.metadata().ok();
        let regular = found.as_ref().is_none_or(std::fs::Metadata::is_file);
        if mode == FileMode::New && found.is_some_and(|found| found.is_file()) {
            return refuse("is there already; --resume goes on with it, --overwrite begins again");
        }
        let mut options = File::options();
        options.write(true).read(regular);
        let opened = match mode {
            _ if !regular => options.open(path),
            FileMode::New => options.create_new(true).open(path),
            FileMode::Resume | FileMode::Overwrite => {
                options.create(true).truncate(false).open(path)
            }
        };
        let file = opened.map_err(|error| Failure::BadInput(unwritable(path, &error)))?;
        if regular && matches!(file.try_lock(), Err(TryLockError::WouldBlock)) {
            return refuse("another sweep is writing it");
        }
        let mut before = Before::default();
        if regular && mode == FileMode::Resume {
            match resume::read(BufReader::new(&file), format, sweep) {
                Ok(found) => before = found,
                Err(what) => return refuse(&what),
            }
        }
        let mut file = Self {
            file,
            path: path.to_owned(),
            length: regular.then_some(before.end),
            synced: Instant::now(),
        };
        file.cut().map_err(|error| file.unwritable(&error))?;
        if before.end == 0 {
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
        Failure::Failed(unwritable(&self.path, error))
    }
}
