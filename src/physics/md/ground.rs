//! What pulls on the lowest gap: nothing, gravity, or gravity and a moving plate.
//! In gap coordinates no other gap feels any of them.

use crate::math;
use crate::physics::plate::Plate;

/// Steps between two exact evaluations of the plate's sine; a rotation takes the
/// steps between, with an error of a few hundred roundings at most.
const RESYNC: u64 = 256;

/// The floor and gravity of an MD column. Unless said otherwise the floor stands still.
pub(crate) trait Ground: Clone + Send {
    /// Whether there is gravity.
    const PULLS: bool;
    /// Whether the floor moves.
    const MOVES: bool;
    /// Sets the time step, s.
    fn set_step(&mut self, _: f64) {}
    /// Moves the floor on by a step.
    fn step(&mut self) {}
    /// Acceleration −(g + z̈₀) of a free lowest gap, m/s².
    fn pull(&self) -> f64;
    /// Velocity of the floor, m/s.
    fn velocity(&self) -> f64 {
        0.0
    }
    /// The floor now.
    fn plate(&self) -> Plate;
}

/// A fixed floor without gravity.
#[derive(Clone)]
pub(crate) struct Free {
    plate: Plate,
}

impl Free {
    pub fn new(plate: Plate) -> Self {
        Self { plate }
    }
}

impl Ground for Free {
    const PULLS: bool = false;
    const MOVES: bool = false;
    fn pull(&self) -> f64 {
        0.0
    }
    fn plate(&self) -> Plate {
        self.plate
    }
}

/// A fixed floor under gravity.
#[derive(Clone)]
pub(crate) struct Weight {
    gravity: f64,
    plate: Plate,
}

impl Weight {
    pub fn new(gravity: f64, plate: Plate) -> Self {
        Self { gravity, plate }
    }
}

impl Ground for Weight {
    const PULLS: bool = true;
    const MOVES: bool = false;
    fn pull(&self) -> f64 {
        -self.gravity
    }
    fn plate(&self) -> Plate {
        self.plate
    }
}

/// A vibrating plate under gravity.
#[derive(Clone)]
pub(crate) struct Shaken {
    gravity: f64,
    start: Plate,
    h: f64,
    n: u64,
    sin: f64,
    cos: f64,
    turn: (f64, f64),
}

impl Shaken {
    pub fn new(gravity: f64, start: Plate) -> Self {
        let (sin, cos) = math::sin_cos(start.phase);
        Self {
            gravity,
            start,
            h: 0.0,
            n: 0,
            sin,
            cos,
            turn: (0.0, 1.0),
        }
    }
}

impl Ground for Shaken {
    const PULLS: bool = true;
    const MOVES: bool = true;

    fn set_step(&mut self, h: f64) {
        self.h = h;
        self.turn = math::sin_cos(self.start.omega * h);
    }

    fn step(&mut self) {
        self.n += 1;
        (self.sin, self.cos) = if self.n.is_multiple_of(RESYNC) {
            math::sin_cos(self.plate().phase)
        } else {
            let (sin, cos) = self.turn;
            (
                self.sin * cos + self.cos * sin,
                self.cos * cos - self.sin * sin,
            )
        };
    }

    fn pull(&self) -> f64 {
        self.start.amplitude * self.start.omega * self.start.omega * self.sin - self.gravity
    }

    fn velocity(&self) -> f64 {
        self.start.amplitude * self.start.omega * self.cos
    }

    fn plate(&self) -> Plate {
        self.start.later(self.n as f64 * self.h)
    }
}
