//! A column under gravity: chaotic, so that two right runs part. What can be compared
//! are the growth of the distance, the time until it can be seen, and the means.

mod tables;

use super::{AccuracyError, Candidate, Effort, Report, candidates};
use crate::math;
use crate::physics::Observation;
use crate::scene::{MethodName, Scene};
use crate::study::fit::slope;
use crate::study::means::Means;
use crate::study::{Drive, RunError, Tell, in_time, one_ulp_off};
use std::time::{Duration, Instant};

/// Looks at the column in a period.
const LOOKS: usize = 100;

/// Parts of a period in each of which the largest distance is taken.
const WINDOWS: usize = 10;

/// Periods of a scene whose floor stands still.
const PERIODS: f64 = 100.0;

/// Fewest periods that say something.
const LEAST_PERIODS: f64 = 2.0;

/// Numbers of a path that are kept, 64 MiB of them.
const MOST_NUMBERS: usize = 8_000_000;

/// Distance, in diameters, at which two runs are said to have parted.
const PARTED: f64 = 0.01;

/// The beginning of a run, which still depends on how it started.
const SETTLING: f64 = 0.1;

/// Tolerances of it.
const TOLERANCES: [f64; 2] = [1e-4, 1e-6];

/// Steps of the ladder that are worth their time here.
const STEPS: [f64; 3] = [50.0, 100.0, 200.0];

/// A run, looked at in equal intervals.
struct PlateTrace {
    /// Heights of all beads at each look, as long as they are kept.
    path: Vec<f64>,
    /// Of the periods after the settling.
    means: Means,
    steps: u64,
    events: u64,
    seconds: f64,
    /// Simulated time, s.
    end: f64,
}

/// When looks are taken.
#[derive(Debug, Clone, Copy, PartialEq)]
struct Looks {
    period: f64,
    duration: f64,
}

impl Looks {
    /// The part of a period in which a distance is taken, s.
    fn window(self) -> f64 {
        self.period / WINDOWS as f64
    }
}

/// How the distance from the reference grows.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
struct Growth {
    /// Exponential rate, 1/s.
    rate: Option<f64>,
    /// When it exceeds [`PARTED`] diameters, s.
    parted: Option<f64>,
}

/// A run of the report.
struct PlateRow {
    name: &'static str,
    setting: String,
    outcome: Result<PlateTrace, (RunError, f64)>,
    /// Largest distance of a bead from the reference in each tenth of a period, m.
    distances: Vec<f64>,
    growth: Growth,
}

pub(super) fn report(
    reference: &Scene,
    scene: &Scene,
    effort: Effort,
    tell: &mut Tell,
) -> Result<Report, AccuracyError> {
    let duration = scene.duration.unwrap_or(0.0);
    let mut looks = Looks {
        period: scene.period().unwrap_or(duration / PERIODS),
        duration,
    };
    let all: Vec<Candidate> = candidates(scene, effort.quick)
        .into_iter()
        .filter(|candidate| match candidate.rung {
            Some(("steps_per_contact", steps)) => STEPS.contains(&steps),
            Some((_, tolerance)) => TOLERANCES.contains(&tolerance),
            None => !candidate.is_reference(),
        })
        .collect();
    let started = Instant::now();
    // What one run leaves is for those that follow.
    let share = |left: usize| {
        let rest = effort.time.saturating_sub(started.elapsed());
        rest / u32::try_from(left).unwrap_or(u32::MAX)
    };
    let first = share(all.len() + 2);
    // The runs take about the same shares of the time, those that follow a short one more.
    let count = (all.len() + 2) as f64;
    let mut tell = |k: usize, what: &str, part: f64| tell(what, Some((k as f64 + part) / count));
    let mut once = |part| tell(0, "the exact run", part);
    let truth = match run(Beginning::Exactly, reference, looks, first, &mut once) {
        Ok(run) => run,
        // As far as the time allows, in whole periods; all others go as far.
        Err((RunError::Stopped { time }, _)) if time > LEAST_PERIODS * looks.period => {
            looks.duration = (time / looks.period).floor() * looks.period;
            let mut again = |part| tell(1, "the exact run, once more", part);
            run(Beginning::Exactly, reference, looks, 4 * first, &mut again).map_err(|e| e.0)?
        }
        Err((RunError::Stopped { time }, seconds)) => {
            return Err(AccuracyError::TooSlow {
                needed: (time > 0.0).then(|| seconds * LEAST_PERIODS * looks.period / time),
                share: first.as_secs_f64(),
            });
        }
        Err((error, _)) => return Err(error.into()),
    };
    let mut rows = Vec::new();
    let mut off = |part| tell(1, "the exact run, one bit off", part);
    let near = run(Beginning::OneUlpOff, reference, looks, 4 * first, &mut off);
    rows.push(row(
        "exact",
        "last bit".to_owned(),
        near,
        &truth,
        scene,
        looks,
    ));
    for (k, candidate) in all.iter().enumerate() {
        let name = candidate.method.as_str();
        let label = format!("{name} {}", candidate.setting());
        let outcome = run(
            Beginning::Exactly,
            &candidate.scene,
            looks,
            share(all.len() - k),
            &mut |part| tell(k + 2, &label, part),
        );
        rows.push(row(
            name,
            candidate.setting(),
            outcome,
            &truth,
            scene,
            looks,
        ));
    }
    Ok(tables::report(&rows, &truth, scene, looks))
}

