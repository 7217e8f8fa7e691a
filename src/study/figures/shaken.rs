//! Figs. 5 and 6: columns on a plate that vibrates with twice gravity.

use super::landings::{Landing, Landings, alternation, changes, dense_share, return_time};
use super::pool::RunPool;
use super::runs::{largest, looks, preset};
use super::{Claim, FigureError, Sheet};
use crate::numerals::significant;
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::fit::median;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Cell, Column, Table};

/// Periods that are drawn, and that are counted.
const DRAWN: f64 = 10.0;
const COUNTED: (f64, f64) = (60.0, 600.0);

/// Periods whose states are drawn, and whose motion is kept.
const STATES: f64 = 30.0;
const KEPT: f64 = 60.0;

/// E_r/E below which a column is condensed, and below which nothing is drawn.
const CONDENSED: f64 = 1e-3;
const LEAST_SHOWN: f64 = 1e-8;

/// Looks in a period.
const LOOKS: f64 = 200.0;

/// One look at the column.
struct ShakenLook {
    time: f64,
    floor: f64,
    heights: Vec<f64>,
    shared: Option<f64>,
    flight: Option<f64>,
    /// Distance of the top bead from where it is in a closed column, m.
    opened: f64,
}

/// What is seen of a run.
struct ShakenRecord {
    samples: Vec<ShakenLook>,
    landings: Landings,
}

/// The figure of a preset of that name, of `fig5a` to `fig6b`.
pub(super) fn sheet(name: &'static str, pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let method = match name {
        "fig6a" => MethodName::Ed,
        _ => MethodName::Exact,
    };
    let scene = preset(name, Some(method), &[])?;
    let period = scene.period().unwrap_or(f64::NAN);
    let periods = pool.pick(COUNTED.0, COUNTED.1);
    let seen = pool.each(&[periods], |&periods| seen(&scene, period, periods))?;
    let mut sheet = Sheet::default();
    for seen in &seen {
        match name {
            "fig6a" => clustered(&scene, &seen.samples, &mut sheet),
            _ => parting(name, &scene, period, seen, &mut sheet),
        }
        record(name, &scene, period, seen, &mut sheet);
    }
    Ok(sheet)
}

fn seen(scene: &Scene, period: f64, periods: f64) -> Result<ShakenRecord, FigureError> {
    let mut samples = Vec::new();
    let mut landings = Landings::new(scene.contact_time().unwrap_or(f64::NAN));
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most 120 000 looks"
    )]
    let count = (periods * LOOKS) as u32;
    looks(scene, periods * period, count, |seen| {
        let energy = &seen.energy;
        landings.look(seen);
        samples.push(ShakenLook {
            time: seen.time,
            floor: seen.floor,
            heights: seen.reduced.clone(),
            shared: (energy.kinetic > 0.0).then(|| energy.relative / energy.kinetic),
            flight: seen.free_flight,
            opened: seen.gaps.iter().skip(1).map(|gap| gap.max(0.0)).sum(),
        });
    })?;
    Ok(ShakenRecord { samples, landings })
}

fn parting(name: &str, scene: &Scene, period: f64, seen: &ShakenRecord, sheet: &mut Sheet) {
    let contact_time = scene.contact_time().unwrap_or(f64::NAN);
    let (samples, landings) = (&seen.samples, seen.landings.all());
    let count = landings.len();
    let dense = dense_share(landings);
    let (at_dense, at_loose) = changes(landings);
    let condensed = samples
        .iter()
        .filter(|s| s.shared.is_some_and(|x| x < CONDENSED));
    let condensed = condensed.count() as f64 / samples.len() as f64;
    let opened = largest(samples.iter().map(|s| s.opened)) / scene.diameter;
    match name {
        "fig5a" => sheet.claims.extend([
            Claim::near(
                "contact time of 10 beads/period",
                0.15,
                scene.n as f64 * contact_time / period,
                0.1,
            ),
            Claim::least("landings with sigma < 1", "most", dense, 0.5).because(
                "measured by the mean gap at a landing few landings are dense: large gaps \
                 last, as the figure shows, and sigma is small only beside that of Fig. 5(b)",
            ),
            Claim::most("time with E_r/E < 1e-3", "seldom", condensed, 0.05),
        ]),
        "fig5b" => {
            sheet.claims.extend([
                Claim::between("landings with sigma < 1", "some", dense, (0.05, 0.95)),
                Claim::between("time with E_r/E < 1e-3", "some", condensed, (0.05, 0.95)),
                Claim::least("E_r/E at a dense landing, times", "grows", at_dense, 100.0),
                Claim::between(
                    "E_r/E at a loose landing, times",
                    "falls",
                    at_loose,
                    (0.01, 1.0),
                ),
            ]);
            sheet.claims.extend(alternation(landings, period));
            sheet.notes.push(format!(
                "A column that has come to rest takes off at the same phase of the plate each \
                 time, so dense landings come whole periods after one another, {:.2} in the \
                 median (one that follows right on another belongs to the same burst and is left \
                 out).",
                return_time(landings, period)
            ));
        }
        _ => {}
    }
    // The plate throws one body (A_0 ω)²/2g high, which is d to 2d; in a burst the upper
    // beads get more than their part.
    sheet.claims.push(Claim::between(
        "widest opening over d",
        "large",
        opened,
        (1.0, 30.0),
    ));
    let sigmas: Vec<f64> = landings.iter().map(|l| l.sigma).collect();
    sheet.notes.push(format!(
        "{count} landings in {:.0} periods, with a median sigma of {}; sigma of a landing is the \
         mean gap over the speed and t_c, as sigma_0 is of a launched column. From before a landing \
         to after it E_r/E changes by a factor of {} where sigma < 1, and of {} elsewhere (medians). The motion is \
         chaotic: after some periods only what is counted can be compared, not the lines.",
        samples.last().map_or(0.0, |s| s.time / period),
        significant(median(&sigmas), 2),
        significant(at_dense, 2),
        significant(at_loose, 2),
    ));
}

