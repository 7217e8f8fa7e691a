//! What happens changes the model, and may ask something of the world.

use std::time::Instant;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::keys::{self, Action};
use super::model::{Change, Menu, Model, Overlay, Prompt, Speed};
use crate::live::{Frame, Order};
use crate::scene::parameters::{self, Parameter, Value};
use crate::scene::{Law, Scene};
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

/// What is asked of the world.
#[derive(Debug)]
pub enum Command {
    /// An order to the simulation thread.
    Order(Order),
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
                text.chars().for_each(|c| prompt.push(c));
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
        Overlay::Prompt(_) => on_prompt_key(model, key, now),
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

fn on_prompt_key(model: &mut Model, key: KeyEvent, now: Instant) -> Option<Command> {
    let Overlay::Prompt(prompt) = &mut model.overlay else {
        return None;
    };
    match key.code {
        KeyCode::Char('u') if key.modifiers.contains(KeyModifiers::CONTROL) => prompt.text.clear(),
        KeyCode::Char(c) => prompt.push(c),
        KeyCode::Backspace => {
            prompt.text.pop();
        }
        KeyCode::Esc => model.overlay = Overlay::None,
        KeyCode::Enter => {
            let (parameter, text) = (prompt.parameter, std::mem::take(&mut prompt.text));
            model.overlay = Overlay::None;
            return commit(model, parameter, &text, now);
        }
        _ => {}
    }
    None
}

/// Carries out what was typed: a value for `parameter`, or `name=value`.
fn commit(
    model: &mut Model,
    parameter: Option<&'static Parameter>,
    text: &str,
    now: Instant,
) -> Option<Command> {
    let text = text.trim();
    if text.is_empty() {
        return None;
    }
    let entry = match (text.split_once('='), parameter) {
        (Some((name, value)), _) if name.trim() == "speed" => return type_speed(model, value, now),
        (Some((name, value)), _) => parameters::named(name.trim()).map(|found| (found, value)),
        (None, Some(parameter)) => Ok((parameter, text)),
        (None, None) => {
            model.say(
                format!("{text}: type name=value, such as restitution=0.9"),
                true,
                now,
            );
            return None;
        }
    };
    let entry = entry.and_then(|(parameter, value)| {
        parameters::parse(parameter, value).map(|value| (parameter, value))
    });
    match entry {
        Ok((parameter, value)) => set(model, parameter, value, now),
        Err(error) => {
            model.say(error.to_string(), true, now);
            None
        }
    }
}

/// Sets a parameter, or says why not.
fn set(
    model: &mut Model,
    parameter: &'static Parameter,
    value: Value,
    now: Instant,
) -> Option<Command> {
    match model.bench.set(parameter, value) {
        Ok(change) => {
            let command = changed(model, change, now);
            let ruled = |scene: &Scene| matches!(scene.law(), Some(Law::Power(_)));
            if parameter.name == "restitution" && model.bench.scenes().iter().any(ruled) {
                model.say(
                    "of hard spheres only: soft ones have the restitution of their law",
                    false,
                    now,
                );
            }
            Some(command)
        }
        Err(error) => {
            model.say(error.to_string(), true, now);
            None
        }
    }
}

/// `speed=1/20`, or `speed=0.05`.
fn type_speed(model: &mut Model, text: &str, now: Instant) -> Option<Command> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let factor = match text.split_once('/') {
        Some((over, under)) => number(over)
            .zip(number(under))
            .map(|(over, under)| over / under),
        None => number(text),
    };
    if let Some(factor) = factor.filter(|factor| factor.is_finite() && *factor > 0.0) {
        model.speed = Speed::nearest(factor);
        return Some(Command::Order(Order::Speed(model.speed.factor())));
    }
    model.say(
        format!(
            "speed = {}: must be a number above 0, such as 1/20",
            text.trim()
        ),
        true,
        now,
    );
    None
}

