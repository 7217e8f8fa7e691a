//! A grid of time steps, and the flights that pass over parts of it: what all engines
//! of a fixed step share, whatever they move.

use super::EngineError;
use crate::scene::{Integrator, Scene};

/// Steps between two looks at the numbers themselves.
pub(crate) const HOUSEKEEPING: u64 = 32;
/// Steps between two looks at the energy.
const INSPECTION: u64 = 1024;
/// Steps that a time can count, 2^53.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

/// What a scene on a grid has.
#[derive(Clone, Copy)]
pub(crate) struct Settings {
    pub integrator: Integrator,
    /// t_c, s.
    pub contact_time: f64,
    pub steps_per_contact: f64,
}

impl Settings {
    /// Of a scene of soft contacts on a grid, as `physics::build` hands them out.
    pub fn of(scene: &Scene) -> Self {
        let (Some(grid), Some(contact_time)) = (scene.grid(), scene.contact_time()) else {
            unreachable!("physics::build hands scenes on a grid to engines of fixed steps");
        };
        Self {
            integrator: grid.integrator,
            contact_time,
            steps_per_contact: grid.steps_per_contact,
        }
    }

    /// One step, s.
    pub fn step(&self) -> f64 {
        self.contact_time / self.steps_per_contact
    }
}

/// Where on its grid an engine is.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Grid {
    /// Time of grid point 0, s: the start, or the last edit.
    origin: f64,
    /// One step, s.
    pub h: f64,
    /// Grid points done.
    n: u64,
    /// Where a flight without any contact or force began and where it will be
    /// stepped again; in between all moves at constant rates and needs no steps.
    flight: Option<(u64, u64)>,
    /// Grid points passed in finished flights.
    skipped: u64,
}

impl Grid {
    /// A grid of steps of `h` s that begins at `origin` s.
    pub fn new(origin: f64, h: f64) -> Self {
        Self {
            origin,
            h,
            n: 0,
            flight: None,
            skipped: 0,
        }
    }

    /// Time now, s.
    pub fn time(&self) -> f64 {
        self.at(self.n)
    }

    fn at(&self, n: u64) -> f64 {
        self.origin + n as f64 * self.h
    }

    /// The last grid point not after `until`.
    pub fn last_step(&self, until: f64) -> u64 {
        let estimate = ((until - self.origin) / self.h).max(0.0);
        if estimate >= MOST_STEPS {
            return u64::MAX;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 2^53"
        )]
        let mut n = estimate as u64;
        while n > 0 && self.at(n) > until {
            n -= 1;
        }
        while self.at(n + 1) <= until {
            n += 1;
        }
        n
    }

    /// Steps to take now, of `budget`: not past `target`, nor past a look at the numbers;
    /// none when the target is reached.
    pub fn ahead(&self, target: u64, budget: u64) -> u64 {
        budget
            .min(target.saturating_sub(self.n))
            .min(HOUSEKEEPING - self.n % HOUSEKEEPING)
    }

    /// So many steps were taken.
    pub fn stepped(&mut self, steps: u64) {
        self.n += steps;
    }

    /// Whether the numbers are to be looked at.
    pub fn is_due(&self) -> bool {
        self.n.is_multiple_of(HOUSEKEEPING)
    }

    /// Whether the energy is to be looked at, too.
    pub fn is_inspected(&self) -> bool {
        self.n.is_multiple_of(INSPECTION)
    }

    /// Steps taken one by one.
    pub fn steps(&self) -> u64 {
        let flying = self.flight.map_or(0, |(from, _)| self.n - from);
        self.n - self.skipped - flying
    }

    /// Moves places on to now in a flight that is not yet at its end.
    pub fn fly_on(&self, places: &mut [f64], rates: &[f64]) {
        if let Some((from, _)) = self.flight {
            let flown = (self.n - from) as f64 * self.h;
            for (place, rate) in places.iter_mut().zip(rates) {
                *place += flown * rate;
            }
        }
    }

    /// Whether nothing has changed for so long, since the time of the last change, that
    /// derivatives of an integrator have died away.
    pub fn is_settled(&self, since: Option<f64>) -> bool {
        self.time() - since.unwrap_or(self.origin) > HOUSEKEEPING as f64 * self.h
    }

    /// Begins a flight that ends just before the next contact, `time` s ahead.
    ///
    /// # Errors
    /// When that is further than steps can be counted, unless all is `over`.
    pub fn take_off(&mut self, time: f64, over: bool) -> Result<(), EngineError> {
        let ahead = time / self.h;
        if ahead.is_finite() && self.n as f64 + ahead >= MOST_STEPS && !over {
            return Err(EngineError::BeyondTime {
                time: self.time(),
                steps: ahead,
            });
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count of steps, or infinite"
        )]
        let steps = ahead.min(u64::MAX as f64) as u64;
        // The last steps are done one by one: the closed form must not overshoot.
        let steps = steps.saturating_sub(2) / HOUSEKEEPING * HOUSEKEEPING;
        if steps > 0 {
            self.flight = Some((self.n, self.n.saturating_add(steps)));
        }
        Ok(())
    }

    /// Passes through a flight, up to grid point `last` at most; its steps, if it ends.
    pub fn fly(&mut self, last: u64) -> Option<u64> {
        let (from, end) = self.flight?;
        self.n = end.min(last).max(self.n);
        if self.n < end {
            return None;
        }
        self.skipped += end - from;
        self.flight = None;
        Some(end - from)
    }

    /// Whether it has come to a grid point.
    pub fn has_come(&self, target: u64) -> bool {
        self.n >= target
    }
}
