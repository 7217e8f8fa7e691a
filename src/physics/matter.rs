//! What beads are, and what follows from where they are at one time: the energies, the centre
//! of mass and an observation.

use super::bounce::Arrival;
use super::column::{masses, springs};
use super::observation::{Energy, Observation};
use super::plate::Plate;
use super::spring::Spring;
use crate::scene::Scene;

/// Where beads are and how they move at one time.
pub(crate) struct Snapshot {
    /// Simulated time, s.
    pub time: f64,
    /// Gaps, m; of a lattice the displacements of its beads.
    pub gaps: Vec<f64>,
    /// Rates of those, m/s.
    pub rates: Vec<f64>,
    /// The floor then.
    pub plate: Plate,
}

/// What the beads of a snapshot are: a column, or a lattice.
pub(crate) trait Matter {
    /// Stored energies; the ledger's entries are left at 0.
    fn energy(&self, now: &Snapshot) -> Energy;

    /// The beads in the floor's frame, as they arrive there or leave.
    fn arrival(&self, now: &Snapshot) -> Arrival;

    /// Fills in where all is and how it moves. `closed` says which contacts are closed.
    fn observe(&self, now: &Snapshot, closed: &[bool], into: &mut Observation);

    /// The springs of soft contacts, as a [`State`](super::State) has them.
    fn springs(&self) -> Vec<Spring>;

    /// The pairs of beads whose contacts the log has, where it has not those of all gaps.
    fn bonds(&self) -> Vec<[u32; 2]> {
        Vec::new()
    }
}

/// What a column is, whatever moves it.
#[derive(Debug, Clone)]
pub(crate) struct BeadColumn {
    /// Mass of each bead, in mean bead masses.
    pub masses: Vec<f64>,
    /// Spring and dashpot of each contact, index 0 being the floor's; hard beads have none.
    pub springs: Vec<Spring>,
    /// g, m/s²; 0 without gravity.
    pub gravity: f64,
}

impl BeadColumn {
    /// That of a scene.
    pub fn of(scene: &Scene) -> Self {
        let masses = masses(scene);
        Self {
            springs: springs(scene, &masses),
            gravity: scene.gravity.unwrap_or(0.0),
            masses,
        }
    }

    /// Writes the overlaps of the lowest beads, at rest and pressed down by `pull`, m/s², to
    /// their gaps.
    pub fn rest(&self, gaps: &mut [f64], pull: f64) {
        let mut load = 0.0;
        for (i, gap) in gaps.iter_mut().enumerate().rev() {
            load += self.masses[i] * pull;
            *gap = -self.springs[i].overlap_under(load);
        }
    }
}

/// E_r about the velocity `centre`, summed directly: E − ½Mv_cm² would cancel.
fn relative(now: &Snapshot, masses: &[f64], centre: f64) -> f64 {
    let mut u = now.plate.velocity() - centre;
    let mut relative = 0.0;
    for (w, m) in now.rates.iter().zip(masses) {
        u += w;
        relative += 0.5 * m * u * u;
    }
    relative
}

/// Of a stack at the floor the gaps are fewer than the beads of the column.
impl Matter for BeadColumn {
    fn energy(&self, now: &Snapshot) -> Energy {
        let (mut z, mut v) = now.plate.motion();
        let (mut mass, mut momentum, mut kinetic, mut height) = (0.0, 0.0, 0.0, 0.0);
        for ((g, w), m) in now.gaps.iter().zip(&now.rates).zip(&self.masses) {
            v += w;
            z += g;
            mass += m;
            momentum += m * v;
            kinetic += 0.5 * m * v * v;
            height += m * z;
        }
        let contacts = now.gaps.iter().zip(&self.springs);
        let elastic = contacts.filter(|(g, _)| **g < 0.0);
        Energy {
            kinetic,
            relative: relative(now, &self.masses, momentum / mass),
            potential: self.gravity * height,
            elastic: elastic.map(|(g, spring)| spring.energy(-g)).sum(),
            ..Energy::default()
        }
    }

    fn arrival(&self, now: &Snapshot) -> Arrival {
        let (mass, centre) = centre(now.rates.iter().copied(), &self.masses);
        let between = &now.gaps[1..];
        let separation = between.iter().map(|g| g.max(0.0)).sum::<f64>() / between.len() as f64;
        Arrival {
            time: now.time,
            period: now.plate.period(),
            translation: translational(mass, centre),
            relative: relative(now, &self.masses, centre + now.plate.velocity()),
            crossing: (!between.is_empty() && centre != 0.0).then(|| separation / centre.abs()),
        }
    }

    fn observe(&self, now: &Snapshot, closed: &[bool], into: &mut Observation) {
        let (mut z, mut v) = now.plate.motion();
        into.floor = z;
        into.floor_velocity = v;
        into.reduced.clear();
        into.velocities.clear();
        let (mut mass, mut height, mut momentum) = (0.0, 0.0, 0.0);
        for ((g, w), m) in now.gaps.iter().zip(&now.rates).zip(&self.masses) {
            z += g;
            v += w;
            mass += m;
            height += m * z;
            momentum += m * v;
            into.reduced.push(z);
            into.velocities.push(v);
        }
        into.centre = height / mass;
        into.centre_velocity = momentum / mass;
        now.gaps.clone_into(&mut into.gaps);
        closed.clone_into(&mut into.contacts);
        into.discs = None;
    }

    fn springs(&self) -> Vec<Spring> {
        self.springs.clone()
    }
}

/// Mass, and velocity of the centre of mass in the floor's frame, from the rates of the
/// gaps.
fn centre(rates: impl Iterator<Item = f64>, masses: &[f64]) -> (f64, f64) {
    let (mut u, mut mass, mut momentum) = (0.0, 0.0, 0.0);
    for (w, m) in rates.zip(masses) {
        u += w;
        mass += m;
        momentum += m * u;
    }
    (mass, momentum / mass)
}

/// What [`Arrival::translation`] is, from the rates of the gaps alone.
pub(crate) fn translation(rates: impl Iterator<Item = f64>, masses: &[f64]) -> f64 {
    let (mass, u) = centre(rates, masses);
    translational(mass, u)
}

fn translational(mass: f64, u: f64) -> f64 {
    0.5 * mass * u * u.abs()
}
