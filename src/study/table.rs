//! Tables of results: text to read, CSV and JSON to reckon with.

use crate::numerals::{shortest, significant};
use serde::ser::{Serialize, SerializeMap, SerializeStruct, Serializer};
use std::borrow::Cow;
use std::fmt::Write;

/// One value of a table.
#[derive(Debug, Clone, PartialEq, serde::Serialize)]
#[serde(untagged)]
pub enum Cell {
    /// The row does not have this.
    Empty,
    /// A word.
    Word(String),
    /// A count.
    Count(u64),
    /// A finite number.
    Number(f64),
}

impl From<f64> for Cell {
    /// A number that is not finite is no result.
    fn from(x: f64) -> Self {
        if x.is_finite() {
            // −0 is a sign that means nothing.
            Self::Number(x + 0.0)
        } else {
            Self::Empty
        }
    }
}

impl From<u64> for Cell {
    fn from(count: u64) -> Self {
        Self::Count(count)
    }
}

impl From<&str> for Cell {
    fn from(word: &str) -> Self {
        Self::Word(word.to_owned())
    }
}

impl From<String> for Cell {
    fn from(word: String) -> Self {
        Self::Word(word)
    }
}

impl<T: Into<Cell>> From<Option<T>> for Cell {
    fn from(value: Option<T>) -> Self {
        value.map_or(Self::Empty, Into::into)
    }
}

/// How numbers of a column are shown in text.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Digits {
    /// So many significant digits, as 0.0123 or 1.2e-9.
    Significant(usize),
    /// So many digits after the point.
    Fixed(usize),
}

/// A column: what its values are.
#[derive(Debug, Clone, PartialEq)]
pub struct Column {
    /// Name in CSV and JSON, like `sim_time`.
    pub name: Cow<'static, str>,
    /// Heading in text; the column is left out of text where it is empty.
    pub heading: &'static str,
    /// SI unit; empty for pure numbers and words.
    pub unit: &'static str,
    /// How numbers are shown in text.
    pub digits: Digits,
}

impl Column {
    /// A column of numbers with three significant digits in text, or of words.
    pub const fn new(name: &'static str, heading: &'static str, unit: &'static str) -> Self {
        Self {
            name: Cow::Borrowed(name),
            heading,
            unit,
            digits: Digits::Significant(3),
        }
    }

    /// The same with other digits.
    #[must_use]
    pub const fn with(mut self, digits: Digits) -> Self {
        self.digits = digits;
        self
    }
}

/// A table of results.
#[derive(Debug, Clone, PartialEq)]
pub struct Table {
    /// Name of its file, without an ending.
    pub name: String,
    /// What it shows, in one line.
    pub title: String,
    /// What was simulated: names and values, the seed among them.
    pub facts: Vec<(String, String)>,
    /// The columns.
    pub columns: Vec<Column>,
    /// What a reader must know, one sentence or two each.
    pub notes: Vec<String>,
    rows: Vec<Vec<Cell>>,
}

impl Table {
    /// An empty table.
    pub fn new(
        name: impl Into<String>,
        title: impl Into<String>,
        columns: impl Into<Vec<Column>>,
    ) -> Self {
        Self {
            name: name.into(),
            title: title.into(),
            facts: Vec::new(),
            columns: columns.into(),
            notes: Vec::new(),
            rows: Vec::new(),
        }
    }

    /// Adds a row.
    ///
    /// # Panics
    /// When it has not one cell a column.
    pub fn push(&mut self, row: impl Into<Vec<Cell>>) {
        let row = row.into();
        assert_eq!(
            row.len(),
            self.columns.len(),
            "a row of {} has a cell a column",
            self.name
        );
        self.rows.push(row);
    }

    /// The rows.
    pub fn rows(&self) -> &[Vec<Cell>] {
        &self.rows
    }

    /// The cell of a row in the column of that name.
    pub fn get(&self, row: usize, column: &str) -> Option<&Cell> {
        let at = self.columns.iter().position(|c| c.name == column)?;
        self.rows.get(row).map(|cells| &cells[at])
    }

    /// Aligned columns under their headings and units, with the notes wrapped to `width`.
    pub fn text(&self, width: usize) -> String {
        let shown: Vec<usize> = (0..self.columns.len())
            .filter(|&c| !self.columns[c].heading.is_empty())
            .collect();
        let has_units = shown.iter().any(|&c| !self.columns[c].unit.is_empty());
        let line = |cell: &dyn Fn(usize) -> String| shown.iter().map(|&c| cell(c)).collect();
        let mut lines: Vec<Vec<String>> =
            vec![line(&|c: usize| self.columns[c].heading.to_owned())];
        if has_units {
            lines.push(line(&|c: usize| self.columns[c].unit.to_owned()));
        }
        let headings = lines.len();
        for row in &self.rows {
            lines.push(line(&|c: usize| show(&row[c], self.columns[c].digits)));
        }
        let widths: Vec<usize> = (0..shown.len())
            .map(|k| {
                lines
                    .iter()
                    .map(|l| l[k].chars().count())
                    .max()
                    .unwrap_or(0)
            })
            .collect();
        let left: Vec<bool> = shown.iter().map(|&c| self.is_of_words(c)).collect();
        let mut text = wrapped(&self.title, width, "");
        text.push('\n');
        for (l, cells) in lines.iter().enumerate() {
            let mut out = String::new();
            for (k, cell) in cells.iter().enumerate() {
                let w = widths[k];
                let gap = if k == 0 { "" } else { "  " };
                let _ = if left[k] {
                    write!(out, "{gap}{cell:<w$}")
                } else {
                    write!(out, "{gap}{cell:>w$}")
                };
            }
            text += out.trim_end();
            text.push('\n');
            if l + 1 == headings {
                let rule: usize = widths.iter().sum::<usize>() + 2 * widths.len().saturating_sub(1);
                text += &"-".repeat(rule.min(width));
                text.push('\n');
            }
        }
        if !self.notes.is_empty() {
            text.push('\n');
        }
        for note in &self.notes {
            text += &wrapped(note, width, "  ");
        }
        text
    }

