//! Everything that a run gives, with the digits that are known of it.

use super::drive::{Drive, RunError, Watch};
use super::measure::{Results, measure};
use super::quantity::{self, Around, Quantity, Run};
use super::sensitivity::{Sensitivity, by_trial, is_cheap};
use super::table::Cell;
use super::vary::PATTERNS;
use super::verdict::verdict;
use crate::numerals::{digits, rounded};
use crate::scene::{Preset, Scene};
use std::ops::ControlFlow;
use std::time::Instant;

/// A quantity of a run.
#[derive(Debug, Clone)]
pub struct Finding {
    /// Which.
    pub quantity: &'static Quantity,
    /// What it is, of this scene; may be empty.
    pub meaning: &'static str,
    /// Its value in the digits that are known and one to spare; empty where the scene has
    /// none. A number need not be finite: see [`Findings::not_finite`].
    pub cell: Cell,
    /// Digits of it, where they are known.
    pub digits: Option<usize>,
}

/// What a run gives.
#[derive(Debug, Clone)]
pub struct Findings {
    /// All quantities, in the order of [`quantity::table`].
    pub all: Vec<Finding>,
    /// What a reader of them should know, a sentence each.
    pub remarks: Vec<String>,
}

/// What [`run`] is at.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum FindingStage {
    /// A run of the scene has come to this simulated time, s: the scene's own, then one
    /// after another those that tell what its results are sensitive to.
    Run(f64),
    /// The verdict on the scene's soft contacts.
    Verdict,
}

/// Runs a preset's scene to its end, and says everything about it. What its results are
/// sensitive to is measured where that is cheap, or `asked` for.
///
/// # Errors
/// [`RunError`] when the engine cannot go on.
pub fn run(
    preset: &Preset,
    asked: bool,
    tell: &mut dyn FnMut(FindingStage),
) -> Result<Findings, RunError> {
    let scene = &preset.scene;
    let mut watch = |time| {
        tell(FindingStage::Run(time));
        ControlFlow::Continue(())
    };
    let started = Instant::now();
    let results = measure(scene, &mut Drive::new(scene, &mut watch))?;
    let wall_time = started.elapsed().as_secs_f64().max(1e-9);
    let sensitivity = examine(scene, &results, asked, &mut watch)?;
    tell(FindingStage::Verdict);
    let verdict = verdict(scene, &mut |_| ControlFlow::Continue(()))?;
    let run = Run {
        scene,
        results: &results,
        sensitivity: &sensitivity,
    };
    let around = Around {
        preset,
        wall_time,
        verdict: &verdict,
    };
    let all = quantity::table().iter();
    Ok(Findings::of(all, run, Some(around)))
}

/// Runs a scene to its end, and says what was measured: [`quantity::of_runs`], the digits
/// measured too where that is cheap.
///
/// # Errors
/// [`RunError`] when the engine cannot go on, or a run is stopped.
pub fn measured(scene: &Scene, watch: &mut Watch) -> Result<Findings, RunError> {
    let results = measure(scene, &mut Drive::new(scene, &mut *watch))?;
    let sensitivity = examine(scene, &results, false, watch)?;
    let run = Run {
        scene,
        results: &results,
        sensitivity: &sensitivity,
    };
    Ok(Findings::of(quantity::of_runs(), run, None))
}

/// What the results of a scene are sensitive to: the largest changes over `patterns` of last
/// bits, of [`PATTERNS`] at most, over the last bit of ε, and over other steps, tolerances or
/// depths where the method has them; none of no patterns.
///
/// # Errors
/// As [`measure`] of the scene.
pub fn sensitivity(
    scene: &Scene,
    results: &Results,
    patterns: usize,
    watch: &mut Watch,
) -> Result<Sensitivity, RunError> {
    let measures: Vec<_> = quantity::measured().collect();
    by_trial(&measures, scene, results, patterns, watch)
}

fn examine(
    scene: &Scene,
    results: &Results,
    asked: bool,
    watch: &mut Watch,
) -> Result<Sensitivity, RunError> {
    let patterns = if asked {
        PATTERNS
    } else {
        usize::from(is_cheap(scene, results))
    };
    sensitivity(scene, results, patterns, watch)
}

impl Findings {
    fn of(
        quantities: impl Iterator<Item = &'static Quantity>,
        run: Run,
        around: Option<Around>,
    ) -> Self {
        let finding = |quantity: &'static Quantity| {
            let digits = quantity.unknown(run).map(digits);
            let cell = match (quantity.value(run, around), digits) {
                (Cell::Number(x), Some(digits)) => Cell::Number(rounded(x, digits)),
                (cell, _) => cell,
            };
            Finding {
                quantity,
                meaning: quantity.meaning(run.scene),
                cell,
                digits,
            }
        };
        Self {
            all: quantities
                .filter(|quantity| quantity.is_of(run.scene))
                .map(finding)
                .collect(),
            remarks: run.results.remarks(),
        }
    }

    /// The first number that is not finite, which is no result.
    pub fn not_finite(&self) -> Option<(&'static str, f64)> {
        self.all.iter().find_map(|finding| match finding.cell {
            Cell::Number(x) if !x.is_finite() => Some((finding.quantity.name, x)),
            _ => None,
        })
    }

    /// A number by the name of its quantity.
    pub fn number(&self, name: &str) -> Option<f64> {
        let finding = self
            .all
            .iter()
            .find(|finding| finding.quantity.name == name);
        match finding?.cell {
            Cell::Number(x) => Some(x),
            _ => None,
        }
    }
}
