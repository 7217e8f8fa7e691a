//! The equations of motion of a column under a power law.

use crate::physics::column::reduced_mass;
use crate::physics::ground::Ground;
use crate::physics::matter::BeadColumn;

/// The equations of a column. Its state is laid out as gaps, rates, energy lost in contacts,
/// work of the plate.
#[derive(Clone)]
pub(super) struct Equations {
    pub column: BeadColumn,
    pub attraction: bool,
    /// 1/m of each bead.
    inverse: Vec<f64>,
    /// Reduced mass of each contact.
    reduced: Vec<f64>,
    /// What gravity changes a rate by in a contact time, m/s.
    fall: f64,
}

/// A contact's speed counts as no less than this part of the largest in the column: slower
/// motion is not resolved further.
const FAINT: f64 = 1e-6;

impl Equations {
    /// Of this column, in a scene of this contact time, s.
    pub fn new(column: BeadColumn, attraction: bool, contact_time: f64) -> Self {
        let masses = &column.masses;
        Self {
            attraction,
            inverse: masses.iter().map(|m| 1.0 / m).collect(),
            reduced: (0..masses.len()).map(|i| reduced_mass(masses, i)).collect(),
            fall: column.gravity * contact_time,
            column,
        }
    }

    /// Number of gaps.
    pub fn len(&self) -> usize {
        self.column.springs.len()
    }

    /// Force of contact `i` at gap `g` with rate `w`, m/s², and the power that it loses, m²/s³.
    fn push(&self, i: usize, g: f64, w: f64) -> (f64, f64) {
        let spring = &self.column.springs[i];
        // A step to the end of a contact may try gaps beyond it.
        let x = (-g).max(0.0);
        let (elastic, dashpot) = spring.elastic_and_dashpot(x);
        let full = elastic - dashpot * w;
        let force = if self.attraction { full } else { full.max(0.0) };
        (force, (elastic - force) * w)
    }

    /// Writes the derivative of `y` at `t`, s from the epoch. `closed` says which gaps are
    /// contacts.
    pub fn rate<G: Ground>(&self, ground: &G, t: f64, closed: &[bool], y: &[f64], dy: &mut [f64]) {
        let n = self.len();
        let (gaps, rest) = y.split_at(n);
        let rates = &rest[..n];
        let (moved, rest) = dy.split_at_mut(n);
        let (pushed, books) = rest.split_at_mut(n);
        moved.copy_from_slice(rates);
        books.fill(0.0);
        for i in 0..n {
            let (force, power) = if closed[i] {
                self.push(i, gaps[i], rates[i])
            } else {
                (0.0, 0.0)
            };
            pushed[i] = force;
            books[0] += power;
        }
        if closed[0] && G::MOVES {
            books[1] = pushed[0] * ground.plate(t).velocity();
        }
        // Forces become accelerations of the beads, and these those of the gaps below them.
        let mut below = 0.0;
        for i in 0..n {
            let above = if i + 1 < n { pushed[i + 1] } else { 0.0 };
            let acceleration = (pushed[i] - above) * self.inverse[i];
            pushed[i] = acceleration - below;
            below = acceleration;
        }
        ground.accelerate(t, pushed);
    }

    /// Kinetic energy of the contacts' own motions at these speeds, m²/s².
    pub fn energy(&self, speeds: &[f64]) -> f64 {
        let each = speeds.iter().zip(&self.reduced);
        each.map(|(speed, reduced)| 0.5 * reduced * speed * speed)
            .sum()
    }

    /// Writes the speed of each contact's own motion: its rate, and the rate that its elastic
    /// energy could give it. None is below a [`FAINT`] part of the largest, which is returned.
    pub fn speeds(&self, closed: &[bool], y: &[f64], into: &mut [f64]) -> f64 {
        let n = self.len();
        let mut largest = self.fall;
        for i in 0..n {
            let stored = if closed[i] {
                2.0 * self.column.springs[i].energy((-y[i]).max(0.0)) / self.reduced[i]
            } else {
                0.0
            };
            into[i] = y[n + i].abs() + stored.sqrt();
            largest = largest.max(into[i]);
        }
        // The square of less would underflow.
        let least = (FAINT * largest).max(1e-150);
        for speed in into {
            *speed = speed.max(least);
        }
        least
    }
}
