//! Errors over the phases of a grid: where its points fall between contact changes is
//! chance, and a single run has one chance of many.

use super::Candidate;
use super::compared::{CollisionTrace, Errors};
use crate::physics::{Engine, build};
use crate::scene::Scene;
use crate::study::{Drive, RunError, Watch, measure, sensitivity};

/// Starts, a 16th of a step apart.
const PHASES: usize = 16;

/// What the phases of a method's grid give.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct Spread {
    /// Roots of the mean squares.
    pub rms: Errors,
    /// The largest.
    pub worst: Errors,
    /// How many phases there are; 1 of a method without a grid.
    pub phases: usize,
    /// The error of ε_eff that `run` estimates, from other steps.
    pub estimate: Option<f64>,
}

impl Spread {
    /// Of one run alone.
    pub fn of_one(errors: Errors) -> Self {
        Self {
            rms: errors,
            worst: errors,
            phases: 1,
            estimate: None,
        }
    }
}

/// Runs a candidate over the other phases of its grid, as far as `watch` lets it, and
/// compares each with the truth by `errors`; `run` goes from an engine that begins so much
/// earlier, s, to the end.
///
/// # Errors
/// When a run fails; not when it is stopped.
pub(super) fn over_phases(
    candidate: &Candidate,
    spread: &mut Spread,
    watch: &mut Watch,
    run: impl Fn(Drive, f64) -> Result<CollisionTrace, RunError>,
    errors: impl Fn(&CollisionTrace) -> Errors,
) -> Result<(), RunError> {
    let scene = &candidate.scene;
    let step = match candidate.rung {
        Some(("steps_per_contact", steps)) => scene.contact_time().map(|t_c| t_c / steps),
        _ => None,
    };
    let Some(step) = step else {
        return Ok(());
    };
    let mut squares = spread.rms.map(|e| e * e);
    let mut more = |watch: &mut Watch| {
        for phase in 1..PHASES {
            let early = step * phase as f64 / PHASES as f64;
            let mut look = |time| watch(time);
            let drive = Drive::of(begun(scene, early), scene, &mut look);
            let here = errors(&run(drive, early)?);
            squares = squares.with(here, |sum, e| sum + e * e);
            spread.worst = spread.worst.with(here, f64::max);
            spread.phases += 1;
        }
        let mut look = |time| watch(time);
        let results = measure(scene, &mut Drive::new(scene, &mut look))?;
        spread.estimate = sensitivity(scene, &results, 1, watch)?.step;
        Ok(())
    };
    let done = more(watch);
    spread.rms = squares.map(|sum| (sum / spread.phases as f64).sqrt());
    match done {
        Err(RunError::Stopped { .. }) => Ok(()),
        done => done,
    }
}

/// The engine of a scene without gravity that begins so much earlier, s, in free flight.
fn begun(scene: &Scene, early: f64) -> Box<dyn Engine> {
    let mut state = build(scene, None).0.state();
    state.gaps[0] -= state.rates[0] * early;
    build(scene, Some(&state)).0
}
