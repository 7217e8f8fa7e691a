//! What moves a soft column on a grid of steps.

use super::chain::Chain;
use super::pace::Pace;
use super::stepper::Stepper;
use super::walker::{Walker, Walking};
use crate::physics::grid::{Grid, Settings};
use crate::physics::ground::Ground;
use crate::physics::ledger::Ledger;
use crate::physics::matter::{BeadColumn, Snapshot};
use crate::physics::shell::{Mover, Shell};
use crate::physics::state::{Books, State};
use crate::physics::{Engine, EngineError};
use crate::scene::Scene;

/// A soft column on a grid of steps. What takes them is known when the program is compiled,
/// and asked for many at a time; all else stands here once.
#[derive(Clone)]
pub(super) struct Md {
    pub(super) walker: Box<dyn Walker>,
    pub(super) column: BeadColumn,
    pub(super) steps_per_contact: f64,
    /// Energy in which the column would fall by a diameter, m²/s².
    pub(super) least_energy: f64,
    pub(super) grid: Grid,
    pub(super) books: Books,
    /// Room for the gaps of a moment.
    pub(super) row: Vec<f64>,
}

impl Md {
    pub(super) fn boxed<S: Stepper + 'static, G: Ground, C: Chain + 'static>(
        scene: &Scene,
        settings: Settings,
        state: State,
        ground: G,
        column: BeadColumn,
        mut chain: C,
    ) -> Box<dyn Engine> {
        let h = settings.step();
        let ground = Pace::new(ground, h);
        let stepper = S::start(&state.gaps, &state.rates, h, &mut chain, &ground);
        let md = Self {
            walker: Box::new(Walking::new(stepper, ground, chain)),
            least_energy: column.gravity * scene.diameter * column.masses.iter().sum::<f64>(),
            grid: Grid::new(state.time, h),
            column,
            steps_per_contact: settings.steps_per_contact,
            books: state.books,
            row: Vec::new(),
        };
        Shell::boxed(md)
    }

    /// Does up to `steps` steps, to where contacts change; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let (done, changed) = self.walker.run(steps);
        self.grid.stepped(done);
        if changed {
            self.note_contacts();
            if self.books.over && self.lost_the_energy() {
                return Err(self.unstable());
            }
        }
        if self.grid.is_due() {
            self.housekeeping()?;
        }
        Ok(done)
    }

    pub(super) fn unstable(&self) -> EngineError {
        EngineError::Unstable {
            time: self.time(),
            steps_per_contact: self.steps_per_contact,
        }
    }
}

impl Mover for Md {
    type Matter = BeadColumn;

    fn time(&self) -> f64 {
        self.grid.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError> {
        let target = self.grid.last_step(until);
        let mut left = budget;
        loop {
            self.fly(target);
            let steps = self.grid.ahead(target, left);
            if steps == 0 {
                // Who looks now must not see what has blown up since the last inspection.
                if self.lost_the_energy() {
                    return Err(self.unstable());
                }
                return Ok(self.grid.has_come(target));
            }
            left -= self.run(steps)?;
        }
    }

    /// Looks which contacts began or ended in the last step.
    fn note_contacts(&mut self) {
        let time = self.time();
        let floor_was_closed = self.books.contacts.closed()[0];
        self.walker.gaps(&mut self.row);
        for (i, &g) in self.row.iter().enumerate() {
            self.books.contacts.note(i, g <= 0.0, time);
        }
        self.books.measure(self.row.iter().copied());
        self.note_bounce(floor_was_closed);
        if !self.walker.pulls() && !self.books.over && self.books.contacts.all_open() {
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
        self.walker.power().account(&mut ledger, self.grid.h);
        ledger
    }

    fn steps(&self) -> u64 {
        self.books.steps + self.grid.steps()
    }

    fn now(&self) -> Snapshot {
        let (mut gaps, rates) = (Vec::new(), self.walker.rates());
        self.walker.gaps(&mut gaps);
        self.grid.fly_on(&mut gaps, &rates);
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: self.walker.plate(),
        }
    }

    fn matter(&self) -> &BeadColumn {
        &self.column
    }
}