/// Where a run begins.
#[derive(Debug, Clone, Copy, PartialEq)]
enum Beginning {
    Exactly,
    OneUlpOff,
}

/// A run of `most` of the time; `tell` hears which part of the run is done, or of the time.
fn run(
    from: Beginning,
    scene: &Scene,
    looks: Looks,
    most: Duration,
    tell: &mut dyn FnMut(f64),
) -> Result<PlateTrace, (RunError, f64)> {
    let started = Instant::now();
    let mut within = in_time(started + most);
    let mut watch = |time: f64| {
        let spent = started.elapsed().as_secs_f64() / most.as_secs_f64();
        tell((time / looks.duration).max(spent).min(1.0));
        within(time)
    };
    let mut drive = match from {
        Beginning::Exactly => Drive::new(scene, &mut watch),
        Beginning::OneUlpOff => Drive::of(one_ulp_off(scene, 0), scene, &mut watch),
    };
    let mut run = PlateTrace {
        path: Vec::new(),
        means: Means::new(scene, LOOKS),
        steps: 0,
        events: 0,
        seconds: 0.0,
        end: 0.0,
    };
    let followed = follow(&mut drive, scene, looks, &mut run);
    run.seconds = started.elapsed().as_secs_f64();
    match followed {
        Ok(()) => Ok(run),
        Err(error) => Err((error, run.seconds)),
    }
}

fn follow(
    drive: &mut Drive,
    scene: &Scene,
    looks: Looks,
    run: &mut PlateTrace,
) -> Result<(), RunError> {
    let mut seen = Observation::default();
    let interval = looks.period / LOOKS as f64;
    let mut look = 0.0;
    while (look + 1.0) * interval <= looks.duration * (1.0 + 1e-12) {
        look += 1.0;
        let time = look * interval;
        drive.advance(time)?;
        drive.observe(&mut seen);
        if run.path.len() + scene.n <= MOST_NUMBERS {
            let late = time - seen.time;
            let place = |(z, v): (&f64, &f64)| z + late * v;
            run.path
                .extend(seen.reduced.iter().zip(&seen.velocities).map(place));
        }
        // From the look at the settling's end on, which rounding must not lose.
        if time >= SETTLING * looks.duration * (1.0 - 1e-12) {
            run.means.look(&seen);
        }
    }
    (run.steps, run.events, run.end) = (seen.steps, seen.events, drive.time());
    Ok(())
}

fn row(
    name: &'static str,
    setting: String,
    outcome: Result<PlateTrace, (RunError, f64)>,
    truth: &PlateTrace,
    scene: &Scene,
    looks: Looks,
) -> PlateRow {
    let distances = match &outcome {
        Ok(run) => distances(run, truth, scene.n),
        Err(_) => Vec::new(),
    };
    let mut growth = growth(&distances, looks.window(), scene.diameter);
    if name == MethodName::Ed.as_str() {
        // Another model is not an error that grows.
        growth.rate = None;
    }
    PlateRow {
        name,
        setting,
        outcome,
        distances,
        growth,
    }
}

/// Largest distance of any bead in each tenth of a period.
fn distances(run: &PlateTrace, truth: &PlateTrace, n: usize) -> Vec<f64> {
    let apart: Vec<f64> = run
        .path
        .iter()
        .zip(&truth.path)
        .map(|(a, b)| (a - b).abs())
        .collect();
    apart
        .chunks_exact(n * LOOKS / WINDOWS)
        .map(|window| window.iter().fold(0.0, |a, &b| f64::max(a, b)))
        .collect()
}

/// The rate is that of the line through the logarithms up to the parting.
fn growth(distances: &[f64], window: f64, diameter: f64) -> Growth {
    let end = distances.iter().position(|&d| d > PARTED * diameter);
    let before = &distances[..end.unwrap_or(distances.len())];
    let point = |(k, d): (usize, &f64)| (*d > 0.0).then(|| (k as f64 * window, math::ln(*d)));
    let points: Vec<_> = before.iter().enumerate().filter_map(point).collect();
    Growth {
        // Less than half a period makes no trend.
        rate: (points.len() >= WINDOWS / 2)
            .then(|| slope(&points))
            .flatten(),
        parted: end.map(|k| (k + 1) as f64 * window),
    }
}
