//! Columns without gaps that meet the floor, Sec. IV A.

use super::FigureError;
use super::runs::{preset, results};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::Results;

/// The text's t_c, s.
pub(super) const CONTACT_TIME: f64 = 0.2e-4;

/// The scene of such a column.
pub(super) fn scene(n: u64, restitution: f64, speed: f64) -> Result<Scene, FigureError> {
    let values = [
        ("n", Value::Whole(n)),
        ("restitution", Value::Number(restitution)),
        ("contact_time", Value::Number(CONTACT_TIME)),
        ("v0", Value::Number(-speed)),
    ];
    preset("fig1a", Some(MethodName::Exact), &values)
}

/// A column without gaps that meets the floor.
pub(super) fn run(n: u64, restitution: f64, speed: f64) -> Result<Results, FigureError> {
    results(&scene(n, restitution, speed)?)
}

/// ε_eff of a run.
pub(super) fn eps(results: &Results) -> f64 {
    results.eps_eff.unwrap_or(f64::NAN)
}
