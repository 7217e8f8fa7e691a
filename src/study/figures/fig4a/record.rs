//! The tables and the plot of Fig. 4(a).

use super::lattice_run::{LatticeRun, eps};
use super::{PAIRS, Point, mean};
use crate::scene::MethodName;
use crate::study::Results;
use crate::study::accuracy::facts;
use crate::study::figures::runs::{preset, results};
use crate::study::figures::{FigureError, Sheet};
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};

/// Adds both to the sheet.
pub(super) fn record(
    jobs: &[LatticeRun],
    found: &[Results],
    curve: &[Point],
    sheet: &mut Sheet,
) -> Result<(), FigureError> {
    let mut runs = Table::new(
        "fig4a",
        "Fig. 4(a): effective restitution of a lattice over sigma",
        [
            Column::new("v0", "", "m/s"),
            Column::new("contact_time", "", "s"),
            Column::new("s0", "", "m"),
            Column::new("seed", "", ""),
            Column::new("sigma", "", ""),
            Column::new("eps_eff", "", ""),
            Column::new("er_over_ef", "", ""),
            Column::new("energy_drift", "", ""),
        ],
    );
    runs.facts = facts(&jobs[0].scene()?, "fig4 with the values of each row");
    for (job, results) in jobs.iter().zip(found) {
        runs.push([
            (-job.v0).into(),
            job.contact_time.into(),
            job.s0().into(),
            job.seed.into(),
            job.sigma.into(),
            results.eps_eff.into(),
            results.er_over_ef.into(),
            results.energy_drift.into(),
        ]);
    }
    let mut means = Table::new(
        "fig4a-curve",
        "Fig. 4(a): means over pairs and seeds, columns of ten beside them",
        [
            Column::new("sigma", "", ""),
            Column::new("runs", "", ""),
            Column::new("eps_eff", "", ""),
            Column::new("standard_error", "", ""),
            Column::new("column_even", "", ""),
            Column::new("column_shifted", "", ""),
        ],
    );
    means.facts.clone_from(&runs.facts);
    for point in curve {
        let lattice = mean(&point.lattice);
        means.push([
            point.sigma.into(),
            (point.lattice.len() as u64).into(),
            lattice.value.into(),
            lattice.error.into(),
            point.even.into(),
            point.shifted.into(),
        ]);
    }
    sheet.data.extend([runs, means]);
    sheet.plots.push(plot(jobs, found, curve)?);
    Ok(())
}

fn plot(jobs: &[LatticeRun], found: &[Results], curve: &[Point]) -> Result<Plot, FigureError> {
    let hard = eps(&results(&preset("fig1d", Some(MethodName::Ed), &[])?)?);
    let ends = [curve.first(), curve.last()].into_iter().flatten();
    let line = ends.map(|point| (point.sigma, hard)).collect();
    let column = curve.iter().map(|point| (point.sigma, point.even));
    // Points are drawn over what comes before them.
    let mut series = vec![
        Series::new("1D, ED", line).with(SeriesStyle::Line),
        Series::new("1D, h = 10", column.collect()).with(SeriesStyle::Line),
    ];
    for pair in PAIRS {
        let mine = jobs.iter().zip(found);
        let points = mine
            .filter(|(job, _)| (job.v0, job.contact_time) == pair)
            .map(|(job, results)| (job.sigma, eps(results)));
        let name = format!("2D, {} m/s, {:e} s", pair.0, pair.1);
        series.push(Series::new(name, points.collect()).with(SeriesStyle::Points));
    }
    Ok(Plot {
        name: "fig4a".to_owned(),
        title: "Fig. 4(a): 10 rows of 13 beads, ε = 0.9".to_owned(),
        x: Axis::log("σ = s_0/(|v_0| t_c)"),
        y: Axis::linear("ε_eff"),
        series,
    })
}
