//! Fig. 1: trajectories of ten beads that meet a floor.

use super::pool::RunPool;
use super::runs::{looks, preset, results};
use super::{Claim, FigureError, Sheet};
use crate::physics::Observation;
use crate::scene::{MethodName, Scene};
use crate::study::accuracy::facts;
use crate::study::plot::{Axis, Plot, Series, SeriesStyle};
use crate::study::table::{Column, Table};

/// A panel: its letter, method, the other method's panel, what is drawn of it, s.
struct Panel {
    letter: char,
    method: MethodName,
    other: char,
    end: f64,
}

const PANELS: [Panel; 6] = [
    panel('a', MethodName::Exact, 'd', 2e-4),
    panel('b', MethodName::Exact, 'e', 2e-4),
    panel('c', MethodName::Exact, 'f', 1e-3),
    panel('d', MethodName::Ed, 'a', 2e-4),
    panel('e', MethodName::Ed, 'b', 2e-4),
    panel('f', MethodName::Ed, 'c', 1e-3),
];

const fn panel(letter: char, method: MethodName, other: char, end: f64) -> Panel {
    Panel {
        letter,
        method,
        other,
        end,
    }
}

/// Points of a trajectory.
const POINTS: (u32, u32) = (200, 1000);

/// What a collision of ten beads ends in.
struct End {
    eps_eff: f64,
    shared: f64,
    /// Mean velocity at the end, m/s.
    away: f64,
    /// Neighbours of which the upper does not move away faster than those below do.
    disorder: f64,
}

/// The sheet of a panel.
pub(super) fn sheet(letter: char, pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let find = |letter: char| PANELS.iter().find(|panel| panel.letter == letter);
    let mut sheet = Sheet::default();
    let Some((this, other)) = find(letter).and_then(|p| Some((p, find(p.other)?))) else {
        return Ok(sheet);
    };
    let scenes = [scene(this)?, scene(other)?];
    let ends = pool.each(&scenes, end)?;
    sheet.claims = claims(letter, &ends[0], &ends[1]);
    let count = pool.pick(POINTS.0, POINTS.1);
    trajectories(this, &scenes[0], count, &mut sheet)?;
    sheet.notes.push(format!(
        "{} Reduced heights z_i = 0 when the column just touches (Eq. (9) prints N - 1 for \
         i - 1).",
        match this.method {
            MethodName::Ed => "Hard spheres, largest relative velocity first.",
            _ => "Soft contacts by the exact method.",
        }
    ));
    Ok(sheet)
}

fn scene(panel: &Panel) -> Result<Scene, FigureError> {
    preset(&format!("fig1{}", panel.letter), Some(panel.method), &[])
}

fn end(scene: &Scene) -> Result<End, FigureError> {
    let results = results(scene)?;
    let mut last = Observation::default();
    looks(scene, results.sim_time, 1, |seen| last.clone_from(seen))?;
    let rates: Vec<f64> = last.velocities.windows(2).map(|v| v[1] - v[0]).collect();
    // In order: what parts above parts no faster than what parts below, or no slower.
    let turns = rates
        .windows(3)
        .filter(|r| (r[1] - r[0]) * (r[2] - r[1]) < 0.0);
    Ok(End {
        eps_eff: results.eps_eff.unwrap_or(f64::NAN),
        shared: results.er_over_ef.unwrap_or(f64::NAN),
        away: last.velocities.iter().sum::<f64>() / last.velocities.len() as f64,
        disorder: turns.count() as f64,
    })
}

/// What the paper says of soft beads that start close together.
fn detached(here: &End, other: &End) -> [Claim; 2] {
    let away = here.away / other.away;
    [
        Claim::least("c.m. velocity over that of ED", "larger", away, 1.0),
        Claim::least(
            "turns in the separation rates",
            "disordered",
            here.disorder,
            1.0,
        ),
    ]
}

fn claims(letter: char, here: &End, other: &End) -> Vec<Claim> {
    match letter {
        'a' => {
            let shared = Claim::near("E_r/E_f (Sec. IV A)", 0.035, here.shared, 0.05);
            std::iter::once(shared)
                .chain(detached(here, other))
                .collect()
        }
        'b' => detached(here, other).into(),
        'c' => vec![Claim::most(
            "eps_eff off that of ED",
            "similar",
            (here.eps_eff - other.eps_eff).abs(),
            0.002,
        )],
        _ => vec![
            Claim::off("eps_eff, hard spheres", 0.341, here.eps_eff, 0.002),
            Claim::most(
                "turns in the separation rates",
                "ordered",
                here.disorder,
                0.0,
            ),
        ],
    }
}

fn trajectories(
    panel: &Panel,
    scene: &Scene,
    count: u32,
    sheet: &mut Sheet,
) -> Result<(), FigureError> {
    let name = format!("1{}", panel.letter);
    let mut data = Table::new(
        format!("fig{name}"),
        format!("Fig. 1({}): reduced heights over time", panel.letter),
        [
            Column::new("time", "", "s"),
            Column::new("bead", "", ""),
            Column::new("z", "", "m"),
            Column::new("velocity", "", "m/s"),
        ],
    );
    data.facts = facts(scene, &format!("fig{name}"));
    let mut lines = vec![Vec::new(); scene.n];
    looks(scene, panel.end, count, |seen| {
        for (bead, (&z, &v)) in seen.reduced.iter().zip(&seen.velocities).enumerate() {
            let number = (bead + 1) as u64;
            data.push([seen.time.into(), number.into(), z.into(), v.into()]);
            lines[bead].push((1e6 * seen.time, 1e6 * z));
        }
    })?;
    sheet.data.push(data);
    sheet.plots.push(Plot {
        name: format!("fig{name}"),
        title: format!(
            "Fig. 1({}): {}, s_0 = {} m",
            panel.letter,
            if panel.method == MethodName::Ed {
                "ED"
            } else {
                "MD"
            },
            match panel.letter {
                'a' | 'd' => "0",
                'b' | 'e' => "1e-6",
                _ => "1e-5",
            }
        ),
        x: Axis::linear("t (µs)"),
        y: Axis::linear("z_i (µm)"),
        series: lines
            .into_iter()
            .enumerate()
            .map(|(bead, line)| Series::new(format!("{}", bead + 1), line).with(SeriesStyle::Line))
            .collect(),
    });
    Ok(())
}
