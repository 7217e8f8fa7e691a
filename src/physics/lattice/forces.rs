//! Forces of the contacts of a lattice.

use super::list::List;
use crate::physics::contact_law::{ContactLaw, Memories};
use crate::scene::lattice::Sites;

/// The laws of a contact with the floor and of one between beads.
#[derive(Clone)]
pub(super) struct Laws<L> {
    pub floor: L,
    pub pair: L,
}

/// What acts across a contact, chosen at compile time.
pub(super) trait Surface: Copy + Send {
    /// Whether anything does.
    const RUBS: bool;
    /// D_t, 1/s.
    fn damping(self) -> f64;
}

/// Nothing acts across.
#[derive(Clone, Copy)]
pub(super) struct Smooth;

/// D_t, 1/s, Eq. (4).
#[derive(Clone, Copy)]
pub(super) struct Rubbing(pub f64);

impl Surface for Smooth {
    const RUBS: bool = false;
    fn damping(self) -> f64 {
        0.0
    }
}

impl Surface for Rubbing {
    const RUBS: bool = true;
    fn damping(self) -> f64 {
        self.0
    }
}

/// The contacts of a lattice, whatever their law.
#[derive(Clone)]
pub(super) struct Web {
    pub sites: Sites,
    pub list: List,
    /// Accelerations of the beads, all across, then all up, m/s².
    pub accelerations: Vec<f64>,
    /// Power lost in contacts, summed over the steps since it was last taken, m²/s³.
    pub lost: f64,
}

/// The contacts of a lattice, and what they do to its beads.
#[derive(Clone)]
pub(super) struct LatticeForces<L: ContactLaw, S> {
    pub web: Web,
    laws: Laws<L>,
    surface: S,
    /// What the contacts of the list remember: those with the floor, and those of pairs.
    memories: [Memories<L::Memory>; 2],
}

impl<L: ContactLaw, S: Surface> LatticeForces<L, S> {
    pub fn new(sites: Sites, laws: Laws<L>, surface: S, places: &[f64]) -> Self {
        let web = Web {
            list: List::new(&sites, places),
            accelerations: vec![0.0; 2 * sites.count()],
            sites,
            lost: 0.0,
        };
        let memories = [web.list.feet.len(), web.list.bonds.len()].map(Memories::new);
        Self {
            web,
            laws,
            surface,
            memories,
        }
    }

    /// Finds anew which beads may touch soon; contacts remember what they did.
    pub fn list_anew(&mut self, places: &[f64]) {
        let Web { sites, list, .. } = &mut self.web;
        if Memories::<L::Memory>::ARE_NONE {
            list.make(sites, places);
            return;
        }
        let before = list.contacts();
        list.make(sites, places);
        let contacts = before.iter().zip(list.contacts());
        for (memories, (before, now)) in self.memories.iter_mut().zip(contacts) {
            memories.reorder(before, &now);
        }
    }

    /// The accelerations at these displacements and rates, which count `unit` m/s; whether
    /// a pair has come into contact or left it. Makes the list anew where it has to be.
    #[inline]
    pub fn act(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        if self.web.list.is_stale(places) {
            self.list_anew(places);
        }
        self.web.accelerations.fill(0.0);
        let floor = self.on_floor(places, rates, unit);
        let pairs = self.between(places, rates, unit);
        floor || pairs
    }

    #[inline]
    fn on_floor(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        let n = self.web.sites.count();
        let mut changed = false;
        let [memories, _] = &mut self.memories;
        for (k, foot) in self.web.list.feet.iter_mut().enumerate() {
            let i = foot.i as usize;
            let gap = foot.gap + places[n + i];
            let closed = gap <= 0.0;
            changed |= closed != foot.closed;
            foot.closed = closed;
            if closed {
                let rate = rates[n + i] * unit;
                let push = |memory: &mut L::Memory| self.laws.floor.push(gap, rate, memory);
                let (force, lost) = memories.with(k, push);
                self.web.accelerations[n + i] += force;
                self.web.lost += lost;
                if S::RUBS {
                    let across = rates[i] * unit;
                    let drag = self.surface.damping() * across;
                    self.web.accelerations[i] -= drag;
                    self.web.lost += drag * across;
                }
            } else {
                memories.with(k, |memory| *memory = L::Memory::default());
            }
        }
        changed
    }

