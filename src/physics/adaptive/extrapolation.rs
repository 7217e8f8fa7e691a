//! Extrapolation of the modified midpoint rule (Gragg, Bulirsch, Stoer), of variable
//! order up to 2·[`COLUMNS`].
//!
//! Increments are extrapolated, not values: a gap of a millimetre that changes by a
//! picometre keeps its digits.

use crate::math;

/// Most columns of the tableau.
const COLUMNS: usize = 6;
/// Columns before which no agreement is believed.
const LEAST: usize = 3;

/// Substeps of row k: 2, 4, 6, …
fn substeps(k: usize) -> u32 {
    2 * (u32::try_from(k).expect("a few columns") + 1)
}

/// Evaluations up to and with row k, the first one at the start included.
fn work(k: usize) -> f64 {
    let rows = (k + 1) as f64;
    1.0 + rows * (rows + 1.0)
}

/// What a step came to.
#[derive(Debug, Clone, Copy)]
pub(super) struct Verdict {
    /// Whether it meets the tolerance.
    pub good: bool,
    /// The step to take next, or instead, s.
    pub next: f64,
}

/// Tableau and buffers.
pub(super) struct Extrapolation {
    rows: [Vec<f64>; COLUMNS],
    /// The row that the last step was taken from.
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

    /// Tries a step of `h` s from `y`, whose derivative `rate` writes; `allowed` is what
    /// each of the first increments may be wrong by; those without an entry are free.
    pub fn step(
        &mut self,
        rate: &impl Fn(f64, &[f64], &mut [f64]),
        y: &[f64],
        h: f64,
        allowed: &[f64],
    ) -> Verdict {
        rate(0.0, y, &mut self.first);
        let mut next = (f64::INFINITY, h);
        for k in 0..COLUMNS {
            self.midpoint(rate, y, h, k);
            let error = self.extrapolate(k, allowed);
            if k + 1 < LEAST {
                continue;
            }
            // A NaN is no agreement.
            let good = error <= 1.0;
            let power = 1.0 / (2 * k + 1) as f64;
            let factor = (SAFETY / math::powf(error.max(1e-12), power)).clamp(0.1, GROWTH);
            let cost = work(k) / factor;
            if cost < next.0 {
                next = (cost, h * factor);
            }
            if good {
                return Verdict { good, next: next.1 };
            }
            if k + 1 == COLUMNS {
                let factor = if error.is_finite() { factor } else { 0.1 };
                return Verdict {
                    good,
                    next: h * factor.min(0.7),
                };
            }
        }
        unreachable!("the last column decides");
    }

    /// The increment by the midpoint rule in the substeps of row `k`, into `now`.
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

    /// Extrapolates with `now` as the newest row `k` (Aitken, Neville): row j of the
    /// tableau becomes the extrapolation of the newest j + 1 midpoint rows. The largest
    /// last change over what is allowed.
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
                // A NaN must not hide.
                error = if ratio <= error { error } else { ratio };
            }
        }
        error
    }
}

/// Part of the step that the tolerance would just allow.
const SAFETY: f64 = 0.8;
/// Largest growth of the step.
const GROWTH: f64 = 6.0;
