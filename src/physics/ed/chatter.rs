//! Which gaps count as touching, so that inelastic collapse ends in finite work.
//!
//! A gap below 10⁻¹² of a diameter (an atomic nucleus to a bead) is a contact. In a
//! collapse, N(1 − ε) ≫ 1, a pair collides infinitely often in finite time while its
//! gap shrinks to nothing; to follow all of it down to there costs of the order of N³
//! collisions. So a pair that has chattered for longer than any sequence without
//! collapse does counts as touching at ever larger gaps, and its cascade, by LRV,
//! brings it to relative rest.

use crate::scene::Scene;

/// Touching at first, in diameters.
const TOUCHING: f64 = 1e-12;
/// Touching at most, in diameters.
const MOST: f64 = 1e-4;
/// Collisions of a chattering pair over which its touching gap doubles.
const DOUBLING: u32 = 16;
/// Part of a period within which a pair that collides again still chatters.
const SOON: f64 = 1e-4;

pub(super) struct Chatter {
    touching: f64,
    most: f64,
    soon: f64,
    allowed: u32,
    pairs: Vec<Pair>,
}

#[derive(Clone)]
struct Pair {
    last: f64,
    collisions: u32,
    touching: f64,
}

impl Chatter {
    pub fn new(scene: &Scene, masses: &[f64]) -> Self {
        // Elastic equal beads exchange their velocities at most N times a pair; a light
        // bead between a heavy one and the floor bounces π/2 √(mass ratio) times.
        let (light, heavy) = masses
            .iter()
            .fold((f64::INFINITY, 0.0_f64), |(low, high), &m| {
                (low.min(m), high.max(m))
            });
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a float-to-int cast saturates"
        )]
        let allowed = (64.0 + 4.0 * scene.n as f64 * (heavy / light).sqrt()) as u32;
        let soon = match (scene.period(), scene.gravity) {
            (Some(period), _) => SOON * period,
            (None, Some(gravity)) => SOON * (scene.diameter / gravity).sqrt(),
            // A single floor collision: whatever a pair does is part of it.
            (None, None) => f64::INFINITY,
        };
        let touching = TOUCHING * scene.diameter;
        let pair = Pair {
            last: f64::NEG_INFINITY,
            collisions: 0,
            touching,
        };
        Self {
            touching,
            most: MOST * scene.diameter,
            soon,
            allowed,
            pairs: vec![pair; scene.n],
        }
    }

    /// Whether gap `i`, of size `g`, is a contact.
    pub fn touch(&self, i: usize, g: f64) -> bool {
        g <= self.pairs[i].touching
    }

    /// Pair `i` collides after a flight.
    pub fn collides(&mut self, i: usize, t: f64) {
        let pair = &mut self.pairs[i];
        if t - pair.last > self.soon {
            (pair.collisions, pair.touching) = (0, self.touching);
        }
        pair.last = t;
        pair.collisions = pair.collisions.saturating_add(1);
        if pair.collisions > self.allowed && pair.collisions.is_multiple_of(DOUBLING) {
            pair.touching = (2.0 * pair.touching).min(self.most);
        }
    }

    /// Moves the origin of time on.
    pub fn shift(&mut self, shift: f64) {
        for pair in &mut self.pairs {
            pair.last -= shift;
        }
    }
}
