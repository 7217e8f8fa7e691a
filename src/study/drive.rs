//! An engine on its way, in slices, with somebody looking on.

use crate::physics::{self, Engine, EngineError, Observation, Outcome};
use crate::scene::{MethodName, Scene, Start};
use std::ops::ControlFlow;

/// Bead steps between two looks; about 10 ms.
const BEAD_STEPS: usize = 2_000_000;

/// The same for the exact method, whose steps are long and dear.
const EXACT_BEAD_STEPS: usize = 20_000;

/// Events between two looks; one costs about the same in any column.
const EVENTS: u64 = 200_000;

/// Growth of the time between two looks whether a floor collision is over.
const PATIENCE: f64 = 0.05;

/// Who looks on: is told the simulated time every few milliseconds, s, and may stop the run.
pub type Watch<'a> = dyn FnMut(f64) -> ControlFlow<()> + 'a;

/// Why a run has no end.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum RunError {
    /// The engine cannot go on.
    #[error(transparent)]
    Engine(#[from] EngineError),
    /// Who looked on stopped it.
    #[error("the run was stopped at t = {time:e} s")]
    Stopped {
        /// When, in simulated time, s.
        time: f64,
    },
}

/// An engine on its way.
pub struct Drive<'a> {
    engine: Box<dyn Engine>,
    slice: u64,
    watch: &'a mut Watch<'a>,
}

impl<'a> Drive<'a> {
    /// The engine of a scene, at its start.
    pub fn new(scene: &Scene, watch: &'a mut Watch<'a>) -> Self {
        Self::of(physics::build(scene, None).0, scene, watch)
    }

    /// An engine of that scene, wherever it is.
    pub fn of(engine: Box<dyn Engine>, scene: &Scene, watch: &'a mut Watch<'a>) -> Self {
        let in_steps = |bead_steps: usize| (bead_steps / scene.n).max(1) as u64;
        let slice = match scene.method.name() {
            MethodName::Ed => EVENTS,
            MethodName::Exact => in_steps(EXACT_BEAD_STEPS),
            _ => in_steps(BEAD_STEPS),
        };
        Self {
            engine,
            slice,
            watch,
        }
    }

    /// Moves on to `until`, s.
    ///
    /// # Errors
    /// [`RunError`] when the engine cannot go on, or the run is stopped.
    pub fn advance(&mut self, until: f64) -> Result<Outcome, RunError> {
        loop {
            let outcome = self.engine.advance(until, self.slice)?;
            let time = self.engine.time();
            if (self.watch)(time).is_break() {
                return Err(RunError::Stopped { time });
            }
            if outcome != Outcome::OutOfBudget {
                return Ok(outcome);
            }
        }
    }

    /// Moves on until the floor collision of a scene without gravity is over, or
    /// to its duration if that comes first. Says whether it is over.
    ///
    /// # Errors
    /// As [`Drive::advance`].
    pub fn collide(&mut self, scene: &Scene) -> Result<bool, RunError> {
        let look = natural_time(scene);
        let end = scene.duration.unwrap_or(f64::INFINITY);
        let mut until = self.time();
        while until < end {
            // The times to look at depend on nothing but the scene: the same bytes again.
            until = end.min(until + look.max(PATIENCE * until));
            if self.advance(until)? == Outcome::Over {
                return Ok(true);
            }
        }
        Ok(false)
    }

    /// The engine, to go on with it later.
    pub fn into_engine(self) -> Box<dyn Engine> {
        self.engine
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
