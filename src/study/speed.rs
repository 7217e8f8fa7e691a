//! How fast the engines are on this machine: bead steps and collisions per second.
//!
//! Machines are noisy, so methods take turns, medians count, and ratios within one run.

use super::accuracy::Report;
use super::table::{Cell, Column, Table};
use super::{Tell, vary};
use crate::physics::{Engine, Observation, build};
use crate::scene::parameters::Value;
use crate::scene::{Facts, Launch, MethodName, Preset, Scene, Start};
use std::time::{Duration, Instant};

/// Lengths of the columns.
const BEADS: [usize; 3] = [10, 1000, 10_000];
/// Longest column that is timed in cascades: one of 10 000 beads lands for seconds.
const LONGEST_CASCADE: usize = 1000;
/// Contact time of soft beads that meet two by two, s: so short that no third one comes
/// in between.
const SHORT: f64 = 1e-8;
/// Turns that every case takes, and how long one is.
const TURNS: usize = 7;
const TURN: Duration = Duration::from_millis(40);
/// Bead steps or collisions between two looks at the clock.
const SLICE: u64 = 20_000;

/// What a column does while it is timed.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Activity {
    /// It rests under gravity, all contacts closed.
    Contact,
    /// It flies under gravity, all contacts open.
    Flight,
    /// Elastic beads, far apart, bounce on a floor under gravity for ever, and meet two
    /// by two.
    Pairs,
    /// Elastic beads that touch bounce on a floor under gravity for ever: every landing
    /// is one instant of N(N + 1)/2 collisions.
    Cascades,
}

struct TimedColumn {
    method: MethodName,
    activity: Activity,
    scene: Scene,
    rates: Vec<f64>,
}

/// Times every engine; about ten seconds.
///
/// # Panics
/// Never: the scenes are right, and their engines go on.
pub fn speed(quick: bool, tell: &mut Tell) -> Report {
    let mut cases = cases();
    let turns = if quick { 3 } else { TURNS };
    let all = (turns * cases.len()) as f64;
    for turn in 0..turns {
        let done = turn * cases.len();
        for (k, case) in cases.iter_mut().enumerate() {
            tell(case.method.as_str(), Some((done + k) as f64 / all));
            case.rates.push(rate(&case.scene));
        }
    }
    for case in &mut cases {
        case.rates.sort_by(f64::total_cmp);
    }
    Report {
        tables: vec![table(&cases)],
        plots: Vec::new(),
    }
}

fn cases() -> Vec<TimedColumn> {
    let mut cases = Vec::new();
    for n in BEADS {
        for activity in [Activity::Contact, Activity::Flight] {
            for method in [MethodName::Verlet, MethodName::Gear] {
                cases.push(case(method, activity, n));
            }
        }
        for method in [MethodName::Ed, MethodName::Exact] {
            cases.push(case(method, Activity::Pairs, n));
        }
        if n <= LONGEST_CASCADE {
            cases.push(case(MethodName::Ed, Activity::Cascades, n));
        }
    }
    cases
}

fn case(method: MethodName, activity: Activity, n: usize) -> TimedColumn {
    let preset = Preset::load("fig1b").expect("an embedded preset");
    let n = Value::Whole(n as u64);
    let mut settings = vec![("n", n)];
    if matches!(activity, Activity::Pairs | Activity::Cascades) {
        // Without damping no column collapses or comes to rest.
        settings.push(("restitution", Value::Number(1.0)));
    }
    if method == MethodName::Exact {
        settings.push(("contact_time", Value::Number(SHORT)));
    }
    let scene = vary(&preset.scene, Some(method), &settings).expect("a scene of any length");
    let start = match activity {
        Activity::Contact => Start::Resting,
        Activity::Flight => Start::Launched(Launch {
            s0: 1e-3,
            jitter: false,
            v0: 10.0,
        }),
        Activity::Pairs => Start::Launched(Launch {
            s0: 1e-2,
            jitter: true,
            v0: -0.2,
        }),
        Activity::Cascades => Start::Launched(Launch {
            s0: 0.0,
            jitter: false,
            v0: -0.2,
        }),
    };
    let facts = Facts {
        start,
        gravity: Some(9.81),
        duration: Some(1.0),
        ..scene.facts().clone()
    };
    TimedColumn {
        method,
        activity,
        scene: Scene::new(facts).expect("a scene of that start"),
        rates: Vec::new(),
    }
}

/// Bead steps or collisions of one turn, per second.
fn rate(scene: &Scene) -> f64 {
    let steps = scene.n as u64;
    let slice = match scene.method.name() {
        MethodName::Verlet | MethodName::Gear => (SLICE / steps).max(1),
        MethodName::Ed | MethodName::Exact => SLICE,
    };
    let mut seen = Observation::default();
    let (mut engine, _) = build(scene, None);
    let before = work(scene, &*engine, &mut seen);
    let started = Instant::now();
    while started.elapsed() < TURN && engine.advance(f64::MAX, slice).is_ok() {}
    let time = started.elapsed();
    let count = work(scene, &*engine, &mut seen) - before;
    count as f64 / time.as_secs_f64()
}

/// Bead steps, or collisions, done by an engine.
fn work(scene: &Scene, engine: &dyn Engine, seen: &mut Observation) -> u64 {
    engine.observe(seen);
    match scene.method.name() {
        MethodName::Ed => seen.events,
        // A contact begins and ends.
        MethodName::Exact => seen.events / 2,
        _ => seen.steps * scene.n as u64,
    }
}

fn table(cases: &[TimedColumn]) -> Table {
    let mut table = Table::new(
        "speed",
        "Speed of the engines on this machine, one core",
        vec![
            Column::new("method", "method", ""),
            Column::new("state", "column", ""),
            Column::new("n", "N", ""),
            Column::new("per_second", "per second", ""),
            Column::new("nanoseconds", "each", "ns"),
            Column::new("spread", "spread", ""),
            Column::new("ratio", "ratio", ""),
        ],
    );
    let median = |case: &TimedColumn| case.rates[case.rates.len() / 2];
    for case in cases {
        let first = |other: &&TimedColumn| {
            let ruler = [MethodName::Verlet, MethodName::Ed].contains(&other.method);
            ruler && other.activity == case.activity && other.scene.n == case.scene.n
        };
        let ruler = cases.iter().find(first).map_or(1.0, median);
        let activity = match case.activity {
            Activity::Contact => "in contact",
            Activity::Flight => "in flight",
            Activity::Pairs => "two by two",
            Activity::Cascades => "cascades",
        };
        let rate = median(case);
        let (least, most) = (case.rates[0], case.rates[case.rates.len() - 1]);
        table.push([
            case.method.as_str().into(),
            activity.into(),
            Cell::Count(case.scene.n as u64),
            rate.into(),
            (1e9 / rate).into(),
            ((most - least) / rate).into(),
            (rate / ruler).into(),
        ]);
    }
    table.notes = vec![
        "in contact: a column at rest, in flight: thrown upwards, both under gravity, in bead \
         steps; two by two: elastic beads 10 mm apart bounce on a floor under gravity (t_c 10 ns), \
         cascades: elastic beads that touch do, both in collisions."
            .to_owned(),
        "Medians of turns that the methods take one after another; spread: largest less \
         smallest, over the median; ratio: to verlet, or for collisions to ed."
            .to_owned(),
    ];
    table
}
