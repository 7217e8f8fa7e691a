//! A run from start to end, and what it measures.

use super::drive::Drive;
use super::report::{Cell, Report, Row};
use crate::commands::Failure;
use crate::physics::{self, Observation};
use crate::scene::{Preset, Scene, Start, diameters};
use std::io::{self, Write};
use std::time::Instant;

/// Looks at the centre of mass in a plate period.
const LOOKS_IN_A_PERIOD: f64 = 200.0;

/// So many looks are enough for any mean.
const MOST_LOOKS: f64 = 1e6;

/// The beginning of a run, which still depends on how it started.
const SETTLING: f64 = 0.1;

/// A ledger that is off by more belongs to a run that has lost its physics.
const UNTRUSTED: f64 = 0.1;

/// What a run gives besides the last moment.
#[derive(Default)]
struct Measured {
    eps_eff: Option<f64>,
    er_over_ef: Option<f64>,
    contact_duration: Option<f64>,
    h_cm_mean: Option<f64>,
}

/// Runs the scene to its end.
pub(super) fn measure(preset: &Preset, mut drive: Drive) -> Result<Report, Failure> {
    let scene = &preset.scene;
    let started = Instant::now();
    let mut last = Observation::default();
    let measured = match (scene.gravity, scene.duration) {
        (Some(gravity), Some(duration)) => {
            let looks = interval(scene, gravity);
            let h_cm_mean = Some(mean_height(scene, &mut drive, duration, looks, &mut last)?);
            Measured {
                h_cm_mean,
                ..Measured::default()
            }
        }
        _ => floor_collision(scene, &mut drive, &mut last)?,
    };
    if last.energy.drift.abs() > UNTRUSTED {
        note(&format!(
            "the energy ledger is off by {:.0} %, so these numbers are not to be trusted",
            100.0 * last.energy.drift.abs()
        ));
    }
    let wall_time = started.elapsed().as_secs_f64().max(1e-9);
    let report = Report {
        title: preset.title.clone(),
        rows: rows(preset, &measured, &last, drive.time(), wall_time),
        wall_time,
    };
    report.check()?;
    Ok(report)
}

/// A remark on standard error, where it does not mix with the results.
fn note(remark: &str) {
    let _ = writeln!(io::stderr(), "beadlab: note: {remark}");
}

/// A collision with the floor without gravity.
fn floor_collision(
    scene: &Scene,
    drive: &mut Drive,
    last: &mut Observation,
) -> Result<Measured, Failure> {
    drive.observe(last);
    let before = last.energy.kinetic;
    let over = drive.collide(scene)?;
    drive.observe(last);
    if !over {
        note(&format!(
            "the floor collision is not over at {:e} s, so it has no eps_eff yet",
            drive.time()
        ));
        return Ok(Measured::default());
    }
    let after = last.energy.kinetic;
    Ok(Measured {
        eps_eff: Some((after / before).sqrt()),
        // Of a column that has come to rest nobody can say how its energy is shared.
        er_over_ef: (after > 0.0).then(|| last.energy.relative / after),
        contact_duration: last
            .floor_left
            .zip(last.floor_touched)
            .map(|(left, touched)| left - touched),
        h_cm_mean: None,
    })
}

/// Time between two looks at the centre of mass, s: a part of the plate's period,
/// or of the time in which a bead falls by its diameter.
fn interval(scene: &Scene, gravity: f64) -> f64 {
    let period = scene
        .period()
        .unwrap_or_else(|| (2.0 * scene.diameter / gravity).sqrt());
    period / LOOKS_IN_A_PERIOD
}

/// Runs for the whole duration. Mean absolute height of the centre of mass, m,
/// over its last nine tenths.
fn mean_height(
    scene: &Scene,
    drive: &mut Drive,
    duration: f64,
    interval: f64,
    last: &mut Observation,
) -> Result<f64, Failure> {
    let begin = SETTLING * duration;
    let looks = ((duration - begin) / interval)
        .ceil()
        .clamp(1.0, MOST_LOOKS);
    drive.advance(begin)?;
    let mut sum = 0.0;
    let mut look = 0.0;
    while look < looks {
        look += 1.0;
        let until = begin + (duration - begin) * (look / looks);
        drive.advance(until.min(duration))?;
        drive.observe(last);
        sum += last.centre;
    }
    Ok(sum / looks + stacking_height(scene))
}

