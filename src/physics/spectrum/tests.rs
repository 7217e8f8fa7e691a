//! The spectrum against closed forms, dense matrices and the engines themselves.

use super::*;
use crate::physics::{State, build};
use crate::scene::{Facts, Floor, FloorContact, GridSettings, Law, Method, Soft, Solver, Start};

const CONTACT_TIME: f64 = 1e-5;

fn scene(n: usize, restitution: f64, width: f64, integrator: Integrator, steps: f64) -> Scene {
    Scene::new(Facts {
        arrangement: Arrangement::Column,
        n,
        diameter: 1e-3,
        width,
        seed: 3,
        restitution,
        floor_contact: FloorContact::SameSpring,
        start: Start::Resting,
        gravity: Some(9.81),
        floor: Floor::Fixed,
        method: Method::Soft(Soft {
            law: Law::Hooke {
                contact_time: CONTACT_TIME,
            },
            solver: Solver::Grid(GridSettings {
                integrator,
                steps_per_contact: steps,
            }),
            attraction: true,
        }),
        duration: Some(1.0),
    })
    .expect("a valid scene")
}

fn theory(n: usize, restitution: f64, width: f64, integrator: Integrator) -> f64 {
    let scene = scene(n, restitution, width, integrator, 100.0);
    CONTACT_TIME / largest_stable_step(&scene, integrator).expect("soft contacts")
}

#[test]
fn undamped_verlet_is_stable_up_to_two_over_omega() {
    // One bead: ω = π/(√2 t_c). A long chain: ω = 2√K, √2 π/t_c.
    for (n, omega) in [(1, PI / 2f64.sqrt()), (1000, PI * 2f64.sqrt())] {
        let expected = omega / 2.0;
        let found = theory(n, 1.0, 0.0, Integrator::Verlet);
        // π/(2N+1) from the end of the band at N = 1000: 1.2e-6 of ω. ROUNDING beyond the
        // limit, where the growth is the root of the excess, is less.
        assert!(
            (found / expected - 1.0).abs() < 2e-6,
            "{n}: {found} {expected}"
        );
    }
}

/// Stiffness or dashpot matrix of a closed column, dense.
fn dense(masses: &[f64], springs: &[Spring], constant: impl Fn(&Spring) -> f64) -> DMatrix<f64> {
    let n = masses.len();
    DMatrix::from_fn(n, n, |i, j| {
        let at = |k: usize| springs.get(k).map_or(0.0, &constant);
        let element = match i.abs_diff(j) {
            0 => at(i) + at(i + 1),
            1 => -at(i.max(j)),
            _ => 0.0,
        };
        element / (masses[i] * masses[j]).sqrt()
    })
}

#[test]
fn stiffest_mode_is_that_of_the_dense_matrix() {
    for floor_contact in [FloorContact::SameSpring, FloorContact::SameRestitution] {
        for (n, width) in [(1, 0.0), (2, 0.0), (13, 0.0), (13, 1e-3), (40, 1.9e-3)] {
            let facts = Facts {
                floor_contact,
                ..scene(n, 0.4, width, Integrator::Gear, 100.0)
                    .facts()
                    .clone()
            };
            let scene = Scene::new(facts).expect("a valid scene");
            let masses = masses(&scene);
            let springs = springs(&scene, &masses);
            let largest = |m: DMatrix<f64>| m.symmetric_eigenvalues().max();
            let mode = stiffest_mode(&scene).expect("soft contacts");
            let stiffness = largest(dense(&masses, &springs, |s| s.stiffness));
            let damping = largest(dense(&masses, &springs, |s| s.dashpot));
            // Rounding of a dense eigen-solver, N ε.
            assert!(
                (mode.stiffness / stiffness - 1.0).abs() < 1e-13,
                "{n} {width}"
            );
            assert!((mode.damping / damping - 1.0).abs() < 1e-13, "{n} {width}");
        }
    }
}

/// Whether a column at rest, slightly disturbed, comes back to rest.
fn comes_to_rest(scene: &Scene) -> bool {
    let (mut engine, _) = build(scene, None);
    let mut state: State = engine.state();
    // So little that no contact opens; all modes are in it.
    for (k, rate) in state.rates.iter_mut().enumerate() {
        *rate = 1e-9 * (1.0 + (k as f64 * 1.7).sin());
    }
    let before = state.rates.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    (engine, _) = build(scene, Some(&state));
    let steps = 20_000;
    let Ok(_) = engine.advance(1.0, steps) else {
        return false;
    };
    let after = engine
        .state()
        .rates
        .iter()
        .fold(0.0, |a: f64, b| a.max(b.abs()));
    after < 3.0 * before
}

