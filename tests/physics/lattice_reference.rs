//! The lattice against the plainest program for it: absolute places, every pair, every
//! image, velocity Verlet.

use crate::scenes::{engine, fig1, look, soft};
use beadlab::scene::{Arrangement, Facts, Integrator, Launch, Start};

const COLUMNS: usize = 3;
const ROWS: usize = 2;
const N: usize = COLUMNS * ROWS;
const DIAMETER: f64 = 1e-3;
const CONTACT_TIME: f64 = 1e-5;
const SPEED: f64 = 0.1;
const STEPS: f64 = 100.0;

/// Two rows of three beads, ε = 0.9, shifted at random.
fn scene(s0: f64, seed: u64, tangential: f64) -> Facts {
    let method = soft(Integrator::Verlet, CONTACT_TIME, STEPS);
    Facts {
        arrangement: Arrangement::Lattice {
            columns: COLUMNS,
            tangential,
        },
        n: N,
        seed,
        start: Start::Launched(Launch {
            s0,
            jitter: true,
            v0: -SPEED,
        }),
        ..fig1(method, s0)
    }
}

#[derive(Clone, Copy, Default)]
struct Vector {
    x: f64,
    y: f64,
}

impl Vector {
    fn plus(self, other: Self, factor: f64) -> Self {
        Self {
            x: self.x + factor * other.x,
            y: self.y + factor * other.y,
        }
    }

    fn dot(self, other: Self) -> f64 {
        self.x * other.x + self.y * other.y
    }
}

/// Accelerations by Eqs. (2) to (4): masses of 1, the floor with the spring of a pair.
fn accelerations(places: &[Vector], rates: &[Vector], period: f64, tangential: f64) -> Vec<Vector> {
    let mu = -0.9_f64.ln() / CONTACT_TIME;
    let stiffness = 0.5 * ((std::f64::consts::PI / CONTACT_TIME).powi(2) + mu * mu);
    let mut forces = vec![Vector::default(); N];
    for i in 0..N {
        let gap = places[i].y - 0.5 * DIAMETER;
        if gap <= 0.0 {
            forces[i].y -= stiffness * gap + mu * rates[i].y;
            forces[i].x -= tangential * rates[i].x;
        }
        for j in 0..i {
            for image in [-period, 0.0, period] {
                let mut between = places[i].plus(places[j], -1.0);
                between.x += image;
                let distance = between.dot(between).sqrt();
                if distance > DIAMETER {
                    continue;
                }
                let normal = Vector::default().plus(between, 1.0 / distance);
                let across = Vector {
                    x: -normal.y,
                    y: normal.x,
                };
                let rate = rates[i].plus(rates[j], -1.0);
                let push = stiffness * (DIAMETER - distance) - mu * rate.dot(normal);
                let drag = -tangential * rate.dot(across);
                let force = Vector::default().plus(normal, push).plus(across, drag);
                forces[i] = forces[i].plus(force, 1.0);
                forces[j] = forces[j].plus(force, -1.0);
            }
        }
    }
    forces
}

/// Kinetic energy after so many steps from these places, m²/s².
fn by_hand(mut places: Vec<Vector>, period: f64, tangential: f64, steps: u32) -> f64 {
    let h = CONTACT_TIME / STEPS;
    let mut rates = vec![Vector { x: 0.0, y: -SPEED }; N];
    let mut forces = accelerations(&places, &rates, period, tangential);
    for _ in 0..steps {
        let mut predicted = rates.clone();
        for i in 0..N {
            rates[i] = rates[i].plus(forces[i], 0.5 * h);
            places[i] = places[i].plus(rates[i], h);
            predicted[i] = rates[i].plus(forces[i], 0.5 * h);
        }
        forces = accelerations(&places, &predicted, period, tangential);
        for i in 0..N {
            rates[i] = rates[i].plus(forces[i], 0.5 * h);
        }
    }
    rates.iter().map(|rate| 0.5 * rate.dot(*rate)).sum()
}

#[test]
fn six_beads_collide_as_all_pairs_by_hand_say() {
    let mut kept = Vec::new();
    for (s0, seed, contacts) in [(1e-6, 1, 10), (1e-6, 3, 10), (1e-5, 2, 20), (1e-4, 3, 200)] {
        for tangential in [0.0, 1e4] {
            let mut engine = engine(scene(s0, seed, tangential));
            let start = look(&*engine);
            let discs = start.discs.expect("a plane");
            let places = discs.x.iter().zip(&discs.heights);
            let places = places.map(|(&x, &y)| Vector { x, y }).collect();
            // Half a step on, lest rounding decides which grid point is meant.
            let until = (f64::from(contacts) + 0.5 / STEPS) * CONTACT_TIME;
            engine.advance(until, u64::MAX).expect("sound");
            let steps = 100 * contacts;
            let expected = by_hand(places, discs.period, tangential, steps);
            let energy = look(&*engine).energy.kinetic;
            // Absolute places of 1e-3 m are rounded to 1e-19 m, overlaps are some 1e-7 m.
            let off = energy / expected - 1.0;
            assert!(off.abs() < 1e-9, "s0 {s0}, seed {seed}: {off:e}");
            kept.push(energy / start.energy.kinetic);
        }
    }
    // Collisions they were, and rubbing is felt.
    assert!(kept.iter().all(|&part| part < 0.9), "{kept:?}");
    assert!(kept.chunks(2).all(|pair| (pair[0] - pair[1]).abs() > 1e-3));
}
