//! The discs of a lattice where they are: gaps and shifts to scale with the traces, the
//! discs themselves drawn smaller, those that touch filled. What leaves on one side enters
//! on the other.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;
use ratatui::style::Style;

use super::beads::magnification;
use super::raster::Raster;
use super::trace::{PLATE, announce};
use crate::live::{Side, Status};
use crate::math;
use crate::physics::Discs;
use crate::scene::lattice::Sites;
use crate::tui::layout::{ROW, SHARE};
use crate::tui::model::Scale;
use crate::tui::text::line;
use crate::tui::theme::Theme;

/// Rows from which on the last one tells the scale.
const WITH_LEGEND: u16 = 5;
/// Without Unicode smaller discs than this, in dots, are characters.
const CHARACTERS: i32 = 6;
/// The smallest disc of which an outline can be told from a filled one, dots.
const OUTLINED: i32 = 3;

/// The discs of one lattice where they are now.
pub struct LatticePicture<'a> {
    /// What is seen of the lattice.
    pub side: &'a Side,
    /// Where its beads belong.
    pub sites: Sites,
    /// Scale of the traces.
    pub scale: &'a Scale,
    /// Whether to say why its engine stopped, if it did.
    pub tells_failure: bool,
    /// Characters and colours.
    pub theme: Theme,
}

/// How metres become dots.
struct DiscDots {
    /// Diameter of a disc, dots.
    disc: i32,
    /// Distance of two rows that touch, dots.
    row: f64,
    /// Dots of a metre of gap, or of a shift.
    gap: f64,
    /// Dots after which everything repeats, and dots to the left of them.
    period: i32,
    margin: i32,
}

/// A disc on the raster: its left and its upper edge, and whether it touches another.
struct PlacedDisc {
    left: i32,
    top: i32,
    touches: bool,
}

impl LatticePicture<'_> {
    /// Draws into the area; its last row takes the scale.
    pub fn render(&self, area: Rect, buffer: &mut Buffer) {
        let Some(discs) = &self.side.seen.discs else {
            return;
        };
        let legend = u16::from(area.height >= WITH_LEGEND);
        let plane = Rect {
            height: area.height - legend,
            ..area
        };
        let mut raster = Raster::new(plane);
        let drawing = self.drawing(&raster);
        self.draw_floor(&mut raster);
        let (touching, free): (Vec<PlacedDisc>, Vec<PlacedDisc>) = self
            .places(discs, &drawing, &raster)
            .partition(|place| place.touches);
        // A cell has one colour: that of the contacts, if it has any.
        let kinds = [(free, self.theme.side(0)), (touching, self.theme.contact())];
        let characters = self.theme.ascii && drawing.disc < CHARACTERS;
        if !characters {
            for (places, style) in &kinds {
                stamp(places, &drawing, *style, &mut raster);
            }
        }
        raster.render(self.theme, buffer);
        if characters {
            for (places, style) in &kinds {
                spell(places, &drawing, *style, plane, buffer);
            }
        }
        if let (true, Status::Failed(why)) = (self.tells_failure, &self.side.status) {
            announce(self.theme, why, area, buffer);
        }
        if legend > 0 {
            self.explain(&drawing, characters, area, buffer);
        }
    }

    fn drawing(&self, raster: &Raster) -> DiscDots {
        let (rows, columns) = (self.sites.rows as f64, self.sites.columns as f64);
        let (width, height) = (f64::from(raster.width()), room(raster));
        let rows_high = 1.0 + ROW * (rows - 1.0);
        let high = SHARE * height / rows_high;
        let gap_of = |disc: f64| (height - disc * rows_high) / self.scale.top();
        let wide = |gap: f64| width / columns - gap * self.sites.separation;
        let first = high.min(width / columns).floor().max(high.min(1.0));
        // A quarter of a dot of overlap is not seen.
        let pitch = first
            .min((wide(gap_of(first)) + 0.25).floor())
            .max(high.min(1.0));
        let disc = pitch.max(1.0);
        let gap = gap_of(pitch).max(0.0);
        let period = (columns * (disc + gap * self.sites.separation)).min(width);
        let period = whole(period).max(1);
        DiscDots {
            disc: whole(disc),
            row: ROW * pitch,
            gap,
            period,
            margin: (raster.width() - period) / 2,
        }
    }

    /// Where the discs are on the raster.
    fn places<'a>(
        &'a self,
        discs: &'a Discs,
        drawing: &'a DiscDots,
        raster: &Raster,
    ) -> impl Iterator<Item = PlacedDisc> + 'a {
        let (columns, height) = (self.sites.columns, room(raster));
        let across = f64::from(drawing.period) / self.sites.period();
        let reduced = &self.side.seen.reduced;
        let beads = discs.x.iter().zip(reduced).zip(&discs.touching).enumerate();
        beads.map(move |(k, ((&x, &z), &touches))| {
            let site = self.sites.x(k);
            let foot = drawing.row * (k / columns) as f64 + drawing.gap * z;
            PlacedDisc {
                left: whole(across * site + drawing.gap * (x - site)),
                top: whole(height - foot) - drawing.disc,
                touches,
            }
        })
    }

    fn draw_floor(&self, raster: &mut Raster) {
        let (surface, right) = (whole(room(raster)), raster.width() - 1);
        raster.line((0, surface), (right, surface), self.theme.plate());
        for x in (0..=right).step_by(2) {
            raster.dot(x, surface + PLATE, self.theme.plate());
        }
    }

    /// The scale of the gaps, and how contacts are told.
    fn explain(&self, drawing: &DiscDots, characters: bool, area: Rect, buffer: &mut Buffer) {
        let touching = match drawing.disc {
            _ if characters => "@ touching",
            OUTLINED.. => "filled: touching",
            _ if self.theme.colour => "red: touching",
            _ => "",
        };
        let gap = magnification(drawing.gap, self.sites.diameter, drawing.disc);
        let gap = format!("gap{}{gap}", self.theme.symbol("×", "x"));
        line(self.theme, buffer, area, area.height - 1)
            .put(touching, self.theme.quiet())
            .right(&gap, self.theme.quiet());
    }
}

