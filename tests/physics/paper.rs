//! The paper's numbers for a column that hits a fixed floor (N = 10, ε = 0.9,
//! t_c = 0.7e-5 s, v₀ = −0.2 m/s, same-spring floor).

use crate::scenes::{ED, collide, fig1, md, rebound};
use beadlab::physics::LinearLaw;
use beadlab::scene::{Facts, GridSettings, Integrator, Launch, Law, Method, Soft, Solver, Start};

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
            // Wide enough for t_c/1000; contact changes fall between steps.
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
        assert!((eps - HARD).abs() < 1e-6, "s0 {s0}: ε_eff {eps}");
        assert!((er - 0.0165).abs() < 1e-4, "s0 {s0}: E_r/E_f {er}");
    }
}

#[test]
fn hooke_columns_of_fig_3() {
    // K/m = 2e9 s⁻² (m the reduced mass), D_n = 3.17e3 s⁻¹, s₀ = 0, v₀ = −0.05 m/s.
    let law = LinearLaw::from_stiffness(1e9, 3.17e3).expect("underdamped");
    assert!((law.restitution() - 0.800).abs() < 5e-4);
    // Two digits are known.
    assert!((law.contact_time() / 7.0e-5 - 1.0).abs() < 1e-2);
    for (n, expected) in [(1, 0.85414), (10, 0.94005), (50, 0.96860)] {
        let method = Method::Soft(Soft {
            law: Law::Hooke {
                contact_time: law.contact_time(),
            },
            solver: Solver::Grid(GridSettings {
                integrator: Integrator::Gear,
                steps_per_contact: 1000.0,
            }),
            attraction: true,
        });
        let start = Start::Launched(Launch {
            s0: 0.0,
            jitter: false,
            v0: -0.05,
        });
        let restitution = law.restitution();
        let (eps, _) = rebound(Facts {
            n,
            restitution,
            start,
            ..fig1(method, 0.0)
        });
        // As in the table above: 1e-4 at t_c/1000. A single bead loses only at the two
        // ends of its one contact, a thousandth of it each.
        assert!(
            (eps - expected).abs() < if n == 1 { 1e-3 } else { 1e-4 },
            "N {n}: {eps}"
        );
    }
}

#[test]
fn a_touching_column_stays_on_the_wall_for_n_contact_times() {
    // Sec. IV A: t_k ≈ N t_c.
    for n in [5, 10, 20, 50] {
        let (_, end) = collide(Facts {
            n,
            ..fig1(md(Integrator::Verlet, 200.0), 0.0)
        });
        let stay = end
            .floor_left
            .zip(end.floor_touched)
            .map(|(left, touched)| left - touched);
        let ratio =
            stay.expect("one collision") / (f64::from(u32::try_from(n).expect("small")) * 0.7e-5);
        assert!((0.9..1.15).contains(&ratio), "N {n}: t_k = {ratio} N t_c");
    }
}

#[test]
fn less_is_lost_the_longer_the_column() {
    // Fig. 2(b): log–log slope of 1 − ε_eff over N, −0.5 for ε = 0.6, −0.315 for 0.975.
    for (restitution, slope) in [(0.6, -0.5), (0.975, -0.315)] {
        let loss = |n| {
            1.0 - rebound(Facts {
                n,
                restitution,
                ..fig1(md(Integrator::Verlet, 200.0), 0.0)
            })
            .0
        };
        let found = (loss(100) / loss(50)).ln() / 2_f64.ln();
        // The slope is read off a plot over N = 1 … 100 and reached only at its end.
        assert!(
            (found - slope).abs() < 0.05,
            "ε {restitution}: slope {found}"
        );
    }
}

#[test]
fn relative_energy_grows_with_the_square_of_the_speed() {
    // Sec. IV A: E_r ∝ v₀²: for a touching column ε_eff and E_r/E_f do not know v₀.
    let at = |v0| {
        let start = Start::Launched(Launch {
            s0: 0.0,
            jitter: false,
            v0,
        });
        rebound(Facts {
            start,
            ..fig1(md(Integrator::Gear, 100.0), 0.0)
        })
    };
    let (slow, fast) = (at(-1e-4), at(-10.0));
    assert!((slow.0 - fast.0).abs() < 1e-10 && (slow.1 - fast.1).abs() < 1e-10);
}
