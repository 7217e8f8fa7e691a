//! Fig. 4(a): ε_eff over σ of a lattice ten rows high, with a column of ten beside it.

mod lattice_run;
mod record;

use super::pool::RunPool;
use super::runs::{crossing, largest};
use super::{Claim, FigureError, Sheet};
use crate::math;
use crate::study::Results;
use lattice_run::{LatticeRun, STEPS, eps};
use record::record;

/// Speeds |v₀|, m/s, and contact times t_c, s, within the paper's ranges. Lengths in d,
/// times in t_c: what a lattice does depends on σ and |v₀| t_c/d alone, which is from
/// 2e-5 to 0.1 here.
const PAIRS: [(f64, f64); 5] = [
    (1.0, 1e-4),
    (1.0, 1e-5),
    (0.1, 1e-5),
    (0.05, 2e-6),
    (0.01, 2e-6),
];

/// Separations s₀ of the paper, m.
const SEPARATIONS: (f64, f64) = (1e-7, 1e-3);

/// A lattice with wider separations is not dense: its limit at large σ is another.
const DENSE: f64 = 1e-4;

/// Decades of σ that the separations reach.
const DECADES: std::ops::RangeInclusive<i32> = -3..=5;

/// From here on, to rounding, nothing depends on σ any more.
const HARD: f64 = 99.9;

/// Where the curve begins to fall, within a factor of two of the paper's 0.1.
const BEGIN: (f64, f64) = (0.05, 0.2);

/// Rows and restitutions of other lattices in the same limit.
const OTHERS: [(u64, f64); 4] = [(5, 0.9), (20, 0.9), (10, 0.8), (10, 0.97)];

/// Where the steps are checked.
const CHECKED: [f64; 3] = [0.1, 1.0, 10.0];

/// A mean with its standard error and the scatter of single values.
#[derive(Debug, Clone, Copy)]
struct ScatteredMean {
    value: f64,
    error: f64,
    scatter: f64,
}

fn mean(values: &[f64]) -> ScatteredMean {
    let n = values.len() as f64;
    let value = values.iter().sum::<f64>() / n;
    let squares: f64 = values.iter().map(|x| math::powi(x - value, 2)).sum();
    let scatter = (squares / (n - 1.0)).sqrt();
    ScatteredMean {
        value,
        error: scatter / n.sqrt(),
        scatter,
    }
}

/// The curve at one σ: the lattice over seeds and pairs, and columns beside it.
struct Point {
    sigma: f64,
    lattice: Vec<f64>,
    even: f64,
    shifted: f64,
}

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let jobs = jobs(pool.pick(2, 4), pool.pick(1, 3));
    let found = pool.each(&jobs, LatticeRun::run)?;
    let curve = curve(pool, &jobs, &found)?;
    let ends = pool.each(&[false, true], |&column| {
        // Without separation there is nothing to be shifted by.
        let still = LatticeRun::usual(0.0, 1);
        if column {
            still.column(None)
        } else {
            Ok(eps(&LatticeRun {
                steps: 200.0,
                ..still
            }
            .run()?))
        }
    })?;
    let mut sheet = Sheet::default();
    let limit = limits(&jobs, &found, (ends[0], ends[1]), &mut sheet)?;
    fall(&curve, (ends[0], limit), ends[1], &mut sheet);
    spread(&curve, &mut sheet);
    others(pool, &mut sheet)?;
    steps(pool, &mut sheet)?;
    record(&jobs, &found, &curve, &mut sheet)?;
    Ok(sheet)
}

/// Every σ of so many in a decade that a pair's separations reach, with so many seeds.
fn jobs(in_decade: i32, seeds: u64) -> Vec<LatticeRun> {
    let mut jobs = Vec::new();
    let whole = DECADES.start() * in_decade..=DECADES.end() * in_decade;
    for (v0, contact_time) in PAIRS {
        for k in whole.clone() {
            let sigma = math::powf(10.0, f64::from(k) / f64::from(in_decade));
            let s0 = sigma * v0 * contact_time;
            // To rounding.
            if s0 < 0.999 * SEPARATIONS.0 || s0 > 1.001 * SEPARATIONS.1 {
                continue;
            }
            for _ in 0..seeds {
                jobs.push(LatticeRun {
                    v0,
                    contact_time,
                    // A seed of its own for every run.
                    ..LatticeRun::usual(sigma, 1 + jobs.len() as u64)
                });
            }
        }
    }
    jobs
}

