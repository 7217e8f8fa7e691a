//! What an integrator of a lattice does.

use super::forces::{LatticeForces, Surface};
use crate::physics::contact_law::ContactLaw;
use crate::physics::lanes::flushed;

/// An integrator. Its state is displacements and rates, all across, then all up.
pub(super) trait PlaneStepper: Clone + Send {
    /// Starts from displacements, m, and rates, m/s, with steps of `h` s.
    fn start<L: ContactLaw, S: Surface>(
        places: Vec<f64>,
        rates: &[f64],
        h: f64,
        forces: &mut LatticeForces<L, S>,
    ) -> Self;
    /// One step; whether a contact began or ended.
    fn step<L: ContactLaw, S: Surface>(&mut self, forces: &mut LatticeForces<L, S>) -> bool;
    /// Flies on for `steps` steps at constant rates.
    fn coast(&mut self, steps: u64);
    /// Displacements, m.
    fn places(&self) -> &[f64];
    /// Writes the rates, m/s.
    fn rates(&self, accelerations: &[f64], into: &mut Vec<f64>);
    /// Clears numbers too small to matter, which are slow to compute with.
    fn clear(&mut self);
}

/// Sets to zero what is too small to matter to anything.
pub(super) fn flush(row: &mut [f64]) {
    for x in row {
        *x = flushed(*x);
    }
}
