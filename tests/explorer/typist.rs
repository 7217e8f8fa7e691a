//! Keys typed on a model without a simulation, and what came of them.

#![allow(
    clippy::needless_pass_by_value,
    reason = "predicates of what was just returned"
)]

use std::time::Instant;

use beadlab::live::Order;
use beadlab::tui::model::{Model, Overlay};
use beadlab::tui::update::{Command, Msg, update};
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::play::{COLOURS, preset};

/// A model of a preset on 80 by 24, without a simulation.
pub fn model(name: &str) -> Model {
    Model::new(preset(name), None, COLOURS, (80, 24))
        .expect("the preset has its twin")
        .0
}

/// Presses a key.
pub fn press(model: &mut Model, code: KeyCode) -> Option<Command> {
    let key = KeyEvent::new(code, KeyModifiers::NONE);
    update(model, Msg::Key(key), Instant::now())
}

/// Types a text, a line end being the enter key; what the last key asks for.
pub fn type_keys(model: &mut Model, keys: &str) -> Option<Command> {
    let code = |c| match c {
        '\n' => KeyCode::Enter,
        c => KeyCode::Char(c),
    };
    keys.chars().map(|c| press(model, code(c))).last().flatten()
}

/// Types a line and enters it.
pub fn enter(model: &mut Model, text: &str) -> Option<Command> {
    type_keys(model, text);
    press(model, KeyCode::Enter)
}

/// Types a line that is refused: what is said of it, and the line with a bar at the fault.
/// The line is left.
pub fn refuse(model: &mut Model, text: &str) -> (String, String) {
    assert!(enter(model, text).is_none(), "{text}");
    let Overlay::Prompt(prompt) = &model.overlay else {
        panic!("{text}: the line stays open")
    };
    let note = prompt.note.as_ref().expect("it is told");
    assert!(note.alarm && note.text.lines().count() == 1, "{text}");
    let (before, after) = prompt.text().split_at(prompt.cursor());
    let told = (note.text.clone(), format!("{before}|{after}"));
    press(model, KeyCode::Esc);
    told
}

pub fn message(model: &Model) -> &str {
    model.message.as_ref().map_or("", |message| &message.text)
}

pub fn edited(command: Option<Command>) -> bool {
    matches!(command, Some(Command::Order(Order::Edit { .. })))
}

pub fn restarted(command: Option<Command>) -> bool {
    matches!(command, Some(Command::Order(Order::Load { .. })))
}

pub fn restitutions(model: &Model) -> Vec<f64> {
    model
        .bench
        .scenes()
        .iter()
        .map(|scene| scene.restitution)
        .collect()
}
