//! What every method makes of a case.

use super::RIGHT;
use super::cases::Case;
use super::runs::{Ending, Numbers, distance, run};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene, Start};
use crate::study::{one_ulp_off, vary};
use std::time::Duration;

/// Steps in a contact time of the methods on a grid, and of the run that checks: the
/// first that there is time for.
const STEPS: f64 = 100.0;
const CHECK_STEPS: [f64; 2] = [6400.0, 800.0];

/// Of the error of a coarse grid, what is left on the fine one, of at least
/// eight times the steps, where the method converges.
const CONVERGING: f64 = 0.3;

/// What a last bit may do to a right number, beyond itself.
const LAST_BITS: f64 = 10.0;

/// What became of a method on a case.
#[derive(Debug, Clone, PartialEq)]
pub enum Verdict {
    /// Its relative error is small enough.
    Right(f64),
    /// It is not.
    Off(f64),
    /// Another model, so far from the reference.
    Model(f64),
    /// It came to its end, and nothing says how right; what the last bit changes, if
    /// that is known.
    Ran(Option<f64>),
    /// It became unstable or lost the column: when, s, and the engine's words.
    Breaks(f64, String),
    /// It would take so long, s, where that is known.
    Slow(Option<f64>),
    /// The scene is not allowed: the words for it.
    Refused(String),
}

/// A method and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The method.
    pub method: MethodName,
    /// What became of it.
    pub verdict: Verdict,
}

impl Verdict {
    /// In at most 12 characters.
    pub fn short(&self) -> String {
        match self {
            Self::Right(error) => format!("right {}", brief(*error)),
            Self::Off(error) => format!("off {}", brief(*error)),
            Self::Model(error) => format!("model {}", brief(*error)),
            Self::Ran(Some(bits)) => format!("ran {}", brief(*bits)),
            Self::Ran(None) => "ran".to_owned(),
            Self::Breaks(time, _) => format!("breaks {}", brief(*time)),
            Self::Slow(Some(needed)) => format!("slow {}", brief(*needed)),
            Self::Slow(None) => "slow".to_owned(),
            Self::Refused(_) => "refused".to_owned(),
        }
    }

    /// In full.
    pub fn long(&self) -> String {
        match self {
            Self::Right(error) => format!("right, error {error:e}"),
            Self::Off(error) => format!("inaccurate, error {error:e}"),
            Self::Model(error) => format!("another model, distance {error:e}"),
            Self::Ran(Some(bits)) => format!("came to its end; the last bit changes {bits:e}"),
            Self::Ran(None) => "came to its end, with nothing to compare with".to_owned(),
            Self::Breaks(time, why) => format!("breaks at {time:e} s: {why}"),
            Self::Slow(Some(needed)) => format!("too slow, would take {needed:.1} s"),
            Self::Slow(None) => "too slow, for an unknown time".to_owned(),
            Self::Refused(why) => format!("refused: {why}"),
        }
    }
}

/// One digit, as short as it goes.
fn brief(x: f64) -> String {
    if (0.01..1.0).contains(&x) {
        return format!("{x:.2}");
    }
    if (1.0..1000.0).contains(&x) || x == 0.0 {
        return format!("{x:.0}");
    }
    format!("{x:.0e}")
}

/// Numbers to compare with, and how far two right runs may differ.
struct Truth {
    numbers: Numbers,
    allowed: f64,
}

/// Runs every method on a case, each within the budget.
pub fn judge(case: &Case, budget: Duration) -> Vec<Judgement> {
    let scene = match &case.scene {
        Ok(scene) => scene,
        Err(error) => {
            let refused = |method| Judgement {
                method,
                verdict: Verdict::Refused(error.to_string()),
            };
            return MethodName::ALL.map(refused).into();
        }
    };
    let exact = run(scene, None, budget, None);
    let end = match &exact {
        Ending::Done { end, .. } => Some(*end),
        _ => None,
    };
    let (check, finest) = check(scene, budget, end);
    let (of_exact, truth) = reference(scene, &exact, &check, budget, end);
    // A coarse grid can confirm, but not convict.
    let of_exact = match of_exact {
        Verdict::Off(_) if !finest => Verdict::Ran(None),
        verdict => verdict,
    };
    let judgement = |method| Judgement {
        method,
        verdict: match method {
            MethodName::Exact => of_exact.clone(),
            _ => other(scene, method, truth.as_ref(), budget, end),
        },
    };
    MethodName::ALL.map(judgement).into()
}

/// How far another scene's numbers are, if it comes to its end.
fn from(scene: &Scene, truth: &Numbers, budget: Duration, end: Option<f64>) -> Option<f64> {
    match run(scene, None, budget, end) {
        Ending::Done { numbers, .. } => Some(distance(&numbers, truth)),
        _ => None,
    }
}

