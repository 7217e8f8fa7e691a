//! Text on the screen, as far as there is room and as the terminal can show it.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

pub(crate) use crate::scene::words::wrapped;
use crate::tui::theme::Theme;

/// A line that is written from left to right into a row of an area.
pub struct Line<'a> {
    theme: Theme,
    buffer: &'a mut Buffer,
    x: u16,
    end: u16,
    y: u16,
}

/// Begins a line in row `row` of the area, counted from its top. A row that the
/// area does not have takes no text.
pub fn line(theme: Theme, buffer: &mut Buffer, area: Rect, row: u16) -> Line<'_> {
    let area = area.intersection(buffer.area);
    let end = if row < area.height {
        area.right()
    } else {
        area.x
    };
    Line {
        theme,
        buffer,
        x: area.x,
        end,
        y: area.y.saturating_add(row),
    }
}

impl Line<'_> {
    /// Writes on, as far as there is room.
    pub fn put(&mut self, text: &str, style: Style) -> &mut Self {
        let text = self.theme.text(text);
        let room = usize::from(self.end.saturating_sub(self.x));
        if room > 0 {
            (self.x, _) = self
                .buffer
                .set_stringn(self.x, self.y, text.as_ref(), room, style);
        }
        self
    }

    /// Writes a number whole, or dots: a part of one would be another number.
    pub fn number(&mut self, text: &str, style: Style) -> &mut Self {
        let text = self.theme.text(text).into_owned();
        let cut = columns(&text) > self.room();
        self.put(if cut { "..." } else { &text }, style)
    }

    /// Goes on at a column of the area that the line began in, counted from here.
    pub fn skip(&mut self, columns: u16) -> &mut Self {
        self.x = self.x.saturating_add(columns).min(self.end);
        self
    }

    /// Writes at the right end, if there is room for all of it.
    pub fn right(&mut self, text: &str, style: Style) {
        let text = self.theme.text(text).into_owned();
        let width = columns(&text);
        if self.x.saturating_add(width) <= self.end {
            let room = usize::from(width);
            self.buffer
                .set_stringn(self.end - width, self.y, text, room, style);
        }
    }

    /// Columns left.
    pub fn room(&self) -> u16 {
        self.end.saturating_sub(self.x)
    }
}

/// Columns that a text takes; every character that is written here takes one.
pub fn columns(text: &str) -> u16 {
    u16::try_from(text.chars().count()).unwrap_or(u16::MAX)
}

/// A text cut to fit, with dots at its end if something is cut.
pub fn fitted(text: &str, room: u16) -> String {
    if columns(text) <= room {
        return text.to_owned();
    }
    let kept: String = text
        .chars()
        .take(usize::from(room.saturating_sub(3)))
        .collect();
    format!("{}...", kept.trim_end())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn texts_are_cut_and_wrapped() {
        assert_eq!(fitted("detachment", 10), "detachment");
        assert_eq!(fitted("detachment", 8), "detac...");
        assert_eq!(wrapped("a bb ccc dddd", 6), ["a bb", "ccc", "dddd"]);
        assert_eq!(wrapped("", 6), [""]);
    }

    #[test]
    fn numbers_are_not_cut() {
        let theme = Theme {
            ascii: false,
            colour: false,
        };
        for (width, shown) in [(8, "1.2e-10 "), (7, "1.2e-10"), (6, "...   "), (2, "..")] {
            let area = Rect::new(0, 0, width, 1);
            let mut buffer = Buffer::empty(area);
            line(theme, &mut buffer, area, 0).number("1.2e-10", Style::new());
            let symbols = buffer.content.iter().map(ratatui::buffer::Cell::symbol);
            assert_eq!(symbols.collect::<String>(), shown);
        }
    }
}
