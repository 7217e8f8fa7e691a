//! The explorer on the terminal.
//!
//! [`model::Model`] is everything that is shown, [`update::update`] changes it by
//! what happens, [`view::view`] draws it, and [`event_loop`] runs the three; the
//! other files are the terminal's manners. The loop runs on any backend.

pub mod event_loop;
mod guard;
pub mod judge;
pub mod keys;
mod layout;
pub mod link;
pub mod model;
mod numbers;
mod screen;
pub mod signals;
pub mod theme;
pub mod update;
pub mod view;
mod widgets;

use std::io;
use std::thread;
use std::time::Instant;

use crossbeam_channel::{Receiver, bounded};
use crossterm::event::Event;
use ratatui::Terminal;

use crate::live::{self, Build};
use crate::scene::Preset;
use event_loop::{Ending, EventLoop, Stage, Wires};
use guard::Guard;
use link::Link;
use model::Model;
use screen::Screen;
use theme::Theme;

/// Keys that wait for a busy screen.
const KEYS: usize = 256;

/// The real terminal's manners.
struct RealStage;

impl Stage for RealStage {
    fn stop_job(&mut self) {
        signals::stop_job();
    }

    fn stop(&mut self) {
        guard::leave();
        signals::stop_now();
    }

    fn resume(&mut self) {
        // A terminal that refuses has gone, and that is noticed elsewhere.
        let _ = guard::enter();
    }
}

/// Shows a preset on the terminal until somebody wants to leave.
///
/// # Errors
/// When the terminal or a thread cannot be had, or the preset's twin cannot be
/// loaded, in a sentence.
pub fn run(
    preset: Preset,
    speed: Option<f64>,
    theme: Theme,
    build: Build,
) -> Result<Ending, String> {
    let cannot = |what: &str| {
        let what = what.to_owned();
        move |error: io::Error| format!("cannot {what}: {error}")
    };
    let size = crossterm::terminal::size().map_err(cannot("learn the terminal's size"))?;
    let (mut model, start) = Model::new(preset, speed, theme, size)?;
    let live = live::spawn(build).map_err(cannot("start the simulation thread"))?;
    let judge = judge::spawn().map_err(cannot("start the judging thread"))?;
    let signals = signals::watch().map_err(cannot("watch signals"))?;
    guard::hook_panics();
    let guard = Guard::take().map_err(cannot("take the terminal"))?;
    let input = read_input().map_err(cannot("read the terminal"))?;
    live.orders
        .send(start)
        .map_err(|_| "the simulation thread has ended".to_owned())?;
    let wires = Wires {
        input,
        signals,
        live,
        judge,
    };
    let writer = guard::terminal().map_err(cannot("write to the terminal"))?;
    let (mut link, writer) = Link::new(writer, Instant::now());
    let ended = Terminal::new(Screen::new(writer)).and_then(|mut terminal| {
        let (terminal, model, stage) = (&mut terminal, &mut model, &mut RealStage);
        EventLoop {
            terminal,
            model,
            wires: &wires,
            link: &mut link,
            stage,
            pending: std::collections::VecDeque::new(),
        }
        .run()
    });
    drop(guard);
    // What can no longer be drawn to has gone.
    Ok(ended.unwrap_or(Ending::Signal(signals::HANGUP)))
}

/// Reads the terminal in a thread of its own.
fn read_input() -> io::Result<Receiver<Event>> {
    let (sender, receiver) = bounded(KEYS);
    thread::Builder::new().name("input".into()).spawn(move || {
        while let Ok(event) = crossterm::event::read() {
            if sender.send(event).is_err() {
                return;
            }
        }
    })?;
    Ok(receiver)
}
