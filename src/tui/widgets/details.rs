//! More numbers, for screens that have room for them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use super::text::line;
use crate::physics::Observation;
use crate::tui::model::Model;
use crate::tui::numbers::{scientific, short, with_unit};

/// A quantity and how it is written.
type Detail = (&'static str, fn(&Observation) -> String);

/// Columns that a number takes, and a space.
const NARROWEST: u16 = 9;

/// In the order in which they are given up where there is no room.
const DETAILS: [Detail; 8] = [
    ("h_cm", |seen| with_unit(seen.centre, "m")),
    ("drift", |seen| scientific(seen.energy.drift)),
    ("lost", |seen| short(seen.energy.lost)),
    ("plate", |seen| short(seen.energy.plate_work)),
    ("E_pot", |seen| short(seen.energy.potential)),
    ("E_el", |seen| short(seen.energy.elastic)),
    ("t_k", |seen| {
        let span = seen
            .floor_touched
            .zip(seen.floor_left)
            .map(|(first, last)| last - first);
        span.map_or_else(|| "-".into(), |span| with_unit(span, "s"))
    }),
    ("count", |seen| (seen.steps + seen.events).to_string()),
];

/// Draws a table: a quantity a line, a column of beads a column.
pub fn render(model: &Model, area: Rect, buffer: &mut Buffer) {
    let sides = &model.numbers.sides;
    if area.height < 3 || sides.is_empty() {
        return;
    }
    let theme = model.theme;
    let count = u16::try_from(sides.len()).unwrap_or(1);
    let width = area.width.saturating_sub(6) / count;
    if width < NARROWEST {
        return;
    }
    for (row, (name, write)) in (1..area.height).zip(DETAILS) {
        line(theme, buffer, area, row).put(name, theme.quiet());
        for (index, side) in (0..count).zip(sides) {
            let cell = Rect {
                x: area.x + 6 + index * width,
                width: width - 1,
                ..area
            };
            let style = theme.side(usize::from(index));
            line(theme, buffer, cell, row).put(&write(&side.seen), style);
        }
    }
}
