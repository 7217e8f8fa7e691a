//! The backend: as few bytes as a frame can be told in.
//!
//! Between frames it keeps in mind where the cursor stands and which style is
//! set. Colours are the sixteen classic ones by their short codes. A frame that
//! changes something leaves in one write, inside one synchronised update; a
//! frame that changes nothing leaves nothing. It asks the terminal for
//! nothing.

use std::io::{self, Write};

use ratatui::backend::{Backend, ClearType, WindowSize};
use ratatui::buffer::Cell;
use ratatui::layout::{Position, Size};
use ratatui::style::{Color, Modifier};

use super::tty;

const BEGIN_FRAME: &[u8] = b"\x1b[?2026h";
const END_FRAME: &[u8] = b"\x1b[?2026l";
/// Size of a terminal that does not know its own.
const FALLBACK: (u16, u16) = (80, 24);

/// Columns and rows that can be drawn on.
pub fn size() -> (u16, u16) {
    tty::size().unwrap_or(FALLBACK)
}

/// A terminal behind a writer.
#[derive(Debug)]
pub struct Screen<W: Write> {
    writer: W,
    frame: Vec<u8>,
    cursor: Option<Position>,
    style: Option<Pen>,
}

/// What the terminal writes with.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
struct Pen {
    foreground: Color,
    modifier: Modifier,
}

const PLAIN: Pen = Pen {
    foreground: Color::Reset,
    modifier: Modifier::empty(),
};

/// Modifiers that are used here, and their codes.
const MODIFIERS: [(Modifier, &str); 4] = [
    (Modifier::BOLD, "1"),
    (Modifier::DIM, "2"),
    (Modifier::UNDERLINED, "4"),
    (Modifier::REVERSED, "7"),
];

impl<W: Write> Screen<W> {
    /// A terminal whose cursor and style are unknown.
    pub fn new(writer: W) -> Screen<W> {
        Screen {
            writer,
            frame: Vec::new(),
            cursor: None,
            style: None,
        }
    }

    fn move_to(&mut self, x: u16, y: u16) {
        let (row, column) = (y + 1, x + 1);
        let sequence = match self.cursor {
            Some(at) if at == Position { x, y } => return,
            // Past the right edge terminals disagree about where the cursor is, but no
            // cell follows there.
            Some(at) if at.y == y && at.x < x => format!("\x1b[{}C", x - at.x),
            _ if x == 0 && y == 0 => "\x1b[H".to_owned(),
            _ => format!("\x1b[{row};{column}H"),
        };
        self.frame.extend_from_slice(sequence.as_bytes());
        self.cursor = Some(Position { x, y });
    }

    fn set_style(&mut self, pen: Pen) {
        let before = match self.style {
            Some(before) if before == pen => return,
            Some(before) if pen.modifier.contains(before.modifier) => before,
            // Only a reset takes a modifier away.
            _ => {
                self.frame.extend_from_slice(b"\x1b[0");
                self.codes(PLAIN, pen, true);
                return;
            }
        };
        self.frame.extend_from_slice(b"\x1b[");
        self.codes(before, pen, false);
    }

    /// The codes that lead from one pen to another, and the end of the sequence.
    fn codes(&mut self, before: Pen, pen: Pen, mut continued: bool) {
        let mut put = |frame: &mut Vec<u8>, code: &str| {
            if std::mem::replace(&mut continued, true) {
                frame.push(b';');
            }
            frame.extend_from_slice(code.as_bytes());
        };
        for (modifier, code) in MODIFIERS {
            if pen.modifier.contains(modifier) && !before.modifier.contains(modifier) {
                put(&mut self.frame, code);
            }
        }
        if pen.foreground != before.foreground {
            put(&mut self.frame, &foreground(pen.foreground).to_string());
        }
        self.frame.push(b'm');
        self.style = Some(pen);
    }
}

/// The code of one of the sixteen colours; any other is the terminal's own.
fn foreground(colour: Color) -> u8 {
    match colour {
        Color::Black => 30,
        Color::Red => 31,
        Color::Green => 32,
        Color::Yellow => 33,
        Color::Blue => 34,
        Color::Magenta => 35,
        Color::Cyan => 36,
        Color::Gray => 37,
        Color::DarkGray => 90,
        Color::LightRed => 91,
        Color::LightGreen => 92,
        Color::LightYellow => 93,
        Color::LightBlue => 94,
        Color::LightMagenta => 95,
        Color::LightCyan => 96,
        Color::White => 97,
        Color::Reset | Color::Rgb(..) | Color::Indexed(_) => 39,
    }
}

