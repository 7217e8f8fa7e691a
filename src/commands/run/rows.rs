//! What a run prints, row by row.

use super::report::{Cell, Report, Row};
use super::runs::Runs;
use crate::commands::{Failure, note};
use crate::physics;
use crate::scene::{Arrangement, Law, MethodName, Preset, Scene};
use crate::study::verdict::{Verdict, verdict};
use crate::study::{self, Drive, PATTERNS, Results, Sensitivity, is_cheap};
use std::ops::ControlFlow;
use std::time::Instant;

/// Runs the scene to its end.
pub(super) fn measure(
    preset: &Preset,
    sensitivity: bool,
    runs: &mut Runs,
) -> Result<Report, Failure> {
    let scene = &preset.scene;
    let started = Instant::now();
    let mut look = |time| {
        runs.show(time);
        ControlFlow::Continue(())
    };
    let results = study::measure(scene, &mut Drive::new(scene, &mut look))?;
    let wall_time = started.elapsed().as_secs_f64().max(1e-9);
    let patterns = patterns(scene, &results, sensitivity);
    let sensitivity = study::sensitivity(scene, &results, patterns, &mut look)?;
    for remark in results.remarks() {
        note(&remark);
    }
    runs.show_verdict();
    let judged = verdict(scene, &mut |_| ControlFlow::Continue(()))?;
    let mut rows = rows(preset, &results, &sensitivity, wall_time);
    rows.extend(of_the_verdict(judged));
    let report = Report {
        title: preset.title.clone(),
        rows,
        wall_time,
    };
    report.check()?;
    Ok(report)
}

/// How many patterns of last bits are tried.
fn patterns(scene: &Scene, results: &Results, asked: bool) -> usize {
    if asked {
        PATTERNS
    } else {
        usize::from(is_cheap(scene, results))
    }
}

