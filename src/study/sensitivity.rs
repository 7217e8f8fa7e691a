//! How many digits a result has: what the last bits of its start and of ε do to it, and
//! the step or the tolerance of its method, or where it closes a collapse.

use super::drive::{Drive, RunError, Watch};
use super::measure::{Results, measure};
use super::vary::{PATTERNS, one_ulp_off, vary};
use crate::physics;
use crate::scene::parameters::Value;
use crate::scene::{GridSettings, Scene};
use std::collections::BTreeMap;

/// Bead steps of a run that may be done a few times without being asked to.
const CHEAP: f64 = 1e8;

/// Collisions of a run of hard spheres that costs nothing to do again.
const FEW: u64 = 1_000_000;

/// Steps in a contact, as parts of the scene's own, that tell what the step does: contact
/// changes fall elsewhere between the grid points of each. More finer ones where the
/// coarser are not stable.
const COARSER: [f64; 3] = [0.5, 0.585, 0.69];
const FINER: [f64; 1] = [1.37];
const FINEST: [f64; 2] = [1.69, 2.0];
/// The difference from a finer grid, or a tighter tolerance, is only a part of an error.
const BUT_A_PART: f64 = 2.0;

/// Tolerances, as parts of the scene's own, that tell what it does.
const TIGHTER: [f64; 2] = [0.1, 0.32];

/// What a grid vouches for where nobody has tried another: contact changes fall between
/// its points, so every contact is off by up to a step, which of the whole is about a
/// tenth of a step in a contact time.
const OF_A_STEP: f64 = 0.1;

/// What a tolerance, of one step, vouches for over a whole run.
const OF_A_TOLERANCE: f64 = 100.0;

/// The main result of a run: the first of these that it has.
const MAIN: [&str; 2] = ["eps_eff", "h_cm_mean"];

/// A result whose digits are measured.
#[derive(Debug, Clone, Copy)]
pub(super) struct Measured {
    /// Its value, in the unit of its quantity.
    pub get: fn(&Results) -> Option<f64>,
    /// The part of it that is not known at best.
    pub at_best: fn(&Scene, &Results) -> f64,
    /// The same where nobody has measured what it is sensitive to.
    pub unmeasured: fn(&Scene) -> f64,
}

