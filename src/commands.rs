//! What the program does: one file a subcommand.

pub mod accuracy;
pub mod advise;
pub mod explore;
pub mod figure;
mod output;
pub mod presets;
mod progress;
mod replay;
mod report;
pub mod run;
mod signals;
pub mod speed;
pub mod stability;
pub mod sweep;
mod usage;

use crate::cli::{Cli, Subcommand};
use crate::scene::parameters::{self, Setting};
use crate::scene::words::{one_line, quote};
use crate::scene::{MethodName, Preset};
use crate::study::RunError;
use crate::tui::model::Origin;
use clap::Parser;
use explore::ExploreOptions;
use std::ffi::OsString;
use std::io::{self, ErrorKind, Write};
use std::process::ExitCode;

/// Why a command did not do what it was asked to.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Failure {
    /// The input is wrong; one line for each thing that is.
    BadInput(String),
    /// The input is right, but the run failed; one line.
    Failed(String),
    /// A signal ended it; one line, and the signal's number.
    Interrupted(String, u8),
}

impl From<RunError> for Failure {
    fn from(error: RunError) -> Self {
        Self::Failed(error.to_string())
    }
}

/// Runs the program: arguments in, exit code out. What goes wrong is told on
/// standard error, in one line.
pub fn main(arguments: impl IntoIterator<Item = OsString>) -> ExitCode {
    match dispatch(arguments) {
        Ok(()) => ExitCode::SUCCESS,
        Err(failure) => {
            let (message, code) = match failure {
                Failure::Failed(message) => (message, 1),
                Failure::BadInput(message) => (message, 2),
                Failure::Interrupted(message, signal) => (message, 128 + signal),
            };
            for line in message.lines() {
                // Nobody may be listening any more, and that is no reason to panic.
                let _ = writeln!(io::stderr(), "beadlab: {}", one_line(line));
            }
            ExitCode::from(code)
        }
    }
}

fn dispatch(arguments: impl IntoIterator<Item = OsString>) -> Result<(), Failure> {
    let cli = match Cli::try_parse_from(arguments) {
        Ok(cli) => cli,
        Err(error) => return usage::answer(&error),
    };
    // The explorer and a sweep have their own ways to end.
    let others = cli.command.as_ref();
    let leaves_by_itself = |command: &Subcommand| match command {
        Subcommand::Sweep(_) => true,
        Subcommand::Replay(args) => replay::is_explored(args),
        _ => false,
    };
    if others.is_some_and(|command| !leaves_by_itself(command)) {
        signals::leave_nothing_behind()?;
    }
    match cli.command {
        Some(Subcommand::Run(args)) => run::run(&args),
        Some(Subcommand::Accuracy(args)) => accuracy::run(&args),
        Some(Subcommand::Advise(args)) => advise::run(&args),
        Some(Subcommand::Stability(args)) => stability::run(&args),
        Some(Subcommand::Speed(args)) => speed::run(&args),
        Some(Subcommand::Sweep(args)) => sweep::run(&args),
        Some(Subcommand::Figure(args)) => figure::run(&args),
        Some(Subcommand::Replay(args)) => replay::run(&args),
        Some(Subcommand::Presets { action }) => presets::presets(action),
        None => {
            let args = cli.explore;
            let original = Preset::load(&args.preset).map_err(bad_input)?;
            let origin = Origin {
                scene: original.scene.clone(),
                name: args.preset,
            };
            let preset = changed(&original, args.method, &args.settings)?;
            let options = ExploreOptions {
                ascii: args.ascii,
                speed: args.speed,
                memory: args.memory as usize * MIB,
                tape: None,
                record: args.record,
            };
            explore::explore(preset, origin, options)
        }
    }
}

/// Bytes in a MiB.
const MIB: usize = 1 << 20;

/// The preset or file of that name, with the method and settings of the command line.
fn load(name: &str, method: Option<MethodName>, settings: &[String]) -> Result<Preset, Failure> {
    let preset = Preset::load(name).map_err(bad_input)?;
    changed(&preset, method, settings)
}

/// A preset with the method and settings of the command line.
fn changed(
    preset: &Preset,
    method: Option<MethodName>,
    settings: &[String],
) -> Result<Preset, Failure> {
    let layer = layer(settings)?;
    preset.with(method, &layer).map_err(|error| {
        let meant = |name: &str| {
            parameters::called(name).is_some_and(|parameter| parameter.name == error.parameter())
        };
        let written = settings
            .iter()
            .filter_map(|text| text.split_once('='))
            .rfind(|(name, _)| meant(name));
        bad_input(match written {
            Some((_, value)) => error.with_written(value),
            None => error,
        })
    })
}

/// All `--set name=value`.
fn layer(settings: &[String]) -> Result<Vec<Setting>, Failure> {
    settings.iter().map(|text| setting(text)).collect()
}

/// One `--set name=value`.
fn setting(text: &str) -> Result<Setting, Failure> {
    let (name, value) = text.split_once('=').ok_or_else(|| {
        let text = quote(text);
        Failure::BadInput(format!("--set {text}: must be NAME=VALUE, like t_c=4.6us"))
    })?;
    Setting::read(name, value).map_err(bad_input)
}

fn bad_input(error: impl std::fmt::Display) -> Failure {
    Failure::BadInput(error.to_string())
}

/// A remark on standard error, where it does not mix with the results.
fn note(remark: &str) {
    let _ = writeln!(io::stderr(), "beadlab: note: {}", one_line(remark));
}

/// What became of printing: a reader that has seen enough is no failure.
fn printed(result: io::Result<()>) -> Result<(), Failure> {
    match result {
        Err(error) if error.kind() == ErrorKind::BrokenPipe => Ok(()),
        Err(error) => Err(Failure::Failed(format!("cannot print: {error}"))),
        Ok(()) => Ok(()),
    }
}
