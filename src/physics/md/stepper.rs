//! What every fixed-step integrator does.

use super::chain::Chain;
use super::pace::Pace;
use crate::physics::ground::Ground;
use crate::physics::lanes::Lane;
use crate::physics::ledger::Ledger;

/// What an integrator does. Its state is gaps, rates and derivatives of its own.
pub(super) trait Stepper: Clone + Send {
    /// Starts from gaps and rates, with forces in force now and steps of `h` s.
    fn start<C: Chain, G: Ground>(
        gaps: &[f64],
        rates: &[f64],
        h: f64,
        chain: &mut C,
        ground: &Pace<G>,
    ) -> Self;
    /// One step, the floor's included; whether any gap may have changed between
    /// contact and flight.
    fn step<C: Chain, G: Ground>(
        &mut self,
        chain: &mut C,
        ground: &mut Pace<G>,
        power: &mut Power,
    ) -> bool;
    /// Flies on for `steps` steps at constant rates.
    fn coast(&mut self, steps: u64);
    /// The gaps, m.
    fn gaps(&self) -> impl Iterator<Item = f64>;
    /// The rates, m/s.
    fn rates<C: Chain, G: Ground>(&self, chain: &C, ground: &Pace<G>) -> Vec<f64>;
    /// Clears numbers too small to matter: in free flight derivatives decay into
    /// subnormals, which cost 20 to 40 times as much to compute with.
    fn clear(&mut self);
}

/// Powers summed over steps, m²/s³.
#[derive(Clone, Copy, Default)]
pub(super) struct Power {
    /// Lost in the floor's contact, and in the others, a sum a lane.
    pub lost: (f64, Lane),
    /// Put in by the plate.
    pub plate: f64,
}

impl Power {
    /// Puts what was lost and put in, in steps of `h` s, into a ledger.
    pub fn account(&self, ledger: &mut Ledger, h: f64) {
        let (floor, pairs) = self.lost;
        let lost = floor + pairs.to_array().iter().sum::<f64>();
        ledger.lost.add(lost * h);
        ledger.plate_work.add(self.plate * h);
    }
}
