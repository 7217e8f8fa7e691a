//! Where in what was the screen is, while it is gone back in.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::tui::model::Model;
use crate::tui::numbers;
use crate::tui::text::{columns, line};

/// The keys that go back and forth, the most needed first.
const KEYS: [(&str, &str); 6] = [
    (", .", "frame"),
    ("{ }", "landing"),
    ("< >", "contact"),
    ("( )", "period"),
    ("Home End", ""),
    ("space", "goes on"),
];

/// The shortest bar that shows anything, cells.
const SHORTEST: u16 = 8;

/// Draws a bar from t = 0 to the time that the columns have come to, with a mark at the
/// present of the screen; below it, where there is a row, the keys.
pub fn render(model: &Model, area: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    let clock = |time| numbers::clock(time, model.page.sweep.span);
    let (start, end) = ("0 ".to_owned(), format!(" {}", clock(model.end)));
    let words = theme.symbol("◂ back at ", "< back at ");
    let here = format!("{words}{}  ", clock(model.page.now));
    let taken = 2 + columns(&here) + columns(&start) + columns(&end);
    let mut row = line(theme, buffer, area, 0);
    row.skip(1).put(&here, theme.strong());
    if taken + SHORTEST <= area.width {
        let width = area.width - taken;
        let part = (model.page.now / model.end).clamp(0.0, 1.0);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a cell of the bar"
        )]
        let mark = (part * f64::from(width - 1)).round() as u16;
        let cells = |symbol: &str, count: u16| symbol.repeat(usize::from(count));
        row.put(&start, theme.quiet())
            .put(&cells(theme.symbol("━", "="), mark), Style::new())
            .put(theme.symbol("●", "O"), theme.strong())
            .put(
                &cells(theme.symbol("─", "-"), width - 1 - mark),
                theme.quiet(),
            );
    }
    row.put(&end, theme.quiet());
    let mut row = line(theme, buffer, area, 1);
    row.skip(1);
    for (keys, what) in KEYS {
        if keys == "( )"
            && model
                .bench
                .scenes()
                .iter()
                .all(|scene| scene.period().is_none())
        {
            continue;
        }
        if columns(keys) + columns(what) + 3 > row.room() {
            break;
        }
        row.put(keys, theme.strong()).put(" ", Style::new());
        row.put(what, theme.quiet()).put("  ", Style::new());
    }
}
