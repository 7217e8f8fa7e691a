//! Soft contacts under a power law, to a tolerance.
//!
//! While a contact is closed the column is integrated by Gragg-Bulirsch-Stoer extrapolation.
//! The error allowed is relative to the motion of each contact. No step goes beyond the
//! beginning or the end of a contact, where the force is not smooth. Without contacts the
//! beads fly in closed form.
//!
//! Steps do not depend on the times that are asked for. A time within a step is reached by
//! another, shorter step, which is then forgotten.

mod equations;
mod extrapolation;
mod hermite;
mod step;

use super::column::{OVER, masses, nothing_to_come, springs};
use super::flight::{Free, Ground, Shaken, Weight};
use super::ledger::{Ledger, Sum};
use super::observation::Observation;
use super::snapshot::Snapshot;
use super::state::{Books, State, weight};
use super::{Engine, EngineError, Outcome};
use crate::scene::{Floor, Scene};
use equations::Equations;
use step::{Ahead, Motion};

/// Steps between two looks whether contacts that never open have spent their energy.
const INSPECTION: u64 = 64;

/// Steps in which no contact begins or ends, after which a column without gravity only creeps.
/// Strongly damped contacts under a power law let go ever more slowly, and never open.
const CREEPING: u64 = 300_000;

/// Builds the engine of an MD scene under a power law.
pub(super) fn build(scene: &Scene, tolerance: f64, state: State) -> Box<dyn Engine> {
    let plate = state.plate;
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), plate);
            Adaptive::boxed(scene, tolerance, state, ground)
        }
        (Floor::Fixed, Some(gravity)) => {
            let ground = Weight::new(gravity, plate, scene.diameter);
            Adaptive::boxed(scene, tolerance, state, ground)
        }
        (Floor::Fixed, None) => Adaptive::boxed(scene, tolerance, state, Free { plate }),
    }
}

/// The column at a time within the step ahead, for whoever looks.
#[derive(Clone)]
struct Midstep {
    /// Simulated time, s.
    time: f64,
    /// Time since the epoch, s.
    t: f64,
    /// Laid out as the equations have it.
    y: Vec<f64>,
}

/// A column under a power law.
#[derive(Clone)]
struct Adaptive<G> {
    motion: Motion<G>,
    masses: Vec<f64>,
    gravity: f64,
    /// Simulated time at which the engine started, s.
    origin: f64,
    /// Ticks of the ground from there to the epoch.
    ticks: f64,
    /// End of the last step, s from the epoch.
    now: Sum,
    /// The step that is computed, but not taken yet.
    ahead: Option<Ahead>,
    /// What was last asked for within that step.
    midstep: Option<Midstep>,
    state: State,
    over: bool,
    /// Steps since time last moved on by a part of the contact time, and when that was, s.
    idle: (u64, f64),
    /// Steps since a contact last began or ended.
    unchanged: u64,
}

