//! Forces in the contacts of a chain, and the accelerations of its gaps.

use crate::physics::power_law::Spring;

/// Contacts and masses of a chain. `ATTRACTION` of the implementations says whether
/// the short attractive end of a contact acts, as in the paper, or is cut off.
pub(crate) trait Chain: Send {
    /// Force of the contact at gap `i` > 0, and the power it loses, at gap `g` with
    /// rate `w`; in mean bead masses. Beads just touching are in contact.
    fn pair(&self, i: usize, g: f64, w: f64) -> (f64, f64);

    /// The same for the contact with the floor.
    fn floor(&self, g: f64, w: f64) -> (f64, f64);

    /// Acceleration of gap `i` > 0 under the contact forces, `forces[n]` being the
    /// free end's, 0.
    fn acceleration(&self, forces: &[f64], i: usize) -> f64;

    /// Acceleration of bead 1, that is of gap 0 over a floor that does not accelerate.
    fn first(&self, forces: &[f64]) -> f64;
}

#[inline]
fn push<const ATTRACTION: bool>(spring: Spring, g: f64, w: f64) -> (f64, f64) {
    let elastic = -spring.stiffness * g;
    let full = elastic - spring.dashpot * w;
    let force = if ATTRACTION { full } else { full.max(0.0) };
    if g <= 0.0 {
        (force, (elastic - force) * w)
    } else {
        (0.0, 0.0)
    }
}

/// Equal beads: the floor's contact, and one law for all others.
pub(crate) struct Equal<const ATTRACTION: bool> {
    floor: Spring,
    pair: Spring,
}

impl<const ATTRACTION: bool> Equal<ATTRACTION> {
    /// The chain with these springs, those of all pairs being alike.
    pub fn new(springs: &[Spring]) -> Self {
        Self {
            floor: springs[0],
            pair: *springs.last().expect("a column has beads"),
        }
    }
}

impl<const ATTRACTION: bool> Chain for Equal<ATTRACTION> {
    #[inline]
    fn pair(&self, _: usize, g: f64, w: f64) -> (f64, f64) {
        push::<ATTRACTION>(self.pair, g, w)
    }

    #[inline]
    fn floor(&self, g: f64, w: f64) -> (f64, f64) {
        push::<ATTRACTION>(self.floor, g, w)
    }

    #[inline]
    fn acceleration(&self, forces: &[f64], i: usize) -> f64 {
        2.0 * forces[i] - forces[i - 1] - forces[i + 1]
    }

    #[inline]
    fn first(&self, forces: &[f64]) -> f64 {
        forces[0] - forces[1]
    }
}

/// Beads of different masses: a law a contact, a mass a bead.
pub(crate) struct Unequal<const ATTRACTION: bool> {
    springs: Vec<Spring>,
    inverse: Vec<f64>,
}

impl<const ATTRACTION: bool> Unequal<ATTRACTION> {
    pub fn new(springs: &[Spring], masses: &[f64]) -> Self {
        Self {
            springs: springs.to_vec(),
            inverse: masses.iter().map(|m| 1.0 / m).collect(),
        }
    }
}

impl<const ATTRACTION: bool> Chain for Unequal<ATTRACTION> {
    #[inline]
    fn pair(&self, i: usize, g: f64, w: f64) -> (f64, f64) {
        push::<ATTRACTION>(self.springs[i], g, w)
    }

    #[inline]
    fn floor(&self, g: f64, w: f64) -> (f64, f64) {
        push::<ATTRACTION>(self.springs[0], g, w)
    }

    #[inline]
    fn acceleration(&self, forces: &[f64], i: usize) -> f64 {
        (forces[i] - forces[i + 1]) * self.inverse[i]
            - (forces[i - 1] - forces[i]) * self.inverse[i - 1]
    }

    #[inline]
    fn first(&self, forces: &[f64]) -> f64 {
        (forces[0] - forces[1]) * self.inverse[0]
    }
}

/// Forces of all contacts at these gaps and rates, with the free end's 0.
pub(super) fn forces<C: Chain>(chain: &C, gaps: &[f64], rates: &[f64]) -> Vec<f64> {
    let mut forces = vec![0.0; gaps.len() + 1];
    forces[0] = chain.floor(gaps[0], rates[0]).0;
    for i in 1..gaps.len() {
        forces[i] = chain.pair(i, gaps[i], rates[i]).0;
    }
    forces
}
