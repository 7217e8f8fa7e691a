//! The commonest changes: two beads meet in flight, away from everything else, and part.
//! What the other files do for any cluster, here at the least cost.

use super::cluster::Plan;
use super::passage::brought;
use super::{Exact, Gap, Mode};
use crate::physics::flight::Ground;

impl<G: Ground> Exact<G> {
    /// Gap `i`, in flight between others, closes at `t`, and nothing else reaches its
    /// beads before it opens. False, and nothing done, where it is otherwise.
    pub(super) fn pair_meets(&mut self, i: usize, t: f64) -> bool {
        let open = |j: usize| self.modes.get(j).is_none_or(|mode| *mode == Mode::Open);
        // The gaps beside it fly by themselves if those beyond them are no contacts.
        let alone = self.attraction && i > 0 && open(i.saturating_sub(2)) && open(i + 2);
        let encounter = self.encounters[i].as_ref().filter(|_| alone);
        let Some(lasts) = encounter.map(|encounter| encounter.lasts) else {
            return false;
        };
        let (low, high) = (i - 1, (i + 1).min(self.gaps.len() - 1));
        let [below, gap, above] = [low, i, high].map(|j| brought(self.flight(j, t), t));
        let w = gap.w;
        let free = (f64::MIN..0.0).contains(&w)
            && self.stays_open(i, low, below, w, lasts)
            && (high == i || self.stays_open(i, high, above, w, lasts));
        if !free {
            return false;
        }
        (self.gaps[low], self.gaps[high]) = (below, above);
        self.gaps[i] = Gap { g: 0.0, w, t };
        self.change(i, Mode::Pushing, t);
        self.first[low..=high].fill(low);
        self.end[low] = high + 1;
        self.plans[low] = Plan::Encounter(i);
        self.queue.write(high, f64::INFINITY);
        self.queue.write(i, f64::INFINITY);
        self.queue.write(low, t + lasts);
        self.queue.play_again(low, high);
        true
    }

    /// Contact `i`, whose beads have met alone in the cluster at `low`, opens at `t`.
    /// False, and nothing done, where the floor has a part in it.
    pub(super) fn pair_parts(&mut self, low: usize, i: usize, t: f64) -> bool {
        let Some(encounter) = self.encounters[i].as_ref().filter(|_| i > 0) else {
            return false;
        };
        let (high, w, tau) = (self.end[low], self.gaps[i].w, encounter.lasts);
        let (lost, end) = (encounter.lost(w, tau), encounter.at(w, tau));
        self.state.books.ledger.lost.add(lost);
        self.state
            .books
            .measure(std::iter::once(w * encounter.depth));
        for j in low..high {
            self.gaps[j] = brought(self.beside(i, j, tau, w, end), t);
        }
        self.change(i, Mode::Open, t);
        for j in low..high {
            (self.first[j], self.end[j]) = (j, j + 1);
            self.plans[j] = Plan::Flight;
            self.queue.write(j, self.closes(j));
        }
        self.queue.play_again(low, high - 1);
        true
    }
}
