//! A short way for the commonest event: two beads meet in flight, away from all others.

use super::{Ed, Gap, Rule};
use crate::physics::column::{reduced_mass, restitutions};
use crate::physics::ground::Ground;
use crate::scene::Scene;

/// The constants of the collisions at a gap.
#[derive(Debug, Clone, Copy)]
pub(super) struct Pair {
    /// Reduced mass m*, in mean bead masses.
    pub reduced: f64,
    pub restitution: f64,
    /// m*/m of the bead below, the part that it takes of a change of the gap's rate; 0 for the
    /// floor.
    pub below: f64,
    /// The same of the bead above.
    pub above: f64,
}

/// The pairs of a column; the first is the floor's with bead 1.
pub(super) fn pairs(scene: &Scene, masses: &[f64]) -> Vec<Pair> {
    let pair = |(i, restitution)| {
        let reduced = reduced_mass(masses, i);
        Pair {
            reduced,
            restitution,
            below: if i == 0 { 0.0 } else { reduced / masses[i - 1] },
            above: reduced / masses[i],
        }
    };
    restitutions(scene, masses)
        .into_iter()
        .enumerate()
        .map(pair)
        .collect()
}

impl Pair {
    /// The rate after a collision at rate `w`, m/s, its change, and the energy lost, m²/s².
    #[inline]
    pub fn collide(&self, w: f64, elastic: bool) -> (f64, f64, f64) {
        let restitution = if elastic { 1.0 } else { self.restitution };
        let lost = 0.5 * self.reduced * (1.0 - restitution * restitution) * w * w;
        (-restitution * w, -(1.0 + restitution) * w, lost)
    }
}

impl<G: Ground, R: Rule> Ed<G, R> {
    /// Two beads meet at gap `i` at `t`, and part; the gaps beside it stay open. Nearly every
    /// event is of this kind, and this does it at the least cost. Where it is of another kind
    /// nothing is done, and the answer is false: [`Ed::collide_at`] does all kinds.
    #[inline]
    pub(super) fn pair_meets(&mut self, i: usize, t: f64) -> bool {
        if i <= self.ground.riders() {
            return false;
        }
        let [below, gap, above @ ..] = &mut self.gaps[i - 1..] else {
            return false;
        };
        let (under, rate) = self.ground.flown(i - 1, below, t);
        let above = above.first_mut();
        let above = above.map(|gap| (self.ground.flown(i + 1, gap, t).0, gap));
        let over = above.as_ref().map(|(over, _)| *over);
        let (pair, w) = (self.pairs[i], gap.w);
        let parts = w < -self.closing.speed && w.is_finite() && pair.restitution > 0.0;
        let beside = under <= 0.0 || over.is_some_and(|over| over <= 0.0);
        if beside || !parts {
            return false;
        }
        let elastic = self.rule.elastic(Some(i - 1), i, t);
        let (after, change, lost) = pair.collide(w, elastic);
        *gap = Gap {
            g: 0.0,
            w: after,
            t,
        };
        self.queue.write(i, f64::INFINITY);
        let w = rate - change * pair.below;
        *below = Gap { g: under, w, t };
        let mut soonest = self.ground.closes(i - 1, below);
        self.queue.write(i - 1, soonest);
        let mut high = i;
        if let Some((over, gap)) = above {
            let w = gap.w - change * pair.above;
            *gap = Gap { g: over, w, t };
            high += 1;
            let closes = self.ground.closes(high, gap);
            soonest = soonest.min(closes);
            self.queue.write(high, closes);
        }
        self.queue.play_again(i - 1, high);
        self.look_ahead(soonest, t);
        let time = self.absolute(t);
        let books = &mut self.books;
        books.ledger.lost.add(lost);
        books.events += 1;
        books.contacts.touch_alone(i, time);
        true
    }
}
