//! Power laws on a grid of time steps.

use super::chain::Law;
use super::lanes::Number;
use crate::physics::power_law::Spring;

/// A power law; `ATTRACTION` as in [`super::chain::Linear`].
#[derive(Clone, Copy)]
pub(crate) struct Powered<const ATTRACTION: bool>(pub Spring);

impl<const ATTRACTION: bool> Law for Powered<ATTRACTION> {
    #[inline]
    fn push<T: Number>(self, g: T, w: T) -> (T, T) {
        // Powers have no lanes of their own.
        T::singly(g, w, |g, w| {
            if g > 0.0 {
                return (0.0, 0.0);
            }
            let (elastic, dashpot) = self.0.elastic_and_dashpot(-g);
            let full = elastic - dashpot * w;
            let force = if ATTRACTION { full } else { full.max(0.0) };
            (force, (elastic - force) * w)
        })
    }
}
