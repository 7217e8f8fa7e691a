//! What every fixed-step integrator does.

use super::chain::Chain;
use super::ground::Ground;

/// What an integrator does. Its state is gaps, rates and derivatives of its own.
pub(super) trait Stepper: Send + Sized {
    /// Starts from gaps and rates, with forces in force now and steps of `h` s.
    fn start<C: Chain, G: Ground>(
        gaps: &[f64],
        rates: &[f64],
        h: f64,
        chain: &C,
        ground: &G,
    ) -> Self;
    /// One step; whether any gap may have changed between contact and flight.
    fn step<C: Chain, G: Ground>(&mut self, chain: &C, ground: &mut G) -> bool;
    /// Flies on for `steps` steps at constant rates.
    fn coast(&mut self, steps: u64);
    /// The gaps, m.
    fn gaps(&self) -> &[f64];
    /// Writes the rates, m/s.
    fn rates(&self, into: &mut Vec<f64>);
    /// What contacts have lost since this was last cleared, m²/s².
    fn lost(&self) -> f64;
    /// Work of the plate since this was last cleared, m²/s².
    fn plate_work(&self) -> f64;
    /// Clears both, and numbers too small to matter: in free flight derivatives decay
    /// into subnormals, which cost 20 to 40 times as much to compute with.
    fn clear(&mut self);
}

/// Sets to zero what is too small to matter to anything (lengths of 10⁻²⁰⁰ m).
pub(super) fn flush(row: &mut [f64]) {
    for x in row {
        if x.abs() < 1e-200 {
            *x = 0.0;
        }
    }
}
