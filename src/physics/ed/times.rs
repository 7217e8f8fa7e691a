//! The epoch that all times are counted from. It moves on with the collisions, so that times
//! keep their digits.

use super::{Ed, Rule};
use crate::physics::ground::Ground;

/// A gap of N closes soon when it closes within this part over N of the time since the epoch.
///
/// A flight that is short against the time since the epoch loses digits, since it is a
/// difference of two such times. The epoch moves to now before a flight that closes soon, so
/// that a flight loses a factor 16 N at most. By chance one in some 16 N flights closes soon,
/// so that the O(N) of a move is cheap.
const SOON: f64 = 1.0 / 16.0;

/// A gap of `n` closes soon when it closes before this multiple of now.
pub(super) fn soonest(n: usize) -> f64 {
    1.0 + SOON / n as f64
}

impl<G: Ground, R: Rule> Ed<G, R> {
    /// Notes that of the gaps scheduled at `t` the first closes at `soonest`.
    #[inline]
    pub(super) fn look_ahead(&mut self, soonest: f64, t: f64) {
        self.soon |= soonest < t * self.soonest;
    }

    /// Moves the epoch on by so many units of time.
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

    /// Moves the epoch to now, and schedules all gaps again: what closes soon then has the
    /// digits of its flight, not of the time before.
    pub(super) fn follow(&mut self) {
        self.move_epoch(self.now);
        self.schedule(0, self.gaps.len() - 1);
        self.schedule_take_off();
        self.soon = false;
    }
}
