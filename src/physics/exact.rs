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

use super::flight::Gap;
use super::ground::{Ground, OverGround};
use super::ledger::{Ledger, Sum};
use super::matter::{BeadColumn, Snapshot};
use super::observation::{Energy, Observation};
use super::plate::Plate;
use super::shell::{Mover, Shell};
use super::state::{Books, State};
use super::tournament::Tournament;
use super::{Engine, EngineError};
use crate::scene::Scene;
use centre_of_mass::Centre;
use clock::EpochClock;
use cluster::Clusters;
use constants::Constants;
use over::CollisionEnd;
use plan::{Flight, Plan, Stacks};
use workspace::{PADDING, Workspace};

/// Events and closed forms, for scenes of linear contacts with the exact solver.
pub(super) struct LinearEvents;

impl OverGround for LinearEvents {
    fn over<G: Ground>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine> {
        let (Some(soft), Some(contact_time)) = (scene.soft(), scene.contact_time()) else {
            unreachable!("physics::build hands scenes of soft contacts to this room");
        };
        let n = scene.n;
        let clock = EpochClock::new(state.time, contact_time);
        let gap = |(&g, &w): (&f64, &f64)| Gap { g, w, t: 0.0 };
        let exact = Exact {
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
            start: state.plate,
            books: state.books,
        };
        Shell::boxed(exact)
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
    /// The plate at the start.
    start: Plate,
    books: Books,
}

impl<G: Ground> Exact<G> {
    /// What a gap does by its place and rate. Beads that just touch are in contact.
    fn mode_of(&self, i: usize) -> ContactMode {
        let Gap { g, w, .. } = self.gaps[i];
        let spring = self.constants.column.springs[i];
        let pushing = spring.stiffness * g + spring.dashpot * w <= 0.0;
        if g > 0.0 {
            ContactMode::Open
        } else if self.constants.attraction || pushing {
            ContactMode::Pushing
        } else {
            ContactMode::Idle
        }
    }

    /// The column now, at these gaps and rates.
    fn snapshot(&self, gaps: Vec<f64>, rates: Vec<f64>) -> Snapshot {
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: self.ground.plate(self.clock.now),
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
            .set_plate(self.start.later(self.clock.epoch.passed()));
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
            time: self.clock.epoch.absolute(t),
            bead: i + 1,
            what,
        })
    }
}

impl<G: Ground> Mover for Exact<G> {
    type Matter = BeadColumn;

    fn time(&self) -> f64 {
        self.clock.epoch.absolute(self.clock.now)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError> {
        let mut left = budget;
        loop {
            let (i, t) = self.queue.first();
            // As `next_event` says it, so that advancing to there includes the event.
            if self.clock.epoch.absolute(t) > until || t.is_infinite() {
                // Not past the next event, which rounding could do.
                let end = self.clock.epoch.since(until).min(t);
                self.clock.now = self.clock.now.max(end);
                self.books.over |= !G::PULLS && t.is_infinite();
                return Ok(true);
            }
            if left == 0 {
                return Ok(false);
            }
            left -= 1;
            // An advance to between two events may have moved `now`, but never past this one.
            self.clock.now = self.clock.now.max(t);
            self.carry_out(i, self.clock.now)?;
            self.look_whether_over();
            self.move_epoch();
        }
    }

    fn next_event(&self) -> Option<f64> {
        let (_, t) = self.queue.first();
        t.is_finite().then(|| self.clock.epoch.absolute(t))
    }

    fn note_contacts(&mut self) {
        let time = self.time();
        for i in 0..self.gaps.len() {
            self.modes[i] = self.mode_of(i);
            let closed = self.modes[i] != ContactMode::Open;
            self.books.contacts.note(i, closed, time);
        }
    }

    fn begin(&mut self, energy: Energy) {
        self.end.energy_at_first = energy.kinetic + energy.elastic;
        self.regroup(0, self.gaps.len(), 0.0);
        self.centre = self.weighed(Sum::default());
    }

    fn books(&self) -> &Books {
        &self.books
    }

    fn books_mut(&mut self) -> &mut Books {
        &mut self.books
    }

    /// With what the plans have lost so far.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.books.ledger;
        let mut work = Workspace::new(self.gaps.len());
        for low in self.clusters.starts() {
            let (plan, cluster) = (self.plans[low].of_cluster(), self.cluster(low));
            plan.account(&cluster, self.clock.now, &mut ledger, &mut work);
        }
        ledger
    }

    fn now(&self) -> Snapshot {
        let n = self.gaps.len();
        let row = || vec![0.0; n + PADDING];
        let (mut gaps, mut rates) = (row(), row());
        self.all_at(self.clock.now, &mut gaps, &mut rates);
        gaps.truncate(n);
        rates.truncate(n);
        self.snapshot(gaps, rates)
    }

    fn matter(&self) -> &BeadColumn {
        &self.constants.column
    }

    fn fill_in(&self, into: &mut Observation) {
        into.integrals = self.integrals();
        // A stack that rests is looked at between its plans only here.
        into.deepest = into.gaps.iter().fold(into.deepest, |most, g| most.max(-g));
    }
}
