//! Trace samples on their way to the screen: bounded, and without a gap.

use std::collections::VecDeque;

use crate::physics::{Discs, Observation};

/// Lines that a trace can show; taller columns show every k-th bead.
const LINES: usize = 64;

/// One column in a sample. Single precision: it is drawn, not computed with.
#[derive(Debug, Clone, PartialEq)]
pub struct ColumnSample {
    /// Height of the floor, m.
    pub floor: f32,
    /// Reduced heights of the beads that have a line, bottom to top, m.
    pub reduced: Vec<f32>,
    /// Kinetic energy E, m²/s².
    pub kinetic: f64,
    /// Kinetic energy relative to the centre of mass E_r, m²/s².
    pub relative: f64,
    /// The largest error of a bead's height that was known then, m.
    pub error: Option<f64>,
}

/// The columns at one moment.
#[derive(Debug, Clone, PartialEq)]
pub struct Sample {
    /// Simulated time, s.
    pub time: f64,
    /// One row a column; none where its engine has failed.
    pub rows: Vec<Option<ColumnSample>>,
}

impl Sample {
    /// About how much memory it takes, bytes.
    pub(super) fn bytes(&self) -> usize {
        let lines = |row: &ColumnSample| size_of_val(row.reduced.as_slice());
        let rows = size_of_val(self.rows.as_slice());
        size_of::<Self>() + rows + self.rows.iter().flatten().map(lines).sum::<usize>()
    }
}

/// The newest samples, at most as many as the screen can show.
///
/// What is given up when more arrive is what the sweep has written over by then.
#[derive(Debug, Clone)]
pub struct History {
    samples: VecDeque<Sample>,
    capacity: usize,
}

impl ColumnSample {
    /// The row of one observation and the error known of it, its beads thinned to the lines
    /// of a trace; a row of a lattice has one line.
    pub fn of(seen: &Observation, error: Option<f64>) -> ColumnSample {
        #[expect(clippy::cast_possible_truncation, reason = "drawn, not computed with")]
        let single = |x: f64| x as f32;
        let means = seen.discs.as_ref().map(|discs| means(seen, discs));
        let heights = means.as_ref().unwrap_or(&seen.reduced);
        let stride = stride(heights.len());
        ColumnSample {
            floor: single(seen.floor),
            reduced: heights
                .iter()
                .rev()
                .step_by(stride)
                .rev()
                .map(|&z| single(z))
                .collect(),
            kinetic: seen.energy.kinetic,
            relative: seen.energy.relative,
            error,
        }
    }
}

/// Mean reduced heights of the rows of a lattice, m.
fn means(seen: &Observation, discs: &Discs) -> Vec<f64> {
    let rows = seen.reduced.chunks(discs.columns.max(1));
    rows.map(|row| row.iter().sum::<f64>() / row.len() as f64)
        .collect()
}

/// Every how many-th bead of a column of `beads` has a line.
pub fn stride(beads: usize) -> usize {
    beads.div_ceil(LINES).max(1)
}

impl History {
    /// An empty history that keeps `capacity` samples.
    pub fn new(capacity: usize) -> History {
        History {
            samples: VecDeque::new(),
            capacity: capacity.max(1),
        }
    }

    /// The samples, oldest first.
    pub fn iter(&self) -> impl DoubleEndedIterator<Item = &Sample> + Clone {
        self.samples.iter()
    }

    /// Number of samples that can be kept.
    pub fn capacity(&self) -> usize {
        self.capacity
    }

    /// Number of samples kept.
    pub fn len(&self) -> usize {
        self.samples.len()
    }

    /// Whether no sample is kept.
    pub fn is_empty(&self) -> bool {
        self.samples.is_empty()
    }

    /// The newest sample.
    pub fn last(&self) -> Option<&Sample> {
        self.samples.back()
    }

    /// Forgets every sample.
    pub fn clear(&mut self) {
        self.samples.clear();
    }

    /// Forgets the samples taken before `time`.
    pub fn forget_before(&mut self, time: f64) {
        self.samples.retain(|sample| sample.time >= time);
    }

    /// Keeps at most `capacity` samples from now on.
    pub fn set_capacity(&mut self, capacity: usize) {
        self.capacity = capacity.max(1);
        self.trim();
    }

    /// Adds a sample. Time only grows: a sample of an earlier time is a fresh start.
    pub fn push(&mut self, sample: Sample) {
        if self.last().is_some_and(|last| last.time > sample.time) {
            self.clear();
        }
        self.samples.push_back(sample);
        self.trim();
    }

    /// Adds the samples of a later history.
    pub fn append(&mut self, later: History) {
        for sample in later.samples {
            self.push(sample);
        }
    }

    fn trim(&mut self) {
        let surplus = self.samples.len().saturating_sub(self.capacity);
        self.samples.drain(..surplus);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sample(time: f64) -> Sample {
        Sample {
            time,
            rows: vec![None],
        }
    }

    #[test]
    fn keeps_the_newest() {
        let mut history = History::new(3);
        for k in 0..10 {
            history.push(sample(f64::from(k)));
        }
        let times: Vec<f64> = history.iter().map(|s| s.time).collect();
        assert_eq!(times, [7.0, 8.0, 9.0]);
    }

    #[test]
    fn an_earlier_time_starts_afresh() {
        let mut history = History::new(8);
        history.push(sample(5.0));
        let mut later = History::new(8);
        later.push(sample(0.0));
        history.append(later);
        assert_eq!(history.len(), 1);
    }

    #[test]
    fn a_row_of_a_lattice_has_one_line() {
        let discs = Discs {
            columns: 3,
            ..Discs::default()
        };
        let seen = Observation {
            reduced: vec![1.0, 2.0, 6.0, 4.0, 5.0, 6.0],
            discs: Some(discs),
            ..Observation::default()
        };
        assert_eq!(ColumnSample::of(&seen, None).reduced, [3.0, 5.0]);
    }

    #[test]
    fn tall_columns_are_thinned_and_keep_the_top() {
        let seen = Observation {
            reduced: (0..1000).map(f64::from).collect(),
            ..Observation::default()
        };
        let row = ColumnSample::of(&seen, None);
        assert!(row.reduced.len() <= LINES);
        assert_eq!(row.reduced.last(), Some(&999.0));
        assert_eq!(stride(10), 1);
    }
}
