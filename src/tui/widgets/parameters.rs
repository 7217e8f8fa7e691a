//! The parameters that the scenes have: symbol, name, value, keys.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::scene::parameters::{Parameter, display, display_ascii};
use crate::tui::keys::keys_of;
use crate::tui::model::Model;
use crate::tui::text::{columns, line};

/// Columns of the keys.
const KEYS: u16 = 3;

/// Draws as many rows as there is room for, the selected one among them.
pub fn render(model: &Model, area: Rect, buffer: &mut Buffer) {
    let rows = model.bench.parameters();
    let height = usize::from(area.height);
    let first = first_row(model.selected, rows.len(), height);
    for (offset, (index, parameter)) in (0..).zip(rows.iter().enumerate().skip(first).take(height))
    {
        row(
            model,
            parameter,
            index == model.selected,
            area,
            offset,
            buffer,
        );
    }
    let theme = model.theme;
    let below = rows.len().saturating_sub(first + height);
    if first > 0 {
        mark(model, theme.symbol("▲", "^"), area, 0, buffer);
    }
    if below > 0 {
        mark(
            model,
            theme.symbol("▼", "v"),
            area,
            area.height.saturating_sub(1),
            buffer,
        );
    }
}

/// The first row shown, so that the selected one and its neighbours are.
fn first_row(selected: usize, count: usize, height: usize) -> usize {
    let last = count.saturating_sub(height);
    (selected + 2).saturating_sub(height).min(last)
}

fn row(
    model: &Model,
    parameter: &Parameter,
    selected: bool,
    area: Rect,
    offset: u16,
    buffer: &mut Buffer,
) {
    let theme = model.theme;
    let Some(value) = model.bench.value(parameter) else {
        return;
    };
    let (symbol, value) = if theme.ascii {
        (parameter.symbol_ascii, display_ascii(parameter, value))
    } else {
        (parameter.symbol, display(parameter, value))
    };
    let symbol = if symbol == parameter.name { "" } else { symbol };
    let y = area.y + offset;
    let keys = Rect {
        x: area.right().saturating_sub(KEYS + 1),
        y,
        width: KEYS,
        height: 1,
    };
    let cell = Rect {
        x: area.x,
        y,
        width: area.width.saturating_sub(KEYS + 2),
        height: 1,
    };
    let value_width = columns(&value) + 1;
    let name = Rect {
        width: cell.width.saturating_sub(value_width),
        ..cell
    };
    let words = parameter.name.replace('_', " ");
    let mut label = format!("{symbol:<5} {words}");
    // A long value needs the room of the symbol that is not there.
    if symbol.is_empty() && columns(&label) > name.width {
        label = words;
    }
    line(theme, buffer, name, 0).put(&label, Style::new());
    line(theme, buffer, cell, 0).right(&value, theme.strong());
    if selected {
        buffer.set_style(cell.intersection(buffer.area), theme.selected());
    }
    line(theme, buffer, keys, 0).put(keys_of(parameter.name), theme.quiet());
}

fn mark(model: &Model, symbol: &str, area: Rect, row: u16, buffer: &mut Buffer) {
    line(model.theme, buffer, area, row).right(symbol, model.theme.strong());
}
