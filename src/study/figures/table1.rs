//! Table I, the appendix, and the materials of Sec. III.

use super::pair::{Hit, hit, law};
use super::pool::RunPool;
use super::runs::{decades, largest};
use super::{Claim, FigureError, Sheet};
use crate::math;
use crate::scene::PowerLaw;
use crate::study::fit::slope;
use crate::study::plot::{Axis, Plot, Series};
use crate::study::table::{Column, Table};
use std::f64::consts::PI;

/// β and γ of a row of Table I, and its name.
const ROWS: [(&str, (f64, f64)); 5] = [
    ("0, 0", (0.0, 0.0)),
    ("0, 1/5", (0.0, 0.2)),
    ("1/2, 0", (0.5, 0.0)),
    ("1/2, 1/2", (0.5, 0.5)),
    ("1/2, 1/4", (0.5, 0.25)),
];

/// Speeds: 15 decades, as in the paper, m/s.
const SPEEDS: (f64, f64) = (1e-9, 1e6);

/// K/m of the linear laws and of the others, Sec. IV B, SI.
const STIFFNESS: (f64, f64) = (2e9, 2e12);

/// 1 − ε in the middle of the range: no more than 1e-3 at its ends.
const LOSS: f64 = 3e-5;

/// How near (A1) and (A2) are, as the paper says.
const NEAR: f64 = 1e-3;

/// The row of Table I, and its exponent of t_c, that cannot be.
const MISPRINTED: ((f64, f64), f64) = ((0.5, 0.5), -0.6);
const MISPRINT: &str = "the table (in the copy that was read) has -3/5 here, but Eq. (A2) gives \
                        -beta/(2 + beta) = -1/5, the text says that t_c depends on beta alone, \
                        and the other rows with beta = 1/2 have -1/5";

/// Most markers of a line.
const MARKERS: usize = 31;

/// What is allowed of an exponent, whose law has corrections of the order of 1 − ε.
const EXPONENT: f64 = 2e-3;

pub(super) fn sheet(pool: &mut RunPool) -> Result<Sheet, FigureError> {
    let mut sheet = Sheet::default();
    exponents(pool, &mut sheet)?;
    nearness(pool, &mut sheet)?;
    materials(&mut sheet)?;
    sheet.notes.push(
        "A pair is run as one bead against a floor that acts as a second bead (the same \
         equation), to a tolerance of 1e-12. Exponents stand beside those of Eqs. (A1), (A2) \
         and (A4): x_max 2/(2 + beta), t_c -beta/(2 + beta), 1 - eps (2 gamma - beta)/(2 + beta); \
         Table I has the same but for one."
            .to_owned(),
    );
    Ok(sheet)
}

fn stiffness(beta: f64) -> f64 {
    if beta == 0.0 {
        STIFFNESS.0
    } else {
        STIFFNESS.1
    }
}

