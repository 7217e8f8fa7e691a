//! Figs. 2(b) and (c) and the sentences of Sec. IV A: columns without gaps.

use super::limits;
use super::pool::RunPool;
use super::runs::{largest, results, smallest};
use super::touching::{CONTACT_TIME, eps, run, scene};
use super::{Claim, FigureError, Sheet};
use crate::math;
use crate::scene::MethodName;
use crate::study::Results;
use crate::study::accuracy::facts;
use crate::study::fit::slope;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};

const LENGTHS: [u64; 7] = [1, 2, 5, 10, 20, 50, 100];
const RESTITUTIONS: [f64; 5] = [0.6, 0.8, 0.9, 0.95, 0.975];

/// The text's v₀, m/s; the caption has 0.05 m/s.
const SPEED: f64 = 0.2;
const CAPTION_SPEED: f64 = 0.05;

fn share(results: &Results) -> f64 {
    results.er_over_ef.unwrap_or(f64::NAN)
}

/// All lengths at all restitutions, and the table of them.
struct LengthScan {
    jobs: Vec<(f64, u64)>,
    found: Vec<Results>,
}

impl LengthScan {
    fn run(pool: &mut RunPool) -> Result<Self, FigureError> {
        let jobs: Vec<(f64, u64)> = RESTITUTIONS
            .iter()
            .flat_map(|&restitution| LENGTHS.map(|n| (restitution, n)))
            .collect();
        let found = pool.each(&jobs, |&(restitution, n)| run(n, restitution, SPEED))?;
        Ok(Self { jobs, found })
    }

    /// A quantity over N at one restitution.
    fn over_n(&self, restitution: f64, get: impl Fn(&Results) -> f64) -> Vec<(f64, f64)> {
        let all = self.jobs.iter().zip(&self.found);
        all.filter(|((e, _), _)| *e == restitution)
            .map(|((_, n), results)| (*n as f64, get(results)))
            .collect()
    }

    fn table(&self, name: &str) -> Result<Table, FigureError> {
        let mut data = Table::new(
            name,
            "Columns without gaps that meet a floor",
            [
                Column::new("restitution", "", ""),
                Column::new("n", "", ""),
                Column::new("eps_eff", "", ""),
                Column::new("er_over_ef", "", ""),
                Column::new("contact_duration", "", "s"),
            ],
        );
        data.facts = facts(&scene(10, 0.9, SPEED)?, "fig1a with the values of each row");
        for (&(restitution, n), results) in self.jobs.iter().zip(&self.found) {
            data.push([
                restitution.into(),
                n.into(),
                results.eps_eff.into(),
                results.er_over_ef.into(),
                results.contact_duration.into(),
            ]);
        }
        Ok(data)
    }
}

pub(super) fn fig2b(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let grid = LengthScan::run(pool)?;
    let captioned = run(10, 0.9, CAPTION_SPEED)?;
    let mut sheet = Sheet::default();
    let loss = |restitution: f64| grid.over_n(restitution, |r| 1.0 - eps(r));
    let fitted = |restitution: f64, from: f64| {
        let long = loss(restitution).into_iter().filter(|(n, _)| *n >= from);
        let logs: Vec<_> = long
            .map(|(n, loss)| (math::ln(n), math::ln(loss)))
            .collect();
        slope(&logs).unwrap_or(f64::NAN)
    };
    let guide = "the paper draws the slope as a guide for the eye; the points come near it \
                 towards N = 100 and are shallower before";
    for (restitution, paper) in [(0.6, -0.5), (0.975, -0.315)] {
        sheet.claims.extend([
            Claim::off(
                format!("slope, eps {restitution}, N 50 to 100"),
                paper,
                fitted(restitution, 50.0),
                0.03,
            ),
            Claim::off(
                format!("slope, eps {restitution}, N >= 10"),
                paper,
                fitted(restitution, 10.0),
                0.03,
            )
            .because(guide),
        ]);
    }
    let falls = RESTITUTIONS
        .iter()
        .filter(|&&e| loss(e).windows(2).all(|p| p[1].1 < p[0].1));
    sheet.claims.push(Claim::least(
        "series that fall at every N",
        "all 5",
        falls.count() as f64,
        5.0,
    ));
    let same = grid.over_n(0.9, eps)[3].1 - eps(&captioned);
    sheet.claims.push(Claim::most(
        "eps_eff at 0.2 less at 0.05 m/s",
        "-",
        same.abs(),
        1e-9,
    ));
    let slopes: Vec<String> = RESTITUTIONS
        .iter()
        .map(|&e| format!("{:.3} at eps = {e}", fitted(e, 10.0)))
        .collect();
    sheet.notes.push(format!(
        "Slopes over N >= 10: {}. Text and caption of the figure give two speeds; linear \
         contacts do not feel them.",
        slopes.join(", ")
    ));
    let mut series: Vec<Series> = RESTITUTIONS
        .iter()
        .map(|&e| Series::new(format!("ε = {e}"), loss(e)))
        .collect();
    for (name, paper, at) in [("slope -0.5", -0.5, 0.6), ("slope -0.315", -0.315, 0.975)] {
        let line = loss(at);
        let (n, y) = line[line.len() - 1];
        let points = vec![(10.0, y * math::powf(10.0 / n, paper)), (n, y)];
        series.push(Series::new(name, points).with(SeriesStyle::Line));
    }
    sheet.plots.push(Plot {
        name: "fig2b".to_owned(),
        title: "Fig. 2(b): loss of a column without gaps".to_owned(),
        x: Axis::log("N"),
        y: Axis::log("1 - ε_eff"),
        series,
    });
    sheet.data.push(grid.table("fig2b")?);
    limits::losses(pool, SPEED, &mut sheet)?;
    Ok(sheet)
}

