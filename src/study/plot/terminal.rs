//! A plot as text.

use super::axis::Tick;
use super::{Bounds, Plot, SeriesStyle, bounds};
use crate::study::table::wrapped;

/// Markers of series, in their order; told apart without colour.
const MARKERS: [char; 8] = ['o', 'x', '+', '*', '#', '@', '%', '&'];

/// Markers on a line that has none at its points.
const LINE_MARKS: usize = 4;

/// The least room in which a plot says anything.
const LEAST: (usize, usize) = (12, 4);

/// Dots of a cell in Braille.
const DOTS: [[u32; 4]; 2] = [[0x01, 0x02, 0x04, 0x40], [0x08, 0x10, 0x20, 0x80]];

/// A field of cells, each with dots and perhaps a marker.
struct Field {
    width: usize,
    height: usize,
    dots: Vec<u32>,
    marks: Vec<Option<char>>,
    ascii: bool,
}

impl Field {
    fn new(width: usize, height: usize, ascii: bool) -> Self {
        Self {
            width,
            height,
            dots: vec![0; width * height],
            marks: vec![None; width * height],
            ascii,
        }
    }

    /// Dots in a cell, across and down.
    fn grain(&self) -> (usize, usize) {
        if self.ascii { (1, 1) } else { (2, 4) }
    }

    /// The dot at these parts of width and height, counted from the lower left.
    fn at(&self, (x, y): (f64, f64)) -> (f64, f64) {
        let (across, down) = self.grain();
        let last = |cells: usize, grain: usize| (cells * grain - 1) as f64;
        (
            (x * last(self.width, across)).round(),
            ((1.0 - y) * last(self.height, down)).round(),
        )
    }

    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "dots of a field on the screen"
    )]
    fn cell(&self, (x, y): (f64, f64)) -> Option<(usize, usize, usize)> {
        if x < 0.0 || y < 0.0 {
            return None;
        }
        let ((across, down), (x, y)) = (self.grain(), (x as usize, y as usize));
        let (column, row) = (x / across, y / down);
        (column < self.width && row < self.height).then_some((
            row * self.width + column,
            x % across,
            y % down,
        ))
    }

    fn dot(&mut self, dot: (f64, f64)) {
        if let Some((cell, x, y)) = self.cell(dot) {
            self.dots[cell] |= if self.ascii { 1 } else { DOTS[x][y] };
        }
    }

    fn line(&mut self, from: (f64, f64), to: (f64, f64)) {
        let (a, b) = (self.at(from), self.at(to));
        let length = (b.0 - a.0).abs().max((b.1 - a.1).abs()).max(1.0);
        let mut step = 0.0;
        while step <= length {
            let part = step / length;
            let dot = (a.0 + part * (b.0 - a.0), a.1 + part * (b.1 - a.1));
            self.dot((dot.0.round(), dot.1.round()));
            step += 1.0;
        }
    }

    fn mark(&mut self, place: (f64, f64), marker: char) {
        if let Some((cell, ..)) = self.cell(self.at(place)) {
            self.marks[cell] = Some(marker);
        }
    }

    fn row(&self, row: usize) -> String {
        let cells = row * self.width..(row + 1) * self.width;
        let show = |cell: usize| match (self.marks[cell], self.dots[cell]) {
            (Some(marker), _) => marker,
            (None, 0) => ' ',
            (None, _) if self.ascii => '.',
            (None, dots) => char::from_u32(0x2800 + dots).unwrap_or('.'),
        };
        cells.map(show).collect()
    }
}

pub(super) fn draw(plot: &Plot, width: usize, height: usize, ascii: bool) -> String {
    let title = wrapped(&plot.title, width, "");
    let y_label = wrapped(&plot.y.label, width, "");
    let legend = legend(plot, width, ascii);
    let around = [&title, &y_label, &legend].map(|text| text.lines().count());
    // The frame below, ticks and label of the x axis take three lines more.
    let rows = height.saturating_sub(around.iter().sum::<usize>() + 3);
    let Some(bounds) = bounds(&[plot]) else {
        return format!("{title}(nothing to plot)\n");
    };
    let y_ticks = plot.y.ticks(bounds.1, rows / 3);
    let margin = y_ticks.iter().map(|tick| tick.label.len()).max();
    let margin = margin.unwrap_or(0);
    let columns = width.saturating_sub(margin + 2);
    if columns < LEAST.0 || rows < LEAST.1 {
        return format!("{title}(no room for the plot: {width}x{height})\n");
    }
    let mut field = Field::new(columns, rows, ascii);
    fill(plot, &mut field, bounds);
    let x_ticks = plot.x.ticks(bounds.0, columns / 10);
    let mut text = title + &y_label;
    text += &body(&field, bounds.1, &y_ticks, margin, ascii);
    text += &foot(&x_ticks, bounds.0, margin, columns, ascii);
    let indent = (margin + 2 + columns).saturating_sub(plot.x.label.chars().count());
    text += &" ".repeat(indent);
    text += &plot.x.label;
    text.push('\n');
    text + &legend
}