    #[inline]
    fn between(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        let n = self.web.sites.count();
        let (x, y) = places.split_at(n);
        let (u, v) = rates.split_at(n);
        let (ax, ay) = self.web.accelerations.split_at_mut(n);
        let diameter = self.web.sites.diameter;
        let (mut changed, mut sum) = (false, 0.0);
        let [_, memories] = &mut self.memories;
        for (k, bond) in self.web.list.bonds.iter_mut().enumerate() {
            let (i, j) = (bond.i as usize, bond.j as usize);
            let (dx, dy) = (x[j] - x[i], y[j] - y[i]);
            let excess = bond.offset.excess_when_moved(dx, dy);
            let closed = excess <= 0.0;
            changed |= closed != bond.closed;
            bond.closed = closed;
            if closed {
                let length = (excess + diameter * diameter).sqrt();
                let inverse = 1.0 / length;
                let (nx, ny) = (
                    (bond.offset.x + dx) * inverse,
                    (bond.offset.y + dy) * inverse,
                );
                let (du, dv) = ((u[j] - u[i]) * unit, (v[j] - v[i]) * unit);
                let gap = excess / (length + diameter);
                let rate = nx * du + ny * dv;
                let push = |memory: &mut L::Memory| self.laws.pair.push(gap, rate, memory);
                let (force, lost) = memories.with(k, push);
                sum += lost;
                let (mut fx, mut fy) = (force * nx, force * ny);
                if S::RUBS {
                    let across = nx * dv - ny * du;
                    let drag = self.surface.damping() * across;
                    sum += drag * across;
                    fx += drag * ny;
                    fy -= drag * nx;
                }
                ax[j] += fx;
                ay[j] += fy;
                ax[i] -= fx;
                ay[i] -= fy;
            } else {
                memories.with(k, |memory| *memory = L::Memory::default());
            }
        }
        self.web.lost += sum;
        changed
    }
}

impl Web {
    /// Gap and its rate of a pair in the list, m and m/s.
    pub fn gap(&self, k: usize, places: &[f64], rates: &[f64]) -> (f64, f64) {
        let n = self.sites.count();
        let bond = &self.list.bonds[k];
        let (i, j) = (bond.i as usize, bond.j as usize);
        let (dx, dy) = (places[j] - places[i], places[n + j] - places[n + i]);
        let excess = bond.offset.excess_when_moved(dx, dy);
        let diameter = self.sites.diameter;
        let length = (excess + diameter * diameter).sqrt();
        let along = (bond.offset.x + dx) * (rates[j] - rates[i])
            + (bond.offset.y + dy) * (rates[n + j] - rates[n + i]);
        (excess / (length + diameter), along / length)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::contact_law::Counting;

    #[test]
    fn contacts_remember_through_new_lists_until_they_end() {
        let (columns, rows) = (4, 3);
        let sites = Sites {
            columns,
            rows,
            diameter: 1e-3,
            separation: 0.0,
        };
        let n = sites.count();
        let laws = Laws {
            floor: Counting,
            pair: Counting,
        };
        let (at_rest, rates) = (vec![0.0; 2 * n], vec![0.0; 2 * n]);
        let mut forces = LatticeForces::new(sites, laws, Smooth, &at_rest);
        // All beads just touch. The last one, of the top row, leaves and comes back.
        let mut away = at_rest.clone();
        away[2 * n - 1] = 1e-3;
        let last = u32::try_from(n - 1).expect("a few");
        let looks = [
            (&at_rest, 28, 1, 1),
            (&at_rest, 28, 2, 2),
            (&away, 24, 0, 3),
            (&at_rest, 28, 1, 4),
        ];
        for (places, pairs, own, others) in looks {
            forces.act(places, &rates, 1.0);
            let contacts = forces.web.list.contacts();
            assert_eq!(contacts.each_ref().map(Vec::len), [columns, pairs]);
            for (memories, contacts) in forces.memories.iter_mut().zip(contacts) {
                for (k, contact) in contacts.iter().enumerate() {
                    let expected = if contact.contains(&last) { own } else { others };
                    assert_eq!(memories.with(k, |looks| *looks), expected, "{contact:?}");
                }
            }
        }
    }
}