/// Rows of dots over the floor.
fn room(raster: &Raster) -> f64 {
    f64::from((raster.height() - PLATE - 1).max(1))
}

/// Draws discs, those that touch filled, the others as outlines.
fn stamp(places: &[PlacedDisc], drawing: &DiscDots, style: Style, raster: &mut Raster) {
    let dots = [false, true].map(|filled| dots(drawing.disc, filled));
    for place in places {
        for (x, y) in &dots[usize::from(place.touches)] {
            let x = (place.left + x).rem_euclid(drawing.period) + drawing.margin;
            raster.dot(x, place.top + y, style);
        }
    }
}

/// Writes discs as characters.
fn spell(places: &[PlacedDisc], drawing: &DiscDots, style: Style, area: Rect, buffer: &mut Buffer) {
    for place in places {
        let middle = place.left + drawing.disc / 2;
        let dot = middle.rem_euclid(drawing.period) + drawing.margin;
        let x = dot / 2;
        let y = (place.top + drawing.disc / 2).div_euclid(4);
        let (Ok(x), Ok(y)) = (u16::try_from(x), u16::try_from(y)) else {
            continue;
        };
        if x < area.width
            && y < area.height
            && let Some(cell) = buffer.cell_mut((area.x + x, area.y + y))
        {
            let glyph = if place.touches { '@' } else { 'o' };
            cell.set_char(glyph).set_style(style);
        }
    }
}

/// The dots of a disc of that diameter, from its upper left corner.
fn dots(diameter: i32, filled: bool) -> Vec<(i32, i32)> {
    let within = |x: i32, y: i32| {
        // Twice the distances from the middle; a little less than the diameter, so that
        // discs that touch can be told apart.
        let (dx, dy) = (2 * x + 1 - diameter, 2 * y + 1 - diameter);
        f64::from(dx * dx + dy * dy) <= math::powi(f64::from(diameter) - 0.3, 2)
    };
    let inner = |x: i32, y: i32| {
        [(1, 0), (-1, 0), (0, 1), (0, -1)]
            .into_iter()
            .all(|(dx, dy)| within(x + dx, y + dy))
    };
    let seen =
        |&(x, y): &(i32, i32)| diameter < OUTLINED || (within(x, y) && (filled || !inner(x, y)));
    (0..diameter)
        .flat_map(|y| (0..diameter).map(move |x| (x, y)))
        .filter(seen)
        .collect()
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "as saturates, and NaN becomes 0"
)]
fn whole(x: f64) -> i32 {
    x.round().clamp(-1e6, 1e6) as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn filled_discs_have_dots_that_outlines_have_not() {
        for diameter in OUTLINED..40 {
            let (filled, outline) = (dots(diameter, true), dots(diameter, false));
            assert!(outline.len() < filled.len(), "{diameter}");
            assert!(outline.iter().all(|dot| filled.contains(dot)));
            // They reach to all four sides, so that neighbours meet.
            for side in [0, diameter - 1] {
                assert!(outline.iter().any(|dot| dot.0 == side));
                assert!(outline.iter().any(|dot| dot.1 == side));
            }
        }
        assert_eq!(dots(1, false), [(0, 0)]);
    }
}
