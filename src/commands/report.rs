//! A study's tables and plots, printed and written into a folder.

use super::output::Output;
use super::{Failure, printed};
use crate::cli::{ReportArgs, ReportFormat};
use crate::scene::words::one_line;
use crate::study::accuracy::Report;
use crate::study::plot::Plot;
use crate::study::table::Table;
use crate::tui::theme::Theme;
use std::fs;
use std::io::{self, IsTerminal, Write};
use std::path::Path;

/// Columns where no terminal says otherwise, and the most that a line is read in.
const WIDTH: usize = 80;
const WIDEST: usize = 100;

/// The report as it is printed, in the folder.
const REPORT: &str = "report.txt";

/// Lines of a plot.
const LINES: usize = 22;

/// A part of a report.
pub(super) enum Part {
    /// A table to read.
    Shown(Table),
    /// A table too long to read: not in text.
    Filed(Table),
    /// A plot.
    Drawn(Plot),
}

impl Part {
    fn table(&self) -> Option<&Table> {
        match self {
            Self::Shown(table) | Self::Filed(table) => Some(table),
            Self::Drawn(_) => None,
        }
    }

    fn plot(&self) -> Option<&Plot> {
        match self {
            Self::Drawn(plot) => Some(plot),
            _ => None,
        }
    }
}

/// Where a report goes; made before the work, so that it does not end in vain.
pub(super) struct Destination<'a> {
    args: &'a ReportArgs,
    folder: Option<&'a Path>,
}

impl<'a> Destination<'a> {
    /// The folder is made where only its last part is missing.
    pub fn open(args: &'a ReportArgs) -> Result<Self, Failure> {
        let folder = args.out.as_deref();
        if let Some(folder) = folder {
            prepare(folder)?;
        }
        Ok(Self { args, folder })
    }

    /// Prints the report, and writes all its parts into the folder.
    pub fn write(self, report: &Report) -> Result<(), Failure> {
        let tables = report.tables.iter().cloned().map(Part::Shown);
        let plots = report.plots.iter().cloned().map(Part::Drawn);
        self.write_parts(&tables.chain(plots).collect::<Vec<_>>())
    }

    /// Prints the parts in their order, and writes each into the folder.
    pub fn write_parts(self, report: &[Part]) -> Result<(), Failure> {
        if let Some(folder) = self.folder {
            write_files(folder, report)?;
        }
        let text = match self.args.format {
            ReportFormat::Text => {
                let theme = Theme::detect(self.args.ascii, |name| std::env::var(name).ok());
                in_words(report, columns(), theme.ascii)
            }
            ReportFormat::Csv => in_csv(report),
            ReportFormat::Json => in_json(report),
        };
        let mut out = io::stdout().lock();
        printed(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
    }
}

/// Makes the folder if it is not there, and sees whether a file can be made in it.
fn prepare(path: &Path) -> Result<(), Failure> {
    if !path.exists() {
        fs::create_dir(path).map_err(|error| {
            let path = one_line(&path.to_string_lossy());
            let error = one_line(&error.to_string());
            Failure::BadInput(format!("--out {path}: cannot be made: {error}"))
        })?;
    }
    if !path.is_dir() {
        let path = one_line(&path.to_string_lossy());
        return Err(Failure::BadInput(format!("--out {path}: is not a folder")));
    }
    // It is gone again at once: whatever ends the work leaves nothing behind.
    Output::open(Some(&path.join(REPORT))).map(drop)
}

/// The report as text, each table as CSV, each plot as SVG, and everything as JSON. All
/// are written beside their places before the first takes its own: a full disk leaves
/// what was there before.
fn write_files(folder: &Path, report: &[Part]) -> Result<(), Failure> {
    let text = (REPORT.to_owned(), in_words(report, WIDTH, true));
    let tables = report
        .iter()
        .filter_map(Part::table)
        .map(|t| (format!("{}.csv", t.name), t.csv()));
    let plots = report
        .iter()
        .filter_map(Part::plot)
        .map(|p| (format!("{}.svg", p.name), p.svg()));
    let json = ("report.json".to_owned(), in_json(report));
    let mut written = Vec::new();
    for (name, text) in [text].into_iter().chain(tables).chain(plots).chain([json]) {
        let mut output = Output::open(Some(&folder.join(name)))?;
        let result = output.write_all(text.as_bytes());
        output.judge(result)?;
        written.push(output);
    }
    Output::finish_all(written)
}

/// Columns of the terminal, or of a page.
fn columns() -> usize {
    if !io::stdout().is_terminal() {
        return WIDTH;
    }
    crossterm::terminal::size().map_or(WIDTH, |(columns, _)| usize::from(columns).clamp(20, WIDEST))
}

fn in_words(report: &[Part], width: usize, ascii: bool) -> String {
    let texts = report.iter().filter_map(|part| match part {
        Part::Shown(table) => Some(table.text(width)),
        Part::Drawn(plot) => Some(plot.terminal(width, LINES, ascii)),
        Part::Filed(_) => None,
    });
    texts.collect::<Vec<_>>().join("\n")
}

fn in_csv(report: &[Part]) -> String {
    let tables = report.iter().filter_map(Part::table).map(Table::csv);
    tables.collect::<Vec<_>>().join("\n")
}

fn in_json(report: &[Part]) -> String {
    let tables: Vec<&Table> = report.iter().filter_map(Part::table).collect();
    let text = serde_json::to_string_pretty(&tables);
    text.expect("words and finite numbers can be written") + "\n"
}
