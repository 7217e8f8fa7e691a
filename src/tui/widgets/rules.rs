//! Rules between the parts of the screen, with titles.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::tui::text::line;
use crate::tui::theme::Theme;

/// Draws a rule over the whole area.
pub fn horizontal(theme: Theme, area: Rect, buffer: &mut Buffer) {
    let dash = theme.symbol("─", "-");
    for x in area.left()..area.right() {
        set(theme, buffer, x, area.y, dash);
    }
}

/// Draws a rule down column `x`, joined to the rules at its ends.
pub fn vertical(theme: Theme, x: u16, rows: std::ops::Range<u16>, buffer: &mut Buffer) {
    for y in rows.clone() {
        set(theme, buffer, x, y, theme.symbol("│", "|"));
    }
    if let Some(above) = rows.start.checked_sub(1) {
        match symbol(buffer, x, above) {
            "─" | "-" => set(theme, buffer, x, above, theme.symbol("┬", "+")),
            "┴" => set(theme, buffer, x, above, "┼"),
            _ => {}
        }
    }
    if matches!(symbol(buffer, x, rows.end), "─" | "-") {
        set(theme, buffer, x, rows.end, theme.symbol("┴", "+"));
    }
}

/// Joins the rule that begins right of column `x` to the one down that column.
pub fn branch(theme: Theme, x: u16, y: u16, buffer: &mut Buffer) {
    set(theme, buffer, x, y, theme.symbol("├", "+"));
}

fn symbol(buffer: &Buffer, x: u16, y: u16) -> &str {
    buffer.cell((x, y)).map_or("", |cell| cell.symbol())
}

/// Columns that a title takes besides its text.
pub const TITLE: u16 = 3;

/// Writes a title into a rule.
pub fn title(theme: Theme, text: &str, area: Rect, buffer: &mut Buffer) {
    line(theme, buffer, area, 0)
        .skip(1)
        .put(&format!(" {text} "), theme.strong());
}

fn set(theme: Theme, buffer: &mut Buffer, x: u16, y: u16, symbol: &str) {
    if let Some(cell) = buffer.cell_mut((x, y)) {
        cell.set_symbol(symbol).set_style(theme.quiet());
    }
}
