//! Fig. 2(a): ε_eff over σ, one curve for all speeds, contact times and separations.

use super::pool::RunPool;
use super::runs::{crossing, decades, largest, preset, results, smallest};
use super::{Claim, FigureError, Sheet};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};

/// Speeds v₀, m/s, and contact times t_c, s, over the paper's ranges.
const PAIRS: [(f64, f64); 6] = [
    (14.0, 2.5e-6),
    (14.0, 2.2e-3),
    (0.2, 0.7e-5),
    (0.2, 2e-4),
    (0.008, 2.5e-6),
    (0.008, 2.2e-3),
];

/// Separations s₀ of the paper, m.
const SEPARATIONS: (f64, f64) = (1e-9, 1e-3);

/// Where the curve falls, by Sec. IV C.
const FALL: (f64, f64) = (0.1, 1.0);

/// What the hard spheres were run with, m and m/s.
const HARD_SEPARATIONS: [f64; 7] = [0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2];
const HARD_SPEEDS: [f64; 3] = [20.0, 0.2, 0.01];

/// A run.
#[derive(Clone, Copy)]
struct SpacedRun {
    v0: f64,
    contact_time: f64,
    s0: f64,
    /// Of the random shifts; evenly spaced beads without.
    seed: Option<u64>,
}

impl SpacedRun {
    fn sigma(&self) -> f64 {
        self.s0 / (self.v0 * self.contact_time)
    }

    fn scene(&self) -> Result<Scene, FigureError> {
        let mut values = vec![
            ("v0", Value::Number(-self.v0)),
            ("contact_time", Value::Number(self.contact_time)),
            ("s0", Value::Number(self.s0)),
        ];
        if let Some(seed) = self.seed {
            values.extend([("jitter", Value::Flag(true)), ("seed", Value::Whole(seed))]);
        }
        preset("fig1b", Some(MethodName::Exact), &values)
    }

    fn run(&self) -> Result<f64, FigureError> {
        Ok(results(&self.scene()?)?.eps_eff.unwrap_or(f64::NAN))
    }

    /// The evenly spaced column with the same σ, at 0.2 m/s and 7 µs.
    fn twin(&self) -> Self {
        let (v0, contact_time) = (0.2, 0.7e-5);
        Self {
            v0,
            contact_time,
            s0: self.sigma() * v0 * contact_time,
            seed: None,
        }
    }
}

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let separations = decades(SEPARATIONS.0, SEPARATIONS.1, pool.pick(26, 61));
    let mut jobs = Vec::new();
    for (v0, contact_time) in PAIRS {
        for shifted in [false, true] {
            for &s0 in &separations {
                // A seed of its own for every run.
                let seed = shifted.then_some(1 + jobs.len() as u64);
                jobs.push(SpacedRun {
                    v0,
                    contact_time,
                    s0,
                    seed,
                });
            }
        }
    }
    let found = pool.each(&jobs, |job| Ok((job.run()?, job.twin().run()?)))?;
    let hard = hard(pool)?;
    let mut sheet = Sheet::default();
    spread(&jobs, &found, &mut sheet);
    fall(&jobs, &found, &mut sheet);
    let line = hard.iter().sum::<f64>() / hard.len() as f64;
    let most = largest(hard.iter().map(|e| (e - line).abs()));
    sheet
        .claims
        .push(Claim::off("eps_eff of ED, mean", 0.341, line, 0.002));
    sheet.claims.push(Claim::most(
        "ED: spread over s0, v0",
        "+-0.002",
        most,
        0.002,
    ));
    record(&jobs, &found, line, &mut sheet)?;
    Ok(sheet)
}

fn hard(pool: &mut RunPool) -> Result<Vec<f64>, FigureError> {
    let jobs: Vec<(f64, f64)> = HARD_SPEEDS
        .iter()
        .flat_map(|&v0| HARD_SEPARATIONS.map(|s0| (v0, s0)))
        .collect();
    pool.each(&jobs, |&(v0, s0)| {
        let values = [("v0", Value::Number(-v0)), ("s0", Value::Number(s0))];
        let scene = preset("fig1d", Some(MethodName::Ed), &values)?;
        Ok(results(&scene)?.eps_eff.unwrap_or(f64::NAN))
    })
}

