//! LatticeForces of the contacts of a lattice.

use super::list::List;
use crate::physics::contact_law::ContactLaw;
use crate::scene::lattice::Sites;

/// The laws of a contact with the floor and of one between beads.
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

/// The contacts of a lattice, and what they do to its beads.
pub(super) struct LatticeForces<L, S> {
    pub sites: Sites,
    pub list: List,
    laws: Laws<L>,
    surface: S,
    /// Accelerations of the beads, all across, then all up, m/s².
    pub accelerations: Vec<f64>,
    /// Power lost in contacts, summed over the steps since it was last taken, m²/s³.
    pub lost: f64,
}

impl<L: ContactLaw, S: Surface> LatticeForces<L, S> {
    pub fn new(sites: Sites, laws: Laws<L>, surface: S, places: &[f64]) -> Self {
        Self {
            list: List::new(&sites, places),
            accelerations: vec![0.0; 2 * sites.count()],
            sites,
            laws,
            surface,
            lost: 0.0,
        }
    }

    /// The accelerations at these displacements and rates, which count `unit` m/s; whether
    /// a pair has come into contact or left it. Makes the list anew where it has to be.
    #[inline]
    pub fn act(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        if self.list.is_stale(places) {
            self.list.make(&self.sites, places);
        }
        self.accelerations.fill(0.0);
        let floor = self.on_floor(places, rates, unit);
        let pairs = self.between(places, rates, unit);
        floor || pairs
    }

    #[inline]
    fn on_floor(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        let n = self.sites.count();
        let mut changed = false;
        for foot in &mut self.list.feet {
            let i = foot.i as usize;
            let gap = foot.gap + places[n + i];
            let closed = gap <= 0.0;
            changed |= closed != foot.closed;
            foot.closed = closed;
            if closed {
                let (force, lost) = self.laws.floor.push(gap, rates[n + i] * unit);
                self.accelerations[n + i] += force;
                self.lost += lost;
                if S::RUBS {
                    let across = rates[i] * unit;
                    let drag = self.surface.damping() * across;
                    self.accelerations[i] -= drag;
                    self.lost += drag * across;
                }
            }
        }
        changed
    }

    #[inline]
    fn between(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        let n = self.sites.count();
        let (x, y) = places.split_at(n);
        let (u, v) = rates.split_at(n);
        let (ax, ay) = self.accelerations.split_at_mut(n);
        let diameter = self.sites.diameter;
        let (mut changed, mut sum) = (false, 0.0);
        for bond in &mut self.list.bonds {
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
                let (force, lost) = self.laws.pair.push(gap, nx * du + ny * dv);
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
            }
        }
        self.lost += sum;
        changed
    }

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
