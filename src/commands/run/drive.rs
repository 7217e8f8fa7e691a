//! An engine on its way, in slices, with its progress shown.

use super::progress::Progress;
use crate::commands::Failure;
use crate::physics::{self, Engine, Observation, Outcome};
use crate::scene::{Scene, Start};

/// Bead steps between two looks at the clock.
const BEAD_STEPS: usize = 2_000_000;

/// Events between two looks at the clock; one costs about the same in any column.
const EVENTS: u64 = 200_000;

/// Growth of the time between two looks whether a floor collision is over.
const PATIENCE: f64 = 0.05;

/// An engine on its way.
pub(super) struct Drive {
    engine: Box<dyn Engine>,
    budget: u64,
    progress: Progress,
}

impl Drive {
    /// The engine of a scene, at its start.
    pub fn new(scene: &Scene) -> Self {
        let (engine, _) = physics::build(scene, None);
        let budget = if scene.is_md() {
            (BEAD_STEPS / scene.n).max(1) as u64
        } else {
            EVENTS
        };
        Self {
            engine,
            budget,
            progress: Progress::new(scene.duration),
        }
    }

    /// Moves on to `until`, s.
    pub fn advance(&mut self, until: f64) -> Result<Outcome, Failure> {
        loop {
            let outcome = self
                .engine
                .advance(until, self.budget)
                .map_err(|error| Failure::Failed(error.to_string()))?;
            self.progress.show(self.engine.time());
            if outcome != Outcome::OutOfBudget {
                return Ok(outcome);
            }
        }
    }

    /// Moves on until the floor collision of a scene without gravity is over, or
    /// to its duration if that comes first. Says whether it is over.
    pub fn collide(&mut self, scene: &Scene) -> Result<bool, Failure> {
        let look = natural_time(scene);
        let end = scene.duration.unwrap_or(f64::INFINITY);
        let mut until = 0.0;
        while until < end {
            // The times to look at depend on nothing but the scene: the same bytes again.
            until = end.min(until + look.max(PATIENCE * until));
            if self.advance(until)? == Outcome::Over {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// Whether the floor collision is over.
    pub fn is_over(&self) -> bool {
        self.engine.is_over()
    }

    /// Simulated time, s.
    pub fn time(&self) -> f64 {
        self.engine.time()
    }

    /// What can be seen now.
    pub fn observe(&self, into: &mut Observation) {
        self.engine.observe(into);
    }
}

/// A time in which a column that hits a floor changes, s.
pub fn natural_time(scene: &Scene) -> f64 {
    let contact = scene.contact_time().unwrap_or(0.0);
    match scene.start {
        Start::Separated { s0, v0, .. } if v0 != 0.0 => {
            contact.max(s0.max(1e-3 * scene.diameter) / v0.abs())
        }
        _ => contact.max(scene.diameter),
    }
}
