//! The rows of the table.

mod contact;
mod lattice;

use super::access::{
    choice, columns, flag, launch, number, set_alpha, set_rule, set_tolerance, shake, whole,
};
use super::{Kind, NudgeScale, Parameter, Value};
use crate::scene::{CollisionRule, Method};

/// The largest seed that a JSON number holds exactly.
const LARGEST_SEED: u64 = 1 << 53;

const SEPARATED: &str = "scenes with start separated";
const SOFT: &str = "scenes with soft contacts (method gear, verlet or exact)";
const GRID: &str = "scenes on a grid of time steps (method gear or verlet)";
const ADAPTIVE: &str = "scenes with a power law and method exact";
const HARD: &str = "scenes with hard spheres (method ed)";
const HEAVY: &str = "scenes with gravity";
const VIBRATING: &str = "scenes with a vibrating floor";

const DECADES: NudgeScale = NudgeScale::Log {
    fine: 1.1,
    coarse: 2.0,
    smallest: 1e-12,
};
const SEPARATIONS: NudgeScale = NudgeScale::Log {
    fine: 1.1,
    coarse: 2.0,
    smallest: 1e-9,
};
const WIDTHS: NudgeScale = NudgeScale::Log {
    fine: 1.1,
    coarse: 2.0,
    smallest: 1e-6,
};
const AMPLITUDES: NudgeScale = NudgeScale::Log {
    fine: 1.02,
    coarse: 1.25,
    smallest: 1e-6,
};

/// The order in which a layer's settings act.
pub(super) mod order {
    /// Decides whether there is a contact time.
    pub const RULE: u8 = 0;
    /// All that moves the column.
    pub const PLAIN: u8 = 1;
    /// α is turned into an amplitude by the frequency and gravity in force.
    pub const ALPHA: u8 = 2;
    /// A change of law keeps collisions alike at the speed that follows.
    pub const LAW: u8 = 3;
    /// So does a change of exponents.
    pub const EXPONENTS: u8 = 4;
    /// What the law has.
    pub const CONSTANTS: u8 = 5;
}

/// What most rows share.
const ROW: Parameter = Parameter {
    name: "",
    symbol: "",
    symbol_ascii: "",
    aliases: &[],
    unit: "",
    help: "",
    kind: Kind::Flag,
    note: "",
    belongs_to: "all scenes",
    live: true,
    optional: false,
    needed: false,
    order: order::PLAIN,
    get: |_| None,
    set: |_, _| {},
};

