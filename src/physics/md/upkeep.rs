//! What a soft column looks after between steps: contacts, flights, and its numbers.

use super::chain::Chain;
use super::engine::{Md, fold};
use super::ground::Ground;
use super::stepper::{Power, Stepper};
use crate::physics::column::{OVER, nothing_to_come};
use crate::physics::{Engine, EngineError};

/// Steps between two looks at the numbers themselves.
pub(super) const HOUSEKEEPING: u64 = 32;
/// Steps between two looks at the energy.
const INSPECTION: u64 = 1024;
/// Steps that a time can count, 2^53.
pub(in crate::physics) const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

impl<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static> Md<S, G, C> {
    /// Looks which contacts began or ended in the last step.
    pub(super) fn note_contacts(&mut self) {
        let time = self.time();
        let floor_was_closed = self.state.books.contacts.closed()[0];
        for (i, g) in self.stepper.gaps().enumerate() {
            self.state.books.contacts.note(i, g <= 0.0, time);
        }
        let floor_is_closed = self.state.books.contacts.closed()[0];
        if floor_is_closed != floor_was_closed {
            let (gaps, rates) = (self.gaps(), self.rates());
            let arrival = self.moment(&gaps, &rates).arrival();
            self.state.books.bounce.turn(floor_is_closed, arrival);
        }
        if !G::PULLS && !self.over && self.state.books.contacts.all_open() {
            self.over = self.nothing_to_come();
        }
    }

    pub(super) fn nothing_to_come(&self) -> bool {
        nothing_to_come(self.rates().into_iter(), &self.masses)
    }

    /// Goes on in one flight to just before the next contact, if nothing pulls and no
    /// contact has been closed since the last look.
    pub(super) fn look_for_flight(&mut self) -> Result<(), EngineError> {
        let since = self.state.books.contacts.last().unwrap_or(self.origin);
        let settled = self.time() - since > HOUSEKEEPING as f64 * self.h;
        if G::PULLS || !settled || !self.state.books.contacts.all_open() {
            return Ok(());
        }
        let closing = |(g, w): (f64, f64)| if w < 0.0 { -g / w } else { f64::INFINITY };
        let gaps = self.stepper.gaps();
        let next = gaps
            .zip(self.rates())
            .map(closing)
            .fold(f64::INFINITY, f64::min);
        let ahead = next / self.h;
        if ahead.is_finite() && self.n as f64 + ahead >= MOST_STEPS && !self.over {
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

    /// Passes through a flight, up to grid point `last` at most.
    pub(super) fn fly(&mut self, last: u64) {
        let Some((from, end)) = self.flight else {
            return;
        };
        self.n = end.min(last).max(self.n);
        if self.n == end {
            self.stepper.coast(end - from);
            self.skipped += end - from;
            self.flight = None;
        }
    }

    /// Every so often, whatever the slices a run is advanced in.
    pub(super) fn housekeeping(&mut self) -> Result<(), EngineError> {
        fold(&mut self.state.books.ledger, &self.power, self.h);
        self.power = Power::default();
        self.stepper.clear();
        self.look_for_flight()?;
        let sound = self.stepper.gaps().sum::<f64>().is_finite();
        if sound && !self.n.is_multiple_of(INSPECTION) {
            return Ok(());
        }
        if !sound || self.lost_the_energy() {
            return Err(self.unstable());
        }
        // Overdamped contacts of heavy pairs never open, but spend all they have.
        if !G::PULLS && !self.over {
            let energy = self.moment(&self.gaps(), &self.rates()).energy();
            self.over = energy.elastic <= OVER * energy.kinetic && self.nothing_to_come();
        }
        Ok(())
    }

    /// Whether the ledger shows that the integration blows up.
    pub(super) fn lost_the_energy(&self) -> bool {
        let energy = self.moment(&self.gaps(), &self.rates()).energy();
        self.ledger().is_broken(energy, self.least_energy)
    }
}
