//! Where results go: standard output, or a file that appears when it is complete.

use crate::commands::{Failure, printed};
use crate::scene::words::one_line;
use std::ffi::OsString;
use std::fs::{self, File};
use std::io::{self, ErrorKind, Write};
use std::mem;
use std::path::{Path, PathBuf};
use std::sync::{Mutex, MutexGuard, PoisonError};

/// The files that are written beside their places, so that a signal removes them.
static UNFINISHED: Mutex<Vec<PathBuf>> = Mutex::new(Vec::new());

fn unfinished() -> MutexGuard<'static, Vec<PathBuf>> {
    UNFINISHED.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Removes all files that are not finished, and says how many; none is begun or takes its
/// place any more. For a program that ends.
pub(in crate::commands) fn remove_unfinished() -> usize {
    let mut files = unfinished();
    let removed = mem::take(&mut *files);
    for temporary in &removed {
        // If it cannot be removed, so be it.
        let _ = fs::remove_file(temporary);
    }
    mem::forget(files);
    removed.len()
}

/// Why the file of an `--out` cannot be written, in one line.
pub(in crate::commands) fn unwritable(path: &Path, error: &io::Error) -> String {
    let path = one_line(&path.to_string_lossy());
    format!("--out {path}: cannot be written: {}", reason(error))
}

/// Why a file cannot be written.
pub(in crate::commands) fn reason(error: &io::Error) -> String {
    match error.kind() {
        ErrorKind::NotFound => "there is no such folder".to_owned(),
        ErrorKind::IsADirectory => "a file is wanted, and this names a folder".to_owned(),
        _ => one_line(&error.to_string()),
    }
}

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
        let (file, unfinished) =
            create(path).map_err(|error| Failure::BadInput(unwritable(path, &error)))?;
        Ok(Self {
            writer: Box::new(file),
            file: Some(unfinished),
        })
    }

    /// Everything is written: the file takes its place.
    pub fn finish(self) -> Result<(), Failure> {
        Self::finish_all(vec![self])
    }

    /// Everything is written: the files take their places, and no signal comes between.
    pub fn finish_all(mut all: Vec<Self>) -> Result<(), Failure> {
        for output in &mut all {
            let flushed = output.writer.flush();
            output.judge(flushed)?;
        }
        let mut waiting = unfinished();
        for output in &mut all {
            if let Some(file) = &mut output.file
                && let Err(error) = file.take_place(&mut waiting)
            {
                let failure = file.failed(&error);
                drop(waiting);
                return Err(failure);
            }
        }
        Ok(())
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
    fn take_place(&mut self, waiting: &mut Vec<PathBuf>) -> io::Result<()> {
        if let Some(temporary) = &self.temporary {
            fs::rename(temporary, &self.target)?;
            waiting.retain(|other| other != temporary);
            self.temporary = None;
        }
        Ok(())
    }

    fn failed(&self, error: &io::Error) -> Failure {
        let target = one_line(&self.target.to_string_lossy());
        Failure::Failed(format!("{target}: cannot be written: {error}"))
    }
}

impl Drop for Unfinished {
    fn drop(&mut self) {
        if let Some(temporary) = &self.temporary {
            unfinished().retain(|other| other != temporary);
            // It is of no use any more; if it cannot be removed, so be it.
            let _ = fs::remove_file(temporary);
        }
    }
}

fn create(path: &Path) -> io::Result<(File, Unfinished)> {
    // A link stays a link: what it points to is replaced.
    let target = fs::canonicalize(path).unwrap_or_else(|_| path.to_owned());
    match fs::metadata(&target) {
        Ok(found) if found.is_dir() => return Err(ErrorKind::IsADirectory.into()),
        Ok(found) if found.permissions().readonly() => {
            return Err(ErrorKind::PermissionDenied.into());
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
    let (file, temporary) = create_beside(&target)?;
    Ok((
        file,
        Unfinished {
            target,
            temporary: Some(temporary),
        },
    ))
}

/// A new file beside a place that is to be taken.
fn create_beside(target: &Path) -> io::Result<(File, PathBuf)> {
    let name = target.file_name().ok_or(ErrorKind::IsADirectory)?;
    // What is behind the name, as in `name/` or `name/.`, makes it that of a folder.
    if !target
        .as_os_str()
        .as_encoded_bytes()
        .ends_with(name.as_encoded_bytes())
    {
        return Err(ErrorKind::IsADirectory.into());
    }
    let mut waiting = unfinished();
    let mut number = 0_u32;
    loop {
        let mut beside = OsString::from(".");
        beside.push(name);
        beside.push(match number {
            0 => format!(".{}.part", std::process::id()),
            _ => format!(".{}-{number}.part", std::process::id()),
        });
        let temporary = target.with_file_name(beside);
        match File::options()
            .write(true)
            .create_new(true)
            .open(&temporary)
        {
            // Of one that was killed, or of one elsewhere that has the same number.
            Err(error) if error.kind() == ErrorKind::AlreadyExists => number += 1,
            opened => {
                let file = opened?;
                waiting.push(temporary.clone());
                return Ok((file, temporary));
            }
        }
    }
}
