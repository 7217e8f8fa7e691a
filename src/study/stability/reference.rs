//! What the exact method is measured by: the adaptive method of the power laws, for which
//! the linear law is one with β = γ = 0. The two share the scene, and no step.

use super::RIGHT;
use super::runs::{Numbers, RunEnd, distance, run};
use super::verdict::{CaseVerdict, unfinished};
use crate::scene::{Facts, Law, Method, Scene, Soft, Solver};
use crate::study::one_ulp_off;

/// Tolerance of the adaptive run, and of the one that tells how right it is.
const TOLERANCE: f64 = 1e-13;
const LOOSER: f64 = 1e-12;

/// Allowances that the adaptive run may take: it is what all the others hang on.
const PATIENCE: u64 = 4;

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
    let soft = scene.soft().filter(|_| !scene.depends_on_speed())?;
    let method = Method::Soft(Soft {
        law: Law::powers(soft.law.in_powers(scene.restitution)),
        solver: Solver::Adaptive { tolerance },
        ..soft
    });
    let facts = scene.facts().clone();
    Scene::new(Facts { method, ..facts }).ok()
}

/// The verdict on the exact method, and what the others are compared with.
pub(super) fn reference(
    scene: &Scene,
    exact: &RunEnd,
    slices: u64,
    end: Option<f64>,
) -> (CaseVerdict, Option<Truth>) {
    let numbers_of = |ending: RunEnd| match ending {
        RunEnd::Done { numbers, .. } => Some(numbers),
        _ => None,
    };
    let by_adaptive = |tolerance: f64| {
        let other = adaptive(scene, tolerance)?;
        numbers_of(run(&other, None, PATIENCE * slices, end))
    };
    let RunEnd::Done { numbers, .. } = exact else {
        let truth = by_adaptive(TOLERANCE).map(|numbers| Truth {
            numbers,
            allowed: RIGHT,
        });
        return (unfinished(exact), truth);
    };
    let near = run(scene, Some(one_ulp_off(scene, 0)), slices, end);
    let bits = numbers_of(near).map(|near| distance(&near, numbers));
    let several_bits = LAST_BITS * bits.unwrap_or(0.0);
    let verdict = match by_adaptive(TOLERANCE) {
        None => CaseVerdict::Ran(bits),
        Some(other) => {
            let error = distance(&other, numbers);
            // A run of less tolerance shows how far the adaptive method itself is off.
            let blurred =
                || by_adaptive(LOOSER).is_some_and(|loose| error <= distance(&loose, &other));
            if error <= SURE.max(several_bits) || (error <= RIGHT && blurred()) {
                CaseVerdict::Confirmed { error, bits }
            } else if blurred() {
                CaseVerdict::Ran(bits)
            } else {
                CaseVerdict::Off(error)
            }
        }
    };
    let truth = Truth {
        numbers: numbers.clone(),
        allowed: RIGHT.max(several_bits),
    };
    (verdict, Some(truth))
}
