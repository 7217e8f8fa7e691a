//! The largest stable step of the methods on a grid: found by bisection on a column
//! that stays closed, and foretold from its spectrum.

use crate::math;
use crate::physics::{build, spectrum};
use crate::scene::parameters::Value;
use crate::scene::{Integrator, MethodName, Preset, Scene};
use crate::study::{Tell, vary};

const BEADS: [u64; 5] = [1, 2, 10, 100, 1000];
const RESTITUTIONS: [f64; 6] = [1.0, 0.9, 0.6, 0.1, 1e-3, 1e-6];

/// Coarsest and finest grids that are tried, in steps per contact.
const COARSEST: f64 = 2.0;
const FINEST: f64 = 1e6;

/// Work of one trial, in bead steps, and the steps it has at least and at most.
const BEAD_STEPS: usize = 1_000_000;
const STEPS: (usize, usize) = (3_000, 50_000);

/// Growth of the disturbance that no stable column shows.
const GROWN: f64 = 10.0;

/// The disturbance, over the speed that a bead gains by falling for a contact time:
/// so little that no contact opens.
const DISTURBANCE: f64 = 1e-5;

/// Least steps per contact of a column, found (none: the coarsest grid is stable) and
/// foretold.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Limit {
    /// Beads.
    pub n: usize,
    /// Restitution.
    pub restitution: f64,
    /// Of Gear's method.
    pub gear: (Option<f64>, Option<f64>),
    /// Of Verlet's.
    pub verlet: (Option<f64>, Option<f64>),
}

/// The limits of columns of several lengths and restitutions.
pub fn limits(quick: bool, tell: &mut Tell) -> Vec<Limit> {
    let beads = if quick { &BEADS[..3] } else { &BEADS[..] };
    let count = beads.len() * RESTITUTIONS.len();
    let mut limits = Vec::new();
    for &n in beads {
        for restitution in RESTITUTIONS {
            let at = limits.len() + 1;
            tell(&format!("least steps, column {at} of {count}: N {n}"), None);
            if let Some(scene) = resting(n, restitution) {
                limits.push(Limit {
                    n: scene.n,
                    restitution,
                    gear: limit(&scene, MethodName::Gear, Integrator::Gear),
                    verlet: limit(&scene, MethodName::Verlet, Integrator::Verlet),
                });
            }
        }
    }
    limits
}

/// A column at rest on a plate that does not move.
fn resting(n: u64, restitution: f64) -> Option<Scene> {
    let preset = Preset::load("fig5b").ok()?;
    let values = [
        ("n", Value::Whole(n)),
        ("restitution", Value::Number(restitution)),
        ("amplitude", Value::Number(0.0)),
    ];
    vary(&preset.scene, None, &values).ok()
}

fn limit(scene: &Scene, method: MethodName, integrator: Integrator) -> (Option<f64>, Option<f64>) {
    let theory = spectrum::largest_stable_step(scene, integrator)
        .zip(scene.contact_time())
        .map(|(step, contact_time)| contact_time / step);
    (found(|steps| is_stable(scene, method, steps)), theory)
}

/// The least steps that are stable, to a part in a thousand.
fn found(is_stable: impl Fn(f64) -> bool) -> Option<f64> {
    if is_stable(COARSEST) {
        return None;
    }
    let mut unstable = COARSEST;
    let mut stable = 2.0 * COARSEST;
    while !is_stable(stable) {
        (unstable, stable) = (stable, 2.0 * stable);
        if stable > FINEST {
            return None;
        }
    }
    while stable / unstable > 1.001 {
        let middle = (stable * unstable).sqrt();
        if is_stable(middle) {
            stable = middle;
        } else {
            unstable = middle;
        }
    }
    Some(stable)
}

/// Whether a slight disturbance of the column does not grow.
fn is_stable(scene: &Scene, method: MethodName, steps: f64) -> bool {
    let grid = [("steps_per_contact", Value::Number(steps))];
    let Ok(scene) = vary(scene, Some(method), &grid) else {
        return false;
    };
    let mut state = build(&scene, None).0.state();
    let fall = scene.gravity.unwrap_or(0.0) * scene.contact_time().unwrap_or(0.0);
    for (k, rate) in state.rates.iter_mut().enumerate() {
        // All modes are in it.
        *rate = DISTURBANCE * fall * (1.0 + math::sin(k as f64 * 1.7));
    }
    let size = |rates: &[f64]| rates.iter().fold(0.0, |most, w| w.abs().max(most));
    let before = size(&state.rates);
    let mut engine = build(&scene, Some(&state)).0;
    let trial = (BEAD_STEPS / scene.n).clamp(STEPS.0, STEPS.1) as u64;
    engine.advance(f64::MAX, trial).is_ok() && size(&engine.state().rates) < GROWN * before
}
