//! A column at one time: the energies, the centre of mass and the observation that follow from
//! its gaps and rates.

use super::bounce::Arrival;
use super::course::Course;
use super::ledger::Ledger;
use super::observation::{Energy, Observation};
use super::plate::Plate;
use super::spring::Spring;
use super::state::{Books, Depth, State};

/// The gaps and rates of a column, and all that they need to mean something.
pub(crate) struct Snapshot<'a> {
    /// Simulated time, s.
    pub time: f64,
    /// Gaps, m.
    pub gaps: &'a [f64],
    /// Rates of the gaps, m/s.
    pub rates: &'a [f64],
    /// The floor now.
    pub plate: Plate,
    /// Masses, in mean bead masses.
    pub masses: &'a [f64],
    /// g, m/s²; 0 without gravity.
    pub gravity: f64,
    /// The springs of soft contacts; none between hard beads.
    pub springs: &'a [Spring],
}

impl Snapshot<'_> {
    /// Stored energies; the ledger's entries are left at 0.
    pub fn energy(&self) -> Energy {
        let (mut z, mut v) = self.plate.motion();
        let (mut mass, mut momentum, mut kinetic, mut height) = (0.0, 0.0, 0.0, 0.0);
        for ((g, w), m) in self.gaps.iter().zip(self.rates).zip(self.masses) {
            v += w;
            z += g;
            mass += m;
            momentum += m * v;
            kinetic += 0.5 * m * v * v;
            height += m * z;
        }
        let elastic = self
            .gaps
            .iter()
            .zip(self.springs)
            .filter(|(g, _)| **g < 0.0);
        Energy {
            kinetic,
            relative: self.relative(momentum / mass),
            potential: self.gravity * height,
            elastic: elastic.map(|(g, spring)| spring.energy(-g)).sum(),
            ..Energy::default()
        }
    }

    /// E_r about the velocity `centre`, summed directly: E − ½Mv_cm² would cancel.
    fn relative(&self, centre: f64) -> f64 {
        let mut u = self.plate.velocity() - centre;
        let mut relative = 0.0;
        for (w, m) in self.rates.iter().zip(self.masses) {
            u += w;
            relative += 0.5 * m * u * u;
        }
        relative
    }

    /// The column in the floor's frame, as it arrives there or leaves.
    pub fn arrival(&self) -> Arrival {
        let (mass, centre) = centre(self.rates.iter().copied(), self.masses);
        let between = &self.gaps[1..];
        let separation = between.iter().map(|g| g.max(0.0)).sum::<f64>() / between.len() as f64;
        Arrival {
            time: self.time,
            period: self.plate.period(),
            translation: translational(mass, centre),
            relative: self.relative(centre + self.plate.velocity()),
            crossing: (!between.is_empty() && centre != 0.0).then(|| separation / centre.abs()),
        }
    }

    /// The whole state, with these books.
    pub fn state(&self, books: Books) -> State {
        State {
            time: self.time,
            gaps: self.gaps.to_vec(),
            rates: self.rates.to_vec(),
            plate: self.plate,
            course: Course::default(),
            settled: self.time,
            ledger_error: books.ledger.error(self.energy()),
            closing: Depth::default(),
            springs: self.springs.to_vec(),
            bonds: Vec::new(),
            books,
        }
    }

    /// Fills in an observation. The books are looked at often, and not copied for it:
    /// only the ledger is of this moment.
    pub fn observe(&self, books: &Books, ledger: Ledger, into: &mut Observation) {
        let (mut z, mut v) = self.plate.motion();
        into.time = self.time;
        into.floor = z;
        into.floor_velocity = v;
        into.reduced.clear();
        into.velocities.clear();
        let (mut mass, mut height, mut momentum) = (0.0, 0.0, 0.0);
        for ((g, w), m) in self.gaps.iter().zip(self.rates).zip(self.masses) {
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
        into.integrals = None;
        self.gaps.clone_into(&mut into.gaps);
        books.contacts.closed().clone_into(&mut into.contacts);
        into.energy = ledger.closed(self.energy());
        books.observe(self.time, self.plate.period(), into);
        into.discs = None;
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
