//! A soft column on a grid of steps, as an engine.

use super::SoftColumn;
use super::chain::Chain;
use super::ground::Ground;
use super::stepper::{Power, Stepper};
use crate::physics::grid::{Grid, Settings};
use crate::physics::ledger::Ledger;
use crate::physics::observation::Observation;
use crate::physics::snapshot::Snapshot;
use crate::physics::spring::Spring;
use crate::physics::state::{Books, State, weight};
use crate::physics::{Engine, EngineError, Outcome};
use crate::scene::Scene;

/// A soft column on a grid of steps.
pub(super) struct Md<S, G, C> {
    pub(super) stepper: S,
    /// Since the last look at the numbers.
    pub(super) power: Power,
    pub(super) ground: G,
    pub(super) chain: C,
    pub(super) masses: Vec<f64>,
    pub(super) springs: Vec<Spring>,
    pub(super) gravity: f64,
    pub(super) steps_per_contact: f64,
    /// Energy in which the column would fall by a diameter, m²/s².
    pub(super) least_energy: f64,
    pub(super) grid: Grid,
    pub(super) state: State,
    pub(super) over: bool,
}

impl<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static> Md<S, G, C> {
    pub(super) fn boxed(
        scene: &Scene,
        settings: Settings,
        state: State,
        column: SoftColumn<G>,
        chain: C,
    ) -> Box<dyn Engine> {
        let SoftColumn {
            mut ground,
            masses,
            springs,
        } = column;
        let h = settings.step();
        ground.set_step(h);
        let mut md = Self {
            stepper: S::start(&state.gaps, &state.rates, h, &chain, &ground),
            power: Power::default(),
            gravity: weight(scene),
            least_energy: weight(scene) * scene.diameter * masses.iter().sum::<f64>(),
            grid: Grid::new(state.time, h),
            over: false,
            ground,
            chain,
            masses,
            springs,
            steps_per_contact: settings.steps_per_contact,
            state,
        };
        md.note_contacts();
        let (gaps, rates) = (md.gaps(), md.rates());
        if md.state.books.contacts.closed()[0] {
            let arrival = md.snapshot(&gaps, &rates).arrival();
            md.state.books.bounce.begin(arrival);
        }
        let energy = md.snapshot(&gaps, &rates).energy();
        let error = md.state.ledger_error;
        md.state.books.ledger.open(energy, error);
        Box::new(md)
    }

    pub(super) fn snapshot<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64]) -> Snapshot<'a> {
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: self.ground.plate(),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.springs,
        }
    }

    /// Does up to `steps` steps, to where contacts change; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let (mut done, mut changed) = (0, false);
        while done < steps && !changed {
            changed = self
                .stepper
                .step(&self.chain, &mut self.ground, &mut self.power);
            done += 1;
        }
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
        self.stepper.rates(&self.chain, &self.ground)
    }

    /// The gaps now, those of a flight included.
    pub(super) fn gaps(&self) -> Vec<f64> {
        let gaps = self.stepper.gaps();
        let Some(flown) = self.grid.flown() else {
            return gaps.collect();
        };
        gaps.zip(self.rates()).map(|(g, w)| g + flown * w).collect()
    }

    /// What is accounted for, up to now.
    pub(super) fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        fold(&mut ledger, &self.power, self.grid.h);
        ledger
    }

    /// Steps done.
    fn steps(&self) -> u64 {
        self.state.books.steps + self.grid.steps()
    }
}

pub(super) fn fold(ledger: &mut Ledger, power: &Power, h: f64) {
    ledger.lost.add(power.all_lost() * h);
    ledger.plate_work.add(power.plate * h);
}

impl<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static> Engine for Md<S, G, C> {
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
