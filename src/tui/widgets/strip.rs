//! A history on a logarithmic axis: E, or E_r/E, of both columns on the page of
//! the traces, and the numbers below it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::raster::Raster;
use super::rules;
use super::trace::clear;
use crate::live::ColumnSample;
use crate::math;
use crate::physics::Energy;
use crate::tui::model::Model;
use crate::tui::numbers;
use crate::tui::text::{columns, line};

/// What a history shows.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Graphed {
    /// Kinetic energy E.
    Kinetic,
    /// E_r/E: how much of it is motion of the beads against each other.
    Relative,
}

/// Powers of ten that the axis spans.
const DECADES: f64 = 4.0;
/// E_r/E of beads that move as one, their velocities each off by a last bit or some.
const ROUNDING: f64 = 1e-28;

impl Graphed {
    /// Its name, longest first.
    fn titles(self) -> &'static [&'static str] {
        match self {
            Graphed::Kinetic => &[
                "kinetic energy E per mass, m²/s²",
                "kinetic energy E",
                "energy E",
                "E",
            ],
            Graphed::Relative => &[
                "E_r/E: relative motion's part of E",
                "E_r/E relative part",
                "E_r/E",
            ],
        }
    }

    fn of(self, kinetic: f64, relative: f64) -> f64 {
        match self {
            Graphed::Kinetic => kinetic,
            Graphed::Relative if relative > ROUNDING * kinetic => relative / kinetic,
            Graphed::Relative => 0.0,
        }
    }

    /// Its value now.
    pub fn now(self, energy: &Energy) -> f64 {
        self.of(energy.kinetic, energy.relative)
    }

    /// The upper end of the axis as a power of ten.
    fn top(self, model: &Model) -> f64 {
        if self == Graphed::Relative {
            return 0.0;
        }
        let rows = model
            .page
            .samples
            .iter()
            .flat_map(|sample| sample.rows.iter().flatten());
        let largest = rows
            .map(|row| row.kinetic)
            .filter(|e| e.is_finite())
            .fold(0.0, f64::max);
        if largest > 0.0 {
            math::log10(largest).ceil()
        } else {
            0.0
        }
    }
}

/// Draws the history into the area, its title into the rule above.
pub fn render(model: &Model, quantity: Graphed, area: Rect, buffer: &mut Buffer) {
    if area.is_empty() {
        return;
    }
    let sides = u16::try_from(model.numbers.sides.len()).unwrap_or(0);
    let graph = Rect {
        height: area.height.saturating_sub(sides),
        ..area
    };
    let top = quantity.top(model);
    let above = Rect {
        y: area.y.saturating_sub(1),
        height: 1,
        ..area
    };
    let room = above.width.saturating_sub(rules::TITLE);
    let mut titles = quantity.titles().iter();
    let fits = |title: &&&str| columns(&model.theme.text(title)) <= room;
    if let Some(title) = titles.find(fits) {
        rules::title(model.theme, title, above, buffer);
    }
    draw(model, quantity, top, graph, buffer);
    label_axis(model, top, graph, buffer);
    for (index, side) in model.numbers.sides.iter().enumerate() {
        let row = graph.height + u16::try_from(index).unwrap_or(0);
        let value = numbers::short(quantity.now(&side.seen.energy));
        line(model.theme, buffer, area, row)
            .put(&format!("{} ", model.label(index)), model.theme.side(index))
            .number(&value, model.theme.strong());
    }
}

/// The ends of the axis, over the graph.
fn label_axis(model: &Model, top: f64, area: Rect, buffer: &mut Buffer) {
    let power = |p: f64| {
        if p == 0.0 {
            "1".to_owned()
        } else {
            format!("1e{p:.0}")
        }
    };
    let style = model.theme.quiet();
    if area.height > 1 {
        line(model.theme, buffer, area, 0).number(&power(top), style);
        line(model.theme, buffer, area, area.height - 1).number(&power(top - DECADES), style);
    }
}

fn draw(model: &Model, quantity: Graphed, top: f64, area: Rect, buffer: &mut Buffer) {
    let mut raster = Raster::new(area);
    // What is too small for the axis, 0 included, runs along its lower end.
    let place = |row: &ColumnSample| {
        let value = quantity.of(row.kinetic, row.relative);
        ((math::log10(value) - top + DECADES) / DECADES).clamp(0.0, 1.0)
    };
    for index in (0..model.bench.scenes().len()).rev() {
        let style = model.theme.side(index);
        let mut last: Option<(i32, i32)> = None;
        for (at, sample) in model.page.visible(clear(area)) {
            let row = sample.rows.get(index).and_then(Option::as_ref);
            let dot = row.and_then(|row| Some((raster.column(at), raster.row(place(row))?)));
            if let Some(dot) = dot {
                let from = last.filter(|last| last.0 <= dot.0).unwrap_or(dot);
                // Without colours the right column's line is told by its gaps.
                if model.theme.colour || index == 0 {
                    raster.line(from, dot, style);
                } else if dot.0 % 2 == 0 {
                    raster.dot(dot.0, dot.1, style);
                }
            }
            last = dot;
        }
    }
    raster.render(model.theme, buffer);
}
