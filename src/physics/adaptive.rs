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

use super::column::{OVER, nothing_to_come};
use super::epoch::Epoch;
use super::ground::{Ground, OverGround};
use super::ledger::{Ledger, Sum};
use super::matter::{BeadColumn, Snapshot};
use super::shell::{Mover, Shell};
use super::state::{Books, State};
use super::{Engine, EngineError};
use crate::scene::{Scene, Solver};
use equations::Equations;
use step::{Ahead, Motion};

/// Steps between two looks whether contacts that never open have spent their energy.
const INSPECTION: u64 = 64;

/// Steps in which no contact begins or ends, after which a column without gravity only creeps.
/// Strongly damped contacts under a power law let go ever more slowly, and never open.
const CREEPING: u64 = 300_000;

/// Steps to a tolerance, for scenes with the adaptive solver.
pub(super) struct AdaptiveSteps;

impl OverGround for AdaptiveSteps {
    fn over<G: Ground>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine> {
        let (Some(soft), Some(contact_time)) = (scene.soft(), scene.contact_time()) else {
            unreachable!("physics::build hands scenes of soft contacts to this room");
        };
        let Solver::Adaptive { tolerance } = soft.solver else {
            unreachable!("and of this solver");
        };
        let equations = Equations::new(BeadColumn::of(scene), soft.attraction, contact_time);
        let mut y = state.gaps;
        y.extend(state.rates);
        y.extend([0.0; 2]);
        let adaptive = Adaptive {
            motion: Motion::new(ground, equations, y, tolerance, contact_time),
            epoch: Epoch::new(state.time),
            now: Sum::default(),
            ahead: None,
            midstep: None,
            idle: (0, state.time),
            unchanged: 0,
            books: state.books,
        };
        Shell::boxed(adaptive)
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
    epoch: Epoch,
    /// End of the last step, s from the epoch.
    now: Sum,
    /// The step that is computed, but not taken yet.
    ahead: Option<Ahead>,
    /// What was last asked for within that step.
    midstep: Option<Midstep>,
    books: Books,
    /// Steps since time last moved on by a part of the contact time, and when that was, s.
    idle: (u64, f64),
    /// Steps since a contact last began or ended.
    unchanged: u64,
}

impl<G: Ground> Adaptive<G> {
    fn beads(&self) -> usize {
        self.motion.equations.len()
    }

    /// The time of the last step's end, s.
    fn reached(&self) -> f64 {
        self.epoch.absolute(self.now.total())
    }

    /// Now, s from the epoch, and the column then.
    fn seen(&self) -> (f64, &[f64]) {
        match &self.midstep {
            Some(midstep) => (midstep.t, &midstep.y),
            None => (self.now.total(), &self.motion.y),
        }
    }

    fn nothing_to_come(&self) -> bool {
        let rates = self.motion.rates().iter().copied();
        nothing_to_come(rates, &self.matter().masses, OVER)
    }

    /// Takes the step ahead.
    fn take(&mut self, ahead: Ahead) -> Result<(), EngineError> {
        self.midstep = None;
        let beads = self.beads();
        self.books.steps += u64::from(!ahead.flight);
        enter(&mut self.books.ledger, &ahead.y, beads);
        let (changed, h) = (ahead.event.is_some(), ahead.h);
        self.motion.take(ahead);
        let gaps = self.motion.y[..beads].iter().copied();
        self.books.measure(gaps);
        self.now.add(h);
        let tick = self.motion.ground.tick();
        while self.now.total() >= tick {
            self.now.add(-tick);
            self.epoch.move_on(tick);
            self.motion.ground.move_epoch(tick);
        }
        self.unchanged = if changed { 0 } else { self.unchanged + 1 };
        if changed {
            self.note_contacts();
        }
        // Overdamped contacts never open, but lose their energy.
        if !G::PULLS && !self.books.over && self.books.steps.is_multiple_of(INSPECTION) {
            let energy = self.energy_now();
            self.books.over = energy.elastic <= OVER * energy.kinetic && self.nothing_to_come();
        }
        if !G::PULLS && !self.books.over && self.unchanged > CREEPING {
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
        if *steps > 10_000 + 1000 * self.motion.equations.len() as u64 {
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

impl<G: Ground> Mover for Adaptive<G> {
    type Matter = BeadColumn;

    fn time(&self) -> f64 {
        match &self.midstep {
            Some(midstep) => midstep.time,
            None => self.reached(),
        }
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError> {
        let mut left = budget;
        while self.time() < until {
            if self.ahead.is_none() {
                if left == 0 {
                    return Ok(false);
                }
                left -= 1;
                let ahead = self.motion.look_ahead(self.now.total());
                self.ahead = Some(ahead.map_err(|step| EngineError::Stuck {
                    time: self.reached(),
                    step,
                })?);
            }
            let end = self.now.total() + self.ahead.as_ref().map_or(0.0, |ahead| ahead.h);
            if self.epoch.absolute(end) <= until {
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
        Ok(true)
    }

    fn next_event(&self) -> Option<f64> {
        let ahead = self.ahead.as_ref()?;
        ahead.event?;
        Some(self.epoch.absolute(self.now.total() + ahead.h))
    }

    fn note_contacts(&mut self) {
        self.motion.settle();
        let time = self.time();
        let was_closed = self.books.contacts.closed()[0];
        for (i, &closed) in self.motion.closed.iter().enumerate() {
            self.books.contacts.note(i, closed, time);
        }
        self.note_bounce(was_closed);
        if !G::PULLS && !self.books.over && self.books.contacts.all_open() {
            self.books.over = self.nothing_to_come();
        }
    }

    fn books(&self) -> &Books {
        &self.books
    }

    fn books_mut(&mut self) -> &mut Books {
        &mut self.books
    }

    fn ledger(&self) -> Ledger {
        let mut ledger = self.books.ledger;
        if let Some(midstep) = &self.midstep {
            enter(&mut ledger, &midstep.y, self.beads());
        }
        ledger
    }

    fn now(&self) -> Snapshot {
        let ((t, y), n) = (self.seen(), self.beads());
        Snapshot {
            time: self.time(),
            gaps: y[..n].to_vec(),
            rates: y[n..2 * n].to_vec(),
            plate: self.motion.ground.plate(t),
        }
    }

    fn matter(&self) -> &BeadColumn {
        &self.motion.equations.column
    }
}
