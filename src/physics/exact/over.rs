//! When a floor collision without gravity is over.

use super::Exact;
use crate::physics::column::{OVER, most_to_lose, much_to_come, velocities};
use crate::physics::ground::Ground;
use crate::physics::matter::Matter;
use crate::physics::shell::Mover;

/// Steps between two looks while some contact is closed.
const INSPECTION: u64 = 256;

/// When to look whether the collision is over.
#[derive(Clone, Debug)]
pub(super) struct CollisionEnd {
    /// Energy at the start or after an edit, m²/s². Without gravity it only falls.
    pub energy_at_first: f64,
    /// Events, and steps, up to which there is no need to look.
    next_look: (u64, u64),
}

impl CollisionEnd {
    pub fn new() -> Self {
        Self {
            energy_at_first: f64::INFINITY,
            next_look: (0, INSPECTION),
        }
    }
}

impl<G: Ground> Exact<G> {
    /// Looks whether a floor collision without gravity is over: when all contacts are open,
    /// and every [`INSPECTION`] steps, since overdamped contacts of heavy pairs never open.
    pub(super) fn look_whether_over(&mut self) {
        if G::PULLS || self.books.over {
            return;
        }
        let open = self.books.contacts.all_open();
        let (events, steps) = (self.books.events, self.books.steps);
        // A look costs O(N). Once in N events is enough, and costs each of them O(1).
        let due = if open {
            events >= self.end.next_look.0
        } else {
            steps >= self.end.next_look.1
        };
        if !due {
            return;
        }
        self.end.next_look = (events + self.gaps.len() as u64, steps + INSPECTION);
        let (next, when) = self.queue.first();
        let (rate, least) = (self.gaps[next].w, OVER * self.end.energy_at_first);
        if open
            && when.is_finite()
            && much_to_come(&self.constants.column.masses, next, rate, least)
        {
            return;
        }
        self.books.over = self.nothing_to_come(open);
    }

    /// Whether the contacts and collisions still to come can change no energy by a part of
    /// [`OVER`].
    fn nothing_to_come(&self, open: bool) -> bool {
        let now = self.now();
        let energy = self.matter().energy(&now);
        let spent = open || energy.elastic <= OVER * energy.kinetic;
        // E_r, too, must keep its digits, unless it is itself less than OVER of E.
        let least = energy
            .relative
            .max(OVER * energy.kinetic)
            .min(energy.kinetic);
        spent
            && most_to_lose(
                velocities(now.rates.into_iter()),
                &self.constants.column.masses,
            ) <= OVER * least
    }
}
