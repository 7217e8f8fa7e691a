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
