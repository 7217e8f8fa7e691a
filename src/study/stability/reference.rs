//! What the exact method is measured by: the adaptive method of the power laws, for which
//! the linear law is one with β = γ = 0. The two share the scene, and no step.

use super::RIGHT;
use super::judge::{Verdict, unfinished};
use super::runs::{Ending, Numbers, distance, run};
use crate::scene::{Facts, Law, Method, PowerLaw, Scene, Solver};
use crate::study::{PATTERNS, one_ulp_off};

/// Tolerance of the adaptive run, and of the one that tells how right it is.
const TOLERANCE: f64 = 1e-13;
const LOOSER: f64 = 1e-12;

/// How near two right runs come, beyond what the last bit changes.
const SURE: f64 = 1e-10;

/// What a last bit may do to a right number, beyond itself.
const LAST_BITS: f64 = 10.0;

/// Numbers to compare with, and how far two right runs may differ.
pub(super) struct Truth {
    pub numbers: Numbers,
    pub allowed: f64,
}

/// The scene by the adaptive method.
fn adaptive(scene: &Scene, tolerance: f64) -> Option<Scene> {
    let Method::Md {
        law: Law::Hooke { contact_time },
        attraction,
        ..
    } = scene.method
    else {
        return None;
    };
    let method = Method::Md {
        law: Law::Power(PowerLaw::linear(scene.restitution, contact_time)),
        solver: Solver::Adaptive { tolerance },
        attraction,
    };
    let facts = scene.facts().clone();
    Scene::new(Facts { method, ..facts }).ok()
}

/// The verdict on the exact method, and what the others are compared with.
pub(super) fn reference(
    scene: &Scene,
    exact: &Ending,
    slices: u64,
    end: Option<f64>,
) -> (Verdict, Option<Truth>) {
    let numbers_of = |ending: Ending| match ending {
        Ending::Done { numbers, .. } => Some(numbers),
        _ => None,
    };
    let by_adaptive = |tolerance: f64| {
        let other = adaptive(scene, tolerance)?;
        numbers_of(run(&other, None, slices, end))
    };
    let Ending::Done { numbers, .. } = exact else {
        let truth = by_adaptive(TOLERANCE).map(|numbers| Truth {
            numbers,
            allowed: RIGHT,
        });
        return (unfinished(exact), truth);
    };
    let near = (0..PATTERNS).filter_map(|pattern| {
        let near = one_ulp_off(scene, pattern);
        numbers_of(run(scene, Some(near), slices, end))
    });
    let bits = near
        .map(|near| distance(&near, numbers))
        .fold(0.0, f64::max);
    let verdict = match by_adaptive(TOLERANCE) {
        None => Verdict::Ran(Some(bits)),
        Some(other) => {
            let error = distance(&other, numbers);
            // A run of less tolerance shows how far the adaptive method itself is off.
            let blurred =
                || by_adaptive(LOOSER).is_some_and(|loose| error <= distance(&loose, &other));
            if error <= SURE.max(LAST_BITS * bits) || (error <= RIGHT && blurred()) {
                Verdict::Confirmed { error, bits }
            } else if blurred() {
                Verdict::Ran(Some(bits))
            } else {
                Verdict::Off(error)
            }
        }
    };
    let truth = Truth {
        numbers: numbers.clone(),
        allowed: RIGHT.max(LAST_BITS * bits),
    };
    (verdict, Some(truth))
}