fn clustered(scene: &Scene, samples: &[ShakenLook], sheet: &mut Sheet) {
    let opened = largest(samples.iter().map(|s| s.opened)) / scene.diameter;
    let amplitude = largest(samples.iter().map(|s| s.floor));
    let lowest = samples.iter().filter_map(|s| s.heights.first().copied());
    let apex = largest(lowest) / amplitude;
    sheet.claims.extend([
        Claim::most("widest opening over d", "far below d", opened, 0.01),
        Claim::off("apex over A_0, one inelastic body", 1.25, apex, 0.002),
    ]);
    sheet.notes.push(
        "The paper's Fig. 6(a) is an experiment, whose data are not at hand: shown is what its \
         text says of it, that the column stays clustered, as hard spheres do. The apex of one \
         totally inelastic body at alpha = 2 has a closed form."
            .to_owned(),
    );
}

/// Names of the beads' columns; the presets have ten.
const HEIGHTS: [&str; 10] = ["z1", "z2", "z3", "z4", "z5", "z6", "z7", "z8", "z9", "z10"];

fn record(name: &str, scene: &Scene, period: f64, seen: &ShakenRecord, sheet: &mut Sheet) {
    let (samples, landings) = (&seen.samples, seen.landings.all());
    let short = &name[3..];
    sheet.data.push(motion(name, scene, period, samples));
    let line = |get: &dyn Fn(&ShakenLook) -> f64| -> Vec<(f64, f64)> {
        let drawn = samples.iter().take_while(|s| s.time <= DRAWN * period);
        drawn.map(|s| (s.time / period, 1e3 * get(s))).collect()
    };
    let mut series: Vec<Series> = (0..scene.n)
        .map(|bead| Series::new(format!("{}", bead + 1), line(&|s| s.heights[bead])))
        .collect();
    series.push(Series::new("plate", line(&|s| s.floor)));
    sheet.plots.push(Plot {
        name: name.to_owned(),
        title: format!("Fig. {short}: reduced heights"),
        x: Axis::linear("t f (periods)"),
        y: Axis::linear("z_i (mm)"),
        series: series
            .into_iter()
            .map(|s| s.with(SeriesStyle::Line))
            .collect(),
    });
    if name == "fig6a" {
        return;
    }
    let drawn = landings.iter().take_while(|l| l.time <= STATES * period);
    let sigma = drawn.map(|l| (l.time / period, l.sigma.max(LEAST_SHOWN)));
    let shared = samples.iter().take_while(|s| s.time <= STATES * period);
    let shared = shared.filter_map(|s| Some((s.time / period, s.shared?.max(LEAST_SHOWN))));
    sheet.plots.push(Plot {
        name: format!("{name}-sigma"),
        title: format!("Fig. {short}: E_r/E, and σ of each landing"),
        x: Axis::linear("t f (periods)"),
        y: Axis::log("E_r/E, σ"),
        series: vec![
            Series::new("E_r/E", shared.collect()).with(SeriesStyle::Line),
            Series::new("σ of a landing", sigma.collect()).with(SeriesStyle::Points),
        ],
    });
    sheet.data.push(states(name, scene, landings));
}

/// The first periods, with all beads.
fn motion(name: &str, scene: &Scene, period: f64, samples: &[ShakenLook]) -> Table {
    let mut columns = vec![Column::new("time", "", "s"), Column::new("floor", "", "m")];
    columns.extend(
        HEIGHTS
            .iter()
            .take(scene.n)
            .map(|z| Column::new(z, "", "m")),
    );
    columns.extend([
        Column::new("opened", "", "m"),
        Column::new("er_over_e", "", ""),
        Column::new("free_flight", "", "s"),
    ]);
    let title = format!("Fig. {}: a shaken column over time", &name[3..]);
    let mut data = Table::new(name, title, columns);
    data.facts = facts(scene, name);
    for sample in samples.iter().take_while(|s| s.time <= KEPT * period) {
        let mut row: Vec<Cell> = vec![sample.time.into(), sample.floor.into()];
        row.extend(sample.heights.iter().map(|&z| Cell::from(z)));
        row.extend([
            sample.opened.into(),
            sample.shared.into(),
            sample.flight.into(),
        ]);
        data.push(row);
    }
    data
}

/// All landings.
fn states(name: &str, scene: &Scene, landings: &[Landing]) -> Table {
    let title = format!(
        "Fig. {}: all landings, and the motion after each",
        &name[3..]
    );
    let columns = [
        Column::new("time", "", "s"),
        Column::new("sigma", "", ""),
        Column::new("er_over_e_after", "", ""),
    ];
    let mut data = Table::new(format!("{name}-landings"), title, columns);
    data.facts = facts(scene, name);
    data.notes.push(
        "sigma: mean gap at the landing over speed and t_c; er_over_e_after: mean E_r over mean \
         E from there to the next landing."
            .to_owned(),
    );
    for landing in landings {
        data.push([
            landing.time.into(),
            landing.sigma.into(),
            landing.after.into(),
        ]);
    }
    data
}
