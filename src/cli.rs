//! The command line's grammar; what it does is in [`crate::commands`].

use crate::scene::{MethodName, parameters};
use clap::builder::PossibleValue;
use clap::{Args, Parser, Subcommand, ValueEnum};
use std::path::PathBuf;

const EXAMPLES: &str = "\
Examples:
  beadlab                                the shaken column, soft and hard contacts
                                         side by side
  beadlab fig1a                          a preset; `beadlab presets` lists them
  beadlab fig5b --set alpha=3            the same with another acceleration
  beadlab my-column.toml                 a scene of your own
  beadlab run fig1a --method ed          numbers instead of pictures";

const RUN_EXAMPLES: &str = "\
Examples:
  beadlab run fig1b
  beadlab run fig1b --set s0=1e-5 --set n=20 --format json
  beadlab run fig5b --method ed --format csv --every 1e-3 --out trace.csv

Without gravity a run lasts until the floor collision is over, and eps_eff,
er_over_ef and contact_duration are given if that comes before `duration`.
With gravity it lasts for `duration`, and h_cm_mean is the mean absolute height
of the centre of mass over the last 90 % of it, er_over_e_mean the mean E_r over
the mean E. A quantity that the scene does not have is left out. The same scene
and seed give the same bytes, except for wall_time and speed, which measure the
machine and stand only in json.

sigma is the mean time between successive contacts of the same pair, over
contact_time: of a floor collision counted to the end of its last contact, under
gravity over the contacts begun in the last plate period. overlap_max is the
deepest overlap seen (gear, verlet: every 32 steps and at contact changes).

Results are printed to the digits that they have, and one more. What decides the
others is measured without gravity, unless the run is long, else by --sensitivity:
what the last bits of the start and of eps change, and other steps (gear, verlet),
tolerances (power laws) or depths at which a collapse is closed (ed). `sensitivity` is that of eps_eff or h_cm_mean; other
results have their own, as in sigma_sensitivity. Means have an error, statistical
and of the looks between which the motion is not known. Where nothing was
measured a grid vouches for a tenth of a step in a contact time.

energy_drift checks the books, not the results: on a grid it can be 500 times less
than their error, of which step_error is an estimate, from other steps.

verdict is on the scene's soft contacts: detachment, crossover or agreement with
hard spheres; verdict_why says by which numbers. They come from runs of both from
the start that last until they decide, whatever the method and duration of this one.

Unequal beads share one spring and dashpot, so each pair has a restitution of its
own, soft or hard (restitution_min, restitution_max; law = hooke, and ed).

Exit codes: 0 done, 1 the run failed, 2 bad input.";

const ACCURACY_EXAMPLES: &str = "\
Examples:
  beadlab accuracy                       Fig. 1(b): error against run time
  beadlab accuracy fig1a --set n=50
  beadlab accuracy fig7-md               a chaotic plate: when runs part, and means
  beadlab accuracy --out report          also as CSV, JSON and SVG, in a folder";

const ADVISE_EXAMPLES: &str = "\
Examples:
  beadlab advise                         how short must Fig. 1(b)'s contacts be?
  beadlab advise fig1b --set s0=1e-5 --tolerance 0.001
  beadlab advise steel                   a plate: mean E_r/E and h_cm
  beadlab advise steel --against material    longer than steel's own, what changes?
  beadlab advise fig3-hertz --against 1e-7   power laws: against a contact time
  beadlab advise my-column.toml --between 1e-7:1e-4 --out report

The answer is the longest contact time t_c up to which every one that was looked at
keeps eps_eff (without gravity), or the means of E_r/E and h_cm (on a plate that
vibrates), within --tolerance of the limit; then the step, and what a run costs there.
Where means are too uncertain to say, it says so; --budget gives more time.

Exit codes: 0 answered (also when no t_c will do), 1 the limit cannot be measured,
2 bad input.";

const STABILITY_EXAMPLES: &str = "\
Examples:
  beadlab stability                      every method on every case
  beadlab stability --steps              the largest stable steps alone
  beadlab stability --budget 10          more time for what is slow
  beadlab stability --format json        every verdict in full";

