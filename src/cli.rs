//! The command line's grammar; what it does is in [`crate::commands`].

mod help;
mod values;

use crate::scene::MethodName;
use crate::study::export::{self, FORMATS};
use clap::builder::PossibleValue;
use clap::{Args, Parser, ValueEnum};
use help::{
    ACCURACY_EXAMPLES, ADVISE_EXAMPLES, EXAMPLES, FIGURE_EXAMPLES, PRESET_EXAMPLES,
    REPLAY_EXAMPLES, RUN_EXAMPLES, STABILITY_EXAMPLES, SWEEP_EXAMPLES, run_long_help,
};
use std::path::PathBuf;
use values::{between, budget, positive, speed, tolerance};

/// Memory for what was, to go back to, unless it is told, MiB.
pub const MEMORY: u32 = 64;

/// A terminal laboratory for the detachment effect: soft-contact against
/// hard-sphere simulations of a column of beads.
///
/// Without a subcommand the explorer opens: the column live, with everything to
/// edit while it moves.
#[derive(Debug, Parser)]
#[command(version, after_help = EXAMPLES, args_conflicts_with_subcommands = true)]
pub struct Cli {
    /// What to do; without it the explorer opens.
    #[command(subcommand)]
    pub command: Option<Subcommand>,

    /// What to explore.
    #[command(flatten)]
    pub explore: ExploreArgs,
}

/// What the program does besides exploring.
#[derive(Debug, clap::Subcommand)]
pub enum Subcommand {
    /// Run a scene without pictures and print what it measures
    #[command(after_help = RUN_EXAMPLES, after_long_help = run_long_help())]
    Run(RunArgs),
    /// Error against run time of every method that fits a scene
    #[command(after_help = ACCURACY_EXAMPLES)]
    Accuracy(AccuracyArgs),
    /// The longest contact time that will do, the step, and what it costs
    #[command(after_help = ADVISE_EXAMPLES)]
    Advise(AdviseArgs),
    /// Where each method breaks: stiff and extreme cases, and the largest stable step
    #[command(after_help = STABILITY_EXAMPLES)]
    Stability(StabilityArgs),
    /// How fast the engines are on this machine
    Speed(ReportArgs),
    /// Measure a scene at every point of a product of ranges, into a CSV file
    #[command(after_help = SWEEP_EXAMPLES)]
    Sweep(SweepArgs),
    /// The paper's figures, tables and sentences, beside what it says
    #[command(after_help = FIGURE_EXAMPLES)]
    Figure(FigureArgs),
    /// Play a recorded session again: in the explorer, or without pictures
    #[command(after_help = REPLAY_EXAMPLES)]
    Replay(ReplayArgs),
    /// List the presets, show one as TOML, or check files of your own
    #[command(after_help = PRESET_EXAMPLES)]
    Presets {
        /// What to do with them; without it they are listed.
        #[command(subcommand)]
        action: Option<PresetsAction>,
    },
}

/// Arguments of the explorer.
#[derive(Debug, Args)]
pub struct ExploreArgs {
    /// A preset's name, or a TOML file
    #[arg(
        value_name = "PRESET|FILE.toml",
        default_value = "shaken",
        hide_default_value = true
    )]
    pub preset: String,

    /// How the beads are moved at first
    #[arg(long, value_enum)]
    pub method: Option<MethodName>,

    /// Draw with ASCII only
    #[arg(long)]
    pub ascii: bool,

    /// Simulated seconds per second of your time, like 0.02 or 1/50
    #[arg(long, value_parser = speed)]
    pub speed: Option<f64>,

    /// Write a tape of the session to a new file, for `beadlab replay`
    #[arg(long, value_name = "FILE")]
    pub record: Option<PathBuf>,

    /// Memory for what was, to go back to, in MiB
    #[arg(
        long,
        value_name = "MIB",
        default_value_t = MEMORY,
        value_parser = clap::value_parser!(u32).range(1..=1_048_576),
        allow_hyphen_values = true
    )]
    pub memory: u32,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; `beadlab run --help` lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,
}

/// Arguments of `beadlab replay`.
#[derive(Debug, Args)]
pub struct ReplayArgs {
    /// A tape that the explorer has written
    #[arg(value_name = "FILE")]
    pub tape: PathBuf,

    /// How it is written; without this, on a terminal, the explorer plays it
    #[arg(long, value_enum)]
    pub format: Option<export::Format>,

    /// Stop at this simulated time, in seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub until: Option<f64>,

    /// With csv or xyz: print the motion at this interval, in simulated seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub every: Option<f64>,

    /// With csv or xyz: the column whose motion is printed, from the left
    #[arg(
        long,
        value_name = "NUMBER",
        default_value_t = 1,
        value_parser = clap::value_parser!(u32).range(1..=2),
        allow_hyphen_values = true
    )]
    pub column: u32,

    /// Write to a file, which appears when it is complete
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `beadlab run`.
#[derive(Debug, Args)]
pub struct RunArgs {
    /// A preset's name, or a TOML file
    #[arg(value_name = "PRESET|FILE.toml")]
    pub preset: String,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; --help lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,

    /// How the beads are moved
    #[arg(long, value_enum)]
    pub method: Option<MethodName>,

    /// How the results are written
    #[arg(long, value_enum, default_value = "text")]
    pub format: export::Format,

    /// With csv: print the motion at this interval, in simulated seconds
    #[arg(long, value_name = "SECONDS", value_parser = positive, allow_hyphen_values = true)]
    pub every: Option<f64>,

    /// Measure what the last bit of the start changes, and other steps, in more runs
    #[arg(long, conflicts_with = "every")]
    pub sensitivity: bool,