    /// Words stand to the left, numbers to the right.
    fn is_of_words(&self, column: usize) -> bool {
        let mut cells = self.rows.iter().map(|row| &row[column]);
        cells.any(|cell| matches!(cell, Cell::Word(_)))
    }

    /// Full precision: `#` lines with title, facts, units and notes, a header, the rows.
    pub fn csv(&self) -> String {
        let mut text = format!("# {}\n", self.title);
        for (name, value) in &self.facts {
            let _ = writeln!(text, "# {name} = {value}");
        }
        let units: Vec<String> = self
            .columns
            .iter()
            .filter(|c| !c.unit.is_empty())
            .map(|c| format!("{} {}", c.name, c.unit))
            .collect();
        if !units.is_empty() {
            let _ = writeln!(text, "# units: {}", units.join(", "));
        }
        for note in &self.notes {
            let _ = writeln!(text, "# {note}");
        }
        let header = self.columns.iter().map(|c| c.name.to_string()).collect();
        let cells = |row: &Vec<Cell>| row.iter().map(exactly).collect();
        let rows = self.rows.iter().map(cells);
        text + &records(std::iter::once(header).chain(rows)).unwrap_or_default()
    }
}

/// Records as CSV; memory takes whatever is written.
fn records(mut records: impl Iterator<Item = Vec<String>>) -> Option<String> {
    let mut writer = csv::Writer::from_writer(Vec::new());
    records
        .try_for_each(|record| writer.write_record(record))
        .ok()?;
    String::from_utf8(writer.into_inner().ok()?).ok()
}

/// A number as the shortest text that reads as the same number.
fn exactly(cell: &Cell) -> String {
    match cell {
        Cell::Empty => String::new(),
        Cell::Word(word) => word.clone(),
        Cell::Count(count) => count.to_string(),
        Cell::Number(x) => shortest(*x, 1e7),
    }
}

/// A cell as it stands in text.
fn show(cell: &Cell, digits: Digits) -> String {
    match (cell, digits) {
        (Cell::Empty, _) => "-".to_owned(),
        (Cell::Number(x), Digits::Fixed(places)) => format!("{x:.places$}"),
        (Cell::Number(x), Digits::Significant(count)) => significant(*x, count),
        (cell, _) => exactly(cell),
    }
}

/// A paragraph in lines of at most `width`, all but the first indented.
pub fn wrapped(paragraph: &str, width: usize, indent: &str) -> String {
    let mut text = String::new();
    let mut line = String::new();
    for word in paragraph.split_whitespace() {
        let longer = line.chars().count() + 1 + word.chars().count();
        if !line.trim().is_empty() && longer > width {
            text += line.trim_end();
            text.push('\n');
            indent.clone_into(&mut line);
        } else if !line.is_empty() {
            line.push(' ');
        }
        line += word;
    }
    text += line.trim_end();
    text.push('\n');
    text
}

/// A row with the names of its cells; what it does not have is left out.
struct Named<'a>(&'a [Column], &'a [Cell]);

impl Serialize for Named<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let mut object = serializer.serialize_map(None)?;
        for (column, cell) in self.0.iter().zip(self.1) {
            if *cell != Cell::Empty {
                object.serialize_entry(&column.name, cell)?;
            }
        }
        object.end()
    }
}

/// Names and values as an object, in their order.
struct Pairs<'a>(&'a [(String, String)]);

impl Serialize for Pairs<'_> {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        serializer.collect_map(self.0.iter().map(|(name, value)| (name, value)))
    }
}

impl Serialize for Table {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        let units: Vec<(String, String)> = self
            .columns
            .iter()
            .filter(|c| !c.unit.is_empty())
            .map(|c| (c.name.to_string(), c.unit.to_owned()))
            .collect();
        let rows: Vec<_> = self.rows.iter().map(|r| Named(&self.columns, r)).collect();
        let mut object = serializer.serialize_struct("Table", 6)?;
        object.serialize_field("name", &self.name)?;
        object.serialize_field("title", &self.title)?;
        object.serialize_field("scene", &Pairs(&self.facts))?;
        object.serialize_field("units", &Pairs(&units))?;
        object.serialize_field("rows", &rows)?;
        object.serialize_field("notes", &self.notes)?;
        object.end()
    }
}
