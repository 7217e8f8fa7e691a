//! Velocity Verlet for a lattice. The dashpots get the velocity that the old acceleration
//! predicts. Rates are kept as they were half a step ago.

use super::forces::{LatticeForces, Surface};
use super::stepper::{PlaneStepper, flush};
use crate::physics::contact_law::ContactLaw;

#[derive(Clone)]
pub(super) struct LatticeVerlet {
    h: f64,
    places: Vec<f64>,
    /// Rates half a step ago, m/s.
    before: Vec<f64>,
    /// Rates predicted for the end of the step, m/s.
    predicted: Vec<f64>,
}

impl PlaneStepper for LatticeVerlet {
    fn start<L: ContactLaw, S: Surface>(
        places: Vec<f64>,
        rates: &[f64],
        h: f64,
        forces: &mut LatticeForces<L, S>,
    ) -> Self {
        forces.act(&places, rates, 1.0);
        let before = rates.iter().zip(&forces.web.accelerations);
        Self {
            h,
            before: before.map(|(w, a)| w - a * (0.5 * h)).collect(),
            predicted: rates.to_vec(),
            places,
        }
    }

    #[inline]
    fn step<L: ContactLaw, S: Surface>(&mut self, forces: &mut LatticeForces<L, S>) -> bool {
        let h = self.h;
        let rates = self.before.iter_mut().zip(&mut self.predicted);
        let state = self.places.iter_mut().zip(rates);
        for ((place, (before, predicted)), a) in state.zip(&forces.web.accelerations) {
            let kick = a * (0.5 * h);
            let half = (*before + kick) + kick;
            *place += half * h;
            *predicted = half + kick;
            *before = half;
        }
        forces.act(&self.places, &self.predicted, 1.0)
    }

    fn coast(&mut self, steps: u64) {
        let flight = steps as f64 * self.h;
        for (place, rate) in self.places.iter_mut().zip(&self.before) {
            *place += rate * flight;
        }
    }

    fn places(&self) -> &[f64] {
        &self.places
    }

    fn rates(&self, accelerations: &[f64], into: &mut Vec<f64>) {
        let kicked = self.before.iter().zip(accelerations);
        into.clear();
        into.extend(kicked.map(|(w, a)| w + a * (0.5 * self.h)));
    }

    fn clear(&mut self) {
        flush(&mut self.places);
        flush(&mut self.before);
    }
}
