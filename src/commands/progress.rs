//! How far a run is, for a person who waits for it.

use indicatif::{HumanDuration, ProgressBar, ProgressDrawTarget, ProgressState, ProgressStyle};
use std::fmt;
use std::io::{self, IsTerminal};
use std::time::{Duration, Instant};

/// A run that is over by then needs no bar.
const PATIENCE: Duration = Duration::from_millis(500);

/// Time between two looks at the bar.
const REFRESH: Duration = Duration::from_millis(100);

/// Columns that a bar with all its words takes.
const ROOM: usize = 70;

/// Resolution of the bar.
const PARTS: f64 = 1000.0;

/// A bar on standard error, if that is a terminal and the run takes its time.
pub(in crate::commands) struct Progress {
    duration: Option<f64>,
    due: Instant,
    bar: Option<ProgressBar>,
    wanted: bool,
}

impl Progress {
    /// Of a run of that duration, s, or of one that ends when it is over.
    pub fn new(duration: Option<f64>) -> Self {
        let wanted = io::stderr().is_terminal();
        Self {
            duration,
            due: Instant::now() + PATIENCE,
            bar: None,
            wanted,
        }
    }

    /// Shows that the run has come to `time`, s.
    pub fn show(&mut self, time: f64) {
        if !self.wanted || Instant::now() < self.due {
            return;
        }
        self.due = Instant::now() + REFRESH;
        let bar = self
            .bar
            .get_or_insert_with(|| new_bar(self.duration.is_some()));
        bar.set_message(format!("t = {time:.3e} s"));
        if let Some(duration) = self.duration {
            // Between 0 and 1000, so that nothing is lost.
            #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
            bar.set_position((PARTS * time / duration) as u64);
        }
        bar.tick();
    }
}

impl Drop for Progress {
    fn drop(&mut self) {
        if let Some(bar) = &self.bar {
            bar.finish_and_clear();
        }
    }
}

fn new_bar(has_end: bool) -> ProgressBar {
    // What is wide is cut off where the line ends, so that no line is ever wrapped.
    let template = match (has_end, is_narrow()) {
        (true, false) => "{bar:24} {percent:>3} % {left:>9}  {wide_msg}",
        (true, true) => "{percent:>3} % {wide_msg}",
        (false, _) => "{spinner} {wide_msg}",
    };
    let style = style(template, 0).tick_chars("|/-\\ ");
    #[allow(clippy::cast_possible_truncation, clippy::cast_sign_loss)]
    let parts = has_end.then_some(PARTS as u64);
    ProgressBar::with_draw_target(parts, ProgressDrawTarget::stderr()).with_style(style)
}

fn is_narrow() -> bool {
    crossterm::terminal::size().is_ok_and(|(columns, _)| usize::from(columns) < ROOM)
}

/// A style in which `left` is the time left, once more than what was `done` before is.
fn style(template: &str, done: u64) -> ProgressStyle {
    ProgressStyle::with_template(template)
        .unwrap_or_else(|_| ProgressStyle::default_bar())
        .with_key(
            "left",
            move |state: &ProgressState, text: &mut dyn fmt::Write| {
                // Before the first part is done nobody knows.
                if state.pos() > done {
                    let _ = write!(text, "{:#} left", HumanDuration(state.eta()));
                }
            },
        )
        .progress_chars("##-")
}

/// A bar on standard error for a study of many runs, if that is a terminal.
pub(in crate::commands) struct Waiting(Option<ProgressBar>);

impl Waiting {
    pub fn new() -> Self {
        let wanted = io::stderr().is_terminal();
        Self(wanted.then(|| new_bar(true)))
    }

    /// Shows what the study is at, and which part of it is done.
    pub fn show(&mut self, what: &str, part: f64) {
        if let Some(bar) = &self.0 {
            bar.set_message(what.to_owned());
            #[expect(
                clippy::cast_possible_truncation,
                clippy::cast_sign_loss,
                reason = "from 0 to 1000"
            )]
            bar.set_position((PARTS * part.clamp(0.0, 1.0)) as u64);
            bar.tick();
        }
    }
}

impl Drop for Waiting {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}

/// A bar on standard error that counts rows, if that is a terminal; rows are counted
/// from any thread.
pub(in crate::commands) struct RowsDone(Option<ProgressBar>);

impl RowsDone {
    /// So many of `all` are done already, and say nothing about the time left.
    pub fn new(done: usize, all: usize) -> Self {
        let wanted = io::stderr().is_terminal() && done < all;
        Self(wanted.then(|| {
            let template = if is_narrow() {
                "{pos}/{len} rows"
            } else {
                "{bar:30} {pos}/{len} rows  {left}"
            };
            let style = style(template, done as u64);
            let target = ProgressDrawTarget::stderr();
            let bar = ProgressBar::with_draw_target(Some(all as u64), target).with_style(style);
            bar.set_position(done as u64);
            bar.reset_eta();
            bar.enable_steady_tick(PATIENCE);
            bar
        }))
    }

    /// One more is done.
    pub fn one_more(&self) {
        if let Some(bar) = &self.0 {
            bar.inc(1);
        }
    }
}

impl Drop for RowsDone {
    fn drop(&mut self) {
        if let Some(bar) = &self.0 {
            bar.finish_and_clear();
        }
    }
}
