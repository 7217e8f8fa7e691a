//! Buffers that are kept, so that few steps allocate.

use super::polynomial::ROWS;
use super::taylor::Coupling;

/// Entries behind the last gap of a row: up to three that fill a lane, and the zero forces
/// at both ends.
pub(super) const PADDING: usize = 6;

/// Coefficients in the longest buffer that is kept: those of 32 gaps. Making a longer one costs
/// little against the series itself, and keeping many of them might cost O(N²) of memory.
const LONGEST_KEPT: usize = 32 * ROWS;

/// Buffers as long as the longest cluster, padded. What is in them means nothing between
/// two uses.
#[derive(Clone, Debug, Default)]
pub(super) struct Workspace {
    pub a: Vec<f64>,
    pub b: Vec<f64>,
    /// The sign that each gap of a cluster keeps while its contact does not change.
    pub signs: Vec<f64>,
    /// As long as the longest cluster's series.
    pub series: Vec<f64>,
    pub coupling: Coupling,
    /// Coefficients of series that have ended.
    spare_rows: Vec<Vec<f64>>,
}

impl Workspace {
    /// For a column of `n` gaps.
    pub fn new(n: usize) -> Self {
        Self {
            a: vec![0.0; n + PADDING],
            b: vec![0.0; n + PADDING],
            signs: Vec::with_capacity(n + PADDING),
            series: vec![0.0; ROWS * (n + PADDING)],
            coupling: Coupling::default(),
            spare_rows: Vec::new(),
        }
    }

    /// A buffer of `len` coefficients, of any values.
    pub fn take_rows(&mut self, len: usize) -> Vec<f64> {
        let mut rows = self.spare_rows.pop().unwrap_or_default();
        rows.resize(len, 0.0);
        rows
    }

    /// Takes a buffer back, unless it is so long that it is not worth keeping.
    pub fn keep_rows(&mut self, rows: Vec<f64>) {
        if rows.capacity() <= LONGEST_KEPT {
            self.spare_rows.push(rows);
        }
    }
}
