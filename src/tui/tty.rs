//! The terminal as a file.

#[cfg(not(unix))]
pub use elsewhere::Tty;
#[cfg(unix)]
pub use unix::Tty;

/// Sizes that no terminal has. Larger ones are drawn in part.
const LARGEST: u16 = 1000;

/// Columns and rows; none where the terminal does not know them, as at the start of a
/// container's, and on serial lines.
pub fn size() -> Option<(u16, u16)> {
    let (width, height) = raw_size()?;
    let known = width > 0 && height > 0;
    known.then(|| (width.min(LARGEST), height.min(LARGEST)))
}

#[cfg(unix)]
fn raw_size() -> Option<(u16, u16)> {
    let size = rustix::termios::tcgetwinsize(rustix::stdio::stdout()).ok()?;
    Some((size.ws_col, size.ws_row))
}

#[cfg(not(unix))]
fn raw_size() -> Option<(u16, u16)> {
    crossterm::terminal::size().ok()
}

#[cfg(unix)]
mod unix {
    use std::ffi::OsStr;
    use std::fs::File;
    use std::io::{self, Write};
    use std::os::fd::AsFd;
    use std::os::unix::ffi::OsStrExt;
    use std::os::unix::fs::OpenOptionsExt;
    use std::time::Duration;

    use rustix::event::{PollFd, PollFlags, Timespec, poll};
    use rustix::fs::OFlags;
    use rustix::termios::{
        OptionalActions, QueueSelector, Termios, tcflush, tcgetattr, tcsetattr, ttyname,
    };

    /// The terminal, opened anew if it may be: writes that would block say so, and whoever
    /// shares the terminal's own file is not affected.
    #[derive(Debug)]
    pub struct Tty {
        file: File,
        /// As it was found.
        modes: Termios,
    }

    impl Tty {
        /// The terminal that output goes to.
        ///
        /// # Errors
        /// When there is none.
        pub fn open() -> io::Result<Tty> {
            let output = rustix::stdio::stdout();
            let modes = tcgetattr(output)?;
            let anew = ttyname(output, Vec::new()).map(|name| {
                File::options()
                    .write(true)
                    .custom_flags((OFlags::NONBLOCK | OFlags::NOCTTY).bits().cast_signed())
                    .open(OsStr::from_bytes(name.as_bytes()))
            });
            let file = match anew {
                Ok(Ok(file)) => file,
                // Another user's, as after su: it can be written to, not opened.
                _ => File::from(output.try_clone_to_owned()?),
            };
            Ok(Tty { file, modes })
        }

        /// Keys one by one, as they are typed.
        ///
        /// # Errors
        /// When the terminal refuses.
        pub fn make_raw(&self) -> io::Result<()> {
            let mut modes = self.modes.clone();
            modes.make_raw();
            Ok(tcsetattr(&self.file, OptionalActions::Now, &modes)?)
        }

        /// The mode in which it was found. What was typed and not read is dropped: answers,
        /// mostly.
        pub fn restore(&self) {
            let _ = tcflush(&self.file, QueueSelector::IFlush);
            let _ = tcsetattr(&self.file, OptionalActions::Now, &self.modes);
        }

        /// Writes as many bytes as it takes now.
        ///
        /// # Errors
        /// When it takes none, or has gone.
        pub fn write(&self, bytes: &[u8]) -> io::Result<usize> {
            (&self.file).write(bytes)
        }

        /// Waits at most so long for it to take bytes.
        pub fn wait(&self, most: Duration) {
            let file = self.file.as_fd();
            let mut watched = [PollFd::new(&file, PollFlags::OUT)];
            let limit = Timespec {
                tv_sec: 0,
                tv_nsec: most.subsec_nanos().into(),
            };
            let _ = poll(&mut watched, Some(&limit));
        }

        /// Drops the bytes that wait in its queue.
        pub fn drop_queue(&self) {
            let _ = tcflush(&self.file, QueueSelector::OFlush);
        }
    }
}

#[cfg(not(unix))]
mod elsewhere {
    use std::io::{self, Write};
    use std::thread;
    use std::time::Duration;

    /// The terminal that output goes to.
    #[derive(Debug)]
    pub struct Tty(());

    impl Tty {
        /// The terminal.
        ///
        /// # Errors
        /// None.
        pub fn open() -> io::Result<Tty> {
            Ok(Tty(()))
        }

        /// Keys one by one, as they are typed.
        ///
        /// # Errors
        /// When the terminal refuses.
        pub fn make_raw(&self) -> io::Result<()> {
            crossterm::terminal::enable_raw_mode()
        }

        /// The mode in which it was found.
        pub fn restore(&self) {
            let _ = crossterm::terminal::disable_raw_mode();
        }

        /// Writes bytes.
        ///
        /// # Errors
        /// When it has gone.
        pub fn write(&self, bytes: &[u8]) -> io::Result<usize> {
            let mut output = io::stdout();
            let count = output.write(bytes)?;
            output.flush().map(|()| count)
        }

        /// Waits so long.
        pub fn wait(&self, most: Duration) {
            thread::sleep(most);
        }

        /// Its queue cannot be reached.
        pub fn drop_queue(&self) {}
    }
}