const SWEEP_EXAMPLES: &str = "\
Examples:
  beadlab sweep fig1b --over contact_time=1e-6:1e-3:log:30 --out tc.csv
  beadlab sweep fig1b --over restitution=0.5:0.99:20 --over n=1,2,5,10,20 \\
      --method exact --out map.csv
  beadlab sweep fig1b --over v0=-14:-0.008:log:40 --out v0.csv --resume

Ranges: NAME=START:END:COUNT, both ends included; NAME=START:END:log:COUNT; or a
list NAME=A,B,C. Of several, the last runs fastest. Whole numbers are rounded, and
those that fall together are taken once. Parameters as for `beadlab run --help`.

The file is CSV after lines that begin with #: what was swept, the whole scene, units.
A row is on disk as soon as it and all before it are done, in any number of jobs the
same bytes. After a kill the same command with --resume goes on where it ended. What
a scene does not have is an empty cell; a run that fails leaves its results empty
and its reason in the column `note`.

Exit codes: 0 done, 1 a run failed or the disk is full, 2 bad input (a file that
cannot be opened too), 130 or 143 ended by Ctrl-C or TERM.";

const FIGURE_EXAMPLES: &str = "\
Examples:
  beadlab figure 2a                      a figure: its plot, and how near it comes
  beadlab figure table1 --format csv     every number behind it
  beadlab figure plateau                 Fig. 5(b) with ever shorter contacts
  beadlab figure all --out report        the whole paper, as text, CSV, JSON and SVG
  beadlab figure all --quick             the same with fewer points and shorter runs";

const PRESET_EXAMPLES: &str = "\
A scene of your own:
  beadlab presets show fig5b > my-column.toml
  beadlab presets check my-column.toml
  beadlab my-column.toml";

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
    pub command: Option<Command>,

    /// What to explore.
    #[command(flatten)]
    pub explore: ExploreArgs,
}

/// Subcommands.
#[derive(Debug, Subcommand)]
pub enum Command {
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

    /// Draw with ASCII only
    #[arg(long)]
    pub ascii: bool,

    /// Simulated seconds per second of your time, like 0.02 or 1/50
    #[arg(long, value_parser = speed)]
    pub speed: Option<f64>,

    /// Change a parameter, like t_c=4.6us or N=20; a bare number is in SI units
    /// (repeatable; `beadlab run --help` lists them)
    #[arg(long = "set", value_name = "NAME=VALUE", allow_hyphen_values = true)]
    pub settings: Vec<String>,
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
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,

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
    #[arg(long, value_enum, default_value_t = Format::Text)]
    pub format: Format,

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

/// How results are written.
#[derive(Debug, Clone, Copy, PartialEq, Eq, ValueEnum)]
pub enum Format {
    /// A table to read
    Text,
    /// JSON
    Json,
    /// Comma-separated values
    Csv,
}

/// What to do with presets.
#[derive(Debug, Subcommand)]
pub enum PresetsAction {
    /// List names and titles
    List,
    /// Print a preset as TOML
    Show {
        /// The preset's name
        name: String,
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

fn run_long_help() -> String {
    format!("{}\n{RUN_EXAMPLES}", parameters::help())
}

fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("must be a number above 0".to_owned()),
    }
}

/// Seconds that a person would wait.
fn budget(text: &str) -> Result<f64, String> {
    match positive(text)? {
        x if x <= 1e6 => Ok(x),
        _ => Err("must be a number above 0 and at most 1e6".to_owned()),
    }
}

/// A part of something that may differ.
fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (1e-12..=1.0).contains(&x) => Ok(x),
        _ => Err("must be a number from 1e-12 to 1".to_owned()),
    }
}

/// Two contact times, the shorter one first.
fn between(text: &str) -> Result<(f64, f64), String> {
    let parts = text.split_once(':');
    let numbers = parts.and_then(|(a, b)| Some((positive(a).ok()?, positive(b).ok()?)));
    match numbers {
        Some((from, to)) if from < to => Ok((from, to)),
        _ => Err("must be two numbers above 0, the smaller one first, like 1e-7:1e-4".to_owned()),
    }
}

/// A number, or a fraction like 1/50.
fn speed(text: &str) -> Result<f64, String> {
    let value = match text.split_once('/') {
        Some((above, below)) => positive(above)? / positive(below)?,
        None => positive(text)?,
    };
    positive(&value.to_string())
}
