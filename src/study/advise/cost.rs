//! What the methods cost at a contact time, measured side by side.

use super::{Question, SceneKind};
use crate::physics::{Observation, spectrum};
use crate::scene::parameters::Value;
use crate::scene::{GridSettings, MethodName, Scene};
use crate::study::fit::median;
use crate::study::{Drive, Results, RunError, Tell, in_time, measure, vary};
use std::time::{Duration, Instant};

/// Runs of one method; the middle one counts.
const TURNS: usize = 5;

/// Wall-clock time of a turn, where a run need not come to its end.
const TURN: Duration = Duration::from_millis(300);
const QUICK_TURN: Duration = Duration::from_millis(60);

/// Turns' time that a floor collision may take.
const PATIENCE: u32 = 10;

/// Turns' time after which nothing is repeated.
const ENOUGH: u32 = 12;

/// Periods of a plate that a run must have seen at least.
const LEAST_PERIODS: f64 = 5.0;

/// What a method costs.
pub(super) struct Cost {
    pub method: MethodName,
    /// Time step, s, and the largest one that is stable on the closed column.
    pub step: Option<f64>,
    pub stable: Option<f64>,
    pub steps_per_contact: Option<f64>,
    /// Steps or collisions, and run time, s: of a floor collision, or of a simulated second.
    pub work: Option<f64>,
    pub run_time: Option<f64>,
    pub eps_eff: Option<f64>,
    pub failure: Option<String>,
}

/// What one turn gave: steps or collisions, run time in s, results.
type TimedTurn = (f64, f64, Option<Results>);

/// Every method on a scene, or on its hard twin; methods take turns.
/// The grid is that of the scene `asked` about, where it has one.
pub(super) fn costs(
    scene: &Scene,
    asked: &Scene,
    kind: SceneKind,
    question: Question,
    tell: &mut Tell,
) -> Vec<Cost> {
    let methods = [
        MethodName::Exact,
        MethodName::Verlet,
        MethodName::Gear,
        MethodName::Ed,
    ];
    let scenes: Vec<Scene> = methods
        .into_iter()
        .filter(|&method| method != MethodName::Ed || is_linear(scene))
        .filter_map(|method| on_grid_of(asked, scene.with_method(method).ok()?))
        .collect();
    let turn = if question.quick { QUICK_TURN } else { TURN };
    let mut turns: Vec<Vec<Result<TimedTurn, RunError>>> =
        scenes.iter().map(|_| Vec::new()).collect();
    let all = TURNS * scenes.len();
    let started = Instant::now();
    for k in 0..TURNS {
        if started.elapsed() > ENOUGH * turn {
            break;
        }
        for (j, (scene, turns)) in scenes.iter().zip(&mut turns).enumerate() {
            let at = k * scenes.len() + j + 1;
            tell(&format!("the cost, run {at} of {all} at most"), None);
            // What failed or was too slow once is so again.
            if turns.last().is_none_or(Result::is_ok) {
                turns.push(match kind {
                    SceneKind::Launched => collision(scene, PATIENCE * turn),
                    SceneKind::Falling | SceneKind::Shaken => followed(scene, turn),
                });
            }
        }
    }
    let pairs = scenes.iter().zip(turns);
    pairs.map(|(scene, turns)| cost(scene, &turns)).collect()
}

/// Hard spheres are no twin of a power law.
fn is_linear(scene: &Scene) -> bool {
    scene.is_md() && !scene.depends_on_speed()
}

/// The scene with the grid of another, if both have one.
fn on_grid_of(asked: &Scene, scene: Scene) -> Option<Scene> {
    match (scene.grid(), asked.grid()) {
        (Some(_), Some(grid)) => {
            let steps = Value::Number(grid.steps_per_contact);
            vary(&scene, None, &[("steps_per_contact", steps)]).ok()
        }
        _ => Some(scene),
    }
}

fn cost(scene: &Scene, turns: &[Result<TimedTurn, RunError>]) -> Cost {
    let done: Vec<&TimedTurn> = turns.iter().filter_map(|turn| turn.as_ref().ok()).collect();
    let middle = |of: &dyn Fn(&TimedTurn) -> f64| {
        let values: Vec<f64> = done.iter().map(|turn| of(turn)).collect();
        (!values.is_empty()).then(|| median(&values))
    };
    let grid = scene.grid();
    let stable = |grid: GridSettings| spectrum::largest_stable_step(scene, grid.integrator);
    let failed = turns.iter().find_map(|turn| turn.as_ref().err());
    Cost {
        method: scene.method.name(),
        step: grid.and_then(|grid| Some(scene.contact_time()? / grid.steps_per_contact)),
        stable: grid.and_then(stable),
        steps_per_contact: grid.map(|grid| grid.steps_per_contact),
        work: middle(&|turn| turn.0),
        run_time: middle(&|turn| turn.1),
        eps_eff: done.last().and_then(|turn| turn.2.as_ref()?.eps_eff),
        failure: failed.map(|error| match error {
            RunError::Stopped { .. } => "too slow to be measured".to_owned(),
            RunError::Engine(error) => error.to_string(),
        }),
    }
}

/// A whole floor collision.
fn collision(scene: &Scene, most: Duration) -> Result<TimedTurn, RunError> {
    let started = Instant::now();
    let mut watch = in_time(started + most);
    let results = measure(scene, &mut Drive::new(scene, &mut watch))?;
    let seconds = started.elapsed().as_secs_f64();
    let work = results.steps + results.events;
    Ok((work as f64, seconds, Some(results)))
}

/// As much of a run under gravity as there is time for, at least some periods.
fn followed(scene: &Scene, turn: Duration) -> Result<TimedTurn, RunError> {
    let fall = (scene.diameter / scene.gravity.unwrap_or(f64::NAN)).sqrt();
    let period = scene.period().unwrap_or(fall);
    let started = Instant::now();
    let mut watch = in_time(started + PATIENCE * turn);
    let mut drive = Drive::new(scene, &mut watch);
    let mut seen = Observation::default();
    let mut until = 0.0;
    // What only falls has an end; what is shaken goes on.
    let end = match scene.period() {
        Some(_) => f64::INFINITY,
        None => scene.duration.unwrap_or(period),
    };
    let enough = (LEAST_PERIODS * period).min(end);
    while until < enough || (until < end && started.elapsed() < turn) {
        until = end.min(until + period);
        match drive.advance(until) {
            // Less than that says little, but something.
            Err(RunError::Stopped { time }) if time > period => break,
            other => other?,
        };
    }
    let seconds = started.elapsed().as_secs_f64();
    drive.observe(&mut seen);
    let work = match scene.method.name() {
        MethodName::Ed => seen.events,
        _ => seen.steps,
    };
    let simulated = drive.time();
    Ok((work as f64 / simulated, seconds / simulated, None))
}
