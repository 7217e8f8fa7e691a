//! A floor collision: one right answer, and every method's distance from it.

use super::phases::{Spread, over_phases};
use super::{AccuracyError, Candidate, Effort, Report, candidates};
use crate::physics::Observation;
use crate::scene::{MethodName, Scene, Start};
use crate::study::fit::{median, slope};
use crate::study::plot::{Axis, Plot, Series};
use crate::study::table::{Cell, Column, Digits, Table};
use crate::study::{Drive, RunError, Tell, digits, in_time, one_ulp_off, rounded};
use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Times at which trajectories are compared.
const SAMPLES: f64 = 200.0;

/// Runs over which a median is taken, where there is time.
const MOST_RUNS: usize = 15;

/// Rounding in a number whose true value is of the order 1.
const ROUNDING: f64 = f64::EPSILON;

/// A collision, and where the beads were at the sample times.
pub(super) struct Run {
    eps_eff: f64,
    er_over_ef: Option<f64>,
    path: Vec<f64>,
    steps: u64,
    events: u64,
    /// When it was over, s.
    end: f64,
    /// When bead 1 last left the floor, s.
    left: Option<f64>,
}

/// Distance of a run from the reference; relative, the trajectory's over |v₀| t_c.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Errors {
    eps_eff: f64,
    er_over_ef: Option<f64>,
    trajectory: f64,
}

impl Errors {
    /// Each of them changed.
    pub fn map(self, change: impl Fn(f64) -> f64) -> Self {
        Self {
            eps_eff: change(self.eps_eff),
            er_over_ef: self.er_over_ef.map(&change),
            trajectory: change(self.trajectory),
        }
    }

    /// Each of them together with the same one of another run.
    pub fn with(self, other: Self, both: impl Fn(f64, f64) -> f64) -> Self {
        let shares = self.er_over_ef.zip(other.er_over_ef);
        Self {
            eps_eff: both(self.eps_eff, other.eps_eff),
            er_over_ef: shares.map(|(a, b)| both(a, b)),
            trajectory: both(self.trajectory, other.trajectory),
        }
    }
}

/// One row of the report.
struct Row {
    candidate: Candidate,
    outcome: Result<(Run, Spread), RunError>,
    times: Vec<f64>,
}

