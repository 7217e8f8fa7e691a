//! More numbers, for screens that have room for them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::study::quantity::{self, Seen};
use crate::study::table::Cell;
use crate::tui::model::Model;
use crate::tui::numbers::{scientific, short, with_unit};
use crate::tui::text::line;

/// Columns that a number takes, and a space.
const NARROWEST: u16 = 9;

/// What only a moment has, beside the quantities that a run gives too.
const MOMENTARY: [Seen; 5] = [
    Seen {
        symbol: "lost",
        rank: 2,
        of: |_| true,
        now: |seen| Cell::Number(seen.energy.lost),
    },
    Seen {
        symbol: "plate",
        rank: 3,
        of: |scene| scene.shake().is_some(),
        now: |seen| Cell::Number(seen.energy.plate_work),
    },
    Seen {
        symbol: "E_pot",
        rank: 4,
        of: |scene| scene.gravity.is_some(),
        now: |seen| Cell::Number(seen.energy.potential),
    },
    Seen {
        symbol: "E_el",
        rank: 5,
        of: |scene| scene.is_md(),
        now: |seen| Cell::Number(seen.energy.elastic),
    },
    Seen {
        symbol: "count",
        rank: 7,
        of: |_| true,
        now: |seen| Cell::Count(seen.steps + seen.events),
    },
];

/// A quantity, its unit, and whether it is an error.
type Detail = (Seen, &'static str, bool);

/// In the order in which they are given up where there is no room, the last one first.
fn details() -> Vec<Detail> {
    let of_runs = quantity::table()
        .iter()
        .filter_map(|quantity| Some((quantity.seen?, quantity.unit, quantity.is_rough())));
    let mut all: Vec<Detail> = of_runs
        .chain(MOMENTARY.map(|seen| (seen, "", false)))
        .collect();
    all.sort_by_key(|(seen, ..)| seen.rank);
    all
}

fn written(cell: Cell, unit: &str, is_rough: bool) -> String {
    match cell {
        Cell::Empty => "-".to_owned(),
        Cell::Word(word) => word,
        Cell::Count(count) => count.to_string(),
        Cell::Number(x) if !unit.is_empty() => with_unit(x, unit),
        Cell::Number(x) if is_rough => scientific(x),
        Cell::Number(x) => short(x),
    }
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
    let mut shown = details();
    shown.retain(|(seen, ..)| scenes.iter().any(seen.of));
    for (row, (seen, unit, is_rough)) in (1..area.height).zip(shown) {
        line(theme, buffer, area, row).put(seen.symbol, theme.quiet());
        for (index, side) in (0..count).zip(sides) {
            let cell = Rect {
                x: area.x + 6 + index * width,
                width: width - 1,
                ..area
            };
            let style = theme.side(usize::from(index));
            line(theme, buffer, cell, row)
                .number(&written((seen.now)(&side.seen), unit, is_rough), style);
        }
    }
}
