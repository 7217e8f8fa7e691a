//! Long columns without gaps: what Fig. 2(b) and Sec. IV A come to as N grows.
//!
//! Far from its ends a column of touching beads is a string. A spring K = m ω_0²/2 and a
//! dashpot c = m μ between beads of mass m carry waves at ω_0/√2 beads a second, which
//! lose μk² of their energy a second at k radians a bead. The floor stops bead 1, and a
//! step of the velocity, v_0 high, goes up to the free end and comes back as the step that
//! lets go of the floor, after
//!
//!   t_k = 2N √2/ω_0 = N t_c · 2√2/(π √(1 + (ln ε/π)²)).
//!
//! In that time dashpots smooth the step. Its spectrum is v_0²/k², so that it loses
//!
//!   m v_0² ∫ dk/2π (1 − exp(−μk² t_k))/k² = m v_0² √(μ t_k/π)
//!
//! of E_0 = N m v_0²/2. With 1 − ε_eff² = 2(1 − ε_eff) for small losses,
//!
//!   1 − ε_eff = √(2√2 μ/(π ω_0 N)),
//!
//! an exponent of −1/2 for every ε. What the ends add falls as N^(−1/2) beside the loss.

use super::pool::RunPool;
use super::touching::{eps, run, scene};
use super::{Claim, FigureError, Sheet};
use crate::math;
use crate::study::Results;
use crate::study::accuracy::facts;
use crate::study::table::{Column, Table};
use std::f64::consts::{PI, SQRT_2};

/// Restitutions whose columns are long enough to show the limit.
const RESTITUTIONS: [f64; 2] = [0.6, 0.9];

/// Weakly damped columns are far from the limit still: what slope they have by then.
const WEAK: f64 = 0.975;
const PRINTED: f64 = -0.315;

/// ln ε/π, without its sign: μ/ω.
fn damping(restitution: f64) -> f64 {
    -math::ln(restitution) / PI
}

/// 1 − ε_eff of a long column.
fn loss(restitution: f64, n: u64) -> f64 {
    let damping = damping(restitution);
    let part = damping / math::hypot(damping, 1.0);
    (2.0 * SQRT_2 * part / (PI * n as f64)).sqrt()
}

/// t_k/(N t_c) of a long column.
fn duration(restitution: f64) -> f64 {
    2.0 * SQRT_2 / (PI * math::hypot(damping(restitution), 1.0))
}

/// What 1 − ε_eff comes to, for Fig. 2(b), from two lengths.
pub(super) fn losses(pool: &mut RunPool, speed: f64, sheet: &mut Sheet) -> Result<(), FigureError> {
    let lengths = pool.pick([100, 300], [1000, 3000]);
    let (short, long) = pool.pick((100, 300), (300, 1000));
    // The longest first: they take longest.
    let mut jobs = vec![(WEAK, long), (WEAK, short)];
    jobs.extend(RESTITUTIONS.map(|restitution| (restitution, lengths[1])));
    jobs.extend(RESTITUTIONS.map(|restitution| (restitution, lengths[0])));
    let found = pool.each(&jobs, |&(restitution, n)| {
        Ok(1.0 - eps(&run(n, restitution, speed)?))
    })?;
    let of = |job: (f64, u64)| {
        let mine = jobs.iter().zip(&found).find(|(other, _)| **other == job);
        mine.map_or(f64::NAN, |(_, loss)| *loss)
    };
    let mut parts = Vec::new();
    for restitution in RESTITUTIONS {
        let [first, last] = lengths.map(|n| of((restitution, n)) / loss(restitution, n));
        // What is left falls as N^(-1/2).
        let ratio = (lengths[1] as f64 / lengths[0] as f64).sqrt();
        let limit = last + (last - first) / (ratio - 1.0);
        sheet.claims.push(
            Claim::near(
                format!("eps {restitution}: loss/limit for N -> oo"),
                1.0,
                limit,
                0.01,
            )
            .by_theory(),
        );
        parts.push(format!("{first:.3} and {last:.3} at eps = {restitution}"));
    }
    sheet.notes.push(format!(
        "For N -> oo 1 - eps_eff = sqrt(2 sqrt(2) mu/(pi omega_0 N)), a power -1/2 at every eps. \
         Columns of {} and {} beads lose of that {}; what is missing falls as N^(-1/2).",
        lengths[0],
        lengths[1],
        parts.join(", ")
    ));
    let slope =
        math::ln(of((WEAK, long)) / of((WEAK, short))) / math::ln(long as f64 / short as f64);
    sheet.claims.push(
        Claim::off(
            format!("slope, eps {WEAK}, N {short} to {long}"),
            PRINTED,
            slope,
            0.03,
        )
        .because(
            "the slope goes on to grow: -0.315 is what it passes through near N = 100 on its way \
             to -1/2",
        ),
    );
    let mut data = Table::new(
        "fig2b-limits",
        "Long columns without gaps, and their limit",
        [
            Column::new("restitution", "", ""),
            Column::new("n", "", ""),
            Column::new("loss", "", ""),
            Column::new("limit", "", ""),
        ],
    );
    data.facts = facts(&scene(10, 0.9, speed)?, "fig1a with the values of each row");
    for (&(restitution, n), found) in jobs.iter().zip(&found) {
        data.push([
            restitution.into(),
            n.into(),
            (*found).into(),
            loss(restitution, n).into(),
        ]);
    }
    sheet.data.push(data);
    Ok(())
}

/// What t_k comes to, for Sec. IV A.
pub(super) fn times(
    pool: &mut RunPool,
    speed: f64,
    contact_time: f64,
    sheet: &mut Sheet,
) -> Result<(), FigureError> {
    let restitution = 0.9;
    let n = pool.pick(300, 3000);
    let found = pool.each(&[n], |&n| run(n, restitution, speed))?;
    let touching = |results: &Results| results.contact_duration.unwrap_or(f64::NAN);
    let limit = duration(restitution);
    sheet.claims.push(
        Claim::near(
            format!("t_k/(N t_c) of waves, N = {n}"),
            (1e4 * limit).round() / 1e4,
            touching(&found[0]) / (n as f64 * contact_time),
            // A contact time for both ends.
            1.0 / (limit * n as f64),
        )
        .by_theory(),
    );
    Ok(())
}
