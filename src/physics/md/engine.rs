//! A soft column on a grid of steps, as an engine.

use super::SoftColumn;
use super::chain::Chain;
use super::ground::Ground;
use super::mover::{Moved, Mover};
use super::stepper::Stepper;
use crate::physics::grid::{Grid, Settings};
use crate::physics::ledger::Ledger;
use crate::physics::observation::Observation;
use crate::physics::snapshot::Snapshot;
use crate::physics::spring::Spring;
use crate::physics::state::{Books, State, weight};
use crate::physics::{Engine, EngineError, Outcome};
use crate::scene::Scene;

/// A soft column on a grid of steps. What moves it is known when the program is compiled,
/// and asked for many steps at a time; all else stands here once.
#[derive(Clone)]
pub(super) struct Md {
    pub(super) mover: Box<dyn Mover>,
    pub(super) masses: Vec<f64>,
    pub(super) springs: Vec<Spring>,
    pub(super) gravity: f64,
    pub(super) steps_per_contact: f64,
    /// Energy in which the column would fall by a diameter, m²/s².
    pub(super) least_energy: f64,
    pub(super) grid: Grid,
    pub(super) state: State,
    pub(super) over: bool,
    /// Room for the gaps of a moment.
    pub(super) row: Vec<f64>,
}

impl Md {
    pub(super) fn boxed<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static>(
        scene: &Scene,
        settings: Settings,
        state: State,
        column: SoftColumn<G>,
        mut chain: C,
    ) -> Box<dyn Engine> {
        let SoftColumn {
            mut ground,
            masses,
            springs,
        } = column;
        let h = settings.step();
        ground.set_step(h);
        let stepper = S::start(&state.gaps, &state.rates, h, &mut chain, &ground);
        let mut md = Self {
            mover: Box::new(Moved::new(stepper, ground, chain)),
            gravity: weight(scene),
            least_energy: weight(scene) * scene.diameter * masses.iter().sum::<f64>(),
            grid: Grid::new(state.time, h),
            over: false,
            masses,
            springs,
            steps_per_contact: settings.steps_per_contact,
            state,
            row: Vec::new(),
        };
        md.open();
        Box::new(md)
    }

    /// Finds the contacts and opens the ledger.
    fn open(&mut self) {
        self.note_contacts();
        let (gaps, rates) = (self.gaps(), self.rates());
        if self.state.books.contacts.closed()[0] {
            let arrival = self.snapshot(&gaps, &rates).arrival();
            self.state.books.bounce.begin(arrival);
        }
        let energy = self.snapshot(&gaps, &rates).energy();
        let error = self.state.ledger_error;
        self.state.books.ledger.open(energy, error);
    }

    pub(super) fn snapshot<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64]) -> Snapshot<'a> {
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: self.mover.plate(),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.springs,
        }
    }

    /// Does up to `steps` steps, to where contacts change; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let (done, changed) = self.mover.run(steps);
        self.grid.stepped(done);
        if changed {
            self.note_contacts();
            if self.over && self.lost_the_energy() {
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

    pub(super) fn rates(&self) -> Vec<f64> {
        self.mover.rates()
    }

    /// The gaps now, those of a flight included.
    pub(super) fn gaps(&self) -> Vec<f64> {
        let mut gaps = Vec::new();
        self.mover.gaps(&mut gaps);
        if let Some(flown) = self.grid.flown() {
            for (g, w) in gaps.iter_mut().zip(self.rates()) {
                *g += flown * w;
            }
        }
        gaps
    }

    /// What is accounted for, up to now.
    pub(super) fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        self.mover.power().account(&mut ledger, self.grid.h);
        ledger
    }

    /// Steps done.
    fn steps(&self) -> u64 {
        self.state.books.steps + self.grid.steps()
    }
}

impl Engine for Md {
    fn time(&self) -> f64 {
        self.grid.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
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
                return Ok(self.grid.outcome(target, self.over));
            }
            left -= self.run(steps)?;
        }
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn next_event(&self) -> Option<f64> {
        None
    }

    fn observe(&self, into: &mut Observation) {
        self.snapshot(&self.gaps(), &self.rates())
            .observe(&self.state.books, self.ledger(), into);
        into.steps = self.steps();
    }

    fn state(&self) -> State {
        let books = Books {
            ledger: self.ledger(),
            steps: self.steps(),
            ..self.state.books.clone()
        };
        self.snapshot(&self.gaps(), &self.rates()).state(books)
    }
}
