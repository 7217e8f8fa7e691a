//! Fig. 3: ε_eff over N for three laws of contact.

use super::pool::RunPool;
use super::runs::{largest, preset, results, smallest};
use super::{Claim, FigureError, Sheet};
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Scene};
use crate::study::Results;
use crate::study::accuracy::facts;
use crate::study::plot::{Axis, Plot, Series};
use crate::study::table::{Column, Table};

const LAWS: [(&str, &str, MethodName); 4] = [
    ("Hooke", "fig3-hooke", MethodName::Exact),
    ("Hertz", "fig3-hertz", MethodName::Exact),
    ("Hertz-Kuwabara-Kono", "fig3-hkk", MethodName::Exact),
    ("ED, as Hooke", "fig3-hooke", MethodName::Ed),
];

const LENGTHS: [u64; 8] = [1, 2, 5, 10, 20, 50, 100, 200];

/// Lengths of a quick figure, to N = 50: the longest take most of the time.
const SHORT: usize = 6;

fn scene(law: usize, n: u64) -> Result<Scene, FigureError> {
    let (_, name, method) = LAWS[law];
    preset(name, Some(method), &[("n", Value::Whole(n))])
}

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let lengths = &LENGTHS[..pool.pick(SHORT, LENGTHS.len())];
    // The longest columns first: they take longest.
    let jobs: Vec<(usize, u64)> = lengths
        .iter()
        .rev()
        .flat_map(|&n| (0..LAWS.len()).map(move |law| (law, n)))
        .collect();
    let found = pool.each(&jobs, |&(law, n)| results(&scene(law, n)?))?;
    let curve = |law: usize| -> Vec<(f64, f64)> {
        let all = jobs.iter().zip(&found).rev();
        all.filter(|((l, _), _)| *l == law)
            .map(|((_, n), results)| (*n as f64, eps(results)))
            .collect()
    };
    let mut sheet = Sheet::default();
    judge([curve(0), curve(1), curve(2)], &curve(3), &mut sheet);
    let mut data = Table::new(
        "fig3",
        "Fig. 3: effective restitution over the length of the column",
        [
            Column::new("law", "", ""),
            Column::new("n", "", ""),
            Column::new("eps_eff", "", ""),
            Column::new("er_over_ef", "", ""),
        ],
    );
    for (&(law, n), results) in jobs.iter().zip(&found) {
        data.push([
            LAWS[law].0.into(),
            n.into(),
            results.eps_eff.into(),
            results.er_over_ef.into(),
        ]);
    }
    data.facts = facts(&scene(0, 10)?, "fig3-hooke, fig3-hertz, fig3-hkk");
    sheet.data.push(data);
    sheet.plots.push(Plot {
        name: "fig3".to_owned(),
        title: "Fig. 3: columns without gaps, v_0 = 0.05 m/s".to_owned(),
        x: Axis::log("N"),
        y: Axis::linear("ε_eff"),
        series: (0..LAWS.len())
            .map(|law| Series::new(LAWS[law].0, curve(law)))
            .collect(),
    });
    Ok(sheet)
}

fn eps(results: &Results) -> f64 {
    results.eps_eff.unwrap_or(f64::NAN)
}

fn judge(soft: [Vec<(f64, f64)>; 3], hard: &[(f64, f64)], sheet: &mut Sheet) {
    let spread = |curve: &[(f64, f64)]| {
        let values = || curve.iter().map(|p| p.1);
        largest(values()) - smallest(values())
    };
    let rise = smallest(soft[0].windows(2).map(|p| p[1].1 - p[0].1));
    sheet.claims.push(Claim::least(
        "Hooke: least rise with N",
        "increases",
        rise,
        0.0,
    ));
    let [hooke, hertz, hkk] = soft.map(|curve| spread(&curve));
    let grows = "with this law a longer column loses more, and goes on to do so at the largest N";
    sheet.claims.extend([
        Claim::most("Hertz: change over all N", "varies little", hertz, 0.05),
        Claim::most("H.-K.-Kono: change over all N", "varies little", hkk, 0.05).because(grows),
        Claim::most("Hertz over Hooke: change", "weaker", hertz / hooke, 1.0),
        Claim::most("H.-K.-Kono over Hooke: change", "weaker", hkk / hooke, 1.0),
    ]);
    if let Some(long) = hard.last() {
        sheet.claims.push(Claim::most(
            format!("ED: eps_eff at N = {}", long.0),
            "close to 0",
            long.1,
            0.01,
        ));
    }
}