fn act(model: &mut Model, action: Action, now: Instant) -> Option<Command> {
    match action {
        Action::Pause => {
            model.paused = !model.paused;
            model.held = false;
            Some(Command::Order(Order::Run(!model.paused)))
        }
        Action::StepFrame => {
            model.paused = true;
            let step = model.speed.factor() * STEP_SECONDS;
            Some(Command::Order(Order::Step(step)))
        }
        Action::StepEvent => {
            model.paused = true;
            Some(Command::Order(Order::NextEvent))
        }
        Action::Restart => {
            let running = !model.paused || model.held;
            Some(Command::Order(model.start(running)))
        }
        Action::Speed(rungs) => {
            model.speed = model.speed.shifted(rungs);
            Some(Command::Order(Order::Speed(model.speed.factor())))
        }
        Action::Method => {
            let change = model.bench.next_method();
            changed_or_said(model, change, now)
        }
        Action::Twin => {
            let change = model.bench.toggle_twin();
            changed_or_said(model, change, now)
        }
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
        } => nudge(model, name, steps, coarse, now),
        Action::Exact => {
            let parameter = model.bench.parameters().get(model.selected).copied();
            model.overlay = Overlay::Prompt(Prompt {
                parameter,
                text: String::new(),
            });
            None
        }
        Action::Prompt => {
            model.overlay = Overlay::Prompt(Prompt {
                parameter: None,
                text: String::new(),
            });
            None
        }
        Action::Undo => {
            let change = model
                .bench
                .undo()
                .ok_or_else(|| "nothing to undo".to_owned());
            changed_or_said(model, change, now)
        }
        Action::Redo => {
            let change = model
                .bench
                .redo()
                .ok_or_else(|| "nothing to redo".to_owned());
            changed_or_said(model, change, now)
        }
        Action::Reset => {
            let change = model
                .bench
                .reset()
                .ok_or_else(|| "this is the preset as it came".to_owned());
            changed_or_said(model, change, now)
        }
        Action::Redraw => Some(Command::Redraw),
        Action::Suspend => Some(Command::Suspend),
        Action::Quit => Some(Command::Quit),
    }
}

/// Exact runs in the shadow of soft columns, on or off; on again where one was given up.
fn toggle_shadow(model: &mut Model, now: Instant) -> Command {
    let checks = model.bench.checks();
    let refused = checks
        .iter()
        .find_map(|check| check.reference.as_ref().err());
    let refused = refused.cloned();
    let off = model.shadow && !model.is_shadow_given_up();
    let none = checks.iter().all(|check| check.reference.is_err());
    model.shadow = !off && !none;
    if let Some(why) = refused.filter(|_| !off || none) {
        let whose = if none { "no error" } else { "MD only" };
        model.say(format!("{whose}: {why}"), none, now);
    }
    Command::Order(Order::Shadow(model.shadow))
}

fn nudge(
    model: &mut Model,
    name: Option<&'static str>,
    steps: i32,
    coarse: bool,
    now: Instant,
) -> Option<Command> {
    let rows = model.bench.parameters();
    let index = match name {
        Some(name) => rows.iter().position(|parameter| parameter.name == name),
        None => Some(model.selected.min(rows.len().saturating_sub(1))),
    };
    let Some(parameter) = index.and_then(|index| rows.get(index).copied()) else {
        model.say(
            format!("this scene does not have {}", name.unwrap_or("parameters")),
            true,
            now,
        );
        return None;
    };
    model.selected = index.unwrap_or(model.selected);
    let value = model.bench.value(parameter)?;
    let next = parameters::nudge(parameter, value, steps, coarse);
    if next == value {
        model.say(at_the_end(parameter, value), false, now);
        return None;
    }
    set(model, parameter, next, now)
}

fn at_the_end(parameter: &Parameter, value: Value) -> String {
    format!(
        "{} = {value}: must be {}",
        parameter.name,
        parameter.allowed()
    )
}

fn changed_or_said(
    model: &mut Model,
    change: Result<Change, String>,
    now: Instant,
) -> Option<Command> {
    match change {
        Ok(change) => Some(changed(model, change, now)),
        Err(why) => {
            model.say(why, true, now);
            None
        }
    }
}

/// Tells the simulation thread of an edit.
fn changed(model: &mut Model, change: Change, now: Instant) -> Command {
    let count = model.bench.parameters().len();
    model.selected = model.selected.min(count.saturating_sub(1));
    Command::Order(match change {
        Change::GoOn(from) => Order::Edit {
            scenes: model.bench.scenes().to_vec(),
            from,
        },
        Change::Restart => {
            model.say(
                "this acts from the start: started again from t = 0",
                false,
                now,
            );
            let running = !model.paused || model.held;
            model.start(running)
        }
    })
}
