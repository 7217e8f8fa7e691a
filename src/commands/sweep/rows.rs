//! The lines of a sweep's file: what was swept, and a row for each point.

use crate::cli::SweepArgs;
use crate::scene::Scene;
use crate::scene::parameters::{self, Value};
use crate::scene::words::{one_line, quote};
use crate::study::sweep::Sweep;
use crate::study::{Results, RunError, Sensitivity, rounded};
use std::fmt::Write;

/// What is measured, with units, in the order of the columns.
const MEASURED: [(&str, &str); 19] = [
    ("eps_eff", ""),
    ("er_over_ef", ""),
    ("contact_duration", "s"),
    ("h_cm_mean", "m"),
    ("h_cm_error", "m"),
    ("er_over_e_mean", ""),
    ("er_over_e_error", ""),
    ("sigma", ""),
    ("overlap_max", ""),
    ("energy_drift", ""),
    ("step_error", ""),
    ("sensitivity", ""),
    ("er_over_ef_sensitivity", ""),
    ("contact_duration_sensitivity", ""),
    ("er_over_e_mean_sensitivity", ""),
    ("sigma_sensitivity", ""),
    ("events", ""),
    ("steps", ""),
    ("sim_time", "s"),
];

/// Where events and steps stand in it.
const COUNTS: [usize; 2] = [16, 17];

/// Digits of a number that is an error itself.
const ROUGHLY: usize = 2;

/// What became of one point.
pub(super) struct Row {
    results: Option<Cells>,
    note: String,
}

type Cells = [String; MEASURED.len()];

impl Row {
    /// Of the run of a scene. Results that are no numbers are as good as none.
    pub fn of(scene: &Scene, outcome: Result<(Results, Sensitivity), RunError>) -> Self {
        let failed = |note: String| Self {
            results: None,
            note,
        };
        let (results, known) = match outcome {
            Ok(measured) => measured,
            Err(error) => return failed(one_line(&error.to_string())),
        };
        let rough = |x: Option<f64>| x.map(|x| rounded(x, ROUGHLY));
        let numbers = [
            results.eps_eff,
            results.er_over_ef,
            results.contact_duration,
            results.h_cm_mean,
            rough(results.h_cm_error),
            results.er_over_e_mean,
            rough(results.er_over_e_error),
            results.sigma,
            rough(results.overlap_max),
            rough(Some(results.energy_drift)),
            rough(known.step),
            rough(known.main()),
            rough(known.er_over_ef),
            rough(known.contact_duration),
            rough(known.er_over_e_mean),
            rough(known.sigma),
            None,
            None,
            Some(results.sim_time),
        ];
        for (x, (name, _)) in numbers.iter().zip(MEASURED) {
            if x.is_some_and(|x| !x.is_finite()) {
                return failed(format!("{name} is not a finite number"));
            }
        }
        let mut cells = numbers.map(|x| x.map_or_else(String::new, number));
        let soft = scene.is_md();
        let counted = |is: bool, count: u64| if is { count.to_string() } else { String::new() };
        cells[COUNTS[0]] = counted(!soft, results.events);
        cells[COUNTS[1]] = counted(soft, results.steps);
        Self {
            results: Some(cells),
            note: results.remarks().join("; "),
        }
    }

    /// Whether the run has no results.
    pub fn failed(&self) -> bool {
        self.results.is_none()
    }
}

fn number(x: f64) -> String {
    Value::Number(x).to_string()
}

/// How the lines of one sweep look.
pub(super) struct Format {
    header: String,
    columns: Vec<&'static str>,
}

