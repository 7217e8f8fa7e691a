//! How far a command is, for a person who waits for it.

use crate::scene::Scene;
use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;
use std::io::{self, IsTerminal};
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::{RecvTimeoutError, Sender, channel};
use std::thread::{self, JoinHandle};
use std::time::{Duration, Instant};

/// A command that is over by then needs no bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// Time between two looks at the bar.
const REFRESH: Duration = Duration::from_millis(100);

/// Before that nobody knows how long the rest takes.
const EARLY: Duration = Duration::from_secs(2);

/// Columns that a bar with all its words takes.
const ROOM: usize = 70;

/// Resolution of the bar.
const PARTS: u16 = 1000;

/// A line on standard error that moves from [`PATIENCE`] on, however busy the program is.
struct ProgressLine {
    bar: ProgressBar,
    /// Ends the thread that brings the line up, when it is dropped.
    over: Option<Sender<()>>,
    thread: Option<JoinHandle<()>>,
}

impl ProgressLine {
    /// Nothing where standard error is no terminal.
    fn new(length: u64, style: ProgressStyle) -> Option<Self> {
        if !io::stderr().is_terminal() {
            return None;
        }
        let bar = ProgressBar::with_draw_target(Some(length), ProgressDrawTarget::hidden());
        bar.set_style(style);
        let (over, is_over) = channel();
        let shown = bar.clone();
        let bring_up = move || {
            if is_over.recv_timeout(PATIENCE) == Err(RecvTimeoutError::Timeout) {
                shown.set_draw_target(ProgressDrawTarget::stderr());
                shown.enable_steady_tick(REFRESH);
            }
        };
        // Without a thread there is no line, and no harm.
        let thread = thread::Builder::new().spawn(bring_up).ok();
        Some(Self {
            bar,
            over: Some(over),
            thread,
        })
    }
}

impl Drop for ProgressLine {
    fn drop(&mut self) {
        drop(self.over.take());
        if let Some(thread) = self.thread.take() {
            // It cannot panic, and if it did there would be no line to clear.
            let _ = thread.join();
        }
        self.bar.finish_and_clear();
    }
}

fn is_narrow() -> bool {
    crossterm::terminal::size().is_ok_and(|(columns, _)| usize::from(columns) < ROOM)
}

/// A style in which `left` is the time left, if the rest is as fast as what was done since
/// `before`, which was done already.
fn style(template: &str, before: u64) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key(
            "left",
            move |state: &ProgressState, text: &mut dyn fmt::Write| {
                let done = state.pos().saturating_sub(before);
                let rest = state.len().unwrap_or(0).saturating_sub(state.pos());
                if done > 0 && state.elapsed() > EARLY {
                    let left = state.elapsed().mul_f64(rest as f64 / done as f64);
                    let _ = write!(text, "{:#} left", HumanDuration(left));
                }
            },
        )
        .progress_chars("##-")
        .tick_chars("|/-\\ ")
}

/// The style of a command of which it is known, or not, which part is done. What is wide
/// is cut off where the line ends, so that no line is ever wrapped.
fn style_of(has_part: bool) -> ProgressStyle {
    let template = match (has_part, is_narrow()) {
        (true, false) => "{bar:24} {percent:>3} % {left:>9}  {wide_msg}",
        (true, true) => "{percent:>3} % {wide_msg}",
        (false, _) => "{spinner} {elapsed:>3}  {wide_msg}",
    };
    style(template, 0)
}

/// What a command is at, on standard error, if that is a terminal.
pub(in crate::commands) struct Waiting {
    line: Option<ProgressLine>,
    what: String,
    has_part: bool,
    due: Instant,
}

impl Waiting {
    pub fn new() -> Self {
        Self {
            line: ProgressLine::new(PARTS.into(), style_of(false)),
            ..Self::unseen()
        }
    }

    /// For nobody.
    pub fn unseen() -> Self {
        Self {
            line: None,
            what: String::new(),
            has_part: false,
            due: Instant::now(),
        }
    }

    /// Shows what the command is at, and a bar of the part of it that is done, if that is
    /// known; otherwise how long it has been at work.
    pub fn show(&mut self, what: &str, part: Option<f64>) {
        let Some(ProgressLine { bar, .. }) = &self.line else {
            return;
        };
        // Some tell it a thousand times between two looks, and measure times.
        let now = Instant::now();
        if what == self.what && now < self.due {
            return;
        }
        self.due = now + REFRESH;
        if self.has_part != part.is_some() {
            self.has_part = part.is_some();
            bar.set_style(style_of(self.has_part));
        }
        if what != self.what {
            what.clone_into(&mut self.what);
            bar.set_message(what.to_owned());
        }
        if let Some(part) = part {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "from 0 to 1000"
            )]
            bar.set_position((f64::from(PARTS) * part.clamp(0.0, 1.0)) as u64);
        }
    }
}

/// A bar on standard error that counts rows, if that is a terminal; rows are shown from
/// any thread.
pub(in crate::commands) struct RowsDone {
    line: Option<ProgressLine>,
    done: AtomicUsize,
    all: usize,
}

impl RowsDone {
    /// So many of `all` are done already, and say nothing about the time left.
    pub fn new(done: usize, all: usize) -> Self {
        let parts = |rows: usize| u64::from(PARTS) * rows as u64;
        let template = if is_narrow() {
            "{msg} rows  {elapsed}"
        } else {
            "{bar:30} {msg} rows  {elapsed}  {left}"
        };
        let wanted = (done < all).then(|| style(template, parts(done)));
        let line = wanted.and_then(|style| ProgressLine::new(parts(all), style));
        if let Some(ProgressLine { bar, .. }) = &line {
            bar.set_position(parts(done));
            bar.set_message(format!("{done}/{all}"));
        }
        Self {
            line,
            done: AtomicUsize::new(done),
            all,
        }
    }

    /// One row, of a scene, that begins.
    pub fn row(&self, scene: &Scene) -> RowOnItsWay<'_> {
        RowOnItsWay {
            rows: self,
            // A floor collision ends when it is over.
            duration: scene.duration.filter(|_| scene.gravity.is_some()),
            shown: 0,
        }
    }
}

/// A row that is measured.
pub(in crate::commands) struct RowOnItsWay<'a> {
    rows: &'a RowsDone,
    /// Of its run, s, where that is known before.
    duration: Option<f64>,
    /// Parts of it that the bar has.
    shown: u16,
}

impl RowOnItsWay<'_> {
    /// Its run has come to `time`, s.
    pub fn show(&mut self, time: f64) {
        if let Some(duration) = self.duration {
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "from 0 to 1000"
            )]
            self.come_to((f64::from(PARTS) * (time / duration).clamp(0.0, 1.0)) as u16);
        }
    }

    /// It is measured.
    pub fn done(mut self) {
        self.come_to(PARTS);
        let done = self.rows.done.fetch_add(1, Ordering::Relaxed) + 1;
        if let Some(ProgressLine { bar, .. }) = &self.rows.line {
            bar.set_message(format!("{done}/{}", self.rows.all));
        }
    }

    fn come_to(&mut self, parts: u16) {
        if let Some(ProgressLine { bar, .. }) = &self.rows.line
            && parts > self.shown
        {
            bar.inc(u64::from(parts - self.shown));
            self.shown = parts;
        }
    }
}
