//! Means over time of a column under gravity, with errors that know what lies between
//! two looks, and that neighbours are alike.

use super::fit::standard_error;
use crate::math;
use crate::physics::{Integrals, Observation, masses};
use crate::scene::Scene;
use std::ops::Range;

/// Standard deviation of the place of a jump that is somewhere between two looks, over
/// their distance: 1/√12.
const SOMEWHERE: f64 = 0.288_675_134_594_812_9;

/// Part of a block that is one whole, give or take a step of a grid.
const WHOLE: f64 = 0.9;

/// A mean and its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mean {
    /// The mean.
    pub value: f64,
    /// Its standard error, with what is not known of the motion between looks; none of
    /// too few blocks.
    pub error: Option<f64>,
}

/// Integrals over time, and what they may be off by.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Block {
    time: f64,
    height: f64,
    kinetic: f64,
    relative: f64,
    /// Bound on the error of the height's, m s.
    height_off: f64,
    /// Square of the standard error of E_r's, m⁴/s².
    relative_off: f64,
}

/// The integrals between looks at a column, block by block of equally many.
#[derive(Debug, Clone)]
pub(super) struct Means {
    /// Intervals between looks in a block.
    looks: usize,
    /// Of a single bead, which has no E_r.
    alone: bool,
    /// Mass of the column, in mean bead masses.
    mass: f64,
    gravity: f64,
    last: Option<Look>,
    open: Block,
    in_open: usize,
    blocks: Vec<Block>,
}

/// What is seen at a look.
#[derive(Debug, Clone, Copy)]
struct Look {
    time: f64,
    centre: f64,
    velocity: f64,
    relative: f64,
    on_floor: bool,
    floor_left: Option<f64>,
    integrals: Option<Integrals>,
}

impl Means {
    /// Of a scene, in blocks of so many looks.
    pub fn new(scene: &Scene, looks: usize) -> Self {
        Self {
            looks,
            alone: scene.n == 1,
            mass: masses(scene).iter().sum(),
            gravity: scene.gravity.unwrap_or(0.0),
            last: None,
            open: Block::default(),
            in_open: 0,
            blocks: Vec::new(),
        }
    }

    /// One look; the first is where the first block begins.
    pub fn look(&mut self, seen: &Observation) {
        let look = Look {
            time: seen.time,
            centre: seen.centre,
            velocity: seen.centre_velocity,
            relative: seen.energy.relative,
            on_floor: seen.contacts.first().copied().unwrap_or(false),
            floor_left: seen.floor_left,
            integrals: seen.integrals,
        };
        let Some(last) = self.last.replace(look) else {
            return;
        };
        let between = self.between(last, look);
        let open = &mut self.open;
        open.time += between.time;
        open.height += between.height;
        open.kinetic += between.kinetic;
        open.relative += between.relative;
        open.height_off += between.height_off;
        open.relative_off += between.relative_off;
        self.in_open += 1;
        if self.in_open == self.looks {
            self.blocks.push(std::mem::take(&mut self.open));
            self.in_open = 0;
        }
    }

    /// The integrals between two looks: the engine's own, or by what both ends tell.
    fn between(&self, a: Look, b: Look) -> Block {
        let h = b.time - a.time;
        if h <= 0.0 {
            // A grid so coarse that both looks are at one of its points.
            return Block::default();
        }
        let own = |look: Look| Some((look.integrals?, look.integrals?.energies));
        let (mut height, mut squares, mut height_off, jump) =
            if a.on_floor == b.on_floor && a.floor_left == b.floor_left {
                smooth(a, b)
            } else {
                self.pushed(a, b)
            };
        // E_r has changed somewhere in between: at the floor's push, if there was one.
        let mut relative = a.relative * jump + b.relative * (h - jump);
        let mut relative_off = math::powi(SOMEWHERE * h * (b.relative - a.relative), 2);
        if let Some(((from, before), (to, after))) = own(a).zip(own(b)) {
            (height, height_off) = (to.height - from.height, 0.0);
            if let Some((before, after)) = before.zip(after) {
                squares = after.squares - before.squares;
                (relative, relative_off) = (after.relative - before.relative, 0.0);
            }
        }
        Block {
            time: h,
            height,
            kinetic: 0.5 * self.mass * squares + relative,
            relative,
            height_off,
            relative_off,
        }
    }