/// What all runs at each σ come to.
fn curve(
    pool: &mut RunPool,
    jobs: &[LatticeRun],
    found: &[Results],
) -> Result<Vec<Point>, FigureError> {
    let mut sigmas: Vec<f64> = jobs.iter().map(|job| job.sigma).collect();
    sigmas.sort_by(f64::total_cmp);
    sigmas.dedup();
    pool.each(&sigmas, |&sigma| {
        let mine = jobs.iter().zip(found);
        let twin = LatticeRun::usual(sigma, 1);
        let shifted = (1..=8).map(|seed| twin.column(Some(seed)));
        Ok(Point {
            sigma,
            lattice: mine
                .filter(|(job, _)| job.sigma == sigma)
                .map(|(_, results)| eps(results))
                .collect(),
            even: twin.column(None)?,
            shifted: mean(&shifted.collect::<Result<Vec<_>, _>>()?).value,
        })
    })
}

/// Both ends of the curve beside those of the column; the lattice's at large σ.
fn limits(
    jobs: &[LatticeRun],
    found: &[Results],
    (lattice, column): (f64, f64),
    sheet: &mut Sheet,
) -> Result<f64, FigureError> {
    // Of the runs at large σ those with separations in a range, edges by rounding.
    let hard = |from: f64, to: f64, get: fn(&Results) -> f64| -> ScatteredMean {
        let mine = jobs.iter().zip(found);
        let values = mine
            .filter(|(job, _)| job.sigma > HARD && (from..to).contains(&(job.s0() / 1.001)))
            .map(|(_, results)| get(results));
        mean(&values.collect::<Vec<_>>())
    };
    let relative = |results: &Results| results.er_over_ef.unwrap_or(f64::NAN);
    let widest = 0.99 * SEPARATIONS.1;
    let dense = hard(0.0, DENSE, eps);
    let (wide, wider) = (hard(DENSE, widest, eps), hard(widest, f64::INFINITY, eps));
    let hard_column = LatticeRun::usual(1e3, 1).column(None)?;
    sheet.claims.extend([
        Claim::most(
            "sigma = 0: |2D - 1D|",
            "none",
            (lattice - column).abs(),
            0.003,
        ),
        Claim::most(
            "sigma >= 100: |2D - 1D|",
            "none",
            (dense.value - hard_column).abs(),
            0.02,
        )
        .because(
            "near but not the same, and not for want of seeds, steps or time: 2D lies under 1D \
             where little is lost and over it where much is, and 10 rows at eps = 0.9 are near \
             where they cross (see the other heights and restitutions)",
        ),
    ]);
    sheet.notes.push(format!(
        "eps_eff without separation: 2D {lattice:.4}, 1D {column:.4}; for sigma >= 100 and s0 <= \
         d/10: 2D {:.4} +- {:.4} (single runs scatter by {:.3}), 1D {hard_column:.4}. Lattices \
         that are not dense have limits of their own: {:.3} for s0 between d/10 and d, {:.3} for \
         s0 = d.",
        dense.value, dense.error, dense.scatter, wide.value, wider.value
    ));
    sheet.notes.push(format!(
        "The same eps_eff is not the same motion: for sigma >= 100 E_r/E_f is {:.2} in 2D, and 0.02 \
         in 1D. Beads of a lattice are hit 30 degrees off their way up, by one of two below first: \
         less goes into the centre of mass, more is left in relative motion.",
        hard(0.0, DENSE, relative).value,
    ));
    Ok(dense.value)
}

/// Between which σ the curve falls, in a plane and in a column.
fn fall(curve: &[Point], (first, last): (f64, f64), column: f64, sheet: &mut Sheet) {
    let along = |get: fn(&Point) -> f64| -> Vec<(f64, f64)> {
        curve
            .iter()
            .map(|point| (point.sigma, get(point)))
            .collect()
    };
    let lattice = along(|point| mean(&point.lattice).value);
    let (even, shifted) = (along(|point| point.even), along(|point| point.shifted));
    let hard = even.last().map_or(f64::NAN, |point| point.1);
    let at = |curve: &[(f64, f64)], (first, last): (f64, f64), part: f64| {
        crossing(curve, first + part * (last - first))
    };
    let plane = |part| at(&lattice, (first, last), part);
    let line = |part| at(&even, (column, hard), part);
    let random = |part| at(&shifted, (column, hard), part);
    sheet.claims.extend([
        Claim::between("2D: sigma at 10 % of the fall", "0.1", plane(0.1), BEGIN),
        // Later than in 1D, and within the paper's interval.
        Claim::between(
            "2D: sigma at 90 % of the fall",
            "to 10",
            plane(0.9),
            (1.0, 10.0),
        ),
        Claim::between("1D: sigma at 10 % of the fall", "0.1", line(0.1), BEGIN),
        Claim::between("1D: sigma at 90 % of the fall", "1", line(0.9), (0.5, 1.0))
            .because("the tail towards the hard spheres' value is long, as in Fig. 2(a)"),
        // 0.1 to 10 over 0.1 to 1 at most.
        Claim::between(
            "its width in 2D over that in 1D",
            "> 1",
            (plane(0.9) / plane(0.1)) / (line(0.9) / line(0.1)),
            (1.0, 10.0),
        ),
    ]);
    sheet.notes.push(format!(
        "10, 50 and 90 % of the fall: 2D sigma = {:.3}, {:.3}, {:.2}; 1D evenly spaced {:.3}, {:.3}, \
         {:.2}; 1D shifted at random, as the lattice is, {:.3}, {:.3}, {:.2}.",
        plane(0.1),
        plane(0.5),
        plane(0.9),
        line(0.1),
        line(0.5),
        line(0.9),
        random(0.1),
        random(0.5),
        random(0.9),
    ));
}

