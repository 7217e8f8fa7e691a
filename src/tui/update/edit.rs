//! Edits of the scenes on the bench, told to the simulation thread and repeated in a line.

use std::time::Instant;

use super::Command;
use crate::live::Order;
use crate::scene::parameters::{self, Parameter, Value};
use crate::scene::{MethodName, Scene, SceneError};
use crate::tui::model::{Bench, Change, Model};
use crate::tui::theme::Theme;

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
    let told = change(parameter, before, value, model.theme);
    let ruled = |scene: &Scene| scene.depends_on_speed();
    let ruled = parameter.name == "restitution" && model.bench.scenes().iter().any(ruled);
    let remark = ruled.then_some("of hard spheres only: soft ones have that of their law");
    Ok(tell(model, &changed, &[told], remark, now))
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
            let told = before.changes(&Values::of(&model.bench), model.theme);
            Some(tell(model, &changed, &told, None, now))
        }
        Err(why) => {
            model.say(why, true, now);
            None
        }
    }
}

/// Tells the simulation thread of an edit, and the person at the keyboard.
fn tell(
    model: &mut Model,
    changed: &Change,
    told: &[String],
    remark: Option<&str>,
    now: Instant,
) -> Command {
    let count = model.bench.parameters().len();
    model.selected = model.selected.min(count.saturating_sub(1));
    let (order, remark) = match changed {
        Change::GoOn(from) => {
            model.page.rearrange_ghost(from);
            let scenes = model.bench.scenes().to_vec();
            let from = from.clone();
            (Order::Edit { scenes, from }, remark)
        }
        Change::Restart => {
            let running = !model.paused || model.held;
            let remark = "this acts from the start: started again from t = 0";
            (model.start(running), Some(remark))
        }
    };
    let room = usize::from(model.size.0.saturating_sub(2));
    let line = line(told, remark, room);
    if !line.is_empty() {
        model.echo(line, now);
    }
    Command::Order(order)
}

/// Changes and what there is to remark on them, in a line: as many as have room, but the
/// remark in any case, and a change where there is none.
fn line(told: &[String], remark: Option<&str>, room: usize) -> String {
    let first = |shown: usize| {
        let more = told.len() - shown;
        let mut parts = told[..shown].to_vec();
        if more > 0 && shown > 0 {
            parts.push(format!("{more} more"));
        }
        let changes = parts.join(", ");
        let parts = [Some(changes.as_str()), remark];
        let parts = parts.into_iter().flatten().filter(|part| !part.is_empty());
        parts.collect::<Vec<_>>().join("; ")
    };
    let least = usize::from(remark.is_none()).min(told.len());
    (least..=told.len())
        .rev()
        .map(first)
        .find(|line| line.chars().count() <= room)
        .unwrap_or_else(|| first(least))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_remark_is_never_cut_for_the_sake_of_a_change() {
        let told = ["N 20 → 10".to_owned(), "ε 0.60 → 0.80".to_owned()];
        for (remark, room, expected) in [
            (None, 80, "N 20 → 10, ε 0.60 → 0.80"),
            (None, 20, "N 20 → 10, 1 more"),
            (None, 5, "N 20 → 10, 1 more"),
            (Some("restarted"), 40, "N 20 → 10, ε 0.60 → 0.80; restarted"),
            (Some("restarted"), 30, "N 20 → 10, 1 more; restarted"),
            (Some("restarted"), 20, "restarted"),
        ] {
            assert_eq!(line(&told, remark, room), expected);
        }
        assert_eq!(line(&[], None, 80), "");
        assert_eq!(line(&[], Some("restarted"), 80), "restarted");
    }
}
