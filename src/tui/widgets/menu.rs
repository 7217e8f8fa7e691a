//! The list of presets, with what is said of the selected one.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;
use ratatui::widgets::{Clear, Widget};

use super::rules;
use crate::scene::Preset;
use crate::tui::caption::{CaptionPart, text_width, texts, turns};
use crate::tui::model::{Menu, Model};
use crate::tui::text::{fitted, line};
use crate::tui::theme::Theme;

/// Rows for the texts of the selected preset.
const TEXTS: u16 = 10;
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
    let mut row = 0;
    for CaptionPart { label, lines } in turns(theme, &texts(preset), text_width(area), u16::MAX) {
        render_turn(theme, &label, &lines, area, row, buffer);
        row += u16::try_from(lines.len()).unwrap_or(u16::MAX);
    }
}

/// Draws lines from a row of the area on, the label that they begin with in bold.
pub fn render_turn(
    theme: Theme,
    label: &str,
    lines: &[String],
    area: Rect,
    first: u16,
    buffer: &mut Buffer,
) {
    for (row, text) in (first..).zip(lines) {
        let label = if row == first { label } else { "" };
        let (head, tail) = text.split_at(label.len().min(text.len()));
        line(theme, buffer, area, row)
            .skip(1)
            .put(head, theme.strong())
            .put(tail, Style::new());
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::preset::embedded;

    /// What to try next shows, on the list and on screens that have the texts.
    #[test]
    fn all_texts_have_room_at_80_by_24() {
        let theme = Theme {
            ascii: false,
            colour: false,
        };
        let width = text_width(Rect::new(0, 0, 80, 23));
        for (name, _) in embedded() {
            let preset = Preset::load(name).expect("an embedded preset");
            let turns = turns(theme, &texts(&preset), width, u16::MAX);
            let lines: usize = turns.iter().map(|turn| turn.lines.len()).sum();
            assert!(lines < usize::from(TEXTS), "{name}: {lines}");
            let labels = turns.iter().map(|turn| turn.label.as_str());
            assert_eq!(labels.collect::<Vec<_>>(), ["", "look for: ", "try next: "]);
        }
    }
}
