//! `beadlab [PRESET|FILE.toml]`: the explorer.

use std::io::{IsTerminal, stdin, stdout};

use super::Failure;
use crate::physics;
use crate::scene::Preset;
use crate::tui::event_loop::Ending;
use crate::tui::model::Origin;
use crate::tui::theme::Theme;

/// How to explore.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct ExploreOptions {
    /// Write no byte beyond ASCII, whatever the terminal says of itself.
    pub ascii: bool,
    /// Simulated seconds in a second; what suits the preset if not given.
    pub speed: Option<f64>,
    /// Memory for what was, to go back to, bytes.
    pub memory: usize,
}

/// Opens the explorer and returns when it is left. A signal ends the process with
/// exit code 128 + n, after the terminal is restored.
///
/// # Errors
/// When there is no terminal, or it cannot be used.
pub fn explore(preset: Preset, origin: Origin, options: &ExploreOptions) -> Result<(), Failure> {
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
    let build = Box::new(physics::build);
    match crate::tui::run(preset, origin, options.speed, theme, build, options.memory)
        .map_err(Failure::Failed)?
    {
        Ending::Quit => Ok(()),
        Ending::Signal(number) => std::process::exit(128 + number),
    }
}
