//! Figs. 5 and 6: columns on a plate that vibrates with twice gravity.

use super::bench::Bench;
use super::runs::{looks, preset};
use super::{Claim, FigureError, Sheet};
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::fit::median;
use crate::study::plot::{Axis, Look, Plot, Series};
use crate::study::table::{Column, Table};

/// Periods that are drawn, and that are counted.
const DRAWN: f64 = 10.0;
const COUNTED: (f64, f64) = (60.0, 600.0);

/// Looks in a period.
const LOOKS: f64 = 200.0;

/// One look at the column.
struct Sample {
    time: f64,
    floor: f64,
    heights: Vec<f64>,
    shared: Option<f64>,
    flight: Option<f64>,
    /// Distance of the top bead from where it is in a closed column, m.
    opened: f64,
    crossing: Option<f64>,
}

/// The figure of a preset of that name, of `fig5a` to `fig6b`.
pub(super) fn sheet(name: &'static str, bench: &mut Bench) -> Result<Sheet, FigureError> {
    let method = match name {
        "fig6a" => MethodName::Ed,
        _ => MethodName::Exact,
    };
    let scene = preset(name, Some(method), &[])?;
    let period = scene.period().unwrap_or(f64::NAN);
    let periods = bench.pick(COUNTED.0, COUNTED.1);
    let samples = bench.each(&[periods], |&periods| samples(&scene, period, periods))?;
    let samples = &samples[0];
    let mut sheet = Sheet::default();
    match name {
        "fig6a" => clustered(&scene, samples, &mut sheet),
        _ => parting(name, &scene, period, samples, &mut sheet),
    }
    record(name, &scene, period, samples, &mut sheet);
    Ok(sheet)
}

fn samples(scene: &Scene, period: f64, periods: f64) -> Result<Vec<Sample>, FigureError> {
    let mut samples = Vec::new();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "at most 120 000 looks"
    )]
    let count = (periods * LOOKS) as u32;
    looks(scene, periods * period, count, |seen| {
        let energy = &seen.energy;
        samples.push(Sample {
            time: seen.time,
            floor: seen.floor,
            heights: seen.reduced.clone(),
            shared: (energy.kinetic > 0.0).then(|| energy.relative / energy.kinetic),
            flight: seen.free_flight,
            opened: seen.gaps.iter().skip(1).map(|gap| gap.max(0.0)).sum(),
            crossing: seen.crossing,
        });
    })?;
    Ok(samples)
}

/// σ of every landing, in their order: the crossing time stays until the next landing.
fn landings(samples: &[Sample], contact_time: f64) -> Vec<f64> {
    let mut all: Vec<f64> = samples.iter().filter_map(|s| s.crossing).collect();
    all.dedup();
    all.into_iter().map(|time| time / contact_time).collect()
}

fn parting(name: &str, scene: &Scene, period: f64, samples: &[Sample], sheet: &mut Sheet) {
    let contact_time = scene.contact_time().unwrap_or(f64::NAN);
    let sigmas = landings(samples, contact_time);
    let count = sigmas.len() as f64;
    let dense = sigmas.iter().filter(|sigma| **sigma < 1.0).count() as f64 / count;
    let turns = sigmas.windows(2).filter(|s| (s[0] < 1.0) != (s[1] < 1.0));
    let turns = turns.count() as f64 / count;
    let opened = samples.iter().map(|s| s.opened).fold(0.0_f64, f64::max) / scene.diameter;
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
        ]),
        "fig5b" => sheet.claims.extend([
            Claim::least("landings with sigma < 1", "some", dense, 0.05),
            Claim::most("the same", "not all", dense, 0.95),
            Claim::least(
                "turns of sigma about 1 a landing",
                "alternating",
                turns,
                0.1,
            ),
        ]),
        _ => {}
    }
    sheet
        .claims
        .push(Claim::least("widest opening over d", "large", opened, 1.0));
    sheet.notes.push(format!(
        "{count} landings in {:.0} periods, with a median sigma of {:.3}; sigma of a landing is the mean gap over the speed \
         and t_c, as sigma_0 is of a launched column. The motion is chaotic: after some periods \
         only what is counted can be compared, not the lines.",
        samples.last().map_or(0.0, |s| s.time / period),
        median(&sigmas)
    ));
}

fn clustered(scene: &Scene, samples: &[Sample], sheet: &mut Sheet) {
    let opened = samples.iter().map(|s| s.opened).fold(0.0_f64, f64::max) / scene.diameter;
    let amplitude = samples.iter().map(|s| s.floor).fold(0.0_f64, f64::max);
    let top = samples.iter().filter_map(|s| s.heights.first().copied());
    let apex = top.fold(0.0_f64, f64::max) / amplitude;
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

fn record(name: &str, scene: &Scene, period: f64, samples: &[Sample], sheet: &mut Sheet) {
    let short = &name[3..];
    let mut data = Table::new(
        name,
        format!("Fig. {short}: a shaken column over time"),
        [
            Column::new("time", "", "s"),
            Column::new("floor", "", "m"),
            Column::new("z1", "", "m"),
            Column::new("z_top", "", "m"),
            Column::new("opened", "", "m"),
            Column::new("er_over_e", "", ""),
            Column::new("free_flight", "", "s"),
            Column::new("sigma_landing", "", ""),
        ],
    );
    data.facts = facts(scene, name);
    let contact_time = scene.contact_time();
    for sample in samples {
        data.push([
            sample.time.into(),
            sample.floor.into(),
            sample.heights.first().copied().into(),
            sample.heights.last().copied().into(),
            sample.opened.into(),
            sample.shared.into(),
            sample.flight.into(),
            sample.crossing.zip(contact_time).map(|(c, t)| c / t).into(),
        ]);
    }
    sheet.data.push(data);
    let drawn = || samples.iter().take_while(|s| s.time <= DRAWN * period);
    let line = |get: &dyn Fn(&Sample) -> f64| -> Vec<(f64, f64)> {
        drawn().map(|s| (s.time / period, 1e3 * get(s))).collect()
    };
    let mut series = vec![Series::new("plate", line(&|s| s.floor)).with(Look::Line)];
    for bead in 0..scene.n {
        let points = line(&|s| s.heights[bead]);
        series.push(Series::new(format!("{}", bead + 1), points).with(Look::Line));
    }
    sheet.plots.push(Plot {
        name: name.to_owned(),
        title: format!("Fig. {short}: reduced heights"),
        x: Axis::linear("t f (periods)"),
        y: Axis::linear("z_i (mm)"),
        series,
    });
    if name == "fig6a" {
        return;
    }
    let ratio = |get: &dyn Fn(&Sample) -> Option<f64>| -> Vec<(f64, f64)> {
        let all = samples.iter();
        all.filter_map(|s| Some((s.time / period, get(s)?)))
            .collect()
    };
    let sigma = ratio(&|s| s.crossing.zip(contact_time).map(|(c, t)| c / t));
    sheet.plots.push(Plot {
        name: format!("{name}-sigma"),
        title: format!("Fig. {short}: E_r/E and σ of the last landing"),
        x: Axis::linear("t f (periods)"),
        y: Axis::log("E_r/E, σ"),
        series: vec![
            Series::new("σ", sigma).with(Look::Line),
            Series::new("E_r/E", ratio(&|s| s.shared)).with(Look::Line),
        ],
    });
}
