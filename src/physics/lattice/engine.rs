//! A lattice on a grid of steps, as an engine.

use std::collections::BTreeMap;

use super::Plane;
use super::mover::PlaneMover;
use super::view::View;
use crate::physics::grid::Grid;
use crate::physics::ledger::Ledger;
use crate::physics::observation::Observation;
use crate::physics::state::{Books, Depth, State};
use crate::physics::{Engine, EngineError, Outcome};

/// A lattice on a grid of steps. What moves it is known when the program is compiled, and
/// asked for many steps at a time; all else stands here once.
#[derive(Clone)]
pub(super) struct Lattice {
    pub(super) mover: Box<dyn PlaneMover>,
    pub(super) plane: Plane,
    pub(super) grid: Grid,
    pub(super) state: State,
    /// Which contact of the log a pair has.
    pub(super) slots: BTreeMap<[u32; 2], usize>,
    /// Energy of a contact below which it does not count any more, m²/s².
    pub(super) quiet: f64,
    /// When a contact last counted, s.
    pub(super) busy: f64,
    pub(super) over: bool,
    /// Rates now, where they are wanted one by one.
    pub(super) rates: Vec<f64>,
    /// Room for the bonds that began or ended in the last step.
    pub(super) turned: Vec<usize>,
}

impl Lattice {
    /// Opens the books of a lattice in that state, which `mover` has begun to move from these
    /// rates.
    pub(super) fn new(
        plane: Plane,
        state: State,
        mover: Box<dyn PlaneMover>,
        rates: Vec<f64>,
    ) -> Self {
        let h = plane.settings.step();
        let slots = (1..).zip(&state.bonds).map(|(slot, bond)| (*bond, slot));
        let mut lattice = Self {
            mover,
            plane,
            grid: Grid::new(state.time, h),
            slots: slots.collect(),
            quiet: 0.0,
            busy: state.time,
            over: false,
            rates,
            turned: Vec::new(),
            state,
        };
        lattice.set_quiet();
        lattice.note_contacts();
        let places = lattice.mover.places();
        if lattice.state.books.contacts.closed()[0] {
            let arrival = lattice.view(places, &lattice.rates).arrival();
            lattice.state.books.bounce.begin(arrival);
        }
        let places = lattice.mover.places();
        let energy = lattice.view(places, &lattice.rates).energy();
        let error = lattice.state.ledger_error;
        lattice.state.books.ledger.open(energy, error);
        lattice
    }

    pub(super) fn view<'a>(&'a self, places: &'a [f64], rates: &'a [f64]) -> View<'a> {
        View {
            time: self.grid.time(),
            places,
            rates,
            sites: &self.mover.web().sites,
            list: &self.mover.web().list,
            springs: (self.plane.floor, self.plane.pair),
        }
    }

    /// Does up to `steps` steps, to where contacts change; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let (done, changed) = self.mover.run(steps);
        self.grid.stepped(done);
        if changed {
            self.take_rates();
            self.note_contacts();
        }
        if self.grid.is_due() {
            self.housekeeping()?;
        }
        Ok(done)
    }

    pub(super) fn take_rates(&mut self) {
        self.mover.rates(&mut self.rates);
    }

    /// Displacements and rates now, those of a flight included.
    pub(super) fn now(&self) -> (Vec<f64>, Vec<f64>) {
        let mut places = self.mover.places().to_vec();
        let mut rates = Vec::new();
        self.mover.rates(&mut rates);
        if let Some(flown) = self.grid.flown() {
            for (place, rate) in places.iter_mut().zip(&rates) {
                *place += rate * flown;
            }
        }
        (places, rates)
    }

    /// What is accounted for, up to now.
    pub(super) fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        ledger.lost.add(self.mover.web().lost * self.grid.h);
        ledger
    }

    /// Steps done.
    fn steps(&self) -> u64 {
        self.state.books.steps + self.grid.steps()
    }
}

impl Engine for Lattice {
    fn time(&self) -> f64 {
        self.grid.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let target = self.grid.last_step(until);
        let mut left = budget;
        loop {
            self.fly(target)?;
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
        let (places, rates) = self.now();
        let view = self.view(&places, &rates);
        view.observe(&self.state.books, self.ledger(), into);
        into.steps = self.steps();
    }

    fn state(&self) -> State {
        let (places, rates) = self.now();
        let books = Books {
            ledger: self.ledger(),
            steps: self.steps(),
            ..self.state.books.clone()
        };
        let energy = self.view(&places, &rates).energy();
        State {
            time: self.time(),
            ledger_error: books.ledger.error(energy),
            closing: Depth::default(),
            gaps: places,
            rates,
            plate: self.state.plate,
            course: self.state.course.clone(),
            settled: self.state.settled,
            springs: vec![self.plane.floor, self.plane.pair],
            bonds: self.state.bonds.clone(),
            books,
        }
    }
}
