//! `beadlab run`: a scene without pictures.

mod report;
mod rows;
mod series;

use super::output::Output;
use super::progress::Progress;
use super::{Failure, load, note};
use crate::cli::{Format, RunArgs};
use crate::physics::spectrum;
use crate::scene::Scene;
use crate::study::Drive;
use std::io::Write;
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
    let mut progress = Progress::new(preset.scene.duration);
    let mut watch = |time| {
        progress.show(time);
        ControlFlow::Continue(())
    };
    if let Some(every) = args.every {
        let drive = Drive::new(&preset.scene, &mut watch);
        series::print(&preset.scene, drive, every, output)?;
        warn_of_steps(&preset.scene);
        return Ok(());
    }
    let report = rows::measure(&preset, args.sensitivity, &mut watch)?;
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