    /// Write to a file, which appears when it is complete
    #[arg(long, value_name = "FILE")]
    pub out: Option<PathBuf>,
}

/// Arguments of `beadlab accuracy`.
#[derive(Debug, Args)]
pub struct AccuracyArgs {
    /// A preset's name, or a TOML file
    #[arg(value_name = "PRESET|FILE.toml", default_value = "fig1b")]
    pub preset: String,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; `beadlab run --help` lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,

    /// Time for all runs together, in seconds of yours
    #[arg(long, value_name = "SECONDS", value_parser = budget, allow_hyphen_values = true)]
    pub budget: Option<f64>,

    /// How it is reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Arguments of `beadlab advise`.
#[derive(Debug, Args)]
pub struct AdviseArgs {
    /// A preset's name, or a TOML file; hard spheres stand for their soft twins
    #[arg(value_name = "PRESET|FILE.toml", default_value = "fig1b")]
    pub preset: String,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; `beadlab run --help` lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,

    /// What is allowed, as a part of the limit: 0.01 without gravity and on a floor at
    /// rest, 0.05 on a plate where nobody says otherwise
    #[arg(long, value_name = "PART", value_parser = tolerance, allow_hyphen_values = true)]
    pub tolerance: Option<f64>,

    /// The limit: hard spheres, the scene's own contact time, or another one in seconds
    #[arg(
        long,
        value_name = "hard|material|SECONDS",
        default_value = "hard",
        allow_hyphen_values = true
    )]
    pub against: String,

    /// Shortest and longest contact time to look at, in seconds
    #[arg(long, value_name = "SHORT:LONG", value_parser = between, allow_hyphen_values = true)]
    pub between: Option<(f64, f64)>,

    /// Time for the search, in seconds of yours
    #[arg(long, value_name = "SECONDS", value_parser = budget, allow_hyphen_values = true)]
    pub budget: Option<f64>,

    /// How it is reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Arguments of `beadlab stability`.
#[derive(Debug, Args)]
pub struct StabilityArgs {
    /// Work for one run, in seconds of an ordinary machine
    #[arg(long, value_name = "SECONDS", value_parser = budget, allow_hyphen_values = true)]
    pub budget: Option<f64>,

    /// Only the largest stable steps, found and foretold
    #[arg(long)]
    pub steps: bool,

    /// How it is reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

/// Arguments of `beadlab sweep`.
#[derive(Debug, Args)]
pub struct SweepArgs {
    /// A preset's name, or a TOML file
    #[arg(value_name = "PRESET|FILE.toml")]
    pub preset: String,

    /// Vary a parameter, like t_c=1us:1ms:log:30 (repeatable)
    #[arg(
        long = "over",
        value_name = "NAME=RANGE",
        required = true,
        allow_hyphen_values = true
    )]
    pub over: Vec<String>,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; `beadlab run --help` lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,

    /// How the beads are moved
    #[arg(long, value_enum)]
    pub method: Option<MethodName>,

    /// Where the rows go
    #[arg(long, value_name = "FILE.csv")]
    pub out: PathBuf,

    /// Go on with a file that the same sweep began
    #[arg(long, conflicts_with = "overwrite")]
    pub resume: bool,

    /// Begin again, whatever is in the file
    #[arg(long)]
    pub overwrite: bool,

    /// Runs at the same time; as many as there are cores where nobody says otherwise
    #[arg(long, value_name = "COUNT", value_parser = clap::value_parser!(u16).range(1..=1024))]
    pub jobs: Option<u16>,
}

/// Arguments of `beadlab figure`.
#[derive(Debug, Args)]
pub struct FigureArgs {
    /// A figure's name, like 2a or table1, or all
    #[arg(value_name = "NAME|all")]
    pub name: String,

    /// How it is reported.
    #[command(flatten)]
    pub report: ReportArgs,
}

/// How a study is reported.
#[derive(Debug, Args)]
pub struct ReportArgs {
    /// How the tables are printed; text has plots too
    #[arg(long, value_enum, default_value_t = ReportFormat::Text)]
    pub format: ReportFormat,

    /// Write the report into a folder too: text, JSON, CSV and SVG
    #[arg(long, value_name = "DIR")]
    pub out: Option<PathBuf>,

    /// Fewer cases and less time
    #[arg(long)]
    pub quick: bool,

    /// Draw with ASCII only
    #[arg(long)]
    pub ascii: bool,
}

/// How a study's tables are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum ReportFormat {
    /// A table to read
    Text,
    /// JSON
    Json,
    /// Comma-separated values
    Csv,
}

/// What to do with presets.
#[derive(Debug, clap::Subcommand)]
pub enum PresetsAction {
    /// List names and titles
    List,
    /// Print a preset as TOML, changed or as it is
    Show {
        /// A preset's name, or a TOML file
        #[arg(value_name = "PRESET|FILE.toml")]
        name: String,

        /// How the beads are moved
        #[arg(long, value_enum)]
        method: Option<MethodName>,

        /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
        /// (repeatable; `beadlab run --help` lists them)
        #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
        settings: Vec<String>,
    },
    /// Check preset files, and say what is wrong on which line
    Check {
        /// TOML files, or names of presets
        #[arg(required = true, value_name = "FILE")]
        files: Vec<String>,
    },
}

impl ValueEnum for MethodName {
    fn value_variants<'a>() -> &'a [Self] {
        &Self::ALL
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.as_str()).help(self.meaning()))
    }
}

impl ValueEnum for export::Format {
    fn value_variants<'a>() -> &'a [Self] {
        &FORMATS
    }

    fn to_possible_value(&self) -> Option<PossibleValue> {
        Some(PossibleValue::new(self.name).help(self.meaning))
    }
}
