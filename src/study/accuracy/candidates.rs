//! The methods that fit a scene, each on a ladder of what it can be set to.

use crate::math;
use crate::scene::parameters::{Value, find};
use crate::scene::{MethodName, Scene};
use crate::study::vary;

/// Steps per contact of the first rung, and how many rungs there are.
const FIRST_STEPS: f64 = 25.0;
const RUNGS: i32 = 8;
const QUICK_RUNGS: i32 = 4;

/// A method with one setting.
#[derive(Debug, Clone, PartialEq)]
pub struct Candidate {
    /// The method.
    pub method: MethodName,
    /// The parameter that its ladder moves, and its value.
    pub rung: Option<(&'static str, f64)>,
    /// The scene under it.
    pub scene: Scene,
}

impl Candidate {
    /// Whether it is the reference, with nothing to trade.
    pub fn is_reference(&self) -> bool {
        self.method == MethodName::Exact && self.rung.is_none()
    }

    /// Whether it solves another problem than the reference: hard spheres.
    pub fn is_other_model(&self) -> bool {
        !self.scene.is_md()
    }

    /// Its setting in words: steps in a contact time, or a tolerance.
    pub fn setting(&self) -> String {
        match self.rung {
            Some(("steps_per_contact", steps)) => format!("t_c/{steps}"),
            Some((_, value)) => format!("{value:e}"),
            None => String::new(),
        }
    }
}

/// Every method that fits the scene, on `rungs` of its ladder; the reference comes
/// last but for hard spheres. A method that the scene cannot have is left out.
pub fn candidates(scene: &Scene, quick: bool) -> Vec<Candidate> {
    let rungs = if quick { QUICK_RUNGS } else { RUNGS };
    let mut all = Vec::new();
    for method in MethodName::ALL {
        let Ok(under) = scene.with_method(method) else {
            continue;
        };
        let ladder = ladder(&under, rungs);
        if ladder.is_empty() {
            all.push(Candidate {
                method,
                rung: None,
                scene: under,
            });
            continue;
        }
        for rung in ladder {
            if let Ok(scene) = vary(&under, None, &[(rung.0, Value::Number(rung.1))]) {
                all.push(Candidate {
                    method,
                    rung: Some(rung),
                    scene,
                });
            }
        }
    }
    all
}

/// Values of the parameter that trades accuracy for time, if the method has one.
fn ladder(scene: &Scene, rungs: i32) -> Vec<(&'static str, f64)> {
    let has = |name: &str| {
        find(name)
            .and_then(|row| (row.get)(scene.facts()))
            .is_some()
    };
    if has("steps_per_contact") {
        let steps = |rung| ("steps_per_contact", FIRST_STEPS * math::powi(2.0, rung));
        (0..rungs).map(steps).collect()
    } else if has("tolerance") {
        let tolerance = |rung| ("tolerance", math::powi(10.0, -3 - rung));
        (0..rungs).map(tolerance).collect()
    } else {
        Vec::new()
    }
}
