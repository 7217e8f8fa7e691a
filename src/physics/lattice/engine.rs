//! What moves a lattice on a grid of steps.

use std::collections::BTreeMap;

use super::Plane;
use super::walker::PlaneWalker;
use crate::physics::grid::Grid;
use crate::physics::ledger::Ledger;
use crate::physics::matter::Snapshot;
use crate::physics::plate::Plate;
use crate::physics::shell::{Mover, Shell};
use crate::physics::state::{Books, State};
use crate::physics::{Engine, EngineError};

/// A lattice on a grid of steps. What takes them is known when the program is compiled, and
/// asked for many at a time; all else stands here once.
#[derive(Clone)]
pub(super) struct Lattice {
    pub(super) walker: Box<dyn PlaneWalker>,
    pub(super) plane: Plane,
    pub(super) grid: Grid,
    pub(super) books: Books,
    /// The pairs whose contacts the log has, after the floor's.
    pub(super) bonds: Vec<[u32; 2]>,
    /// Which contact of the log a pair has.
    pub(super) slots: BTreeMap<[u32; 2], usize>,
    /// Energy of a contact below which it does not count any more, m²/s².
    pub(super) quiet: f64,
    /// When a contact last counted, s.
    pub(super) busy: f64,
    /// Rates now, where they are wanted one by one.
    pub(super) rates: Vec<f64>,
    /// Room for the bonds that began or ended in the last step.
    pub(super) turned: Vec<usize>,
}

impl Lattice {
    /// A lattice in that state, which `walker` has begun to move from these rates.
    pub(super) fn boxed(
        plane: Plane,
        state: State,
        walker: Box<dyn PlaneWalker>,
        rates: Vec<f64>,
    ) -> Box<dyn Engine> {
        let h = plane.settings.step();
        let slots = (1..).zip(&state.bonds).map(|(slot, bond)| (*bond, slot));
        let mut lattice = Self {
            walker,
            plane,
            grid: Grid::new(state.time, h),
            slots: slots.collect(),
            quiet: 0.0,
            busy: state.time,
            rates,
            turned: Vec::new(),
            bonds: state.bonds,
            books: state.books,
        };
        lattice.set_quiet();
        Shell::boxed(lattice)
    }

    /// Does up to `steps` steps, to where contacts change; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let (done, changed) = self.walker.run(steps);
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
        self.walker.rates(&mut self.rates);
    }

    /// The contact of the log that a pair has.
    fn slot(&mut self, pair: [u32; 2]) -> usize {
        if let Some(&slot) = self.slots.get(&pair) {
            return slot;
        }
        let slot = self.books.contacts.add();
        self.bonds.push(pair);
        self.slots.insert(pair, slot);
        slot
    }
}

impl Mover for Lattice {
    type Matter = Self;

    fn time(&self) -> f64 {
        self.grid.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError> {
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
                return Ok(self.grid.has_come(target));
            }
            left -= self.run(steps)?;
        }
    }

    /// Writes down which contacts began or ended in the last step; the rates are those
    /// of now.
    fn note_contacts(&mut self) {
        let time = self.grid.time();
        let web = self.walker.web_mut();
        let n = web.sites.count();
        let (mut loud, mut on_floor) = (false, false);
        for foot in &mut web.list.feet {
            if foot.noted != foot.closed {
                let w = self.rates[n + foot.i as usize];
                loud |= 0.5 * w * w > self.quiet;
            }
            foot.noted = foot.closed;
            on_floor |= foot.closed;
        }
        self.turned.clear();
        for (k, bond) in web.list.bonds.iter_mut().enumerate() {
            if bond.noted != bond.closed {
                bond.noted = bond.closed;
                self.turned.push(k);
            }
        }
        for at in 0..self.turned.len() {
            let (k, web) = (self.turned[at], self.walker.web());
            let bond = web.list.bonds[k];
            let (_, w) = web.gap(k, self.walker.places(), &self.rates);
            // Half the reduced mass is a quarter.
            loud |= 0.25 * w * w > self.quiet;
            let slot = self.slot([bond.i, bond.j]);
            self.books.contacts.note(slot, bond.closed, time);
        }
        if loud {
            self.busy = time;
        }
        let was_closed = self.books.contacts.closed()[0];
        self.books.contacts.note(0, on_floor, time);
        self.note_bounce(was_closed);
    }

    fn books(&self) -> &Books {
        &self.books
    }

    fn books_mut(&mut self) -> &mut Books {
        &mut self.books
    }

    fn ledger(&self) -> Ledger {
        let mut ledger = self.books.ledger;
        ledger.lost.add(self.walker.web().lost * self.grid.h);
        ledger
    }

    fn steps(&self) -> u64 {
        self.books.steps + self.grid.steps()
    }

    fn now(&self) -> Snapshot {
        let (mut gaps, mut rates) = (self.walker.places().to_vec(), Vec::new());
        self.walker.rates(&mut rates);
        self.grid.fly_on(&mut gaps, &rates);
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: Plate::default(),
        }
    }

    fn matter(&self) -> &Self {
        self
    }
}