impl<W: Write> Backend for Screen<W> {
    type Error = io::Error;

    fn draw<'a, I>(&mut self, content: I) -> io::Result<()>
    where
        I: Iterator<Item = (u16, u16, &'a Cell)>,
    {
        for (x, y, cell) in content {
            self.move_to(x, y);
            let used = MODIFIERS
                .iter()
                .fold(Modifier::empty(), |all, (modifier, _)| all | *modifier);
            let mut modifier = cell.modifier & used;
            if modifier.contains(Modifier::BOLD) {
                // Terminals disagree about what both together are.
                modifier.remove(Modifier::DIM);
            }
            self.set_style(Pen {
                foreground: cell.fg,
                modifier,
            });
            self.frame.extend_from_slice(cell.symbol().as_bytes());
            self.cursor = Some(Position { x: x + 1, y });
        }
        Ok(())
    }

    fn hide_cursor(&mut self) -> io::Result<()> {
        // Hidden and shown with the alternate screen.
        Ok(())
    }

    fn show_cursor(&mut self) -> io::Result<()> {
        Ok(())
    }

    fn get_cursor_position(&mut self) -> io::Result<Position> {
        Ok(self.cursor.unwrap_or_default())
    }

    fn set_cursor_position<P: Into<Position>>(&mut self, position: P) -> io::Result<()> {
        let Position { x, y } = position.into();
        self.move_to(x, y);
        Ok(())
    }

    fn clear(&mut self) -> io::Result<()> {
        self.clear_region(ClearType::All)
    }

    fn clear_region(&mut self, clear_type: ClearType) -> io::Result<()> {
        let part = match clear_type {
            ClearType::All => "2J",
            ClearType::AfterCursor => "J",
            ClearType::BeforeCursor => "1J",
            ClearType::CurrentLine => "2K",
            ClearType::UntilNewLine => "K",
        };
        if clear_type == ClearType::All {
            // What was to be drawn before is gone with the rest.
            self.frame.clear();
        }
        self.frame
            .extend_from_slice(format!("\x1b[0m\x1b[{part}").as_bytes());
        self.style = Some(PLAIN);
        self.cursor = None;
        Ok(())
    }

    fn size(&self) -> io::Result<Size> {
        let (width, height) = size();
        Ok(Size { width, height })
    }

    fn window_size(&mut self) -> io::Result<WindowSize> {
        Ok(WindowSize {
            columns_rows: self.size()?,
            pixels: Size::default(),
        })
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.frame.is_empty() {
            return Ok(());
        }
        let frame = [BEGIN_FRAME, &self.frame, END_FRAME].concat();
        self.frame.clear();
        self.writer.write_all(&frame)?;
        self.writer.flush()
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use ratatui::style::Style;

    fn cell(symbol: &'static str, style: Style) -> Cell {
        let mut cell = Cell::new(symbol);
        cell.set_style(style);
        cell
    }

    fn written(screen: &Screen<Vec<u8>>) -> String {
        String::from_utf8_lossy(&screen.writer).into_owned()
    }

    #[test]
    fn neighbours_need_no_move_and_no_style() {
        let mut screen = Screen::new(Vec::new());
        let cyan = cell("a", Style::new().fg(Color::Cyan));
        let row = [(3, 1, &cyan), (4, 1, &cyan), (9, 1, &cyan)];
        screen
            .draw(row.into_iter())
            .expect("a vector takes everything");
        screen.flush().expect("a vector takes everything");
        assert_eq!(
            written(&screen),
            "\x1b[?2026h\x1b[2;4H\x1b[0;36maa\x1b[4Ca\x1b[?2026l"
        );
    }

    #[test]
    fn a_modifier_goes_by_a_reset() {
        let mut screen = Screen {
            style: Some(PLAIN),
            ..Screen::new(Vec::new())
        };
        let bold = cell(
            "b",
            Style::new().fg(Color::Red).add_modifier(Modifier::BOLD),
        );
        let plain = cell("p", Style::new().fg(Color::Red));
        screen
            .draw([(0, 0, &bold), (1, 0, &plain)].into_iter())
            .expect("a vector takes everything");
        assert_eq!(
            String::from_utf8_lossy(&screen.frame),
            "\x1b[H\x1b[1;31mb\x1b[0;31mp"
        );
    }

    #[test]
    fn an_unchanged_frame_writes_nothing() {
        let mut screen = Screen::new(Vec::new());
        screen
            .draw(std::iter::empty())
            .expect("a vector takes everything");
        screen.flush().expect("a vector takes everything");
        assert!(screen.writer.is_empty());
    }
}
