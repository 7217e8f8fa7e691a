//! Means over time are integrals of the motion: compared with closed forms and with other
//! rules of quadrature.

use std::f64::consts::{PI, TAU};
use std::ops::ControlFlow;

use crate::scenes::{ED, G, engine, exact, hard_scenes, look, shaken, soft};
use beadlab::physics::{Engine, Observation};
use beadlab::scene::{Facts, FloorContact, Integrator, Scene};
use beadlab::study::{Drive, Results, measure};

fn measured(facts: Facts) -> Results {
    let scene = Scene::new(facts).expect("a valid scene");
    let mut watch = |_| ControlFlow::Continue(());
    measure(&scene, &mut Drive::new(&scene, &mut watch)).expect("a sound run")
}

/// A ball that never bounces.
fn inelastic(alpha: f64, duration: f64) -> Facts {
    Facts {
        n: 1,
        restitution: 0.0,
        floor_contact: FloorContact::SameRestitution,
        duration: Some(duration),
        ..shaken(ED, alpha)
    }
}

/// Mean height of that ball over the last 90 %: it rides until sin θ = 1/α, or leaves at
/// once where the plate falls faster than it; the end of a flight is found by bisection.
fn mean_height(alpha: f64, duration: f64) -> f64 {
    let omega = TAU * 20.0;
    let a = alpha * G / (omega * omega);
    let leaves = (1.0 / alpha).asin();
    let from = 0.1 * duration;
    let (mut t, mut sum) = (0.0_f64, 0.0);
    // Of the part of [t, end] in the window, of an integral since t.
    let mut add = |t: f64, end: f64, integral: &dyn Fn(f64) -> f64| {
        let (low, high) = (t.max(from), end.min(duration));
        if high > low {
            sum += integral(high - t) - integral(low - t);
        }
    };
    while t < duration {
        let phase = (omega * t).rem_euclid(TAU);
        let falls_away = phase >= leaves - 1e-12 && phase < PI - leaves;
        let start = if falls_away {
            t
        } else {
            t + (leaves - phase).rem_euclid(TAU) / omega
        };
        // ∫ a sin, as a product: a difference of cosines loses digits late in the run.
        let ridden = |tau: f64| {
            let half = 0.5 * omega * tau;
            2.0 * a / omega * half.sin() * (omega * t + half).sin()
        };
        add(t, start, &ridden);
        let (sin, cos) = (omega * start).sin_cos();
        let (z, v) = (a * sin, a * omega * cos);
        let gap = |tau: f64| z + (v - 0.5 * G * tau) * tau - a * (omega * (start + tau)).sin();
        let step = 1e-4 / 20.0;
        // The first steps off the plate are below rounding.
        let mut tau = 20.0 * step;
        while gap(tau) > 0.0 {
            tau += step;
        }
        let (mut low, mut high) = (tau - step, tau);
        for _ in 0..80 {
            let middle = 0.5 * (low + high);
            if gap(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        add(start, start + high, &|tau| {
            tau * (z + tau * (0.5 * v - G * tau / 6.0))
        });
        t = start + high;
    }
    sum / (duration - from) + 0.5e-3
}

#[test]
fn the_mean_height_of_a_ball_that_never_bounces() {
    // The number that an independent reference gave, to all its digits.
    let known = measured(inelastic(2.0, 10.0)).h_cm_mean.expect("a mean");
    assert!((known - 0.001_071_115_072_03).abs() < 5e-15, "{known}");
    // Up to the window, at α = √(1 + π²) = 3.2969, in which it leaves again at once, and
    // beyond.
    for alpha in [1.1, 1.5, 2.0, 2.7, 3.2968, 3.2970, 3.4, 3.6, 4.0, 4.5] {
        let results = measured(inelastic(alpha, 10.0));
        let (found, truth) = (results.h_cm_mean.expect("a mean"), mean_height(alpha, 10.0));
        // The times of 200 take-offs are rounded to 2⁻⁵³ of 10 s, heights to that times
        // the speed.
        assert!(
            (found / truth - 1.0).abs() < 1e-12,
            "α {alpha}: {found} {truth}"
        );
        assert_eq!(results.er_over_e_mean, Some(0.0));
    }
}

/// Nodes and weights of Gauss's rule of five points on [0, 1].
const GAUSS: [(f64, f64); 5] = [
    (0.046_910_077_030_668_004, 0.118_463_442_528_094_54),
    (0.230_765_344_947_158_45, 0.239_314_335_249_683_24),
    (0.5, 0.284_444_444_444_444_44),
    (0.769_234_655_052_841_5, 0.239_314_335_249_683_24),
    (0.953_089_922_969_332, 0.118_463_442_528_094_54),
];

/// ∫ z, ∫ v² and ∫ E_r over time, by Gauss's rule between events.
fn between_events(engine: &mut dyn Engine, end: f64, most_events: usize) -> [f64; 3] {
    let mut sums = [0.0; 3];
    for _ in 0..most_events {
        let from = engine.time();
        if from >= end {
            break;
        }
        // A thirtieth of a period: five nodes leave 10⁻¹⁶ of a sine.
        let panel = from + 1.0 / 600.0;
        let to = engine.next_event().unwrap_or(end).min(panel).min(end);
        for (node, weight) in GAUSS {
            engine
                .advance(from + node * (to - from), u64::MAX)
                .expect("a sound run");
            let seen = look(engine);
            let weight = weight * (to - from);
            sums[0] += weight * seen.centre;
            sums[1] += weight * seen.centre_velocity.powi(2);
            sums[2] += weight * seen.energy.relative;
        }
        engine.advance(to, u64::MAX).expect("a sound run");
    }
    sums
}

#[test]
fn hard_columns_have_their_integrals_in_closed_form() {
    for (name, facts) in hard_scenes() {
        if facts.gravity.is_none() {
            assert_eq!(look(&*engine(facts)).integrals, None, "{name}");
            continue;
        }
        let mut engine = engine(facts);
        let sums = between_events(&mut *engine, 0.4, 20_000);
        let seen = look(&*engine);
        let integrals = seen.integrals.expect("under gravity");
        let energies = integrals.energies.expect("of hard columns");
        let found = [integrals.height, energies.squares, energies.relative];
        let scales = [
            sums[0].abs().max(1e-6),
            sums[1],
            // Of a column that flies as one E_r is rounding.
            sums[2].max(1e-5 * sums[1]),
        ];
        for ((sum, found), scale) in sums.into_iter().zip(found).zip(scales) {
            // 20 000 events, each with some roundings of E and of times.
            assert!(
                (sum - found).abs() < 1e-9 * scale,
                "{name}: {sums:?} {found}"
            );
        }
    }
}

#[test]
fn exact_soft_columns_have_the_integral_of_their_height_in_closed_form() {
    for (n, contact_time, restitution, alpha, h) in [
        (1, 7e-4, 0.6, 2.0, 1e-6),
        (10, 7e-4, 0.6, 2.0, 1e-6),
        (10, 1e-4, 0.9, 0.7, 1e-6),
        (3, 7e-5, 0.6, 5.0, 4e-7),
        (1, 7e-6, 0.3, 2.0, 1e-7),
    ] {
        let facts = Facts {
            n,
            restitution,
            ..shaken(exact(contact_time), alpha)
        };
        let mut engine = engine(facts);
        let end = 0.11;
        let sum = by_looks(&mut *engine, end, h);
        let found = look(&*engine).integrals.expect("under gravity").height;
        // A contact's force jumps somewhere between two looks: h³ Δa/72 for each, of
        // accelerations to 10⁵ m/s², against 10⁻⁴ m s.
        assert!(
            (sum - found).abs() < 3e-10 * sum.abs().max(1e-5),
            "N {n}, t_c {contact_time}: {sum} {found}"
        );
    }
}

#[test]
fn what_is_not_known_between_looks_is_in_the_error() {
    // A soft ball that hardly bounces moves alike in every period: nothing but the looks
    // makes an error, and it is stated.
    let duration = 1.0 / 0.9;
    for (alpha, contact_time) in [(1.5, 1e-5), (2.0, 1e-4)] {
        let facts = Facts {
            n: 1,
            restitution: 0.05,
            duration: Some(duration),
            ..shaken(soft(Integrator::Verlet, contact_time, 50.0), alpha)
        };
        let results = measured(facts.clone());
        let mean = results.h_cm_mean.expect("a mean");
        let error = results.h_cm_error.expect("an error");
        let mut engine = engine(facts);
        engine
            .advance(0.1 * duration, u64::MAX)
            .expect("a sound run");
        let begun = engine.time();
        let sum = by_looks(&mut *engine, duration, 1e-6);
        let truth = sum / (engine.time() - begun) + 0.5e-3;
        assert!((mean - truth).abs() <= error, "{mean} ± {error}: {truth}");
        // And it is no excuse: a ten-thousandth of the height.
        assert!(error < 1e-4 * mean, "{mean} ± {error}");
    }
}

/// ∫ z dt from where the engine is, by the cubic through places and velocities of looks
/// `h` s apart.
fn by_looks(engine: &mut dyn Engine, end: f64, h: f64) -> f64 {
    let (mut a, mut b) = (Observation::default(), Observation::default());
    engine.observe(&mut a);
    let from = a.time;
    let (mut sum, mut k) = (0.0, 0.0);
    loop {
        k += 1.0;
        let until = (from + k * h).min(end);
        engine.advance(until, u64::MAX).expect("a sound run");
        engine.observe(&mut b);
        let tau = b.time - a.time;
        sum += 0.5 * tau * (a.centre + b.centre)
            + tau * tau * (a.centre_velocity - b.centre_velocity) / 12.0;
        std::mem::swap(&mut a, &mut b);
        if until >= end {
            return sum;
        }
    }
}
