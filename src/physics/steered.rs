//! A column on a plate whose motion was edited: an engine for every part of its course.
//!
//! Engines know one motion of the plate. At a turn the state of one goes on in the next:
//! columns that nobody edits pay nothing.

use super::course::Course;
use super::observation::{Integrals, Observation};
use super::state::State;
use super::{Engine, EngineError, Outcome, unsteered};
use crate::scene::Scene;

/// The engine of a scene whose plate has a course.
pub(super) fn build(scene: &Scene, mut state: State) -> Box<dyn Engine> {
    let mut course = std::mem::take(&mut state.course);
    while course.next().is_some_and(|time| time <= state.time)
        && let Some(turn) = course.take()
    {
        state = state.turned(turn, scene);
    }
    Box::new(Steered {
        engine: unsteered(scene, state),
        scene: scene.clone(),
        course,
        before: None,
    })
}

#[derive(Clone)]
struct Steered {
    scene: Scene,
    /// The engine up to the next turn.
    engine: Box<dyn Engine>,
    course: Course,
    /// What the engines before this one have integrated.
    before: Option<Integrals>,
}

impl Steered {
    /// Takes the next turn, which the engine has come to.
    fn turn(&mut self) {
        let mut seen = Observation::default();
        self.observe(&mut seen);
        self.before = seen.integrals;
        if let Some(turn) = self.course.take() {
            let state = self.engine.state().turned(turn, &self.scene);
            self.engine = unsteered(&self.scene, state);
        }
    }
}

impl Engine for Steered {
    fn time(&self) -> f64 {
        self.engine.time()
    }

    /// The budget is that of each part of the course.
    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        while let Some(time) = self.course.next().filter(|time| *time <= until) {
            if self.engine.advance(time, budget)? == Outcome::OutOfBudget {
                return Ok(Outcome::OutOfBudget);
            }
            self.turn();
        }
        self.engine.advance(until, budget)
    }

    fn is_over(&self) -> bool {
        self.engine.is_over()
    }

    /// What lies beyond a turn is not known: the turn comes first.
    fn next_event(&self) -> Option<f64> {
        let (event, turn) = (self.engine.next_event(), self.course.next());
        match event.zip(turn) {
            Some((event, turn)) => Some(event.min(turn)),
            None => event.or(turn.filter(|_| !self.scene.is_md())),
        }
    }

    fn observe(&self, into: &mut Observation) {
        self.engine.observe(into);
        if let Some(before) = self.before {
            into.integrals = into.integrals.map(|since| before.and(since));
        }
    }

    fn state(&self) -> State {
        State {
            course: self.course.clone(),
            ..self.engine.state()
        }
    }
}
