//! A run from start to end, and what it measures.

use super::drive::{Drive, RunError};
use super::means::Means;
use crate::math;
use crate::physics::Observation;
use crate::scene::{Scene, diameters};

/// Looks at the centre of mass in a plate period.
const LOOKS_IN_A_PERIOD: f64 = 200.0;

/// So many looks are enough for any mean.
const MOST_LOOKS: f64 = 1e6;

/// Parts of a run whose means tell its standard error, where it has no periods.
const PARTS: f64 = 20.0;

/// Fewest periods whose means do.
const LEAST_PERIODS: f64 = 16.0;

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
    /// Mean free flight over t_c: of a floor collision that is over, at the end of its
    /// last contact; otherwise at the end of the run.
    pub sigma: Option<f64>,
    /// The deepest overlap seen, over the diameter of the mean bead; of soft contacts.
    pub overlap_max: Option<f64>,
    /// Relative error of the energy ledger.
    pub energy_drift: f64,
    /// Collisions (ED).
    pub events: u64,
    /// Collapses that were closed (ED).
    pub closed: u64,
    /// Time steps (soft contacts).
    pub steps: u64,
    /// Simulated time, s.
    pub sim_time: f64,
}

/// A ledger that is off by more belongs to a run that has lost its physics.
const UNTRUSTED: f64 = 0.1;

/// Overlaps deeper than this part of a diameter are no contacts of grains any more.
const TOO_DEEP: f64 = 0.1;

impl Results {
    /// What a reader of them should know.
    pub fn remarks(&self) -> Vec<String> {
        let mut remarks = Vec::new();
        if self.h_cm_mean.is_none() && self.eps_eff.is_none() {
            remarks.push(format!(
                "the floor collision is not over at {:e} s, so it has no eps_eff yet",
                self.sim_time
            ));
        }
        if self.energy_drift.abs() > UNTRUSTED {
            remarks.push(format!(
                "the energy ledger is off by {:.0} %, so these numbers are not to be trusted",
                100.0 * self.energy_drift.abs()
            ));
        }
        if let Some(deep) = self.overlap_max.filter(|&deep| deep > TOO_DEEP) {
            remarks.push(format!(
                "overlaps reach {:.0} % of a diameter, which is no contact of grains any more",
                100.0 * deep
            ));
        }
        remarks
    }
}

/// Runs the scene of a drive to its end.
///
/// # Errors
/// [`RunError`] when the engine cannot go on, or the run is stopped.
pub fn measure(scene: &Scene, drive: &mut Drive) -> Result<Results, RunError> {
    let mut last = Observation::default();
    let measured = match (scene.gravity, scene.duration) {
        (Some(gravity), Some(duration)) => {
            let means = means(scene, drive, gravity, duration, &mut last)?;
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
    let flight = if measured.eps_eff.is_some() {
        last.settled_flight
    } else {
        last.free_flight
    };
    Ok(Results {
        sigma: sigma(scene, flight),
        overlap_max: scene.is_md().then(|| last.deepest / scene.diameter),
        energy_drift: last.energy.drift,
        events: last.events,
        closed: last.closed,
        steps: last.steps,
        sim_time: drive.time(),
        ..measured
    })
}

/// σ of a mean free flight, s, in a scene that has a contact time.
pub(super) fn sigma(scene: &Scene, flight: Option<f64>) -> Option<f64> {
    let both = flight.zip(scene.contact_time());
    both.map(|(flight, t_c)| flight / t_c)
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
        er_over_ef: (after > 0.0).then(|| share(last.energy.relative / after, scene.n)),
        contact_duration: last.floor_contact(),
        ..Results::default()
    })
}

/// Runs for the whole duration. Means over its last nine tenths: in blocks of the plate's
/// periods where there are enough of them, else of equal parts.
fn means(
    scene: &Scene,
    drive: &mut Drive,
    gravity: f64,
    duration: f64,
    last: &mut Observation,
) -> Result<Means, RunError> {
    let begin = SETTLING * duration;
    let window = duration - begin;
    let periods = scene.period().map(|period| (period, window / period));
    let (block, blocks) = match periods {
        Some((period, count)) if count >= LEAST_PERIODS => (period, count),
        _ => (window / PARTS, PARTS),
    };
    // The time in which a bead falls by its diameter, where no plate has a period.
    let natural = scene
        .period()
        .unwrap_or_else(|| (2.0 * scene.diameter / gravity).sqrt());
    let looks = (LOOKS_IN_A_PERIOD * block / natural).min(MOST_LOOKS / blocks);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most MOST_LOOKS"
    )]
    let in_a_block = looks.ceil().max(1.0) as usize;
    let interval = block / in_a_block as f64;
    let mut means = Means::new(scene, in_a_block);
    let (mut look, mut until) = (0.0, begin);
    drive.observe(last);
    let mut deepest = last.deepest;
    drive.advance(begin)?;
    drive.observe(last);
    means.look(last);
    deepest = deepest.max(last.deepest);
    while until < duration {
        look += 1.0;
        until = begin + look * interval;
        // A last look that rounding puts short of the end is meant to be there.
        if until > duration - 1e-6 * interval {
            until = duration;
        }
        drive.advance(until)?;
        drive.observe(last);
        means.look(last);
        deepest = deepest.max(last.deepest);
    }
    means.finish();
    last.deepest = deepest;
    Ok(means)
}

/// E_r/E_f of so many beads: 0 where the velocities that it is made of differ by no more
/// than rounding.
fn share(found: f64, n: usize) -> f64 {
    if found.sqrt() < rounding(n) {
        0.0
    } else {
        found
    }
}

/// What a velocity of one of `n` beads is off by at the end of a collision, as a part of it.
pub(super) fn rounding(n: usize) -> f64 {
    4.0 * n as f64 * f64::EPSILON
}

/// Height of the centre of mass of the column that rests, just touching, on z = 0, m.
pub(super) fn stacking_height(scene: &Scene) -> f64 {
    let (mut top, mut mass, mut moment) = (0.0, 0.0, 0.0);
    for d in diameters(scene) {
        // Relative to the mean bead, so that no diameter is too small.
        let m = math::powi(d / scene.diameter, 3);
        mass += m;
        moment += m * (top + d / 2.0);
        top += d;
    }
    moment / mass
}
