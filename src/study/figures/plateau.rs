//! What becomes of Fig. 5(b) as t_c goes to zero. The paper expects the detachment effect to
//! go ("such computation-induced phenomena can be inhibited by using physically reasonable,
//! small values for the time t_c"); on a plate that lets the column come to rest it stays.
//!
//! At rest contact i carries the weight of the beads above it, at the gravity that is felt
//! on the plate, a(t) = g − αg sin ωt. That goes through zero at take-off, at the rate
//! ȧ = −gω√(α² − 1), and the overlaps go with it: where contacts are much faster than the
//! plate, x_i = (m_i a/K)^(1/(1+β)) with m_i = (N − i) m. For the linear law, K = m ω_0²/2,
//! contact i opens at
//!
//!   u_i = 2(N − i) gω√(α² − 1)/ω_0²,
//!
//! of the order of gω t_c², and gaps are u_i T when the column lands at v after a flight of
//! T, the totally inelastic body's. So
//!
//!   σ = ⟨u_i⟩ T/(v t_c) = N gω√(α² − 1) T/(ω_0² v t_c),
//!
//! which goes as t_c: the harder the contacts, the denser the landing. What it bursts into
//! is what columns that touch burst into, whatever t_c.
//!
//! Contacts with β > 0 soften as they are relieved. The overlap cannot follow once a contact
//! needs longer for that than there is: at τ before take-off, with |ȧ|τ³ = (|ȧ|τ/K)^(1/(1+β)).
//! Then u = |ȧ|τ², which goes as K^(−2/(2+3β)), and K as t_c^(−(2+β)) at a given speed: σ goes
//! as t_c^((2−β)/(2+3β)), as t_c^(3/7) after Hertz. Kuwabara and Kono's dashpot is weak beside
//! that spring. A linear dashpot on Hertz's spring (γ = 0) is not: the last contacts creep,
//! some never open, and σ falls faster.

mod theory;

use super::landings::{Landings, dense_share};
use super::pool::RunPool;
use super::runs::{largest, looks, preset, smallest};
use super::{Claim, FigureError, Sheet};
use crate::math;
use crate::numerals::significant;
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::fit::{median, slope};
use crate::study::means::{Mean, Means};
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};
use crate::study::vary;
use theory::density;

/// The law of each part, and its exponent of t_c in σ after a rest.
const LAWS: [(&str, &str); 3] = [
    ("Hooke", "hooke"),
    ("Hertz", "hertz"),
    ("H.-K.-Kono", "hertz-kuwabara-kono"),
];
const HOOKE: usize = 0;
const HERTZ: usize = 1;
const KONO: usize = 2;

/// Contact times t_c, s: of the linear law, and of the linear law that the others are like
/// at the scene's own speed.
const TIMES: [f64; 7] = [7e-4, 7e-5, 7e-6, 7e-7, 7e-8, 7e-9, 7e-10];

/// Of how many of them, the longest, the means of a law are taken, and over how many
/// periods: in a quick figure and in full. Power laws cost some ten times more, and the
/// more, the shorter contacts are.
const MEANS: [[(usize, usize); 2]; 3] =
    [[(5, 60), (7, 400)], [(2, 20), (3, 40)], [(2, 20), (3, 40)]];

/// Of how many the first landing is looked at. A linear dashpot on Hertz's spring lets
/// contacts creep, which costs ever more.
const FIRSTS: [usize; 3] = [7, 5, 7];

/// Periods before the means begin.
const SETTLING: usize = 10;

/// Looks in a period.
const LOOKS: usize = 200;

/// Tolerance of the adaptive method: means of a chaotic motion need no better.
const TOLERANCE: f64 = 1e-8;

/// Longest t_c, s, that is held against the limits of short ones.
const SHORT: f64 = 1e-6;

/// Share of relative motion below which a column would be as hard spheres are.
const CURED: f64 = 0.01;

/// A law at a contact time, in the order of [`LAWS`] and [`TIMES`].
#[derive(Debug, Clone, Copy, PartialEq)]
struct LawRun {
    law: usize,
    time: usize,
    /// Periods of which the mean is taken; without, there is the first landing alone.
    periods: usize,
}

/// What a run gives.
struct Found {
    /// t_c at the scene's own speed, s.
    contact_time: f64,
    share: Option<Mean>,
    landings: Landings,
}

impl LawRun {
    fn scene(&self) -> Result<Scene, FigureError> {
        let linear = [("contact_time", Value::Number(TIMES[self.time]))];
        let scene = preset("fig5b", Some(MethodName::Exact), &linear)?;
        if self.law == HOOKE {
            return Ok(scene);
        }
        let scene = vary(&scene, None, &[("law", Value::Choice(LAWS[self.law].1))])?;
        let tolerance = [("tolerance", Value::Number(TOLERANCE))];
        Ok(vary(&scene, None, &tolerance)?)
    }
}

