//! What is done between the steps of a soft column: contacts are noted, flights are passed
//! through, and the ledger is inspected.

use super::engine::Md;
use crate::physics::column::{OVER, nothing_to_come};
use crate::physics::flight::closing;
use crate::physics::{Engine, EngineError};

impl Md {
    /// Looks which contacts began or ended in the last step.
    pub(super) fn note_contacts(&mut self) {
        let time = self.time();
        let floor_was_closed = self.state.books.contacts.closed()[0];
        self.mover.gaps(&mut self.row);
        for (i, &g) in self.row.iter().enumerate() {
            self.state.books.contacts.note(i, g <= 0.0, time);
        }
        self.state.books.measure(self.row.iter().copied());
        let floor_is_closed = self.state.books.contacts.closed()[0];
        if floor_is_closed != floor_was_closed {
            let (gaps, rates) = (self.gaps(), self.rates());
            let arrival = self.snapshot(&gaps, &rates).arrival();
            self.state.books.bounce.turn(floor_is_closed, arrival);
        }
        if !self.mover.pulls() && !self.over && self.state.books.contacts.all_open() {
            self.over = self.nothing_to_come();
        }
    }

    pub(super) fn nothing_to_come(&self) -> bool {
        nothing_to_come(self.rates().into_iter(), &self.masses, OVER)
    }

    /// Goes on in one flight to just before the next contact, if nothing pulls and no
    /// contact has been closed since the last look. The row has the gaps of now.
    pub(super) fn look_for_flight(&mut self) -> Result<(), EngineError> {
        let contacts = &self.state.books.contacts;
        if self.mover.pulls() || !contacts.all_open() || !self.grid.is_settled(contacts.last()) {
            return Ok(());
        }
        let rates = self.rates();
        let gaps = self.row.iter().zip(&rates);
        let next = gaps
            .map(|(&g, &w)| closing(0.0, g, w))
            .fold(f64::INFINITY, f64::min);
        self.grid.take_off(next, self.over)
    }

    /// Passes through a flight, up to grid point `last` at most.
    pub(super) fn fly(&mut self, last: u64) {
        if let Some(steps) = self.grid.fly(last) {
            self.mover.coast(steps);
        }
    }

    /// Every so often, whatever the slices a run is advanced in.
    pub(super) fn housekeeping(&mut self) -> Result<(), EngineError> {
        let power = self.mover.take_power();
        power.account(&mut self.state.books.ledger, self.grid.h);
        self.mover.clear();
        self.mover.gaps(&mut self.row);
        self.look_for_flight()?;
        let sound = self.row.iter().sum::<f64>().is_finite();
        self.state.books.measure(self.row.iter().copied());
        if sound && !self.grid.is_inspected() {
            return Ok(());
        }
        if !sound || self.lost_the_energy() {
            return Err(self.unstable());
        }
        // An overdamped contact of a heavy pair never opens. The collision is over when such
        // contacts have spent their energy.
        if !self.mover.pulls() && !self.over {
            let energy = self.snapshot(&self.gaps(), &self.rates()).energy();
            self.over = energy.elastic <= OVER * energy.kinetic && self.nothing_to_come();
        }
        Ok(())
    }

    /// Whether the ledger shows that the integration blows up.
    pub(super) fn lost_the_energy(&self) -> bool {
        let energy = self.snapshot(&self.gaps(), &self.rates()).energy();
        self.ledger().is_broken(energy, self.least_energy)
    }
}
