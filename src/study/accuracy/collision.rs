//! A floor collision: one right answer, and every method's distance from it.

mod tables;

use super::compared::{CollisionTrace, errors, run};
use super::phases::{Spread, over_phases};
use super::{AccuracyError, Candidate, Effort, Report, candidates};
use crate::scene::Scene;
use crate::study::{Drive, RunError, Tell, in_time, one_ulp_off};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Times at which trajectories are compared.
const SAMPLES: f64 = 200.0;

/// Runs over which a median is taken, where there is time.
const MOST_RUNS: usize = 15;

/// Parts of the work, where the time does not end it: the first run of every method, and
/// its other phases with the estimate of `run`, two dozen runs, beside [`MOST_RUNS`].
const FIRST_PART: f64 = 0.02;
const PHASES_PART: f64 = 0.6;

/// Rounding in a number whose true value is of the order 1.
const ROUNDING: f64 = f64::EPSILON;

/// One row of the report.
struct CandidateRow {
    candidate: Candidate,
    outcome: Result<(CollisionTrace, Spread), RunError>,
    times: Vec<f64>,
}

pub(super) fn report(
    reference: &Scene,
    scene: &Scene,
    effort: Effort,
    tell: &mut Tell,
) -> Result<Report, AccuracyError> {
    let started = Instant::now();
    // The work comes to its end, or the time does.
    let mut tell = |what: &str, part: f64| {
        let spent = started.elapsed().as_secs_f64() / effort.time.as_secs_f64();
        tell(what, Some(part.max(spent)));
    };
    tell("the exact run", 0.0);
    let share = effort.time / 4;
    let mut in_share = in_time(started + share);
    let first = run(Drive::new(reference, &mut in_share), reference, &[], 0.0);
    let first = first.map_err(|error| match error {
        RunError::Stopped { .. } => AccuracyError::TooSlow {
            needed: None,
            share: share.as_secs_f64(),
        },
        error @ RunError::Engine(_) => error.into(),
    })?;
    let mut unwatched = |_| ControlFlow::Continue(());
    let times = sample_times(reference, &first);
    let truth = run(
        Drive::new(reference, &mut unwatched),
        reference,
        &times,
        0.0,
    )?;
    let off = one_ulp_off(reference, 0);
    let near = run(
        Drive::of(off, reference, &mut unwatched),
        reference,
        &times,
        0.0,
    )?;
    let scale = unit_of_length(reference);
    let sensitivity = errors(&near, &truth, scale);
    let all = candidates(scene, effort.quick);
    let count = all.len() as f64;
    let mut rows: Vec<CandidateRow> = Vec::new();
    let mut costs: Vec<f64> = Vec::new();
    for candidate in all {
        let label = format!("{} {}", candidate.method.as_str(), candidate.setting());
        tell(&label, FIRST_PART * rows.len() as f64 / count);
        let begun = Instant::now();
        let mut watch = in_time(started + effort.time);
        let drive = Drive::new(&candidate.scene, &mut watch);
        let outcome = run(drive, &candidate.scene, &times, 0.0).map(|run| {
            let errors = if candidate.is_reference() {
                sensitivity
            } else {
                errors(&run, &truth, scale)
            };
            (run, Spread::of_one(errors))
        });
        costs.push(begun.elapsed().as_secs_f64());
        rows.push(CandidateRow {
            candidate,
            outcome,
            times: Vec::new(),
        });
    }
    let all_costs: f64 = costs.iter().sum();
    // The other phases have half of what is left, in equal shares.
    for k in 0..rows.len() {
        let left = effort.time.saturating_sub(started.elapsed());
        let share = left / u32::try_from(2 * (rows.len() - k)).unwrap_or(u32::MAX);
        let done = costs[..k].iter().sum::<f64>() / all_costs;
        tell("other phases of the grids", FIRST_PART + PHASES_PART * done);
        let mut watch = in_time(Instant::now() + share);
        let CandidateRow {
            candidate, outcome, ..
        } = &mut rows[k];
        let Ok((_, spread)) = outcome else { continue };
        let of_phases = over_phases(
            candidate,
            spread,
            &mut watch,
            |drive, early| run(drive, &candidate.scene, &times, early),
            |run| errors(run, &truth, scale),
        );
        if let Err(error) = of_phases {
            *outcome = Err(error);
        }
    }
    measure_times(&mut rows, started, effort.time, &mut tell);
    Ok(tables::report(&rows, &truth, sensitivity))
}

/// |v₀| t_c, m, the unit of the trajectory's error.
fn unit_of_length(scene: &Scene) -> f64 {
    let speed = scene.launch().map_or(0.0, |launch| launch.v0.abs());
    speed * scene.contact_time().unwrap_or(1.0)
}

/// Whole contact times, which all grids of the ladder share, until some time after the
/// floor is left: later the error only grows with the distance flown.
fn sample_times(scene: &Scene, run: &CollisionTrace) -> Vec<f64> {
    let contact_time = scene.contact_time().unwrap_or(run.end);
    let end = run.left.map_or(run.end, |left| run.end.min(2.0 * left));
    let stride = (end / (SAMPLES * contact_time)).ceil().max(1.0);
    let mut times = Vec::new();
    let mut k = stride;
    while k * contact_time <= end {
        times.push(k * contact_time);
        k += stride;
    }
    times
}

/// Runs all candidates in turn, again and again, so that what else the machine does
/// falls on all of them alike.
fn measure_times(
    rows: &mut [CandidateRow],
    started: Instant,
    most: Duration,
    tell: &mut dyn FnMut(&str, f64),
) {
    let share = most.as_secs_f64() / rows.len().max(1) as f64;
    for round in 0..MOST_RUNS {
        for row in rows.iter_mut() {
            let spent: f64 = row.times.iter().sum();
            let last = row.times.last().copied().unwrap_or(0.0);
            if row.outcome.is_err() || spent + last > share {
                continue;
            }
            // The first run of all is always there, whatever the time.
            if round > 0 && started.elapsed() >= most {
                return;
            }
            let mut unwatched = |_| ControlFlow::Continue(());
            let begun = Instant::now();
            let mut drive = Drive::new(&row.candidate.scene, &mut unwatched);
            if drive.collide(&row.candidate.scene).is_ok() {
                row.times.push(begun.elapsed().as_secs_f64());
            }
        }
        let before = FIRST_PART + PHASES_PART;
        let done = (round + 1) as f64 / MOST_RUNS as f64;
        tell("run times", before + (1.0 - before) * done);
    }
}
