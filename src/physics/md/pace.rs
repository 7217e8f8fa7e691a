//! Gravity and floor step by step.

use crate::math;
use crate::physics::ground::Ground;
use crate::physics::plate::Plate;

/// Steps between two exact evaluations of the plate's sine; a rotation takes the
/// steps between, with an error of a few hundred roundings at most.
const RESYNC: u64 = 256;

/// A ground as it is after so many steps.
#[derive(Clone)]
pub(crate) struct Pace<G> {
    ground: G,
    h: f64,
    n: u64,
    /// Sine and cosine of the plate's phase now, and of how far it turns in a step.
    now: (f64, f64),
    turn: (f64, f64),
    gravity: f64,
    /// Aω², m/s², and Aω, m/s, of the plate.
    shake: f64,
    fastest: f64,
}

impl<G: Ground> Pace<G> {
    /// In steps of `h` s.
    pub fn new(ground: G, h: f64) -> Self {
        let plate = ground.plate(0.0);
        Self {
            h,
            n: 0,
            now: math::sin_cos(plate.phase),
            turn: math::sin_cos(plate.omega * h),
            gravity: ground.gravity(),
            shake: plate.shake(),
            fastest: plate.amplitude * plate.omega,
            ground,
        }
    }

    /// Moves the floor on by a step.
    #[inline]
    pub fn step(&mut self) {
        if !G::MOVES {
            return;
        }
        self.n += 1;
        let ((sin, cos), turn) = (self.now, self.turn);
        self.now = if self.n.is_multiple_of(RESYNC) {
            math::sin_cos(self.plate().phase)
        } else {
            (sin * turn.1 + cos * turn.0, cos * turn.1 - sin * turn.0)
        };
    }

    /// Acceleration −(g + z̈₀) of a free lowest gap, m/s².
    #[inline]
    pub fn pull(&self) -> f64 {
        if G::MOVES {
            self.shake * self.now.0 - self.gravity
        } else if G::PULLS {
            -self.gravity
        } else {
            0.0
        }
    }

    /// Velocity of the floor, m/s.
    #[inline]
    pub fn velocity(&self) -> f64 {
        self.fastest * self.now.1
    }

    /// The floor now.
    pub fn plate(&self) -> Plate {
        self.ground.plate(self.n as f64 * self.h)
    }
}
