//! A run from start to end, and what it measures.

use super::drive::{Drive, RunError};
use super::means::Means;
use crate::physics::Observation;
use crate::scene::{Scene, diameters};

/// Looks at the centre of mass in a plate period.
const LOOKS_IN_A_PERIOD: f64 = 200.0;

/// So many looks are enough for any mean.
const MOST_LOOKS: f64 = 1e6;

/// Parts of a run whose means tell its standard error.
const PARTS: usize = 20;

/// The beginning of a run, which still depends on how it started.
const SETTLING: f64 = 0.1;

/// What a run measures; what its scene does not have is none.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Results {
    /// ε_eff = √(E_f/E_0) of the floor collision, once it is over.
    pub eps_eff: Option<f64>,
    /// E_r/E_f, the share of the final energy that is relative motion.
    pub er_over_ef: Option<f64>,
    /// The paper's t_k, from first to last touch of the floor, s.
    pub contact_duration: Option<f64>,
    /// Mean absolute height of the centre of mass over the last 90 % of a run with
    /// gravity, m.
    pub h_cm_mean: Option<f64>,
    /// Its error, m: the standard error, from the means of parts of the run, with what
    /// is not known of the motion between looks.
    pub h_cm_error: Option<f64>,
    /// Mean E_r over mean E, over the same time; of a column that moves.
    pub er_over_e_mean: Option<f64>,
    /// Its error, as of the height.
    pub er_over_e_error: Option<f64>,
    /// Mean free flight over t_c at the end.
    pub sigma: Option<f64>,
    /// Relative error of the energy ledger.
    pub energy_drift: f64,
    /// Collisions (ED).
    pub events: u64,
    /// Time steps (soft contacts).
    pub steps: u64,
    /// Simulated time, s.
    pub sim_time: f64,
}

/// Runs the scene of a drive to its end.
///
/// # Errors
/// [`RunError`] when the engine cannot go on, or the run is stopped.
pub fn measure(scene: &Scene, drive: &mut Drive) -> Result<Results, RunError> {
    let mut last = Observation::default();
    let measured = match (scene.gravity, scene.duration) {
        (Some(gravity), Some(duration)) => {
            let looks = interval(scene, gravity);
            let means = means(scene, drive, duration, looks, &mut last)?;
            let height = means.height(means.all());
            let share = means.share(means.all());
            Results {
                h_cm_mean: height.map(|mean| mean.value + stacking_height(scene)),
                h_cm_error: height.and_then(|mean| mean.error),
                er_over_e_mean: share.map(|mean| mean.value),
                er_over_e_error: share.and_then(|mean| mean.error),
                ..Results::default()
            }
        }
        _ => floor_collision(scene, drive, &mut last)?,
    };
    let sigma = last
        .free_flight
        .zip(scene.contact_time())
        .map(|(flight, t_c)| flight / t_c);
    Ok(Results {
        sigma,
        energy_drift: last.energy.drift,
        events: last.events,
        steps: last.steps,
        sim_time: drive.time(),
        ..measured
    })
}

/// A collision with the floor without gravity.
fn floor_collision(
    scene: &Scene,
    drive: &mut Drive,
    last: &mut Observation,
) -> Result<Results, RunError> {
    drive.observe(last);
    let before = last.energy.kinetic;
    let over = drive.collide(scene)?;
    drive.observe(last);
    if !over {
        return Ok(Results::default());
    }
    let after = last.energy.kinetic;
    Ok(Results {
        eps_eff: Some((after / before).sqrt()),
        // Of a column that has come to rest nobody can say how its energy is shared.
        er_over_ef: (after > 0.0).then(|| last.energy.relative / after),
        contact_duration: last
            .floor_left
            .zip(last.floor_touched)
            .map(|(left, touched)| left - touched),
        ..Results::default()
    })
}

/// Time between two looks at the centre of mass, s: a part of the plate's period,
/// or of the time in which a bead falls by its diameter.
fn interval(scene: &Scene, gravity: f64) -> f64 {
    let period = scene
        .period()
        .unwrap_or_else(|| (2.0 * scene.diameter / gravity).sqrt());
    period / LOOKS_IN_A_PERIOD
}

/// Runs for the whole duration. Means over its last nine tenths.
fn means(
    scene: &Scene,
    drive: &mut Drive,
    duration: f64,
    interval: f64,
    last: &mut Observation,
) -> Result<Means, RunError> {
    let begin = SETTLING * duration;
    let looks = ((duration - begin) / interval).min(MOST_LOOKS) / PARTS as f64;
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most MOST_LOOKS"
    )]
    let in_a_part = looks.ceil().max(1.0) as usize;
    let looks = PARTS * in_a_part;
    let mut means = Means::new(scene, in_a_part);
    for look in 0..=looks {
        let until = begin + (duration - begin) * (look as f64 / looks as f64);
        drive.advance(until.min(duration))?;
        drive.observe(last);
        means.look(last);
    }
    Ok(means)
}

/// Height of the centre of mass of the column that rests, just touching, on z = 0, m.
pub(super) fn stacking_height(scene: &Scene) -> f64 {
    let (mut top, mut mass, mut moment) = (0.0, 0.0, 0.0);
    for d in diameters(scene) {
        // Relative to the mean bead, so that no diameter is too small.
        let m = (d / scene.diameter).powi(3);
        mass += m;
        moment += m * (top + d / 2.0);
        top += d;
    }
    moment / mass
}
