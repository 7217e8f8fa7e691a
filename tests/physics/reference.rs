//! Hard beads on a plate, against a slow method that shares no code with the engine.

use crate::scenes::{ED, G, engine, look, shaken};
use beadlab::scene::{Facts, Floor, Launch, Shake, Start};

/// A slow event-driven reference: absolute heights, every pair looked at for every
/// event, hits on the plate by sampling and bisection. No resting contacts.
struct Reference {
    heights: Vec<f64>,
    velocities: Vec<f64>,
    time: f64,
    amplitude: f64,
    omega: f64,
    restitution: f64,
    floor_restitution: f64,
}

impl Reference {
    fn plate_hit(&self) -> f64 {
        let gap = |tau: f64| {
            self.heights[0] + (self.velocities[0] - 0.5 * G * tau) * tau
                - self.amplitude * (self.omega * (self.time + tau)).sin()
        };
        let step = 1e-5;
        let mut low = 1e-9;
        while gap(low + step) > 0.0 {
            low += step;
        }
        let mut high = low + step;
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if gap(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        0.5 * (low + high)
    }

    fn fly(&mut self, tau: f64) {
        for (z, v) in self.heights.iter_mut().zip(&mut self.velocities) {
            *z += (*v - 0.5 * G * tau) * tau;
            *v -= G * tau;
        }
        self.time += tau;
    }

    fn run(&mut self, until: f64) {
        loop {
            let pair = |i: usize| {
                let rate = self.velocities[i] - self.velocities[i - 1];
                if rate < 0.0 {
                    -(self.heights[i] - self.heights[i - 1]) / rate
                } else {
                    f64::INFINITY
                }
            };
            let next = (1..self.heights.len())
                .map(|i| (i, pair(i)))
                .chain([(0, self.plate_hit())]);
            let (i, tau) = next.fold((0, f64::INFINITY), |best, next| {
                if next.1 < best.1 { next } else { best }
            });
            if self.time + tau > until {
                self.fly(until - self.time);
                return;
            }
            self.fly(tau);
            if i == 0 {
                let plate = self.amplitude * self.omega * (self.omega * self.time).cos();
                self.velocities[0] = plate - self.floor_restitution * (self.velocities[0] - plate);
            } else {
                let impulse =
                    0.5 * (1.0 + self.restitution) * (self.velocities[i] - self.velocities[i - 1]);
                self.velocities[i] -= impulse;
                self.velocities[i - 1] += impulse;
            }
        }
    }
}

#[test]
fn hard_beads_follow_the_slow_reference() {
    let restitution = 0.95;
    for alpha in [0.8, 3.0, 20.0] {
        let start = Start::Launched(Launch {
            s0: 2e-3,
            jitter: true,
            v0: -0.05,
        });
        let facts = Facts {
            n: 3,
            restitution,
            start,
            ..shaken(ED, alpha)
        };
        let Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }) = facts.floor
        else {
            unreachable!("shaken")
        };
        let mut engine = engine(facts);
        let seen = look(&*engine);
        let mut reference = Reference {
            heights: seen.reduced.clone(),
            velocities: seen.velocities.clone(),
            time: 0.0,
            amplitude,
            omega: std::f64::consts::TAU * frequency,
            restitution,
            floor_restitution: beadlab::physics::LinearLaw::new(restitution, 1.0)
                .floor_restitution(),
        };
        for until in [0.02, 0.05, 0.1] {
            engine.advance(until, u64::MAX).expect("a sound run");
            reference.run(until);
            let reduced = look(&*engine).reduced;
            assert_eq!(reduced.len(), reference.heights.len());
            for (z, expected) in reduced.iter().zip(&reference.heights) {
                // Both are exact up to rounding, which a dozen collisions amplify.
                assert!(
                    (z - expected).abs() < 1e-10,
                    "α {alpha}, t {until}: {z} {expected}"
                );
            }
        }
        assert!(
            look(&*engine).events > 3,
            "α {alpha}: the case is here to test collisions"
        );
    }
}
