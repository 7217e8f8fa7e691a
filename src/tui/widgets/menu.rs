//! The list of presets, with what is said of the selected one.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};

use super::rules;
use super::text::{fitted, line, wrapped};
use crate::scene::Preset;
use crate::tui::model::{Menu, Model};

/// Rows for the texts of the selected preset.
const TEXTS: u16 = 8;
/// Columns of the names.
const NAMES: u16 = 15;

/// Draws the list over the whole area.
pub fn render(model: &Model, menu: &Menu, area: Rect, buffer: &mut Buffer) {
    Clear.render(area, buffer);
    let theme = model.theme;
    let texts = if area.height >= 2 * TEXTS { TEXTS } else { 0 };
    let list = Rect {
        y: area.y.saturating_add(1),
        height: area.height.saturating_sub(1 + texts),
        ..area
    };
    rules::horizontal(
        theme,
        Rect {
            height: 1.min(area.height),
            ..area
        },
        buffer,
    );
    rules::title(theme, "presets: Enter loads, Esc goes back", area, buffer);
    let height = usize::from(list.height);
    let first = (menu.selected + 1).saturating_sub(height);
    for (row, (index, preset)) in (0..list.height).zip(menu.presets.iter().enumerate().skip(first))
    {
        let style = if index == menu.selected {
            theme.selected()
        } else {
            Style::new()
        };
        let title = fitted(&preset.title, list.width.saturating_sub(NAMES + 3));
        line(theme, buffer, list, row)
            .put(
                &format!(" {:<1$} ", preset.name, usize::from(NAMES)),
                style.patch(theme.strong()),
            )
            .put(&title, style);
    }
    if let Some(preset) = menu.presets.get(menu.selected).filter(|_| texts > 0) {
        let below = Rect {
            y: list.bottom(),
            height: texts,
            ..area
        };
        rules::horizontal(theme, Rect { height: 1, ..below }, buffer);
        let inner = Rect {
            y: below.y + 1,
            height: texts - 1,
            ..below
        };
        render_texts(model, preset, inner, buffer);
    }
}

/// Draws caption, what to look for and what to try next, as far as there is room.
pub fn render_texts(model: &Model, preset: &Preset, area: Rect, buffer: &mut Buffer) {
    let theme = model.theme;
    let parts = [
        ("", &preset.caption),
        ("look for: ", &preset.look_for),
        ("try next: ", &preset.try_next),
    ];
    let mut row = 0;
    for (word, text) in parts {
        let text = format!("{word}{text}");
        let lines = wrapped(&theme.text(&text), area.width.saturating_sub(2));
        for (k, text) in lines.iter().enumerate() {
            let (head, tail) = text.split_at(if k == 0 {
                word.len().min(text.len())
            } else {
                0
            });
            line(theme, buffer, area, row)
                .skip(1)
                .put(head, theme.strong())
                .put(tail, Style::new());
            row += 1;
        }
    }
}