impl Format {
    /// Of a sweep of those arguments. The header is the same exactly when the rows are.
    pub fn of(sweep: &Sweep, args: &SweepArgs) -> Self {
        let names: Vec<&'static str> = sweep
            .axes()
            .iter()
            .map(|axis| axis.parameter.name)
            .collect();
        let scene = sweep.scene(0);
        let version = env!("CARGO_PKG_VERSION");
        let mut lines = vec![
            format!("beadlab {version} sweep"),
            format!("preset: {}", one_line(&args.preset)),
            format!("method: {}", scene.method.name().as_str()),
        ];
        if !args.settings.is_empty() {
            let settings: Vec<String> = args.settings.iter().map(|text| one_line(text)).collect();
            lines.push(format!("set: {}", settings.join(", ")));
        }
        for axis in sweep.axes() {
            let count = axis.values.len();
            lines.push(format!("over: {} ({count} values)", axis.written));
        }
        lines.push(format!("rows: {}, the last range fastest", sweep.rows()));
        lines.push(format!("scene: {}", facts(&scene, &names)));
        let seed = scene.seed;
        lines.push(if names.contains(&"seed") {
            "seed: swept".to_owned()
        } else {
            format!("seed: {seed}")
        });
        let swept = sweep
            .axes()
            .iter()
            .map(|axis| (axis.parameter.name, axis.parameter.unit));
        let units: Vec<String> = swept
            .chain(MEASURED)
            .filter(|(_, unit)| !unit.is_empty())
            .map(|(name, unit)| format!("{name} {unit}"))
            .collect();
        lines.push(format!(
            "units: {}; all others are pure numbers",
            units.join(", ")
        ));
        let mut header = String::new();
        for line in lines {
            // A String takes everything.
            let _ = writeln!(header, "# {line}");
        }
        let measured = MEASURED.iter().map(|(name, _)| *name);
        let columns: Vec<&'static str> = names
            .iter()
            .copied()
            .chain(measured)
            .chain(["note"])
            .collect();
        header.push_str(&columns.join(","));
        header.push('\n');
        Self { header, columns }
    }

    /// The lines before the first row.
    pub fn header(&self) -> &str {
        &self.header
    }

    /// The line of a row, its end included.
    pub fn line(values: &[Value], row: &Row) -> String {
        let mut line = start(values);
        let cells = row.results.clone().unwrap_or_default();
        for cell in &cells {
            line.push_str(cell);
            line.push(',');
        }
        line.push_str(&quoted(&row.note));
        line.push('\n');
        line
    }

    /// Whether the row of these values has results, of its line without the end.
    ///
    /// # Errors
    /// The first cell that cannot be one of it: where, what it is, and what it must be.
    pub fn check(&self, line: &[u8], values: &[Value]) -> Result<bool, String> {
        let mut cells = csv::ByteRecord::new();
        csv::ReaderBuilder::new()
            .has_headers(false)
            .flexible(true)
            .terminator(csv::Terminator::Any(b'\n'))
            .from_reader(line)
            .read_byte_record(&mut cells)
            .map_err(|error| format!(": {error}"))?;
        let (found, all) = (cells.len(), self.columns.len());
        if found != all {
            return Err(format!(": {found} cells, must be {all}"));
        }
        let text = |k: usize| std::str::from_utf8(&cells[k]).unwrap_or("\u{fffd}");
        let (first, note) = (values.len(), all - 1);
        let has_results = !cells[note - 1].is_empty();
        for (k, name) in self.columns.iter().enumerate() {
            let text = text(k);
            let (is_right, must) = if let Some(value) = values.get(k) {
                let value = value.to_string();
                (text == value, value)
            } else if k == note {
                let has_reason = has_results || !text.is_empty();
                let is_text = one_line(text) == text && !text.contains('\u{fffd}');
                (has_reason && is_text, "the row's note".to_owned())
            } else if !has_results {
                let none = "empty, since the row has no results";
                (text.is_empty(), none.to_owned())
            } else if COUNTS.contains(&(k - first)) {
                let is_count = text.is_empty() || text.parse::<u64>().is_ok();
                (is_count, "a whole number".to_owned())
            } else {
                let is_number = text.parse().is_ok_and(f64::is_finite);
                (text.is_empty() || is_number, "a number".to_owned())
            };
            if !is_right {
                let (column, text) = (k + 1, quote(text));
                return Err(format!(
                    ", column {column} ({name}): `{text}` must be {must}"
                ));
            }
        }
        Ok(has_results)
    }

    /// Whether a line that has no end may be that of these values.
    pub fn is_begun(line: &[u8], values: &[Value]) -> bool {
        let start = start(values);
        start.as_bytes().starts_with(line) || line.starts_with(start.as_bytes())
    }
}

/// The cells of the swept parameters.
fn start(values: &[Value]) -> String {
    let cells: Vec<String> = values.iter().map(Value::to_string).collect();
    cells.join(",") + ","
}

/// The facts of the first row that are not swept.
fn facts(scene: &Scene, swept: &[&str]) -> String {
    let known: Vec<String> = parameters::table()
        .iter()
        .filter(|parameter| !swept.contains(&parameter.name))
        .filter_map(|parameter| Some((parameter.name, (parameter.get)(scene)?)))
        .map(|(name, value)| format!("{name}={value}"))
        .collect();
    known.join(" ")
}

/// A cell of free text.
fn quoted(text: &str) -> String {
    if text.contains([',', '"']) {
        format!("\"{}\"", text.replace('"', "\"\""))
    } else {
        text.to_owned()
    }
}
