//! More numbers, for screens that have room for them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::physics::Observation;
use crate::scene::Scene;
use crate::tui::model::Model;
use crate::tui::numbers::{scientific, short, with_unit};
use crate::tui::text::line;

/// A quantity, which scenes have it, and how it is written.
type Detail = (&'static str, fn(&Scene) -> bool, fn(&Observation) -> String);

/// Columns that a number takes, and a space.
const NARROWEST: u16 = 9;

/// In the order in which they are given up where there is no room.
const DETAILS: [Detail; 8] = [
    ("h_cm", all, |seen| with_unit(seen.centre, "m")),
    ("drift", all, |seen| scientific(seen.energy.drift)),
    ("lost", all, |seen| short(seen.energy.lost)),
    ("plate", moves, |seen| short(seen.energy.plate_work)),
    ("E_pot", heavy, |seen| short(seen.energy.potential)),
    (
        "E_el",
        |scene| scene.is_md(),
        |seen| short(seen.energy.elastic),
    ),
    ("t_k", all, |seen| {
        let span = seen
            .floor_touched
            .zip(seen.floor_left)
            .map(|(first, last)| last - first);
        span.map_or_else(|| "-".into(), |span| with_unit(span, "s"))
    }),
    ("count", all, |seen| (seen.steps + seen.events).to_string()),
];

fn all(_: &Scene) -> bool {
    true
}

fn moves(scene: &Scene) -> bool {
    scene.shake().is_some()
}

fn heavy(scene: &Scene) -> bool {
    scene.gravity.is_some()
}

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
    let scenes = model.bench.scenes();
    let shown = DETAILS.iter().filter(|(_, has, _)| scenes.iter().any(has));
    for (row, (name, _, write)) in (1..area.height).zip(shown) {
        line(theme, buffer, area, row).put(name, theme.quiet());
        for (index, side) in (0..count).zip(sides) {
            let cell = Rect {
                x: area.x + 6 + index * width,
                width: width - 1,
                ..area
            };
            let style = theme.side(usize::from(index));
            line(theme, buffer, cell, row).number(&write(&side.seen), style);
        }
    }
}
