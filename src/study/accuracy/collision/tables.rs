//! The report on a floor collision.

use crate::math;
use crate::numerals::{digits, rounded};
use std::collections::BTreeMap;

use super::{CandidateRow, ROUNDING};
use crate::scene::MethodName;
use crate::study::accuracy::Report;
use crate::study::accuracy::compared::{CollisionTrace, Errors};
use crate::study::fit::{median, slope};
use crate::study::plot::{Axis, Plot, Series};
use crate::study::table::{Cell, Column, Digits, Table};

pub(super) fn report(rows: &[CandidateRow], truth: &CollisionTrace, sensitivity: Errors) -> Report {
    Report {
        tables: vec![table(rows, truth, sensitivity), orders(rows)],
        plots: vec![plot(rows)],
    }
}

fn table(rows: &[CandidateRow], truth: &CollisionTrace, sensitivity: Errors) -> Table {
    let two = Digits::Significant(2);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("setting", "setting", ""),
        Column::new("error_kind", "", ""),
        Column::new("eps_eff_error", "of eps_eff", "").with(two),
        Column::new("eps_eff_worst", "worst", "").with(two),
        Column::new("eps_eff_estimate", "estimate", "").with(two),
        Column::new("er_over_ef_error", "of E_r/E_f", "").with(two),
        Column::new("er_over_ef_worst", "", "").with(two),
        Column::new("trajectory_error", "of path", "|v0|t_c").with(two),
        Column::new("trajectory_worst", "", "").with(two),
        Column::new("phases", "", ""),
        Column::new("run_time", "run time", "s"),
        Column::new("work", "", ""),
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
         the time spent, and not an error of numbers. In files their work is collisions."
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
fn cells(row: &CandidateRow, last_bit: Errors) -> Vec<Cell> {
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
fn orders(rows: &[CandidateRow]) -> Table {
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
                Some((-math::ln(*steps), math::ln(error)))
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
fn has_rung(rows: &[CandidateRow]) -> bool {
    let mut candidates = rows.iter().map(|row| &row.candidate);
    candidates.any(|c| c.method == MethodName::Exact && !c.is_reference())
}

fn plot(rows: &[CandidateRow]) -> Plot {
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
