//! What is done between the steps of a lattice: flights are passed through, its end is looked
//! for, and the ledger is inspected.

use super::engine::Lattice;
use crate::physics::EngineError;
use crate::physics::column::OVER;
use crate::physics::flight::closing;
use crate::physics::shell::Mover;

impl Lattice {
    /// Sets the energy below which a contact does not count: if all beads had such contacts,
    /// they could change less than [`OVER`] of the kinetic energy.
    pub(super) fn set_quiet(&mut self) {
        let kinetic: f64 = self.rates.iter().map(|w| 0.5 * w * w).sum();
        self.quiet = OVER * kinetic / self.walker.web().sites.count() as f64;
    }

    /// Whether a contact that counts is closed; the rates are those of now.
    fn is_loud(&self) -> bool {
        let web = self.walker.web();
        let n = web.sites.count();
        let (places, quiet) = (self.walker.places(), self.quiet);
        let foot_is_loud = web.list.feet.iter().any(|foot| {
            let i = foot.i as usize;
            let (gap, w) = (foot.gap + places[n + i], self.rates[n + i]);
            foot.closed && self.plane.floor.energy((-gap).max(0.0)) + 0.5 * w * w > quiet
        });
        foot_is_loud
            || (0..web.list.bonds.len()).any(|k| {
                let closed = web.list.bonds[k].closed;
                closed && {
                    let (gap, w) = web.gap(k, places, &self.rates);
                    self.plane.pair.energy((-gap).max(0.0)) + 0.25 * w * w > quiet
                }
            })
    }

    /// The collision is over when the floor was touched, and for the paper's time no
    /// contact has counted.
    fn look_for_the_end(&mut self) {
        let (touched, _) = self.books.contacts.floor();
        self.books.over |= touched.is_some() && self.grid.time() - self.busy >= self.plane.wait;
    }

    /// Goes on in one flight to just before the next contact, if no contact has been
    /// closed since the last look.
    fn look_for_flight(&mut self) -> Result<(), EngineError> {
        let contacts = &self.books.contacts;
        if !contacts.all_open() || !self.grid.is_settled(contacts.last()) {
            return Ok(());
        }
        let mut ahead = self.next_contact().min(self.room());
        if ahead > 0.0 && self.room() < self.next_contact() {
            // The list tells of no contact as far as it is good: a new one is good for longer.
            self.walker.list_anew();
            ahead = self.next_contact().min(self.room());
        }
        self.grid.take_off(ahead, self.books.over)
    }

    /// Time to the next contact of a pair in the list, or with the floor, in free
    /// flight, s; the rates are those of now.
    fn next_contact(&self) -> f64 {
        let web = self.walker.web();
        let n = web.sites.count();
        let places = self.walker.places();
        let mut next = f64::INFINITY;
        for foot in &web.list.feet {
            let (gap, w) = (
                foot.gap + places[n + foot.i as usize],
                self.rates[n + foot.i as usize],
            );
            next = next.min(closing(0.0, gap, w));
        }
        for bond in &web.list.bonds {
            let (i, j) = (bond.i as usize, bond.j as usize);
            let (dx, dy) = (places[j] - places[i], places[n + j] - places[n + i]);
            let (u, v) = (
                self.rates[j] - self.rates[i],
                self.rates[n + j] - self.rates[n + i],
            );
            let approach = -((bond.offset.x + dx) * u + (bond.offset.y + dy) * v);
            if approach > 0.0 {
                let excess = bond.offset.excess_when_moved(dx, dy);
                let turn = approach * approach - (u * u + v * v) * excess;
                if turn >= 0.0 {
                    next = next.min(excess / (approach + turn.sqrt()));
                }
            }
        }
        next
    }

    /// Time for which the list is good in free flight, s.
    fn room(&self) -> f64 {
        let n = self.walker.web().sites.count();
        let (across, up) = self.rates.split_at(n);
        let beads = across.iter().zip(up);
        let fastest = beads.map(|(u, v)| u * u + v * v).fold(0.0, f64::max).sqrt();
        let left =
            self.walker.web().list.slack() - self.walker.web().list.moved(self.walker.places());
        left / fastest
    }

    /// Passes through flights, up to grid point `last` at most.
    pub(super) fn fly(&mut self, last: u64) -> Result<(), EngineError> {
        while let Some(steps) = self.grid.fly(last) {
            self.walker.coast(steps);
            self.look_for_the_end();
            self.look_for_flight()?;
        }
        Ok(())
    }

    /// Every so often, whatever the slices a run is advanced in.
    pub(super) fn housekeeping(&mut self) -> Result<(), EngineError> {
        self.books
            .ledger
            .lost
            .add(self.walker.web().lost * self.grid.h);
        self.walker.web_mut().lost = 0.0;
        self.walker.clear();
        self.take_rates();
        self.set_quiet();
        self.measure();
        if self.is_loud() {
            self.busy = self.grid.time();
        }
        self.look_for_the_end();
        self.look_for_flight()?;
        let sound = self.walker.places().iter().sum::<f64>().is_finite();
        if sound && !self.grid.is_inspected() {
            return Ok(());
        }
        if !sound || self.lost_the_energy() {
            return Err(self.unstable());
        }
        Ok(())
    }

    pub(super) fn unstable(&self) -> EngineError {
        EngineError::Unstable {
            time: self.grid.time(),
            steps_per_contact: self.plane.settings.steps_per_contact,
        }
    }

    /// Sees how deep contacts are.
    fn measure(&mut self) {
        let web = self.walker.web();
        let (places, sites) = (self.walker.places(), &web.sites);
        let n = sites.count();
        let feet = web.list.feet.iter();
        let on_floor = feet.map(|foot| foot.gap + places[n + foot.i as usize]);
        let bonds = web.list.bonds.iter().filter(|bond| bond.closed);
        let between = bonds.map(|bond| {
            let (i, j) = (bond.i as usize, bond.j as usize);
            let (dx, dy) = (places[j] - places[i], places[n + j] - places[n + i]);
            // (r² − d²)/(r + d) of a small overlap.
            bond.offset.excess_when_moved(dx, dy) / (2.0 * sites.diameter)
        });
        self.books.measure(on_floor.chain(between));
    }

    /// Whether the ledger shows that the integration blows up.
    pub(super) fn lost_the_energy(&self) -> bool {
        self.ledger().is_broken(self.energy_now(), 0.0)
    }
}