/// How far the points are from one curve.
fn spread(jobs: &[SpacedRun], found: &[(f64, f64)], sheet: &mut Sheet) {
    let off = |shifted: bool| -> Vec<f64> {
        let mine = jobs.iter().zip(found);
        mine.filter(|(job, _)| job.seed.is_some() == shifted)
            .map(|(_, (eps, twin))| (eps - twin).abs())
            .collect()
    };
    let (even, shifted) = (off(false), off(true));
    let mean_square = shifted.iter().map(|x| x * x).sum::<f64>() / shifted.len() as f64;
    sheet.claims.extend([
        Claim::most(
            "even starts: most off one curve",
            "on the curve",
            largest(even),
            1e-6,
        ),
        Claim::most(
            "shifted starts: rms off it",
            "on the curve",
            mean_square.sqrt(),
            0.05,
        ),
        Claim::most(
            "shifted starts: most off it",
            "on the curve",
            largest(shifted),
            0.05,
        )
        .because(
            "where the curve falls, a column with random gaps has some contacts that \
                 overlap and some that do not; it lies near the curve, not on it",
        ),
    ]);
}

/// Between which σ the curve falls, from the even starts.
fn fall(jobs: &[SpacedRun], found: &[(f64, f64)], sheet: &mut Sheet) {
    let mut curve: Vec<(f64, f64)> = jobs
        .iter()
        .zip(found)
        .filter(|(job, _)| job.seed.is_none())
        .map(|(job, (eps, _))| (job.sigma(), *eps))
        .collect();
    curve.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (Some(first), Some(last)) = (curve.first(), curve.last()) else {
        return;
    };
    let at = |part: f64| crossing(&curve, first.1 + part * (last.1 - first.1));
    sheet.claims.extend([
        Claim::between("sigma at 10 % of the fall", "0.1 to 1", at(0.1), FALL),
        Claim::between("sigma at 90 % of the fall", "0.1 to 1", at(0.9), FALL).because(
            "the tail towards the hard spheres' value is long; half of the fall is done where \
             the note says",
        ),
        Claim::near("eps_eff at the largest sigma", 0.341, last.1, 0.01),
    ]);
    sheet.notes.push(format!(
        "Half of the fall is done at sigma = {:.3}; at the smallest, {:.1e}, eps_eff is {:.4}.",
        at(0.5),
        first.0,
        first.1
    ));
}

fn record(
    jobs: &[SpacedRun],
    found: &[(f64, f64)],
    line: f64,
    sheet: &mut Sheet,
) -> Result<(), FigureError> {
    let mut data = Table::new(
        "fig2a",
        "Fig. 2(a): effective restitution over sigma",
        [
            Column::new("v0", "", "m/s"),
            Column::new("contact_time", "", "s"),
            Column::new("s0", "", "m"),
            Column::new("seed", "", ""),
            Column::new("sigma", "", ""),
            Column::new("eps_eff", "", ""),
            Column::new("eps_eff_even_twin", "", ""),
        ],
    );
    data.facts = facts(&jobs[0].scene()?, "fig1b with the values of each row");
    data.facts.push((
        "seed of shifted starts".to_owned(),
        "as in each row".to_owned(),
    ));
    for (job, (eps, twin)) in jobs.iter().zip(found) {
        data.push([
            (-job.v0).into(),
            job.contact_time.into(),
            job.s0.into(),
            job.seed.into(),
            job.sigma().into(),
            (*eps).into(),
            (*twin).into(),
        ]);
    }
    sheet.data.push(data);
    let mut series = Vec::new();
    for (v0, contact_time) in PAIRS {
        let mine = jobs.iter().zip(found).filter(|(job, _)| {
            (job.v0, job.contact_time) == (v0, contact_time) && job.seed.is_none()
        });
        let points = mine.map(|(job, (eps, _))| (job.sigma(), *eps)).collect();
        let name = format!("{v0} m/s, {contact_time:e} s");
        series.push(Series::new(name, points).with(SeriesStyle::Points));
    }
    let shifted = jobs.iter().zip(found).filter(|(job, _)| job.seed.is_some());
    let points = shifted.map(|(job, (eps, _))| (job.sigma(), *eps)).collect();
    series.push(Series::new("shifted at random", points).with(SeriesStyle::Points));
    let ends = || jobs.iter().map(SpacedRun::sigma);
    let (low, high) = (smallest(ends()), largest(ends()));
    series.push(Series::new("ED", vec![(low, line), (high, line)]).with(SeriesStyle::Line));
    sheet.plots.push(Plot {
        name: "fig2a".to_owned(),
        title: "Fig. 2(a): N = 10, ε = 0.9".to_owned(),
        x: Axis::log("σ = s_0/(|v_0| t_c)"),
        y: Axis::linear("ε_eff"),
        series,
    });
    Ok(())
}
