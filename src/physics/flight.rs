//! Flights in closed form: of gaps between beads, and of a bead over the floor.
//!
//! All times are in seconds from the engine's epoch.

mod shaken;

pub(crate) use shaken::Shaken;

use super::plate::Plate;
use crate::math;

/// The floor and gravity of a column whose flights are in closed form.
pub(crate) trait Ground: Clone + Send {
    /// Whether there is gravity.
    const PULLS: bool;
    /// Whether the floor moves.
    const MOVES: bool = false;
    /// Gap, m, and rate, m/s, at time `t` of a free bead over the floor that had gap `g` and
    /// rate `w` at `t0`.
    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64);
    /// When that bead next hits the floor; infinite if never.
    fn hit(&self, t0: f64, g: f64, w: f64) -> f64;
    /// g + z̈₀ at `t`, m/s²: the acceleration that presses a resting bead onto the floor.
    fn pressing(&self, t: f64) -> f64;
    /// When, from `t` on, the floor first falls away faster than g; infinite if never.
    fn take_off(&self, t: f64) -> f64;
    /// The floor at `t`.
    fn plate(&self, t: f64) -> Plate;
    /// Time after which the epoch should move on, s: a power of two, or infinite if never.
    fn tick(&self) -> f64;
    /// Moves the epoch on by so many seconds, at most about a tick.
    fn move_epoch(&mut self, _by: f64) {}
    /// Makes `plate` the floor at the epoch.
    fn set_plate(&mut self, _: Plate) {}
    /// Writes the Taylor coefficients of −(g + z̈₀), m/s², the acceleration of a free lowest
    /// gap, as a series in τ/h from `t` on.
    fn pull(&self, t: f64, h: f64, into: &mut [f64]);
    /// Writes those of the floor's velocity, m/s.
    fn motion(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
    }
}

/// A gap as it was at a time of its own.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Gap {
    /// Its width, m; an overlap is negative.
    pub g: f64,
    /// Its rate, m/s.
    pub w: f64,
    /// That time, s from the epoch.
    pub t: f64,
}

impl Gap {
    /// Its width and rate at `t`, in flight. Gravity and plate act on the `lowest` gap only,
    /// which is over the floor.
    #[inline]
    pub fn flown<G: Ground>(&self, ground: &G, lowest: bool, t: f64) -> (f64, f64) {
        if G::PULLS && lowest {
            ground.fall(self.t, self.g, self.w, t)
        } else {
            (self.g + self.w * (t - self.t), self.w)
        }
    }

    /// When it closes, in flight; infinite if never.
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
#[derive(Clone)]
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

/// When a gap of constant rate closes, which was `g` at `t0`; infinite if never.
pub(crate) fn closing(t0: f64, g: f64, w: f64) -> f64 {
    std::hint::select_unpredictable(w >= 0.0, f64::INFINITY, t0 - g.max(0.0) / w)
}

/// A fixed floor under gravity.
#[derive(Clone)]
pub(crate) struct Weight {
    gravity: f64,
    plate: Plate,
    tick: f64,
}

impl Weight {
    /// Under `gravity`, for beads of this mean diameter. A tick is about the time in which a
    /// bead falls by its own size.
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

/// The first τ ≥ 0 at which g + wτ − aτ²/2 falls to zero, g ≥ 0. (From g = 0 with w > 0 it
/// first rises: that is the second root.)
fn first_root(g: f64, w: f64, a: f64) -> f64 {
    let root = (w * w + 2.0 * a * g).sqrt();
    if w < 0.0 {
        2.0 * g / (root - w)
    } else {
        (w + root) / a
    }
}
