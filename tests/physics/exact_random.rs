//! The exact method on random scenes of every kind: what must hold whatever comes.

use crate::dice::Dice;
use crate::random_scenes::hard_beads;
use crate::scenes::look;
use beadlab::physics::{Engine, Outcome, build};
use beadlab::scene::{
    Facts, Floor, Launch, Law, Method, Scene, Shake, Soft, Solver, Start, angular,
};

const SCENES: u32 = 200;
/// Steps after which a scene has been looked at long enough.
const BUDGET: u64 = 20_000;

/// A random scene of soft beads, and how long to follow it, s.
fn soft(dice: &mut Dice) -> (Facts, f64) {
    let hard = hard_beads(dice);
    let contact_time = dice.decades(-9.0, -2.0);
    let facts = Facts {
        restitution: hard.restitution.max(1e-6),
        method: Method::Soft(Soft {
            law: Law::Hooke { contact_time },
            solver: Solver::Exact,
            attraction: dice.chance(0.7),
        }),
        ..hard
    };
    let long = facts.period().map_or(1.0, |period| 3.0 * period);
    (facts, long)
}

fn engine(facts: &Facts) -> Box<dyn Engine> {
    build(&Scene::new(facts.clone()).expect("a valid scene"), None).0
}

#[test]
fn every_state_is_one_that_can_be() {
    let mut dice = Dice(3);
    let mut failures = Vec::new();
    for k in 0..SCENES {
        let (facts, long) = soft(&mut dice);
        let mut engine = engine(&facts);
        if let Err(error) = engine.advance(long, BUDGET) {
            failures.push(format!("scene {k}: {error}: {facts:?}"));
            continue;
        }
        let seen = look(&*engine);
        let energy = seen.energy;
        let finite = seen
            .gaps
            .iter()
            .chain(&seen.velocities)
            .all(|x| x.is_finite());
        // No more energy than there was or came from the plate; and rounding.
        let budget = energy.kinetic + energy.potential + energy.elastic;
        if !finite
            || energy.drift.abs() > 1e-10
            || !budget.is_finite()
            || energy.lost < -1e-10 * budget.abs()
        {
            failures.push(format!(
                "scene {k}: drift {:.1e}, lost {:.1e}, {} steps, finite {finite}: {facts:?}",
                energy.drift, energy.lost, seen.steps
            ));
        }
    }
    assert!(
        failures.is_empty(),
        "{} of {SCENES}:\n{}",
        failures.len(),
        failures.join("\n")
    );
}

#[test]
fn a_split_advance_gives_the_same_bits() {
    let mut dice = Dice(4);
    let mut compared = 0;
    for k in 0..SCENES {
        let (facts, long) = soft(&mut dice);
        let mut whole = engine(&facts);
        let Ok(outcome) = whole.advance(long, BUDGET / 10) else {
            continue; // another test's matter
        };
        // Where the budget ended it, to there again.
        let until = if outcome == Outcome::OutOfBudget {
            whole.time()
        } else {
            long
        };
        let mut again = engine(&facts);
        // The end of a budget may lie within an instant of many events, which goes on.
        let until = until * (1.0 - 1e-9);
        again.advance(until, u64::MAX).expect("it did before");
        let mut split = engine(&facts);
        let mut to = 0.0;
        while to < until {
            to = until.min(to + until * 0.2 * dice.roll());
            while split
                .advance(to, 1 + u64::from(k % 7))
                .expect("it did before")
                == Outcome::OutOfBudget
            {
                let _ = look(&*split);
            }
        }
        let (again, split) = (again.state(), split.state());
        assert_eq!(again.gaps, split.gaps, "scene {k}: {facts:?}");
        assert_eq!(again.rates, split.rates, "scene {k}: {facts:?}");
        assert_eq!(again.time, split.time, "scene {k}");
        compared += 1;
    }
    assert!(compared > SCENES * 9 / 10, "{compared}");
}

/// The same scene in units of length and time of which it has `lengths` and `times` as
/// many.
fn scaled(facts: &Facts, lengths: f64, times: f64) -> Facts {
    let speeds = lengths / times;
    let mut other = facts.clone();
    other.diameter *= lengths;
    other.width *= lengths;
    other.gravity = facts.gravity.map(|g| g * speeds / times);
    if let Start::Launched(Launch { s0, v0, .. }) = &mut other.start {
        *s0 *= lengths;
        *v0 *= speeds;
    }
    if let Floor::Vibrating(Shake {
        amplitude,
        frequency,
    }) = &mut other.floor
    {
        *amplitude *= lengths;
        *frequency /= times;
    }
    if let Method::Soft(Soft {
        law: Law::Hooke { contact_time },
        ..
    }) = &mut other.method
    {
        *contact_time *= times;
    }
    other.duration = facts.duration.map(|duration| duration * times);
    other
}

