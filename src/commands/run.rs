//! `beadlab run`: a scene without pictures.

mod report;
mod rows;
mod runs;
mod series;

use super::output::Output;
use super::progress::Waiting;
use super::{Failure, load, note};
use crate::cli::{Format, RunArgs};
use crate::physics::spectrum;
use crate::scene::Scene;
use crate::study::Drive;
use runs::Runs;
use std::io::{self, IsTerminal, Write};
use std::ops::ControlFlow;

/// Runs `beadlab run`.
///
/// # Errors
/// [`Failure::BadInput`] for arguments that make no run, [`Failure::Failed`] when
/// the engine cannot go on or the results cannot be written.
pub fn run(args: &RunArgs) -> Result<(), Failure> {
    if args.every.is_some() && args.format != Format::Csv {
        let reason = "--every: needs --format csv, which prints the motion";
        return Err(Failure::BadInput(reason.to_owned()));
    }
    let preset = load(&args.preset, args.method, &args.settings)?;
    if let Some(every) = args.every {
        series::check(&preset.scene, every)?;
    }
    let mut output = Output::open(args.out.as_deref())?;
    // Rows on the same terminal show by themselves how far it is.
    let shows_itself = args.every.is_some() && args.out.is_none() && io::stdout().is_terminal();
    let waiting = if shows_itself {
        Waiting::unseen()
    } else {
        Waiting::new()
    };
    let mut runs = Runs::new(&preset.scene, args.sensitivity, waiting);
    if let Some(every) = args.every {
        let mut watch = |time| {
            runs.show(time);
            ControlFlow::Continue(())
        };
        let drive = Drive::new(&preset.scene, &mut watch);
        series::print(&preset.scene, drive, every, output)?;
        warn_of_steps(&preset.scene);
        return Ok(());
    }
    let report = rows::measure(&preset, args.sensitivity, &mut runs)?;
    drop(runs);
    warn_of_steps(&preset.scene);
    let written = output.write_all(report.written(args.format).as_bytes());
    if written.is_err() {
        return output.judge(written);
    }
    output.finish()?;
    if args.format == Format::Text {
        report.tell_time();
    }
    Ok(())
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