pub(super) static ROWS: &[Parameter] = &[
    lattice::COUNT,
    lattice::ROWS,
    lattice::COLUMNS,
    contact::RESTITUTION,
    contact::CONTACT_TIME,
    contact::LAW,
    contact::BETA,
    contact::GAMMA,
    contact::STIFFNESS,
    contact::DAMPING,
    Parameter {
        name: "amplitude",
        symbol: "A_0",
        symbol_ascii: "A_0",
        aliases: &["A", "A0", "A₀"],
        unit: "m",
        help: "amplitude of the plate",
        kind: Kind::Number {
            min: 0.0,
            max: 1e6,
            scale: AMPLITUDES,
        },
        belongs_to: VIBRATING,
        needed: true,
        get: |facts| facts.shake().map(|shake| Value::Number(shake.amplitude)),
        set: |facts, value| number(value, |x| shake(facts, |shake| shake.amplitude = x)),
        ..ROW
    },
    Parameter {
        name: "alpha",
        symbol: "α",
        symbol_ascii: "alpha",
        help: "largest acceleration of the plate over gravity",
        kind: Kind::Number {
            min: 0.0,
            max: 1e6,
            scale: NudgeScale::Linear {
                fine: 0.1,
                coarse: 1.0,
            },
        },
        belongs_to: VIBRATING,
        order: order::ALPHA,
        get: |facts| facts.alpha().map(Value::Number),
        set: |facts, value| number(value, |x| set_alpha(facts, x)),
        ..ROW
    },
    Parameter {
        name: "frequency",
        symbol: "f",
        symbol_ascii: "f",
        unit: "Hz",
        help: "frequency of the plate",
        kind: Kind::Number {
            min: 1e-3,
            max: 1e6,
            scale: NudgeScale::Linear {
                fine: 0.5,
                coarse: 5.0,
            },
        },
        belongs_to: VIBRATING,
        needed: true,
        get: |facts| facts.shake().map(|shake| Value::Number(shake.frequency)),
        set: |facts, value| number(value, |x| shake(facts, |shake| shake.frequency = x)),
        ..ROW
    },
    Parameter {
        name: "gravity",
        symbol: "g",
        symbol_ascii: "g",
        unit: "m/s²",
        help: "gravitational acceleration",
        kind: Kind::Number {
            min: 1e-6,
            max: 1e6,
            scale: NudgeScale::Linear {
                fine: 0.1,
                coarse: 1.0,
            },
        },
        belongs_to: HEAVY,
        get: |facts| facts.gravity.map(Value::Number),
        set: |facts, value| number(value, |x| facts.gravity = Some(x)),
        ..ROW
    },
    Parameter {
        name: "s0",
        symbol: "s_0",
        symbol_ascii: "s_0",
        aliases: &["s₀"],
        unit: "m",
        help: "separation of the beads at the start",
        kind: Kind::Number {
            min: 0.0,
            max: 1e3,
            scale: SEPARATIONS,
        },
        belongs_to: SEPARATED,
        live: false,
        needed: true,
        get: |facts| facts.launch().map(|launch| Value::Number(launch.s0)),
        set: |facts, value| number(value, |x| launch(facts, |launch| launch.s0 = x)),
        ..ROW
    },
    Parameter {
        name: "v0",
        symbol: "v_0",
        symbol_ascii: "v_0",
        aliases: &["v₀"],
        unit: "m/s",
        help: "velocity at the start, negative towards the floor",
        kind: Kind::Number {
            min: -1e6,
            max: 1e6,
            scale: NudgeScale::Linear {
                fine: 0.01,
                coarse: 0.1,
            },
        },
        note: " (without gravity: below 0)",
        belongs_to: SEPARATED,
        live: false,
        needed: true,
        get: |facts| facts.launch().map(|launch| Value::Number(launch.v0)),
        set: |facts, value| number(value, |x| launch(facts, |launch| launch.v0 = x)),
        ..ROW
    },
    Parameter {
        name: "jitter",
        symbol: "jitter",
        symbol_ascii: "jitter",
        help: "shift each bead at the start by up to s0/2, at random",
        kind: Kind::Flag,
        belongs_to: SEPARATED,
        live: false,
        get: |facts| facts.launch().map(|launch| Value::Flag(launch.jitter)),
        set: |facts, value| flag(value, |on| launch(facts, |launch| launch.jitter = on)),
        ..ROW
    },
    Parameter {
        name: "diameter",
        symbol: "d",
        symbol_ascii: "d",
        unit: "m",
        help: "mean diameter of the beads",
        kind: Kind::Number {
            min: 1e-9,
            max: 1.0,
            scale: DECADES,
        },
        live: false,
        needed: true,
        get: |facts| Some(Value::Number(facts.diameter)),
        set: |facts, value| number(value, |x| facts.diameter = x),
        ..ROW
    },
    Parameter {
        name: "width",
        symbol: "w",
        symbol_ascii: "w",
        unit: "m",
        help: "width of the spread of diameters, 0 for equal beads",
        kind: Kind::Number {
            min: 0.0,
            max: 1.97,
            scale: WIDTHS,
        },
        note: " (at most 1.97 diameters)",
        belongs_to: "columns",
        live: false,
        get: |facts| {
            columns(facts)
                .is_none()
                .then_some(Value::Number(facts.width))
        },
        set: |facts, value| number(value, |x| facts.width = x),
        ..ROW
    },
    Parameter {
        name: "seed",
        symbol: "seed",
        symbol_ascii: "seed",
        help: "seed of the diameters and of the jitter",
        kind: Kind::Whole {
            min: 0,
            max: LARGEST_SEED,
            fine: 1,
            coarse: 10,
        },
        live: false,
        get: |facts| Some(Value::Whole(facts.seed)),
        set: |facts, value| whole(value, |k| facts.seed = k),
        ..ROW
    },
    lattice::TANGENTIAL_DAMPING,
    contact::FLOOR_CONTACT,
    contact::ATTRACTION,
    Parameter {
        name: "steps_per_contact",
        symbol: "t_c/Δt",
        symbol_ascii: "t_c/dt",
        aliases: &["steps"],
        help: "time steps in one contact time",
        kind: Kind::Number {
            min: 2.0,
            max: 1e6,
            scale: NudgeScale::Log {
                fine: 1.1,
                coarse: 2.0,
                smallest: 2.0,
            },
        },
        belongs_to: GRID,
        get: |facts| {
            facts
                .grid()
                .map(|grid| Value::Number(grid.steps_per_contact))
        },
        set: |facts, value| {
            number(value, |x| {
                if let Some(grid) = facts.grid_mut() {
                    grid.steps_per_contact = x;
                }
            });
        },
        ..ROW
    },
    Parameter {
        name: "tolerance",
        symbol: "tol",
        symbol_ascii: "tol",
        help: "local error of a step, relative to each contact's motion",
        kind: Kind::Number {
            min: 1e-14,
            max: 1e-3,
            scale: NudgeScale::Log {
                fine: 2.0,
                coarse: 10.0,
                smallest: 1e-14,
            },
        },
        belongs_to: ADAPTIVE,
        order: order::CONSTANTS,
        get: |facts| facts.tolerance().map(Value::Number),
        set: |facts, value| number(value, |x| set_tolerance(facts, x)),
        ..ROW
    },
    Parameter {
        name: "rule",
        symbol: "rule",
        symbol_ascii: "rule",
        help: "collisions that dissipate: all, or not within contact_time",
        kind: Kind::Choice(CollisionRule::WORDS),
        belongs_to: HARD,
        order: order::RULE,
        get: |facts| match facts.method {
            Method::Hard(rule) => Some(Value::Choice(rule.as_str())),
            Method::Soft(_) => None,
        },
        set: |facts, value| choice(value, |word| set_rule(facts, word)),
        ..ROW
    },
    Parameter {
        name: "duration",
        symbol: "T",
        symbol_ascii: "T",
        unit: "s",
        help: "how long a run lasts; without gravity, at most",
        kind: Kind::Number {
            min: 1e-12,
            max: 1e9,
            scale: DECADES,
        },
        optional: true,
        get: |facts| facts.duration.map(Value::Number),
        set: |facts, value| number(value, |x| facts.duration = Some(x)),
        ..ROW
    },
];
