//! `beadlab [PRESET|FILE.toml]`: the explorer.

use std::fs::File;
use std::io::{ErrorKind, IsTerminal, stdin, stdout};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use super::Failure;
use super::output::reason;
use crate::live::Recording;
use crate::physics;
use crate::scene::Preset;
use crate::scene::words::one_line;
use crate::tape::Tape;
use crate::tui::Session;
use crate::tui::event_loop::Ending;
use crate::tui::model::Origin;
use crate::tui::theme::Theme;

/// How to explore.
#[derive(Debug)]
pub struct ExploreOptions {
    /// Write no byte beyond ASCII, whatever the terminal says of itself.
    pub ascii: bool,
    /// Simulated seconds in a second; what suits the preset if not given.
    pub speed: Option<f64>,
    /// Memory for what was, to go back to, bytes.
    pub memory: usize,
    /// A tape to play.
    pub tape: Option<Tape>,
    /// A new file for a tape of the session.
    pub record: Option<PathBuf>,
}

/// Opens the explorer and returns when it is left. A signal ends the process with
/// exit code 128 + n, after the terminal is restored.
///
/// # Errors
/// When there is no terminal, or it cannot be used.
pub fn explore(preset: Preset, origin: Origin, options: ExploreOptions) -> Result<(), Failure> {
    for (is_terminal, which) in [
        (stdin().is_terminal(), "input"),
        (stdout().is_terminal(), "output"),
    ] {
        if !is_terminal {
            return Err(Failure::BadInput(format!(
                "the explorer needs a terminal, and its {which} is none; `beadlab run` works without one"
            )));
        }
    }
    if let Some(speed) = options
        .speed
        .filter(|speed| !(speed.is_finite() && *speed > 0.0))
    {
        return Err(Failure::BadInput(format!(
            "--speed {speed}: must be a number above 0"
        )));
    }
    let variable = |name: &str| std::env::var(name).ok();
    let term = crate::tui::tmux::terminal().or_else(|| variable("TERM"));
    if cfg!(unix) && matches!(term.as_deref(), None | Some("" | "dumb")) {
        return Err(Failure::BadInput(
            "TERM is unset or dumb, a terminal that cannot move its cursor; set TERM, such as \
             TERM=xterm, or use `beadlab run`"
                .to_owned(),
        ));
    }
    let theme = Theme::detect(options.ascii, |name| match name {
        "TERM" => term.clone(),
        name => variable(name),
    });
    let recording = options.record.as_deref().map(create).transpose()?;
    let session = Session {
        preset,
        origin,
        speed: options.speed,
        memory: options.memory,
        tape: options.tape.map(Arc::new),
        recording,
    };
    let build = Box::new(physics::build);
    match crate::tui::run(session, theme, build).map_err(Failure::Failed)? {
        Ending::Quit => Ok(()),
        Ending::Signal(number) => std::process::exit(128 + number),
    }
}

/// A new file for a tape, never one that is there.
fn create(path: &Path) -> Result<(String, Recording), Failure> {
    let name = one_line(&path.to_string_lossy());
    match File::create_new(path) {
        Ok(file) => Ok((name, Recording::new(Box::new(file)))),
        Err(error) => {
            let why = match error.kind() {
                ErrorKind::AlreadyExists => "is there already, and no tape is written over".into(),
                _ => reason(&error),
            };
            Err(Failure::BadInput(format!("--record {name}: {why}")))
        }
    }
}
