//! Rows about the force of a contact.

use super::{DECADES, ROW, SOFT, order};
use crate::scene::parameters::access::{
    choice, contact_time, exponents, flag, number, power, set_contact_time, set_exponents,
    set_power,
};
use crate::scene::parameters::{Kind, NudgeScale, Parameter, Value};
use crate::scene::{FloorContact, LawName};

const SAME_SPRING: &str = "same-spring";
const SAME_RESTITUTION: &str = "same-restitution";
const TIMED: &str = "scenes with soft contacts and law hooke, or the rule tc";
const GIVEN: &str = "scenes with law hooke or hard spheres (method ed)";
const POWER: &str = "scenes with a power law (law hertz, hertz-kuwabara-kono, taguchi or power)";
const FREE: &str = "scenes with law power";
pub(super) const CONSTANTS: NudgeScale = NudgeScale::Log {
    fine: 1.1,
    coarse: 2.0,
    smallest: 1e-12,
};
const EXPONENT: Kind = Kind::Number {
    min: 0.0,
    max: 5.0,
    scale: NudgeScale::Linear {
        fine: 0.05,
        coarse: 0.25,
    },
};

pub(super) const RESTITUTION: Parameter = Parameter {
    name: "restitution",
    symbol: "ε",
    symbol_ascii: "e",
    aliases: &["eps", "epsilon", "ϵ"],
    help: "restitution of two beads: speed after over before",
    kind: Kind::Number {
        min: 0.0,
        max: 1.0,
        scale: NudgeScale::Linear {
            fine: 0.01,
            coarse: 0.1,
        },
    },
    note: " (soft contacts: above 0)",
    belongs_to: GIVEN,
    needed: true,
    order: order::CONSTANTS,
    get: |facts| (!facts.depends_on_speed()).then_some(Value::Number(facts.restitution)),
    set: |facts, value| number(value, |x| facts.restitution = x),
    ..ROW
};

pub(super) const CONTACT_TIME: Parameter = Parameter {
    name: "contact_time",
    symbol: "t_c",
    symbol_ascii: "t_c",
    aliases: &["tc", "T_c"],
    unit: "s",
    help: "time that a collision of two beads takes",
    kind: Kind::Number {
        min: 1e-12,
        max: 1e3,
        scale: DECADES,
    },
    belongs_to: TIMED,
    needed: true,
    order: order::CONSTANTS,
    get: |facts| contact_time(facts).map(Value::Number),
    set: |facts, value| number(value, |x| set_contact_time(facts, x)),
    ..ROW
};

pub(super) const LAW: Parameter = Parameter {
    name: "law",
    symbol: "law",
    symbol_ascii: "law",
    help: "force of a contact; a new law keeps collisions alike",
    kind: Kind::Choice(LawName::WORDS),
    belongs_to: SOFT,
    order: order::LAW,
    get: |facts| facts.law().map(|law| Value::Choice(law.name().as_str())),
    set: |facts, value| {
        choice(value, |word| {
            if let Some(name) = LawName::find(word) {
                facts.obey(name);
            }
        });
    },
    ..ROW
};

pub(super) const BETA: Parameter = Parameter {
    name: "beta",
    symbol: "β",
    symbol_ascii: "beta",
    help: "elastic force x^(1+beta); collisions stay alike",
    kind: EXPONENT,
    belongs_to: FREE,
    order: order::EXPONENTS,
    get: |facts| exponents(facts).map(|(beta, _)| Value::Number(beta)),
    set: |facts, value| number(value, |x| set_exponents(facts, Some(x), None)),
    ..ROW
};

pub(super) const GAMMA: Parameter = Parameter {
    name: "gamma",
    symbol: "γ",
    symbol_ascii: "gamma",
    help: "dissipative force x^gamma dx/dt; collisions stay alike",
    kind: EXPONENT,
    belongs_to: FREE,
    order: order::EXPONENTS,
    get: |facts| exponents(facts).map(|(_, gamma)| Value::Number(gamma)),
    set: |facts, value| number(value, |x| set_exponents(facts, None, Some(x))),
    ..ROW
};

pub(super) const STIFFNESS: Parameter = Parameter {
    name: "stiffness",
    symbol: "K/m",
    symbol_ascii: "K/m",
    unit: "SI",
    help: "elastic constant over reduced mass, in s^-2 m^-beta",
    kind: Kind::Number {
        min: 1e-12,
        max: 1e150,
        scale: CONSTANTS,
    },
    belongs_to: POWER,
    needed: true,
    order: order::CONSTANTS,
    get: |facts| power(facts).map(|power| Value::Number(power.stiffness)),
    set: |facts, value| number(value, |x| set_power(facts, |power| power.stiffness = x)),
    ..ROW
};

pub(super) const DAMPING: Parameter = Parameter {
    name: "damping",
    symbol: "D_n",
    symbol_ascii: "D_n",
    unit: "SI",
    help: "dissipation constant D_n, in s^-1 m^-gamma",
    kind: Kind::Number {
        min: 0.0,
        max: 1e150,
        scale: CONSTANTS,
    },
    belongs_to: POWER,
    needed: true,
    order: order::CONSTANTS,
    get: |facts| power(facts).map(|power| Value::Number(power.damping)),
    set: |facts, value| number(value, |x| set_power(facts, |power| power.damping = x)),
    ..ROW
};

pub(super) const FLOOR_CONTACT: Parameter = Parameter {
    name: "floor_contact",
    symbol: "floor",
    symbol_ascii: "floor",
    help: "what floor and beads share: the spring, or restitution",
    kind: Kind::Choice(&[SAME_SPRING, SAME_RESTITUTION]),
    get: |facts| {
        Some(Value::Choice(match facts.floor_contact {
            FloorContact::SameSpring => SAME_SPRING,
            FloorContact::SameRestitution => SAME_RESTITUTION,
        }))
    },
    set: |facts, value| {
        choice(value, |word| {
            facts.floor_contact = if word == SAME_SPRING {
                FloorContact::SameSpring
            } else {
                FloorContact::SameRestitution
            }
        });
    },
    ..ROW
};

pub(super) const ATTRACTION: Parameter = Parameter {
    name: "attraction",
    symbol: "attraction",
    symbol_ascii: "attraction",
    help: "let the attractive end of a contact act, as in the paper",
    kind: Kind::Flag,
    belongs_to: SOFT,
    get: |facts| facts.soft().map(|soft| Value::Flag(soft.attraction)),
    set: |facts, value| {
        flag(value, |on| {
            if let Some(soft) = facts.soft_mut() {
                soft.attraction = on;
            }
        });
    },
    ..ROW
};
