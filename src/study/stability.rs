//! Where each method breaks: stiff and extreme cases, each method on each of them
//! within a budget, and the largest stable step beside its theory.

mod cases;
mod judge;
mod reference;
mod runs;
mod steps;
mod verdict;

pub use cases::{Case, cases};
pub use judge::judge;
pub use steps::{Limit, limits};
pub use verdict::{CaseVerdict, Judgement};

use super::SLICE;
use super::Tell;
use super::table::{Cell, Column, Digits, Table};
use crate::scene::MethodName;

/// A relative error that is small enough for what people use the number for.
pub const RIGHT: f64 = 1e-2;

/// Runs every method on every case, each run within so many slices of work.
pub fn grid(quick: bool, slices: u64, tell: &mut Tell) -> Table {
    let all = cases(quick);
    let mut judged: Vec<(Case, Vec<Judgement>)> = Vec::new();
    let count = all.len();
    for (k, case) in all.into_iter().enumerate() {
        let judgements = judge(&case, slices, &mut |what| {
            // Some cases take a thousand times as long as others.
            tell(
                &format!("case {} of {count}, {}: {what}", k + 1, case.name),
                None,
            );
        });
        judged.push((case, judgements));
    }
    table(&judged, slices)
}

fn table(judged: &[(Case, Vec<Judgement>)], slices: u64) -> Table {
    let mut columns = vec![Column::new("case", "case", "")];
    for method in MethodName::ALL {
        columns.push(Column::new(method.as_str(), method.as_str(), ""));
    }
    columns.push(Column::new("settings", "", ""));
    columns.push(Column::new("compared", "", ""));
    columns.extend(MethodName::ALL.map(|method| Column::new(detail(method), "", "")));
    let mut table = Table::new("stability", "Where each method breaks", columns);
    for (case, judgements) in judged {
        let mut row: Vec<Cell> = vec![case.name.into()];
        row.extend(judgements.iter().map(|j| Cell::from(j.verdict.short())));
        row.push(case.settings().into());
        row.push(case.compared().into());
        row.extend(judgements.iter().map(|j| Cell::from(j.verdict.long())));
        table.push(row);
    }
    table.notes = vec![
        format!(
            "right, off: relative error, at most {RIGHT} or above; slow: seconds that the run \
             would take on an ordinary machine, with {} allowed, in counted work: the same on \
             every machine; breaks: the simulated second in which it does; refused: the scene \
             is not allowed. Gear and Verlet at t_c/100.",
            slices as f64 * SLICE
        ),
        "exact: its distance from the adaptive method of the power laws, to which the linear \
         law is one with beta = gamma = 0, at a tolerance of 1e-13; both errors are in it. ran: \
         that was too slow, or itself not sure; the number is what the last bit of the start \
         changes. Where that is more than is right, ten times that is right."
            .to_owned(),
        "model: hard spheres (ed) solve another problem; their distance from soft beads is not \
         an error of numbers."
            .to_owned(),
        "Floor collisions compare eps_eff; under gravity, where motion is chaotic, it is the \
         height of the centre of mass over two periods, relative to its range."
            .to_owned(),
    ];
    table
}

/// Name of the column that holds a method's verdict in full.
fn detail(method: MethodName) -> &'static str {
    match method {
        MethodName::Gear => "gear_detail",
        MethodName::Verlet => "verlet_detail",
        MethodName::Exact => "exact_detail",
        MethodName::Ed => "ed_detail",
    }
}

/// Least steps in a contact time that are stable, found and foretold.
pub fn steps_table(quick: bool, tell: &mut Tell) -> Table {
    let three = Digits::Significant(4);
    let columns = [
        Column::new("n", "N", ""),
        Column::new("restitution", "eps", ""),
        Column::new("gear_found", "gear found", "steps").with(three),
        Column::new("gear_theory", "theory", "steps").with(three),
        Column::new("verlet_found", "verlet found", "steps").with(three),
        Column::new("verlet_theory", "theory", "steps").with(three),
    ];
    let title = "Least steps in a contact time that are stable on a closed column";
    let mut table = Table::new("steps", title, columns);
    for limit in limits(quick, tell) {
        table.push([
            (limit.n as u64).into(),
            limit.restitution.into(),
            limit.gear.0.into(),
            limit.gear.1.into(),
            limit.verlet.0.into(),
            limit.verlet.1.into(),
        ]);
    }
    table.notes = vec![
        "Found by bisection: a column rests under gravity, slightly disturbed; stable is what \
         does not grow tenfold. A dash: stable at 2 steps, the coarsest grid there is. Theory: \
         where the stiffest mode's amplification matrix leaves the unit circle."
            .to_owned(),
        "Without damping (eps = 1) Gear grows so slowly just below the limit that the runs, of \
         some ten thousand steps, do not see it: less than a part in ten thousand a step."
            .to_owned(),
    ];
    table
}
