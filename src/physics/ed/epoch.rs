//! The epoch that all times are counted from, and that follows the collisions.

use super::{Ed, Rule};
use crate::physics::flight::Ground;

/// The epoch follows where a gap closes again within 1/(16 N) of the time since it: so many
/// of the digits of a flight may be lost to the digits of its time. By chance this happens
/// once in some 16 N collisions, so that following, O(N), costs next to nothing.
const SOON: f64 = 1.0 / 16.0;

/// Multiple of now before which a gap of one of `n` closes soon.
pub(super) fn soonest(n: usize) -> f64 {
    1.0 + SOON / n as f64
}

impl<G: Ground, R: Rule> Ed<G, R> {
    /// A gap that closes next at `soonest` was scheduled at `t`.
    #[inline]
    pub(super) fn look_ahead(&mut self, soonest: f64, t: f64) {
        self.soon |= soonest < t * self.soonest;
    }

    /// Moves the epoch on by so much, so that times keep their digits.
    pub(super) fn move_epoch(&mut self, by: f64) {
        self.ground.move_epoch(by);
        self.epoch.add(by);
        for gap in &mut self.gaps {
            gap.t -= by;
        }
        self.rule.shift(by);
        self.shift_tally(by);
        self.queue.shift(by);
        self.now -= by;
        self.queue.set(self.gaps.len() + 1, self.ground.tick());
    }

    /// Makes now the epoch, and schedules all gaps again: what closes soon is then known
    /// to a part of its flight, not of the time before.
    pub(super) fn follow(&mut self) {
        self.move_epoch(self.now);
        self.schedule(0, self.gaps.len() - 1);
        self.schedule_take_off();
        self.soon = false;
    }
}
