//! A screen in memory that others can watch.

use std::convert::Infallible;
use std::sync::{Arc, Condvar, Mutex, MutexGuard};
use std::time::Duration;

use ratatui::backend::{Backend, ClearType, TestBackend, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};

/// Nothing that is waited for takes so long.
const LONG: Duration = Duration::from_secs(30);
/// The longest time between two frames of a screen that moves.
const FRAME: Duration = Duration::from_millis(45);

/// Shows every whole frame to those who watch.
pub struct Screen {
    backend: TestBackend,
    shown: Shown,
}

/// What a screen shows.
#[derive(Clone, Default)]
pub struct Shown(Arc<(Mutex<Picture>, Condvar)>);

#[derive(Default)]
struct Picture {
    rows: Vec<String>,
    /// Frames so far.
    frames: u64,
}

impl Screen {
    /// The screen, and what it will show.
    pub fn new(backend: TestBackend) -> (Self, Shown) {
        let shown = Shown::default();
        let screen = Self {
            backend,
            shown: shown.clone(),
        };
        (screen, shown)
    }
}

impl Shown {
    /// The rows now.
    pub fn rows(&self) -> Vec<String> {
        self.lock().rows.clone()
    }

    fn lock(&self) -> MutexGuard<'_, Picture> {
        self.0.0.lock().expect("nobody panics with it")
    }

    /// Waits until so many more frames are drawn, as long as they take at most: a screen on
    /// which nothing changes draws none.
    pub fn wait_for_frames(&self, count: u32) {
        let picture = self.lock();
        let last = picture.frames + u64::from(count);
        let not_yet = |picture: &mut Picture| picture.frames < last;
        let waited = self.0.1.wait_timeout_while(picture, count * FRAME, not_yet);
        drop(waited.expect("nobody panics with it"));
    }

    /// Waits until the screen is so. What is never so is left to the test, which says of
    /// the last screen what it misses.
    pub fn wait(&self, is_so: impl Fn(&str) -> bool) {
        let not_yet = |picture: &mut Picture| !is_so(&picture.rows.join("\n"));
        let waited = self.0.1.wait_timeout_while(self.lock(), LONG, not_yet);
        drop(waited.expect("nobody panics with it"));
    }
}

impl Backend for Screen {
    type Error = Infallible;

    fn draw<'a, I>(&mut self, content: I) -> Result<(), Infallible>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        self.backend.draw(content)
    }

    fn hide_cursor(&mut self) -> Result<(), Infallible> {
        self.backend.hide_cursor()
    }

    fn show_cursor(&mut self) -> Result<(), Infallible> {
        self.backend.show_cursor()
    }

    fn get_cursor_position(&mut self) -> Result<Position, Infallible> {
        self.backend.get_cursor_position()
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> Result<(), Infallible> {
        self.backend.set_cursor_position(position)
    }

    fn clear(&mut self) -> Result<(), Infallible> {
        self.backend.clear()
    }

    fn clear_region(&mut self, clear_type: ClearType) -> Result<(), Infallible> {
        self.backend.clear_region(clear_type)
    }

    fn size(&self) -> Result<Size, Infallible> {
        self.backend.size()
    }

    fn window_size(&mut self) -> Result<WindowSize, Infallible> {
        self.backend.window_size()
    }

    fn flush(&mut self) -> Result<(), Infallible> {
        self.backend.flush()?;
        let buffer = self.backend.buffer();
        let symbols: Vec<&str> = buffer.content.iter().map(Cell::symbol).collect();
        let rows = symbols.chunks(usize::from(buffer.area.width).max(1));
        let mut picture = self.shown.lock();
        picture.rows = rows.map(<[&str]>::concat).collect();
        picture.frames += 1;
        drop(picture);
        self.shown.0.1.notify_all();
        Ok(())
    }
}
