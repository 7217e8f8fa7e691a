//! Gragg-Bulirsch-Stoer extrapolation of the modified midpoint rule, of variable order up to
//! 2·[`COLUMNS`] (Hairer, Nørsett & Wanner, Solving Ordinary Differential Equations I, II.9).
//!
//! What is extrapolated are increments, not values: a gap of a millimetre that changes by a
//! picometre keeps its digits.

use crate::math;

/// Most columns of the tableau.
const COLUMNS: usize = 6;
/// Columns from which on an estimate of the error is believed.
const LEAST: usize = 3;

/// Substeps of row k: 2, 4, 6, …
fn substeps(k: usize) -> u32 {
    2 * (u32::try_from(k).expect("a few columns") + 1)
}

/// Evaluations of the derivative for rows 0 to k and the one at the start: 1 + Σ (2j + 2).
fn work(k: usize) -> f64 {
    let rows = (k + 1) as f64;
    1.0 + rows * (rows + 1.0)
}

/// What the attempt at a step came to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Attempt {
    /// Whether it meets the tolerance.
    pub good: bool,
    /// The step to take next, or instead if it does not, s.
    pub next: f64,
}

/// The method, with its tableau and buffers.
#[derive(Clone)]
pub(super) struct Extrapolation {
    /// Row j is the extrapolation of the newest j + 1 midpoint rows.
    rows: [Vec<f64>; COLUMNS],
    /// The row that is the last step's result.
    last: usize,
    /// The derivative at the start of a step.
    first: Vec<f64>,
    slope: Vec<f64>,
    value: Vec<f64>,
    before: Vec<f64>,
    now: Vec<f64>,
}

impl Extrapolation {
    pub fn new(len: usize) -> Self {
        let empty = || vec![0.0; len];
        Self {
            rows: std::array::from_fn(|_| empty()),
            last: 0,
            first: empty(),
            slope: empty(),
            value: empty(),
            before: empty(),
            now: empty(),
        }
    }

    /// The increment that the last step came to.
    pub fn increment(&self) -> &[f64] {
        &self.rows[self.last]
    }

    /// The derivative at the start of the last step.
    pub fn first(&self) -> &[f64] {
        &self.first
    }

    /// Tries a step of `h` s from `y`. `rate` writes the derivative of a state at a time since
    /// the start. Increment i may be wrong by `allowed[i]`, or by anything if there is no entry.
    pub fn step(
        &mut self,
        rate: &impl Fn(f64, &[f64], &mut [f64]),
        y: &[f64],
        h: f64,
        allowed: &[f64],
    ) -> Attempt {
        rate(0.0, y, &mut self.first);
        let mut next = (f64::INFINITY, h);
        for k in 0..COLUMNS {
            self.midpoint(rate, y, h, k);
            let error = self.extrapolate(k, allowed);
            if k + 1 < LEAST {
                continue;
            }
            // False for NaN.
            let good = error <= 1.0;
            // The error goes with h to the power 2k + 1. The cheapest column per time decides.
            let power = 1.0 / (2 * k + 1) as f64;
            let factor = (SAFETY / math::powf(error.max(1e-12), power)).clamp(0.1, GROWTH);
            let cost = work(k) / factor;
            if cost < next.0 {
                next = (cost, h * factor);
            }
            if good {
                return Attempt { good, next: next.1 };
            }
            if k + 1 == COLUMNS {
                let factor = if error.is_finite() { factor } else { 0.1 };
                return Attempt {
                    good,
                    next: h * factor.min(0.7),
                };
            }
        }
        unreachable!("the last column decides");
    }

    /// Writes the increment by the modified midpoint rule, in the substeps of row `k`, to `now`.
    fn midpoint(&mut self, rate: &impl Fn(f64, &[f64], &mut [f64]), y: &[f64], h: f64, k: usize) {
        let count = substeps(k);
        let step = h / f64::from(count);
        self.before.fill(0.0);
        for (now, first) in self.now.iter_mut().zip(&self.first) {
            *now = step * first;
        }
        for j in 1..count {
            for ((value, y), now) in self.value.iter_mut().zip(y).zip(&self.now) {
                *value = y + now;
            }
            rate(f64::from(j) * step, &self.value, &mut self.slope);
            for ((before, now), slope) in self.before.iter_mut().zip(&mut self.now).zip(&self.slope)
            {
                (*before, *now) = (*now, *before + 2.0 * step * slope);
            }
        }
    }

    /// Extrapolates with `now` as row `k`, by the Aitken-Neville scheme in the square of the
    /// substep. The error over what is allowed, the largest of all increments: the error of each
    /// is taken to be the last change.
    fn extrapolate(&mut self, k: usize, allowed: &[f64]) -> f64 {
        let mut factors = [0.0; COLUMNS];
        for (j, factor) in factors.iter_mut().enumerate().take(k) {
            let ratio = f64::from(substeps(k)) / f64::from(substeps(k - j - 1));
            *factor = 1.0 / (ratio * ratio - 1.0);
        }
        self.last = k;
        let mut error = 0.0f64;
        for i in 0..self.now.len() {
            let (mut better, mut change) = (self.now[i], f64::INFINITY);
            for (row, factor) in self.rows[..k].iter_mut().zip(&factors) {
                change = (better - row[i]) * factor;
                row[i] = better;
                better += change;
            }
            self.rows[k][i] = better;
            if let Some(allowed) = allowed.get(i) {
                let ratio = change.abs() / allowed;
                // NaN counts as an error.
                error = if ratio <= error { error } else { ratio };
            }
        }
        error
    }
}

/// Part that is taken of the step that the tolerance would just allow.
const SAFETY: f64 = 0.8;
/// Largest growth of the step.
const GROWTH: f64 = 6.0;
