//! The trace: reduced heights over time, one line a bead, the plate below.
//!
//! It fills from left to right and starts over, as a monitor does: a scrolling
//! trace would write every cell anew for every dot.

use std::borrow::Cow;

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::raster::Raster;
use crate::live::ColumnSample;
use crate::tui::model::{Page, Scale};
use crate::tui::text::{line, wrapped};
use crate::tui::theme::Theme;

/// Columns kept clear ahead of the pen, cells.
const CLEAR: f64 = 2.0;
/// A ghost has dots in every so many columns of dots: one in a cell, or, where characters
/// stand for all dots of a cell, one in every other cell.
const DOTTED: i32 = 2;
const SPARSE: i32 = 4;
/// Thickness of the plate, dots: its lower edge is dotted.
pub(super) const PLATE: i32 = 2;

/// The trace of one column of beads.
pub struct Trace<'a> {
    /// The page to draw.
    pub page: &'a Page,
    /// Which column of beads.
    pub side: usize,
    /// Why its engine stopped, if it did.
    pub failure: Option<&'a str>,
    /// Characters and colours.
    pub theme: Theme,
}

impl Trace<'_> {
    /// Draws into the area.
    pub fn render(&self, area: Rect, buffer: &mut Buffer) {
        self.render_ghost(area, buffer);
        let mut raster = Raster::new(area);
        let beads = self.theme.side(self.side);
        let scale = self.page.trace_scale();
        let mut last: Option<(i32, Cow<ColumnSample>)> = None;
        for (place, sample) in self.page.visible(clear(area)) {
            let row = sample.rows.get(self.side).and_then(Option::as_ref);
            let Some(row) = row.and_then(|row| self.page.drawn(self.side, sample.time, row)) else {
                last = None;
                continue;
            };
            let x = raster.column(place);
            let from = last.as_ref().filter(|(before, _)| *before <= x);
            let from = from.map_or((x, &*row), |(before, row)| (*before, row));
            ground(&mut raster, from, (x, &row), scale, self.theme.plate());
            for (k, &z) in row.reduced.iter().enumerate() {
                let before = from.1.reduced.get(k).copied().unwrap_or(z);
                stroke(&mut raster, scale, (from.0, before), (x, z), beads);
            }
            last = Some((x, row));
        }
        raster.render(self.theme, buffer);
        if let Some(why) = self.failure {
            announce(self.theme, why, area, buffer);
        }
    }
}

impl Trace<'_> {
    /// The ghost: fainter lines of fewer dots, over which the others are drawn.
    fn render_ghost(&self, area: Rect, buffer: &mut Buffer) {
        let (scale, style) = (self.page.trace_scale(), self.theme.quiet());
        let every = if self.theme.ascii { SPARSE } else { DOTTED };
        let mut raster = Raster::new(area);
        let mut last: Option<(i32, Cow<ColumnSample>)> = None;
        for (place, row) in self.page.ghost_rows(self.side) {
            let Some(row) = row else {
                last = None;
                continue;
            };
            let x = raster.column(place);
            let from = last.as_ref().filter(|(before, _)| *before <= x);
            let from = from.map_or((x, &*row), |(before, row)| (*before, row));
            let dot = |raster: &Raster, z: f32| raster.row(scale.place(f64::from(z)));
            for (before, z) in lines(from.1).zip(lines(&row)) {
                if let (Some(start), Some(end)) = (dot(&raster, before), dot(&raster, z)) {
                    raster.dotted((from.0, start), (x, end), every, style);
                }
            }
            last = Some((x, row));
        }
        raster.render(self.theme, buffer);
    }
}

/// What has a line: the floor and the beads.
fn lines(row: &ColumnSample) -> impl Iterator<Item = f32> + '_ {
    std::iter::once(row.floor).chain(row.reduced.iter().copied())
}

/// The part of a page that is kept clear ahead of the pen.
pub fn clear(area: Rect) -> f64 {
    CLEAR / f64::from(area.width.max(1))
}

/// A line between two heights, where both are on the scale.
fn stroke(raster: &mut Raster, scale: &Scale, from: (i32, f32), to: (i32, f32), style: Style) {
    let row = |raster: &Raster, z: f32| raster.row(scale.place(f64::from(z)));
    if let (Some(start), Some(end)) = (row(raster, from.1), row(raster, to.1)) {
        raster.line((from.0, start), (to.0, end), style);
    }
}

