//! What is noted when a contact begins, ends, or loses its force.

use super::{ContactMode, Exact};
use crate::physics::column::reduced_mass;
use crate::physics::ground::Ground;
use crate::physics::matter::{Matter, translation};
use crate::physics::shell::Mover;
use crate::physics::spring::Spring;

impl<G: Ground> Exact<G> {
    /// Gap `i` begins to do what `mode` says, at `t`.
    pub(super) fn change(&mut self, i: usize, mode: ContactMode, t: f64) {
        let was_closed = self.modes[i] != ContactMode::Open;
        let closed = mode != ContactMode::Open;
        self.modes[i] = mode;
        if i <= self.clusters.end(0) {
            self.stacks.disturb();
        }
        if closed == was_closed {
            // The attraction is cut off, or the contact begins to push again.
            self.without_force(i);
            return;
        }
        self.gaps[i].g = 0.0;
        self.books.events += 1;
        self.books
            .contacts
            .note(i, closed, self.clock.epoch.absolute(t));
        if i == 0 {
            self.note_floor(closed, t);
        }
    }

    /// Makes the force of contact `i`, which is zero but for rounding, zero to the last bit.
    /// Overlap or rate is set from the other: the one that the other determines better.
    fn without_force(&mut self, i: usize) {
        let Spring {
            stiffness, dashpot, ..
        } = self.constants.column.springs[i];
        let gap = &mut self.gaps[i];
        if dashpot * dashpot <= stiffness * reduced_mass(&self.constants.column.masses, i) {
            gap.g = -dashpot * gap.w / stiffness;
        } else {
            gap.w = -stiffness * gap.g / dashpot;
        }
    }

    /// The floor's contact begins or ends at `t`. Where a column that has arrived meets the
    /// floor again, that is part of the same bounce, and the O(N) of a look is saved.
    fn note_floor(&mut self, closed: bool, t: f64) {
        if closed && self.books.bounce.has_arrived() {
            return;
        }
        let n = self.gaps.len();
        let mut work = std::mem::take(&mut self.workspace);
        self.all_at(t, &mut work.a, &mut work.b);
        // The floor's own cluster has been brought to `t`, and its plan is spent.
        let lowest = &self.gaps[..self.clusters.end(0)];
        for (i, gap) in lowest.iter().enumerate() {
            (work.a[i], work.b[i]) = (gap.g, gap.w);
        }
        let (gaps, rates) = (&work.a[..n], &work.b[..n]);
        if closed {
            let arrival = self
                .matter()
                .arrival(&self.snapshot(gaps.to_vec(), rates.to_vec()));
            self.books.bounce.begin(arrival);
        } else {
            let leaving = translation(rates.iter().copied(), &self.constants.column.masses);
            self.books.bounce.end(leaving);
        }
        self.workspace = work;
    }
}
