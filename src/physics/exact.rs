//! Soft contacts with linear forces, exact to rounding.
//!
//! Between contact changes such a column is a linear system. It is propagated as one, and
//! the contact changes are located.
//!
//! Every gap keeps its value and rate at a time of its own, as in the event-driven engine.
//! Gaps that forces couple form clusters: contacts, and the gaps beside them. Clusters move
//! independently, each by a [`Plan`] up to its next contact change. Gaps outside of clusters
//! fly, and cost nothing until they close.

mod centre_of_mass;
mod clock;
mod cluster;
mod constants;
mod contact_changes;
mod grouping;
mod oscillator;
mod over;
mod pair_events;
mod plan;
mod polynomial;
mod propagation;
mod stack;
mod taylor;
mod workspace;

use super::flight::{Free, Gap, Ground, Shaken, Weight};
use super::ledger::Sum;
use super::observation::Observation;
use super::snapshot::Snapshot;
use super::state::{Books, State};
use super::tournament::Tournament;
use super::{Engine, EngineError, Outcome};
use crate::scene::{Floor, Scene};
use centre_of_mass::Centre;
use clock::EpochClock;
use cluster::Clusters;
use constants::Constants;
use over::CollisionEnd;
use plan::{Flight, Plan, Stacks};
use workspace::Workspace;

/// Builds the engine of a scene with the exact solver.
pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let plate = state.plate;
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), plate);
            Box::new(Exact::new(scene, state, ground))
        }
        (Floor::Fixed, Some(gravity)) => {
            let ground = Weight::new(gravity, plate, scene.diameter);
            Box::new(Exact::new(scene, state, ground))
        }
        (Floor::Fixed, None) => Box::new(Exact::new(scene, state, Free { plate })),
    }
}

/// What a gap does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum ContactMode {
    /// It is open.
    Open,
    /// It is a contact, and its force acts.
    Pushing,
    /// It is a contact, but its force would be attraction and is cut off.
    Idle,
}

/// A soft column, exactly.
#[derive(Clone)]
struct Exact<G> {
    ground: G,
    constants: Constants,
    clock: EpochClock,
    gaps: Vec<Gap>,
    modes: Vec<ContactMode>,
    clusters: Clusters,
    /// How the cluster that starts at each gap moves; elsewhere it means nothing.
    plans: Vec<Plan>,
    /// When that plan ends, s from the epoch.
    queue: Tournament,
    stacks: Stacks,
    centre: Centre,
    workspace: Workspace,
    end: CollisionEnd,
    state: State,
}

impl<G: Ground> Exact<G> {
    fn new(scene: &Scene, state: State, ground: G) -> Self {
        let (Some(soft), Some(contact_time)) = (scene.soft(), scene.contact_time()) else {
            unreachable!("physics::build hands scenes of soft contacts to this room");
        };
        let n = scene.n;
        let clock = EpochClock::new(state.time, contact_time);
        let gap = |(&g, &w): (&f64, &f64)| Gap { g, w, t: 0.0 };
        let mut exact = Self {
            constants: Constants::new(scene, &state, soft.attraction, clock.tick()),
            clock,
            gaps: state.gaps.iter().zip(&state.rates).map(gap).collect(),
            modes: vec![ContactMode::Open; n],
            clusters: Clusters::alone(n),
            plans: (0..n).map(|_| Plan::Flight(Flight)).collect(),
            queue: Tournament::new(n),
            stacks: Stacks::new(),
            centre: Centre::default(),
            workspace: Workspace::new(n),
            end: CollisionEnd::new(),
            ground,
            state,
        };
        exact.begin();
        exact
    }

    /// Finds the contacts, opens the ledger and plans every cluster.
    fn begin(&mut self) {
        let n = self.gaps.len();
        for i in 0..n {
            self.modes[i] = self.mode_of(i);
            let closed = self.modes[i] != ContactMode::Open;
            self.state.books.contacts.note(i, closed, self.state.time);
        }
        let (gaps, rates) = self.gaps_and_rates(0.0);
        if self.modes[0] != ContactMode::Open {
            let arrival = self.snapshot(&gaps, &rates, 0.0).arrival();
            self.state.books.bounce.begin(arrival);
        }
        let energy = self.snapshot(&gaps, &rates, 0.0).energy();
        self.end.energy_at_first = energy.kinetic + energy.elastic;
        let error = self.state.ledger_error;
        self.state.books.ledger.open(energy, error);
        self.regroup(0, n, 0.0);
        self.centre = self.weighed(Sum::default());
    }