pub(super) fn report(
    reference: &Scene,
    scene: &Scene,
    effort: Effort,
    tell: &mut Tell,
) -> Result<Report, AccuracyError> {
    let started = Instant::now();
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
    let mut rows: Vec<Row> = Vec::new();
    for candidate in all {
        let label = format!("{} {}", candidate.method.as_str(), candidate.setting());
        tell(&label, 0.5 * rows.len() as f64 / count);
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
        rows.push(Row {
            candidate,
            outcome,
            times: Vec::new(),
        });
    }
    // The other phases have half of what is left, in equal shares.
    for k in 0..rows.len() {
        let left = effort.time.saturating_sub(started.elapsed());
        let share = left / u32::try_from(2 * (rows.len() - k)).unwrap_or(u32::MAX);
        let mut watch = in_time(Instant::now() + share);
        let Row {
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
    measure_times(&mut rows, started, effort.time, tell);
    Ok(Report {
        tables: vec![table(&rows, &truth, sensitivity), orders(&rows)],
        plots: vec![plot(&rows)],
    })
}

/// |v₀| t_c, m, the unit of the trajectory's error.
fn unit_of_length(scene: &Scene) -> f64 {
    let speed = match scene.start {
        Start::Separated { v0, .. } => v0.abs(),
        Start::Resting => 0.0,
    };
    speed * scene.contact_time().unwrap_or(1.0)
}

/// Whole contact times, which all grids of the ladder share, until some time after the
/// floor is left: later the error only grows with the distance flown.
fn sample_times(scene: &Scene, run: &Run) -> Vec<f64> {
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

/// A collision that began so much `early`, s, and where the beads were at times of the one
/// that did not.
fn run(mut drive: Drive, scene: &Scene, times: &[f64], early: f64) -> Result<Run, RunError> {
    let mut seen = Observation::default();
    drive.observe(&mut seen);
    let before = seen.energy.kinetic;
    let mut path = Vec::with_capacity(times.len() * scene.n);
    for time in times.iter().map(|time| time + early) {
        // A grid point that rounding put behind the time is meant all the same.
        drive.advance(time * (1.0 + 4.0 * f64::EPSILON))?;
        drive.observe(&mut seen);
        let late = time - seen.time;
        let place = |(z, v): (&f64, &f64)| z + late * v;
        path.extend(seen.reduced.iter().zip(&seen.velocities).map(place));
    }
    drive.collide(scene)?;
    drive.observe(&mut seen);
    let after = seen.energy.kinetic;
    Ok(Run {
        eps_eff: (after / before).sqrt(),
        er_over_ef: (after > 0.0).then(|| seen.energy.relative / after),
        path,
        steps: seen.steps,
        events: seen.events,
        end: drive.time(),
        left: seen.floor_left,
    })
}

fn errors(run: &Run, truth: &Run, unit_of_length: f64) -> Errors {
    let relative = |x: f64, y: f64| if x == y { 0.0 } else { (x / y - 1.0).abs() };
    let apart = run.path.iter().zip(&truth.path).map(|(a, b)| (a - b).abs());
    Errors {
        eps_eff: relative(run.eps_eff, truth.eps_eff),
        er_over_ef: run
            .er_over_ef
            .zip(truth.er_over_ef)
            .map(|(a, b)| relative(a, b)),
        trajectory: apart.fold(0.0, f64::max) / unit_of_length,
    }
}

/// Runs all candidates in turn, again and again, so that what else the machine does
/// falls on all of them alike.
fn measure_times(rows: &mut [Row], started: Instant, most: Duration, tell: &mut Tell) {
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
        tell(
            "run times",
            0.5 + 0.5 * (round + 1) as f64 / MOST_RUNS as f64,
        );
    }
}

fn table(rows: &[Row], truth: &Run, sensitivity: Errors) -> Table {
    let two = Digits::Significant(2);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("setting", "setting", ""),
        Column::new("error_kind", "error", ""),
        Column::new("eps_eff_error", "of eps_eff", "").with(two),
        Column::new("eps_eff_worst", "worst", "").with(two),
        Column::new("eps_eff_estimate", "estimate", "").with(two),
        Column::new("er_over_ef_error", "of E_r/E_f", "").with(two),
        Column::new("er_over_ef_worst", "", "").with(two),
        Column::new("trajectory_error", "of path", "|v0|t_c").with(two),
        Column::new("trajectory_worst", "", "").with(two),
        Column::new("phases", "", ""),
        Column::new("run_time", "run time", "s"),
        Column::new("work", "steps", ""),
        Column::new("eps_eff", "", ""),
        Column::new("er_over_ef", "", ""),
        Column::new("run_time_repeats", "", ""),
        Column::new("failure", "", ""),
    ];
    let mut table = Table::new("accuracy", "Error against run time", columns);
    for row in rows {
        table.push(cells(row, sensitivity));
    }
    let eps_eff = rounded(truth.eps_eff, digits(sensitivity.eps_eff).min(12));
    let share = truth.er_over_ef.map_or(String::new(), |share| {
        let part = sensitivity.er_over_ef.unwrap_or(0.0);
        let share = rounded(share, digits(part).min(9));
        format!(" and E_r/E_f = {share}")
    });
    table.notes = vec![
        format!(
            "The exact method gives eps_eff = {eps_eff}{share}; errors are relative to that, the \
             path's is the largest distance of any bead until twice the time at which the \
             floor is left."
        ),
        "Where the points of a grid fall between contact changes is chance: errors of gear and \
         verlet are the root of the mean square, and the worst, over 16 starts a 16th of a step \
         apart (fewer where the time was up). The estimate is what `run` prints as step_error, from other steps alone; the \
         drift of the energy ledger is no such error, and far smaller."
            .to_owned(),
        format!(
            "{} one bit of the start changes {:.0e} of eps_eff.",
            if has_rung(rows) {
                "Its own rows are distances from a run at a tolerance of 1e-12;"
            } else {
                "Its own row is what the last bit does:"
            },
            sensitivity.eps_eff.max(ROUNDING)
        ),
        "Hard spheres (ed) solve another problem: their distance is the model's, whatever \
         the time spent, and not an error of numbers. Their steps are collisions."
            .to_owned(),
    ];
    let failures = rows.iter().filter_map(|row| {
        let error = row.outcome.as_ref().err()?;
        let (name, setting) = (row.candidate.method.as_str(), row.candidate.setting());
        Some(format!("{name} {setting}: {error}."))
    });
    table.notes.extend(failures);
    table
}

/// A row; of results no digit beyond what the last bit of the start leaves.
fn cells(row: &Row, last_bit: Errors) -> Vec<Cell> {
    let kind = match &row.candidate {
        candidate if candidate.is_reference() => "last bit",
        candidate if candidate.is_other_model() => "model",
        _ => "numbers",
    };
    let (run, errors) = match &row.outcome {
        Ok((run, errors)) => (Some(run), Some(errors)),
        Err(_) => (None, None),
    };
    let failure = row.outcome.as_ref().err().map(ToString::to_string);
    vec![
        row.candidate.method.as_str().into(),
        row.candidate.setting().into(),
        if failure.is_some() { "failed" } else { kind }.into(),
        errors.map(|e| e.rms.eps_eff).into(),
        errors.map(|e| e.worst.eps_eff).into(),
        errors.and_then(|e| e.estimate).into(),
        errors.and_then(|e| e.rms.er_over_ef).into(),
        errors.and_then(|e| e.worst.er_over_ef).into(),
        errors.map(|e| e.rms.trajectory).into(),
        errors.map(|e| e.worst.trajectory).into(),
        errors.map(|e| e.phases as u64).into(),
        (!row.times.is_empty()).then(|| median(&row.times)).into(),
        run.map(|run| run.steps + run.events).into(),
        run.map(|run| rounded(run.eps_eff, digits(last_bit.eps_eff)))
            .into(),
        run.and_then(|run| run.er_over_ef)
            .map(|x| rounded(x, digits(last_bit.er_over_ef.unwrap_or(0.0))))
            .into(),
        (row.times.len() as u64).into(),
        failure.into(),
    ]
}

/// Observed order of convergence of every method with a ladder of steps.
fn orders(rows: &[Row]) -> Table {
    let one = Digits::Fixed(2);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("eps_eff_order", "of eps_eff", "").with(one),
        Column::new("er_over_ef_order", "of E_r/E_f", "").with(one),
        Column::new("trajectory_order", "of path", "").with(one),
    ];
    let mut table = Table::new("orders", "Observed order of convergence", columns);
    for method in MethodName::ALL {
        let rungs: Vec<(f64, Errors)> = rows
            .iter()
            .filter(|row| row.candidate.method == method)
            .filter_map(|row| {
                let (_, errors) = row.outcome.as_ref().ok()?;
                let (name, value) = row.candidate.rung?;
                (name == "steps_per_contact").then_some((value, errors.rms))
            })
            .collect();
        if rungs.len() < 2 {
            continue;
        }
        let order = |of: &dyn Fn(&Errors) -> Option<f64>| {
            let point = |(steps, errors): &(f64, Errors)| {
                let error = of(errors).filter(|&e| e > 0.0)?;
                Some((-steps.ln(), error.ln()))
            };
            slope(&rungs.iter().filter_map(point).collect::<Vec<_>>())
        };
        table.push([
            method.as_str().into(),
            order(&|e| Some(e.eps_eff)).into(),
            order(&|e| e.er_over_ef).into(),
            order(&|e| Some(e.trajectory)).into(),
        ]);
    }
    table.notes = vec![
        "Slope of log error over log step. The force of a contact jumps at its first touch \
         and at its end, which fall between steps: any fixed-step method is of first order \
         there, whatever its name."
            .to_owned(),
    ];
    table
}

