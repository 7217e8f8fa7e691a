//! Soft contacts under a power law, to a tolerance.
//!
//! While a contact is closed the column is integrated by extrapolation, with an error
//! norm relative to the motion of each contact; no step reaches over the beginning or
//! the end of a contact, where the force is not smooth. Without contacts the beads fly
//! in closed form. Steps do not depend on the times that are asked for: one that is
//! asked for within a step is reached by another, shorter one, which then is forgotten.

mod chain;
mod crossing;
mod extrapolation;
mod stride;

use super::column::{OVER, masses, nothing_to_come, springs};
use super::flight::{Free, Ground, Shaken, Weight};
use super::ledger::{Ledger, Sum};
use super::moment::Moment;
use super::observation::Observation;
use super::state::{Books, State, weight};
use super::{Engine, EngineError, Outcome};
use crate::scene::{Floor, Scene};
use chain::Chain;
use stride::{Ahead, Motion};

/// Steps between two looks whether creeping contacts have spent all they have.
const INSPECTION: u64 = 64;

/// Steps without any contact that begins or ends after which a column without gravity
/// only creeps: strongly damped contacts under a power law let go ever more slowly and
/// never come to an end.
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

/// The column at a time within the step ahead.
struct View {
    /// Simulated time, s.
    time: f64,
    /// Time since the epoch, s.
    t: f64,
    y: Vec<f64>,
}

/// A column under a power law.
struct Adaptive<G> {
    motion: Motion<G>,
    masses: Vec<f64>,
    gravity: f64,
    /// Time of the first epoch, s, and ticks of the ground since.
    origin: f64,
    ticks: f64,
    /// Time since the epoch, s.
    now: Sum,
    ahead: Option<Ahead>,
    /// A time asked for within the step ahead, and the column then.
    view: Option<View>,
    state: State,
    over: bool,
    /// Steps since time last moved on noticeably, and when that was.
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
        let chain = Chain::new(springs(scene, &masses), &masses, attraction, fall);
        let mut y = state.gaps.clone();
        y.extend(&state.rates);
        y.extend([0.0; 2]);
        let mut adaptive = Self {
            motion: Motion::new(ground, chain, y, tolerance, contact_time),
            gravity: weight(scene),
            origin: state.time,
            ticks: 0.0,
            now: Sum::default(),
            ahead: None,
            view: None,
            over: false,
            idle: (0, state.time),
            unchanged: 0,
            masses,
            state,
        };
        adaptive.settle();
        if adaptive.motion.closed[0] {
            let arrival = adaptive.moment(&adaptive.motion.y).arrival();
            adaptive.state.books.bounce.begin(arrival);
        }
        let energy = adaptive.moment(&adaptive.motion.y).energy();
        let error = adaptive.state.ledger_error;
        adaptive.state.books.ledger.open(energy, error);
        Box::new(adaptive)
    }

    fn beads(&self) -> usize {
        self.masses.len()
    }

    /// The time of the last step's end, s.
    fn reached(&self) -> f64 {
        self.since_epoch(self.now.total())
    }

    fn since_epoch(&self, t: f64) -> f64 {
        let tick = self.motion.ground.tick();
        // An endless tick is never counted.
        let epoch = if self.ticks > 0.0 {
            self.ticks * tick
        } else {
            0.0
        };
        self.origin + (epoch + t)
    }

    /// The column now: its time since the epoch and what it does.
    fn seen(&self) -> (f64, &[f64]) {
        match &self.view {
            Some(view) => (view.t, &view.y),
            None => (self.now.total(), &self.motion.y),
        }
    }

    fn moment<'a>(&'a self, y: &'a [f64]) -> Moment<'a> {
        let (gaps, rest) = y.split_at(self.beads());
        Moment {
            time: self.time(),
            gaps,
            rates: &rest[..self.beads()],
            plate: self.motion.ground.plate(self.seen().0),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.motion.chain.springs,
        }
    }

    /// What is accounted for, up to what is seen.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        if let Some(view) = &self.view {
            enter(&mut ledger, &view.y, self.beads());
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
            let arrival = self.moment(&self.motion.y).arrival();
            self.state.books.bounce.turn(!was_closed, arrival);
        }
        if !G::PULLS && !self.over && self.state.books.contacts.all_open() {
            self.over = nothing_to_come(self.motion.rates().iter().copied(), &self.masses, OVER);
        }
    }

    /// Takes the step ahead.
    fn take(&mut self, ahead: Ahead) -> Result<(), EngineError> {
        self.view = None;
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
        // Overdamped contacts never open, but spend all they have.
        if !G::PULLS && !self.over && self.state.books.steps.is_multiple_of(INSPECTION) {
            let energy = self.moment(&self.motion.y).energy();
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

    /// An error when very many steps bring nothing.
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

/// Enters what `y` has of energy lost and of the plate's work.
fn enter(ledger: &mut Ledger, y: &[f64], beads: usize) {
    if let [lost, work] = y[2 * beads..] {
        ledger.lost.add(lost);
        ledger.plate_work.add(work);
    }
}

impl<G: Ground + 'static> Engine for Adaptive<G> {
    fn time(&self) -> f64 {
        match &self.view {
            Some(view) => view.time,
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
            if self.since_epoch(end) <= until {
                if let Some(ahead) = self.ahead.take() {
                    self.take(ahead)?;
                }
            } else {
                let flight = self.ahead.as_ref().is_some_and(|ahead| ahead.flight);
                let tau = until - self.reached();
                let y = self.motion.glimpse(self.now.total(), tau, flight);
                let t = self.now.total() + tau;
                self.view = Some(View { time: until, t, y });
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
        Some(self.since_epoch(self.now.total() + ahead.h))
    }

    fn observe(&self, into: &mut Observation) {
        self.moment(self.seen().1)
            .observe(&self.state.books, self.ledger(), into);
    }

    fn state(&self) -> State {
        let books = Books {
            ledger: self.ledger(),
            ..self.state.books.clone()
        };
        self.moment(self.seen().1).state(books)
    }
}