/// Height of the centre of mass of the column that rests, just touching, on z = 0, m.
fn stacking_height(scene: &Scene) -> f64 {
    let (mut top, mut mass, mut moment) = (0.0, 0.0, 0.0);
    for d in diameters(scene) {
        // Relative to the mean bead, so that no diameter is too small.
        let m = (d / scene.diameter).powi(3);
        mass += m;
        moment += m * (top + d / 2.0);
        top += d;
    }
    moment / mass
}

/// All fields in their order: the scene's, then what was measured.
fn rows(
    preset: &Preset,
    measured: &Measured,
    last: &Observation,
    sim_time: f64,
    wall_time: f64,
) -> Vec<Row> {
    let mut rows = of_the_scene(preset);
    rows.extend(of_the_run(&preset.scene, measured, last));
    rows.push(Row::new(
        "sim_time",
        Some(Cell::Number(sim_time)),
        "s",
        "simulated",
    ));
    rows.push(Row::of_the_machine("wall_time", wall_time, "s", "taken"));
    rows.push(Row::of_the_machine(
        "speed",
        sim_time / wall_time,
        "",
        "sim_time/wall_time",
    ));
    rows
}

fn of_the_scene(preset: &Preset) -> Vec<Row> {
    let scene = &preset.scene;
    let method = scene.method.name();
    let start = match scene.start {
        Start::Separated { s0, v0, .. } => Some((s0, v0)),
        Start::Resting => None,
    };
    let word = |text: &str| Some(Cell::Word(text.to_owned()));
    let number = |x: f64| Some(Cell::Number(x));
    vec![
        Row::new("preset", word(&preset.name), "", ""),
        Row::new("method", word(method.as_str()), "", method.meaning()),
        Row::new(
            "law",
            scene.is_md().then(|| Cell::Word("hooke".into())),
            "",
            "linear spring and dashpot",
        ),
        Row::new("n", Some(Cell::Count(scene.n as u64)), "", "beads"),
        Row::new("restitution", number(scene.restitution), "", "of two beads"),
        Row::new(
            "floor_restitution",
            number(physics::floor_restitution(scene)),
            "",
            "of a bead on the floor",
        ),
        Row::new(
            "contact_time",
            scene.contact_time().map(Cell::Number),
            "s",
            "of two beads",
        ),
        Row::new(
            "v0",
            start.map(|(_, v0)| Cell::Number(v0)),
            "m/s",
            "velocity at the start",
        ),
        Row::new(
            "s0",
            start.map(|(s0, _)| Cell::Number(s0)),
            "m",
            "separation at the start",
        ),
        Row::new(
            "sigma0",
            scene.sigma0().map(Cell::Number),
            "",
            "s0/(|v0| contact_time)",
        ),
    ]
}

fn of_the_run(scene: &Scene, measured: &Measured, last: &Observation) -> Vec<Row> {
    let sigma = last
        .free_flight
        .zip(scene.contact_time())
        .map(|(flight, t_c)| flight / t_c);
    let soft = scene.is_md();
    vec![
        Row::new(
            "eps_eff",
            measured.eps_eff.map(Cell::Number),
            "",
            "sqrt(E_f/E_0)",
        ),
        Row::new(
            "er_over_ef",
            measured.er_over_ef.map(Cell::Number),
            "",
            "share of E_f that is relative motion",
        ),
        Row::new(
            "contact_duration",
            measured.contact_duration.map(Cell::Number),
            "s",
            "the floor's, from first touch to last",
        ),
        Row::new(
            "h_cm_mean",
            measured.h_cm_mean.map(Cell::Number),
            "m",
            "height of the centre of mass, mean of the last 90 %",
        ),
        Row::new(
            "sigma",
            sigma.map(Cell::Number),
            "",
            "mean free flight over contact_time",
        ),
        Row::new(
            "energy_drift",
            Some(Cell::Number(last.energy.drift)),
            "",
            "relative error of the ledger",
        ),
        Row::new(
            "events",
            (!soft).then_some(Cell::Count(last.events)),
            "",
            "collisions",
        ),
        Row::new(
            "steps",
            soft.then_some(Cell::Count(last.steps)),
            "",
            "time steps",
        ),
    ]
}