/// All of those, by name.
type Measures<'a> = &'a [(&'static str, Measured)];

/// Relative changes of a run's results.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Sensitivity {
    /// Of each result that has digits to be measured, by its name in [`super::quantity::table`].
    changes: BTreeMap<&'static str, f64>,
    /// What the grid's step alone does to the main result.
    pub step: Option<f64>,
}

/// The largest changes of `measures` over `patterns` of last bits, of [`PATTERNS`] at most, over the
/// last bit of ε, and over other steps, tolerances or depths where the method has them;
/// none of no patterns.
///
/// # Errors
/// As [`measure`] of the scene.
pub(super) fn by_trial(
    measures: Measures,
    scene: &Scene,
    results: &Results,
    patterns: usize,
    watch: &mut Watch,
) -> Result<Sensitivity, RunError> {
    let mut found = Sensitivity::default();
    if patterns == 0 {
        return Ok(found);
    }
    found.vary_method(measures, scene, results, watch)?;
    // Hard spheres near collapse have only rounding to be sensitive to, and one pattern
    // may tell a sixth of it.
    let few = !scene.is_md() && scene.gravity.is_none() && results.events < FEW;
    let patterns = if few { PATTERNS } else { patterns };
    for pattern in 0..patterns.min(PATTERNS) {
        let off = one_ulp_off(scene, pattern);
        found.widen(measures, results, &run(off, scene, watch)?, 1.0);
    }
    if let Some(off) = restitution_off(scene) {
        let engine = physics::build(&off, None).0;
        found.widen(measures, results, &run(engine, &off, watch)?, 1.0);
    }
    if results.closed > 0 {
        let engine = physics::build_half_as_deep(scene);
        found.widen(measures, results, &run(engine, scene, watch)?, 1.0);
    }
    Ok(found)
}

/// Work of the runs of [`super::sensitivity()`] in their order, in runs of the scene; as far as
/// can be told before: where other steps are not stable there are others.
pub fn work_of_sensitivity(scene: &Scene, patterns: usize) -> Vec<f64> {
    if patterns == 0 {
        return Vec::new();
    }
    let mut work = match of_method(scene) {
        Some(("tolerance", _)) => vec![1.0; TIGHTER.len()],
        Some(_) => [&COARSER[..], &FINER].concat(),
        None => Vec::new(),
    };
    let of_restitution = usize::from(restitution_off(scene).is_some());
    work.extend(vec![1.0; patterns + of_restitution]);
    work
}

/// The scene with an ε that is smaller by its last bit. A decimal number that somebody
/// typed is half of that from what it means.
fn restitution_off(scene: &Scene) -> Option<Scene> {
    let restitution = Value::Number(scene.restitution.next_down());
    let has = scene.restitution > 0.0 && scene.gravity.is_none();
    let off = has.then(|| vary(scene, None, &[("restitution", restitution)]));
    off?.ok()
}

fn run(
    engine: Box<dyn physics::Engine>,
    scene: &Scene,
    watch: &mut Watch,
) -> Result<Results, RunError> {
    let mut look = |time| watch(time);
    measure(scene, &mut Drive::of(engine, scene, &mut look))
}

impl Sensitivity {
    /// The same run with other steps, or tolerances.
    fn vary_method(
        &mut self,
        measures: Measures,
        scene: &Scene,
        results: &Results,
        watch: &mut Watch,
    ) -> Result<(), RunError> {
        let Some((name, value)) = of_method(scene) else {
            return Ok(());
        };
        let mut try_all = |parts: &[f64], factor: f64| -> Result<usize, RunError> {
            let mut done = 0;
            for part in parts {
                let set = [(name, Value::Number(part * value))];
                let Ok(other) = vary(scene, None, &set) else {
                    continue;
                };
                match run(physics::build(&other, None).0, &other, watch) {
                    Ok(near) => self.widen(measures, results, &near, factor),
                    Err(RunError::Engine(_)) => continue,
                    Err(stopped) => return Err(stopped),
                }
                done += 1;
            }
            Ok(done)
        };
        if name == "tolerance" {
            if try_all(&TIGHTER, BUT_A_PART)? == 0 {
                try_all(&TIGHTER.map(|part| 1.0 / part), 1.0)?;
            }
            return Ok(());
        }
        let coarser = try_all(&COARSER, 1.0)?;
        try_all(&FINER, BUT_A_PART)?;
        if coarser < COARSER.len() {
            try_all(&FINEST, BUT_A_PART)?;
        }
        self.step = self.main();
        Ok(())
    }

    fn widen(&mut self, measures: Measures, here: &Results, near: &Results, factor: f64) {
        for &(name, measured) in measures {
            // Of 0, which is rounding, there are no parts.
            let Some(here) = (measured.get)(here).filter(|&here| here != 0.0) else {
                continue;
            };
            // A result that the other run does not have has no digits.
            let near = (measured.get)(near);
            let change = near.map_or(1.0, |near| ((near - here) / here).abs());
            let change = if change.is_nan() { 0.0 } else { change };
            let known = self.changes.entry(name).or_insert(f64::EPSILON);
            *known = known.max(factor * change);
        }
    }

    /// That of the result of this name, if it was measured.
    pub fn change(&self, name: &str) -> Option<f64> {
        self.changes.get(name).copied()
    }

    /// That of the run's main result: ε_eff, or the mean height.
    pub fn main(&self) -> Option<f64> {
        MAIN.iter().find_map(|name| self.change(name))
    }

    /// What is not known of a result at best: its sensitivity, if it was measured; its
    /// error, if it is a mean; and what the method vouches for where nothing was measured.
    pub(super) fn unknown(
        &self,
        name: &str,
        measured: Measured,
        scene: &Scene,
        results: &Results,
    ) -> Option<f64> {
        let of_method = match of_method(scene) {
            _ if self.main().is_some() => 0.0,
            Some(("tolerance", tolerance)) => OF_A_TOLERANCE * tolerance,
            Some((_, steps)) => OF_A_STEP / steps,
            None => 0.0,
        };
        let change = self.change(name);
        let part = change
            .unwrap_or_else(|| (measured.unmeasured)(scene))
            .max(of_method)
            .max((measured.at_best)(scene, results));
        (part > 0.0).then_some(part)
    }
}

/// What a method can be set to that decides how right it is: steps in a contact time, or
/// a tolerance.
fn of_method(scene: &Scene) -> Option<(&'static str, f64)> {
    let steps = |grid: GridSettings| ("steps_per_contact", grid.steps_per_contact);
    let tolerance = scene.tolerance().map(|tolerance| ("tolerance", tolerance));
    scene.grid().map(steps).or(tolerance)
}

/// Whether a run without gravity was so short that it may be done again without being
/// asked to; under gravity, where motion is chaotic, means have a standard error.
pub(super) fn is_cheap(scene: &Scene, results: &Results) -> bool {
    let cost = results.steps as f64 * scene.n as f64 + results.events as f64;
    scene.gravity.is_none() && cost < CHEAP
}
