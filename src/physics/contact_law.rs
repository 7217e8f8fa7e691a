//! Contact laws as engines on a grid of steps compute them, known when the program is
//! compiled.
//!
//! Beside `scene::law`, where a law says what it is, this is the one file that names the
//! laws: a new one does not compile until both know it.

use std::collections::BTreeMap;

use super::Engine;
use super::lanes::Number;
use super::spring::Spring;
use crate::scene::{Law, Scene};

/// What is built for a contact law.
pub(super) trait UnderLaw {
    /// Builds it for this law of each contact's spring and dashpot.
    fn under<L: ContactLaw + 'static>(self, law: impl Fn(Spring) -> L) -> Box<dyn Engine>;
}

/// Builds for the law of the scene's contacts, which are soft.
pub(super) fn build(scene: &Scene, what: impl UnderLaw) -> Box<dyn Engine> {
    let soft = scene.soft().expect("the scene's contacts are soft");
    match (soft.law, soft.attraction) {
        (Law::Hooke { .. }, true) => what.under(Linear::<true>),
        (Law::Hooke { .. }, false) => what.under(Linear::<false>),
        (Law::Power(_), true) => what.under(Powered::<true>),
        (Law::Power(_), false) => what.under(Powered::<false>),
    }
}

/// The law of one contact, chosen at compile time.
pub(crate) trait ContactLaw: Copy + Send {
    /// What a contact knows of its own past, such as its largest overlap; `()` under a law
    /// that goes by gap and rate alone. A contact begins with the default one, also where
    /// another engine's state goes on. Solvers that are on no grid know of none, which is
    /// what [`Law::allows`] has to say.
    type Memory: Copy + Default + Send;

    /// Force of the contact at gap `g` with rate `w`, and the power that it loses, in
    /// mean bead masses; both 0 where g > 0, where the memory ends. Beads just touching are
    /// in contact. Asked once a step.
    fn push<T: Number>(self, g: T, w: T, memory: &mut T::Each<Self::Memory>) -> (T, T);
}

/// The memories of many contacts, or of groups of them. There are none to look up where they
/// are `()`.
#[derive(Debug, Clone)]
pub(crate) struct Memories<M>(Vec<M>);

impl<M: Copy + Default> Memories<M> {
    /// Whether there is nothing to remember.
    pub const ARE_NONE: bool = size_of::<M>() == 0;

    /// Those of so many contacts that begin.
    pub fn new(count: usize) -> Self {
        Self(vec![M::default(); count])
    }

    /// Lets `act` use the memory of contact `k`.
    #[inline]
    pub fn with<R>(&mut self, k: usize, act: impl FnOnce(&mut M) -> R) -> R {
        if Self::ARE_NONE {
            act(&mut M::default())
        } else {
            act(&mut self.0[k])
        }
    }

    /// Puts them into another order: contacts that were there before keep theirs, others begin.
    pub fn reorder<K: Ord>(&mut self, before: &[K], now: &[K]) {
        let known: BTreeMap<&K, &M> = before.iter().zip(&self.0).collect();
        let own = |contact| known.get(contact).copied().copied().unwrap_or_default();
        self.0 = now.iter().map(own).collect();
    }
}

/// The linear law. `ATTRACTION` says whether the short attractive end of a contact
/// acts, as in the paper, or is cut off.
#[derive(Clone, Copy)]
pub(crate) struct Linear<const ATTRACTION: bool>(pub Spring);

impl<const ATTRACTION: bool> ContactLaw for Linear<ATTRACTION> {
    type Memory = ();

    #[inline]
    fn push<T: Number>(self, g: T, w: T, _: &mut T::Each<()>) -> (T, T) {
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
    type Memory = ();

    #[inline]
    fn push<T: Number>(self, g: T, w: T, memory: &mut T::Each<()>) -> (T, T) {
        // Powers have no lanes of their own.
        T::singly(g, w, memory, |g, w, ()| {
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

/// Each contact pushes with the number of looks since it began.
#[cfg(test)]
#[derive(Debug, Clone, Copy)]
pub(crate) struct Counting;

#[cfg(test)]
impl ContactLaw for Counting {
    type Memory = u32;

    fn push<T: Number>(self, g: T, w: T, memory: &mut T::Each<u32>) -> (T, T) {
        T::singly(g, w, memory, |g, _, looks| {
            *looks = if g > 0.0 { 0 } else { *looks + 1 };
            (f64::from(*looks), 0.0)
        })
    }
}
