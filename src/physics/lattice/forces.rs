//! Forces of the contacts of a lattice.

use super::list::List;
use crate::physics::contact_law::ContactLaw;
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
pub(super) struct LatticeForces<L, S> {
    pub web: Web,
    laws: Laws<L>,
    surface: S,
}

impl<L: ContactLaw, S: Surface> LatticeForces<L, S> {
    pub fn new(sites: Sites, laws: Laws<L>, surface: S, places: &[f64]) -> Self {
        let web = Web {
            list: List::new(&sites, places),
            accelerations: vec![0.0; 2 * sites.count()],
            sites,
            lost: 0.0,
        };
        Self { web, laws, surface }
    }

    /// The accelerations at these displacements and rates, which count `unit` m/s; whether
    /// a pair has come into contact or left it. Makes the list anew where it has to be.
    #[inline]
    pub fn act(&mut self, places: &[f64], rates: &[f64], unit: f64) -> bool {
        if self.web.list.is_stale(places) {
            self.web.list.make(&self.web.sites, places);
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
        for foot in &mut self.web.list.feet {
            let i = foot.i as usize;
            let gap = foot.gap + places[n + i];
            let closed = gap <= 0.0;
            changed |= closed != foot.closed;
            foot.closed = closed;
            if closed {
                let (force, lost) = self.laws.floor.push(gap, rates[n + i] * unit);
                self.web.accelerations[n + i] += force;
                self.web.lost += lost;
                if S::RUBS {
                    let across = rates[i] * unit;
                    let drag = self.surface.damping() * across;
                    self.web.accelerations[i] -= drag;
                    self.web.lost += drag * across;
                }
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
        for bond in &mut self.web.list.bonds {
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
