//! The motion of a stack on the floor while all its contacts stay closed.
//!
//! The gaps are the sum of two motions. One is the steady answer to weight and plate, known
//! in closed form. The other is a transient that obeys the same equations without weight and
//! plate. Its energy V can only fall, and moves contact i by at most √(2V/K_i). So no contact
//! opens while its steady overlap exceeds that. Until then the transient is propagated by
//! powers of a matrix, at a cost that does not grow with the time.

use nalgebra::{Complex, DMatrix, DVector};

use super::polynomial::ROWS;
use super::taylor::{Coupling, PHASE, TaylorSeries, expand, lanes};
use crate::math;
use crate::physics::plate::Plate;
use crate::physics::spring::Spring;

/// Longest rest planned at once with a transient, as a power of two of the propagator's step.
const POWERS: u32 = 16;
/// Part of the steady overlap that is kept in reserve against rounding.
const RESERVE: f64 = 1e-9;
/// A transient with less than this part of the elastic energy of the steady overlaps is set
/// to zero: it is their rounding, 10⁻¹⁴ of the overlaps.
const STILL: f64 = 1e-28;
/// Beads of the largest stack whose transient is propagated: a propagator has (2·64)² entries.
pub(super) const LARGEST: usize = 64;

/// A stack of beads that can rest: its steady answer and the propagators of its transient.
#[derive(Debug, Clone)]
pub(super) struct Stack {
    springs: Vec<Spring>,
    masses: Vec<f64>,
    /// Overlaps under the stack's own weight, m.
    weight: Vec<f64>,
    /// Complex amplitude X, m, of each gap's answer to the plate, which is Im(X e^{iθ}).
    answer: Vec<Complex<f64>>,
    /// 2π times the plate's frequency, 1/s.
    omega: f64,
    /// Step of the first propagator, s.
    h: f64,
    coupling: Coupling,
    /// Propagators of gaps and rates times h over h, 2h, 4h, ..., as far as they were needed.
    powers: Vec<DMatrix<f64>>,
}

/// How a stack moves apart from its steady answer, from the beginning of a rest on.
#[derive(Debug, Clone)]
pub(super) struct Transient {
    /// Gaps less the steady answer, then their rates times h.
    value: DVector<f64>,
    /// Its energy V, m²/s².
    energy: f64,
    /// Phase of the plate.
    phase: f64,
    /// How long all contacts stay closed for sure, s.
    pub lasts: f64,
}

impl Stack {
    /// The stack of these beads, lowest first, under gravity on a plate.
    pub fn new(springs: &[Spring], masses: &[f64], gravity: f64, plate: Plate) -> Self {
        let m = masses.len();
        let mut load = 0.0;
        let mut weight = vec![0.0; m];
        for i in (0..m).rev() {
            load += masses[i] * gravity;
            weight[i] = load / springs[i].stiffness;
        }
        let lanes = lanes(m);
        let mut coupling = Coupling::default();
        coupling.clear(lanes);
        let mut fastest = (0.0_f64, 0.0_f64);
        for i in 0..m {
            coupling.above[i] = 1.0 / masses[i];
            coupling.below[i] = if i == 0 { 0.0 } else { 1.0 / masses[i - 1] };
            // Gershgorin by columns: both neighbours together have what the diagonal has.
            let both = 2.0 * (coupling.above[i] + coupling.below[i]);
            fastest.0 = fastest.0.max(both * springs[i].stiffness);
            fastest.1 = fastest.1.max(both * springs[i].dashpot);
        }
        let h = PHASE / (fastest.0.sqrt() + fastest.1);
        Self {
            answer: answer(springs, masses, plate),
            springs: springs.to_vec(),
            masses: masses.to_vec(),
            weight,
            omega: plate.omega,
            h,
            coupling,
            powers: Vec::new(),
        }
    }

    /// Beads of the stack.
    pub fn beads(&self) -> usize {
        self.masses.len()
    }

    /// The propagator over h: what a step makes of each unit vector.
    fn propagator(&self) -> DMatrix<f64> {
        let size = 2 * self.masses.len();
        let columns: Vec<_> = (0..size)
            .map(|k| {
                let unit = DVector::from_fn(size, |i, _| f64::from(u8::from(i == k)));
                self.short(&unit, 1.0)
            })
            .collect();
        DMatrix::from_columns(&columns)
    }

