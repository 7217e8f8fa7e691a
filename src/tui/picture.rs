//! What the traces show, as a picture and as a table of numbers, to be kept.

#[cfg(test)]
mod tests;

use std::borrow::Cow;
use std::collections::BTreeSet;

use super::model::{Ghost, Model, Page};
use super::numbers;
use super::widgets::title::in_words;
use crate::live::{ColumnSample, Sample, stride};
use crate::study::accuracy::facts;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle, svg_row};
use crate::study::table::{Cell, Column, Table};

/// So many pages after t = 0 times are told from when the page began.
const LATE: f64 = 50.0;

/// The picture: a plot a column, in the order of time where the screen starts over.
pub(super) fn svg(model: &Model) -> String {
    let units = Units::of(&model.page);
    let sides = 0..model.bench.scenes().len();
    let plots: Vec<Plot> = sides.map(|side| plot(model, side, &units)).collect();
    svg_row(&title(model), &plots)
}

fn title(model: &Model) -> String {
    format!("{}: {}", model.preset.name, model.as_preset().title)
}

/// What the axes are numbered in.
struct Units {
    x: Axis,
    y: Axis,
    /// The time, s, from which times count, and the units, s and m.
    from: f64,
    second: f64,
    metre: f64,
}

impl Units {
    fn of(page: &Page) -> Units {
        let (span, (start, _)) = (page.sweep.span, page.begun());
        // As on the screen.
        let (second, prefix) = if span >= 0.01 {
            (1.0, "")
        } else {
            numbers::prefix(span)
        };
        let late = start > LATE * span;
        let x = if late {
            format!("time after {} ({prefix}s)", numbers::clock(start, span))
        } else {
            format!("time ({prefix}s)")
        };
        let scale = page.trace_scale();
        let (metre, prefix) = numbers::prefix(scale.top().abs().max(scale.bottom().abs()));
        let y = match page.lens {
            None => format!("reduced heights ({prefix}m)"),
            Some(_) => format!("ways since the page began, bead above bead ({prefix}m)"),
        };
        Units {
            x: Axis::linear(x),
            y: Axis::linear(y),
            from: if late { start } else { 0.0 },
            second,
            metre,
        }
    }
}

/// The lines of a column, and behind them those of its ghost.
fn plot(model: &Model, side: usize, units: &Units) -> Plot {
    let page = &model.page;
    let live = page.visible(0.0).map(|(_, sample)| {
        let row = sample.rows.get(side).and_then(Option::as_ref);
        let drawn = row.and_then(|row| page.drawn(side, sample.time, row));
        (sample.time, drawn)
    });
    let live = lines(live, units);
    let ghost = page.ghost_rows(side).map(|(place, row)| {
        let (start, _) = page.begun();
        let fresh = place.mul_add(page.sweep.span, start);
        (page.time_at(place, 0.0).unwrap_or(fresh), row)
    });
    let ghost = lines(ghost, units);
    let mut series = Vec::new();
    for (name, style, lines) in [
        ("floor", SeriesStyle::Line, live.get(..1)),
        ("beads", SeriesStyle::Line, live.get(1..)),
        ("ghost", SeriesStyle::Behind, ghost.get(..)),
    ] {
        add(&mut series, name, style, lines.unwrap_or_default());
    }
    let scene = &model.bench.scenes()[side];
    Plot {
        name: String::new(),
        title: format!("{}  {}", model.label(side), in_words(scene)),
        x: units.x.clone(),
        y: units.y.clone(),
        series,
    }
}

/// Adds lines under one name.
fn add(series: &mut Vec<Series>, name: &str, style: SeriesStyle, lines: &[LinePieces]) {
    let mut pieces = lines.iter().flatten();
    let Some(first) = pieces.next() else {
        return;
    };
    let first = Series::new(name, first.clone()).with(style);
    let others: Vec<Series> = pieces
        .map(|points| Series::like(&first, points.clone()))
        .collect();
    series.push(first);
    series.extend(others);
}

/// A line in the pieces between which it is not known.
type LinePieces = Vec<Vec<(f64, f64)>>;

