//! Pacing: how far simulated time should have come by now, and how fast it went.

use std::time::{Duration, Instant};

/// Wall time that one tick may count: a suspended process does not leap.
const LONGEST_TICK: f64 = 0.1;
/// The achieved speed is measured over this long.
const WINDOW: Duration = Duration::from_millis(500);

/// A clock that runs `speed` simulated seconds in a second.
#[derive(Debug)]
pub(super) struct Clock {
    speed: f64,
    goal: f64,
    last: Instant,
    window: Option<(Instant, f64)>,
    achieved: Option<f64>,
}

impl Clock {
    pub(super) fn new(now: Instant) -> Clock {
        Clock {
            speed: 1.0,
            goal: 0.0,
            last: now,
            window: None,
            achieved: None,
        }
    }

    /// Simulated time to reach, s.
    pub(super) fn goal(&self) -> f64 {
        self.goal
    }

    /// Simulated seconds in a second, measured lately.
    pub(super) fn achieved(&self) -> Option<f64> {
        self.achieved
    }

    pub(super) fn set_speed(&mut self, speed: f64) {
        self.speed = speed;
        self.forget_pace();
    }

    /// Stands at `time`, from `now` on.
    pub(super) fn stand_at(&mut self, time: f64, now: Instant) {
        self.goal = time;
        self.last = now;
        self.forget_pace();
    }

    /// Asks for `time` although the clock stands.
    pub(super) fn ask_for(&mut self, time: f64) {
        self.goal = time;
    }

    /// Moves the goal on. The columns have come to `reached`; what they lag behind
    /// is caught up as long as it is less than a tick, and forgiven otherwise.
    pub(super) fn tick(&mut self, reached: f64, now: Instant) {
        let passed = now
            .duration_since(self.last)
            .as_secs_f64()
            .min(LONGEST_TICK);
        self.last = now;
        self.goal = (self.goal + self.speed * passed).min(reached + self.speed * LONGEST_TICK);
        self.measure(reached, now);
    }

    fn measure(&mut self, reached: f64, now: Instant) {
        let Some((since, start)) = self.window else {
            self.window = Some((now, reached));
            return;
        };
        let span = now.duration_since(since);
        if span >= WINDOW {
            self.achieved = Some((reached - start) / span.as_secs_f64());
            self.window = Some((now, reached));
        }
    }

    fn forget_pace(&mut self) {
        self.window = None;
        self.achieved = None;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A clock of this speed after 99 ticks, so many milliseconds apart, the columns
    /// having come to `reached` at each.
    fn ticked(speed: f64, apart: u64, reached: impl Fn(&Clock) -> f64) -> Clock {
        let start = Instant::now();
        let mut clock = Clock::new(start);
        clock.set_speed(speed);
        for k in 1..100 {
            clock.tick(reached(&clock), start + Duration::from_millis(apart * k));
        }
        clock
    }

    #[test]
    fn a_long_sleep_does_not_leap() {
        let start = Instant::now();
        let mut clock = Clock::new(start);
        clock.set_speed(0.5);
        clock.tick(0.0, start + Duration::from_secs(3600));
        assert!((clock.goal() - 0.5 * LONGEST_TICK).abs() < 1e-12);
    }

    #[test]
    fn columns_that_keep_up_have_the_speed_that_was_asked_for() {
        let clock = ticked(0.2, 20, Clock::goal);
        let achieved = clock.achieved().expect("two seconds have passed");
        assert!((achieved - 0.2).abs() < 1e-12);
    }

    #[test]
    fn a_lag_is_forgiven() {
        let clock = ticked(1.0, 50, |_| 0.0);
        assert!(clock.goal() <= LONGEST_TICK + 1e-12);
        assert_eq!(clock.achieved(), Some(0.0));
    }
}
