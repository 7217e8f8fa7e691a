//! The loop of the screen thread. It knows no terminal but a backend, so that
//! tests run it as it is.

use std::collections::VecDeque;
use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, TrySendError, after, never, select};
use crossterm::event::{Event, KeyEventKind};
use ratatui::Terminal;
use ratatui::backend::Backend;
use ratatui::layout::Rect;

use super::input::Heard;
use super::judge::Judge;
use super::link::Link;
use super::model::Model;
use super::signals::{HANGUP, Signal};
use super::update::{Command, Msg, NewFile, update};
use super::view::view;
use crate::live::{Frame, Live, Order, Recording};
use crate::scene::Scene;
use crate::study::verdict::Verdict;

/// Everything that the loop hears and speaks to.
pub struct Wires {
    /// What the terminal says.
    pub heard: Heard,
    /// What the system asks.
    pub signals: Receiver<Signal>,
    /// The simulation thread.
    pub live: Live,
    /// The thread that judges scenes.
    pub judge: Judge,
}

/// What the loop asks of the real terminal; a test's does nothing.
pub trait Stage {
    /// Whether somebody could have this process go on once it has stopped.
    fn can_be_continued(&self) -> bool;
    /// Stop the whole job, as Ctrl-Z does.
    fn stop_job(&mut self);
    /// Show the terminal's own screen again, and go on listening.
    fn leave_screen(&mut self);
    /// Give the terminal back and stop this process.
    fn stop(&mut self);
    /// Take the terminal again.
    fn resume(&mut self);
    /// Put a text where the terminal's own pasting finds it.
    fn copy(&mut self, text: &str);
    /// A file of a new name that begins so, for a tape, and its name.
    ///
    /// # Errors
    /// When there can be none, in a line.
    fn open_tape(&mut self, stem: &str) -> Result<(String, Recording), String>;
    /// Write files of new names that begin so; their names.
    ///
    /// # Errors
    /// When they cannot be written, in a line.
    fn keep(&mut self, stem: &str, files: &[NewFile]) -> Result<Vec<String>, String>;
}

/// How the loop ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Ending {
    /// Somebody wanted to leave.
    Quit,
    /// A signal of that number, or its like.
    Signal(i32),
}

/// How soon to try again to hand over an order.
const RETRY: Duration = Duration::from_millis(20);

/// What woke the loop.
enum Wake {
    Input(Event),
    InputClosed,
    Leave,
    Signal(Signal),
    Receipt,
    Frame(Box<Frame>),
    FramesClosed,
    Verdict(Box<(Scene, Verdict)>),
    VerdictsClosed,
    Timer,
}

/// The loop's own state.
pub struct EventLoop<'a, B: Backend> {
    /// Where it draws.
    pub terminal: &'a mut Terminal<B>,
    /// What it draws.
    pub model: &'a mut Model,
    /// What it hears and speaks to.
    pub wires: &'a Wires,
    /// When it may draw.
    pub link: &'a mut Link,
    /// The real terminal's manners.
    pub stage: &'a mut dyn Stage,
    /// Orders that the simulation thread has no room for yet.
    pub pending: VecDeque<Order>,
}

