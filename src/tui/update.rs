//! What happens changes the model, and may ask something of the world.

mod edit;
mod prompt;

use std::time::Instant;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::caption::ReadingTime;
use super::keys::{self, Action};
use super::model::{Bench, Menu, Model, Overlay, Prompt};
use super::picture;
use crate::live::{Frame, Leap, Order, Way};
use crate::scene::Scene;
use crate::study::verdict::Verdict;

/// What happens.
#[derive(Debug)]
pub enum Msg {
    /// A key.
    Key(KeyEvent),
    /// Text pasted into the terminal.
    Paste(String),
    /// The simulation thread shows itself.
    Frame(Box<Frame>),
    /// A scene is judged.
    Verdict(Box<(Scene, Verdict)>),
    /// The screen has another size.
    Resize(u16, u16),
    /// The simulation thread is gone.
    SimulationEnded,
}

/// A file that is to be written.
#[derive(Debug)]
pub struct NewFile {
    /// What follows the last dot of its name.
    pub ending: &'static str,
    /// What is in it.
    pub text: String,
}

/// What is asked of the world.
#[derive(Debug)]
pub enum Command {
    /// An order to the simulation thread.
    Order(Order),
    /// Write a tape of the session to a new file of that stem.
    Record(String),
    /// Put a text where the terminal's own pasting finds it.
    Copy(String),
    /// Write files whose names begin so, and say the names.
    Keep {
        /// What their names begin with.
        stem: String,
        /// The files.
        files: Vec<NewFile>,
    },
    /// Draw the whole screen again.
    Redraw,
    /// Stop as the shell's job.
    Suspend,
    /// Leave.
    Quit,
}

/// Pages of the list move by so many rows.
const LIST_PAGE: i32 = 8;
/// Pages of the help, lines.
const HELP_PAGE: u16 = 12;
/// A single step is what runs by in this long, s.
const STEP_SECONDS: f64 = 1.0 / 30.0;

/// Changes the model by what happened at `now`.
pub fn update(model: &mut Model, msg: Msg, now: Instant) -> Option<Command> {
    match msg {
        Msg::Key(key) => on_key(model, key, now),
        Msg::Paste(text) => {
            if let Overlay::Prompt(prompt) = &mut model.overlay {
                text.chars().for_each(|c| prompt.insert(c));
            }
            None
        }
        Msg::Verdict(judged) => {
            model.take_verdict(*judged);
            None
        }
        Msg::Frame(frame) => model.show(*frame, now).map(Command::Order),
        Msg::Resize(width, height) => {
            model.size = (width, height);
            // The texts are divided otherwise, and begin again.
            model.reading = ReadingTime::default();
            model.fit_page(false, true).map(Command::Order)
        }
        Msg::SimulationEnded => {
            model.paused = true;
            model.say("the simulation thread has ended; q quits", true, now);
            None
        }
    }
}

fn on_key(model: &mut Model, key: KeyEvent, now: Instant) -> Option<Command> {
    model.message = None;
    // Terminals join Esc and a key that follows soon, which tmux and screen take to be half a
    // second: nothing that lies over the screen knows Alt, and Esc closes it.
    let joined = matches!(key.code, KeyCode::Char(_)) && key.modifiers == KeyModifiers::ALT;
    if joined && !matches!(model.overlay, Overlay::None) {
        on_key(model, KeyCode::Esc.into(), now);
        return on_key(model, key.code.into(), now);
    }
    // These work everywhere.
    let everywhere = keys::action(key).filter(|_| key.modifiers.contains(KeyModifiers::CONTROL));
    if let Some(action @ (Action::Quit | Action::Suspend | Action::Redraw)) = everywhere {
        return act(model, action, now);
    }
    match &mut model.overlay {
        Overlay::None => keys::action(key).and_then(|action| act(model, action, now)),
        Overlay::Help(scrolled) => {
            match key.code {
                KeyCode::Down => *scrolled = scrolled.saturating_add(1),
                KeyCode::Up => *scrolled = scrolled.saturating_sub(1),
                KeyCode::PageDown => *scrolled = scrolled.saturating_add(HELP_PAGE),
                KeyCode::PageUp => *scrolled = scrolled.saturating_sub(HELP_PAGE),
                _ => model.overlay = Overlay::None,
            }
            None
        }
        Overlay::Presets(_) => on_menu_key(model, key, now),
        Overlay::Prompt(_) => prompt::on_key(model, key, now),
    }
}

fn on_menu_key(model: &mut Model, key: KeyEvent, now: Instant) -> Option<Command> {
    let Overlay::Presets(menu) = &mut model.overlay else {
        return None;
    };
    match key.code {
        KeyCode::Up | KeyCode::Char('k') => menu.select(-1),
        KeyCode::Down | KeyCode::Char('j') => menu.select(1),
        KeyCode::PageUp => menu.select(-LIST_PAGE),
        KeyCode::PageDown => menu.select(LIST_PAGE),
        KeyCode::Home => menu.select(i32::MIN),
        KeyCode::End => menu.select(i32::MAX),
        KeyCode::Enter | KeyCode::Char(' ') => {
            let chosen = menu.presets.get(menu.selected).cloned();
            model.overlay = Overlay::None;
            return match model.load(chosen?) {
                Ok(order) => Some(Command::Order(order)),
                Err(why) => {
                    model.say(why, true, now);
                    None
                }
            };
        }
        KeyCode::Esc | KeyCode::Char('p' | 'q') => model.overlay = Overlay::None,
        _ => {}
    }
    None
}

