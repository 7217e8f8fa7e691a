//! Gear's fifth-order predictor–corrector for a lattice: the scaled derivatives
//! r_k = (h^k/k!) d^k x/dt^k of every displacement, a row each.

use super::forces::{LatticeForces, Surface};
use super::stepper::{PlaneStepper, flush};
use crate::physics::contact_law::ContactLaw;
use crate::physics::md::{corrected, predicted};

#[derive(Clone)]
pub(super) struct LatticeGear {
    h: f64,
    rows: [Vec<f64>; 6],
}

impl PlaneStepper for LatticeGear {
    fn start<L: ContactLaw, S: Surface>(
        places: Vec<f64>,
        rates: &[f64],
        h: f64,
        forces: &mut LatticeForces<L, S>,
    ) -> Self {
        forces.act(&places, rates, 1.0);
        let half = 0.5 * h * h;
        let zero = || vec![0.0; rates.len()];
        Self {
            h,
            rows: [
                places,
                rates.iter().map(|w| w * h).collect(),
                forces.web.accelerations.iter().map(|a| a * half).collect(),
                zero(),
                zero(),
                zero(),
            ],
        }
    }

    #[inline]
    fn step<L: ContactLaw, S: Surface>(&mut self, forces: &mut LatticeForces<L, S>) -> bool {
        self.predict();
        let changed = forces.act(&self.rows[0], &self.rows[1], 1.0 / self.h);
        self.correct(&forces.web.accelerations);
        changed
    }

    fn coast(&mut self, steps: u64) {
        let coasted = steps as f64;
        let [places, rates, rest @ ..] = &mut self.rows;
        for (place, rate) in places.iter_mut().zip(rates) {
            *place += *rate * coasted;
        }
        // What is left of the rest has died away over the steps since the last contact.
        for row in rest {
            row.fill(0.0);
        }
    }

    fn places(&self) -> &[f64] {
        &self.rows[0]
    }

    fn rates(&self, _: &[f64], into: &mut Vec<f64>) {
        into.clear();
        into.extend(self.rows[1].iter().map(|r| r / self.h));
    }

    fn clear(&mut self) {
        self.rows.iter_mut().for_each(|row| flush(row));
    }
}

impl LatticeGear {
    /// The Taylor series, a step on.
    #[inline]
    fn predict(&mut self) {
        let [r0, r1, r2, r3, r4, r5] = &mut self.rows;
        let upper = r3.iter_mut().zip(r4).zip(r5.iter());
        let lower = r0.iter_mut().zip(r1).zip(r2);
        for (((a, b), c), ((d, e), f)) in lower.zip(upper) {
            [*a, *b, *c, *d, *e, _] = predicted([*a, *b, *c, *d, *e, *f]);
        }
    }

    /// Sets the derivatives right for these accelerations.
    #[inline]
    fn correct(&mut self, accelerations: &[f64]) {
        let half = 0.5 * self.h * self.h;
        let [r0, r1, r2, r3, r4, r5] = &mut self.rows;
        let upper = r3.iter_mut().zip(r4).zip(r5);
        let lower = r0.iter_mut().zip(r1).zip(r2);
        let rows = lower.zip(upper).zip(accelerations);
        for ((((a, b), c), ((d, e), f)), acceleration) in rows {
            [*a, *b, *c, *d, *e, *f] = corrected([*a, *b, *c, *d, *e, *f], acceleration * half);
        }
    }
}
