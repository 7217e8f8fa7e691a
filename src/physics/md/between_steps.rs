//! What is done between the steps of a soft column: flights are passed through, and the ledger
//! is inspected.

use super::engine::Md;
use crate::physics::EngineError;
use crate::physics::column::{OVER, nothing_to_come};
use crate::physics::flight::closing;
use crate::physics::shell::Mover;

impl Md {
    pub(super) fn nothing_to_come(&self) -> bool {
        nothing_to_come(self.walker.rates().into_iter(), &self.column.masses, OVER)
    }

    /// Goes on in one flight to just before the next contact, if nothing pulls and no
    /// contact has been closed since the last look. The row has the gaps of now.
    pub(super) fn look_for_flight(&mut self) -> Result<(), EngineError> {
        let contacts = &self.books.contacts;
        if self.walker.pulls() || !contacts.all_open() || !self.grid.is_settled(contacts.last()) {
            return Ok(());
        }
        let rates = self.walker.rates();
        let gaps = self.row.iter().zip(&rates);
        let next = gaps
            .map(|(&g, &w)| closing(0.0, g, w))
            .fold(f64::INFINITY, f64::min);
        self.grid.take_off(next, self.books.over)
    }

    /// Passes through a flight, up to grid point `last` at most.
    pub(super) fn fly(&mut self, last: u64) {
        if let Some(steps) = self.grid.fly(last) {
            self.walker.coast(steps);
        }
    }

    /// Every so often, whatever the slices a run is advanced in.
    pub(super) fn housekeeping(&mut self) -> Result<(), EngineError> {
        let power = self.walker.take_power();
        power.account(&mut self.books.ledger, self.grid.h);
        self.walker.clear();
        self.walker.gaps(&mut self.row);
        self.look_for_flight()?;
        let sound = self.row.iter().sum::<f64>().is_finite();
        self.books.measure(self.row.iter().copied());
        if sound && !self.grid.is_inspected() {
            return Ok(());
        }
        if !sound || self.lost_the_energy() {
            return Err(self.unstable());
        }
        // An overdamped contact of a heavy pair never opens. The collision is over when such
        // contacts have spent their energy.
        if !self.walker.pulls() && !self.books.over {
            let energy = self.energy_now();
            self.books.over = energy.elastic <= OVER * energy.kinetic && self.nothing_to_come();
        }
        Ok(())
    }

    /// Whether the ledger shows that the integration blows up.
    pub(super) fn lost_the_energy(&self) -> bool {
        self.ledger()
            .is_broken(self.energy_now(), self.least_energy)
    }
}
