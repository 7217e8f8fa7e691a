//! What the last bit of the start does to the results: how many digits a case has.

use super::drive::{Drive, RunError, Watch};
use super::measure::{Results, measure};
use super::vary::{PATTERNS, one_ulp_off};
use crate::math;
use crate::scene::Scene;

/// Bead steps of a run that may be done twice without being asked to.
const CHEAP: f64 = 1e8;

/// What is known of a floor collision's energies at most: it counts as over when no more
/// than this part of them can still change.
const AT_THE_END: f64 = 1e-12;

/// Relative changes of a run's results when its start changes in the last bit.
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
    /// Of σ.
    pub sigma: Option<f64>,
}

/// The largest changes over `patterns` of last bits, of [`PATTERNS`] at most.
///
/// # Errors
/// As [`measure`].
pub fn sensitivity(
    scene: &Scene,
    results: &Results,
    patterns: usize,
    watch: &mut Watch,
) -> Result<Sensitivity, RunError> {
    let mut found = Sensitivity::default();
    for pattern in 0..patterns.min(PATTERNS) {
        let mut look = |time| watch(time);
        let mut drive = Drive::of(one_ulp_off(scene, pattern), scene, &mut look);
        found.widen(results, &measure(scene, &mut drive)?);
    }
    Ok(found)
}

impl Sensitivity {
    fn widen(&mut self, here: &Results, near: &Results) {
        let widen = |known: &mut Option<f64>, here: Option<f64>, near: Option<f64>| {
            let Some(here) = here else { return };
            // A result that the other run does not have has no digits.
            let change = near.map_or(1.0, |near| ((near - here) / here).abs());
            let change = if change.is_nan() { 0.0 } else { change };
            *known = Some(known.unwrap_or(f64::EPSILON).max(change));
        };
        widen(&mut self.eps_eff, here.eps_eff, near.eps_eff);
        widen(&mut self.er_over_ef, here.er_over_ef, near.er_over_ef);
        widen(
            &mut self.contact_duration,
            here.contact_duration,
            near.contact_duration,
        );
        widen(&mut self.h_cm_mean, here.h_cm_mean, near.h_cm_mean);
        widen(&mut self.sigma, here.sigma, near.sigma);
    }

    /// That of the run's main result: ε_eff, or the mean height.
    pub fn main(&self) -> Option<f64> {
        self.eps_eff.or(self.h_cm_mean)
    }
}

/// Whether a run without gravity was so short that it may be done again without being
/// asked to; under gravity, where motion is chaotic, means have a standard error.
pub fn is_cheap(scene: &Scene, results: &Results) -> bool {
    let cost = results.steps as f64 * scene.n as f64 + results.events as f64;
    scene.gravity.is_none() && cost < CHEAP
}

/// The results of a run without the digits that the last bit of its start decides, where
/// it costs little to know them.
///
/// # Errors
/// As [`measure`].
pub fn in_its_digits(
    scene: &Scene,
    results: &Results,
    watch: &mut Watch,
) -> Result<Results, RunError> {
    let patterns = usize::from(is_cheap(scene, results));
    let known = sensitivity(scene, results, patterns, watch)?;
    let cut = |x: Option<f64>, part: Option<f64>| match (x, part) {
        (Some(x), Some(part)) => Some(rounded(x, digits(part))),
        _ => x,
    };
    Ok(Results {
        eps_eff: cut(results.eps_eff, at_the_end(known.eps_eff)),
        er_over_ef: cut(results.er_over_ef, at_the_end(known.er_over_ef)),
        contact_duration: cut(results.contact_duration, known.contact_duration),
        sigma: cut(results.sigma, known.sigma),
        ..results.clone()
    })
}

/// What is known of an energy at the end of a floor collision at most.
pub fn at_the_end(part: Option<f64>) -> Option<f64> {
    part.map(|part| part.max(AT_THE_END))
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