/// How far single runs are from the mean at their σ.
fn spread(curve: &[Point], sheet: &mut Sheet) {
    let off: Vec<f64> = curve
        .iter()
        .flat_map(|point| {
            let middle = mean(&point.lattice).value;
            point.lattice.iter().map(move |eps| (eps - middle).abs())
        })
        .collect();
    let mean_square = off.iter().map(|x| x * x).sum::<f64>() / off.len() as f64;
    sheet.claims.extend([
        Claim::most(
            "single runs: rms off one curve",
            "one curve",
            mean_square.sqrt(),
            0.02,
        ),
        Claim::most(
            "single runs: most off one curve",
            "one curve",
            largest(off.iter().copied()),
            0.05,
        ),
    ]);
}

/// Other heights and restitutions in the limit of large σ.
fn others(pool: &mut RunPool, sheet: &mut Sheet) -> Result<(), FigureError> {
    let seeds = pool.pick(2, 8);
    let job = |(rows, restitution), seed| LatticeRun {
        rows,
        restitution,
        v0: 0.01,
        ..LatticeRun::usual(100.0, seed)
    };
    let jobs: Vec<LatticeRun> = OTHERS
        .iter()
        .flat_map(|&other| (1..=seeds).map(move |seed| job(other, seed)))
        .collect();
    let found = pool.each(&jobs, |job| Ok((eps(&job.run()?), job.column(None)?)))?;
    for ((rows, restitution), runs) in OTHERS
        .iter()
        .zip(found.chunks_exact(jobs.len() / OTHERS.len()))
    {
        let lattice = mean(&runs.iter().map(|run| run.0).collect::<Vec<_>>());
        let column = runs[0].1;
        let claim = Claim::off(
            format!("sigma 100, h {rows}, eps {restitution}"),
            column,
            lattice.value,
            0.02,
        );
        sheet.claims.push(
            Claim {
                paper: format!("1D: {column:.4}"),
                ..claim
            }
            .because(format!(
                "at large sigma eps_eff does depend on the dimension; +-{:.3} is the mean's error",
                lattice.error
            )),
        );
    }
    Ok(())
}

/// Whether the steps are short enough.
fn steps(pool: &mut RunPool, sheet: &mut Sheet) -> Result<(), FigureError> {
    let (seeds, fine) = (pool.pick(2, 8), pool.pick(2.0, 4.0));
    let job = |sigma, seed, steps| LatticeRun {
        steps,
        ..LatticeRun::usual(sigma, seed)
    };
    let jobs: Vec<[LatticeRun; 2]> = CHECKED
        .iter()
        .flat_map(|&sigma| {
            (1..=seeds).map(move |seed| [1.0, fine].map(|f| job(sigma, seed, f * STEPS)))
        })
        .collect();
    let found = pool.each(&jobs, |[coarse, fine]| {
        Ok(eps(&coarse.run()?) - eps(&fine.run()?))
    })?;
    let by_sigma = found.chunks_exact(found.len() / CHECKED.len());
    let off = largest(by_sigma.map(|runs| mean(runs).value.abs()));
    sheet.claims.push(Claim::most(
        format!("t_c/{STEPS} less t_c/{}, mean", fine * STEPS),
        "-",
        off,
        0.01,
    ));
    sheet.notes.push(format!(
        "Steps of t_c/{STEPS}, velocity Verlet. At large sigma a single run forgets its seed's last \
         digits, so shorter steps are held against it in the mean over {seeds} seeds, at sigma = 0.1, \
         1 and 10."
    ));
    Ok(())
}
