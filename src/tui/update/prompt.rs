//! Keys typed into a prompt, and what its line does.

use std::time::Instant;

use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use super::{Command, edit};
use crate::live::Order;
use crate::scene::SceneError;
use crate::scene::parameters::{self, Parameter};
use crate::tui::model::{Model, Overlay, Place, Prompt, Speed, speed_text};

/// What is no parameter of a scene, but is typed like one.
const SPEED: &str = "speed";
/// Lines that can be brought back.
const ENTERED: usize = 100;

/// What is wrong with a line, and where, in bytes.
struct Fault {
    why: String,
    at: usize,
}

/// Types a key into the prompt that is open.
pub(super) fn on_key(model: &mut Model, key: KeyEvent, now: Instant) -> Option<Command> {
    let Overlay::Prompt(prompt) = &mut model.overlay else {
        return None;
    };
    prompt.note = None;
    // Both together are AltGr somewhere, which writes characters.
    let control = key.modifiers & (KeyModifiers::CONTROL | KeyModifiers::ALT);
    match key.code {
        KeyCode::Char(c) if control == KeyModifiers::CONTROL => on_control(prompt, c),
        KeyCode::Char(c) => prompt.insert(c),
        KeyCode::Left => prompt.go(Place::Left),
        KeyCode::Right => prompt.go(Place::Right),
        KeyCode::Home => prompt.go(Place::Start),
        KeyCode::End => prompt.go(Place::End),
        KeyCode::Backspace => prompt.delete(Place::Left),
        KeyCode::Delete => prompt.delete(Place::Right),
        KeyCode::Up => prompt.recall(&model.entered, true),
        KeyCode::Down => prompt.recall(&model.entered, false),
        KeyCode::Tab => prompt.complete(&model.bench.parameters(), &[SPEED]),
        KeyCode::Esc => close(model),
        KeyCode::Enter => return enter(model, now),
        _ => {}
    }
    None
}

/// The keys of a shell's line.
fn on_control(prompt: &mut Prompt, c: char) {
    match c {
        'a' => prompt.go(Place::Start),
        'e' => prompt.go(Place::End),
        'w' => prompt.delete(Place::Word),
        'u' => prompt.delete(Place::Start),
        'k' => prompt.delete(Place::End),
        // What the backspace key of some terminals sends.
        'h' => prompt.delete(Place::Left),
        _ => {}
    }
}

/// Carries the line out; one that is wrong stays, to be mended.
fn enter(model: &mut Model, now: Instant) -> Option<Command> {
    let Overlay::Prompt(prompt) = &model.overlay else {
        return None;
    };
    let (parameter, text) = (prompt.parameter, prompt.text().to_owned());
    if text.trim().is_empty() {
        model.overlay = Overlay::None;
        return None;
    }
    match carry_out(model, parameter, &text, now) {
        Ok(command) => {
            close(model);
            Some(command)
        }
        Err(Fault { why, at }) => {
            if let Overlay::Prompt(prompt) = &mut model.overlay {
                prompt.refuse(why, at);
            }
            None
        }
    }
}

/// Closes the prompt, and keeps its line for later.
fn close(model: &mut Model) {
    if let Overlay::Prompt(prompt) = std::mem::replace(&mut model.overlay, Overlay::None) {
        let text = prompt.text().trim();
        let line = match prompt.parameter {
            _ if text.is_empty() => return,
            Some(parameter) if !text.contains('=') => format!("{}={text}", parameter.name),
            _ => text.to_owned(),
        };
        model.entered.retain(|earlier| *earlier != line);
        if model.entered.len() == ENTERED {
            model.entered.remove(0);
        }
        model.entered.push(line);
    }
}

/// Carries out what was typed: a value for `parameter`, or `name=value`.
fn carry_out(
    model: &mut Model,
    parameter: Option<&'static Parameter>,
    text: &str,
    now: Instant,
) -> Result<Command, Fault> {
    let start = text.len() - text.trim_start().len();
    let (name, value_at) = match (text.split_once('='), parameter) {
        (Some((name, value)), _) => {
            let spaces = value.len() - value.trim_start().len();
            (Some(name.trim()), name.len() + 1 + spaces)
        }
        (None, Some(_)) => (None, start),
        (None, None) => {
            return Err(Fault {
                why: format!("{}: type name=value, such as t_c=4.6us", text.trim()),
                at: text.trim_end().len(),
            });
        }
    };
    let value = text[value_at..].trim_end();
    if name == Some(SPEED) {
        let fault = |why| Fault { why, at: value_at };
        return set_speed(model, value, now).map_err(fault);
    }
    let named = match (name, parameter) {
        (None, Some(parameter)) => Ok(parameter),
        (name, _) => parameters::named(name.unwrap_or_default()),
    };
    let set = named.and_then(|parameter| {
        let value = parameters::parse(parameter, value)?;
        edit::set(model, parameter, value, now)
    });
    set.map_err(|error| Fault {
        at: match &error {
            SceneError::Unknown { .. } | SceneError::Absent { .. } => start,
            SceneError::Unit { unit, .. } => value_at + value.rfind(unit.as_str()).unwrap_or(0),
            _ => value_at,
        },
        why: error.to_string(),
    })
}

/// Carries out `speed=1/20`, or `speed=0.05`; or says why not.
fn set_speed(model: &mut Model, text: &str, now: Instant) -> Result<Command, String> {
    let number = |text: &str| text.trim().parse::<f64>().ok();
    let factor = match text.split_once('/') {
        Some((over, under)) => number(over)
            .zip(number(under))
            .map(|(over, under)| over / under),
        None => number(text),
    };
    let factor = factor
        .filter(|factor| factor.is_finite() && *factor > 0.0)
        .ok_or_else(|| format!("speed = {text}: must be a number above 0, such as 1/20"))?;
    let before = speed_text(model.speed.factor());
    model.speed = Speed::nearest(factor);
    let after = speed_text(model.speed.factor());
    let arrow = model.theme.symbol("→", "->");
    model.echo(format!("speed {before} {arrow} {after}"), now);
    Ok(Command::Order(Order::Speed(model.speed.factor())))
}
