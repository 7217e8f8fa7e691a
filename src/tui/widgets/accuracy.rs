//! What a column's numbers are worth: its error against the run in its shadow, in a line
//! and as a history, and the warning of steps that are too long.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::raster::Raster;
use super::rules;
use super::trace::clear;
use crate::live::{Accuracy, Status};
use crate::math;
use crate::tui::model::{Model, Notice};
use crate::tui::numbers::{clock, scientific, short, with_unit};
use crate::tui::text::{columns, fitted, line};

/// The axis of the history: from the rounding of a diameter to a diameter, in powers of
/// ten.
const BOTTOM: f64 = -18.0;
const TOP: f64 = 1.0;
/// An error is of now unless it is older than this, s of wall time.
const LATE: f64 = 0.3;

/// Draws the lines about the columns.
pub fn render_notices(model: &Model, area: Rect, buffer: &mut Buffer) {
    for (row, notice) in (0..area.height).zip(model.notices()) {
        render_notice(model, notice, area, row, buffer);
    }
}

/// Draws a line about a column.
pub fn render_notice(model: &Model, notice: Notice, area: Rect, row: u16, buffer: &mut Buffer) {
    let (Notice::TooFewSteps { side, .. } | Notice::Error { side }) = notice;
    let theme = model.theme;
    let mut line = line(theme, buffer, area, row);
    line.skip(1)
        .put(model.label(side), theme.side(side).patch(theme.strong()))
        .put(" ", Style::new());
    let room = line.room();
    let (texts, style) = match notice {
        Notice::TooFewSteps { least, .. } => (too_few(least), theme.alarm()),
        Notice::Error { .. } => error(model, side),
    };
    let shown = texts
        .iter()
        .find(|text| columns(&theme.text(text)) <= room)
        .or(texts.last());
    if let Some(text) = shown {
        line.put(&fitted(&theme.text(text), room), style);
    }
}

fn too_few(least: f64) -> Vec<String> {
    let least = least.ceil();
    vec![
        format!("unstable: closed contacts need steps_per_contact of at least {least}"),
        format!("unstable: needs steps_per_contact >= {least}"),
        format!("unstable: steps < {least}"),
    ]
}

/// The error in words, longest first, and how they are written.
fn error(model: &Model, side: usize) -> (Vec<String>, Style) {
    let theme = model.theme;
    let reference = model.bench.references().get(side);
    let against = match reference {
        Some(Ok(scene)) => match scene.tolerance() {
            Some(tolerance) => format!("tolerance {tolerance:.0e}"),
            None => "exact".to_owned(),
        },
        _ => return (Vec::new(), theme.quiet()),
    };
    let shown = model.numbers.sides.get(side);
    if shown.is_some_and(|side| matches!(side.status, Status::Failed(_))) {
        return (
            vec!["no error: the column has stopped".to_owned()],
            theme.quiet(),
        );
    }
    match shown.and_then(|side| side.accuracy.as_ref()) {
        Some(Accuracy::GivenUp(why)) => (
            vec![
                format!("no error: the {against} run is given up, {why}: slow down ([), then x"),
                format!("no error: {why}: [ then x"),
                "no error".to_owned(),
            ],
            theme.alarm(),
        ),
        Some(Accuracy::Follows {
            since,
            distance: Some(distance),
        }) => {
            let size = model.bench.scenes()[side].diameter;
            let height = length(distance.height);
            let share = short(distance.height / size);
            let energy = short(distance.energy);
            let span = model.page.sweep.span;
            // A number that lags behind the column says when it was true.
            let lag = shown.map_or(0.0, |side| side.seen.time - distance.time);
            let when = if lag > LATE * model.speed.factor() {
                format!("at {}", clock(distance.time, span))
            } else {
                format!("since {}", clock(*since, span))
            };
            (
                vec![
                    format!("off {against} by {height} = {share} d, E by {energy}, {when}"),
                    format!("off {against} by {share} d, E by {energy}"),
                    format!("error {share} d"),
                ],
                theme.strong(),
            )
        }
        _ => (
            vec![format!("against {against}: not compared yet")],
            theme.quiet(),
        ),
    }
}

/// A length that may be far below any unit's prefix.
fn length(x: f64) -> String {
    if x > 0.0 && x < 1e-12 {
        format!("{} m", scientific(x))
    } else {
        with_unit(x, "m")
    }
}

/// Draws the history of the errors on the page of the traces, in diameters, on a
/// logarithmic axis that is the same for every scene.
pub fn render_history(model: &Model, area: Rect, buffer: &mut Buffer) {
    if area.is_empty() {
        return;
    }
    let theme = model.theme;
    let above = Rect {
        y: area.y.saturating_sub(1),
        height: 1,
        ..area
    };
    rules::title(theme, "error/d", above, buffer);
    let sides: Vec<usize> = model
        .notices()
        .into_iter()
        .filter_map(|notice| match notice {
            Notice::Error { side } => Some(side),
            Notice::TooFewSteps { .. } => None,
        })
        .collect();
    let numbers = u16::try_from(sides.len()).unwrap_or(0);
    let graph = Rect {
        height: area.height.saturating_sub(numbers),
        ..area
    };
    draw(model, &sides, graph, buffer);
    if graph.height > 1 {
        let labels = [(0, TOP), (graph.height - 1, BOTTOM)];
        for (row, power) in labels {
            line(theme, buffer, graph, row).number(&format!("1e{power:.0}"), theme.quiet());
        }
    }
    for (row, side) in (graph.height..).zip(sides) {
        line(theme, buffer, area, row)
            .put(&format!("{} ", model.label(side)), theme.side(side))
            .number(&now(model, side), theme.strong());
    }
}

/// The error now, in diameters.
fn now(model: &Model, side: usize) -> String {
    let shown = model.numbers.sides.get(side);
    match shown.and_then(|side| side.accuracy.as_ref()) {
        Some(Accuracy::Follows {
            distance: Some(distance),
            ..
        }) => short(distance.height / model.bench.scenes()[side].diameter),
        Some(Accuracy::GivenUp(_)) => "given up".to_owned(),
        _ => "-".to_owned(),
    }
}

fn draw(model: &Model, sides: &[usize], area: Rect, buffer: &mut Buffer) {
    let mut raster = Raster::new(area);
    for &side in sides.iter().rev() {
        let (style, size) = (model.theme.side(side), model.bench.scenes()[side].diameter);
        // No error at all runs along the lower end.
        let place =
            |error: f64| ((math::log10(error / size) - BOTTOM) / (TOP - BOTTOM)).clamp(0.0, 1.0);
        let mut last: Option<(i32, i32)> = None;
        for (at, sample) in model.page.visible(clear(area)) {
            let error = sample.rows.get(side).and_then(|row| row.as_ref()?.error);
            let dot = error.and_then(|error| Some((raster.column(at), raster.row(place(error))?)));
            if let Some(dot) = dot {
                raster.line(
                    last.filter(|last| last.0 <= dot.0).unwrap_or(dot),
                    dot,
                    style,
                );
            }
            last = dot;
        }
    }
    raster.render(model.theme, buffer);
}