pub(super) fn fig2c(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let grid = LengthScan::run(pool)?;
    let mut sheet = Sheet::default();
    sheet.claims.push(Claim::near(
        "E_r/E_f, N = 10, eps = 0.9",
        0.035,
        grid.over_n(0.9, share)[3].1,
        0.05,
    ));
    sheet.plots.push(Plot {
        name: "fig2c".to_owned(),
        title: "Fig. 2(c): relative motion after the collision".to_owned(),
        x: Axis::log("N"),
        y: Axis::linear("E_r/E_f"),
        series: RESTITUTIONS
            .iter()
            .map(|&e| Series::new(format!("ε = {e}"), grid.over_n(e, share)))
            .collect(),
    });
    sheet.data.push(grid.table("fig2c")?);
    Ok(sheet)
}

/// The sentences of Sec. IV A.
pub(super) fn sentences(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let grid = LengthScan::run(pool)?;
    let mut sheet = Sheet::default();
    let touching = grid.over_n(0.9, |r| {
        r.contact_duration.unwrap_or(f64::NAN) / CONTACT_TIME
    });
    for (n, t_k) in touching
        .iter()
        .filter(|(n, _)| [10.0, 50.0, 100.0].contains(n))
    {
        sheet.claims.push(Claim::near(
            format!("t_k/(N t_c), N = {n}, eps = 0.9"),
            1.0,
            t_k / n,
            0.1,
        ));
    }
    limits::times(pool, SPEED, CONTACT_TIME, &mut sheet)?;
    let speeds = [0.01, 0.1, 1.0, 10.0];
    let runs = pool.each(&speeds, |&speed| run(10, 0.9, speed))?;
    let energies: Vec<_> = speeds
        .iter()
        .zip(&runs)
        // E_r = (E_r/E_f) ε_eff² E_0, and E_0 goes with v₀².
        .map(|(v, r)| (math::ln(*v), math::ln(share(r) * math::powi(eps(r) * v, 2))))
        .collect();
    let power = slope(&energies).unwrap_or(f64::NAN);
    sheet
        .claims
        .push(Claim::off("power of v0 in E_r", 2.0, power, 1e-6));
    weak_damping(pool, &mut sheet)?;
    let strong = run(10, 0.6, SPEED)?;
    sheet.claims.push(Claim::least(
        "MD, N 10, eps 0.6: E_r/E_f",
        "detachment",
        share(&strong),
        0.01,
    ));
    let hard = results(&scene(10, 0.6, SPEED)?.with_method(MethodName::Ed)?)?;
    sheet.claims.push(Claim::most(
        "ED, N 10, eps 0.6: eps_eff",
        "about 0",
        eps(&hard),
        0.01,
    ));
    sheet
        .notes
        .push(format!("MD has eps_eff = {:.4} there.", eps(&strong)));
    sheet.data.push(grid.table("sec4a")?);
    Ok(sheet)
}

/// "In the limit of low dissipation, ε > 0.9, we find that ε_eff ∝ ε."
fn weak_damping(pool: &mut RunPool, sheet: &mut Sheet) -> Result<(), FigureError> {
    let restitutions: Vec<f64> = (0..=10).map(|k| 0.9 + 0.00999 * f64::from(k)).collect();
    let runs = pool.each(&restitutions, |&restitution| run(10, restitution, SPEED))?;
    let points: Vec<_> = restitutions
        .iter()
        .copied()
        .zip(runs.iter().map(eps))
        .collect();
    let rise = slope(&points).unwrap_or(f64::NAN);
    let count = points.len() as f64;
    let (x, y) = points
        .iter()
        .fold((0.0, 0.0), |(x, y), p| (x + p.0 / count, y + p.1 / count));
    let bend = largest(points.iter().map(|p| (p.1 - y - rise * (p.0 - x)).abs()));
    let ratios = || points.iter().map(|p| p.1 / p.0);
    let spread = largest(ratios()) / smallest(ratios()) - 1.0;
    sheet.claims.extend([
        Claim::most(
            "eps > 0.9: off a straight line",
            "linear in eps",
            bend,
            0.002,
        ),
        Claim::most("eps > 0.9: eps_eff/eps varies by", "constant", spread, 0.02).because(
            "eps_eff is linear in eps there, but with an intercept: both are 1 without damping, \
             and 1 - eps_eff is a third of 1 - eps",
        ),
    ]);
    sheet.notes.push(format!(
        "For eps from 0.9 to 1 the slope of eps_eff over eps is {rise:.3}; a proportion would \
         have 1."
    ));
    Ok(())
}
