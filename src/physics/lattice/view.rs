//! One moment of a lattice: what follows from displacements and rates.

use super::list::List;
use crate::physics::bounce::Arrival;
use crate::physics::ledger::Ledger;
use crate::physics::observation::{Discs, Energy, Observation};
use crate::physics::spring::Spring;
use crate::physics::state::Books;
use crate::scene::lattice::Sites;

/// Displacements, rates and what gives them meaning.
pub(super) struct View<'a> {
    pub time: f64,
    /// Displacements from the sites, m, and rates, m/s: all across, then all up.
    pub places: &'a [f64],
    pub rates: &'a [f64],
    pub sites: &'a Sites,
    pub list: &'a List,
    /// Springs of the floor's contacts and of all others.
    pub springs: (Spring, Spring),
}

impl View<'_> {
    fn n(&self) -> usize {
        self.sites.count()
    }

    /// Overlaps of the beads with the floor, m.
    fn on_floor(&self) -> impl Iterator<Item = (usize, f64)> {
        let n = self.n();
        let feet = self.list.feet.iter();
        feet.map(move |foot| {
            (
                foot.i as usize,
                -(foot.gap + self.places[n + foot.i as usize]),
            )
        })
        .filter(|&(_, overlap)| overlap >= 0.0)
    }

    /// Overlaps of pairs, m.
    fn between(&self) -> impl Iterator<Item = ([usize; 2], f64)> {
        let (n, diameter) = (self.n(), self.sites.diameter);
        let overlap = move |i: usize, j: usize, excess: f64| {
            let length = (excess + diameter * diameter).sqrt();
            ([i, j], -excess / (length + diameter))
        };
        let bonds = self.list.bonds.iter();
        bonds.filter_map(move |bond| {
            let (i, j) = (bond.i as usize, bond.j as usize);
            let dx = self.places[j] - self.places[i];
            let dy = self.places[n + j] - self.places[n + i];
            let excess = bond.offset.excess_when_moved(dx, dy);
            (excess <= 0.0).then(|| overlap(i, j, excess))
        })
    }

    /// Velocity of the centre of mass, m/s.
    fn centre_velocity(&self) -> (f64, f64) {
        let (across, up) = self.rates.split_at(self.n());
        let mean = |row: &[f64]| row.iter().sum::<f64>() / self.n() as f64;
        (mean(across), mean(up))
    }

    /// Stored energies; the ledger's entries are left at 0.
    pub fn energy(&self) -> Energy {
        let (across, up) = self.rates.split_at(self.n());
        let (u, v) = self.centre_velocity();
        let about = |u: f64, v: f64| -> f64 {
            let beads = across.iter().zip(up);
            beads
                .map(|(x, y)| 0.5 * ((x - u) * (x - u) + (y - v) * (y - v)))
                .sum()
        };
        let floor = self.on_floor().map(|(_, x)| self.springs.0.energy(x));
        let pairs = self.between().map(|(_, x)| self.springs.1.energy(x));
        Energy {
            kinetic: about(0.0, 0.0),
            relative: about(u, v),
            elastic: floor.chain(pairs).sum(),
            ..Energy::default()
        }
    }

    /// The lattice as it arrives at its floor or leaves; its separation is the mean one
    /// of neighbours in the lattice.
    pub fn arrival(&self) -> Arrival {
        let (_, v) = self.centre_velocity();
        let n = self.n();
        let (mut sum, mut count) = (0.0, 0.0);
        for i in 0..n {
            for (j, turns) in self.sites.neighbours(i) {
                let dx = self.places[j] - self.places[i];
                let dy = self.places[n + j] - self.places[n + i];
                let excess = self.sites.offset(i, j, turns).excess_when_moved(dx, dy);
                let length = (excess + self.sites.diameter * self.sites.diameter).sqrt();
                sum += (excess / (length + self.sites.diameter)).max(0.0);
                count += 1.0;
            }
        }
        Arrival {
            time: self.time,
            period: f64::INFINITY,
            translation: 0.5 * n as f64 * v * v.abs(),
            relative: self.energy().relative,
            crossing: (count > 0.0 && v != 0.0).then(|| sum / count / v.abs()),
        }
    }

    /// Fills in an observation.
    pub fn observe(&self, books: &Books, ledger: Ledger, into: &mut Observation) {
        let n = self.n();
        let up = &self.places[n..];
        into.time = self.time;
        (into.floor, into.floor_velocity) = (0.0, 0.0);
        into.reduced.clear();
        let reduced = up
            .iter()
            .enumerate()
            .map(|(i, y)| self.sites.reduced(i) + y);
        into.reduced.extend(reduced);
        into.velocities.clear();
        into.velocities.extend_from_slice(&self.rates[n..]);
        into.gaps.clear();
        into.contacts.clear();
        into.centre = into.reduced.iter().sum::<f64>() / n as f64;
        into.centre_velocity = self.centre_velocity().1;
        into.integrals = None;
        into.energy = ledger.closed(self.energy());
        books.observe(self.time, f64::INFINITY, into);
        self.draw(into.discs.get_or_insert_default());
    }

    /// Where the discs are, and which touch.
    fn draw(&self, discs: &mut Discs) {
        let (n, sites) = (self.n(), self.sites);
        let (across, up) = self.places.split_at(n);
        discs.columns = sites.columns;
        discs.period = sites.period();
        discs.diameter = sites.diameter;
        discs.x.clear();
        discs.x.extend((0..n).map(|i| sites.x(i) + across[i]));
        discs.heights.clear();
        let height = |i: usize| 0.5 * sites.diameter + sites.floor_gap(i) + up[i];
        discs.heights.extend((0..n).map(height));
        discs.contacts.clear();
        discs.contacts.extend(self.between().map(|(pair, _)| pair));
        discs.touching.clear();
        discs.touching.resize(n, false);
        for (i, _) in self.on_floor() {
            discs.touching[i] = true;
        }
        for [i, j] in &discs.contacts {
            discs.touching[*i] = true;
            discs.touching[*j] = true;
        }
    }
}
