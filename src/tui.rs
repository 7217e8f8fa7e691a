//! The explorer on the terminal.
//!
//! [`model::Model`] is everything that is shown, [`update::update`] changes it by
//! what happens, [`view::view`] draws it, and [`event_loop`] runs the three; the
//! other files are the terminal's manners. The loop runs on any backend.

mod caption;
pub mod event_loop;
mod files;
mod guard;
pub mod input;
pub mod judge;
pub mod keys;
mod layout;
pub mod link;
pub mod model;
mod numbers;
pub mod outbox;
mod picture;
mod screen;
pub mod signals;
mod text;
pub mod theme;
pub mod tmux;
mod tty;
pub mod update;
pub mod view;
mod widgets;

use std::io::{self, Write};
use std::path::Path;
use std::sync::Arc;
use std::time::{Duration, Instant};

use ratatui::Terminal;

use crate::live::{self, Build, Live, Order, Recording};
use crate::scene::Preset;
use crate::tape::Tape;
use event_loop::{Ending, EventLoop, Stage, Wires};
use guard::Guard;
use link::Link;
use model::{Model, Origin};
use outbox::{Outbox, StatusRequest};
use screen::Screen;
use theme::Theme;
use tmux::Passage;
use update::NewFile;

/// The end of a tape is waited for so long.
const LAST_WRITING: Duration = Duration::from_secs(1);

/// The real terminal's manners.
struct RealStage {
    outbox: Outbox,
}

impl Stage for RealStage {
    fn can_be_continued(&self) -> bool {
        signals::can_be_continued()
    }

    fn stop_job(&mut self) {
        signals::stop_job();
    }

    fn leave_screen(&mut self) {
        guard::leave_screen();
    }

    fn stop(&mut self) {
        guard::leave();
        signals::stop_now();
    }

    fn resume(&mut self) {
        // A terminal that refuses has gone, and that is noticed elsewhere.
        let _ = guard::enter();
    }

    fn copy(&mut self, text: &str) {
        self.outbox.copy(text);
    }

    fn open_tape(&mut self, stem: &str) -> Result<(String, Recording), String> {
        let (name, file) = files::create_new(Path::new(""), stem, "tape")?;
        Ok((name, Recording::new(Box::new(file))))
    }

    fn keep(&mut self, stem: &str, files: &[NewFile]) -> Result<Vec<String>, String> {
        files::write_new(Path::new(""), stem, files)
    }
}

/// Ends the simulation thread, which may have the end of a tape to write.
fn end(live: Live) {
    let Live { orders, frames } = live;
    drop(orders);
    let deadline = Instant::now() + LAST_WRITING;
    // Frames end with the thread.
    while frames.recv_deadline(deadline).is_ok() {}
}

/// What is shown, and how.
#[derive(Debug)]
pub struct Session {
    /// The preset, or of a tape one of its first column.
    pub preset: Preset,
    /// Where it came from.
    pub origin: Origin,
    /// Simulated seconds in a second; what suits the preset if not given.
    pub speed: Option<f64>,
    /// Memory for what was, to go back to, bytes.
    pub memory: usize,
    /// A tape to play in place of the preset.
    pub tape: Option<Arc<Tape>>,
    /// Where a tape of the session is written, and what that is called.
    pub recording: Option<(String, Recording)>,
}

/// Shows a session on the terminal until somebody wants to leave. A line that was asked for
/// is printed on leaving.
///
/// # Errors
/// When the terminal or a thread cannot be had, or the preset's twin cannot be
/// loaded, in a sentence.
pub fn run(session: Session, theme: Theme, build: Build) -> Result<Ending, String> {
    let cannot = |what: &str| {
        let what = what.to_owned();
        move |error: io::Error| format!("cannot {what}: {error}")
    };
    let (model, start) = Model::new(session.preset, session.speed, theme, screen::size())?;
    let mut model = model.from_origin(session.origin);
    let mut pending = std::collections::VecDeque::from([start]);
    if let Some((name, recording)) = session.recording {
        pending.push_back(Order::Record(Some(recording)));
        model.tape_name = Some(name);
    }
    pending.extend(session.tape.map(Order::Play));
    model.orders = pending.len() as u64;
    let live = live::spawn(build, session.memory).map_err(cannot("start the simulation thread"))?;
    let judge = judge::spawn().map_err(cannot("start the judging thread"))?;
    let signals = signals::watch().map_err(cannot("watch signals"))?;
    guard::hook_panics();
    let question = StatusRequest::detect(|name| std::env::var(name).ok());
    let _passage = (question == StatusRequest::Tmux).then(Passage::open);
    let guard = Guard::take().map_err(cannot("take the terminal"))?;
    let heard = input::listen().map_err(cannot("read the terminal"))?;
    let outbox = Outbox::spawn(question, guard::write).map_err(cannot("write to the terminal"))?;
    let wires = Wires {
        heard,
        signals,
        live,
        judge,
    };
    let mut link = Link::new(outbox.clone(), Instant::now());
    let mut stage = RealStage {
        outbox: outbox.clone(),
    };
    let ended = Terminal::new(Screen::new(outbox)).and_then(|mut terminal| {
        let (terminal, model, stage) = (&mut terminal, &mut model, &mut stage);
        EventLoop {
            terminal,
            model,
            wires: &wires,
            link: &mut link,
            stage,
            pending,
        }
        .run()
    });
    drop(guard);
    end(wires.live);
    if let Some(line) = &model.parting {
        // A terminal that is gone has no use for it.
        let _ = writeln!(io::stdout(), "{line}");
    }
    // What can no longer be drawn to has gone.
    Ok(ended.unwrap_or(Ending::Signal(signals::HANGUP)))
}
