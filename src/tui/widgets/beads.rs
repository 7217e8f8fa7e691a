//! The column now: the beads where they are, gaps to scale with the traces,
//! the beads themselves drawn smaller, contacts marked beside them.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::raster::Raster;
use super::trace::PLATE;
use crate::live::Side;
use crate::math;
use crate::tui::model::Scale;
use crate::tui::text::line;
use crate::tui::theme::Theme;

/// The part of the height that the beads take; the gaps have the rest.
const BEADS: f64 = 0.7;

/// The beads of one column where they are now.
pub struct Beads<'a> {
    /// What is seen of the column.
    pub side: &'a Side,
    /// Which column, for its colour.
    pub index: usize,
    /// Scale of the traces.
    pub scale: &'a Scale,
    /// Mean diameter d, m.
    pub diameter: f64,
    /// Characters and colours.
    pub theme: Theme,
    /// Where overlaps are looked into, the deepest so far, m.
    pub deep: Option<f64>,
}

/// Dots that the deepest overlap takes where it is looked into, and a gap at most.
const DEEP: f64 = 2.0;

/// How heights become dots: a bead takes `bead` dots, a metre of gap `gap` dots.
struct BeadDots {
    bead: i32,
    gap: f64,
    bottom: f64,
}

impl Beads<'_> {
    /// Draws into the area; its last column is for the marks of contacts. `below`
    /// takes the scale of the gaps.
    pub fn render(&self, area: Rect, below: Rect, buffer: &mut Buffer) {
        let seen = &self.side.seen;
        if area.width < 3 || seen.reduced.is_empty() {
            return;
        }
        let beads = Rect {
            width: area.width - 1,
            ..area
        };
        let mut raster = Raster::new(beads);
        let mut drawing = self.drawing(&raster, seen.reduced.len());
        let close = self
            .deep
            .map(|deepest| close_up(&mut drawing, &seen.gaps, deepest));
        let floor = close.as_ref().map_or(seen.floor, |_| drawing.bottom);
        self.draw_plate(&mut raster, &drawing, floor);
        for (k, &z) in seen.reduced.iter().enumerate() {
            let feet = close.as_ref().and_then(|feet| feet.get(k).copied());
            let foot = feet.unwrap_or_else(|| drawing.foot(k, z));
            ellipse(&mut raster, foot, drawing.bead, self.theme.side(self.index));
            if seen.contacts.get(k) == Some(&true) {
                self.mark(area, raster.height() - 1 - foot, buffer);
            }
        }
        raster.render(self.theme, buffer);
        let text = format!(
            "gap{}{}",
            self.theme.symbol("×", "x"),
            magnification(drawing.gap, self.diameter, drawing.bead)
        );
        line(self.theme, buffer, below, 0).right(&text, self.theme.quiet());
    }

    fn drawing(&self, raster: &Raster, count: usize) -> BeadDots {
        let height = raster.height();
        let count = i32::try_from(count).unwrap_or(i32::MAX).max(1);
        #[expect(clippy::cast_possible_truncation, reason = "less than the height")]
        let share = (f64::from(height) * BEADS) as i32;
        // Beads too many to be drawn are drawn as points, as the traces draw them.
        let bead = (share / count).min(14).min(raster.width());
        let rest = f64::from(height - bead * count - 2).max(4.0);
        BeadDots {
            bead,
            gap: rest / (self.scale.top() - self.scale.bottom()),
            bottom: self.scale.bottom(),
        }
    }

    fn draw_plate(&self, raster: &mut Raster, drawing: &BeadDots, floor: f64) {
        let surface = raster.height() - 1 - drawing.dots(floor);
        let right = raster.width() - 1;
        raster.line((0, surface), (right, surface), self.theme.plate());
        for x in (0..=right).step_by(2) {
            raster.dot(x, surface + PLATE, self.theme.plate());
        }
    }

    /// Marks the contact at the foot of a bead.
    fn mark(&self, area: Rect, row: i32, buffer: &mut Buffer) {
        let cell = u16::try_from((row / 4).max(0)).unwrap_or(0);
        if cell < area.height {
            let at = (area.right() - 1, area.y + cell);
            if let Some(cell) = buffer.cell_mut(at) {
                cell.set_symbol(self.theme.symbol("•", "*"))
                    .set_style(self.theme.contact());
            }
        }
    }
}