/// Whether the exact method has tolerances.
fn has_rung(rows: &[Row]) -> bool {
    let mut candidates = rows.iter().map(|row| &row.candidate);
    candidates.any(|c| c.method == MethodName::Exact && !c.is_reference())
}

fn plot(rows: &[Row]) -> Plot {
    let mut series: BTreeMap<usize, Vec<(f64, f64)>> = BTreeMap::new();
    for row in rows {
        let at = MethodName::ALL
            .iter()
            .position(|&m| m == row.candidate.method);
        if let (Some(at), Ok((_, errors))) = (at, &row.outcome)
            && !row.times.is_empty()
        {
            let point = (median(&row.times), errors.rms.eps_eff.max(ROUNDING));
            series.entry(at).or_default().push(point);
        }
    }
    let named = |(at, points): (usize, Vec<(f64, f64)>)| {
        let name = match MethodName::ALL[at] {
            MethodName::Ed => "ed (another model)".to_owned(),
            MethodName::Exact if has_rung(rows) => "exact (tolerances)".to_owned(),
            MethodName::Exact => "exact (last bit)".to_owned(),
            method => method.as_str().to_owned(),
        };
        Series::new(name, points)
    };
    Plot {
        name: "accuracy".to_owned(),
        title: "Relative error of eps_eff against run time".to_owned(),
        x: Axis::log("run time, s"),
        y: Axis::log("relative error of eps_eff"),
        series: series.into_iter().map(named).collect(),
    }
}
