//! Means over the periods of a column under gravity, with standard errors that know
//! that neighbours are alike.

use super::fit::standard_error;
use crate::math;
use crate::physics::Observation;
use std::ops::Range;

/// Means over one period.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
struct Block {
    height: f64,
    relative: f64,
    kinetic: f64,
}

/// A mean and its standard error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Mean {
    /// The mean.
    pub value: f64,
    /// Its standard error; none of too few periods, and of what does not scatter.
    pub error: Option<f64>,
}

/// What looks at a column add up to, period by period.
#[derive(Debug, Clone, Default)]
pub(super) struct Means {
    looks: usize,
    open: Block,
    in_open: usize,
    blocks: Vec<Block>,
}

impl Means {
    /// Of so many looks in a period.
    pub fn new(looks: usize) -> Self {
        Self {
            looks,
            ..Self::default()
        }
    }

    /// One look.
    pub fn look(&mut self, seen: &Observation) {
        let part = 1.0 / self.looks as f64;
        self.open.height += seen.centre * part;
        self.open.relative += seen.energy.relative * part;
        self.open.kinetic += seen.energy.kinetic * part;
        self.in_open += 1;
        if self.in_open == self.looks {
            self.blocks.push(std::mem::take(&mut self.open));
            self.in_open = 0;
        }
    }

    /// Complete periods.
    pub fn periods(&self) -> usize {
        self.blocks.len()
    }

    /// All of them.
    pub fn all(&self) -> Range<usize> {
        0..self.blocks.len()
    }

    /// Mean of the centre's height over the resting column's, m, in some of the periods.
    pub fn height(&self, of: Range<usize>) -> Option<Mean> {
        self.mean(of, |block| block.height)
    }

    /// Mean E_r over mean E in some of the periods: a ratio of means, since E passes
    /// through 0.
    pub fn share(&self, of: Range<usize>) -> Option<Mean> {
        let relative = self.mean(of.clone(), |b| b.relative)?;
        let kinetic = self.mean(of.clone(), |b| b.kinetic)?;
        if kinetic.value <= 0.0 {
            return None;
        }
        let value = relative.value / kinetic.value;
        if value < f64::EPSILON {
            // A single bead, or a cluster whose differences are rounding.
            return Some(Mean {
                value: 0.0,
                error: None,
            });
        }
        // What each period adds to the ratio's deviation.
        let deviations = self.mean(of, |b| (b.relative - value * b.kinetic) / kinetic.value)?;
        Some(Mean {
            value,
            error: deviations.error,
        })
    }

    fn mean(&self, of: Range<usize>, number: impl Fn(&Block) -> f64) -> Option<Mean> {
        let values: Vec<f64> = self.blocks.get(of)?.iter().map(number).collect();
        (!values.is_empty()).then(|| Mean {
            value: values.iter().sum::<f64>() / values.len() as f64,
            error: standard_error(&values),
        })
    }
}

impl Mean {
    /// Distance from another in units of both standard errors together.
    pub fn in_errors_from(self, other: Self) -> Option<f64> {
        let both = math::hypot(self.error?, other.error?);
        (both > 0.0).then(|| (self.value - other.value).abs() / both)
    }
}