fn exponents(pool: &mut RunPool, sheet: &mut Sheet) -> Result<(), FigureError> {
    let speeds = decades(SPEEDS.0, SPEEDS.1, pool.pick(31, 200));
    let middle = (SPEEDS.0 * SPEEDS.1).sqrt();
    let weak = |exponents: (f64, f64)| law(exponents, stiffness(exponents.0), LOSS / PI, middle);
    let jobs: Vec<(usize, f64)> = (0..ROWS.len())
        .flat_map(|row| speeds.iter().map(move |&speed| (row, speed)))
        .collect();
    let hits = pool.each(&jobs, |&(row, speed)| hit(weak(ROWS[row].1), speed))?;
    let mut data = Table::new(
        "table1",
        "Single collisions of a pair, Eq. (8)",
        [
            Column::new("beta", "", ""),
            Column::new("gamma", "", ""),
            Column::new("v0", "", "m/s"),
            Column::new("x_max", "", "m"),
            Column::new("t_c", "", "s"),
            Column::new("loss", "", ""),
            Column::new("x_max_a1", "", "m"),
            Column::new("t_c_a2", "", "s"),
        ],
    );
    data.facts = vec![
        ("scene".to_owned(), "one pair, no gravity".to_owned()),
        ("K/m linear".to_owned(), format!("{:e} s^-2", STIFFNESS.0)),
        (
            "K/m others".to_owned(),
            format!("{:e} s^-2 m^-1/2", STIFFNESS.1),
        ),
        (
            "loss 1 - eps".to_owned(),
            format!("{LOSS:e} at {middle:e} m/s"),
        ),
        ("seed".to_owned(), "none, nothing is random".to_owned()),
    ];
    let (mut depths, mut times) = (Vec::new(), Vec::new());
    for (&(row, speed), found) in jobs.iter().zip(&hits) {
        let law = weak(ROWS[row].1);
        let (depth, time) = (law.penetration(speed), law.contact_time(speed));
        depths.push((found.depth / depth - 1.0).abs());
        times.push((found.contact_time / time - 1.0).abs());
        let (beta, gamma) = ROWS[row].1;
        data.push([
            beta.into(),
            gamma.into(),
            speed.into(),
            found.depth.into(),
            found.contact_time.into(),
            (1.0 - found.restitution).into(),
            depth.into(),
            time.into(),
        ]);
    }
    let of_row = |row: usize, get: fn(&Hit) -> f64| -> Vec<(f64, f64)> {
        let mine = jobs.iter().zip(&hits).filter(|((r, _), _)| *r == row);
        mine.map(|((_, speed), found)| (*speed, get(found)))
            .collect()
    };
    for (row, (name, (beta, gamma))) in ROWS.iter().enumerate() {
        let below = 2.0 + beta;
        for (symbol, paper, get) in [
            ("x_max", 2.0 / below, (|h| h.depth) as fn(&Hit) -> f64),
            ("t_c", -beta / below, |h| h.contact_time),
            ("1-eps", (2.0 * gamma - beta) / below, |h| {
                1.0 - h.restitution
            }),
        ] {
            let points = of_row(row, get);
            let ln = |(x, y): &(f64, f64)| (math::ln(*x), math::ln(*y));
            let logs: Vec<_> = points.iter().map(ln).collect();
            let found = slope(&logs).unwrap_or(f64::NAN);
            if symbol == "t_c" && (*beta, *gamma) == MISPRINTED.0 {
                let what = format!("({name}): t_c over v0, as printed");
                let claim = Claim::off(what, MISPRINTED.1, found, EXPONENT);
                sheet.claims.push(claim.because(MISPRINT));
            }
            sheet.claims.push(Claim::off(
                format!("({name}): {symbol} over v0"),
                paper,
                found,
                EXPONENT,
            ));
        }
    }
    sheet.claims.push(Claim::most(
        "x_max off (A1), weak damping",
        "0.001",
        largest(depths),
        NEAR,
    ));
    sheet.claims.push(Claim::most(
        "t_c off (A2), weak damping",
        "0.001",
        largest(times),
        NEAR,
    ));
    sheet
        .plots
        .push(losses(&|row| of_row(row, |h| 1.0 - h.restitution)));
    sheet.data.push(data);
    Ok(())
}

/// Loss over speed of every row.
fn losses(of_row: &dyn Fn(usize) -> Vec<(f64, f64)>) -> Plot {
    let series = ROWS.iter().enumerate();
    Plot {
        name: "table1".to_owned(),
        title: "Table I: loss of a pair over its speed, weak damping".to_owned(),
        x: Axis::log("v_0 (m/s)"),
        y: Axis::log("1 - ε"),
        series: series
            .map(|(row, (name, _))| {
                let points = of_row(row);
                // Markers that one can tell apart; all points are in the table.
                let every = points.len().div_ceil(MARKERS);
                let thinned = points.into_iter().step_by(every).collect();
                Series::new(format!("β, γ = {name}"), thinned)
            })
            .collect(),
    }
}

/// A pair with that restitution at 1 m/s.
fn damped(exponents: (f64, f64), restitution: f64) -> Result<(PowerLaw, Hit), FigureError> {
    let (mut weak, mut strong) = (0.0, 1.0);
    loop {
        let strength = 0.5 * (weak + strong);
        let law = law(exponents, stiffness(exponents.0), strength, 1.0);
        // Bisected by a quadrature, which is a thousand times cheaper than a run.
        let found = crate::scene::rebound(&law, true, 1.0);
        if strong - weak < 1e-12 {
            return Ok((law, hit(law, 1.0)?));
        }
        if found > restitution {
            weak = strength;
        } else {
            strong = strength;
        }
    }
}

