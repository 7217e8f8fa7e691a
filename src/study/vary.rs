//! Scenes that differ from another in a few things.

use crate::physics::{self, Engine};
use crate::scene::parameters::{Setting, Value, find};
use crate::scene::{Draft, MethodName, Scene, SceneError};

/// The scene under a method, with other values of parameters.
///
/// # Errors
/// When the scene cannot have them.
pub fn vary(
    scene: &Scene,
    method: Option<MethodName>,
    values: &[(&'static str, Value)],
) -> Result<Scene, SceneError> {
    let mut draft = Draft::of(scene);
    if let Some(name) = method {
        draft = draft.under(name);
    }
    let layer: Vec<Setting> = values
        .iter()
        .filter_map(|&(name, value)| Some((find(name)?, value)))
        .map(|(parameter, value)| Setting { parameter, value })
        .collect();
    draft.set(&layer)?;
    draft.finish()
}

/// Ways in which the last bits of a start can differ.
pub const PATTERNS: usize = 3;

/// The engine of a scene that differs in the last bit: of gravity, which a column at
/// rest has no gaps to differ in from, or without it of gaps and beads' velocities at the
/// start, or where there are no gaps, of the column's velocity; up and down by turns, all
/// up, or up in every third. What two right methods may differ by.
pub fn one_ulp_off(scene: &Scene, pattern: usize) -> Box<dyn Engine> {
    let up = |i: usize| match pattern {
        0 => i.is_multiple_of(2),
        1 => true,
        _ => i.is_multiple_of(3),
    };
    let factor = |i: usize| {
        if up(i) {
            1.0 + f64::EPSILON
        } else {
            1.0 - f64::EPSILON
        }
    };
    if let Some(gravity) = scene.gravity {
        let bits = (pattern + 1) as f64;
        let gravity = Value::Number(gravity * (1.0 + bits * f64::EPSILON));
        if let Ok(off) = vary(scene, None, &[("gravity", gravity)]) {
            return physics::build(&off, None).0;
        }
    }
    let (engine, _) = physics::build(scene, None);
    let mut state = engine.state();
    if state.gaps.iter().any(|&g| g != 0.0) {
        for (i, gap) in state.gaps.iter_mut().enumerate() {
            *gap *= factor(i);
        }
        // Beads' velocities, of which the rates are differences; not the gaps' pattern.
        let (mut v, mut below) = (0.0, 0.0);
        for (i, rate) in state.rates.iter_mut().enumerate() {
            v += *rate;
            let now = v * factor(i / 2);
            *rate = now - below;
            below = now;
        }
    } else {
        for (i, rate) in state.rates.iter_mut().enumerate() {
            *rate *= factor(i);
        }
    }
    physics::build(scene, Some(&state)).0
}
