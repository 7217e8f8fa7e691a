//! What every method makes of a case.

use super::cases::Case;
use super::reference::{Truth, reference};
use super::runs::{RunEnd, distance, run};
use super::verdict::{CaseVerdict, Judgement, unfinished};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::vary;

/// Steps in a contact time of the methods on a grid.
const STEPS: f64 = 100.0;

/// Runs every method on a case, each within so many slices of work; who waits is told
/// which it is at.
pub fn judge(case: &Case, slices: u64, tell: &mut dyn FnMut(&str)) -> Vec<Judgement> {
    let scene = match &case.scene {
        Ok(scene) => scene,
        Err(error) => {
            let refused = |method| Judgement {
                method,
                verdict: CaseVerdict::Refused(error.to_string()),
            };
            return MethodName::ALL.map(refused).into();
        }
    };
    tell("exact");
    let exact = run(scene, None, slices, None);
    let end = match &exact {
        RunEnd::Done { end, .. } => Some(*end),
        _ => None,
    };
    tell("what it is compared with");
    let (of_exact, truth) = reference(scene, &exact, slices, end);
    let judgement = |method: MethodName| {
        tell(method.as_str());
        Judgement {
            method,
            verdict: match method {
                MethodName::Exact => of_exact.clone(),
                _ => other(scene, method, truth.as_ref(), slices, end),
            },
        }
    };
    MethodName::ALL.map(judgement).into()
}

fn on_grid(scene: &Scene, method: MethodName, steps: f64) -> Result<Scene, String> {
    let steps = [("steps_per_contact", Value::Number(steps))];
    vary(scene, Some(method), &steps).map_err(|error| error.to_string())
}

fn other(
    scene: &Scene,
    method: MethodName,
    truth: Option<&Truth>,
    slices: u64,
    end: Option<f64>,
) -> CaseVerdict {
    let under = match method {
        MethodName::Gear | MethodName::Verlet => on_grid(scene, method, STEPS),
        _ => scene.with_method(method).map_err(|error| error.to_string()),
    };
    let under = match under {
        Ok(under) => under,
        Err(why) => return CaseVerdict::Refused(why),
    };
    let ending = run(&under, None, slices, end);
    let (RunEnd::Done { numbers, .. }, Some(truth)) = (&ending, truth) else {
        return unfinished(&ending);
    };
    let error = distance(numbers, &truth.numbers);
    match error {
        _ if !under.is_md() => CaseVerdict::Model(error),
        _ if error <= truth.allowed => CaseVerdict::Right(error),
        _ => CaseVerdict::Off(error),
    }
}
