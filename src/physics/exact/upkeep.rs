//! What is noted when contacts change, and when the collision is over.

use super::{Exact, INSPECTION, Mode};
use crate::physics::column::{OVER, most_to_lose, much_to_come, reduced_mass, velocities};
use crate::physics::flight::Ground;
use crate::physics::moment::translation;
use crate::physics::power_law::Spring;

impl<G: Ground> Exact<G> {
    /// Gap `i` begins or ends to be a contact, or its attraction begins or ends.
    pub(super) fn change(&mut self, i: usize, mode: Mode, t: f64) {
        let was_closed = self.modes[i] != Mode::Open;
        let closed = mode != Mode::Open;
        self.modes[i] = mode;
        if i <= self.end[0] {
            self.repose.disturb();
        }
        if closed == was_closed {
            self.without_force(i);
            return;
        }
        self.gaps[i].g = 0.0;
        self.state.books.events += 1;
        self.state.books.contacts.note(i, closed, self.absolute(t));
        if i == 0 {
            self.note_floor(closed, t);
        }
    }

    /// Makes the force of contact `i`, which is zero now, zero to the last bit: by the one
    /// of overlap and rate that the other determines better.
    fn without_force(&mut self, i: usize) {
        let Spring {
            stiffness, dashpot, ..
        } = self.springs[i];
        let gap = &mut self.gaps[i];
        if dashpot * dashpot <= stiffness * reduced_mass(&self.masses, i) {
            gap.g = -dashpot * gap.w / stiffness;
        } else {
            gap.w = -stiffness * gap.g / dashpot;
        }
    }

    /// The floor's contact begins or ends. A column that has arrived and meets the floor
    /// again is part of the same bounce, and not measured: that would cost O(N).
    fn note_floor(&mut self, closed: bool, t: f64) {
        if closed && self.state.books.bounce.has_arrived() {
            return;
        }
        let n = self.gaps.len();
        let mut room = std::mem::take(&mut self.room);
        self.all_at(t, &mut room.a, &mut room.b);
        // The floor's own cluster has been brought here: its plan is spent.
        for (i, gap) in self.gaps[..self.end[0]].iter().enumerate() {
            (room.a[i], room.b[i]) = (gap.g, gap.w);
        }
        let (gaps, rates) = (&room.a[..n], &room.b[..n]);
        if closed {
            let arrival = self.moment(gaps, rates, t).arrival();
            self.state.books.bounce.begin(arrival);
        } else {
            let leaving = translation(rates.iter().copied(), &self.masses);
            self.state.books.bounce.end(leaving);
        }
        self.room = room;
    }

    /// Whether a floor collision without gravity is over, looked at when all contacts
    /// have opened and now and then: overdamped contacts of heavy pairs never open, but
    /// spend all they have.
    pub(super) fn look_whether_over(&mut self) {
        if G::PULLS || self.over {
            return;
        }
        let open = self.state.books.contacts.all_open();
        let (events, steps) = (self.state.books.events, self.state.books.steps);
        // Once in N contacts is enough, and costs each of them O(1).
        let due = if open {
            events >= self.check_at.0
        } else {
            steps >= self.check_at.1
        };
        if !due {
            return;
        }
        self.check_at = (events + self.gaps.len() as u64, steps + INSPECTION);
        let (next, when) = self.queue.first();
        let rate = self.gaps[next].w;
        if open
            && when.is_finite()
            && much_to_come(&self.masses, next, rate, OVER * self.energy_at_first)
        {
            return;
        }
        self.over = self.nothing_to_come(open);
    }

    /// Whether contacts and collisions still to come can change nothing that shows.
    fn nothing_to_come(&self, open: bool) -> bool {
        let (gaps, rates) = self.gaps_and_rates(self.now);
        let energy = self.moment(&gaps, &rates, self.now).energy();
        let spent = open || energy.elastic <= OVER * energy.kinetic;
        // Of E_r, too, no part is to be lost that would show, unless it is nothing itself.
        let least = energy
            .relative
            .max(OVER * energy.kinetic)
            .min(energy.kinetic);
        spent && most_to_lose(velocities(rates.into_iter()), &self.masses) <= OVER * least
    }
}
