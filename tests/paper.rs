//! The paper's numbers for a column that hits a fixed floor (DESIGN: N = 10, ε = 0.9,
//! t_c = 0.7e-5 s, v₀ = −0.2 m/s, same-spring floor).

mod support;

use beadlab::scene::{FloorContact, Integrator, Start};
use support::{ED, collide, fig1, md, rebound};

/// s₀, m; converged ε_eff and E_r/E_f of the soft column.
const SOFT: [(f64, f64, f64); 3] = [
    (0.0, 0.966_687, 0.033_859),
    (1e-6, 0.539_255, 0.021_337),
    (1e-5, 0.341_547, 0.016_525),
];
/// ε_eff of the hard column, whatever s₀.
const HARD: f64 = 0.341_547_47;

#[test]
fn soft_columns_rebound_as_converged_runs_do() {
    for (s0, eps_eff, er_over_ef) in SOFT {
        for integrator in [Integrator::Gear, Integrator::Verlet] {
            let (eps, er) = rebound(fig1(md(integrator, 1000.0), s0));
            println!("{integrator:?} {s0}: {eps} {er}");
            // The tolerance at t_c/1000; contact changes fall between steps.
            assert!(
                (eps - eps_eff).abs() < 1e-4,
                "{integrator:?}, s0 {s0}: ε_eff {eps}"
            );
            assert!(
                (er - er_over_ef).abs() < 1e-4,
                "{integrator:?}, s0 {s0}: E_r/E_f {er}"
            );
        }
    }
}

#[test]
fn hard_columns_rebound_alike_whatever_the_separation() {
    for s0 in [0.0, 1e-7, 1e-6, 1e-5, 1e-4, 1e-3, 1e-2] {
        let (eps, er) = rebound(fig1(ED, s0));
        println!("ED {s0}: {eps} {er}");
        assert!((eps - HARD).abs() < 1e-6, "s0 {s0}: ε_eff {eps}");
        assert!((er - 0.0165).abs() < 1e-4, "s0 {s0}: E_r/E_f {er}");
    }
}
