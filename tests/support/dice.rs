//! Seeded random numbers for tests, and random scenes.
#![allow(dead_code, reason = "every test uses its own part of this")]

use crate::support::{ED, G, fig1};
use beadlab::scene::{Facts, Floor, FloorContact, Launch, Shake, Start, angular};

/// Numbers in [0, 1), the same in every run.
pub struct Dice(pub u64);

impl Dice {
    pub fn roll(&mut self) -> f64 {
        self.0 = self
            .0
            .wrapping_mul(6_364_136_223_846_793_005)
            .wrapping_add(1_442_695_040_888_963_407);
        (self.0 >> 11) as f64 / (1_u64 << 53) as f64
    }

    pub fn chance(&mut self, p: f64) -> bool {
        self.roll() < p
    }

    pub fn decades(&mut self, from: f64, to: f64) -> f64 {
        10_f64.powf(from + (to - from) * self.roll())
    }

    /// Hard beads of any kind of scene.
    pub fn scene(&mut self) -> Facts {
        let gravity = self.chance(0.7).then_some(G);
        let (frequency, alpha) = (self.decades(0.0, 3.0), self.decades(-1.0, 3.0));
        let floor = if gravity.is_some() && self.chance(0.8) {
            Floor::Vibrating(Shake {
                amplitude: alpha * G / angular(frequency).powi(2),
                frequency,
            })
        } else {
            Floor::Fixed
        };
        let start = if gravity.is_some() && self.chance(0.4) {
            Start::Resting
        } else {
            let s0 = if self.chance(0.2) {
                0.0
            } else {
                self.decades(-12.0, -1.0)
            };
            Start::Launched(Launch {
                s0,
                jitter: self.chance(0.5),
                v0: -self.decades(-4.0, 0.0),
            })
        };
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "1 to 20"
        )]
        let n = 1 + (20.0 * self.roll()) as usize;
        let restitution = if self.chance(0.1) { 0.0 } else { self.roll() };
        let floor_contact = if self.chance(0.5) {
            FloorContact::SameSpring
        } else {
            FloorContact::SameRestitution
        };
        let width = if self.chance(0.3) {
            5e-4 * self.roll()
        } else {
            0.0
        };
        let duration = gravity.map(|_| 1.0);
        Facts {
            n,
            restitution,
            floor_contact,
            width,
            start,
            gravity,
            floor,
            duration,
            ..fig1(ED, 0.0)
        }
    }
}
