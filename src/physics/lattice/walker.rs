//! What takes the steps of a lattice on a grid: integrator and contacts together.

use dyn_clone::DynClone;

use super::forces::{LatticeForces, Surface, Web};
use super::stepper::PlaneStepper;
use crate::physics::contact_law::ContactLaw;

/// What takes the steps, behind one call for many of them.
pub(super) trait PlaneWalker: DynClone + Send {
    /// Up to `steps` steps, to where contacts change: how many it did, and whether any
    /// contact changed in the last.
    fn run(&mut self, steps: u64) -> (u64, bool);
    /// Flies on for `steps` steps at constant rates.
    fn coast(&mut self, steps: u64);
    /// Displacements, m.
    fn places(&self) -> &[f64];
    /// Writes the rates, m/s.
    fn rates(&self, into: &mut Vec<f64>);
    /// Clears numbers too small to matter.
    fn clear(&mut self);
    /// The contacts.
    fn web(&self) -> &Web;
    /// The same, to be written to.
    fn web_mut(&mut self) -> &mut Web;
    /// Finds anew which beads may touch soon.
    fn list_anew(&mut self);
}

dyn_clone::clone_trait_object!(PlaneWalker);

/// The steps of an integrator of lattices.
#[derive(Clone)]
pub(super) struct PlaneWalking<M, L: ContactLaw, S> {
    stepper: M,
    forces: LatticeForces<L, S>,
}

impl<M: PlaneStepper, L: ContactLaw, S: Surface> PlaneWalking<M, L, S> {
    /// Starts from displacements, m, and rates, m/s, with steps of `h` s.
    pub fn new(places: Vec<f64>, rates: &[f64], h: f64, mut forces: LatticeForces<L, S>) -> Self {
        let stepper = M::start(places, rates, h, &mut forces);
        forces.web.lost = 0.0;
        Self { stepper, forces }
    }
}

impl<M: PlaneStepper, L: ContactLaw, S: Surface> PlaneWalker for PlaneWalking<M, L, S> {
    fn run(&mut self, steps: u64) -> (u64, bool) {
        let (mut done, mut changed) = (0, false);
        while done < steps && !changed {
            changed = self.stepper.step(&mut self.forces);
            done += 1;
        }
        (done, changed)
    }

    fn coast(&mut self, steps: u64) {
        self.stepper.coast(steps);
    }

    fn places(&self) -> &[f64] {
        self.stepper.places()
    }

    fn rates(&self, into: &mut Vec<f64>) {
        self.stepper.rates(&self.forces.web.accelerations, into);
    }

    fn clear(&mut self) {
        self.stepper.clear();
    }

    fn web(&self) -> &Web {
        &self.forces.web
    }

    fn web_mut(&mut self) -> &mut Web {
        &mut self.forces.web
    }

    fn list_anew(&mut self) {
        self.forces.list_anew(self.stepper.places());
    }
}
