//! The results of a run, in three formats.

use crate::cli::Format;
use crate::commands::Failure;
use crate::scene::parameters::Value;
use crate::study::{digits, rounded};
use serde::ser::{Serialize, SerializeMap, Serializer};
use std::io::{self, IsTerminal, Write};

/// One result.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub(super) enum Cell {
    Word(String),
    Count(u64),
    Number(f64),
}

/// One result with its name, if the scene has it.
pub(super) struct Row {
    name: &'static str,
    cell: Option<Cell>,
    unit: &'static str,
    meaning: &'static str,
    /// Relative change that means nothing, if it is known: no digit beyond is printed.
    known: Option<f64>,
    /// Measures the machine, not the scene: another run gives another value.
    machine: bool,
}

impl Row {
    pub fn new(
        name: &'static str,
        cell: Option<Cell>,
        unit: &'static str,
        meaning: &'static str,
    ) -> Self {
        Self {
            name,
            cell,
            unit,
            meaning,
            known: None,
            machine: false,
        }
    }

    /// The row of a number that is known to this part of itself.
    pub fn known_to(mut self, part: Option<f64>) -> Self {
        self.known = part;
        if let (Some(Cell::Number(x)), Some(part)) = (&mut self.cell, part) {
            *x = rounded(*x, digits(part));
        }
        self
    }

    pub fn of_the_machine(
        name: &'static str,
        value: f64,
        unit: &'static str,
        meaning: &'static str,
    ) -> Self {
        Self {
            machine: true,
            ..Self::new(name, Some(Cell::Number(value)), unit, meaning)
        }
    }
}

/// All results of a run.
pub(super) struct Report {
    pub title: String,
    pub rows: Vec<Row>,
    /// Time that the run took, s.
    pub wall_time: f64,
}

impl Report {
    /// Refuses results that are not finite.
    pub fn check(&self) -> Result<(), Failure> {
        for Row { name, cell, .. } in &self.rows {
            if let Some(Cell::Number(x)) = cell
                && !x.is_finite()
            {
                return Err(Failure::Failed(format!(
                    "the run failed: {name} came out as {x}"
                )));
            }
        }
        Ok(())
    }

    /// The results in a format, with a newline at the end.
    pub fn written(&self, format: Format) -> String {
        match format {
            Format::Text => self.text(),
            Format::Csv => self.csv(),
            Format::Json => {
                let object = serde_json::to_string_pretty(self);
                object.expect("words and finite numbers can be written") + "\n"
            }
        }
    }

    /// How long it took, for a person at the terminal.
    pub fn tell_time(&self) {
        let mut stderr = io::stderr();
        if stderr.is_terminal() {
            let _ = writeln!(stderr, "took {:.3} s", self.wall_time);
        }
    }

    fn of_the_scene(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().filter(|row| !row.machine)
    }

    fn text(&self) -> String {
        let mut text = format!("{}\n\n", self.title);
        let shown = self.of_the_scene().filter(|row| row.cell.is_some());
        let width = shown.map(|row| row.name.len()).fold(18, usize::max);
        for Row {
            name,
            cell,
            unit,
            meaning,
            known,
            ..
        } in self.of_the_scene()
        {
            let Some(cell) = cell else { continue };
            let value = format!("{} {unit}", readable(cell, *known));
            let line = format!("{name:<width$} {:<20} {meaning}", value.trim_end());
            text += line.trim_end();
            text.push('\n');
        }
        text
    }

    /// One header, one row; what the scene does not have is an empty cell.
    fn csv(&self) -> String {
        let mut writer = csv::Writer::from_writer(Vec::new());
        let header: Vec<_> = self.of_the_scene().map(|row| row.name).collect();
        let cells: Vec<_> = self.of_the_scene().map(|row| &row.cell).collect();
        let bytes = writer
            .write_record(header)
            .and_then(|()| writer.serialize(cells))
            .ok()
            .and_then(|()| writer.into_inner().ok())
            .expect("memory takes whatever is written");
        String::from_utf8(bytes).expect("the cells were text")
    }
}

/// Ten digits are more than a person reads.
fn readable(cell: &Cell, known: Option<f64>) -> String {
    match cell {
        Cell::Word(word) => word.clone(),
        Cell::Count(count) => count.to_string(),
        Cell::Number(x) => {
            let most = known.map_or(10, digits).min(10);
            Value::Number(rounded(*x, most)).to_string()
        }
    }
}

/// As one object, in the order of the rows.
impl Serialize for Report {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        for row in &self.rows {
            if let Some(cell) = &row.cell {
                object.serialize_entry(row.name, cell)?;
            }
        }
        object.end()
    }
}
