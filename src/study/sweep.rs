//! Sweeps: a scene measured at every point of a product of ranges.
//!
//! Rows are numbered in the order of the product, the last range running fastest, and
//! come out in that order whatever finishes first: the same rows from any number of
//! threads.

mod axis;
mod parallel;

pub use axis::{AxisError, SweepAxis};
pub use parallel::run;

use crate::scene::parameters::{Setting, Value};
use crate::scene::{MethodName, Preset, Scene, SceneError};
use crate::study::RunError;
use crate::study::findings::{Findings, measured};
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, Ordering};

/// Most rows of a sweep; all are checked before the first one runs.
pub const MOST_ROWS: usize = 1_000_000;

/// Why there is no sweep; every sentence is one line.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum SweepError {
    /// A parameter has two ranges, or a range and a setting.
    #[error("{name}: given twice")]
    Twice {
        /// The parameter.
        name: &'static str,
    },
    /// The product is too long.
    #[error("these ranges make {rows} rows; at most {MOST_ROWS} are measured")]
    TooMany {
        /// Rows of the product, as far as they can be counted.
        rows: usize,
    },
    /// A point of the product is no scene.
    #[error("{error} (row {row}{at})")]
    Point {
        /// The row, from 1.
        row: usize,
        /// The values of the ranges there, with their own punctuation.
        at: String,
        /// Why.
        error: SceneError,
    },
}

/// A preset, and what is varied about it.
#[derive(Debug, Clone)]
pub struct Sweep {
    preset: Preset,
    method: Option<MethodName>,
    settings: Vec<Setting>,
    axes: Vec<SweepAxis>,
    rows: usize,
}

impl Sweep {
    /// A sweep whose every point is a scene.
    ///
    /// # Errors
    /// The first point that is none, or ranges that do not go together.
    pub fn new(
        preset: Preset,
        method: Option<MethodName>,
        settings: Vec<Setting>,
        axes: Vec<SweepAxis>,
    ) -> Result<Self, SweepError> {
        let names = |k: usize| axes[..k].iter().map(|axis| axis.parameter.name);
        let set = |name: &str| settings.iter().any(|s| s.parameter.name == name);
        for (k, axis) in axes.iter().enumerate() {
            let name = axis.parameter.name;
            if set(name) || names(k).any(|other| other == name) {
                return Err(SweepError::Twice { name });
            }
        }
        let rows = axes
            .iter()
            .fold(1_usize, |rows, axis| rows.saturating_mul(axis.values.len()));
        if rows > MOST_ROWS {
            return Err(SweepError::TooMany { rows });
        }
        let sweep = Self {
            preset,
            method,
            settings,
            axes,
            rows,
        };
        for row in 0..rows {
            sweep.try_scene(row).map_err(|error| {
                let values = sweep.values(row);
                let names = sweep.axes.iter().map(|axis| axis.parameter.name);
                let at = names
                    .zip(values)
                    .map(|(name, value)| format!(", {name} = {value}"));
                SweepError::Point {
                    row: row + 1,
                    at: at.collect(),
                    error,
                }
            })?;
        }
        Ok(sweep)
    }

    /// The ranges, the slowest first.
    pub fn axes(&self) -> &[SweepAxis] {
        &self.axes
    }

    /// Number of points.
    pub fn rows(&self) -> usize {
        self.rows
    }

    /// The values of the ranges in a row, counted from 0.
    pub fn values(&self, row: usize) -> Vec<Value> {
        let mut rest = row;
        let mut values: Vec<Value> = self
            .axes
            .iter()
            .rev()
            .map(|axis| {
                let value = axis.values[rest % axis.values.len()];
                rest /= axis.values.len();
                value
            })
            .collect();
        values.reverse();
        values
    }

    /// The scene of a row, counted from 0.
    ///
    /// # Panics
    /// Never: all rows were tried before.
    pub fn scene(&self, row: usize) -> Scene {
        self.try_scene(row).expect("every row was tried")
    }

    fn try_scene(&self, row: usize) -> Result<Scene, SceneError> {
        let swept = self
            .axes
            .iter()
            .zip(self.values(row))
            .map(|(axis, value)| Setting {
                parameter: axis.parameter,
                value,
            });
        let layer: Vec<Setting> = self.settings.iter().copied().chain(swept).collect();
        Ok(self.preset.with(self.method, &layer)?.scene)
    }
}

/// Measures a scene, with the digits that its results have and what tells them, unless it
/// is stopped on the way. `tell` hears the simulated time of its runs, s.
pub fn measure_unless(
    scene: &Scene,
    stop: &AtomicBool,
    tell: &mut dyn FnMut(f64),
) -> Option<Result<Findings, RunError>> {
    let mut watch = |time| {
        tell(time);
        if stop.load(Ordering::Relaxed) {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    match measured(scene, &mut watch) {
        Err(RunError::Stopped { .. }) => None,
        result => Some(result),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn sweep(over: &[&str]) -> Result<Sweep, SweepError> {
        let axes = over
            .iter()
            .map(|text| SweepAxis::parse(text).expect("a range"))
            .collect();
        let preset = Preset::load("fig1b").expect("an embedded preset");
        Sweep::new(preset, None, Vec::new(), axes)
    }

    #[test]
    fn the_last_range_runs_fastest() {
        let sweep = sweep(&["n=1,5", "s0=0,1e-6,1e-5"]).expect("a sweep");
        let points: Vec<(usize, f64)> = (0..sweep.rows())
            .map(|row| sweep.scene(row))
            .map(|scene| {
                let s0 = scene.sigma0().expect("a column with speed");
                (scene.n, s0 * 0.2 * 0.7e-5)
            })
            .collect();
        assert_eq!(points.len(), 6);
        for (row, (n, s0)) in points.into_iter().enumerate() {
            assert_eq!(n, [1, 5][row / 3]);
            // Through σ₀ and back: two roundings.
            assert!((s0 - [0.0, 1e-6, 1e-5][row % 3]).abs() < 1e-18);
        }
    }

    #[test]
    fn a_point_that_is_no_scene_is_found_before_anything_runs() {
        let error = sweep(&["diameter=1e-3,1e-4", "width=1e-5,5e-4"]).expect_err("too wide");
        let line = error.to_string();
        assert!(line.starts_with("width = 5e-4") || line.starts_with("width = 0.0005"));
        assert!(line.contains("row 4, diameter"), "{line}");
        let many = sweep(&["seed=1:1e6:2000", "s0=0:1:2000"]).expect_err("too many");
        assert_eq!(many, SweepError::TooMany { rows: 4_000_000 });
    }
}