/// The lines of the floor and the beads, from the floor up.
fn lines<'a>(
    rows: impl Iterator<Item = (f64, Option<Cow<'a, ColumnSample>>)>,
    units: &Units,
) -> Vec<LinePieces> {
    let mut lines: Vec<LinePieces> = Vec::new();
    let mut before = f64::NAN;
    for (time, row) in rows {
        // Where a page starts over, or nothing is known, a line ends.
        let joined = before <= time;
        before = if row.is_some() { time } else { f64::NAN };
        let Some(row) = row else { continue };
        let heights = std::iter::once(row.floor).chain(row.reduced.iter().copied());
        for (k, z) in heights.enumerate() {
            if lines.len() == k {
                lines.push(Vec::new());
            }
            let line = &mut lines[k];
            if !joined || line.is_empty() {
                line.push(Vec::new());
            }
            let point = (
                (time - units.from) / units.second,
                f64::from(z) / units.metre,
            );
            line.last_mut()
                .into_iter()
                .for_each(|piece| piece.push(point));
        }
    }
    lines
}

/// The samples of the page, and of its ghost, as they were taken: a row a sample and column.
pub(super) fn data(model: &Model) -> Table {
    let scenes = model.bench.scenes();
    let page = &model.page;
    let live: Vec<&Sample> = page.visible(0.0).map(|(_, sample)| sample).collect();
    let ghost: Vec<&Sample> = page
        .shown_ghost()
        .into_iter()
        .flat_map(Ghost::samples)
        .collect();
    // Which bead each line of a column is.
    let numbers = |side: usize, row: &ColumnSample| -> Vec<usize> {
        let count = row.reduced.len();
        let beads = scenes.get(side).map_or(count, |scene| scene.layers());
        let below = |k: usize| (count - 1 - k) * stride(beads);
        (0..count).map(|k| beads.saturating_sub(below(k))).collect()
    };
    let mut beads = BTreeSet::new();
    for sample in live.iter().chain(&ghost) {
        for (side, row) in sample.rows.iter().enumerate() {
            beads.extend(row.iter().flat_map(|row| numbers(side, row)));
        }
    }
    let mut table = Table::new("", title(model), columns(&beads));
    let own = model.bench.own();
    table.facts = facts(own, &model.preset.name);
    for (side, scene) in scenes.iter().enumerate() {
        let fact = (model.label(side).to_owned(), in_words(scene));
        table.facts.push(fact);
    }
    table.notes = notes(model);
    for (samples, suffix) in [(live, ""), (ghost, " ghost")] {
        for sample in samples {
            for (side, row) in sample.rows.iter().enumerate() {
                let Some(row) = row else { continue };
                let mut cells = vec![
                    Cell::from(format!("{}{suffix}", model.label(side))),
                    Cell::from(sample.time),
                    single(row.floor),
                ];
                let numbers = numbers(side, row);
                cells.extend(beads.iter().map(|bead| {
                    let line = numbers.iter().position(|number| number == bead);
                    line.map_or(Cell::Empty, |line| single(row.reduced[line]))
                }));
                cells.extend([row.kinetic, row.relative].map(Cell::from));
                table.push(cells);
            }
        }
    }
    table
}

fn columns(beads: &BTreeSet<usize>) -> Vec<Column> {
    let bead = |bead: &usize| Column {
        name: format!("z{bead}").into(),
        ..Column::new("", "", "m")
    };
    let mut columns = vec![
        Column::new("column", "", ""),
        Column::new("time", "", "s"),
        Column::new("floor", "", "m"),
    ];
    columns.extend(beads.iter().map(bead));
    columns.extend(["kinetic", "relative"].map(|name| Column::new(name, "", "m²/s²")));
    columns
}

/// A number that is known in single precision, in its shortest digits.
fn single(x: f32) -> Cell {
    x.to_string().parse::<f64>().map_or(Cell::Empty, Cell::from)
}

fn notes(model: &Model) -> Vec<String> {
    let mut notes = vec![
        "floor and reduced heights z_i are in single precision, energies are per mass".to_owned(),
    ];
    if model.bench.is_lattice() {
        notes.push("z_i of 2D is the mean of row i".to_owned());
    }
    if model.page.lens.is_some() {
        notes.push("the picture shows how far each has moved since the page began".to_owned());
    }
    if model.page.shown_ghost().is_some() {
        notes.push("the ghost is a page that was kept, with the times of then".to_owned());
    }
    notes
}
