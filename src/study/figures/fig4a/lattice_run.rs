//! The runs of Fig. 4(a): a lattice, and the column of its height.

use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::Results;
use crate::study::figures::FigureError;
use crate::study::figures::runs::{preset, results};

/// Rows of a lattice, and its restitution.
const ROWS: u64 = 10;
const RESTITUTION: f64 = 0.9;
/// Steps in a contact.
pub(super) const STEPS: f64 = 50.0;

/// A run of a lattice.
#[derive(Debug, Clone, Copy)]
pub(super) struct LatticeRun {
    pub rows: u64,
    pub restitution: f64,
    pub v0: f64,
    pub contact_time: f64,
    pub sigma: f64,
    pub steps: f64,
    /// Of the random shifts.
    pub seed: u64,
}

impl LatticeRun {
    /// That of the preset's speed and contact time.
    pub fn usual(sigma: f64, seed: u64) -> Self {
        Self {
            rows: ROWS,
            restitution: RESTITUTION,
            v0: 0.1,
            contact_time: 1e-5,
            sigma,
            steps: STEPS,
            seed,
        }
    }

    pub fn s0(&self) -> f64 {
        self.sigma * self.v0 * self.contact_time
    }

    pub fn scene(&self) -> Result<Scene, FigureError> {
        let values = [
            ("rows", Value::Whole(self.rows)),
            ("restitution", Value::Number(self.restitution)),
            ("v0", Value::Number(-self.v0)),
            ("contact_time", Value::Number(self.contact_time)),
            ("s0", Value::Number(self.s0())),
            ("steps_per_contact", Value::Number(self.steps)),
            ("seed", Value::Whole(self.seed)),
        ];
        preset("fig4", Some(MethodName::Verlet), &values)
    }

    pub fn run(&self) -> Result<Results, FigureError> {
        results(&self.scene()?)
    }

    /// ε_eff of the column of that height, exactly; a seed shifts its beads.
    pub fn column(&self, seed: Option<u64>) -> Result<f64, FigureError> {
        let mut values = vec![
            ("n", Value::Whole(self.rows)),
            ("restitution", Value::Number(self.restitution)),
            ("v0", Value::Number(-self.v0)),
            ("contact_time", Value::Number(self.contact_time)),
            ("s0", Value::Number(self.s0())),
        ];
        if let Some(seed) = seed {
            values.extend([("jitter", Value::Flag(true)), ("seed", Value::Whole(seed))]);
        }
        Ok(eps(&results(&preset(
            "fig1b",
            Some(MethodName::Exact),
            &values,
        )?)?))
    }
}

/// ε_eff, where the collision is over.
pub(super) fn eps(results: &Results) -> f64 {
    results.eps_eff.unwrap_or(f64::NAN)
}
