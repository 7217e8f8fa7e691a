//! How the rows of the table read and change the facts.

use super::Value;
use super::rows::TC;
use crate::scene::{CollisionRule, Facts, Floor, Method, Solver, Start, angular};

// The table hands over values of the row's own kind only.

pub(super) fn number(value: Value, put: impl FnOnce(f64)) {
    if let Value::Number(x) = value {
        put(x);
    }
}

pub(super) fn whole(value: Value, put: impl FnOnce(u64)) {
    if let Value::Whole(k) = value {
        put(k);
    }
}

pub(super) fn flag(value: Value, put: impl FnOnce(bool)) {
    if let Value::Flag(on) = value {
        put(on);
    }
}

pub(super) fn choice(value: Value, put: impl FnOnce(&'static str)) {
    if let Value::Choice(word) = value {
        put(word);
    }
}

/// s₀, v₀ and jitter of a separated start.
pub(super) fn separated(facts: &Facts) -> Option<(f64, f64, bool)> {
    match facts.start {
        Start::Separated { s0, jitter, v0 } => Some((s0, v0, jitter)),
        Start::Resting => None,
    }
}

/// Whether the attraction of soft contacts acts.
pub(super) fn attraction(facts: &Facts) -> Option<bool> {
    match facts.method {
        Method::Md { attraction, .. } => Some(attraction),
        Method::Ed { .. } => None,
    }
}

/// Steps in a contact time of soft contacts on a grid.
pub(super) fn steps(facts: &Facts) -> Option<f64> {
    match facts.method {
        Method::Md {
            solver: Solver::Grid {
                steps_per_contact, ..
            },
            ..
        } => Some(steps_per_contact),
        _ => None,
    }
}

/// Amplitude and frequency of a vibrating floor.
pub(super) fn plate(facts: &Facts) -> Option<(f64, f64)> {
    match facts.floor {
        Floor::Vibrating {
            amplitude,
            frequency,
        } => Some((amplitude, frequency)),
        Floor::Fixed => None,
    }
}

pub(super) fn set_contact_time(facts: &mut Facts, to: f64) {
    if let Method::Md { contact_time, .. }
    | Method::Ed {
        rule: CollisionRule::Tc { contact_time },
    } = &mut facts.method
    {
        *contact_time = to;
    }
}

pub(super) fn set_amplitude(facts: &mut Facts, to: f64) {
    if let Floor::Vibrating { amplitude, .. } = &mut facts.floor {
        *amplitude = to;
    }
}

pub(super) fn set_frequency(facts: &mut Facts, to: f64) {
    if let Floor::Vibrating { frequency, .. } = &mut facts.floor {
        *frequency = to;
    }
}

/// A₀ = α g/(2πf)² for the frequency and gravity in force.
pub(super) fn set_alpha(facts: &mut Facts, alpha: f64) {
    if let (Some((_, frequency)), Some(gravity)) = (plate(facts), facts.gravity) {
        set_amplitude(facts, alpha * gravity / angular(frequency).powi(2));
    }
}

/// The TC rule starts without a contact time: NaN, "not given yet".
pub(super) fn set_rule(facts: &mut Facts, word: &str) {
    if let Method::Ed { rule } = &mut facts.method {
        *rule = match (word, *rule) {
            (TC, CollisionRule::Lrv) => CollisionRule::Tc {
                contact_time: f64::NAN,
            },
            (TC, timed) => timed,
            _ => CollisionRule::Lrv,
        };
    }
}
