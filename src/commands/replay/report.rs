//! What a replay came to.

use crate::numerals::significant;
use crate::physics::Observation;
use crate::tape::{Replay, Tape};
use serde::Serialize;
use std::fmt::Write;

/// What is known of a column at the end.
#[derive(Serialize)]
struct ColumnReport {
    method: &'static str,
    beads: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    stopped: Option<String>,
    kinetic: f64,
    relative: f64,
    centre: f64,
}

/// All that is told.
#[derive(Serialize)]
struct ReplayReport {
    time: f64,
    edits: usize,
    states_compared: usize,
    #[serde(skip_serializing_if = "Option::is_none")]
    differs_at: Option<f64>,
    #[serde(skip_serializing_if = "Option::is_none")]
    cut_at_line: Option<usize>,
    columns: Vec<ColumnReport>,
}

fn columns(played: &Replay) -> Vec<ColumnReport> {
    let mut now = Observation::default();
    (0..played.player.columns())
        .filter_map(|index| {
            let scene = played.player.scene(index)?;
            played.player.observe(index, &mut now);
            Some(ColumnReport {
                method: scene.method.name().as_str(),
                beads: scene.n,
                stopped: played.player.failure(index).map(ToString::to_string),
                kinetic: now.energy.kinetic,
                relative: now.energy.relative,
                centre: now.centre,
            })
        })
        .collect()
}

/// As one JSON object.
pub(super) fn json(tape: &Tape, played: &Replay) -> String {
    let report = ReplayReport {
        time: played.player.reached(),
        edits: played.edits,
        states_compared: played.compared,
        differs_at: played.differs.map(|(time, _)| time),
        cut_at_line: tape.cut,
        columns: columns(played),
    };
    serde_json::to_string_pretty(&report).unwrap_or_default() + "\n"
}

/// As lines to read.
pub(super) fn text(tape: &Tape, played: &Replay) -> String {
    let mut text = String::new();
    let time = significant(played.player.reached(), 6);
    let _ = writeln!(text, "played to          t = {time} s");
    let _ = writeln!(text, "edits              {}", played.edits);
    let states = match played.differs {
        None => format!("{} compared, all as on the tape", played.compared),
        Some((time, column)) => {
            format!("column {column} differs from the tape from t = {time} s on")
        }
    };
    let _ = writeln!(text, "states             {states}");
    if let Some(line) = tape.cut {
        let _ = writeln!(text, "cut                at line {line}");
    }
    for (number, column) in (1..).zip(columns(played)) {
        let name = format!("column {number}");
        let ColumnReport { method, beads, .. } = column;
        let what = match column.stopped {
            Some(why) => why,
            None => format!(
                "E {}, E_r {} m²/s², centre {} m",
                significant(column.kinetic, 4),
                significant(column.relative, 4),
                significant(column.centre, 4)
            ),
        };
        let _ = writeln!(text, "{name:<18} {method}, N {beads}: {what}");
    }
    text
}
