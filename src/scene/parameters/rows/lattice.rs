//! Rows about how many beads there are, and about lattices.

use super::{ROW, contact};
use crate::scene::Arrangement;
use crate::scene::parameters::access::{columns, number, tangential, whole};
use crate::scene::parameters::{Kind, Parameter, Value};

const COLUMN: &str = "columns (lattices have rows instead)";
const LATTICE: &str = "lattices (arrangement lattice)";

pub(super) const COUNT: Parameter = Parameter {
    name: "n",
    symbol: "N",
    symbol_ascii: "N",
    help: "number of beads in a column",
    kind: Kind::Whole {
        min: 1,
        max: 1_000_000,
        fine: 1,
        coarse: 10,
    },
    belongs_to: COLUMN,
    live: false,
    needed: true,
    get: |facts| {
        columns(facts)
            .is_none()
            .then_some(Value::Whole(facts.n as u64))
    },
    set: |facts, value| {
        whole(value, |n| {
            facts.n = usize::try_from(n).unwrap_or(usize::MAX);
        });
    },
    ..ROW
};

pub(super) const ROWS: Parameter = Parameter {
    name: "rows",
    symbol: "h",
    symbol_ascii: "h",
    help: "rows of the lattice, its height",
    kind: Kind::Whole {
        min: 1,
        max: 100_000,
        fine: 1,
        coarse: 10,
    },
    belongs_to: LATTICE,
    live: false,
    needed: true,
    get: |facts| columns(facts).map(|columns| Value::Whole((facts.n / columns) as u64)),
    set: |facts, value| {
        whole(value, |rows| {
            if let (Some(columns), Ok(rows)) = (columns(facts), usize::try_from(rows)) {
                facts.n = rows * columns;
            }
        });
    },
    ..ROW
};

pub(super) const COLUMNS: Parameter = Parameter {
    name: "columns",
    symbol: "L/a",
    symbol_ascii: "L/a",
    help: "beads in a row of the lattice, which is periodic",
    kind: Kind::Whole {
        min: 3,
        max: 1000,
        fine: 1,
        coarse: 10,
    },
    belongs_to: LATTICE,
    live: false,
    get: |facts| columns(facts).map(|columns| Value::Whole(columns as u64)),
    set: |facts, value| {
        whole(value, |to| {
            if let (Arrangement::Lattice { columns, .. }, Ok(to)) =
                (&mut facts.arrangement, usize::try_from(to))
            {
                facts.n = facts.n / *columns * to;
                *columns = to;
            }
        });
    },
    ..ROW
};

pub(super) const TANGENTIAL_DAMPING: Parameter = Parameter {
    name: "tangential_damping",
    symbol: "D_t",
    symbol_ascii: "D_t",
    unit: "1/s",
    help: "dissipation constant across contacts, Eq. (4)",
    kind: Kind::Number {
        min: 0.0,
        max: 1e12,
        scale: contact::CONSTANTS,
    },
    belongs_to: LATTICE,
    get: |facts| tangential(facts).map(Value::Number),
    set: |facts, value| {
        number(value, |x| {
            if let Arrangement::Lattice { tangential, .. } = &mut facts.arrangement {
                *tangential = x;
            }
        });
    },
    ..ROW
};
