//! The lines of a sweep's file: what was swept, and a row for each point.

use crate::cli::SweepArgs;
use crate::scene::Scene;
use crate::scene::parameters::{self, Value};
use crate::scene::words::{one_line, quote};
use crate::study::quantity::{self, Quantity};
use crate::study::sweep::Sweep;
use crate::study::table::Cell;
use crate::study::{Findings, RunError};
use std::fmt::Write;

/// What became of one point.
pub(super) struct PointRow {
    /// A cell for each quantity.
    results: Option<Vec<Cell>>,
    note: String,
}

impl PointRow {
    /// Of a run. Results that are no numbers are as good as none.
    pub fn of(outcome: Result<Findings, RunError>) -> Self {
        let failed = |note: String| Self {
            results: None,
            note,
        };
        let findings = match outcome {
            Ok(findings) => findings,
            Err(error) => return failed(one_line(&error.to_string())),
        };
        if let Some((name, _)) = findings.not_finite() {
            return failed(format!("{name} is not a finite number"));
        }
        Self {
            note: findings.remarks.join("; "),
            results: Some(findings.all.into_iter().map(|each| each.cell).collect()),
        }
    }

    /// Whether the run has no results.
    pub fn failed(&self) -> bool {
        self.results.is_none()
    }
}

/// A cell as it is written.
fn written(cell: &Cell) -> String {
    match cell {
        Cell::Empty => String::new(),
        Cell::Word(word) => quoted(word),
        Cell::Count(count) => count.to_string(),
        Cell::Number(x) => Value::Number(*x).to_string(),
    }
}

/// How the lines of one sweep look.
pub(super) struct RowFormat {
    header: String,
    columns: Vec<&'static str>,
}

impl RowFormat {
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
            .chain(quantity::of_runs().map(|measured| (measured.name, measured.unit)))
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
        let measured = quantity::of_runs().map(|measured| measured.name);
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
    pub fn line(values: &[Value], row: &PointRow) -> String {
        let mut line = start(values);
        match &row.results {
            Some(cells) => cells.iter().for_each(|cell| {
                line.push_str(&written(cell));
                line.push(',');
            }),
            None => quantity::of_runs().for_each(|_| line.push(',')),
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
        let note = all - 1;
        let of_counts = quantity::of_runs().filter(|measured| measured.is_count());
        let counts: Vec<&str> = of_counts.map(|measured| measured.name).collect();
        let certain = quantity::of_runs().position(Quantity::is_certain);
        let has_results = certain.is_some_and(|k| !cells[values.len() + k].is_empty());
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
            } else if counts.contains(name) {
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