impl<B: Backend> EventLoop<'_, B> {
    /// Draws what happens until somebody wants to leave, and leaves the screen. Without
    /// anything to draw or to hear it sleeps.
    ///
    /// # Errors
    /// When the terminal cannot be drawn to.
    pub fn run(&mut self) -> Result<Ending, B::Error> {
        let ending = self.run_until_left();
        self.leave_screen();
        ending
    }

    fn run_until_left(&mut self) -> Result<Ending, B::Error> {
        let mut changed = true;
        // It may have changed before anybody watched.
        self.follow_size()?;
        let (mut frames_open, mut verdicts_open) = (true, true);
        loop {
            let now = Instant::now();
            if changed && now >= self.link.next(now) {
                self.draw()?;
                changed = false;
            }
            self.ask_for_verdict();
            let wake = self.wait(frames_open, verdicts_open);
            changed |= !matches!(wake, Wake::Timer | Wake::Receipt);
            let command = match wake {
                Wake::Timer => None,
                Wake::Receipt => {
                    self.link.receipt(Instant::now());
                    None
                }
                Wake::Input(event) => self.on_input(event),
                Wake::Leave => return Ok(Ending::Quit),
                Wake::InputClosed => return Ok(Ending::Signal(HANGUP)),
                Wake::Signal(Signal::End(number)) => return Ok(Ending::Signal(number)),
                Wake::Signal(Signal::Resized) => {
                    self.follow_size()?;
                    None
                }
                Wake::Signal(Signal::Stop) => {
                    self.stop();
                    None
                }
                Wake::Signal(Signal::Continue) => {
                    self.stage.resume();
                    self.link.forget(Instant::now());
                    self.follow_size()?;
                    self.forget_screen()?;
                    None
                }
                Wake::Frame(frame) => update(self.model, Msg::Frame(frame), Instant::now()),
                Wake::Verdict(judged) => update(self.model, Msg::Verdict(judged), Instant::now()),
                Wake::VerdictsClosed => {
                    verdicts_open = false;
                    None
                }
                Wake::FramesClosed => {
                    frames_open = false;
                    update(self.model, Msg::SimulationEnded, Instant::now())
                }
            };
            if self.carry_out(command)? {
                return Ok(Ending::Quit);
            }
            self.hand_over();
        }
    }

    /// Has the scene judged that is on the bench now.
    fn ask_for_verdict(&mut self) {
        if let Some(scene) = self.model.unjudged() {
            // Without its thread there is no verdict, and all else goes on.
            let _ = self.wires.judge.scenes.send(scene);
        }
    }

    /// Waits for something to happen. Frames are fetched only when they can be drawn:
    /// until then they give way to newer ones.
    fn wait(&self, frames_open: bool, verdicts_open: bool) -> Wake {
        let now = Instant::now();
        let pause = self.link.next(now).saturating_duration_since(now);
        let timer = match (pause.is_zero(), self.pending.is_empty()) {
            (true, true) => never(),
            (false, true) => after(pause),
            (_, false) => after(RETRY),
        };
        let no_frames = never();
        let frames = if pause.is_zero() && frames_open {
            &self.wires.live.frames
        } else {
            &no_frames
        };
        let no_verdicts = never();
        let verdicts = if verdicts_open {
            &self.wires.judge.verdicts
        } else {
            &no_verdicts
        };
        let receipts = &self.wires.heard.receipts;
        select! {
            recv(self.wires.heard.events) -> event => event.map_or(Wake::InputClosed, Wake::Input),
            recv(self.wires.heard.leave) -> left => left.map_or(Wake::InputClosed, |()| Wake::Leave),
            recv(receipts) -> receipt => receipt.map_or(Wake::InputClosed, |()| Wake::Receipt),
            recv(self.wires.signals) -> signal => signal.map_or(Wake::Timer, Wake::Signal),
            recv(frames) -> frame => frame.map_or(Wake::FramesClosed, |frame| Wake::Frame(Box::new(frame))),
            recv(verdicts) -> judged => judged.map_or(Wake::VerdictsClosed, |judged| Wake::Verdict(Box::new(judged))),
            recv(timer) -> _ => Wake::Timer,
        }
    }

    fn on_input(&mut self, event: Event) -> Option<Command> {
        let msg = match event {
            Event::Key(key) if key.kind != KeyEventKind::Release => Msg::Key(key),
            Event::Paste(text) => Msg::Paste(text),
            Event::Resize(width, height) => Msg::Resize(width, height),
            _ => return None,
        };
        self.link.hurry();
        update(self.model, msg, Instant::now())
    }

    /// Does what is asked; whether that is to leave.
    fn carry_out(&mut self, command: Option<Command>) -> Result<bool, B::Error> {
        match command {
            None => {}
            Some(Command::Quit) => return Ok(true),
            Some(Command::Suspend) if self.stage.can_be_continued() => self.stage.stop_job(),
            Some(Command::Suspend) => self.say_nobody_continues(),
            Some(Command::Redraw) => {
                self.link.forget(Instant::now());
                self.forget_screen()?;
            }
            Some(Command::Order(order)) => self.send(order),
            Some(Command::Record(stem)) => match self.stage.open_tape(&stem) {
                Ok((name, recording)) => {
                    let line = format!("recording to {name}; R ends it");
                    self.model.say(line, false, Instant::now());
                    self.model.tape_name = Some(name);
                    self.send(Order::Record(Some(recording)));
                }
                Err(why) => self.model.say(why, true, Instant::now()),
            },
            Some(Command::Copy(text)) => self.stage.copy(&text),
            Some(Command::Keep { stem, files }) => {
                let kept = self.stage.keep(&stem, &files);
                let alarm = kept.is_err();
                let saved = |names: Vec<String>| format!("saved as {}", names.join(" and "));
                let line = kept.map_or_else(|why| why, saved);
                self.model.say(line, alarm, Instant::now());
            }
        }
        Ok(false)
    }

    /// Orders are never dropped, and never waited for either: one engine call may take
    /// long, and the keys must go on to work.
    fn send(&mut self, order: Order) {
        self.model.orders += 1;
        self.pending.push_back(order);
    }

    fn hand_over(&mut self) {
        while let Some(order) = self.pending.pop_front() {
            match self.wires.live.orders.try_send(order) {
                Ok(()) => {}
                Err(TrySendError::Full(order)) => {
                    self.pending.push_front(order);
                    return;
                }
                Err(TrySendError::Disconnected(_)) => {
                    self.pending.clear();
                    update(self.model, Msg::SimulationEnded, Instant::now());
                }
            }
        }
    }

    fn draw(&mut self) -> Result<(), B::Error> {
        let model = &*self.model;
        self.terminal.draw(|frame| view(model, frame))?;
        self.link.drawn(Instant::now());
        Ok(())
    }

    /// Has the model be as large as the terminal.
    fn follow_size(&mut self) -> Result<(), B::Error> {
        let size = self.terminal.size()?;
        if (size.width, size.height) != self.model.size {
            let resize = Msg::Resize(size.width, size.height);
            let command = update(self.model, resize, Instant::now());
            self.carry_out(command)?;
        }
        Ok(())
    }

    /// Stops this process, if somebody can have it go on.
    fn stop(&mut self) {
        if self.stage.can_be_continued() {
            self.leave_screen();
            self.stage.stop();
        } else {
            self.say_nobody_continues();
        }
    }

    fn say_nobody_continues(&mut self) {
        let why = "not stopped: no shell is here to continue it; q quits";
        self.model.say(why, true, Instant::now());
    }

    /// Shows the terminal's own screen, and waits for the answers that the terminal still
    /// owes: whoever reads it next would take them for keys.
    fn leave_screen(&mut self) {
        self.stage.leave_screen();
        let end = Instant::now() + self.link.longest_wait();
        while self.link.owed() > 0 {
            let left = end.saturating_duration_since(Instant::now());
            if self.wires.heard.receipts.recv_timeout(left).is_err() {
                return;
            }
            self.link.receipt(Instant::now());
        }
    }

    /// Nothing on the screen can be relied on: the next frame is drawn on an empty one.
    fn forget_screen(&mut self) -> Result<(), B::Error> {
        let size = self.terminal.size()?;
        self.terminal.resize(Rect {
            x: 0,
            y: 0,
            width: size.width,
            height: size.height,
        })
    }
}
