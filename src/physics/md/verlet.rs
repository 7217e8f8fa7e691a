//! Velocity Verlet. The dashpot needs the velocity at the end of a step before that is known.
//! It gets the velocity that the old acceleration predicts.
//!
//! The kick that ends a step and the kick that begins the next are done in one pass. Rates are
//! kept as they are before both.

use super::chain::{Chain, Forces};
use super::pace::Pace;
use super::stepper::{Power, Stepper};
use crate::physics::ground::Ground;
use crate::physics::lanes::{
    BEYOND, LANES, Lane, Number, changed, flush, flushed, grouped, neighbours, singly,
};

#[derive(Clone)]
pub(crate) struct Verlet {
    n: usize,
    h: f64,
    /// The floor's gap, and its rate half a step ago.
    floor: (f64, f64),
    gaps: Vec<Lane>,
    /// Rates half a step ago.
    rates: Vec<Lane>,
    /// Contact forces now, and room for the next ones.
    forces: Forces,
    next: Vec<Lane>,
}

/// A step: gap, rate in the middle, and rate predicted for the end.
#[inline]
fn drift<T: Number>(g: T, before: T, acceleration: T, h: f64) -> (T, T, T) {
    let kick = acceleration * (0.5 * h);
    let half = (before + kick) + kick;
    (g + half * h, half, half + kick)
}

impl Stepper for Verlet {
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
        let before = |(w, a): (Lane, Lane)| w - a * (0.5 * h);
        Self {
            n: gaps.len(),
            h,
            floor: (gaps[0], rates[0] - first * (0.5 * h)),
            rates: grouped(rates, 0.0)
                .into_iter()
                .zip(rest)
                .map(before)
                .collect(),
            next: forces.rest.clone(),
            gaps: grouped_gaps,
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
        let (was, before) = self.floor;
        let acceleration = chain.first(self.forces.floor, self.forces.second()) + ground.pull();
        let (g, half, w) = drift(was, before, acceleration, self.h);
        let (force, lost) = chain.floor(g, w);
        self.floor = (g, half);
        power.lost.0 += lost;
        ground.step();
        if G::MOVES {
            power.plate += force * ground.velocity();
        }
        let changed = self.pairs(chain, &mut power.lost.1);
        self.forces.floor = force;
        std::mem::swap(&mut self.forces.rest, &mut self.next);
        changed || (g <= 0.0) != (was <= 0.0)
    }

    fn coast(&mut self, steps: u64) {
        let flight = steps as f64 * self.h;
        self.floor.0 += flight * self.floor.1;
        for (g, w) in self.gaps.iter_mut().zip(&self.rates) {
            *g += *w * flight;
        }
    }

    fn gaps(&self) -> impl Iterator<Item = f64> {
        std::iter::once(self.floor.0)
            .chain(singly(&self.gaps))
            .take(self.n)
    }

    fn rates<C: Chain, G: Ground>(&self, chain: &C, ground: &Pace<G>) -> Vec<f64> {
        let (first, rest) = self.forces.accelerations(chain, ground.pull());
        let kicked = self
            .rates
            .iter()
            .zip(rest)
            .map(|(w, a)| *w + a * (0.5 * self.h));
        std::iter::once(self.floor.1 + first * (0.5 * self.h))
            .chain(singly(&kicked.collect::<Vec<_>>()))
            .take(self.n)
            .collect()
    }

    fn clear(&mut self) {
        self.floor = (flushed(self.floor.0), flushed(self.floor.1));
        flush(&mut self.gaps);
        flush(&mut self.rates);
    }
}

impl Verlet {
    /// A step of all gaps but the floor's; the forces go to `next`.
    #[inline]
    fn pairs<C: Chain>(&mut self, chain: &mut C, lost: &mut Lane) -> bool {
        let (mut sum, mut any) = (*lost, Lane::ZERO);
        let (mut under, h) = (self.forces.floor, self.h);
        let forces = self.forces.rest.iter().zip(&self.forces.rest[1..]);
        let gaps = self.gaps.iter_mut().zip(&mut self.rates);
        let gaps = gaps.zip(&mut self.next);
        for (k, (((gap, rate), next), (&here, &over))) in gaps.zip(forces).enumerate() {
            let (below, above) = neighbours(under, here, over);
            under = here.to_array()[LANES - 1];
            let acceleration = chain.accelerations(k, below, here, above);
            let (g, half, w) = drift(*gap, *rate, acceleration, h);
            let (force, power) = chain.pairs(k, g, w);
            any |= changed(*gap, g);
            sum += power;
            (*gap, *rate, *next) = (g, half, force);
        }
        *lost = sum;
        any.any()
    }
}
