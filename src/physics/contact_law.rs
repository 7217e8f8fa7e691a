//! Contact laws as engines on a grid of steps compute them, known when the program is
//! compiled.
//!
//! Beside `scene::law`, where a law says what it is, this is the one file that names the
//! laws: a new one does not compile until both know it.

use super::Engine;
use super::lanes::Number;
use super::spring::Spring;
use crate::scene::{Law, Soft};

/// What is built for a contact law.
pub(super) trait UnderLaw {
    /// Builds it for this law of each contact's spring and dashpot.
    fn under<L: ContactLaw + 'static>(self, law: impl Fn(Spring) -> L) -> Box<dyn Engine>;
}

/// Builds for the law of these soft contacts.
pub(super) fn build(soft: &Soft, what: impl UnderLaw) -> Box<dyn Engine> {
    match (soft.law, soft.attraction) {
        (Law::Hooke { .. }, true) => what.under(Linear::<true>),
        (Law::Hooke { .. }, false) => what.under(Linear::<false>),
        (Law::Power(_), true) => what.under(Powered::<true>),
        (Law::Power(_), false) => what.under(Powered::<false>),
    }
}

/// The law of one contact, chosen at compile time.
pub(crate) trait ContactLaw: Copy + Send {
    /// Force of the contact at gap `g` with rate `w`, and the power that it loses, in
    /// mean bead masses; both 0 where g > 0. Beads just touching are in contact.
    fn push<T: Number>(self, g: T, w: T) -> (T, T);
}

/// The linear law. `ATTRACTION` says whether the short attractive end of a contact
/// acts, as in the paper, or is cut off.
#[derive(Clone, Copy)]
pub(crate) struct Linear<const ATTRACTION: bool>(pub Spring);

impl<const ATTRACTION: bool> ContactLaw for Linear<ATTRACTION> {
    #[inline]
    fn push<T: Number>(self, g: T, w: T) -> (T, T) {
        let elastic = g * -self.0.stiffness;
        let full = elastic - w * self.0.dashpot;
        let force = if ATTRACTION { full } else { full.positive() };
        let power = (elastic - force) * w;
        (force.where_closed(g), power.where_closed(g))
    }
}

/// A power law; `ATTRACTION` as in [`Linear`].
#[derive(Clone, Copy)]
pub(crate) struct Powered<const ATTRACTION: bool>(pub Spring);

impl<const ATTRACTION: bool> ContactLaw for Powered<ATTRACTION> {
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
