//! `beadlab run`: a scene without pictures.

mod runs;
pub(in crate::commands) mod series;

use super::output::Output;
use super::progress::Waiting;
use super::{Failure, load, note};
use crate::cli::RunArgs;
use crate::physics::spectrum;
use crate::scene::{Preset, Scene};
use crate::study::export::FORMATS;
use crate::study::{self, Drive, FindingStage, Findings, natural_time};
use runs::Runs;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;

/// Runs `beadlab run`.
///
/// # Errors
/// [`Failure::BadInput`] for arguments that make no run, [`Failure::Failed`] when
/// the engine cannot go on or the results cannot be written.
pub fn run(args: &RunArgs) -> Result<(), Failure> {
    match args.every {
        Some(every) => motion(args, every),
        None => results(args),
    }
}

/// Prints what a run gives.
fn results(args: &RunArgs) -> Result<(), Failure> {
    let written = args.format.results.ok_or_else(|| {
        let name = args.format.name;
        Failure::BadInput(format!(
            "--format {name}: needs --every, since it is of the motion"
        ))
    })?;
    let preset = load(&args.preset, args.method, &args.settings)?;
    let mut output = Output::open(args.out.as_deref())?;
    let findings = measured(&preset, args.sensitivity)?;
    warn_of_steps(&preset.scene);
    let written = written(&preset.title, &findings.all);
    let result = output.write_all(written.as_bytes());
    if result.is_err() {
        return output.judge(result);
    }
    output.finish()?;
    if args.format.for_people {
        tell_time(&findings);
    }
    Ok(())
}

/// Everything about the run of a preset, or the first number that is none.
fn measured(preset: &Preset, sensitivity: bool) -> Result<Findings, Failure> {
    let mut runs = Runs::new(&preset.scene, sensitivity, Waiting::new());
    let findings = study::run(preset, sensitivity, &mut |stage| runs.show(stage))?;
    for remark in &findings.remarks {
        note(remark);
    }
    match findings.not_finite() {
        Some((name, x)) => Err(Failure::Failed(format!(
            "the run failed: {name} came out as {x}"
        ))),
        None => Ok(findings),
    }
}

/// Prints the motion of a run.
fn motion(args: &RunArgs, every: f64) -> Result<(), Failure> {
    let begin = args.format.motion.ok_or_else(no_motion)?;
    let preset = load(&args.preset, args.method, &args.settings)?;
    let scene = &preset.scene;
    series::check(scene.duration.unwrap_or_else(|| natural_time(scene)), every)?;
    let output = Output::open(args.out.as_deref())?;
    // Rows on the same terminal show by themselves how far it is.
    let waiting = if args.out.is_none() && io::stdout().is_terminal() {
        Waiting::unseen()
    } else {
        Waiting::new()
    };
    let mut runs = Runs::new(&preset.scene, false, waiting);
    let mut watch = |time| {
        runs.show(FindingStage::Run(time));
        ControlFlow::Continue(())
    };
    let drive = Drive::new(&preset.scene, &mut watch);
    series::print(&preset.scene, drive, every, begin, output)?;
    warn_of_steps(&preset.scene);
    Ok(())
}

/// The format does not write motions: which ones do.
fn no_motion() -> Failure {
    let moving = FORMATS.iter().filter(|format| format.motion.is_some());
    let names: Vec<&str> = moving.map(|format| format.name).collect();
    let (names, verb) = (
        names.join(" or "),
        if names.len() == 1 { "prints" } else { "print" },
    );
    Failure::BadInput(format!(
        "--every: needs --format {names}, which {verb} the motion"
    ))
}

/// How long it took, for a person at the terminal.
fn tell_time(findings: &Findings) {
    let mut stderr = io::stderr();
    if let Some(wall_time) = findings
        .number("wall_time")
        .filter(|_| stderr.is_terminal())
    {
        // Nobody may be listening any more.
        let _ = writeln!(stderr, "took {wall_time:.3} s");
    }
}

/// Says when the scene's grid is too coarse for a column whose contacts are all closed:
/// of a run that went well all the same. One that did not has said so.
fn warn_of_steps(scene: &Scene) {
    if let Some(least) = spectrum::too_few_steps(scene) {
        let method = scene.method.name().as_str();
        note(&format!(
            "{method} becomes unstable on this column, when it is closed, below {least:.1} steps \
             in a contact time"
        ));
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::export::Format;

    fn refused(format: Format, every: Option<f64>) -> String {
        let args = RunArgs {
            preset: "fig1b".to_owned(),
            settings: Vec::new(),
            method: None,
            format,
            every,
            sensitivity: false,
            out: None,
        };
        match run(&args) {
            Err(Failure::BadInput(line)) => line,
            other => panic!("{other:?}"),
        }
    }

    #[test]
    fn formats_are_asked_for_what_they_write() {
        let [text, ..] = FORMATS;
        let line = refused(text, Some(1e-3));
        assert_eq!(
            line,
            "--every: needs --format csv or xyz, which print the motion"
        );
        let of_motion = Format {
            name: "film",
            results: None,
            ..text
        };
        let line = refused(of_motion, None);
        assert_eq!(
            line,
            "--format film: needs --every, since it is of the motion"
        );
    }
}
