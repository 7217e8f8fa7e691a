//! Fig. 4(b): 1 − ε_eff over the height of a lattice without gaps, columns beside it.

use super::pool::RunPool;
use super::runs::{largest, preset, results};
use super::{Claim, FigureError, Sheet};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};

/// Heights of the paper, and some of them.
const HEIGHTS: std::ops::RangeInclusive<u64> = 2..=21;
const FEW: [u64; 6] = [2, 3, 5, 8, 13, 21];
const RESTITUTIONS: [f64; 2] = [0.6, 0.9];

const SPEED: f64 = 0.05;
const CONTACT_TIME: f64 = 0.2e-4;

/// Steps in a contact; the forces jump where contacts begin, so errors go with a step.
const STEPS: f64 = 200.0;

fn values(restitution: f64) -> Vec<(&'static str, Value)> {
    vec![
        ("restitution", Value::Number(restitution)),
        ("v0", Value::Number(-SPEED)),
        ("contact_time", Value::Number(CONTACT_TIME)),
    ]
}

fn scene(height: u64, restitution: f64, steps: f64) -> Result<Scene, FigureError> {
    let mut values = values(restitution);
    values.extend([
        ("rows", Value::Whole(height)),
        ("s0", Value::Number(0.0)),
        ("jitter", Value::Flag(false)),
        ("steps_per_contact", Value::Number(steps)),
    ]);
    preset("fig4", Some(MethodName::Verlet), &values)
}

fn loss(scene: &Scene) -> Result<f64, FigureError> {
    Ok(1.0 - results(scene)?.eps_eff.unwrap_or(f64::NAN))
}

/// What is lost at a height: by the lattice, with steps twice as long, and by the column.
struct HeightRow {
    restitution: f64,
    height: u64,
    lattice: f64,
    coarse: f64,
    column: f64,
}

impl HeightRow {
    fn run(height: u64, restitution: f64) -> Result<Self, FigureError> {
        let mut values = values(restitution);
        values.push(("n", Value::Whole(height)));
        Ok(Self {
            restitution,
            height,
            lattice: loss(&scene(height, restitution, STEPS)?)?,
            coarse: loss(&scene(height, restitution, 0.5 * STEPS)?)?,
            column: loss(&preset("fig1a", Some(MethodName::Exact), &values)?)?,
        })
    }

    /// How much less is lost than by the column.
    fn off(&self) -> f64 {
        (self.lattice - self.column).abs()
    }
}

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let heights = pool.pick(FEW.to_vec(), HEIGHTS.collect());
    let jobs: Vec<(f64, u64)> = RESTITUTIONS
        .iter()
        .flat_map(|&restitution| heights.iter().map(move |&height| (restitution, height)))
        .collect();
    let rows = pool.each(&jobs, |&(restitution, height)| {
        HeightRow::run(height, restitution)
    })?;
    let mut sheet = Sheet::default();
    for restitution in RESTITUTIONS {
        let mine = || rows.iter().filter(|row| row.restitution == restitution);
        let most = |get: fn(&HeightRow) -> f64| largest(mine().map(get));
        let name = |what| format!("eps {restitution}: {what}");
        sheet.claims.extend([
            Claim::most(
                name("most |2D - 1D|"),
                "similar",
                most(HeightRow::off),
                0.02,
            ),
            Claim::most(
                name("the same over 1D's loss"),
                "similar",
                most(|row| row.off() / row.column),
                0.1,
            ),
            Claim::most(
                name("t_c/200 less t_c/100"),
                "-",
                most(|row| (row.lattice - row.coarse).abs()),
                0.002,
            ),
        ]);
        let less = mine().filter(|row| row.lattice < row.column).count();
        sheet.notes.push(format!(
            "At eps = {restitution} the lattice loses less than the column at {less} of {} heights.",
            mine().count()
        ));
    }
    sheet.notes.push(
        "Without separation a lattice moves row by row. A bead touches two below at 60 degrees: \
         a contact of rows has 2 sin^2 60 = 3/2 times stiffness and dashpot of one of beads, and \
         the floor's contact 1 times; that is all that 2D changes."
            .to_owned(),
    );
    let over_height = |restitution: f64, get: fn(&HeightRow) -> f64| -> Vec<(f64, f64)> {
        let mine = rows.iter().filter(|row| row.restitution == restitution);
        mine.map(|row| (row.height as f64, get(row))).collect()
    };
    let mut series = Vec::new();
    // Points are drawn over what comes before them.
    for restitution in RESTITUTIONS {
        let points = over_height(restitution, |row| row.column);
        series.push(Series::new(format!("1D, ε = {restitution}"), points).with(SeriesStyle::Line));
    }
    for restitution in RESTITUTIONS {
        let points = over_height(restitution, |row| row.lattice);
        series
            .push(Series::new(format!("2D, ε = {restitution}"), points).with(SeriesStyle::Points));
    }
    sheet.plots.push(Plot {
        name: "fig4b".to_owned(),
        title: "Fig. 4(b): loss of a lattice without gaps".to_owned(),
        x: Axis::log("h"),
        y: Axis::log("1 - ε_eff"),
        series,
    });
    sheet.data.push(table(&rows)?);
    Ok(sheet)
}

fn table(rows: &[HeightRow]) -> Result<Table, FigureError> {
    let mut data = Table::new(
        "fig4b",
        "Fig. 4(b): loss of a lattice without gaps, and of a column",
        [
            Column::new("restitution", "", ""),
            Column::new("h", "", ""),
            Column::new("loss_lattice", "", ""),
            Column::new("loss_lattice_half_the_steps", "", ""),
            Column::new("loss_column", "", ""),
        ],
    );
    data.facts = facts(&scene(10, 0.9, STEPS)?, "fig4 with the values of each row");
    for row in rows {
        data.push([
            row.restitution.into(),
            row.height.into(),
            row.lattice.into(),
            row.coarse.into(),
            row.column.into(),
        ]);
    }
    Ok(data)
}