    /// A transient `part` ≤ 1 steps later, by its Taylor series.
    fn short(&self, transient: &DVector<f64>, part: f64) -> DVector<f64> {
        let m = self.masses.len();
        let lanes = lanes(m);
        if part <= 0.0 {
            return transient.clone();
        }
        let h = part * self.h;
        let mut coupling = self.coupling.clone();
        for (i, spring) in self.springs.iter().enumerate() {
            coupling.stiffness[i] = spring.stiffness * h * h;
            coupling.dashpot[i] = spring.dashpot * h;
        }
        let mut rows = vec![0.0; ROWS * lanes];
        for i in 0..m {
            rows[i] = transient[i];
            rows[lanes + i] = transient[m + i] * part;
        }
        let mut forces = vec![0.0; lanes + 2];
        expand(&mut rows, &coupling, None, &mut forces);
        let (mut gaps, mut rates) = (vec![0.0; lanes], vec![0.0; lanes]);
        TaylorSeries::new(rows, lanes, 1.0).evaluate(1.0, &mut gaps, &mut rates);
        let slopes = rates[..m].iter().map(|rate| rate / part);
        DVector::from_iterator(2 * m, gaps[..m].iter().copied().chain(slopes))
    }
}

impl Stack {
    /// Steady gaps, m, and rates, m/s, when the plate is at `phase`.
    fn steady(&self, phase: f64) -> impl Iterator<Item = (f64, f64)> {
        let turn = math::cis(phase);
        let weights = self.weight.iter().zip(&self.answer);
        weights.map(move |(weight, answer)| {
            let now = answer * turn;
            (now.im - weight, self.omega * now.re)
        })
    }

    /// The transient of a stack with these gaps, m, and rates, m/s, when the plate is at
    /// `phase`, for at most `most` s; None if it may stay closed for a few steps only.
    pub fn rest(
        &mut self,
        gaps: &[f64],
        rates: &[f64],
        phase: f64,
        most: f64,
    ) -> Option<Transient> {
        let m = self.masses.len();
        let steady = self.steady(phase);
        let (y, u): (Vec<_>, Vec<_>) = steady
            .zip(gaps.iter().zip(rates))
            .map(|((x, v), (g, w))| (g - x, (w - v) * self.h))
            .unzip();
        let mut rest = Transient {
            value: DVector::from_iterator(2 * m, y.into_iter().chain(u)),
            energy: 0.0,
            phase,
            lasts: most,
        };
        rest.energy = self.energy(&rest.value);
        let weights = self.weight.iter().zip(&self.springs);
        let still: f64 = weights.map(|(x, spring)| spring.stiffness * x * x).sum();
        if rest.energy <= STILL * still {
            rest.value.fill(0.0);
            rest.energy = 0.0;
        } else if m > LARGEST {
            return None;
        }
        for i in 0..m {
            rest.lasts = rest.lasts.min(self.sure(i, rest.energy, phase));
        }
        let steps = rest.lasts / self.h;
        if steps <= 32.0 {
            return None;
        }
        if rest.energy > 0.0 {
            rest.lasts = rest.lasts.min(math::exp2(POWERS.into()) * self.h);
            let doublings = math::log2(steps).min(POWERS.into());
            while (self.powers.len() as f64) < doublings + 1.0 {
                let next = match self.powers.last() {
                    Some(last) => last * last,
                    None => self.propagator(),
                };
                self.powers.push(next);
            }
        }
        Some(rest)
    }

    /// How long contact `i` stays closed for sure, s, from `phase` of the plate on, with a
    /// transient of this energy.
    fn sure(&self, i: usize, energy: f64, phase: f64) -> f64 {
        let most = (2.0 * energy / self.springs[i].stiffness).sqrt();
        let spare = self.weight[i] * (1.0 - RESERVE) - most;
        let (size, lead) = math::polar(self.answer[i]);
        // It is closed while its answer |X| sin(θ + φ) is less than `spare`.
        let sine = spare / size;
        if spare <= 0.0 {
            return 0.0;
        }
        if sine >= 1.0 {
            return f64::INFINITY;
        }
        let angle = phase + lead;
        if math::sin(angle) >= sine {
            return 0.0;
        }
        (math::asin(sine) - angle).rem_euclid(std::f64::consts::TAU) / self.omega
    }

