//! An engine on its way, in slices, with somebody looking on.

use crate::physics::{self, Engine, EngineError, Observation, Outcome};
use crate::scene::{Launch, MethodName, Scene};
use std::ops::ControlFlow;
use std::time::Instant;

/// Bead steps between two looks; about 10 ms.
const BEAD_STEPS: usize = 2_000_000;

/// The same for the exact method, whose steps are long and dear, and move so many beads
/// at most, roughly, where the law is linear: a cluster, not the column.
const EXACT_BEAD_STEPS: usize = 20_000;
const CLUSTER: usize = 50;

/// Events between two looks; one costs about the same in any column.
const EVENTS: u64 = 200_000;

/// Growth of the time between two looks whether a floor collision is over.
const PATIENCE: f64 = 0.05;

/// Who looks on: is told the simulated time every few milliseconds, s, and may stop the run.
pub type Watch<'a> = dyn FnMut(f64) -> ControlFlow<()> + 'a;

/// Stops a run at the end of its time.
pub fn in_time(end: Instant) -> impl FnMut(f64) -> ControlFlow<()> {
    move |_| {
        if Instant::now() < end {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    }
}

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

/// Seconds that a slice of work, whatever the method, takes on an ordinary machine.
pub const SLICE: f64 = 0.01;

/// A run that would need so many times its allowance is not taken to the end of it.
const HOPELESS: f64 = 20.0;

/// What a run may cost: counted work, the same on every machine.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Allowance {
    /// Slices of work.
    pub slices: u64,
    /// When the run will be at its end, s of simulated time, if that is known.
    pub end: Option<f64>,
}

impl Allowance {
    /// Slices that the whole run needs, if that can be told from so many spent by `time`.
    pub fn needed(&self, spent: u64, time: f64) -> Option<f64> {
        let end = self.end.filter(|_| time > 0.0)?;
        Some(spent as f64 * (end / time).max(1.0))
    }

    fn is_spent(&self, spent: u64, time: f64) -> bool {
        let hopeless = || {
            let needed = self.needed(spent, time);
            needed.is_some_and(|all| all > HOPELESS * self.slices as f64)
        };
        spent >= self.slices || (4 * spent > self.slices && hopeless())
    }
}

/// An engine on its way.
pub struct Drive<'a> {
    engine: Box<dyn Engine>,
    slice: u64,
    spent: u64,
    allowance: Option<Allowance>,
    watch: &'a mut Watch<'a>,
}

impl<'a> Drive<'a> {
    /// The engine of a scene, at its start.
    pub fn new(scene: &Scene, watch: &'a mut Watch<'a>) -> Self {
        Self::of(physics::build(scene, None).0, scene, watch)
    }

    /// An engine of that scene, wherever it is.
    pub fn of(engine: Box<dyn Engine>, scene: &Scene, watch: &'a mut Watch<'a>) -> Self {
        let in_steps = |bead_steps: usize, beads: usize| (bead_steps / beads).max(1) as u64;
        let slice = match scene.method.name() {
            MethodName::Ed => EVENTS,
            MethodName::Exact => {
                // The adaptive method moves all beads at once.
                let moved = match scene.tolerance() {
                    Some(_) => scene.n,
                    None => scene.n.min(CLUSTER),
                };
                in_steps(EXACT_BEAD_STEPS, moved)
            }
            _ => in_steps(BEAD_STEPS, scene.n),
        };
        Self {
            engine,
            slice,
            spent: 0,
            allowance: None,
            watch,
        }
    }

    /// The same, to be stopped when it has spent this.
    #[must_use]
    pub fn within(self, allowance: Allowance) -> Self {
        Self {
            allowance: Some(allowance),
            ..self
        }
    }

    /// Whole slices of work so far.
    pub fn spent(&self) -> u64 {
        self.spent
    }

    /// Slices that so many steps or events are.
    pub fn in_slices(&self, count: u64) -> f64 {
        count as f64 / self.slice as f64
    }

    /// Moves on to `until`, s.
    ///
    /// # Errors
    /// [`RunError`] when the engine cannot go on, or the run is stopped.
    pub fn advance(&mut self, until: f64) -> Result<Outcome, RunError> {
        loop {
            let outcome = self.engine.advance(until, self.slice)?;
            let time = self.engine.time();
            self.spent += u64::from(outcome == Outcome::OutOfBudget);
            let given = self.allowance;
            let spent = given.is_some_and(|given| given.is_spent(self.spent, time));
            if spent || (self.watch)(time).is_break() {
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
    match scene.launch() {
        // Rows that just touch go on doing so: a lattice is stepped to the end of a look.
        Some(Launch { s0, v0, .. }) if scene.sites().is_some() => contact.max(s0 / v0.abs()),
        Some(Launch { s0, v0, .. }) if v0 != 0.0 => {
            contact.max(s0.max(1e-3 * scene.diameter) / v0.abs())
        }
        _ => contact.max(scene.diameter),
    }
}
