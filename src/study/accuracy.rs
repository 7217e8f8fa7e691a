//! How far off a method is, and what less would cost: error against run time.
//!
//! A floor collision has one right answer, so every method's error is its distance
//! from the exact method's. A shaken column is chaotic: there two right runs part too,
//! and what can be compared are the time until they do and the means.

mod candidates;
mod collision;
mod compared;
mod phases;
mod plate;

pub use candidates::{Candidate, candidates};

use super::plot::Plot;
use super::table::Table;
use super::{RunError, Tell, vary};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene, SceneError};
use std::time::Duration;

/// Tolerance of the reference run where it has one.
const TIGHTEST: f64 = 1e-12;

/// How much work a report may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Effort {
    /// A short ladder.
    pub quick: bool,
    /// Wall-clock time for all runs together.
    pub time: Duration,
}

/// What a study says.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Report {
    /// Its tables.
    pub tables: Vec<Table>,
    /// Its plots.
    pub plots: Vec<Plot>,
}

/// Why there is no report.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AccuracyError {
    /// The scene cannot be compared.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// Nothing exact to compare with.
    #[error("a lattice has no exact run to compare other methods with; columns have")]
    Lattice,
    /// The reference run failed.
    #[error("the reference run failed: {0}")]
    Reference(#[from] RunError),
    /// The reference would take longer than there is time.
    #[error(
        "the reference run takes {} than its share of the time, {share:.1} s; give more with \
         --budget, or make it shorter",
        needed.map_or("more".to_owned(), |s| format!("about {s:.1} s, more"))
    )]
    TooSlow {
        /// Wall-clock time for the least part of it that says something, s, where known.
        needed: Option<f64>,
        /// The time it had, s.
        share: f64,
    },
}

/// Error against run time of every method that fits the scene.
///
/// # Errors
/// When there is nothing to compare with: the scene has no soft contacts, or the
/// reference run fails.
pub fn accuracy(scene: &Scene, effort: Effort, tell: &mut Tell) -> Result<Report, AccuracyError> {
    if scene.sites().is_some() {
        return Err(AccuracyError::Lattice);
    }
    let mut reference = scene.with_method(MethodName::Exact)?;
    // Power laws: an adaptive method, at a tolerance below all that it is asked for.
    if let Ok(tight) = vary(&reference, None, &[("tolerance", Value::Number(TIGHTEST))]) {
        reference = tight;
    }
    if scene.gravity.is_some() {
        plate::report(&reference, scene, effort, tell)
    } else {
        collision::report(&reference, scene, effort, tell)
    }
}

/// What the scene of a report is, name by name.
pub fn facts(scene: &Scene, preset: &str) -> Vec<(String, String)> {
    let mut facts = vec![("scene".to_owned(), preset.to_owned())];
    for parameter in crate::scene::parameters::table() {
        if let Some(value) = (parameter.get)(scene.facts()) {
            let text = format!("{value} {}", parameter.unit);
            facts.push((parameter.name.to_owned(), text.trim_end().to_owned()));
        }
    }
    facts
}

impl Report {
    /// Names the scene in all tables.
    #[must_use]
    pub fn of(mut self, scene: &Scene, preset: &str) -> Self {
        for table in &mut self.tables {
            table.facts = facts(scene, preset);
        }
        self
    }
}