/// All fields in their order: the scene's, then what was results.
fn rows(preset: &Preset, results: &Results, sensitivity: &Sensitivity, wall_time: f64) -> Vec<Row> {
    let sim_time = results.sim_time;
    let mut rows = of_the_scene(preset);
    rows.extend(of_the_lattice(&preset.scene));
    let known = sensitivity.known(&preset.scene, results);
    rows.extend(of_the_run(&preset.scene, results, sensitivity, &known));
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
    let start = scene.launch().map(|launch| (launch.s0, launch.v0));
    let law = scene.law();
    let power = law.as_ref().and_then(Law::power);
    // Under a power law these depend on the speed.
    let (of_two, of_one, lasting) = if power.is_some() {
        (
            "of two beads at the scene's own speed",
            "of a bead on the floor at that speed",
            "of two beads at that speed, undamped",
        )
    } else {
        ("of two beads", "of a bead on the floor", "of two beads")
    };
    let [lowest, highest] = of_unequal_beads(scene);
    let word = |text: &str| Some(Cell::Word(text.to_owned()));
    let number = |x: f64| Some(Cell::Number(x));
    vec![
        Row::new("preset", word(&preset.name), "", ""),
        Row::new("method", word(method.as_str()), "", method.meaning()),
        Row::new(
            "law",
            law.map(|law| Cell::Word(law.name().as_str().to_owned())),
            "",
            law.map_or("", |law| law.name().meaning()),
        ),
        Row::new(
            "beta",
            power.map(|power| Cell::Number(power.exponents.beta())),
            "",
            "elastic force x^(1+beta)",
        ),
        Row::new(
            "gamma",
            power.map(|power| Cell::Number(power.exponents.gamma())),
            "",
            "dissipative force x^gamma dx/dt",
        ),
        Row::new(
            "stiffness",
            power.map(|power| Cell::Number(power.stiffness)),
            "SI",
            "K/m, m being the reduced mass of two beads",
        ),
        Row::new(
            "damping",
            power.map(|power| Cell::Number(power.damping)),
            "SI",
            "D_n",
        ),
        Row::new("n", Some(Cell::Count(scene.n as u64)), "", "beads"),
        Row::new("restitution", number(scene.restitution), "", of_two),
        Row::new(
            "floor_restitution",
            number(physics::floor_restitution(scene)),
            "",
            of_one,
        ),
        lowest,
        highest,
        Row::new(
            "contact_time",
            scene.contact_time().map(Cell::Number),
            "s",
            lasting,
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

/// The least and the largest restitution of two neighbours that are not alike.
fn of_unequal_beads(scene: &Scene) -> [Row; 2] {
    let range = physics::restitution_range(scene);
    [
        Row::new(
            "restitution_min",
            range.map(|(least, _)| Cell::Number(least)),
            "",
            "least of two neighbours, which share one spring",
        ),
        Row::new(
            "restitution_max",
            range.map(|(_, most)| Cell::Number(most)),
            "",
            "the largest",
        ),
    ]
}

/// What only a lattice has.
fn of_the_lattice(scene: &Scene) -> Vec<Row> {
    let (Arrangement::Lattice { tangential, .. }, Some(sites)) = (scene.arrangement, scene.sites())
    else {
        return Vec::new();
    };
    let count = |k: usize| Some(Cell::Count(k as u64));
    vec![
        Row::new("rows", count(sites.rows), "", "of the lattice"),
        Row::new("columns", count(sites.columns), "", "beads in a row"),
        Row::new(
            "tangential_damping",
            Some(Cell::Number(tangential)),
            "1/s",
            "D_t, across contacts",
        ),
    ]
}

/// The verdict on soft contacts, and why; only why where there is none.
fn of_the_verdict(judged: Verdict) -> [Row; 2] {
    let word = judged.word.map(|word| Cell::Word(word.as_str().to_owned()));
    let why = Some(Cell::Word(judged.because));
    [
        Row::new(
            "verdict",
            word,
            "",
            "on soft contacts, against hard spheres",
        ),
        Row::new("verdict_why", why, "", ""),
    ]
}

fn of_the_run(
    scene: &Scene,
    results: &Results,
    measured: &Sensitivity,
    known: &Sensitivity,
) -> Vec<Row> {
    let soft = scene.is_md();
    let number = |x: Option<f64>| x.map(Cell::Number);
    let rough = |name, x, unit, meaning| Row::new(name, number(x), unit, meaning).known_to(ROUGHLY);
    let mut rows = vec![
        Row::new("eps_eff", number(results.eps_eff), "", "sqrt(E_f/E_0)").known_to(known.eps_eff),
        Row::new(
            "er_over_ef",
            number(results.er_over_ef),
            "",
            "share of E_f that is relative motion",
        )
        .known_to(known.er_over_ef),
        Row::new(
            "contact_duration",
            number(results.contact_duration),
            "s",
            "the floor's, from first touch to last",
        )
        .known_to(known.contact_duration),
        Row::new(
            "h_cm_mean",
            number(results.h_cm_mean),
            "m",
            "height of the centre of mass, mean of the last 90 %",
        )
        .known_to(known.h_cm_mean),
        rough("h_cm_error", results.h_cm_error, "m", "its error"),
        Row::new(
            "er_over_e_mean",
            number(results.er_over_e_mean),
            "",
            "mean E_r over mean E, of the last 90 %",
        )
        .known_to(known.er_over_e_mean),
        rough("er_over_e_error", results.er_over_e_error, "", "its error"),
        Row::new(
            "sigma",
            number(results.sigma),
            "",
            "mean free flight over contact_time",
        )
        .known_to(known.sigma),
        rough(
            "overlap_max",
            results.overlap_max,
            "",
            "deepest overlap seen, over the diameter",
        ),
        rough(
            "energy_drift",
            Some(results.energy_drift),
            "",
            "what the ledger misses: no error of results",
        ),
        rough(
            "step_error",
            measured.step,
            "",
            "of the main result, by other steps",
        ),
    ];
    rows.extend(of_sensitivity(scene, measured));
    rows.push(Row::new(
        "events",
        (!soft).then_some(Cell::Count(results.events)),
        "",
        "collisions",
    ));
    rows.push(Row::new(
        "steps",
        soft.then_some(Cell::Count(results.steps)),
        "",
        "time steps",
    ));
    rows
}

/// What is printed of a number that is an error itself.
const ROUGHLY: Option<f64> = Some(0.1);

/// What every result is sensitive to: the main one first, then the others by name.
fn of_sensitivity(scene: &Scene, measured: &Sensitivity) -> [Row; 5] {
    let meaning = match scene.method.name() {
        MethodName::Gear | MethodName::Verlet => "relative change by other steps, or a last bit",
        MethodName::Exact if scene.tolerance().is_some() => {
            "relative change by the tolerance, or a last bit"
        }
        MethodName::Exact | MethodName::Ed => "relative change by a last bit of the start",
    };
    let row = |name, part: Option<f64>, meaning| {
        Row::new(name, part.map(Cell::Number), "", meaning).known_to(ROUGHLY)
    };
    [
        row("sensitivity", measured.main(), meaning),
        row(
            "er_over_ef_sensitivity",
            measured.er_over_ef,
            "that of er_over_ef",
        ),
        row(
            "contact_duration_sensitivity",
            measured.contact_duration,
            "that of contact_duration",
        ),
        row(
            "er_over_e_mean_sensitivity",
            measured.er_over_e_mean,
            "that of er_over_e_mean",
        ),
        row("sigma_sensitivity", measured.sigma, "that of sigma"),
    ]
}