#[test]
fn engines_break_where_the_spectrum_says() {
    for integrator in [Integrator::Gear, Integrator::Verlet] {
        for n in [1, 2, 7, 30] {
            for restitution in [0.95, 0.6, 0.1, 1e-3] {
                let least = theory(n, restitution, 0.0, integrator);
                let at = |steps: f64| comes_to_rest(&scene(n, restitution, 0.0, integrator, steps));
                // No scene has a grid below 2 steps in a contact time.
                if 0.995 * least < 2.0 {
                    assert!(at(2.0), "{integrator:?} {n} {restitution}: {least}");
                    continue;
                }
                // 20 000 steps show a growth of 10⁻⁴ a step, which half a percent of the
                // step makes; a column that is damped settles on the other side.
                assert!(
                    at(1.005 * least),
                    "{integrator:?} {n} {restitution}: {least}"
                );
                assert!(
                    !at(0.995 * least),
                    "{integrator:?} {n} {restitution}: {least}"
                );
            }
        }
    }
}

#[test]
fn unequal_beads_are_on_the_safe_side() {
    for integrator in [Integrator::Gear, Integrator::Verlet] {
        for restitution in [0.9, 0.3] {
            let least = theory(12, restitution, 1.5e-3, integrator);
            let at = |steps: f64| comes_to_rest(&scene(12, restitution, 1.5e-3, integrator, steps));
            assert!(at(1.005 * least), "{integrator:?} {restitution}: {least}");
            // Both extremes taken for one mode cost less than a third.
            assert!(!at(0.67 * least), "{integrator:?} {restitution}: {least}");
        }
    }
}

#[test]
fn only_coarse_grids_are_warned_of() {
    let least = theory(10, 0.1, 0.0, Integrator::Gear);
    let at = |steps| too_few_steps(&scene(10, 0.1, 0.0, Integrator::Gear, steps));
    assert_eq!(at(1.01 * least), None);
    assert!(at(0.99 * least).is_some_and(|found| (found / least - 1.0).abs() < 1e-9));
    // The paper's t_c/100 at its own ε.
    assert_eq!(
        too_few_steps(&scene(10, 0.6, 0.0, Integrator::Gear, 100.0)),
        None
    );
    let exact =
        scene(10, 0.6, 0.0, Integrator::Gear, 2.0).with_method(crate::scene::MethodName::Exact);
    assert_eq!(too_few_steps(&exact.expect("a scene")), None);
}

#[test]
fn the_stiffest_wave_of_a_triangular_lattice() {
    // |D(k)| = Σ 2K (1 − cos k·R) n nᵀ over the three directions of bonds, K = 1: the
    // largest eigenvalue over all wave vectors is 6.
    let directions = [0.0, PI / 3.0, 2.0 * PI / 3.0].map(|angle: f64| angle.sin_cos());
    let largest = |kx: f64, ky: f64| {
        let (mut xx, mut xy, mut yy) = (0.0, 0.0, 0.0);
        for (y, x) in directions {
            let weight = 2.0 * (1.0 - (kx * x + ky * y).cos());
            (xx, xy, yy) = (
                xx + weight * x * x,
                xy + weight * x * y,
                yy + weight * y * y,
            );
        }
        0.5 * (xx + yy) + (0.25 * (xx - yy) * (xx - yy) + xy * xy).sqrt()
    };
    let grid = || (0..=120).map(|k| f64::from(k) * 2.0 * PI / 120.0);
    let most = grid()
        .flat_map(|kx| grid().map(move |ky| largest(kx, ky * 2.0 / 3f64.sqrt())))
        .fold(0.0, f64::max);
    assert!((most - 6.0).abs() < 1e-12, "{most}");
    let springs = [Spring::linear(1.0, 0.5), Spring::linear(1.0, 0.5)];
    let mode = lattice_mode(&springs, 0.25);
    assert_eq!((mode.stiffness, mode.damping), (6.0, 4.5));
}
