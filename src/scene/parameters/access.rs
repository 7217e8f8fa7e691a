//! How the rows of the table read and change the facts.

use super::Value;
use super::rows::TC;
use crate::math;
use crate::scene::{
    Arrangement, CollisionRule, Exponents, Facts, Floor, GridSettings, Launch, Law, Method,
    PowerLaw, Shake, Soft, Solver, Start, angular,
};

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
        Start::Launched(Launch { s0, jitter, v0 }) => Some((s0, v0, jitter)),
        Start::Resting => None,
    }
}

/// Beads in a row of a lattice.
pub(super) fn columns(facts: &Facts) -> Option<usize> {
    match facts.arrangement {
        Arrangement::Lattice { columns, .. } => Some(columns),
        Arrangement::Column => None,
    }
}

/// D_t of a lattice.
pub(super) fn tangential(facts: &Facts) -> Option<f64> {
    match facts.arrangement {
        Arrangement::Lattice { tangential, .. } => Some(tangential),
        Arrangement::Column => None,
    }
}

/// Whether the attraction of soft contacts acts.
pub(super) fn attraction(facts: &Facts) -> Option<bool> {
    match facts.method {
        Method::Soft(Soft { attraction, .. }) => Some(attraction),
        Method::Hard(_) => None,
    }
}

/// Steps in a contact time of soft contacts on a grid.
pub(super) fn steps(facts: &Facts) -> Option<f64> {
    match facts.method {
        Method::Soft(Soft {
            solver: Solver::Grid(GridSettings {
                steps_per_contact, ..
            }),
            ..
        }) => Some(steps_per_contact),
        _ => None,
    }
}

/// Amplitude and frequency of a vibrating floor.
pub(super) fn plate(facts: &Facts) -> Option<(f64, f64)> {
    match facts.floor {
        Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }) => Some((amplitude, frequency)),
        Floor::Fixed => None,
    }
}

/// Contact time of a scene that is given one: under a power law it follows.
pub(super) fn contact_time(facts: &Facts) -> Option<f64> {
    power(facts)
        .is_none()
        .then(|| facts.contact_time())
        .flatten()
}

pub(super) fn set_contact_time(facts: &mut Facts, to: f64) {
    if let Method::Soft(Soft {
        law: Law::Hooke { contact_time },
        ..
    })
    | Method::Hard(CollisionRule::Tc { contact_time }) = &mut facts.method
    {
        *contact_time = to;
    }
}

/// The power law in force.
pub(super) fn power(facts: &Facts) -> Option<PowerLaw> {
    match facts.method {
        Method::Soft(Soft {
            law: Law::Power(power),
            ..
        }) => Some(power),
        _ => None,
    }
}

/// Changes the power law in force.
pub(super) fn set_power(facts: &mut Facts, change: impl FnOnce(&mut PowerLaw)) {
    if let Method::Soft(Soft {
        law: Law::Power(power),
        ..
    }) = &mut facts.method
    {
        change(power);
    }
}

/// β and γ where they are free.
pub(super) fn exponents(facts: &Facts) -> Option<(f64, f64)> {
    match power(facts)?.exponents {
        Exponents::Free { beta, gamma } => Some((beta, gamma)),
        _ => None,
    }
}

/// Other exponents; stiffness and damping follow, so that collisions stay alike.
pub(super) fn set_exponents(facts: &mut Facts, beta: Option<f64>, gamma: Option<f64>) {
    let speed = facts.own_speed();
    if let Some(now) = exponents(facts) {
        set_power(facts, |power| {
            let exponents = Exponents::Free {
                beta: beta.unwrap_or(now.0),
                gamma: gamma.unwrap_or(now.1),
            };
            *power = power.like(exponents, speed);
        });
    }
}

/// Tolerance of the adaptive method.
pub(super) fn tolerance(facts: &Facts) -> Option<f64> {
    match facts.method {
        Method::Soft(Soft {
            solver: Solver::Adaptive { tolerance },
            ..
        }) => Some(tolerance),
        _ => None,
    }
}

pub(super) fn set_amplitude(facts: &mut Facts, to: f64) {
    if let Floor::Vibrating(Shake { amplitude, .. }) = &mut facts.floor {
        *amplitude = to;
    }
}

pub(super) fn set_frequency(facts: &mut Facts, to: f64) {
    if let Floor::Vibrating(Shake { frequency, .. }) = &mut facts.floor {
        *frequency = to;
    }
}

/// A₀ = α g/(2πf)² for the frequency and gravity in force.
pub(super) fn set_alpha(facts: &mut Facts, alpha: f64) {
    if let (Some((_, frequency)), Some(gravity)) = (plate(facts), facts.gravity) {
        set_amplitude(facts, alpha * gravity / math::powi(angular(frequency), 2));
    }
}

/// The TC rule starts without a contact time: NaN, "not given yet".
pub(super) fn set_rule(facts: &mut Facts, word: &str) {
    if let Method::Hard(rule) = &mut facts.method {
        *rule = match (word, *rule) {
            (TC, CollisionRule::Lrv) => CollisionRule::Tc {
                contact_time: f64::NAN,
            },
            (TC, timed) => timed,
            _ => CollisionRule::Lrv,
        };
    }
}
