//! Where results go: standard output, or a file that appears when it is complete.

use crate::commands::{Failure, printed};
use crate::scene::words::one_line;
use std::fs::{self, File};
use std::io::{self, Write};
use std::path::{Path, PathBuf};

/// Where results go.
pub(in crate::commands) struct Output {
    writer: Box<dyn Write>,
    file: Option<Unfinished>,
}

/// A file that is written beside its place, and removed unless it gets there.
struct Unfinished {
    target: PathBuf,
    temporary: Option<PathBuf>,
}

impl Output {
    /// Opens the file at once, so that a long run does not end in vain.
    pub fn open(path: Option<&Path>) -> Result<Self, Failure> {
        let Some(path) = path else {
            return Ok(Self {
                writer: Box::new(io::stdout()),
                file: None,
            });
        };
        let (file, unfinished) = create(path).map_err(|error| {
            let path = one_line(&path.to_string_lossy());
            let error = one_line(&error.to_string());
            Failure::BadInput(format!("--out {path}: cannot be written: {error}"))
        })?;
        Ok(Self {
            writer: Box::new(file),
            file: Some(unfinished),
        })
    }

    /// Everything is written: the file takes its place.
    pub fn finish(mut self) -> Result<(), Failure> {
        let result = self.writer.flush().and_then(|()| match &mut self.file {
            Some(file) => file.take_place(),
            None => Ok(()),
        });
        self.judge(result)
    }

    /// What became of writing: a reader that has seen enough is no failure.
    pub fn judge(&self, result: io::Result<()>) -> Result<(), Failure> {
        match &self.file {
            None => printed(result),
            Some(file) => result.map_err(|error| file.failed(&error)),
        }
    }
}

impl Write for Output {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.writer.write(bytes)
    }

    fn flush(&mut self) -> io::Result<()> {
        self.writer.flush()
    }
}

impl Unfinished {
    fn take_place(&mut self) -> io::Result<()> {
        match self.temporary.take() {
            Some(temporary) => fs::rename(&temporary, &self.target).inspect_err(|_| {
                self.temporary = Some(temporary);
            }),
            None => Ok(()),
        }
    }

    fn failed(&self, error: &io::Error) -> Failure {
        let target = one_line(&self.target.to_string_lossy());
        Failure::Failed(format!("{target}: cannot be written: {error}"))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            // It is of no use any more; if it cannot be removed, so be it.
            let _ = fs::remove_file(temporary);
        }
    }
}

fn create(path: &Path) -> io::Result<(File, Unfinished)> {
    // A link stays a link: what it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => return Err(io::ErrorKind::IsADirectory.into()),
        Ok(found) if found.permissions().readonly() => {
            return Err(io::ErrorKind::PermissionDenied.into());
        }
        // A device or pipe has no place to be taken.
        Ok(found) if !found.is_file() => {
            let file = File::options().write(true).open(&target)?;
            return Ok((
                file,
                Unfinished {
                    target,
                    temporary: None,
                },
            ));
        }
        _ => {}
    }
    let name = target.file_name().ok_or(io::ErrorKind::InvalidFilename)?;
    let mut beside = std::ffi::OsString::from(".");
    beside.push(name);
    beside.push(format!(".{}.part", std::process::id()));
    let temporary = target.with_file_name(beside);
    let file = File::options()
        .write(true)
        .create_new(true)
        .open(&temporary)?;
    Ok((
        file,
        Unfinished {
            target,
            temporary: Some(temporary),
        },
    ))
}
