//! A raster of dots, two by four in a cell: braille, or what ASCII can do.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use crate::tui::theme::Theme;

/// A raster of dots over an area of cells. Row 0 is at the top.
#[derive(Debug)]
pub struct Raster {
    area: Rect,
    cells: Vec<(u8, Style)>,
}

/// Bits of a braille cell, by row and column.
const BITS: [[u8; 2]; 4] = [[0x01, 0x08], [0x02, 0x10], [0x04, 0x20], [0x40, 0x80]];

impl Raster {
    /// An empty raster.
    pub fn new(area: Rect) -> Raster {
        Raster {
            area,
            cells: vec![(0, Style::new()); usize::from(area.width) * usize::from(area.height)],
        }
    }

    /// Width, dots.
    pub fn width(&self) -> i32 {
        2 * i32::from(self.area.width)
    }

    /// Height, dots.
    pub fn height(&self) -> i32 {
        4 * i32::from(self.area.height)
    }

    /// The row of a height from 0 (bottom) to 1 (top); none if it is off the raster
    /// or not finite.
    pub fn row(&self, place: f64) -> Option<i32> {
        let row = ((1.0 - place) * f64::from(self.height() - 1)).round();
        #[expect(clippy::cast_possible_truncation, reason = "between 0 and the height")]
        (row >= 0.0 && row < f64::from(self.height())).then_some(row as i32)
    }

    /// The column of a place from 0 (left) to 1 (right, exclusive).
    pub fn column(&self, place: f64) -> i32 {
        #[expect(
            clippy::cast_possible_truncation,
            reason = "as saturates, and the width is small"
        )]
        let column = (place * f64::from(self.width()) + 0.01).floor() as i32;
        column.clamp(0, self.width() - 1)
    }

    /// Sets a dot. The cell takes the style of its last dot.
    pub fn dot(&mut self, x: i32, y: i32, style: Style) {
        if (0..self.width()).contains(&x) && (0..self.height()).contains(&y) {
            let cell = (y / 4) * i32::from(self.area.width) + x / 2;
            let (row, column) = (
                usize::from(y & 1 > 0) + 2 * usize::from(y & 2 > 0),
                usize::from(x & 1 > 0),
            );
            let bit = BITS[row][column];
            if let Some((mask, kept)) = self
                .cells
                .get_mut(usize::try_from(cell).unwrap_or(usize::MAX))
            {
                *mask |= bit;
                *kept = style;
            }
        }
    }

    /// Draws a line from dot to dot, both ends included.
    pub fn line(&mut self, from: (i32, i32), to: (i32, i32), style: Style) {
        for (x, y) in dots_between(from, to) {
            self.dot(x, y, style);
        }
    }

    /// Draws a line so that it is seen to be a fainter one: in every `every`-th column of
    /// dots, and of the dots there every other.
    pub fn dotted(&mut self, from: (i32, i32), to: (i32, i32), every: i32, style: Style) {
        let mut begun: Option<(i32, i32)> = None;
        for (x, y) in dots_between(from, to).filter(|(x, _)| x % every == 0) {
            let here = begun.filter(|&(column, _)| column == x);
            let foot = here.map_or(y, |(_, foot)| foot);
            begun = Some((x, foot));
            if (y - foot) % 2 == 0 {
                self.dot(x, y, style);
            }
        }
    }

    /// Writes the raster into the buffer; empty cells leave it as it is.
    pub fn render(&self, theme: Theme, buffer: &mut Buffer) {
        for (at, &(mask, style)) in self.area.positions().zip(&self.cells) {
            let glyph = if theme.ascii {
                ascii(mask)
            } else {
                braille(mask)
            };
            if let Some(cell) = buffer.cell_mut(at).filter(|_| mask != 0) {
                cell.set_char(glyph).set_style(style);
            }
        }
    }
}

/// The dots of a line, both ends included.
fn dots_between(from: (i32, i32), to: (i32, i32)) -> impl Iterator<Item = (i32, i32)> {
    let (dx, dy) = (to.0 - from.0, to.1 - from.1);
    let steps = dx.abs().max(dy.abs());
    (0..=steps).map(move |k| {
        let along = |delta: i32| {
            if steps == 0 {
                0
            } else {
                (2 * delta * k + steps * delta.signum()) / (2 * steps)
            }
        };
        (from.0 + along(dx), from.1 + along(dy))
    })
}

fn braille(mask: u8) -> char {
    char::from_u32(0x2800 + u32::from(mask)).unwrap_or(' ')
}

/// The ASCII character that looks most like the dots.
fn ascii(mask: u8) -> char {
    let rows: Vec<usize> = (0..4)
        .filter(|&row| mask & (BITS[row][0] | BITS[row][1]) != 0)
        .collect();
    let mean = |column: usize| {
        let set: Vec<usize> = (0..4)
            .filter(|&row| mask & BITS[row][column] != 0)
            .collect();
        (!set.is_empty()).then(|| set.iter().sum::<usize>() as f64 / set.len() as f64)
    };
    let slope = match (mean(0), mean(1)) {
        (Some(left), Some(right)) => right - left,
        _ => 0.0,
    };
    match (rows.as_slice(), slope) {
        ([], _) => ' ',
        ([0], _) => '\'',
        ([1 | 2], _) => '-',
        ([3], _) => {
            if mask.count_ones() == 2 {
                '_'
            } else {
                '.'
            }
        }
        (_, slope) if slope > 0.9 => '\\',
        (_, slope) if slope < -0.9 => '/',
        ([_, _], _) if rows[1] - rows[0] == 1 => '=',
        ([_, _], _) => ':',
        (all, _) if all.len() == 4 && mask.count_ones() >= 7 => '#',
        _ => '|',
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const AREA: Rect = Rect {
        x: 0,
        y: 0,
        width: 3,
        height: 2,
    };

    fn drawn(raster: &Raster, ascii: bool) -> String {
        let mut buffer = Buffer::empty(AREA);
        raster.render(
            Theme {
                ascii,
                colour: false,
            },
            &mut buffer,
        );
        buffer
            .content
            .iter()
            .map(|cell| cell.symbol().to_owned())
            .collect()
    }

    #[test]
    fn a_diagonal_has_a_dot_in_every_column_and_row() {
        let mut raster = Raster::new(AREA);
        raster.line((0, 0), (5, 7), Style::new());
        assert_eq!(
            drawn(&raster, false)
                .chars()
                .filter(|c| *c > '\u{2800}')
                .count(),
            4
        );
        raster.line((-10, -10), (100, 100), Style::new());
        assert!(drawn(&raster, true).is_ascii());
    }

    #[test]
    fn a_dotted_line_has_every_other_dot() {
        let mut raster = Raster::new(AREA);
        raster.dotted((0, 3), (5, 3), 2, Style::new());
        assert_eq!(drawn(&raster, false), "⡀⡀⡀\u{20}\u{20}\u{20}");
        let mut raster = Raster::new(AREA);
        raster.dotted((1, 0), (1, 7), 1, Style::new());
        assert_eq!(drawn(&raster, false), "⠨  ⠨  ");
    }

    #[test]
    fn places_off_the_raster_have_no_row() {
        let raster = Raster::new(AREA);
        assert_eq!(raster.row(0.0), Some(7));
        assert_eq!(raster.row(1.0), Some(0));
        assert_eq!(raster.row(1.2), None);
        assert_eq!(raster.row(f64::NAN), None);
        assert_eq!(raster.column(f64::NAN), 0);
    }
}
