//! Velocity Verlet. The dashpot needs the velocity at the end of the step before it
//! is known; it gets the one that the old acceleration predicts.

use super::chain::{Chain, forces};
use super::ground::Ground;
use super::stepper::{Stepper, flush};

pub(crate) struct Verlet {
    h: f64,
    gaps: Vec<f64>,
    rates: Vec<f64>,
    accelerations: Vec<f64>,
    /// Contact forces; one more than gaps: the free end's is 0.
    forces: Vec<f64>,
    /// Power lost in each contact, summed over steps.
    lost: Vec<f64>,
    plate_power: f64,
}

impl Verlet {
    fn accelerate<C: Chain, G: Ground>(&mut self, chain: &C, ground: &G) {
        let n = self.gaps.len();
        let forces = &self.forces[..=n];
        let accelerations = &mut self.accelerations[..n];
        for i in 1..n {
            accelerations[i] = chain.acceleration(forces, i);
        }
        accelerations[0] = chain.first(forces) + ground.pull();
    }
}

impl Stepper for Verlet {
    fn start<C: Chain, G: Ground>(
        gaps: &[f64],
        rates: &[f64],
        h: f64,
        chain: &C,
        ground: &G,
    ) -> Self {
        let n = gaps.len();
        let mut verlet = Self {
            h,
            gaps: gaps.to_vec(),
            rates: rates.to_vec(),
            accelerations: vec![0.0; n],
            forces: forces(chain, gaps, rates),
            lost: vec![0.0; n],
            plate_power: 0.0,
        };
        verlet.accelerate(chain, ground);
        verlet
    }

    fn step<C: Chain, G: Ground>(&mut self, chain: &C, ground: &mut G) -> bool {
        ground.step();
        let (n, h) = (self.gaps.len(), self.h);
        let gaps = &mut self.gaps[..n];
        let rates = &mut self.rates[..n];
        let accelerations = &mut self.accelerations[..n];
        let forces = &mut self.forces[..=n];
        let lost = &mut self.lost[..n];
        let mut changed = false;
        let mut drift = |i: usize| {
            let kick = 0.5 * h * accelerations[i];
            let half = rates[i] + kick;
            let g = gaps[i] + h * half;
            changed |= (g <= 0.0) != (gaps[i] <= 0.0);
            gaps[i] = g;
            rates[i] = half;
            (g, half + kick)
        };
        let mut push = |i: usize, (force, power): (f64, f64)| {
            forces[i] = force;
            lost[i] += power;
        };
        let (g, w) = drift(0);
        push(0, chain.floor(g, w));
        for i in 1..n {
            let (g, w) = drift(i);
            push(i, chain.pair(i, g, w));
        }
        for i in 1..n {
            accelerations[i] = chain.acceleration(forces, i);
            rates[i] += 0.5 * h * accelerations[i];
        }
        accelerations[0] = chain.first(forces) + ground.pull();
        rates[0] += 0.5 * h * accelerations[0];
        if G::MOVES {
            self.plate_power += forces[0] * ground.velocity();
        }
        changed
    }

    fn coast(&mut self, steps: u64) {
        let flight = steps as f64 * self.h;
        for (g, w) in self.gaps.iter_mut().zip(&self.rates) {
            *g += flight * w;
        }
    }

    fn gaps(&self) -> &[f64] {
        &self.gaps
    }

    fn rates(&self, into: &mut Vec<f64>) {
        self.rates.clone_into(into);
    }

    fn lost(&self) -> f64 {
        self.lost.iter().sum()
    }

    fn plate_work(&self) -> f64 {
        self.plate_power
    }

    fn clear(&mut self) {
        self.lost.fill(0.0);
        self.plate_power = 0.0;
        flush(&mut self.gaps);
        flush(&mut self.rates);
        flush(&mut self.accelerations);
    }
}
