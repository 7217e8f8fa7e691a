//! Edits of the scenes on the bench, told to the simulation thread and repeated in a line.

use std::time::Instant;

use super::Command;
use crate::live::Order;
use crate::scene::parameters::{self, Parameter, Value};
use crate::scene::{Law, MethodName, Scene, SceneError};
use crate::tui::model::{Bench, Change, Model};
use crate::tui::theme::Theme;

/// A line repeats so many changes of one edit.
const MOST: usize = 3;

/// What can be edited, and its values.
struct Values {
    rows: Vec<(&'static Parameter, Value)>,
    method: MethodName,
}

impl Values {
    fn of(bench: &Bench) -> Self {
        let rows = bench.parameters().into_iter();
        Self {
            rows: rows
                .filter_map(|row| Some((row, bench.value(row)?)))
                .collect(),
            method: bench.scenes()[0].method.name(),
        }
    }

    /// What is different now, one change after another.
    fn changes(&self, now: &Self, theme: Theme) -> Vec<String> {
        let method = (self.method != now.method).then(|| {
            let (from, to) = (self.method.as_str(), now.method.as_str());
            format!("method {from} {} {to}", theme.symbol("→", "->"))
        });
        let rows = self.rows.iter().filter_map(|&(row, before)| {
            let &(_, after) = now.rows.iter().find(|(other, _)| other.name == row.name)?;
            (before != after).then(|| change(row, Some(before), after, theme))
        });
        method.into_iter().chain(rows).collect()
    }
}

/// A change of one parameter, as in "t_c 7.0 µs → 4.6 µs".
fn change(parameter: &Parameter, before: Option<Value>, after: Value, theme: Theme) -> String {
    let symbol = theme.symbol(parameter.symbol, parameter.symbol_ascii);
    let arrow = theme.symbol("→", "->");
    let shown = |value: Value| {
        if theme.ascii {
            parameters::display_ascii(parameter, value)
        } else {
            parameters::display(parameter, value)
        }
    };
    match before {
        None => format!("{symbol} {}", shown(after)),
        Some(before) if before == after => format!("{symbol} {}, as before", shown(after)),
        // Where four digits do not tell them apart all do.
        Some(before) if shown(before) == shown(after) => {
            let unit = theme.text(parameter.unit);
            format!("{symbol} {before} {arrow} {after} {unit}")
                .trim_end()
                .to_owned()
        }
        Some(before) => format!("{symbol} {} {arrow} {}", shown(before), shown(after)),
    }
}

/// Sets a parameter.
///
/// # Errors
/// The first scene's reason to refuse; nothing is changed then.
pub(super) fn set(
    model: &mut Model,
    parameter: &'static Parameter,
    value: Value,
    now: Instant,
) -> Result<Command, SceneError> {
    let before = model.bench.value(parameter);
    let changed = model.bench.set(parameter, value)?;
    // What was typed is what is repeated: α is kept as an amplitude, to the last bit or so.
    let mut told = vec![change(parameter, before, value, model.theme)];
    let ruled = |scene: &Scene| matches!(scene.law(), Some(Law::Power(_)));
    if parameter.name == "restitution" && model.bench.scenes().iter().any(ruled) {
        told.push("of hard spheres only: soft ones have that of their law".to_owned());
    }
    Ok(tell(model, &changed, told, now))
}

/// Moves a parameter, or the selected one, by key presses.
pub(super) fn nudge(
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
    match set(model, parameter, next, now) {
        Ok(command) => Some(command),
        Err(error) => {
            model.say(error.to_string(), true, now);
            None
        }
    }
}

fn at_the_end(parameter: &Parameter, value: Value) -> String {
    format!(
        "{} = {value}: must be {}",
        parameter.name,
        parameter.allowed()
    )
}

/// Changes the bench in another way, or says why that cannot be.
pub(super) fn rearrange(
    model: &mut Model,
    how: impl FnOnce(&mut Bench) -> Result<Change, String>,
    now: Instant,
) -> Option<Command> {
    let before = Values::of(&model.bench);
    match how(&mut model.bench) {
        Ok(changed) => {
            let mut told = before.changes(&Values::of(&model.bench), model.theme);
            if told.len() > MOST {
                let more = told.len() - MOST;
                told.truncate(MOST);
                told.push(format!("{more} more"));
            }
            let told = (!told.is_empty()).then(|| told.join(", "));
            Some(tell(model, &changed, told.into_iter().collect(), now))
        }
        Err(why) => {
            model.say(why, true, now);
            None
        }
    }
}

/// Tells the simulation thread of an edit, and the person at the keyboard.
fn tell(model: &mut Model, changed: &Change, mut told: Vec<String>, now: Instant) -> Command {
    let count = model.bench.parameters().len();
    model.selected = model.selected.min(count.saturating_sub(1));
    let order = match changed {
        Change::GoOn(from) => Order::Edit {
            scenes: model.bench.scenes().to_vec(),
            from: from.clone(),
        },
        Change::Restart => {
            told.push("this acts from the start: started again from t = 0".to_owned());
            let running = !model.paused || model.held;
            model.start(running)
        }
    };
    if !told.is_empty() {
        model.echo(told.join("; "), now);
    }
    Command::Order(order)
}