/// Whether (A1) and (A2) hold within 0.1 % "as long as the dissipation is weak (ε > 0.9)".
fn nearness(pool: &mut RunPool, sheet: &mut Sheet) -> Result<(), FigureError> {
    let restitutions = [0.9, 0.95, 0.99, 0.999];
    let laws = [
        ("Hooke", (0.0, 0.0)),
        ("Hertz", (0.5, 0.0)),
        ("HKK", (0.5, 0.5)),
    ];
    let jobs: Vec<(usize, f64)> = (0..laws.len())
        .flat_map(|k| restitutions.map(|restitution| (k, restitution)))
        .collect();
    let found = pool.each(&jobs, |&(k, restitution)| damped(laws[k].1, restitution))?;
    let mut data = Table::new(
        "table1-damped",
        "How far damped pairs are off Eqs. (A1) and (A2), at 1 m/s",
        [
            Column::new("beta", "", ""),
            Column::new("gamma", "", ""),
            Column::new("restitution", "", ""),
            Column::new("x_max_off", "", ""),
            Column::new("t_c_off", "", ""),
        ],
    );
    data.facts = vec![
        (
            "scene".to_owned(),
            "one pair, no gravity, v0 = 1 m/s".to_owned(),
        ),
        ("seed".to_owned(), "none, nothing is random".to_owned()),
    ];
    for (&(k, restitution), (law, hit)) in jobs.iter().zip(&found) {
        let (name, (beta, gamma)) = laws[k];
        let depth = hit.depth / law.penetration(1.0) - 1.0;
        let time = hit.contact_time / law.contact_time(1.0) - 1.0;
        data.push([
            beta.into(),
            gamma.into(),
            hit.restitution.into(),
            depth.into(),
            time.into(),
        ]);
        if restitution == 0.9 || restitution == 0.999 {
            let first_order = "a damped pair penetrates less by a part of the order of \
                               1 - eps, so 0.1 % holds for eps above about 0.998";
            sheet.claims.push(
                Claim::most(
                    format!("{name}, eps {restitution}: x_max off (A1)"),
                    "0.001",
                    depth.abs(),
                    NEAR,
                )
                .because(first_order),
            );
            let slower = "the contact time follows the speed, which damping changes by a part \
                          of the order of 1 - eps; only for the linear law is t_c off by its \
                          square";
            sheet.claims.push(
                Claim::most(
                    format!("{name}, eps {restitution}: t_c off (A2)"),
                    "0.001",
                    time.abs(),
                    NEAR,
                )
                .because(slower),
            );
        }
    }
    sheet.data.push(data);
    Ok(())
}

/// A material of Sec. III B: Young's modulus, N/m², Poisson's ratio, a bead's mass, kg.
struct Material {
    name: &'static str,
    young: f64,
    poisson: f64,
    mass: f64,
    restitution: f64,
    /// The paper's μ, s⁻¹.
    damping: f64,
}

const DIAMETER: f64 = 1.5e-3;

const MATERIALS: [Material; 2] = [
    Material {
        name: "steel",
        young: 2.06e11,
        poisson: 0.28,
        mass: 1.38e-5,
        restitution: 0.9,
        damping: 2.3e4,
    },
    Material {
        name: "aluminium",
        young: 0.71e11,
        poisson: 0.34,
        mass: 0.479e-5,
        restitution: 0.6,
        damping: 1.1e5,
    },
];

fn materials(sheet: &mut Sheet) -> Result<(), FigureError> {
    for material in MATERIALS {
        let name = material.name;
        let modulus = material.young / (3.0 * (1.0 - material.poisson * material.poisson));
        // K = E d^(1−β) over the reduced mass of two beads.
        let stiffness = modulus * DIAMETER.sqrt() / (0.5 * material.mass);
        let hit = hit(law((0.5, 0.0), stiffness, 0.0, 1.0), 1.0)?;
        sheet.claims.push(Claim::near(
            format!("{name}, 1 m/s: t_c (us), Hertz"),
            4.6,
            1e6 * hit.contact_time,
            // "Around 4.6" for aluminium, "less precise".
            0.03,
        ));
        sheet.claims.push(Claim::near(
            format!("{name}, 1 m/s: x_max (um)"),
            1.5,
            1e6 * hit.depth,
            0.05,
        ));
        let linear = PowerLaw::linear(material.restitution, 4.6e-6);
        sheet.claims.push(Claim::near(
            format!("{name}, linear: omega_0 (1e5/s)"),
            6.8,
            1e-5 * linear.stiffness.sqrt(),
            0.02,
        ));
        sheet.claims.push(Claim::near(
            format!("{name}, linear: mu (1e4/s)"),
            (1e-3 * material.damping).round() / 10.0,
            1e-4 * linear.damping,
            0.02,
        ));
    }
    Ok(())
}
