//! One run of a case within its budget.

use crate::physics::{Engine, EngineError, Observation, build};
use crate::scene::Scene;
use crate::study::{Drive, RunError};
use std::ops::ControlFlow;
use std::time::{Duration, Instant};

/// Looks at a run under gravity.
const LOOKS: usize = 200;

/// A run that would take so many budgets is not waited for.
const HOPELESS: f64 = 20.0;

/// What is compared: one number, or one at each look.
pub(super) type Numbers = Vec<f64>;

/// How a run ended.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum Ending {
    /// It came to its end.
    Done { numbers: Numbers, end: f64 },
    /// The budget was spent; the whole run would take so long, s, where that is known.
    Slow { needed: Option<f64> },
    /// The engine could not go on.
    Broken { error: EngineError },
}

/// Runs a scene, from its start or from another engine's. `end`: when it is known to
/// be over, s.
pub(super) fn run(
    scene: &Scene,
    from: Option<Box<dyn Engine>>,
    budget: Duration,
    end: Option<f64>,
) -> Ending {
    let started = Instant::now();
    let end = scene.duration.or(end);
    let estimate = |time: f64| {
        let end = end.filter(|_| time > 0.0)?;
        Some(started.elapsed().as_secs_f64() * (end / time).max(1.0))
    };
    let mut in_budget = |time: f64| {
        let spent = started.elapsed();
        let hopeless = spent > budget / 4
            && estimate(time).is_some_and(|all| all > HOPELESS * budget.as_secs_f64());
        if spent > budget || hopeless {
            ControlFlow::Break(())
        } else {
            ControlFlow::Continue(())
        }
    };
    let engine = from.unwrap_or_else(|| build(scene, None).0);
    let mut drive = Drive::of(engine, scene, &mut in_budget);
    let followed = match scene.duration.filter(|_| scene.gravity.is_some()) {
        Some(duration) => heights(&mut drive, duration),
        None => collision(&mut drive, scene),
    };
    match followed {
        Ok(numbers) => Ending::Done {
            numbers,
            end: drive.time(),
        },
        Err(RunError::Stopped { time }) => Ending::Slow {
            needed: estimate(time),
        },
        Err(RunError::Engine(error)) => Ending::Broken { error },
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
