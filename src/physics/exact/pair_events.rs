//! Short ways for the commonest events: two beads meet in flight, away from all others, and
//! part. They do what the other files do for any cluster, at the least cost.

use super::plan::{Collision, Flight, Plan};
use super::propagation::brought;
use super::{ContactMode, Exact, Gap};
use crate::physics::ground::Ground;

impl<G: Ground> Exact<G> {
    /// Gap `i`, in flight between others, closes at `t`, and nothing else reaches its beads
    /// before it opens. Where that is not so nothing is done, and the answer is false.
    pub(super) fn pair_meets(&mut self, i: usize, t: f64) -> bool {
        let open = |j: usize| {
            let mode = self.modes.get(j);
            mode.is_none_or(|mode| *mode == ContactMode::Open)
        };
        // The gaps beside it fly by themselves where those beyond them are no contacts.
        let alone = open(i.saturating_sub(2)) && open(i + 2);
        if !alone || i == 0 || !self.constants.attraction {
            return false;
        }
        let (low, high) = (i - 1, (i + 1).min(self.gaps.len() - 1));
        let [below, gap, above] = [low, i, high].map(|j| brought(self.flight(j, t), t));
        let w = gap.w;
        let constants = &self.constants;
        let Some(collision) = Collision::new(constants, i, w) else {
            return false;
        };
        let free = (f64::MIN..0.0).contains(&w)
            && collision.leaves_open(constants, low, below)
            && (high == i || collision.leaves_open(constants, high, above));
        if !free {
            return false;
        }
        (self.gaps[low], self.gaps[high]) = (below, above);
        self.gaps[i] = Gap { g: 0.0, w, t };
        self.change(i, ContactMode::Pushing, t);
        self.clusters.join(low, high + 1);
        self.plans[low] = Plan::Collision(collision);
        self.queue.write(high, f64::INFINITY);
        self.queue.write(i, f64::INFINITY);
        self.queue.write(low, t + collision.oscillator.lasts);
        self.queue.play_again(low, high);
        true
    }

    /// The collision of the cluster at `low` ends at `t`. Where the floor has a part in it
    /// nothing is done, and the answer is false.
    pub(super) fn pair_parts(&mut self, low: usize, collision: Collision, t: f64) -> bool {
        let Collision {
            contact: i,
            w,
            oscillator,
        } = collision;
        if i == 0 {
            return false;
        }
        let (high, tau) = (self.clusters.end(low), oscillator.lasts);
        let (lost, end) = (oscillator.lost(w, tau), oscillator.at(w, tau));
        self.books.ledger.lost.add(lost);
        self.books.measure(std::iter::once(w * oscillator.depth));
        for j in low..high {
            let column = (&self.ground, &self.constants);
            let gap = collision.gap_after(column, (j, self.gaps[j]), tau, end);
            self.gaps[j] = brought(gap, t);
        }
        self.change(i, ContactMode::Open, t);
        for j in low..high {
            self.clusters.join(j, j + 1);
            self.plans[j] = Plan::Flight(Flight);
            let closes = self.ground.closes(j, &self.gaps[j]);
            self.queue.write(j, closes);
        }
        self.queue.play_again(low, high - 1);
        true
    }
}