/// The scene with its beads farther apart by the way that they go in a step of the
/// coarser checking grid.
fn below_the_grid(scene: &Scene) -> Option<Scene> {
    let Start::Separated { s0, v0, .. } = scene.start else {
        return None;
    };
    let fallen = (2.0 * scene.gravity.unwrap_or(0.0) * s0).sqrt();
    let step = v0.abs().max(fallen) * scene.contact_time()? / CHECK_STEPS[1];
    vary(scene, None, &[("s0", Value::Number(s0 + step))]).ok()
}

/// Verlet on the finest grid that there is time for, and whether that is the finest of all.
fn check(scene: &Scene, budget: Duration, end: Option<f64>) -> (Ending, bool) {
    let mut ending = Ending::Slow { needed: None };
    for (k, steps) in CHECK_STEPS.into_iter().enumerate() {
        if let Ok(fine) = on_grid(scene, MethodName::Verlet, steps) {
            ending = run(&fine, None, budget, end);
        }
        if matches!(ending, Ending::Done { .. }) {
            return (ending, k == 0);
        }
    }
    (ending, false)
}

fn on_grid(scene: &Scene, method: MethodName, steps: f64) -> Result<Scene, String> {
    let steps = [("steps_per_contact", Value::Number(steps))];
    vary(scene, Some(method), &steps).map_err(|error| error.to_string())
}

/// The verdict on the exact method, and what the others are compared with.
fn reference(
    scene: &Scene,
    exact: &Ending,
    check: &Ending,
    budget: Duration,
    end: Option<f64>,
) -> (Verdict, Option<Truth>) {
    let Ending::Done { numbers, .. } = exact else {
        let truth = match check {
            Ending::Done { numbers, .. } => Some(Truth {
                numbers: numbers.clone(),
                allowed: RIGHT,
            }),
            _ => None,
        };
        return (unfinished(exact), truth);
    };
    let near = run(scene, Some(one_ulp_off(scene, 0)), budget, end);
    let last_bit = match &near {
        Ending::Done { numbers: near, .. } => Some(distance(near, numbers)),
        _ => None,
    };
    let allowed = RIGHT.max(LAST_BITS * last_bit.unwrap_or(0.0));
    let verdict = match check {
        Ending::Done { numbers: fine, .. } if distance(fine, numbers) <= allowed => {
            Verdict::Right(last_bit.unwrap_or(0.0))
        }
        Ending::Done { numbers: fine, .. } => {
            let fine = distance(fine, numbers);
            let coarse = on_grid(scene, MethodName::Verlet, STEPS).ok();
            let coarse = coarse.and_then(|grid| from(&grid, numbers, budget, end));
            let shifted = below_the_grid(scene).and_then(|s| from(&s, numbers, budget, end));
            if coarse.is_some_and(|coarse| fine < CONVERGING * coarse) {
                // A method of first order that comes nearer with its step is on its way.
                Verdict::Right(last_bit.unwrap_or(0.0))
            } else if shifted.is_some_and(|shifted| fine < LAST_BITS * shifted) {
                // What the grid cannot resolve changes as much: it cannot tell.
                Verdict::Ran(last_bit)
            } else {
                Verdict::Off(fine)
            }
        }
        _ => Verdict::Ran(last_bit),
    };
    let truth = Truth {
        numbers: numbers.clone(),
        allowed,
    };
    (verdict, Some(truth))
}

fn other(
    scene: &Scene,
    method: MethodName,
    truth: Option<&Truth>,
    budget: Duration,
    end: Option<f64>,
) -> Verdict {
    let under = match method {
        MethodName::Gear | MethodName::Verlet => on_grid(scene, method, STEPS),
        _ => scene.with_method(method).map_err(|error| error.to_string()),
    };
    let under = match under {
        Ok(under) => under,
        Err(why) => return Verdict::Refused(why),
    };
    let ending = run(&under, None, budget, end);
    let (Ending::Done { numbers, .. }, Some(truth)) = (&ending, truth) else {
        return unfinished(&ending);
    };
    let error = distance(numbers, &truth.numbers);
    match error {
        _ if !under.is_md() => Verdict::Model(error),
        _ if error <= truth.allowed => Verdict::Right(error),
        _ => Verdict::Off(error),
    }
}

/// The verdict where there is nothing to compare.
fn unfinished(ending: &Ending) -> Verdict {
    match ending {
        Ending::Done { .. } => Verdict::Ran(None),
        Ending::Slow { needed } => Verdict::Slow(*needed),
        Ending::Broken { error } => Verdict::Breaks(error.time(), error.to_string()),
    }
}
