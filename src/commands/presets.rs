//! `beadlab presets`: the presets there are, and checks of one's own.

use super::{Failure, bad_input, load, printed};
use crate::cli::PresetsAction;
use crate::scene::preset::embedded;
use crate::scene::words::one_line;
use crate::scene::{MethodName, Preset};
use std::io::{self, Write};

/// Runs `beadlab presets`.
///
/// # Errors
/// When there is no such preset, or a file is not one.
pub fn presets(action: Option<PresetsAction>) -> Result<(), Failure> {
    match action {
        None | Some(PresetsAction::List) => list(),
        Some(PresetsAction::Show {
            name,
            method,
            settings,
        }) => show(&name, method, &settings),
        Some(PresetsAction::Check { files }) => check(&files),
    }
}

fn list() -> Result<(), Failure> {
    let line = |&(name, _): &(&str, &str)| {
        Preset::load(name).map(|preset| format!("{name:<15} {}\n", preset.title))
    };
    let lines: Result<Vec<_>, _> = embedded().iter().map(line).collect();
    print(&lines.map_err(bad_input)?.concat())
}

/// A preset as it was written, or, where it is changed or a file, as it would be.
fn show(name: &str, method: Option<MethodName>, settings: &[String]) -> Result<(), Failure> {
    let preset = load(name, method, settings)?;
    let as_written = embedded()
        .iter()
        .filter(|_| method.is_none() && settings.is_empty())
        .find(|&&(each, _)| each == name);
    match as_written {
        Some((_, text)) => print(text),
        None => print(&preset.to_toml()),
    }
}

/// All files are good, or each bad one gets its line.
fn check(files: &[String]) -> Result<(), Failure> {
    let (mut good, mut bad) = (Vec::new(), Vec::new());
    for file in files {
        match Preset::load(file) {
            Ok(preset) => good.push(format!("{}: good ({})\n", one_line(file), preset.title)),
            Err(error) => bad.push(error.to_string()),
        }
    }
    if bad.is_empty() {
        print(&good.concat())
    } else {
        Err(Failure::BadInput(bad.join("\n")))
    }
}

fn print(text: &str) -> Result<(), Failure> {
    let mut out = io::stdout().lock();
    printed(out.write_all(text.as_bytes()).and_then(|()| out.flush()))
}
