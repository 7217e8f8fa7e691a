//! `beadlab advise`: the longest contact time that will do.

use super::progress::Waiting;
use super::report::{Destination, Part};
use super::{Failure, bad_input, load};
use crate::cli::AdviseArgs;
use crate::scene::words::quote;
use crate::study::advise::{AdviseError, Against, Question, advise, common_tolerance};
use std::num::NonZero;
use std::time::Duration;

/// Wall-clock time of a search where nobody says otherwise.
const TIME: Duration = Duration::from_secs(20);
const PLATE_TIME: Duration = Duration::from_secs(60);
const QUICK_TIME: Duration = Duration::from_secs(5);

/// Runs `beadlab advise`.
///
/// # Errors
/// [`Failure::BadInput`] for a scene or limit that makes no question or a folder that
/// cannot be written, [`Failure::Failed`] when the limit cannot be measured.
pub fn run(args: &AdviseArgs) -> Result<(), Failure> {
    let preset = load(&args.preset, None, &args.settings)?;
    let common = match preset.scene.gravity {
        _ if args.report.quick => QUICK_TIME,
        Some(_) => PLATE_TIME,
        None => TIME,
    };
    let question = Question {
        against: against(&args.against)?,
        tolerance: args
            .tolerance
            .unwrap_or_else(|| common_tolerance(&preset.scene)),
        between: args.between,
        quick: args.report.quick,
        time: args.budget.map_or(common, Duration::from_secs_f64),
        threads: std::thread::available_parallelism().map_or(1, NonZero::get),
    };
    let destination = Destination::open(&args.report)?;
    let mut waiting = Waiting::new();
    let advice = advise(&preset, question, &mut |what, part| {
        waiting.show(what, part);
    });
    drop(waiting);
    let advice = advice.map_err(|error| match error {
        AdviseError::Limit(_) | AdviseError::LimitTooSlow { .. } | AdviseError::NoLimit(_) => {
            Failure::Failed(error.to_string())
        }
        error => bad_input(error),
    })?;
    let mut parts = vec![Part::Shown(advice.answer), Part::Drawn(advice.plot)];
    if !advice.cost.rows().is_empty() {
        parts.push(Part::Shown(advice.cost));
    }
    parts.push(Part::Filed(advice.curve));
    destination.write_parts(&parts)
}

fn against(text: &str) -> Result<Against, Failure> {
    match text {
        "hard" => Ok(Against::Hard),
        "material" => Ok(Against::Material),
        _ => match text.parse::<f64>() {
            Ok(time) if time > 0.0 && time.is_finite() => Ok(Against::Time(time)),
            _ => Err(Failure::BadInput(format!(
                "--against {}: must be hard, material, or a contact time in seconds",
                quote(text)
            ))),
        },
    }
}
