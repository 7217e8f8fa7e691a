//! What a scene has only in part: how its column is launched, how its plate vibrates, its
//! soft contacts and their grid of steps; and the way to each of them.

use super::{Facts, Floor, Integrator, Law, Method, Solver, Start, angular};
use crate::math;

/// How a column is launched.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Launch {
    /// Separation s₀ between neighbours, and of bead 1 from the floor, m; ≥ 0.
    pub s0: f64,
    /// Shift every bead at random (seeded) by up to ±s₀/2, as in Fig. 2(a).
    pub jitter: bool,
    /// Common velocity v₀, m/s; negative towards the floor.
    pub v0: f64,
}

/// How a plate vibrates.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Shake {
    /// Amplitude A₀, m.
    pub amplitude: f64,
    /// Frequency f, Hz.
    pub frequency: f64,
}

impl Shake {
    /// The plate's largest speed A₀ 2πf, m/s.
    pub fn speed(self) -> f64 {
        self.amplitude * angular(self.frequency)
    }

    /// The plate's largest acceleration A₀ (2πf)², m/s².
    pub fn acceleration(self) -> f64 {
        self.amplitude * math::powi(angular(self.frequency), 2)
    }
}

/// Soft contacts.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Soft {
    /// The force of a contact.
    pub law: Law,
    /// How their motion is computed.
    pub solver: Solver,
    /// Whether the short attractive end of a contact acts (the paper's law).
    pub attraction: bool,
}

/// A fixed grid of time steps.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct GridSettings {
    /// The integrator.
    pub integrator: Integrator,
    /// Time steps in one contact time.
    pub steps_per_contact: f64,
}

impl Facts {
    /// How the column is launched, unless it rests.
    pub fn launch(&self) -> Option<Launch> {
        match self.start {
            Start::Launched(launch) => Some(launch),
            Start::Resting => None,
        }
    }

    /// The same, to be changed.
    pub fn launch_mut(&mut self) -> Option<&mut Launch> {
        match &mut self.start {
            Start::Launched(launch) => Some(launch),
            Start::Resting => None,
        }
    }

    /// How the plate vibrates, if it does.
    pub fn shake(&self) -> Option<Shake> {
        match self.floor {
            Floor::Vibrating(shake) => Some(shake),
            Floor::Fixed => None,
        }
    }

    /// The same, to be changed.
    pub fn shake_mut(&mut self) -> Option<&mut Shake> {
        match &mut self.floor {
            Floor::Vibrating(shake) => Some(shake),
            Floor::Fixed => None,
        }
    }

    /// The soft contacts, where they are not hard.
    pub fn soft(&self) -> Option<Soft> {
        match self.method {
            Method::Soft(soft) => Some(soft),
            Method::Hard(_) => None,
        }
    }

    /// The same, to be changed.
    pub fn soft_mut(&mut self) -> Option<&mut Soft> {
        match &mut self.method {
            Method::Soft(soft) => Some(soft),
            Method::Hard(_) => None,
        }
    }

    /// The law of soft contacts.
    pub fn law(&self) -> Option<Law> {
        self.soft().map(|soft| soft.law)
    }

    /// The grid of time steps, where soft contacts are on one.
    pub fn grid(&self) -> Option<GridSettings> {
        match self.soft()?.solver {
            Solver::Grid(grid) => Some(grid),
            Solver::Exact | Solver::Adaptive { .. } => None,
        }
    }

    /// The same, to be changed.
    pub fn grid_mut(&mut self) -> Option<&mut GridSettings> {
        match &mut self.soft_mut()?.solver {
            Solver::Grid(grid) => Some(grid),
            Solver::Exact | Solver::Adaptive { .. } => None,
        }
    }

    /// The tolerance of the adaptive method, where it is in force.
    pub fn tolerance(&self) -> Option<f64> {
        match self.soft()?.solver {
            Solver::Adaptive { tolerance } => Some(tolerance),
            Solver::Grid(_) | Solver::Exact => None,
        }
    }

    /// The same, to be changed.
    pub fn tolerance_mut(&mut self) -> Option<&mut f64> {
        match &mut self.soft_mut()?.solver {
            Solver::Adaptive { tolerance } => Some(tolerance),
            Solver::Grid(_) | Solver::Exact => None,
        }
    }
}
