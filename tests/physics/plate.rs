//! Hard columns on a vibrating plate, against the closed form of one totally inelastic ball.

use std::f64::consts::{PI, TAU};

use crate::scenes::{ED, G, engine, look, shaken};
use beadlab::physics::{Engine, Outcome};
use beadlab::scene::{Facts, Floor, FloorContact, Shake, Start, angular};

const FREQUENCY: f64 = 20.0;

/// A ball that takes off from the plate at `phase` and flies freely: the phase it has
/// turned by when it lands, by bisection of h(x) − sin x in units of A₀.
fn flight(alpha: f64, phase: f64) -> f64 {
    let height = |x: f64| phase.sin() + phase.cos() * x - 0.5 * x * x / alpha - (phase + x).sin();
    // It cannot land before the plate's pull exceeds gravity again, at π − asin(1/α).
    let (mut low, mut high) = (PI - (1.0 / alpha).asin() - phase, 4.0 * TAU);
    let steps = 4000;
    let step = (high - low) / f64::from(steps);
    for k in 1..=steps {
        if height(low + step * f64::from(k)) < 0.0 {
            (low, high) = (low + step * f64::from(k - 1), low + step * f64::from(k));
            break;
        }
    }
    for _ in 0..80 {
        let middle = 0.5 * (low + high);
        if height(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    0.5 * (low + high)
}

fn ball(alpha: f64) -> Facts {
    Facts {
        n: 1,
        restitution: 0.0,
        floor_contact: FloorContact::SameRestitution,
        duration: Some(1.0),
        start: Start::Resting,
        ..shaken(ED, alpha)
    }
}

/// Phases of the next take-off and landing of a column that is at rest on the plate.
fn take_off_and_landing(engine: &mut dyn Engine) -> (f64, f64) {
    let phase = |time: f64| TAU * FREQUENCY * time;
    let take_off = engine.next_event().expect("a resting column takes off");
    engine.advance(take_off, u64::MAX).expect("a sound run");
    let landing = engine.next_event().expect("what took off lands");
    engine.advance(landing, u64::MAX).expect("a sound run");
    (phase(take_off), phase(landing))
}

/// The next take-off and landing of a column at rest are those of the closed form.
fn flies_like_a_ball(engine: &mut dyn Engine, alpha: f64, round: usize) {
    let (take_off, landing) = take_off_and_landing(engine);
    let first = (1.0 / alpha).asin();
    let expected = first + TAU * (take_off / TAU).floor();
    // Phases of some hundred radians carry 1e-13.
    assert!(
        (take_off - expected).abs() < 1e-9,
        "α {alpha}, round {round}: {take_off}"
    );
    assert!(
        (landing - take_off - flight(alpha, first)).abs() < 1e-9,
        "α {alpha}: {landing}"
    );
}

/// Advances until all beads rest on the plate, and says whether that came in time.
fn comes_to_rest(engine: &mut dyn Engine) -> bool {
    let deadline = engine.time() + 3.0 / FREQUENCY;
    while engine.time() < deadline {
        let seen = look(engine);
        if seen.contacts.iter().all(|&closed| closed) && seen.gaps.iter().all(|&g| g == 0.0) {
            let next = engine.next_event().expect("a take-off");
            // Contacts within a flying cluster are closed too: only a resting one waits
            // for the take-off phase.
            if (look(engine).velocities[0] - look(engine).floor_velocity).abs() == 0.0
                && next > engine.time()
            {
                return true;
            }
        }
        let next = engine.next_event().unwrap_or(deadline).min(deadline);
        engine.advance(next, u64::MAX).expect("a sound run");
    }
    false
}

#[test]
fn an_inelastic_ball_follows_the_closed_form() {
    for alpha in [1.1, 1.5, 2.0, 2.5, 3.0, 3.2] {
        let mut engine = engine(ball(alpha));
        for round in 0..20 {
            flies_like_a_ball(&mut *engine, alpha, round);
        }
    }
}

#[test]
fn at_alpha_2_the_ball_flies_as_the_numbers_say() {
    let mut engine = engine(ball(2.0));
    let (take_off, landing) = take_off_and_landing(&mut *engine);
    // α = 2: take-off at sin φ = 1/2, 30°; flight of 0.74148 periods, apex 1.25 A₀.
    assert!((take_off - PI / 6.0).abs() < 1e-9);
    assert!(((landing - take_off) / TAU - 0.741_48).abs() < 5e-6);
    let amplitude = 2.0 * G / (TAU * FREQUENCY).powi(2);
    let mut flying = crate::scenes::engine(ball(2.0));
    let rise = (TAU * FREQUENCY * amplitude) * (PI / 6.0).cos() / G;
    flying
        .advance(take_off / (TAU * FREQUENCY) + rise, u64::MAX)
        .expect("a sound run");
    assert!((look(&*flying).reduced[0] / amplitude - 1.25).abs() < 1e-9);
}

#[test]
fn a_ball_that_lands_while_the_plate_falls_away_leaves_at_once() {
    // α = 3.5: the first flight ends inside the take-off window of the next period.
    let alpha = 3.5;
    let first = (1.0_f64 / alpha).asin();
    let mut engine = engine(ball(alpha));
    let (take_off, mut landing) = take_off_and_landing(&mut *engine);
    assert!((take_off - first).abs() < 1e-9);
    assert!((landing - take_off - flight(alpha, first)).abs() < 1e-9);
    let mut at_once = 0;
    for _ in 0..20 {
        let phase = landing.rem_euclid(TAU);
        let inside = phase > first && phase < PI - first;
        at_once += usize::from(inside);
        let start = if inside {
            landing
        } else {
            landing + (first - phase).rem_euclid(TAU)
        };
        if !inside {
            let next = engine.next_event().expect("a take-off");
            engine.advance(next, u64::MAX).expect("a sound run");
        }
        let next = TAU * FREQUENCY * engine.next_event().expect("a landing");
        assert!(
            (next - start - flight(alpha, start.rem_euclid(TAU))).abs() < 1e-9,
            "{next} after {start}"
        );
        engine
            .advance(next / (TAU * FREQUENCY), u64::MAX)
            .expect("a sound run");
        landing = next;
    }
    assert!(
        at_once > 0,
        "the case is here to test landings inside the window"
    );
}

#[test]
fn a_hard_column_moves_as_one_inelastic_ball() {
    for alpha in [1.1, 1.5, 2.0, 2.5, 3.0] {
        let mut engine = engine(shaken(ED, alpha));
        for round in 0..8 {
            assert!(
                comes_to_rest(&mut *engine),
                "α {alpha}, round {round}: no rest at {}",
                engine.time()
            );
            flies_like_a_ball(&mut *engine, alpha, round);
        }
    }
}

#[test]
fn below_alpha_1_nothing_ever_takes_off() {
    for alpha in [0.5, 0.999_999, 1.0] {
        let mut engine = engine(shaken(ED, alpha));
        assert_eq!(engine.next_event(), None, "α {alpha}");
        engine.advance(10.0, u64::MAX).expect("a sound run");
        let seen = look(&*engine);
        assert!(seen.contacts.iter().all(|&closed| closed) && seen.events == 0);
        assert!(seen.reduced.iter().all(|z| *z == seen.floor));
    }
}

#[test]
fn just_above_alpha_1_time_goes_on() {
    // The plate falls away for less than a rounding: take-off and rest must not alternate
    // for ever at one instant.
    let just_above = [0.0, 4e-16, 1e-15, 1e-13, 1e-11, 1e-10, 2e-9, 1e-7, 1e-4];
    for frequency in (1..=200).map(f64::from) {
        for excess in just_above {
            let mut facts = ball(1.0 + excess);
            let amplitude = (1.0 + excess) * G / angular(frequency).powi(2);
            facts.floor = Floor::Vibrating(Shake {
                amplitude,
                frequency,
            });
            let mut engine = engine(facts);
            let outcome = engine.advance(5.0 / frequency, 1000).expect("a sound run");
            assert_eq!(outcome, Outcome::Reached, "{frequency} Hz, 1 + {excess}");
            let seen = look(&*engine);
            assert!((seen.reduced[0] - seen.floor).abs() < 1e-3 * amplitude);
        }
    }
}
