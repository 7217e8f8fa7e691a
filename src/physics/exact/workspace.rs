//! Buffers that are kept, so that no step allocates.

use super::polynomial::ROWS;
use super::taylor::Coupling;

/// Entries behind the last gap of a row: up to three that fill a lane, and the zero forces
/// at both ends.
pub(super) const PADDING: usize = 6;

/// Buffers as long as the longest cluster, padded. What is in them means nothing between
/// two uses.
#[derive(Debug, Default)]
pub(super) struct Workspace {
    pub a: Vec<f64>,
    pub b: Vec<f64>,
    /// The sign that each gap of a cluster keeps while its contact does not change.
    pub signs: Vec<f64>,
    /// As long as the longest cluster's series.
    pub series: Vec<f64>,
    pub coupling: Coupling,
    /// Coefficients of plans that have ended, for those to come.
    pub spare_rows: Vec<Vec<f64>>,
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
}
