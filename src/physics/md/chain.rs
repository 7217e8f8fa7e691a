//! Forces in the contacts of a chain, and the accelerations of its gaps.

use crate::physics::power_law::Spring;

/// Contacts and masses of a chain.
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

/// The law of one contact, chosen at compile time.
pub(crate) trait Law: Copy + Send {
    /// Force of the contact at gap `g` with rate `w`, and the power that it loses, in
    /// mean bead masses; both 0 where g > 0. Beads just touching are in contact.
    fn push(self, g: f64, w: f64) -> (f64, f64);
}

/// The linear law. `ATTRACTION` says whether the short attractive end of a contact
/// acts, as in the paper, or is cut off.
#[derive(Clone, Copy)]
pub(crate) struct Linear<const ATTRACTION: bool>(pub Spring);

impl<const ATTRACTION: bool> Law for Linear<ATTRACTION> {
    #[inline]
    fn push(self, g: f64, w: f64) -> (f64, f64) {
        let elastic = -self.0.stiffness * g;
        let full = elastic - self.0.dashpot * w;
        let force = if ATTRACTION { full } else { full.max(0.0) };
        if g <= 0.0 {
            (force, (elastic - force) * w)
        } else {
            (0.0, 0.0)
        }
    }
}

/// Equal beads: the floor's contact, and one law for all others.
pub(crate) struct Equal<L> {
    floor: L,
    pair: L,
}

impl<L: Law> Equal<L> {
    /// The chain with these laws, those of all pairs being alike.
    pub fn new(laws: &[L]) -> Self {
        Self {
            floor: laws[0],
            pair: *laws.last().expect("a column has beads"),
        }
    }
}

impl<L: Law> Chain for Equal<L> {
    #[inline]
    fn pair(&self, _: usize, g: f64, w: f64) -> (f64, f64) {
        self.pair.push(g, w)
    }

    #[inline]
    fn floor(&self, g: f64, w: f64) -> (f64, f64) {
        self.floor.push(g, w)
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
pub(crate) struct Unequal<L> {
    laws: Vec<L>,
    inverse: Vec<f64>,
}

impl<L: Law> Unequal<L> {
    /// The chain with these laws, and masses in mean bead masses.
    pub fn new(laws: &[L], masses: &[f64]) -> Self {
        Self {
            laws: laws.to_vec(),
            inverse: masses.iter().map(|m| 1.0 / m).collect(),
        }
    }
}

impl<L: Law> Chain for Unequal<L> {
    #[inline]
    fn pair(&self, i: usize, g: f64, w: f64) -> (f64, f64) {
        self.laws[i].push(g, w)
    }

    #[inline]
    fn floor(&self, g: f64, w: f64) -> (f64, f64) {
        self.laws[0].push(g, w)
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