impl<G: Ground + 'static> Adaptive<G> {
    fn boxed(scene: &Scene, tolerance: f64, state: State, ground: G) -> Box<dyn Engine> {
        let masses = masses(scene);
        let contact_time = scene.contact_time().unwrap_or(f64::NAN);
        let attraction = scene.soft().is_some_and(|soft| soft.attraction);
        let fall = weight(scene) * contact_time;
        let equations = Equations::new(springs(scene, &masses), &masses, attraction, fall);
        let mut y = state.gaps.clone();
        y.extend(&state.rates);
        y.extend([0.0; 2]);
        let mut adaptive = Self {
            motion: Motion::new(ground, equations, y, tolerance, contact_time),
            gravity: weight(scene),
            origin: state.time,
            ticks: 0.0,
            now: Sum::default(),
            ahead: None,
            midstep: None,
            over: false,
            idle: (0, state.time),
            unchanged: 0,
            masses,
            state,
        };
        adaptive.settle();
        if adaptive.motion.closed[0] {
            let arrival = adaptive.snapshot(&adaptive.motion.y).arrival();
            adaptive.state.books.bounce.begin(arrival);
        }
        let energy = adaptive.snapshot(&adaptive.motion.y).energy();
        let error = adaptive.state.ledger_error;
        adaptive.state.books.ledger.open(energy, error);
        Box::new(adaptive)
    }

    fn beads(&self) -> usize {
        self.masses.len()
    }

    /// The time of the last step's end, s.
    fn reached(&self) -> f64 {
        self.absolute(self.now.total())
    }

    /// The simulated time, s, that lies `t` s after the epoch.
    fn absolute(&self, t: f64) -> f64 {
        let tick = self.motion.ground.tick();
        // An infinite tick never passes, and 0 times it is not a number.
        let epoch = if self.ticks > 0.0 {
            self.ticks * tick
        } else {
            0.0
        };
        self.origin + (epoch + t)
    }

    /// Now, s from the epoch, and the column then.
    fn seen(&self) -> (f64, &[f64]) {
        match &self.midstep {
            Some(midstep) => (midstep.t, &midstep.y),
            None => (self.now.total(), &self.motion.y),
        }
    }

    fn snapshot<'a>(&'a self, y: &'a [f64]) -> Snapshot<'a> {
        let (gaps, rest) = y.split_at(self.beads());
        Snapshot {
            time: self.time(),
            gaps,
            rates: &rest[..self.beads()],
            plate: self.motion.ground.plate(self.seen().0),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.motion.equations.springs,
        }
    }

    /// What is accounted for, up to now.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        if let Some(midstep) = &self.midstep {
            enter(&mut ledger, &midstep.y, self.beads());
        }
        ledger
    }

    /// Notes which contacts began or ended.
    fn settle(&mut self) {
        self.motion.settle();
        let time = self.time();
        let was_closed = self.state.books.contacts.closed()[0];
        for (i, &closed) in self.motion.closed.iter().enumerate() {
            self.state.books.contacts.note(i, closed, time);
        }
        if self.motion.closed[0] != was_closed {
            let arrival = self.snapshot(&self.motion.y).arrival();
            self.state.books.bounce.turn(!was_closed, arrival);
        }
        if !G::PULLS && !self.over && self.state.books.contacts.all_open() {
            self.over = nothing_to_come(self.motion.rates().iter().copied(), &self.masses, OVER);
        }
    }

    /// Takes the step ahead.
    fn take(&mut self, ahead: Ahead) -> Result<(), EngineError> {
        self.midstep = None;
        let books = &mut self.state.books;
        books.steps += u64::from(!ahead.flight);
        enter(&mut books.ledger, &ahead.y, self.masses.len());
        let (changed, h) = (ahead.event.is_some(), ahead.h);
        self.motion.take(ahead);
        let beads = self.masses.len();
        let gaps = self.motion.y[..beads].iter().copied();
        self.state.books.measure(gaps);
        self.now.add(h);
        let tick = self.motion.ground.tick();
        while self.now.total() >= tick {
            self.now.add(-tick);
            self.ticks += 1.0;
            self.motion.ground.move_epoch(tick);
        }
        self.unchanged = if changed { 0 } else { self.unchanged + 1 };
        if changed {
            self.settle();
        }
        // Overdamped contacts never open, but lose their energy.
        if !G::PULLS && !self.over && self.state.books.steps.is_multiple_of(INSPECTION) {
            let energy = self.snapshot(&self.motion.y).energy();
            self.over = energy.elastic <= OVER * energy.kinetic
                && nothing_to_come(self.motion.rates().iter().copied(), &self.masses, OVER);
        }
        if !G::PULLS && !self.over && self.unchanged > CREEPING {
            return Err(EngineError::Creeping {
                time: self.reached(),
            });
        }
        self.look_for_progress(h)
    }

    /// An error when very many steps hardly move time on.
    fn look_for_progress(&mut self, step: f64) -> Result<(), EngineError> {
        let time = self.reached();
        let (steps, mark) = &mut self.idle;
        *steps += 1;
        if time - *mark > 1e-3 * self.motion.contact_time {
            self.idle = (0, time);
            return Ok(());
        }
        if *steps > 10_000 + 1000 * self.masses.len() as u64 {
            return Err(EngineError::Stuck { time, step });
        }
        Ok(())
    }
}

/// Books the energy lost and the plate's work that `y` has.
fn enter(ledger: &mut Ledger, y: &[f64], beads: usize) {
    if let [lost, work] = y[2 * beads..] {
        ledger.lost.add(lost);
        ledger.plate_work.add(work);
    }
}

impl<G: Ground + 'static> Engine for Adaptive<G> {
    fn time(&self) -> f64 {
        match &self.midstep {
            Some(midstep) => midstep.time,
            None => self.reached(),
        }
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let mut left = budget;
        while self.time() < until {
            if self.ahead.is_none() {
                if left == 0 {
                    return Ok(Outcome::OutOfBudget);
                }
                left -= 1;
                let ahead = self.motion.look_ahead(self.now.total());
                self.ahead = Some(ahead.map_err(|step| EngineError::Stuck {
                    time: self.reached(),
                    step,
                })?);
            }
            let end = self.now.total() + self.ahead.as_ref().map_or(0.0, |ahead| ahead.h);
            if self.absolute(end) <= until {
                if let Some(ahead) = self.ahead.take() {
                    self.take(ahead)?;
                }
            } else {
                let flight = self.ahead.as_ref().is_some_and(|ahead| ahead.flight);
                let tau = until - self.reached();
                let y = self.motion.glimpse(self.now.total(), tau, flight);
                let t = self.now.total() + tau;
                self.midstep = Some(Midstep { time: until, t, y });
                break;
            }
        }
        Ok(if self.over {
            Outcome::Over
        } else {
            Outcome::Reached
        })
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn next_event(&self) -> Option<f64> {
        let ahead = self.ahead.as_ref()?;
        ahead.event?;
        Some(self.absolute(self.now.total() + ahead.h))
    }

    fn observe(&self, into: &mut Observation) {
        self.snapshot(self.seen().1)
            .observe(&self.state.books, self.ledger(), into);
    }

    fn state(&self) -> State {
        let books = Books {
            ledger: self.ledger(),
            ..self.state.books.clone()
        };
        self.snapshot(self.seen().1).state(books)
    }
}
