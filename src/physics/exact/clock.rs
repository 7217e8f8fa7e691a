//! The engine's time: an epoch that moves on, and a short time counted from it.

use crate::math;
use crate::physics::epoch::Epoch;

/// Length of a tick in contact times. A time from the epoch is rounded to a bit of its
/// size, and a flight through a gap to a bit of its length. Short ticks keep the first
/// below the second.
const TICK: f64 = 2.0;
/// Beads per event before the epoch may move again: a move costs O(N), and this spreads
/// the cost to O(1) an event.
const BEADS_AN_EVENT: usize = 4;

/// The epoch, and now.
#[derive(Clone, Debug)]
pub(super) struct EpochClock {
    pub epoch: Epoch,
    /// Length of a tick, s. It is a power of two, so that a move of the epoch rounds
    /// nothing but the times it is subtracted from.
    tick: f64,
    /// Now, s from the epoch.
    pub now: f64,
    /// Events since the epoch last moved.
    events: usize,
    /// Events in a row between which no time passed.
    standstill: usize,
}

impl EpochClock {
    pub fn new(origin: f64, contact_time: f64) -> Self {
        Self {
            epoch: Epoch::new(origin),
            tick: math::exp2(math::log2(TICK * contact_time).round()),
            now: 0.0,
            events: 0,
            standstill: 0,
        }
    }

    /// Length of a tick, s.
    pub fn tick(&self) -> f64 {
        self.tick
    }

    /// Counts an event that ends a plan of `taken` s.
    pub fn count_event(&mut self, taken: f64) {
        self.events += 1;
        self.standstill = if taken > 0.0 { 0 } else { self.standstill + 1 };
    }

    /// Whether so many events came at one instant that a column of `n` beads cannot leave it.
    pub fn stands_still(&self, n: usize) -> bool {
        self.standstill > 1000 + 20 * n
    }

    /// Moves the epoch to the last tick before now, if a column of `n` beads has had the
    /// events to pay for it. By how much it moved, s.
    pub fn move_epoch(&mut self, n: usize) -> Option<f64> {
        if self.now < self.tick || BEADS_AN_EVENT * self.events < n {
            return None;
        }
        self.events = 0;
        let shift = (self.now / self.tick).floor() * self.tick;
        self.epoch.move_on(shift);
        self.now -= shift;
        Some(shift)
    }
}
