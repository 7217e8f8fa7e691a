//! The vibrating floor, z₀ = A₀ sin θ, θ = 2πft + θ₀, Eq. (1).

use crate::math;
use crate::scene::{Floor, Scene, angular};

/// The plate as state. How it gets from one motion to another after an edit is its
/// [`Course`](super::course::Course).
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Plate {
    /// A₀, m; 0 for a fixed floor.
    pub amplitude: f64,
    /// 2πf, 1/s; 0 for a fixed floor.
    pub omega: f64,
    /// Phase θ, rad, in [0, 2π).
    pub phase: f64,
    /// Height about which it moves, m: 0 but on the way to another motion.
    pub centre: f64,
}

impl Plate {
    /// The floor of a scene at t = 0.
    pub fn of(scene: &Scene) -> Self {
        match scene.floor {
            Floor::Fixed => Self::default(),
            Floor::Vibrating(shake) => Self {
                amplitude: shake.amplitude,
                omega: angular(shake.frequency),
                ..Self::default()
            },
        }
    }

    /// The plate a time τ later.
    pub fn later(self, tau: f64) -> Self {
        let phase = (self.phase + self.omega * tau).rem_euclid(std::f64::consts::TAU);
        Self { phase, ..self }
    }

    /// Period, s; infinite for a fixed floor.
    pub fn period(&self) -> f64 {
        std::f64::consts::TAU / self.omega
    }

    /// Its greatest acceleration A₀ω², m/s².
    pub fn shake(&self) -> f64 {
        self.amplitude * self.omega * self.omega
    }

    /// Height z₀, m.
    pub fn position(&self) -> f64 {
        self.centre + self.amplitude * math::sin(self.phase)
    }

    /// ∫ z₀ dt, m s, and ∫ ż₀² dt, m²/s, over the next `tau` s.
    pub fn swept(&self, tau: f64) -> (f64, f64) {
        if self.omega == 0.0 {
            return (self.centre * tau, 0.0);
        }
        let turn = self.omega * tau;
        let middle = math::sin(self.phase + 0.5 * turn);
        let swung = 2.0 * self.amplitude / self.omega * math::sin(0.5 * turn) * middle;
        let beat = math::sin(turn) * math::cos(2.0 * self.phase + turn) / self.omega;
        let fastest = self.amplitude * self.omega;
        let squares = 0.5 * fastest * fastest * (tau + beat);
        (self.centre * tau + swung, squares)
    }

    /// Velocity ż₀, m/s.
    pub fn velocity(&self) -> f64 {
        self.amplitude * self.omega * math::cos(self.phase)
    }

    /// Both of these at once, which costs little more than one.
    pub fn motion(&self) -> (f64, f64) {
        let (sin, cos) = math::sin_cos(self.phase);
        let position = self.centre + self.amplitude * sin;
        (position, self.amplitude * self.omega * cos)
    }

    /// Acceleration z̈₀, m/s².
    pub fn acceleration(&self) -> f64 {
        -self.amplitude * self.omega * self.omega * math::sin(self.phase)
    }
}
