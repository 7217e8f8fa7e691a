//! What acts on gaps but contacts: gravity, and the floor that the column stands on.
//!
//! A [`Ground`] is chosen here, once for all methods, and known when the program is compiled:
//! a scene pays only for what it has. All times are in seconds from the engine's epoch.

mod shaken;

use super::Engine;
use super::flight::{Gap, closing};
use super::plate::Plate;
use super::state::State;
use crate::math;
use crate::scene::{Floor, Scene};
use shaken::Shaken;

/// A way to move columns, over any ground.
pub(crate) trait OverGround {
    /// Its engine of a scene, from a state on.
    fn over<G: Ground>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine>;
}

/// Builds the engine that moves a scene in this way, from a state on.
pub(crate) fn build<Way: OverGround>(scene: &Scene, state: State) -> Box<dyn Engine> {
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), state.plate);
            Way::over(scene, state, ground)
        }
        (Floor::Fixed, Some(gravity)) => {
            Way::over(scene, state, Weight::new(gravity, scene.diameter))
        }
        (Floor::Fixed, None) => Way::over(scene, state, Free),
    }
}

/// Gravity and floor of a column. Unless said otherwise there is no gravity, and the floor
/// stands still.
///
/// Gaps are asked for by their number: gravity and floor act on the lowest free one alone.
pub(crate) trait Ground: Clone + Send + 'static {
    /// Whether there is gravity.
    const PULLS: bool;
    /// Whether the floor moves.
    const MOVES: bool = false;

    /// How many beads ride the floor; the gap above them is the lowest free one.
    fn riders(&self) -> usize {
        0
    }
    /// Lets so many beads ride the floor.
    fn set_riders(&mut self, _: usize) {}
    /// g, m/s².
    fn gravity(&self) -> f64 {
        0.0
    }
    /// Gap, m, and rate, m/s, at time `t` of a free bead over the floor that had gap `g` and
    /// rate `w` at `t0`.
    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64);
    /// When that bead next hits the floor; infinite if never.
    fn hit(&self, t0: f64, g: f64, w: f64) -> f64;
    /// g + z̈₀ at `t`, m/s²: the acceleration that presses a resting bead onto the floor.
    fn pressing(&self, _: f64) -> f64 {
        self.gravity()
    }
    /// When, from `t` on, the floor first falls away faster than g; infinite if never.
    fn take_off(&self, _: f64) -> f64 {
        f64::INFINITY
    }
    /// The floor at `t`.
    fn plate(&self, _: f64) -> Plate {
        Plate::default()
    }
    /// Time after which the epoch should move on, s: a power of two, or infinite if never.
    fn tick(&self) -> f64 {
        f64::INFINITY
    }
    /// Moves the epoch on by so many seconds, at most about a tick.
    fn move_epoch(&mut self, _by: f64) {}
    /// Makes `plate` the floor at the epoch.
    fn set_plate(&mut self, _: Plate) {}
    /// Writes the Taylor coefficients of −(g + z̈₀), m/s², the acceleration of a free lowest
    /// gap, as a series in τ/h from `t` on.
    fn pull(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
        into[0] = -self.gravity();
    }
    /// Writes those of the floor's velocity, m/s.
    fn motion(&self, _: f64, _: f64, into: &mut [f64]) {
        into.fill(0.0);
    }

    /// Whether gap `i` does not fly at a constant rate.
    #[inline]
    fn bends(&self, i: usize) -> bool {
        Self::PULLS && i == self.riders()
    }
    /// Width, m, and rate, m/s, of gap `i` at `t`, in flight.
    #[inline]
    fn flown(&self, i: usize, gap: &Gap, t: f64) -> (f64, f64) {
        if self.bends(i) {
            self.fall(gap.t, gap.g, gap.w, t)
        } else {
            (gap.g + gap.w * (t - gap.t), gap.w)
        }
    }
    /// The same, `tau` s after it was `gap`.
    #[inline]
    fn after(&self, i: usize, gap: &Gap, tau: f64) -> (f64, f64) {
        if self.bends(i) {
            self.fall(gap.t, gap.g, gap.w, gap.t + tau)
        } else {
            (gap.g + gap.w * tau, gap.w)
        }
    }
    /// When gap `i` closes, in flight; infinite if never.
    #[inline]
    fn closes(&self, i: usize, gap: &Gap) -> f64 {
        if self.bends(i) {
            self.hit(gap.t, gap.g, gap.w)
        } else {
            closing(gap.t, gap.g, gap.w)
        }
    }
    /// How long until then, s.
    #[inline]
    fn lasts(&self, i: usize, gap: &Gap) -> f64 {
        if self.bends(i) {
            self.hit(gap.t, gap.g, gap.w) - gap.t
        } else {
            closing(0.0, gap.g, gap.w)
        }
    }
    /// Adds what acts at `t` to the accelerations of all gaps, m/s².
    #[inline]
    fn accelerate(&self, t: f64, gaps: &mut [f64]) {
        if Self::PULLS {
            gaps[self.riders()] -= self.pressing(t);
        }
    }
}

/// A fixed floor without gravity.
#[derive(Clone)]
struct Free;

impl Ground for Free {
    const PULLS: bool = false;

    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64) {
        (g + w * (t - t0), w)
    }

    fn hit(&self, t0: f64, g: f64, w: f64) -> f64 {
        closing(t0, g, w)
    }
}

/// A fixed floor under gravity.
#[derive(Clone)]
struct Weight {
    gravity: f64,
    tick: f64,
    riders: usize,
}

impl Weight {
    /// Under `gravity`, for beads of this mean diameter. A tick is about the time in which a
    /// bead falls by its own size.
    fn new(gravity: f64, diameter: f64) -> Self {
        Self {
            gravity,
            tick: power_of_two((diameter / gravity).sqrt()),
            riders: 0,
        }
    }
}

/// The power of two nearest to `x`.
fn power_of_two(x: f64) -> f64 {
    math::exp2(math::log2(x).round())
}

impl Ground for Weight {
    const PULLS: bool = true;

    fn riders(&self) -> usize {
        self.riders
    }

    fn set_riders(&mut self, riders: usize) {
        self.riders = riders;
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

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

    fn tick(&self) -> f64 {
        self.tick
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
