//! How many digits a result has: what the last bits of its start and of ε do to it, and
//! the step or the tolerance of its method, or where it closes a collapse.

use super::drive::{Drive, RunError, Watch};
use super::measure::{Results, measure, rounding};
use super::vary::{PATTERNS, one_ulp_off, vary};
use crate::math;
use crate::physics;
use crate::scene::parameters::Value;
use crate::scene::{GridSettings, Scene};

/// Bead steps of a run that may be done a few times without being asked to.
const CHEAP: f64 = 1e8;

/// What is known of a floor collision's energies at most: it counts as over when no more
/// than this part of them can still change.
const AT_THE_END: f64 = 1e-12;

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

/// What is shown of a σ that nobody has measured the sensitivity of.
const CHAOTIC: f64 = 5e-3;

/// What a tolerance, of one step, vouches for over a whole run.
const OF_A_TOLERANCE: f64 = 100.0;

/// Relative changes of a run's results.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Sensitivity {
    /// Of ε_eff.
    pub eps_eff: Option<f64>,
    /// Of E_r/E_f.
    pub er_over_ef: Option<f64>,
    /// Of the paper's t_k.
    pub contact_duration: Option<f64>,
    /// Of the mean height of the centre of mass.
    pub h_cm_mean: Option<f64>,
    /// Of mean E_r over mean E.
    pub er_over_e_mean: Option<f64>,
    /// Of σ.
    pub sigma: Option<f64>,
    /// What the grid's step alone does to the main result.
    pub step: Option<f64>,
}

/// The largest changes over `patterns` of last bits, of [`PATTERNS`] at most, over the
/// last bit of ε, and over other steps, tolerances or depths where the method has them;
/// none of no patterns.
///
/// # Errors
/// As [`measure`] of the scene.
pub fn sensitivity(
    scene: &Scene,
    results: &Results,
    patterns: usize,
    watch: &mut Watch,
) -> Result<Sensitivity, RunError> {
    let mut found = Sensitivity::default();
    if patterns == 0 {
        return Ok(found);
    }
    found.vary_method(scene, results, watch)?;
    // Hard spheres near collapse have only rounding to be sensitive to, and one pattern
    // may tell a sixth of it.
    let few = !scene.is_md() && scene.gravity.is_none() && results.events < FEW;
    let patterns = if few { PATTERNS } else { patterns };
    for pattern in 0..patterns.min(PATTERNS) {
        let off = one_ulp_off(scene, pattern);
        found.widen(results, &run(off, scene, watch)?, 1.0);
    }
    if let Some(off) = restitution_off(scene) {
        let engine = physics::build(&off, None).0;
        found.widen(results, &run(engine, &off, watch)?, 1.0);
    }
    if results.closed > 0 {
        let engine = physics::build_half_as_deep(scene);
        found.widen(results, &run(engine, scene, watch)?, 1.0);
    }
    Ok(found)
}