/// The plate: its surface, and below it a dotted edge, which tells it from a bead.
fn ground(
    raster: &mut Raster,
    from: (i32, &ColumnSample),
    to: (i32, &ColumnSample),
    scale: &Scale,
    style: Style,
) {
    stroke(
        raster,
        scale,
        (from.0, from.1.floor),
        (to.0, to.1.floor),
        style,
    );
    let Some(surface) = raster.row(scale.place(f64::from(to.1.floor))) else {
        return;
    };
    for x in from.0 + i32::from(from.0 < to.0)..=to.0 {
        if x % 2 == 0 {
            raster.dot(x, surface + PLATE, style);
        }
    }
}

/// Says over the picture why it ends.
pub(super) fn announce(theme: Theme, why: &str, area: Rect, buffer: &mut Buffer) {
    let inner = Rect {
        x: area.x + 1,
        width: area.width.saturating_sub(2),
        ..area
    };
    let lines = wrapped(&format!("stopped: {why}"), inner.width);
    for (row, text) in (1..).zip(&lines) {
        line(theme, buffer, inner, row).put(text, theme.alarm());
    }
    let row = u16::try_from(lines.len()).unwrap_or(0) + 1;
    line(theme, buffer, inner, row).put("an edit or r starts it again", theme.quiet());
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::live::{History, Sample, Sampling};
    use ratatui::style::Modifier;

    const AREA: Rect = Rect {
        x: 0,
        y: 0,
        width: 20,
        height: 10,
    };
    const SWEEP: Sampling = Sampling {
        origin: 0.0,
        span: 0.2,
        columns: 40,
        hold: false,
    };

    /// Draws on up to a time, a bead at that height.
    fn draw(page: &mut Page, to: f64, height: f32) {
        let mut history = History::new(100);
        let begun = page.samples.is_empty();
        let mut number = if begun {
            0
        } else {
            SWEEP.next_sample(page.now, 1)
        };
        while SWEEP.sample_time(number) <= to {
            let row = ColumnSample {
                floor: 0.0,
                reduced: vec![height],
                kinetic: 1.0,
                relative: 0.0,
                error: None,
            };
            history.push(Sample {
                time: SWEEP.sample_time(number),
                rows: vec![Some(row)],
            });
            number += 1;
        }
        page.take(to, history, false);
    }

    /// The rows of the screen, and whether each has a dim cell.
    fn rows(page: &Page, theme: Theme) -> Vec<(String, bool)> {
        let mut buffer = Buffer::empty(AREA);
        let trace = Trace {
            page,
            side: 0,
            failure: None,
            theme,
        };
        trace.render(AREA, &mut buffer);
        let rows = buffer.content.chunks(usize::from(AREA.width));
        let dim = |cell: &ratatui::buffer::Cell| cell.modifier.contains(Modifier::DIM);
        rows.map(|row| {
            let text = row.iter().map(ratatui::buffer::Cell::symbol).collect();
            (text, row.iter().any(dim))
        })
        .collect()
    }

    /// The row of cells at a height.
    fn row_of(page: &Page, height: f64) -> usize {
        let row = Raster::new(AREA).row(page.trace_scale().place(height));
        usize::try_from(row.expect("on the raster") / 4).expect("a row")
    }

    /// A bead at 8 mm, kept, and then at 3 mm: the ghost has a dot in every cell of its row, in
    /// ASCII a sign in every other, and its cells stay as they are.
    #[test]
    fn a_ghost_is_dim_and_sparse_where_its_page_was() {
        let mut page = Page::new(SWEEP, &[]);
        draw(&mut page, 0.199, 8e-3);
        assert!(page.keep_ghost(None));
        draw(&mut page, 0.5, 3e-3);
        let (then, now) = (row_of(&page, 8e-3), row_of(&page, 3e-3));
        assert_ne!(then, now);
        for (ascii, colour) in [(false, true), (false, false), (true, false)] {
            let theme = Theme { ascii, colour };
            let drawn = rows(&page, theme);
            let (text, dim) = &drawn[then];
            assert!(*dim, "{drawn:?}");
            let signs: Vec<char> = text.chars().collect();
            for (k, sign) in signs.iter().enumerate() {
                let empty = ascii && k % 2 == 1;
                assert_eq!(*sign == ' ', empty, "{text}");
                assert_eq!(*sign, signs[k % 2], "{text}");
            }
            // Over the live line nothing of the ghost is seen, nor below it.
            assert!(!drawn[now].1, "{drawn:?}");
            assert!(drawn[now].0.chars().filter(|sign| *sign != ' ').count() >= 18);
            let later = page.now + 0.05;
            draw(&mut page, later, 3e-3);
            assert_eq!(rows(&page, theme)[then], drawn[then]);
        }
        page.ghost = None;
        let drawn = rows(
            &page,
            Theme {
                ascii: false,
                colour: true,
            },
        );
        assert_eq!(drawn[then].0.trim(), "");
    }
}
