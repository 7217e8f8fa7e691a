//! Gear's fifth-order predictor–corrector, for forces that depend on velocity (Gear 1971; Allen
//! & Tildesley, Computer Simulation of Liquids, 1987).
//!
//! The state is the scaled derivatives r_k = (h^k/k!) d^k g/dt^k, k = 0..5. The predictor is
//! their Taylor series. The corrector adds c_k Δ to each, where Δ = (h²/2) g̈ − r₂.

use super::chain::{Chain, Forces};
use super::pace::Pace;
use super::stepper::{Power, Stepper};
use crate::physics::ground::Ground;
use crate::physics::lanes::{
    BEYOND, LANES, Lane, Number, changed, flush, flushed, grouped, neighbours,
};

/// Gear's coefficients c_k for a second-order equation. The first is 3/16 where the force
/// depends on velocity, 3/20 where it does not.
pub(crate) const CORRECTOR: [f64; 6] = [
    3.0 / 16.0,
    251.0 / 360.0,
    1.0,
    11.0 / 18.0,
    1.0 / 6.0,
    1.0 / 60.0,
];

/// r₀ to r₅ of one number that moves, or of a group.
pub(crate) type Derivatives<T> = [T; 6];

#[derive(Clone)]
pub(crate) struct Gear {
    n: usize,
    h: f64,
    floor: Derivatives<f64>,
    rest: Vec<Derivatives<Lane>>,
    forces: Forces,
}

/// The Taylor series, a step on: Pascal's triangle, in sums alone.
#[inline]
pub(crate) fn predicted<T: Number>([a, b, c, d, e, f]: Derivatives<T>) -> Derivatives<T> {
    let e1 = e + f;
    let d1 = d + e1;
    let c1 = c + d1;
    let b1 = b + c1;
    let e2 = e1 + f;
    let d2 = d1 + e2;
    let c2 = c1 + d2;
    let e3 = e2 + f;
    let d3 = d2 + e3;
    let e4 = e3 + f;
    [a + b1, b1 + c2, c2 + d3, d3 + e4, e4 + f, f]
}

/// The derivatives corrected, where the forces say that r₂ is `truth`.
#[inline]
pub(crate) fn corrected<T: Number>([a, b, c, d, e, f]: Derivatives<T>, truth: T) -> Derivatives<T> {
    let delta = truth - c;
    [
        a + delta * CORRECTOR[0],
        b + delta * CORRECTOR[1],
        c + delta * CORRECTOR[2],
        d + delta * CORRECTOR[3],
        e + delta * CORRECTOR[4],
        f + delta * CORRECTOR[5],
    ]
}

impl Stepper for Gear {
    fn start<C: Chain, G: Ground>(
        gaps: &[f64],
        rates: &[f64],
        h: f64,
        chain: &mut C,
        ground: &Pace<G>,
    ) -> Self {
        let grouped_gaps = grouped(gaps, BEYOND);
        let forces = Forces::new(chain, (gaps[0], &grouped_gaps), rates);
        let (first, rest) = forces.accelerations(chain, ground.pull());
        let half = 0.5 * h * h;
        let derivatives = grouped_gaps.iter().zip(grouped(rates, 0.0)).zip(rest);
        let zero = Lane::ZERO;
        Self {
            n: gaps.len(),
            h,
            floor: [gaps[0], rates[0] * h, first * half, 0.0, 0.0, 0.0],
            rest: derivatives
                .map(|((g, w), a)| [*g, w * h, a * half, zero, zero, zero])
                .collect(),
            forces,
        }
    }

    #[inline]
    fn step<C: Chain, G: Ground>(
        &mut self,
        chain: &mut C,
        ground: &mut Pace<G>,
        power: &mut Power,
    ) -> bool {
        ground.step();
        let r = predicted(self.floor);
        let (force, lost) = chain.floor(r[0], r[1] / self.h);
        power.lost.0 += lost;
        if G::MOVES {
            power.plate += force * ground.velocity();
        }
        self.forces.floor = force;
        let mut any = self.predict(chain, &mut power.lost.1);
        any |= self.correct(chain);
        let acceleration = chain.first(force, self.forces.second()) + ground.pull();
        let r = corrected(r, acceleration * (0.5 * self.h * self.h));
        let floor = (r[0] <= 0.0) != (self.floor[0] <= 0.0);
        self.floor = r;
        any.any() || floor
    }

    fn coast(&mut self, steps: u64) {
        // What is left of the rest has died away over the steps since the last contact.
        let coasted = steps as f64;
        let [g, w, ..] = self.floor;
        self.floor = [g + w * coasted, w, 0.0, 0.0, 0.0, 0.0];
        let zero = Lane::ZERO;
        for r in &mut self.rest {
            let [g, w, ..] = *r;
            *r = [g + w * coasted, w, zero, zero, zero, zero];
        }
    }

    fn gaps(&self) -> impl Iterator<Item = f64> {
        self.derivative(0)
    }

    fn rates<C: Chain, G: Ground>(&self, _: &C, _: &Pace<G>) -> Vec<f64> {
        self.derivative(1).map(|r| r / self.h).collect()
    }

    fn clear(&mut self) {
        self.floor = self.floor.map(flushed);
        flush(self.rest.as_flattened_mut());
    }
}

impl Gear {
    /// r_k of all gaps.
    fn derivative(&self, k: usize) -> impl Iterator<Item = f64> {
        let rest = self.rest.iter().flat_map(move |r| r[k].to_array());
        std::iter::once(self.floor[k]).chain(rest).take(self.n)
    }

    /// Predicts all gaps but the floor's, and the forces in them; which lanes changed.
    #[inline]
    fn predict<C: Chain>(&mut self, chain: &mut C, lost: &mut Lane) -> Lane {
        let (mut sum, mut any) = (*lost, Lane::ZERO);
        let per_step = 1.0 / self.h;
        let gaps = self.rest.iter_mut().zip(&mut self.forces.rest);
        for (k, (r, force)) in gaps.enumerate() {
            let next = predicted(*r);
            let (push, power) = chain.pairs(k, next[0], next[1] * per_step);
            any |= changed(r[0], next[0]);
            sum += power;
            (*r, *force) = (next, push);
        }
        *lost = sum;
        any
    }

    /// Corrects all gaps but the floor's for the forces predicted; which lanes changed.
    #[inline]
    fn correct<C: Chain>(&mut self, chain: &C) -> Lane {
        let mut any = Lane::ZERO;
        let half = 0.5 * self.h * self.h;
        let mut under = self.forces.floor;
        let forces = self.forces.rest.iter().zip(&self.forces.rest[1..]);
        for (k, (r, (&here, &over))) in self.rest.iter_mut().zip(forces).enumerate() {
            let (below, above) = neighbours(under, here, over);
            under = here.to_array()[LANES - 1];
            let acceleration = chain.accelerations(k, below, here, above);
            let next = corrected(*r, acceleration * half);
            any |= changed(r[0], next[0]);
            *r = next;
        }
        any
    }
}