/// Work of the runs of [`sensitivity`] in their order, in runs of the scene; as far as
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
                    Ok(near) => self.widen(results, &near, factor),
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

    fn widen(&mut self, here: &Results, near: &Results, factor: f64) {
        let widen = |known: &mut Option<f64>, here: Option<f64>, near: Option<f64>| {
            // Of 0, which is rounding, there are no parts.
            let Some(here) = here.filter(|&here| here != 0.0) else {
                return;
            };
            // A result that the other run does not have has no digits.
            let change = near.map_or(1.0, |near| ((near - here) / here).abs());
            let change = if change.is_nan() { 0.0 } else { change };
            *known = Some(known.unwrap_or(f64::EPSILON).max(factor * change));
        };
        widen(&mut self.eps_eff, here.eps_eff, near.eps_eff);
        widen(&mut self.er_over_ef, here.er_over_ef, near.er_over_ef);
        widen(
            &mut self.contact_duration,
            here.contact_duration,
            near.contact_duration,
        );
        widen(&mut self.h_cm_mean, here.h_cm_mean, near.h_cm_mean);
        widen(
            &mut self.er_over_e_mean,
            here.er_over_e_mean,
            near.er_over_e_mean,
        );
        widen(&mut self.sigma, here.sigma, near.sigma);
    }

    /// That of the run's main result: ε_eff, or the mean height.
    pub fn main(&self) -> Option<f64> {
        self.eps_eff.or(self.h_cm_mean)
    }

    /// What is known of every result at best: the sensitivities, if they were measured;
    /// the errors of means; and what the method vouches for where they were not.
    #[must_use]
    pub fn known(&self, scene: &Scene, results: &Results) -> Self {
        let method = match of_method(scene) {
            _ if self.main().is_some() => 0.0,
            Some(("tolerance", tolerance)) => OF_A_TOLERANCE * tolerance,
            Some((_, steps)) => OF_A_STEP / steps,
            None => 0.0,
        };
        // Under gravity it is that of the last period of a chaotic motion.
        let of_sigma = match (scene.gravity, self.sigma) {
            (Some(_), None) => CHAOTIC,
            _ => 0.0,
        };
        let known = |measured: Option<f64>, least: f64| {
            let part = measured.unwrap_or(0.0).max(method).max(least);
            (part > 0.0).then_some(part)
        };
        let of_mean = |error: Option<f64>, mean: Option<f64>| {
            let part = error.zip(mean).map(|(error, mean)| (error / mean).abs());
            part.filter(|part| part.is_finite()).unwrap_or(0.0)
        };
        // A square of differences of velocities has twice their error.
        let of_share = match results.er_over_ef {
            Some(share) if share > 0.0 => 2.0 * rounding(scene.n) / share.sqrt(),
            _ => 0.0,
        };
        let height = of_mean(results.h_cm_error, results.h_cm_mean);
        let share = of_mean(results.er_over_e_error, results.er_over_e_mean);
        Self {
            eps_eff: known(self.eps_eff, AT_THE_END),
            er_over_ef: known(self.er_over_ef, AT_THE_END.max(of_share)),
            contact_duration: known(self.contact_duration, 0.0),
            h_cm_mean: known(self.h_cm_mean, height),
            er_over_e_mean: known(self.er_over_e_mean, share),
            sigma: known(self.sigma, of_sigma),
            step: self.step,
        }
    }

    /// The results without the digits that are not known to these parts.
    #[must_use]
    pub fn cut(&self, results: &Results) -> Results {
        let cut = |x: Option<f64>, part: Option<f64>| match (x, part) {
            (Some(x), Some(part)) => Some(rounded(x, digits(part))),
            _ => x,
        };
        Results {
            eps_eff: cut(results.eps_eff, self.eps_eff),
            er_over_ef: cut(results.er_over_ef, self.er_over_ef),
            contact_duration: cut(results.contact_duration, self.contact_duration),
            h_cm_mean: cut(results.h_cm_mean, self.h_cm_mean),
            er_over_e_mean: cut(results.er_over_e_mean, self.er_over_e_mean),
            sigma: cut(results.sigma, self.sigma),
            ..results.clone()
        }
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
pub fn is_cheap(scene: &Scene, results: &Results) -> bool {
    let cost = results.steps as f64 * scene.n as f64 + results.events as f64;
    scene.gravity.is_none() && cost < CHEAP
}

/// The results of a run without the digits that they do not have; those of a run that
/// costs little are measured.
///
/// # Errors
/// As [`measure`].
pub fn in_its_digits(
    scene: &Scene,
    results: &Results,
    watch: &mut Watch,
) -> Result<(Results, Sensitivity), RunError> {
    let patterns = usize::from(is_cheap(scene, results));
    let measured = sensitivity(scene, results, patterns, watch)?;
    Ok((measured.known(scene, results).cut(results), measured))
}

/// Digits of a number that is known to this part of itself, and one to spare.
pub fn digits(part: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and 17"
    )]
    let digits = (1.0 - math::log10(part).floor()).clamp(1.0, 17.0) as usize;
    digits
}

/// `x` to so many significant digits.
pub fn rounded(x: f64, digits: usize) -> f64 {
    format!("{x:.*e}", digits - 1).parse().unwrap_or(x)
}