#[test]
fn powers_of_two_are_only_other_units() {
    let mut dice = Dice(5);
    let mut compared = 0;
    for k in 0..SCENES {
        let (facts, long) = soft(&mut dice);
        let (lengths, times) = (4.0, 8.0);
        let other = scaled(&facts, lengths, times);
        let (mut one, mut two) = (engine(&facts), engine(&other));
        let outcomes = (
            one.advance(long, BUDGET / 10),
            two.advance(long * times, BUDGET / 10),
        );
        if outcomes.0.is_err() && outcomes.1.is_err() {
            continue; // another test's matter
        }
        // Powers of two scale without rounding: the same bits.
        let (one, two) = (one.state(), two.state());
        let gaps: Vec<f64> = one.gaps.iter().map(|g| g * lengths).collect();
        let rates: Vec<f64> = one.rates.iter().map(|w| w * lengths / times).collect();
        assert_eq!(gaps, two.gaps, "scene {k}: {facts:?}");
        assert_eq!(rates, two.rates, "scene {k}: {facts:?}");
        compared += 1;
    }
    assert!(compared > SCENES * 9 / 10, "{compared}");
}

#[test]
fn three_and_seven_are_only_other_units() {
    let mut dice = Dice(6);
    let mut compared = 0;
    for k in 0..SCENES {
        let (facts, _) = soft(&mut dice);
        let Some(contact_time) = facts.contact_time() else {
            unreachable!("soft scenes have one");
        };
        // Through the first contact of the lowest beads, before chaos.
        let flight = match facts.start {
            Start::Launched(Launch { s0, v0, .. }) => s0 / v0.abs(),
            Start::Resting => 0.0,
        };
        let until = flight.min(1e-3) + 3.0 * contact_time;
        let other = scaled(&facts, 3.0, 7.0);
        let (mut one, mut two) = (engine(&facts), engine(&other));
        let outcomes = (one.advance(until, BUDGET), two.advance(until * 7.0, BUDGET));
        let (Ok(Outcome::Reached | Outcome::Over), Ok(Outcome::Reached | Outcome::Over)) = outcomes
        else {
            continue; // another test's matter
        };
        let (one, two) = (one.state(), two.state());
        let plate = match facts.floor {
            Floor::Vibrating(Shake {
                amplitude,
                frequency,
            }) => amplitude * angular(frequency),
            Floor::Fixed => 1e-300,
        };
        let speed = one
            .rates
            .iter()
            .fold(plate, |most: f64, w| most.max(w.abs()));
        let length = speed * until + one.gaps.iter().fold(0.0, |most: f64, g| most.max(g.abs()));
        // What the last place of the start makes: 3 and 7 round every number of the scene.
        let mut start = engine(&facts).state();
        for (i, (g, w)) in start.gaps.iter_mut().zip(&mut start.rates).enumerate() {
            let up = i % 2 == 0;
            *g = if up { g.next_up() } else { g.next_down() };
            *w = if up { w.next_down() } else { w.next_up() };
        }
        let (mut changed, _) = build(
            &Scene::new(facts.clone()).expect("a valid scene"),
            Some(&start),
        );
        if changed.advance(until, BUDGET) == Ok(Outcome::OutOfBudget) {
            continue;
        }
        let changed = changed.state();
        let differs = |a: &[f64], b: &[f64]| {
            let difference = a.iter().zip(b).map(|(a, b)| (a - b).abs());
            difference.fold(0.0, f64::max)
        };
        let sensitivity = (differs(&changed.gaps, &one.gaps) / length)
            .max(differs(&changed.rates, &one.rates) / speed);
        for i in 0..facts.n {
            let (g, w) = (
                one.gaps[i] - two.gaps[i] / 3.0,
                one.rates[i] - two.rates[i] / 3.0 * 7.0,
            );
            // The end itself is rounded, which a contact feels: 1e-16 until/t_c.
            let allowed = 1e-11 + 1e-14 * until / contact_time + 100.0 * sensitivity;
            assert!(
                g.abs() <= allowed * length && w.abs() <= allowed * speed,
                "scene {k}, gap {i}: {:.1e} and {:.1e} of {allowed:.1e}: {facts:?}",
                g / length,
                w / speed
            );
        }
        compared += 1;
    }
    assert!(compared > SCENES / 2, "{compared}");
}
