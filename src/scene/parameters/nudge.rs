//! What a key press does to a value.

use super::{Kind, NudgeScale, Parameter, Value};
use crate::math;
use crate::numerals::rounded;

/// The value after `steps` key presses up (or down, if negative), within the
/// parameter's range. Flags toggle; choices go round.
pub fn nudge(parameter: &Parameter, value: Value, steps: i32, coarse: bool) -> Value {
    match (parameter.kind, value) {
        (Kind::Number { min, max, scale }, Value::Number(x)) => {
            Value::Number(move_number(scale, x, steps, coarse).clamp(min, max))
        }
        (
            Kind::Whole {
                min,
                max,
                fine,
                coarse: large,
            },
            Value::Whole(k),
        ) => {
            let step =
                if coarse { large } else { fine }.saturating_mul(steps.unsigned_abs().into());
            let moved = if steps < 0 {
                k.saturating_sub(step)
            } else {
                k.saturating_add(step)
            };
            Value::Whole(moved.clamp(min, max))
        }
        (Kind::Flag, Value::Flag(on)) => Value::Flag(on ^ (steps % 2 != 0)),
        (Kind::Choice(words), Value::Choice(word)) => {
            Value::Choice(go_round(words, word, steps).unwrap_or(word))
        }
        _ => value,
    }
}

fn move_number(scale: NudgeScale, x: f64, steps: i32, coarse: bool) -> f64 {
    match scale {
        NudgeScale::Linear {
            fine,
            coarse: large,
        } => {
            let step = if coarse { large } else { fine };
            let moved = x + f64::from(steps) * step;
            // A step to 0 shall reach 0.
            if moved.abs() < 1e-9 * step {
                0.0
            } else {
                rounded(moved, 12)
            }
        }
        NudgeScale::Log { smallest, .. } if x < smallest && steps <= 0 => x.min(0.0),
        NudgeScale::Log { smallest, .. } if x < smallest => smallest,
        NudgeScale::Log {
            fine,
            coarse: large,
            smallest,
        } => {
            let moved = if coarse {
                rounded(x * math::powi(large, steps), 12)
            } else {
                rounded(x * math::powi(fine, steps), 3)
            };
            // Rounding may make one step down of the smallest value slightly larger.
            if moved < smallest * (1.0 - 1e-9) {
                0.0
            } else {
                moved
            }
        }
    }
}

fn go_round(words: &'static [&'static str], word: &str, steps: i32) -> Option<&'static str> {
    let now = words.iter().position(|&each| each == word)?;
    let count = i64::try_from(words.len()).ok()?;
    let next = (i64::try_from(now).ok()? + i64::from(steps)).rem_euclid(count);
    words.get(usize::try_from(next).ok()?).copied()
}