/// Where the beads stand, in dots, where gaps are drawn so large that the deepest overlap is
/// seen; wide gaps take no more room than that.
fn close_up(drawing: &mut BeadDots, gaps: &[f64], deepest: f64) -> Vec<i32> {
    if deepest > 0.0 {
        drawing.gap = DEEP / deepest;
    }
    let (mut foot, mut feet) = (PLATE + 1, Vec::with_capacity(gaps.len()));
    for g in gaps {
        #[expect(clippy::cast_possible_truncation, reason = "a few dots")]
        let dots = (g * drawing.gap).round().clamp(-DEEP, DEEP) as i32;
        foot = foot.saturating_add(dots);
        feet.push(foot);
        foot = foot.saturating_add(drawing.bead);
    }
    feet
}

impl BeadDots {
    /// Dots from the lower edge to a height, m.
    fn dots(&self, height: f64) -> i32 {
        let dots = ((height - self.bottom) * self.gap).round();
        #[expect(
            clippy::cast_possible_truncation,
            reason = "as saturates, and NaN becomes 0"
        )]
        let dots = dots.clamp(-1e6, 1e6) as i32;
        dots
    }

    /// The lowest dot of bead `k` at reduced height `z`, counted from the lower edge.
    fn foot(&self, k: usize, z: f64) -> i32 {
        let beads_below = i32::try_from(k)
            .unwrap_or(i32::MAX)
            .saturating_mul(self.bead);
        self.dots(z).saturating_add(beads_below).saturating_add(1)
    }
}

/// How much larger gaps are drawn than beads, in two digits: a metre of gap takes `gap`
/// dots, a bead of that diameter `bead` dots.
pub(super) fn magnification(gap: f64, diameter: f64, bead: i32) -> String {
    if bead == 0 {
        return "1".into();
    }
    let factor = gap * diameter / f64::from(bead);
    match factor {
        f if f >= 9.5e3 => format!("{f:.0e}"),
        f if f >= 9.5 => format!("{f:.0}"),
        f if f >= 0.095 => format!("{f:.1}"),
        f => format!("{f:.0e}"),
    }
}

/// A bead of so many dots high, its lowest dot `foot` above the lower edge. Its
/// ends are narrow, so that beads that touch can be told apart.
fn ellipse(raster: &mut Raster, foot: i32, height: i32, style: Style) {
    let middle = raster.width() / 2;
    // Dots are about as wide as high. Small beads are drawn wider, to be seen.
    let round = f64::from(height) * 0.5;
    let half = f64::from(middle).min(round + (3.0 - round * 0.5).max(0.0));
    for k in 0..height.max(1) {
        let row = raster.height() - 1 - foot.saturating_add(k);
        #[expect(clippy::cast_possible_truncation, reason = "less than the width")]
        let reach = (half * girth(k, height)).round().max(1.0) as i32;
        for x in (middle - reach)..(middle + reach) {
            raster.dot(x, row, style);
        }
    }
}

/// Half the width of row `k` of a bead of so many rows; 1 at its middle.
fn girth(k: i32, height: i32) -> f64 {
    match (height, k) {
        (..=1, _) | (2, 0) | (3, 1) => 1.0,
        (2 | 3, _) => 0.4,
        _ => {
            let y = (2.0 * f64::from(k) + 1.0) / f64::from(height) - 1.0;
            math::powf((1.0 - 0.97 * y * y).max(0.0), 0.8)
        }
    }
}
