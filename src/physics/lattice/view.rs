//! A lattice as matter: what follows from displacements and rates.

use super::engine::Lattice;
use crate::physics::bounce::Arrival;
use crate::physics::matter::{Matter, Snapshot};
use crate::physics::observation::{Discs, Energy, Observation};
use crate::physics::spring::Spring;

impl Lattice {
    /// Overlaps of the beads with the floor, m.
    fn on_floor<'a>(&'a self, now: &'a Snapshot) -> impl Iterator<Item = (usize, f64)> + 'a {
        let n = self.plane.sites.count();
        let feet = self.walker.web().list.feet.iter();
        feet.map(move |foot| (foot.i as usize, -(foot.gap + now.gaps[n + foot.i as usize])))
            .filter(|&(_, overlap)| overlap >= 0.0)
    }

    /// Overlaps of pairs, m.
    fn between(&self, now: &Snapshot) -> impl Iterator<Item = ([usize; 2], f64)> {
        let (n, diameter) = (self.plane.sites.count(), self.plane.sites.diameter);
        let overlap = move |i: usize, j: usize, excess: f64| {
            let length = (excess + diameter * diameter).sqrt();
            ([i, j], -excess / (length + diameter))
        };
        let bonds = self.walker.web().list.bonds.iter();
        bonds.filter_map(move |bond| {
            let (i, j) = (bond.i as usize, bond.j as usize);
            let dx = now.gaps[j] - now.gaps[i];
            let dy = now.gaps[n + j] - now.gaps[n + i];
            let excess = bond.offset.excess_when_moved(dx, dy);
            (excess <= 0.0).then(|| overlap(i, j, excess))
        })
    }

    /// Velocity of the centre of mass, m/s.
    fn centre_velocity(&self, now: &Snapshot) -> (f64, f64) {
        let n = self.plane.sites.count();
        let (across, up) = now.rates.split_at(n);
        let mean = |row: &[f64]| row.iter().sum::<f64>() / n as f64;
        (mean(across), mean(up))
    }

    /// Where the discs are, and which touch.
    fn draw(&self, now: &Snapshot, discs: &mut Discs) {
        let (n, sites) = (self.plane.sites.count(), &self.plane.sites);
        let (across, up) = now.gaps.split_at(n);
        discs.columns = sites.columns;
        discs.period = sites.period();
        discs.diameter = sites.diameter;
        discs.x.clear();
        discs.x.extend((0..n).map(|i| sites.x(i) + across[i]));
        discs.heights.clear();
        let height = |i: usize| 0.5 * sites.diameter + sites.floor_gap(i) + up[i];
        discs.heights.extend((0..n).map(height));
        discs.contacts.clear();
        discs
            .contacts
            .extend(self.between(now).map(|(pair, _)| pair));
        discs.touching.clear();
        discs.touching.resize(n, false);
        for (i, _) in self.on_floor(now) {
            discs.touching[i] = true;
        }
        for [i, j] in &discs.contacts {
            discs.touching[*i] = true;
            discs.touching[*j] = true;
        }
    }
}

impl Matter for Lattice {
    fn energy(&self, now: &Snapshot) -> Energy {
        let (across, up) = now.rates.split_at(self.plane.sites.count());
        let (u, v) = self.centre_velocity(now);
        let about = |u: f64, v: f64| -> f64 {
            let beads = across.iter().zip(up);
            beads
                .map(|(x, y)| 0.5 * ((x - u) * (x - u) + (y - v) * (y - v)))
                .sum()
        };
        let floor = self.on_floor(now).map(|(_, x)| self.plane.floor.energy(x));
        let pairs = self.between(now).map(|(_, x)| self.plane.pair.energy(x));
        Energy {
            kinetic: about(0.0, 0.0),
            relative: about(u, v),
            elastic: floor.chain(pairs).sum(),
            ..Energy::default()
        }
    }

    /// The lattice as it arrives at its floor or leaves; its separation is the mean one
    /// of neighbours in the lattice.
    fn arrival(&self, now: &Snapshot) -> Arrival {
        let (_, v) = self.centre_velocity(now);
        let n = self.plane.sites.count();
        let (mut sum, mut count) = (0.0, 0.0);
        for i in 0..n {
            for (j, turns) in self.plane.sites.neighbours(i) {
                let dx = now.gaps[j] - now.gaps[i];
                let dy = now.gaps[n + j] - now.gaps[n + i];
                let excess = self
                    .plane
                    .sites
                    .offset(i, j, turns)
                    .excess_when_moved(dx, dy);
                let length =
                    (excess + self.plane.sites.diameter * self.plane.sites.diameter).sqrt();
                sum += (excess / (length + self.plane.sites.diameter)).max(0.0);
                count += 1.0;
            }
        }
        Arrival {
            time: now.time,
            period: now.plate.period(),
            translation: 0.5 * n as f64 * v * v.abs(),
            relative: self.energy(now).relative,
            crossing: (count > 0.0 && v != 0.0).then(|| sum / count / v.abs()),
        }
    }

    /// Contacts of a lattice are seen in its discs.
    fn observe(&self, now: &Snapshot, _: &[bool], into: &mut Observation) {
        let n = self.plane.sites.count();
        let up = &now.gaps[n..];
        (into.floor, into.floor_velocity) = (0.0, 0.0);
        into.reduced.clear();
        let reduced = up
            .iter()
            .enumerate()
            .map(|(i, y)| self.plane.sites.reduced(i) + y);
        into.reduced.extend(reduced);
        into.velocities.clear();
        into.velocities.extend_from_slice(&now.rates[n..]);
        into.gaps.clear();
        into.contacts.clear();
        into.centre = into.reduced.iter().sum::<f64>() / n as f64;
        into.centre_velocity = self.centre_velocity(now).1;
        self.draw(now, into.discs.get_or_insert_default());
    }

    fn springs(&self) -> Vec<Spring> {
        vec![self.plane.floor, self.plane.pair]
    }

    fn bonds(&self) -> Vec<[u32; 2]> {
        self.bonds.clone()
    }
}
