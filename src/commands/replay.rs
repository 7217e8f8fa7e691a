//! `beadlab replay`: a recorded session once more.

mod play;
mod report;

use super::explore::{self, ExploreOptions};
use super::output::Output;
use super::{Failure, MIB, note};
use crate::cli::{MEMORY, ReplayArgs};
use crate::scene::Preset;
use crate::scene::words::one_line;
use crate::study::export::Format;
use crate::tape::Tape;
use crate::tui::model::Origin;
use play::Playback;
use std::fs;
use std::io::{IsTerminal, Write, stdin, stdout};
use std::path::Path;

/// Whether the arguments, here, mean the explorer.
pub(super) fn is_explored(args: &ReplayArgs) -> bool {
    let plain = args.format.is_none() && args.until.is_none() && args.every.is_none();
    plain && args.out.is_none() && stdin().is_terminal() && stdout().is_terminal()
}

/// Runs `beadlab replay`.
///
/// # Errors
/// [`Failure::BadInput`] when the file is no tape, or one that was altered;
/// [`Failure::Failed`] when it comes to other states than the tape has.
pub fn run(args: &ReplayArgs) -> Result<(), Failure> {
    let tape = read(&args.tape)?;
    if is_explored(args) {
        return explored(&args.tape, tape);
    }
    if let Some(line) = tape.cut {
        note(&format!(
            "the tape is cut at line {line}: it is played up to there"
        ));
    }
    let format = args.format.unwrap_or(crate::study::export::FORMATS[0]);
    let end = args.until.map_or(tape.end(), |until| until.min(tape.end()));
    let playback = Playback::new(&tape, end);
    let name = format.name;
    match (args.every, format.motion) {
        (Some(_), None) => Err(Failure::BadInput(format!(
            "--format {name}: has no motion; --every needs csv or xyz"
        ))),
        (None, Some(_)) => Err(Failure::BadInput(format!(
            "--format {name}: needs --every, since it is of the motion"
        ))),
        (Some(every), Some(begin)) => {
            let output = Output::open(args.out.as_deref())?;
            playback.motion(every, args.column, begin, output)
        }
        (None, None) => {
            let output = Output::open(args.out.as_deref())?;
            report(&tape, playback, format, output)
        }
    }
}

fn report(
    tape: &Tape,
    playback: Playback,
    format: Format,
    mut output: Output,
) -> Result<(), Failure> {
    let played = playback.finish();
    let text = match format.name {
        "json" => report::json(tape, &played),
        _ => report::text(tape, &played),
    };
    let written = output.write_all(text.as_bytes());
    if written.is_err() {
        return output.judge(written);
    }
    output.finish()?;
    play::verdict(&played)
}

/// A tape in the explorer.
fn explored(path: &Path, tape: Tape) -> Result<(), Failure> {
    let name = path.file_stem().unwrap_or_default().to_string_lossy();
    let scene = tape.scenes[0].clone();
    let preset = Preset {
        name: one_line(&name),
        title: "a recorded session".to_owned(),
        caption: String::new(),
        look_for: "The session as it was recorded. An edit goes on from there otherwise.".into(),
        try_next: String::new(),
        scene: scene.clone(),
        beside: None,
    };
    let origin = Origin {
        name: one_line(&path.to_string_lossy()),
        scene,
    };
    let options = ExploreOptions {
        ascii: false,
        speed: None,
        memory: MEMORY as usize * MIB,
        tape: Some(tape),
        record: None,
    };
    explore::explore(preset, origin, options)
}

fn read(path: &Path) -> Result<Tape, Failure> {
    let name = one_line(&path.to_string_lossy());
    let refuse = |why: String| Failure::BadInput(format!("{name}: {why}"));
    let bytes = fs::read(path).map_err(|error| refuse(one_line(&error.to_string())))?;
    // What is no UTF-8 has been altered, and its line's check sum tells.
    Tape::read(&String::from_utf8_lossy(&bytes)).map_err(|error| refuse(error.to_string()))
}
