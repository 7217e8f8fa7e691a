//! The report on a column under gravity.

use super::{Looks, PARTED, PlateRow, PlateTrace, SETTLING, WINDOWS};
use crate::scene::Scene;
use crate::study::RunError;
use crate::study::accuracy::Report;
use crate::study::means::Mean;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Cell, Column, Digits, Table};

pub(super) fn report(rows: &[PlateRow], truth: &PlateTrace, scene: &Scene, looks: Looks) -> Report {
    let mut parting = parting(rows, scene, looks);
    let shortened = scene.duration.is_some_and(|all| looks.duration < all);
    if shortened {
        parting.notes.push(format!(
            "All runs end at {:.3} s, which is as far as the exact one comes in its share of \
             the time; --budget gives more.",
            looks.duration
        ));
    }
    Report {
        tables: vec![parting, statistics(rows, truth, looks)],
        plots: vec![plot(rows, looks)],
    }
}

/// How trajectories part.
fn parting(rows: &[PlateRow], scene: &Scene, looks: Looks) -> Table {
    let two = Digits::Significant(2);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("setting", "setting", ""),
        Column::new("first_distance", "1st period", "d").with(two),
        Column::new("growth_rate", "growth", "1/s"),
        Column::new("growth_per_period", "growth", "1/period").with(two),
        Column::new("parted", "parted at", "s"),
        Column::new("run_time", "run time", "s"),
        Column::new("steps", "", ""),
        Column::new("events", "", ""),
        Column::new("failure", "", ""),
    ];
    let mut table = Table::new("growth", "Distance from the exact run", columns);
    for row in rows {
        let run = row.outcome.as_ref().ok();
        let failure = row.outcome.as_ref().err().map(|failed| why(failed, looks));
        if let Some(reason) = &failure {
            let note = format!("{} {}: {reason}.", row.name, row.setting);
            table.notes.push(note);
        }
        table.push([
            row.name.into(),
            row.setting.clone().into(),
            first_period(row).map(|d| d / scene.diameter).into(),
            row.growth.rate.into(),
            row.growth.rate.map(|rate| rate * looks.period).into(),
            row.growth.parted.into(),
            run.map(|run| run.seconds).into(),
            run.map(|run| run.steps).into(),
            run.map(|run| run.events).into(),
            failure.into(),
        ]);
    }
    table.notes.push(format!(
        "Distance: the largest of any bead. Two runs have parted when it exceeds {PARTED} d; \
         the growth is fitted before that. A period is {}{:.4} s. The first row starts one bit \
         off and is as right as the reference: no method can stay with it longer. Hard \
         spheres (ed) solve another problem.",
        if scene.period().is_some() {
            "the plate's, "
        } else {
            "a hundredth of the run, "
        },
        looks.period
    ));
    table
}

/// The largest distance in the first period, m.
fn first_period(row: &PlateRow) -> Option<f64> {
    let distances = row.distances.iter().take(WINDOWS).copied();
    distances.reduce(f64::max)
}

/// Why a run has no end, with the time that it would take.
fn why((error, seconds): &(RunError, f64), looks: Looks) -> String {
    match error {
        RunError::Stopped { time } if *time > 0.0 => {
            let needed = seconds * looks.duration / time;
            format!("too slow, it would take {needed:.1} s; --budget gives more time")
        }
        error => error.to_string(),
    }
}

/// Means and how far they are from the exact run's.
fn statistics(rows: &[PlateRow], truth: &PlateTrace, looks: Looks) -> Table {
    let one = Digits::Fixed(1);
    let two = Digits::Significant(2);
    let four = Digits::Significant(4);
    let columns = [
        Column::new("method", "method", ""),
        Column::new("setting", "setting", ""),
        Column::new("height", "h_cm", "m").with(four),
        Column::new("height_error", "+-", "m").with(two),
        Column::new("height_difference", "off by", "errors").with(one),
        Column::new("relative_share", "E_r/E", "").with(four),
        Column::new("relative_share_error", "+-", "").with(two),
        Column::new("relative_share_difference", "off by", "errors").with(one),
        Column::new("periods", "", ""),
    ];
    let mut table = Table::new("statistics", "Means over the run", columns);
    table.push(of_one("exact", "", truth, None));
    for row in rows {
        if let Ok(run) = &row.outcome {
            table.push(of_one(row.name, &row.setting, run, Some(truth)));
        }
    }
    table.notes = vec![format!(
        "Over {} periods; the first {:.0} % of the run are left out. h_cm is counted from the \
         resting column's; E_r/E is a mean over a mean. Standard errors come from blocks of \
         periods; a difference from the exact run is in units of both errors together, and \
         below 2 it is no difference.",
        ((1.0 - SETTLING) * looks.duration / looks.period).floor(),
        100.0 * SETTLING
    )];
    table
}

fn of_one(name: &str, setting: &str, run: &PlateTrace, truth: Option<&PlateTrace>) -> Vec<Cell> {
    let off = |mean: Option<Mean>, true_mean: Option<Mean>| {
        mean.zip(true_mean).and_then(|(a, b)| a.in_errors_from(b))
    };
    let height = |run: &PlateTrace| run.means.height(run.means.all());
    let share = |run: &PlateTrace| run.means.share(run.means.all());
    let (true_height, true_share) = (truth.and_then(height), truth.and_then(share));
    let (height, share) = (height(run), share(run));
    vec![
        name.into(),
        setting.into(),
        height.map(|mean| mean.value).into(),
        height.and_then(|mean| mean.error).into(),
        off(height, true_height).into(),
        share.map(|mean| mean.value).into(),
        share.and_then(|mean| mean.error).into(),
        off(share, true_share).into(),
        (run.means.blocks() as u64).into(),
    ]
}

fn plot(rows: &[PlateRow], looks: Looks) -> Plot {
    let series = rows.iter().filter(|row| !row.distances.is_empty());
    // What comes after the parting is as far apart as two runs can be.
    let parted = rows.iter().filter_map(|row| row.growth.parted);
    let end = parted
        .reduce(f64::max)
        .map_or(f64::INFINITY, |t| 1.5 * t + looks.period);
    let points = |row: &PlateRow| {
        let at = |(k, d): (usize, &f64)| ((k + 1) as f64 * looks.window(), *d);
        let points = row.distances.iter().enumerate().map(at);
        points.take_while(|&(t, _)| t <= end).collect()
    };
    let named = |row: &PlateRow| {
        format!("{} {}", row.name, row.setting)
            .trim_end()
            .to_owned()
    };
    Plot {
        name: "growth".to_owned(),
        title: "Distance from the exact run".to_owned(),
        x: Axis::linear("time, s"),
        y: Axis::log("largest distance of a bead, m"),
        series: series
            .map(|row| Series::new(named(row), points(row)).with(SeriesStyle::Line))
            .collect(),
    }
}