    /// What a gap does by its place and rate. Beads that just touch are in contact.
    fn mode_of(&self, i: usize) -> ContactMode {
        let Gap { g, w, .. } = self.gaps[i];
        let spring = self.constants.springs[i];
        let pushing = spring.stiffness * g + spring.dashpot * w <= 0.0;
        if g > 0.0 {
            ContactMode::Open
        } else if self.constants.attraction || pushing {
            ContactMode::Pushing
        } else {
            ContactMode::Idle
        }
    }

    fn snapshot<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64], t: f64) -> Snapshot<'a> {
        Snapshot {
            time: self.clock.absolute(t),
            gaps,
            rates,
            plate: self.ground.plate(t),
            masses: &self.constants.masses,
            gravity: self.constants.gravity,
            springs: &self.constants.springs,
        }
    }

    /// Moves the epoch after now when it is due, so that times keep their digits.
    fn move_epoch(&mut self) {
        let Some(shift) = self.clock.move_epoch(self.gaps.len()) else {
            return;
        };
        for gap in &mut self.gaps {
            gap.t -= shift;
        }
        self.queue.shift(shift);
        self.ground
            .set_plate(self.state.plate.later(self.clock.epoch()));
        self.shift_centre(shift);
    }

    /// Carries out the plan of the cluster that starts at `i`, which ends at `t`.
    fn carry_out(&mut self, i: usize, t: f64) -> Result<(), EngineError> {
        self.clock.count_event(t - self.gaps[i].t);
        let done = match self.plans[i] {
            Plan::Flight(_) => self.pair_meets(i, t),
            Plan::Collision(collision) => self.pair_parts(i, collision, t),
            _ => false,
        };
        if done {
            return Ok(());
        }
        let end = self.clusters.end(i);
        if let Some((gap, mode)) = self.finish(i, t) {
            self.change(gap, mode, t);
        }
        let what = if !self.gaps[i].w.is_finite() {
            "a relative velocity is not finite"
        } else if self.clock.stands_still(self.gaps.len()) {
            "contacts open and close without end at one instant"
        } else {
            self.regroup(i, end, t);
            return Ok(());
        };
        Err(EngineError::Lost {
            time: self.clock.absolute(t),
            bead: i + 1,
            what,
        })
    }
}

impl<G: Ground + 'static> Engine for Exact<G> {
    fn time(&self) -> f64 {
        self.clock.absolute(self.clock.now)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let mut left = budget;
        loop {
            let (i, t) = self.queue.first();
            // As `next_event` says it, so that advancing to there includes the event.
            if self.clock.absolute(t) > until || t.is_infinite() {
                // Not past the next event, which rounding could do.
                let end = self.clock.since_epoch(until).min(t);
                self.clock.now = self.clock.now.max(end);
                self.end.over |= !G::PULLS && t.is_infinite();
                return Ok(if self.end.over {
                    Outcome::Over
                } else {
                    Outcome::Reached
                });
            }
            if left == 0 {
                return Ok(Outcome::OutOfBudget);
            }
            left -= 1;
            // An advance to between two events may have moved `now`, but never past this one.
            self.clock.now = self.clock.now.max(t);
            self.carry_out(i, self.clock.now)?;
            self.look_whether_over();
            self.move_epoch();
        }
    }

    fn is_over(&self) -> bool {
        self.end.over
    }

    fn next_event(&self) -> Option<f64> {
        let (_, t) = self.queue.first();
        t.is_finite().then(|| self.clock.absolute(t))
    }

    fn observe(&self, into: &mut Observation) {
        let (gaps, rates) = self.gaps_and_rates(self.clock.now);
        self.snapshot(&gaps, &rates, self.clock.now).observe(
            &self.state.books,
            self.ledger(),
            into,
        );
        into.integrals = self.integrals();
        // A stack that rests is looked at between its plans only here.
        into.deepest = gaps.iter().fold(into.deepest, |most, g| most.max(-g));
    }

    fn state(&self) -> State {
        let (gaps, rates) = self.gaps_and_rates(self.clock.now);
        let books = Books {
            ledger: self.ledger(),
            ..self.state.books.clone()
        };
        self.snapshot(&gaps, &rates, self.clock.now).state(books)
    }
}