fn run(scene: &Scene, periods: usize) -> Result<Found, FigureError> {
    let contact_time = scene.contact_time().unwrap_or(f64::NAN);
    let mut landings = Landings::new(contact_time);
    let mut means = Means::new(scene, LOOKS);
    let settling = if periods > 0 { SETTLING } else { 1 };
    let all = settling + periods;
    let end = scene.period().unwrap_or(f64::NAN) * all as f64;
    let mut look = 0;
    #[expect(clippy::cast_possible_truncation, reason = "at most 82 000 looks")]
    looks(scene, end, (all * LOOKS) as u32, |seen| {
        landings.look(seen);
        if look >= settling * LOOKS {
            means.look(seen);
        }
        look += 1;
    })?;
    Ok(Found {
        contact_time,
        share: means.share(means.all()),
        landings,
    })
}

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let mut jobs = Vec::new();
    // The shortest contacts take longest, and come first.
    for time in (0..TIMES.len()).rev() {
        for law in [KONO, HERTZ, HOOKE] {
            let (times, periods) = pool.pick(MEANS[law][0], MEANS[law][1]);
            let periods = if time < times { periods } else { 0 };
            if time < FIRSTS[law] {
                jobs.push(LawRun { law, time, periods });
            }
        }
    }
    let found = pool.each(&jobs, |job| run(&job.scene()?, job.periods))?;
    let hard = preset("fig5b", Some(MethodName::Ed), &[])?;
    let hard_periods = pool.pick(MEANS[HOOKE][0], MEANS[HOOKE][1]).1;
    let hard = pool.each(&[hard_periods], |&periods| Ok(run(&hard, periods)?.share))?;
    let study = Study {
        density: density(&preset("fig5b", Some(MethodName::Exact), &[])?),
        hard: hard[0],
        jobs,
        found,
    };
    let mut sheet = Sheet::default();
    study.judge_shares(&mut sheet);
    study.judge_landings(&mut sheet);
    sheet.plots = study.plots();
    sheet.data.push(study.table()?);
    Ok(sheet)
}

/// All runs.
struct Study {
    /// σ over t_c that theory gives, 1/s.
    density: f64,
    hard: Option<Mean>,
    jobs: Vec<LawRun>,
    found: Vec<Found>,
}

impl Study {
    /// The runs of a law, from the shortest contacts to the longest.
    fn of(&self, law: usize) -> impl Iterator<Item = (f64, &Found)> {
        let all = self.jobs.iter().zip(&self.found);
        all.filter(move |(job, _)| job.law == law)
            .map(|(job, found)| (TIMES[job.time], found))
    }

    /// Those of which there is a mean.
    fn shares(&self, law: usize) -> Vec<(f64, Mean)> {
        self.of(law)
            .filter_map(|(time, found)| Some((time, found.share?)))
            .collect()
    }

    /// t_c, s, and σ of the first landing, which comes after a rest.
    fn firsts(&self, law: usize) -> Vec<(f64, f64)> {
        let first = |found: &Found| found.landings.all().first().map(|l| l.sigma);
        self.of(law)
            .filter_map(|(_, found)| Some((found.contact_time, first(found)?)))
            .collect()
    }

    fn judge_shares(&self, sheet: &mut Sheet) {
        for (law, (name, _)) in LAWS.iter().enumerate() {
            let shares = self.shares(law);
            let Some(&(time, shortest)) = shares.first() else {
                continue;
            };
            sheet.claims.push(
                Claim::most(
                    format!("{name}: E_r/E at {time:e} s"),
                    "inhibited",
                    shortest.value,
                    CURED,
                )
                .because(
                    "where the plate lets a column rest, it lands the denser, the harder its \
                     contacts are, and bursts",
                ),
            );
            if law == HOOKE && shares.len() > 2 {
                let (longer, other) = shares[2];
                sheet.claims.push(Claim::most(
                    format!("the same less at {longer:e} s, errors"),
                    "theory: 0",
                    shortest.in_errors_from(other).unwrap_or(f64::NAN),
                    3.0,
                ));
            }
            let list: Vec<String> = shares
                .iter()
                .rev()
                .map(|(time, share)| {
                    let error = share.error.map_or(String::new(), |e| format!(" +- {e:.3}"));
                    format!("{:.3}{error} at {time:e} s", share.value)
                })
                .collect();
            sheet
                .notes
                .push(format!("{name}: E_r/E is {}.", list.join(", ")));
        }
        sheet.claims.push(Claim::most(
            "ED: E_r/E",
            "clustered",
            self.hard.map_or(f64::NAN, |share| share.value),
            1e-9,
        ));
    }

