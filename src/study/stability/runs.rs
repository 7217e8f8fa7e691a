//! One run of a case within its budget.

use crate::physics::{Engine, EngineError, Observation, build};
use crate::scene::Scene;
use crate::study::{Allowance, Drive, RunError, SLICE};
use std::ops::ControlFlow;

/// Looks at a run under gravity.
const LOOKS: usize = 200;

/// What is compared: one number, or one at each look.
pub(super) type Numbers = Vec<f64>;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum RunEnd {
    /// It came to its end.
    Done { numbers: Numbers, end: f64 },
    /// Its work was spent; the whole run would take so long, s on an ordinary machine,
    /// where that is known.
    Slow { needed: Option<f64> },
    /// The engine could not go on.
    Broken { error: EngineError },
}

/// Runs a scene, from its start or from another engine's, in so many slices of work.
/// `end`: when it is known to be over, s.
pub(super) fn run(
    scene: &Scene,
    from: Option<Box<dyn Engine>>,
    slices: u64,
    end: Option<f64>,
) -> RunEnd {
    let allowance = Allowance {
        slices,
        end: scene.duration.or(end),
    };
    let mut nobody = |_| ControlFlow::Continue(());
    let engine = from.unwrap_or_else(|| build(scene, None).0);
    let mut drive = Drive::of(engine, scene, &mut nobody).within(allowance);
    let followed = match scene.duration.filter(|_| scene.gravity.is_some()) {
        Some(duration) => heights(&mut drive, duration),
        None => collision(&mut drive, scene),
    };
    match followed {
        Ok(numbers) => RunEnd::Done {
            numbers,
            end: drive.time(),
        },
        Err(RunError::Stopped { time }) => RunEnd::Slow {
            needed: allowance
                .needed(drive.spent(), time)
                .map(|slices| slices * SLICE),
        },
        Err(RunError::Engine(error)) => RunEnd::Broken { error },
    }
}

fn collision(drive: &mut Drive, scene: &Scene) -> Result<Numbers, RunError> {
    let mut seen = Observation::default();
    drive.observe(&mut seen);
    let before = seen.energy.kinetic;
    drive.collide(scene)?;
    drive.observe(&mut seen);
    Ok(vec![(seen.energy.kinetic / before).sqrt()])
}

fn heights(drive: &mut Drive, duration: f64) -> Result<Numbers, RunError> {
    let mut seen = Observation::default();
    let mut heights = Vec::with_capacity(LOOKS);
    for look in 1..=LOOKS {
        drive.advance(duration * (look as f64 / LOOKS as f64))?;
        drive.observe(&mut seen);
        heights.push(seen.centre);
    }
    Ok(heights)
}

/// The largest difference, relative to the reference or to its range.
pub(super) fn distance(numbers: &Numbers, truth: &Numbers) -> f64 {
    let (low, high) = truth
        .iter()
        .fold((f64::INFINITY, f64::NEG_INFINITY), |(low, high), &x| {
            (low.min(x), high.max(x))
        });
    let scale = if truth.len() == 1 {
        truth[0].abs()
    } else {
        high - low
    };
    let apart = numbers.iter().zip(truth).map(|(a, b)| (a - b).abs());
    let most = apart.fold(0.0, f64::max);
    if most == 0.0 { 0.0 } else { most / scale }
}
