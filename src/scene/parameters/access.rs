//! How the rows of the table read and change the facts.

use super::Value;
use crate::math;
use crate::scene::{
    Arrangement, CollisionRule, Exponents, Facts, Launch, Method, PowerLaw, Shake, angular,
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

/// Changes the launch of a separated start.
pub(super) fn launch(facts: &mut Facts, change: impl FnOnce(&mut Launch)) {
    if let Some(launch) = facts.launch_mut() {
        change(launch);
    }
}

/// Changes how the plate vibrates.
pub(super) fn shake(facts: &mut Facts, change: impl FnOnce(&mut Shake)) {
    if let Some(shake) = facts.shake_mut() {
        change(shake);
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

/// Contact time of a scene that is given one: under a power law it follows.
pub(super) fn contact_time(facts: &Facts) -> Option<f64> {
    facts.contact_time().filter(|_| !facts.depends_on_speed())
}

pub(super) fn set_contact_time(facts: &mut Facts, to: f64) {
    let given = match &mut facts.method {
        Method::Soft(soft) => soft.law.given_contact_time(),
        Method::Hard(CollisionRule::Tc { contact_time }) => Some(contact_time),
        Method::Hard(CollisionRule::Lrv) => None,
    };
    if let Some(contact_time) = given {
        *contact_time = to;
    }
}

/// The power law in force.
pub(super) fn power(facts: &Facts) -> Option<PowerLaw> {
    facts.law()?.power().copied()
}

/// Changes the power law in force.
pub(super) fn set_power(facts: &mut Facts, change: impl FnOnce(&mut PowerLaw)) {
    if let Some(power) = facts.soft_mut().and_then(|soft| soft.law.power_mut()) {
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

pub(super) fn set_tolerance(facts: &mut Facts, to: f64) {
    if let Some(tolerance) = facts.tolerance_mut() {
        *tolerance = to;
    }
}

/// A₀ = α g/(2πf)² for the frequency and gravity in force.
pub(super) fn set_alpha(facts: &mut Facts, alpha: f64) {
    if let (Some(gravity), Some(shake)) = (facts.gravity, facts.shake_mut()) {
        shake.amplitude = alpha * gravity / math::powi(angular(shake.frequency), 2);
    }
}

/// The TC rule starts without a contact time, which is missing then ([`crate::scene::Draft`]).
pub(super) fn set_rule(facts: &mut Facts, word: &str) {
    let timed = CollisionRule::Tc { contact_time: 1.0 };
    if let Method::Hard(rule) = &mut facts.method
        && rule.as_str() != word
    {
        *rule = if word == timed.as_str() {
            timed
        } else {
            CollisionRule::Lrv
        };
    }
}