    fn judge_landings(&self, sheet: &mut Sheet) {
        let short = |law: usize| -> Vec<(f64, f64)> {
            let all = self.firsts(law).into_iter();
            all.filter(|(time, _)| *time < SHORT).collect()
        };
        let power = |law: usize| {
            let logs: Vec<_> = short(law)
                .iter()
                .map(|(t, s)| (math::ln(*t), math::ln(*s)))
                .collect();
            slope(&logs).unwrap_or(f64::NAN)
        };
        let off = short(HOOKE);
        let off = off
            .iter()
            .map(|(t, s)| (s / (self.density * t) - 1.0).abs());
        // The median over all dense landings: most come after a rest, not the first alone.
        let medians = self
            .of(HOOKE)
            .filter(|(t, found)| *t < SHORT && found.share.is_some());
        let medians = medians.map(|(t, found)| {
            let dense = found.landings.all().iter().filter(|l| l.is_dense());
            let sigma = median(&dense.map(|l| l.sigma).collect::<Vec<_>>());
            (sigma / (self.density * t) - 1.0).abs()
        });
        sheet.claims.extend([
            Claim::most(
                "Hooke: first sigma/theory - 1",
                "theory: 0",
                largest(off),
                0.002,
            ),
            Claim::most(
                "dense sigma/theory - 1, median",
                "theory: 0",
                largest(medians),
                0.01,
            ),
            Claim::off("Hooke: power of t_c in sigma", 1.0, power(HOOKE), 0.001).by_theory(),
            Claim::off("H.-K.-Kono: power of t_c in it", 0.4286, power(KONO), 0.005).by_theory(),
            Claim::between(
                "Hertz: power of t_c in it",
                "theory: > 3/7",
                power(HERTZ),
                (0.43, 2.0),
            ),
        ]);
        sheet.notes.push(format!(
            "sigma of the landing after a rest is {} times t_c/s by theory for Hooke. Were gaps \
             given, as s_0 is of a launched column, it would go as 1/t_c.",
            significant(self.density, 4)
        ));
    }

    fn plots(&self) -> Vec<Plot> {
        let shares = |law| -> Vec<(f64, f64)> {
            let all = self.shares(law).into_iter();
            all.map(|(time, share)| (time, share.value)).collect()
        };
        let series = |get: &dyn Fn(usize) -> Vec<(f64, f64)>| -> Vec<Series> {
            let laws = LAWS.iter().enumerate();
            laws.map(|(law, (name, _))| Series::new(*name, get(law)).with(SeriesStyle::Points))
                .collect()
        };
        let ends = [smallest(TIMES), largest(TIMES)];
        let mut relative = series(&shares);
        let hard = self.hard.map_or(f64::NAN, |share| share.value);
        relative.push(Series::new("ED", ends.map(|t| (t, hard)).to_vec()).with(SeriesStyle::Line));
        let mut sigma = series(&|law| self.firsts(law));
        let line = ends.map(|t| (t, self.density * t)).to_vec();
        sigma.push(Series::new("theory, Hooke", line).with(SeriesStyle::Line));
        vec![
            Plot {
                name: "plateau".to_owned(),
                title: "E_r/E of a shaken column that comes to rest".to_owned(),
                x: Axis::log("t_c (s)"),
                y: Axis::linear("E_r/E"),
                series: relative,
            },
            Plot {
                name: "plateau-sigma".to_owned(),
                title: "σ of the landing after a rest".to_owned(),
                x: Axis::log("t_c (s)"),
                y: Axis::log("σ"),
                series: sigma,
            },
        ]
    }

    fn table(&self) -> Result<Table, FigureError> {
        let mut data = Table::new(
            "plateau",
            "A shaken column that comes to rest, over the contact time",
            [
                Column::new("law", "", ""),
                Column::new("contact_time", "", "s"),
                Column::new("periods", "", ""),
                Column::new("er_over_e", "", ""),
                Column::new("er_over_e_error", "", ""),
                Column::new("first_sigma", "", ""),
                Column::new("dense_share", "", ""),
            ],
        );
        let shown = LawRun {
            law: HOOKE,
            time: 2,
            periods: 0,
        };
        data.facts = facts(
            &shown.scene()?,
            "fig5b with law and contact time of each row",
        );
        for (job, found) in self.jobs.iter().zip(&self.found) {
            let landings = found.landings.all();
            data.push([
                LAWS[job.law].1.into(),
                found.contact_time.into(),
                (job.periods as u64).into(),
                found.share.map(|share| share.value).into(),
                found.share.and_then(|share| share.error).into(),
                landings.first().map(|l| l.sigma).into(),
                found.share.map(|_| dense_share(landings)).into(),
            ]);
        }
        Ok(data)
    }
}