fn marker(k: usize) -> char {
    MARKERS[k % MARKERS.len()]
}

fn fill(plot: &Plot, field: &mut Field, (x, y): (Bounds, Bounds)) {
    let parts: Vec<Vec<_>> = plot
        .series
        .iter()
        .map(|series| {
            let places = plot.places(series);
            let part = |(a, b): (f64, f64)| (x.part(a), y.part(b));
            places.into_iter().map(part).collect()
        })
        .collect();
    for (series, parts) in plot.series.iter().zip(&parts) {
        if series.style != SeriesStyle::Points {
            for pair in parts.windows(2) {
                field.line(pair[0], pair[1]);
            }
        }
    }
    let looks = plot.named().count();
    for (k, (series, parts)) in plot.series.iter().zip(&parts).enumerate() {
        let look = plot.look(k);
        if series.style.is_line() {
            mark_line(field, parts, look, looks);
        } else {
            for &part in parts {
                field.mark(part, marker(look));
            }
        }
    }
}

/// A few markers on a line, which has no other name to be told apart by; those of
/// other lines are beside them.
fn mark_line(field: &mut Field, parts: &[(f64, f64)], k: usize, lines: usize) {
    let shift = (k + 1) as f64 / (lines + 1) as f64;
    for m in 0..LINE_MARKS {
        let wanted = (m as f64 + shift) / LINE_MARKS as f64;
        let distance = |part: &(f64, f64)| (part.0 - wanted).abs();
        let nearest = parts
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        if let Some(&part) = nearest {
            field.mark(part, marker(k));
        }
    }
}

/// The row or column of `cells` in which a part of the span lies.
#[expect(
    clippy::cast_possible_truncation,
    clippy::cast_sign_loss,
    reason = "a cell of a field on the screen"
)]
fn nearest_cell(part: f64, cells: usize) -> usize {
    (part * (cells - 1) as f64).round().max(0.0) as usize
}

fn body(field: &Field, bounds: Bounds, ticks: &[Tick], margin: usize, ascii: bool) -> String {
    let (edge, mark) = if ascii { ('|', '+') } else { ('│', '┤') };
    let mut text = String::new();
    for row in 0..field.height {
        let tick = ticks.iter().find(|tick| {
            field.height - 1 - nearest_cell(bounds.part(tick.place), field.height) == row
        });
        let label = tick.map_or("", |tick| &tick.label);
        let edge = if tick.is_some() { mark } else { edge };
        let line = format!("{label:>margin$} {edge}{}", field.row(row));
        text += line.trim_end();
        text.push('\n');
    }
    text
}

fn foot(ticks: &[Tick], bounds: Bounds, margin: usize, columns: usize, ascii: bool) -> String {
    let (corner, edge, mark) = if ascii {
        ('+', '-', '+')
    } else {
        ('└', '─', '┬')
    };
    let mut frame = vec![edge; columns];
    let mut labels = vec![' '; margin + 2 + columns];
    let mut free = 0;
    for tick in ticks {
        let column = nearest_cell(bounds.part(tick.place), columns);
        let length = tick.label.len();
        let begin = (margin + 2 + column)
            .saturating_sub(length / 2)
            .min(labels.len().saturating_sub(length));
        if begin < free {
            continue;
        }
        frame[column.min(columns - 1)] = mark;
        for (place, c) in labels[begin..].iter_mut().zip(tick.label.chars()) {
            *place = c;
        }
        free = begin + length + 1;
    }
    let frame: String = frame.into_iter().collect();
    let labels: String = labels.into_iter().collect();
    format!(
        "{} {corner}{frame}\n{}\n",
        " ".repeat(margin),
        labels.trim_end()
    )
}

fn legend(plot: &Plot, width: usize, ascii: bool) -> String {
    let dash = if ascii { "-" } else { "─" };
    let entry = |(k, series): (usize, &super::Series)| {
        let marker = if series.style.is_line() {
            format!("{dash}{}", marker(k))
        } else {
            marker(k).to_string()
        };
        format!("{marker} {}", series.name)
    };
    let entries: Vec<_> = plot.named().enumerate().map(entry).collect();
    words(&entries, width)
}

/// Entries in lines of at most `width`.
fn words(entries: &[String], width: usize) -> String {
    let mut text = String::new();
    let mut line = String::new();
    for entry in entries {
        let longer = line.chars().count() + 3 + entry.chars().count();
        if !line.is_empty() && longer > width {
            text += &line;
            text.push('\n');
            line.clear();
        }
        if !line.is_empty() {
            line += "   ";
        }
        line += entry;
    }
    text + &line + "\n"
}
