//! When a floor collision without gravity is over.

use super::Exact;
use crate::physics::column::{OVER, most_to_lose, much_to_come, velocities};
use crate::physics::flight::Ground;

/// Steps between two looks while some contact is closed.
const INSPECTION: u64 = 256;

/// Whether the collision is over, and when to look again.
#[derive(Clone, Debug)]
pub(super) struct CollisionEnd {
    pub over: bool,
    /// Energy at the start or after an edit, m²/s². Without gravity it only falls.
    pub energy_at_first: f64,
    /// Events, and steps, up to which there is no need to look.
    next_look: (u64, u64),
}

impl CollisionEnd {
    pub fn new() -> Self {
        Self {
            over: false,
            energy_at_first: f64::INFINITY,
            next_look: (0, INSPECTION),
        }
    }
}

impl<G: Ground> Exact<G> {
    /// Looks whether a floor collision without gravity is over: when all contacts are open,
    /// and every [`INSPECTION`] steps, since overdamped contacts of heavy pairs never open.
    pub(super) fn look_whether_over(&mut self) {
        if G::PULLS || self.end.over {
            return;
        }
        let open = self.state.books.contacts.all_open();
        let (events, steps) = (self.state.books.events, self.state.books.steps);
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
        if open && when.is_finite() && much_to_come(&self.constants.masses, next, rate, least) {
            return;
        }
        self.end.over = self.nothing_to_come(open);
    }

    /// Whether the contacts and collisions still to come can change no energy by a part of
    /// [`OVER`].
    fn nothing_to_come(&self, open: bool) -> bool {
        let (gaps, rates) = self.gaps_and_rates(self.clock.now);
        let energy = self.snapshot(&gaps, &rates, self.clock.now).energy();
        let spent = open || energy.elastic <= OVER * energy.kinetic;
        // E_r, too, must keep its digits, unless it is itself less than OVER of E.
        let least = energy
            .relative
            .max(OVER * energy.kinetic)
            .min(energy.kinetic);
        spent && most_to_lose(velocities(rates.into_iter()), &self.constants.masses) <= OVER * least
    }
}
