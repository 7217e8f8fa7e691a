//! Gear's fifth-order predictor–corrector, for forces that depend on velocity.
//!
//! State: the scaled derivatives r_k = (h^k/k!) d^k g/dt^k, k = 0..5. The predictor is
//! their Taylor series; the corrector adds c_k Δ, Δ = (h²/2) g̈ − r₂.

use super::chain::{Chain, forces};
use super::ground::Ground;
use super::stepper::{Stepper, flush};

/// Corrector coefficients for a second-order equation whose force depends on
/// velocity (3/16 in place of 3/20).
pub(crate) const CORRECTOR: [f64; 6] = [
    3.0 / 16.0,
    251.0 / 360.0,
    1.0,
    11.0 / 18.0,
    1.0 / 6.0,
    1.0 / 60.0,
];

pub(crate) struct Gear {
    h: f64,
    r: [Vec<f64>; 6],
    /// Contact forces; one more than gaps: the free end's is 0.
    forces: Vec<f64>,
    /// Power lost in each contact, summed over steps.
    lost: Vec<f64>,
    plate_power: f64,
}

/// Splits the six derivatives into slices of one known length, so that the loops
/// below need no bounds checks.
fn split(r: &mut [Vec<f64>; 6], n: usize) -> [&mut [f64]; 6] {
    r.each_mut().map(|row| &mut row[..n])
}

impl Gear {
    fn predict<C: Chain>(&mut self, chain: &C) -> bool {
        let n = self.lost.len();
        let per_step = 1.0 / self.h;
        let [r0, r1, r2, r3, r4, r5] = split(&mut self.r, n);
        let (forces, lost) = (&mut self.forces[..n], &mut self.lost[..n]);
        let mut changed = false;
        let mut predict = |i: usize| {
            let (a, b, c, d, e, f) = (r0[i], r1[i], r2[i], r3[i], r4[i], r5[i]);
            let g = a + b + c + d + e + f;
            let gh = b + 2.0 * c + 3.0 * d + 4.0 * e + 5.0 * f;
            changed |= (g <= 0.0) != (a <= 0.0);
            r0[i] = g;
            r1[i] = gh;
            r2[i] = c + 3.0 * d + 6.0 * e + 10.0 * f;
            r3[i] = d + 4.0 * e + 10.0 * f;
            r4[i] = e + 5.0 * f;
            (g, gh * per_step)
        };
        let mut push = |i: usize, (force, power): (f64, f64)| {
            forces[i] = force;
            lost[i] += power;
        };
        let (g, w) = predict(0);
        push(0, chain.floor(g, w));
        for i in 1..n {
            let (g, w) = predict(i);
            push(i, chain.pair(i, g, w));
        }
        changed
    }

    fn correct<C: Chain, G: Ground>(&mut self, chain: &C, ground: &G) -> bool {
        let n = self.lost.len();
        let half = 0.5 * self.h * self.h;
        let forces = &self.forces[..=n];
        let [r0, r1, r2, r3, r4, r5] = split(&mut self.r, n);
        let mut changed = false;
        let mut fix = |i: usize, acceleration: f64| {
            let delta = half * acceleration - r2[i];
            let g = r0[i] + CORRECTOR[0] * delta;
            changed |= (g <= 0.0) != (r0[i] <= 0.0);
            r0[i] = g;
            r1[i] += CORRECTOR[1] * delta;
            r2[i] += CORRECTOR[2] * delta;
            r3[i] += CORRECTOR[3] * delta;
            r4[i] += CORRECTOR[4] * delta;
            r5[i] += CORRECTOR[5] * delta;
        };
        fix(0, chain.first(forces) + ground.pull());
        for i in 1..n {
            fix(i, chain.acceleration(forces, i));
        }
        changed
    }
}

impl Stepper for Gear {
    fn start<C: Chain, G: Ground>(
        gaps: &[f64],
        rates: &[f64],
        h: f64,
        chain: &C,
        ground: &G,
    ) -> Self {
        let n = gaps.len();
        let forces = forces(chain, gaps, rates);
        let half = 0.5 * h * h;
        let mut r: [Vec<f64>; 6] = std::array::from_fn(|_| vec![0.0; n]);
        r[0].copy_from_slice(gaps);
        for i in 0..n {
            r[1][i] = h * rates[i];
            r[2][i] = half
                * if i == 0 {
                    chain.first(&forces) + ground.pull()
                } else {
                    chain.acceleration(&forces, i)
                };
        }
        Self {
            h,
            r,
            forces,
            lost: vec![0.0; n],
            plate_power: 0.0,
        }
    }

    fn step<C: Chain, G: Ground>(&mut self, chain: &C, ground: &mut G) -> bool {
        ground.step();
        let predicted = self.predict(chain);
        let corrected = self.correct(chain, ground);
        if G::MOVES {
            self.plate_power += self.forces[0] * ground.velocity();
        }
        predicted | corrected
    }

    fn coast(&mut self, steps: u64) {
        let [gaps, rates, derivatives @ ..] = &mut self.r;
        for (g, w) in gaps.iter_mut().zip(rates) {
            *g += steps as f64 * *w;
        }
        // What is left of them has died away over the steps since the last contact.
        for row in derivatives {
            row.fill(0.0);
        }
    }

    fn gaps(&self) -> &[f64] {
        &self.r[0]
    }

    fn rates(&self, into: &mut Vec<f64>) {
        into.clear();
        into.extend(self.r[1].iter().map(|r| r / self.h));
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
        for row in &mut self.r {
            flush(row);
        }
    }
}