    /// ∫ z dt and ∫ v² dt of the centre of mass between two looks with a push of the
    /// floor between them, what the first may be off by, and how long after `a` it was.
    ///
    /// Beads push each other without moving the centre, so both ends give the push's mass
    /// m0 = ∫ f dt and moment m1 = ∫ (b − t) f dt. The integral needs ½ ∫ (b − t)² f dt,
    /// and f ≥ 0 (but for the short attractive end of a contact) sets its bounds:
    /// m1²/m0 for a push at one instant, h m1 for one in parts at both ends.
    fn pushed(&self, a: Look, b: Look) -> (f64, f64, f64, f64) {
        let (h, g) = (b.time - a.time, self.gravity);
        let free = h * (a.centre + h * (0.5 * a.velocity - g * h / 6.0));
        let m0 = b.velocity - a.velocity + g * h;
        let m1 = b.centre - a.centre - h * (a.velocity - 0.5 * g * h);
        let after = if m0 > 0.0 {
            (m1 / m0).clamp(0.0, h)
        } else {
            0.5 * h
        };
        let (least, most) = (0.5 * after * m1, 0.5 * h * m1.max(0.0));
        let off = (most - least).max(0.0);
        // Open at both ends it is a landing, and short.
        let push = if a.on_floor || b.on_floor {
            0.5 * (least + most)
        } else {
            least
        };
        let before = h - after;
        let squares = |v: f64, t: f64| t * (v * (v - g * t) + g * t * g * t / 3.0);
        let left = b.velocity + g * after;
        let all = squares(a.velocity, before) + squares(left, after);
        (free + push, all, off, before)
    }

    /// The last look was the last: what is left of a block counts as one, but for scatter.
    pub fn finish(&mut self) {
        if self.in_open > 0 {
            self.blocks.push(std::mem::take(&mut self.open));
            self.in_open = 0;
        }
    }

    /// Complete blocks.
    pub fn blocks(&self) -> usize {
        self.blocks.len()
    }

    /// All of them.
    pub fn all(&self) -> Range<usize> {
        0..self.blocks.len()
    }

    /// Mean of the centre's height over the resting column's, m, in some of the blocks.
    pub fn height(&self, of: Range<usize>) -> Option<Mean> {
        let blocks = self.blocks.get(of)?;
        let mean = mean(blocks, |b| b.height)?;
        let time: f64 = blocks.iter().map(|b| b.time).sum();
        let off = blocks.iter().map(|b| b.height_off).sum::<f64>() / time;
        Some(mean.with(off))
    }

    /// Mean E_r over mean E in some of the blocks: a ratio of means, since E passes
    /// through 0.
    pub fn share(&self, of: Range<usize>) -> Option<Mean> {
        let blocks = self.blocks.get(of)?;
        let relative = mean(blocks, |b| b.relative)?.value;
        let kinetic = mean(blocks, |b| b.kinetic)?.value;
        if kinetic <= 0.0 {
            return None;
        }
        let value = relative / kinetic;
        if self.alone || value < f64::EPSILON {
            // A single bead, or a cluster whose differences are rounding.
            return Some(Mean {
                value: 0.0,
                error: Some(0.0),
            });
        }
        // What each block adds to the ratio's deviation.
        let part = |b: &Block| (b.relative - value * b.kinetic) / kinetic;
        let deviations = mean(blocks, part)?;
        let time: f64 = blocks.iter().map(|b| b.time).sum();
        // Both have the same jumps: of the ratio the part that is not theirs together.
        let off: f64 = blocks.iter().map(|b| b.relative_off).sum();
        let off = off.sqrt() * (1.0 - value).abs() / (kinetic * time);
        let error = Mean {
            value,
            ..deviations
        };
        Some(error.with(off))
    }
}

/// ∫ z dt and ∫ v² dt of the centre of mass between two looks with nothing sudden
/// between them: of the cubic through both ends, exact in flight; what the first may be
/// off by; and the middle.
fn smooth(a: Look, b: Look) -> (f64, f64, f64, f64) {
    let h = b.time - a.time;
    let (v, u) = (a.velocity, b.velocity);
    let height = 0.5 * h * (a.centre + b.centre) + h * h * (v - u) / 12.0;
    let bend = 6.0 * ((b.centre - a.centre) / h - 0.5 * (v + u));
    let squares = h * ((v * v + v * u + u * u) / 3.0 + bend * (v + u) / 6.0 + bend * bend / 30.0);
    // A third derivative makes the bend, a fourth the error; of the same size they are
    // where a push goes on.
    let off = if a.on_floor {
        h * h * bend.abs() / 60.0
    } else {
        0.0
    };
    (height, squares, off, 0.5 * h)
}

/// Mean over time of what blocks have the integrals of, and the scatter's error.
fn mean(blocks: &[Block], sum: impl Fn(&Block) -> f64) -> Option<Mean> {
    let time: f64 = blocks.iter().map(|b| b.time).sum();
    let whole = blocks.first().map_or(0.0, |b| WHOLE * b.time);
    let values = blocks.iter().filter(|b| b.time > whole);
    let values: Vec<f64> = values.map(|b| sum(b) / b.time).collect();
    (time > 0.0).then(|| Mean {
        value: blocks.iter().map(&sum).sum::<f64>() / time,
        error: standard_error(&values),
    })
}

impl Mean {
    /// The same, and off by so much more at most, and by a rounding.
    fn with(self, off: f64) -> Self {
        let rounding = f64::EPSILON * self.value.abs();
        Self {
            error: self
                .error
                .map(|error| math::hypot(math::hypot(error, off), rounding)),
            ..self
        }
    }

    /// Distance from another in units of both errors together.
    pub fn in_errors_from(self, other: Self) -> Option<f64> {
        let both = math::hypot(self.error?, other.error?);
        (both > 0.0).then(|| (self.value - other.value).abs() / both)
    }
}
