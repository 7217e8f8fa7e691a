//! A bead in flight over the floor, and a bead or stack that rides it.
//!
//! All times are in seconds from the engine's epoch.

mod shaken;

pub(crate) use shaken::Shaken;

use super::plate::Plate;
use crate::math;

/// The floor and gravity of a column whose flights are in closed form.
pub(crate) trait Ground: Send {
    /// Whether there is gravity, so that beads fall, bounce out and rest.
    const PULLS: bool;
    /// Whether the floor moves.
    const MOVES: bool = false;
    /// Gap and rate at time `t` of a free bead that had gap `g` and rate `w` at `t0`.
    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64);
    /// When that bead next hits; infinite if never.
    fn hit(&self, t0: f64, g: f64, w: f64) -> f64;
    /// g + z̈₀ at `t`: what presses a resting bead onto the floor, m/s².
    fn pressing(&self, t: f64) -> f64;
    /// When, from `t` on, the floor first falls away faster than g; infinite if never.
    fn take_off(&self, t: f64) -> f64;
    /// The floor at `t`.
    fn plate(&self, t: f64) -> Plate;
    /// After which time the epoch should move on, s, a power of two; infinite if never.
    fn tick(&self) -> f64;
    /// Moves the epoch on by so much, s, at most about a tick.
    fn move_epoch(&mut self, _by: f64) {}
    /// Makes `plate` the floor at the epoch.
    fn set_plate(&mut self, _: Plate) {}
    /// Taylor coefficients, in units of `h`, of the acceleration −(g + z̈₀) of a free
    /// lowest gap at `t`, m/s².
    fn pull(&self, t: f64, h: f64, into: &mut [f64]);
    /// Those of the floor's velocity, m/s.
    fn motion(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
    }
}

/// A gap as it was at a time of its own, s from the epoch.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    pub g: f64,
    pub w: f64,
    pub t: f64,
}

impl Gap {
    /// Itself and its rate at `t`, in flight. Gravity and the plate bend only the
    /// `lowest`, that over the floor.
    #[inline]
    pub fn flown<G: Ground>(&self, ground: &G, lowest: bool, t: f64) -> (f64, f64) {
        if G::PULLS && lowest {
            ground.fall(self.t, self.g, self.w, t)
        } else {
            (self.g + self.w * (t - self.t), self.w)
        }
    }

    /// When it closes.
    #[inline]
    pub fn closes<G: Ground>(&self, ground: &G, lowest: bool) -> f64 {
        if G::PULLS && lowest {
            ground.hit(self.t, self.g, self.w)
        } else {
            closing(self.t, self.g, self.w)
        }
    }
}

/// A fixed floor without gravity.
pub(crate) struct Free {
    pub plate: Plate,
}

impl Ground for Free {
    const PULLS: bool = false;

    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64) {
        (g + w * (t - t0), w)
    }

    fn hit(&self, t0: f64, g: f64, w: f64) -> f64 {
        closing(t0, g, w)
    }

    fn pressing(&self, _: f64) -> f64 {
        0.0
    }

    fn take_off(&self, _: f64) -> f64 {
        f64::INFINITY
    }

    fn plate(&self, _: f64) -> Plate {
        self.plate
    }

    fn tick(&self) -> f64 {
        f64::INFINITY
    }

    fn pull(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
    }
}

/// When a gap that changes at a constant rate closes.
pub(crate) fn closing(t0: f64, g: f64, w: f64) -> f64 {
    std::hint::select_unpredictable(w >= 0.0, f64::INFINITY, t0 - g.max(0.0) / w)
}

/// A fixed floor under gravity.
pub(crate) struct Weight {
    gravity: f64,
    plate: Plate,
    tick: f64,
}

impl Weight {
    /// Under `gravity`, for beads of mean diameter `diameter`: times are kept small
    /// against that in which one falls by its own size.
    pub fn new(gravity: f64, plate: Plate, diameter: f64) -> Self {
        let tick = power_of_two((diameter / gravity).sqrt());
        Self {
            gravity,
            plate,
            tick,
        }
    }
}

/// The power of two nearest to `x`.
fn power_of_two(x: f64) -> f64 {
    math::exp2(math::log2(x).round())
}

impl Ground for Weight {
    const PULLS: bool = true;

    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64) {
        let tau = t - t0;
        (
            g + (w - 0.5 * self.gravity * tau) * tau,
            w - self.gravity * tau,
        )
    }

    fn hit(&self, t0: f64, g: f64, w: f64) -> f64 {
        t0 + first_root(g.max(0.0), w, self.gravity)
    }

    fn pressing(&self, _: f64) -> f64 {
        self.gravity
    }

    fn take_off(&self, _: f64) -> f64 {
        f64::INFINITY
    }

    fn plate(&self, _: f64) -> Plate {
        self.plate
    }

    fn tick(&self) -> f64 {
        self.tick
    }

    fn pull(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
        into[0] = -self.gravity;
    }
}

/// First τ ≥ 0 (for g = 0 and w > 0: the second root) with g + wτ − aτ²/2 = 0.
fn first_root(g: f64, w: f64, a: f64) -> f64 {
    let root = (w * w + 2.0 * a * g).sqrt();
    if w < 0.0 {
        2.0 * g / (root - w)
    } else {
        (w + root) / a
    }
}