    /// Energy of a transient, m²/s².
    fn energy(&self, transient: &DVector<f64>) -> f64 {
        let m = self.masses.len();
        let mut velocity = 0.0;
        let mut energy = 0.0;
        for i in 0..m {
            velocity += transient[m + i] / self.h;
            let y = transient[i];
            energy +=
                0.5 * (self.masses[i] * velocity * velocity + self.springs[i].stiffness * y * y);
        }
        energy
    }

    /// The transient a time `tau` after the rest began: the part of a step by a series, whole
    /// steps by the propagators of their binary digits.
    pub fn later(&self, rest: &Transient, tau: f64) -> DVector<f64> {
        if rest.energy == 0.0 {
            return rest.value.clone();
        }
        let steps = tau / self.h;
        let mut transient = self.short(&rest.value, steps.fract());
        for (doubling, power) in self.powers.iter().enumerate() {
            let size = math::exp2(doubling as f64);
            if (steps.floor() / size) % 2.0 >= 1.0 {
                transient = power * transient;
            }
        }
        transient
    }

    /// Gaps, m, and rates, m/s, a time `tau` after the rest began, the transient being
    /// `now`.
    pub fn at(
        &self,
        rest: &Transient,
        tau: f64,
        now: &DVector<f64>,
        gaps: &mut [f64],
        rates: &mut [f64],
    ) {
        let m = self.masses.len();
        let phase = rest.phase + self.omega * tau;
        for (i, (x, v)) in self.steady(phase).enumerate() {
            gaps[i] = x + now[i];
            rates[i] = v + now[m + i] / self.h;
        }
    }

    /// Energy that the contacts lose in a time `tau` after the rest began, m²/s², the
    /// transient then being `now`: what the transient has lost, and what the dashpots take
    /// from the steady answer, ∫ Σ c Ẋ² dt.
    pub fn lost(&self, rest: &Transient, tau: f64, now: &DVector<f64>) -> f64 {
        let spent = rest.energy - self.energy(now);
        let follow = |(x, spring): (&Complex<f64>, &Spring)| {
            let (size, lead) = math::polar(x * self.omega);
            let from = 2.0 * (rest.phase + lead);
            let swing =
                (math::sin(from + 2.0 * self.omega * tau) - math::sin(from)) / (4.0 * self.omega);
            spring.dashpot * size * size * (0.5 * tau + swing)
        };
        if self.omega == 0.0 {
            return spent;
        }
        spent
            + self
                .answer
                .iter()
                .zip(&self.springs)
                .map(follow)
                .sum::<f64>()
    }
}

/// The stack's answer to a plate: amplitudes of its gaps, relative to e^{iθ}.
///
/// With U_i the movement of bead i over the plate, −ω²m_iU_i = F_i − F_{i+1} + m_iAω² and
/// F_i = −(K_i + iωc_i)X_i. Upwards from an unknown X₀, every F is a constant plus a multiple
/// of X₀. There is no force above the top bead, which gives X₀. The forces are then added up
/// from the top, without loss of digits.
fn answer(springs: &[Spring], masses: &[f64], plate: Plate) -> Vec<Complex<f64>> {
    type C = Complex<f64>;
    let (zero, one) = (C::new(0.0, 0.0), C::new(1.0, 0.0));
    let squared = plate.omega * plate.omega;
    let give = |spring: &Spring| C::new(spring.stiffness, plate.omega * spring.dashpot);
    // Each as (constant, multiple of X₀).
    let mut force = (zero, -give(&springs[0]));
    let mut movement = (zero, one);
    let mut movements = vec![movement];
    for (spring, mass) in springs[1..].iter().zip(masses) {
        force.0 += (movement.0 + plate.amplitude) * (mass * squared);
        force.1 += movement.1 * (mass * squared);
        movement.0 -= force.0 / give(spring);
        movement.1 -= force.1 / give(spring);
        movements.push(movement);
    }
    let top = masses[masses.len() - 1] * squared;
    force.0 += (movement.0 + plate.amplitude) * top;
    force.1 += movement.1 * top;
    let first = -force.0 / force.1;
    let mut force = zero;
    let mut answer = vec![zero; springs.len()];
    for i in (0..springs.len()).rev() {
        let movement = movements[i].0 + movements[i].1 * first;
        force -= (movement + plate.amplitude) * (masses[i] * squared);
        answer[i] = -force / give(&springs[i]);
    }
    answer
}

#[cfg(test)]
mod tests;