/// Shows the command line that makes what is simulated.
fn tell_command_line(model: &mut Model, now: Instant) -> Option<Command> {
    let Some(line) = model.command_line() else {
        let why = "no command line makes this scene; s saves it as a file";
        model.say(why, true, now);
        return None;
    };
    model.say(line.clone(), false, now);
    model.parting = Some(line.clone());
    Some(Command::Copy(line))
}

/// Begins a tape, or ends the one that is written.
fn record(model: &mut Model, now: Instant) -> Command {
    if model.recorded.is_none() {
        return Command::Record(model.preset.name.clone());
    }
    let name = model.tape_name.as_deref().unwrap_or("the tape");
    let line = format!("{name} is written; `beadlab replay` plays it");
    model.say(line, false, now);
    Command::Order(Order::Record(None))
}

/// Asks for a preset file of what is simulated.
fn save(model: &Model) -> Command {
    Command::Keep {
        stem: model.preset.name.clone(),
        files: vec![NewFile {
            ending: "toml",
            text: model.as_preset().to_toml(),
        }],
    }
}

/// Asks for files of what the traces show.
fn picture(model: &Model) -> Command {
    let file = |ending, text| NewFile { ending, text };
    Command::Keep {
        stem: model.preset.name.clone(),
        files: vec![
            file("svg", picture::svg(model)),
            file("csv", picture::data(model).csv()),
        ],
    }
}

/// Keeps the page behind those that follow, or lets it go.
fn toggle_ghost(model: &mut Model, now: Instant) {
    let told = if model.page.ghost.take().is_some() {
        "the ghost is gone"
    } else if model.keep_ghost() {
        "this page stays behind what follows, dim and dotted; g lets it go"
    } else {
        "nothing is drawn yet that could stay"
    };
    model.say(told, false, now);
}

/// Stands still, and asks for another time.
fn leap(model: &mut Model, to: Leap) -> Command {
    (model.paused, model.held) = (true, false);
    Command::Order(Order::Leap(to))
}

fn act(model: &mut Model, action: Action, now: Instant) -> Option<Command> {
    match action {
        Action::Pause => {
            model.paused = !model.paused;
            model.held = false;
            Some(Command::Order(Order::Run(!model.paused)))
        }
        Action::Frame(way) => {
            let sign = if way == Way::Back { -1.0 } else { 1.0 };
            let step = sign * model.speed.factor() * STEP_SECONDS;
            Some(leap(model, Leap::By(step)))
        }
        Action::Leap(to) => Some(leap(model, to)),
        Action::Restart => {
            let running = !model.paused || model.held;
            Some(Command::Order(model.start(running)))
        }
        Action::Speed(rungs) => {
            model.speed = model.speed.shifted(rungs);
            Some(Command::Order(Order::Speed(model.speed.factor())))
        }
        Action::LookInto => {
            let order = model.look_into_landing();
            match (&order, &model.page.lens) {
                (None, _) => {
                    let why = "hard spheres alone: their collisions take no time to look into";
                    model.say(why, false, now);
                }
                (Some(_), Some(_)) => {
                    let what = "a line is how far a bead moved since the page began; z goes back";
                    model.say(what, false, now);
                }
                (Some(_), None) => {}
            }
            order.map(Command::Order)
        }
        Action::Ghost => {
            toggle_ghost(model, now);
            None
        }
        Action::Method => edit::rearrange(model, Bench::next_method, now),
        Action::Twin => edit::rearrange(model, Bench::toggle_twin, now),
        Action::Shadow => Some(toggle_shadow(model, now)),
        Action::Presets => {
            model.overlay = Overlay::Presets(Menu::open(&model.preset.name));
            None
        }
        Action::Help => {
            model.overlay = Overlay::Help(0);
            None
        }
        Action::Select(rows) => {
            let count = model.bench.parameters().len();
            model.selected = super::model::moved(model.selected, rows, count);
            None
        }
        Action::Nudge {
            name,
            steps,
            coarse,
        } => edit::nudge(model, name, steps, coarse, now),
        Action::Exact => {
            let parameter = model.bench.parameters().get(model.selected).copied();
            model.overlay = Overlay::Prompt(Prompt::new(parameter));
            None
        }
        Action::Prompt => {
            model.overlay = Overlay::Prompt(Prompt::new(None));
            None
        }
        Action::Undo => {
            let undo = |bench: &mut Bench| bench.undo().ok_or("nothing to undo".to_owned());
            edit::rearrange(model, undo, now)
        }
        Action::Redo => {
            let redo = |bench: &mut Bench| bench.redo().ok_or("nothing to redo".to_owned());
            edit::rearrange(model, redo, now)
        }
        Action::Reset => {
            let pristine = || "this is the preset as it came".to_owned();
            let reset = |bench: &mut Bench| bench.reset().ok_or_else(pristine);
            edit::rearrange(model, reset, now)
        }
        Action::CommandLine => tell_command_line(model, now),
        Action::Save => Some(save(model)),
        Action::Record => Some(record(model, now)),
        Action::Picture => Some(picture(model)),
        Action::Redraw => Some(Command::Redraw),
        Action::Suspend => Some(Command::Suspend),
        Action::Quit => Some(Command::Quit),
    }
}

/// Exact runs in the shadow of soft columns, on or off; on again where one was given up.
fn toggle_shadow(model: &mut Model, now: Instant) -> Command {
    let references = model.bench.references();
    let refused = references.iter().find_map(|one| one.as_ref().err());
    let refused = refused.cloned();
    let off = model.shadow && !model.is_shadow_given_up();
    let none = references.iter().all(Result::is_err);
    model.shadow = !off && !none;
    if let Some(why) = refused.filter(|_| !off || none) {
        let whose = if none { "no error" } else { "MD only" };
        model.say(format!("{whose}: {why}"), none, now);
    }
    Command::Order(Order::Shadow(model.shadow))
}
