//! Forces in the contacts of a chain, and the accelerations of its gaps.

use crate::physics::contact_law::{ContactLaw, Memories};
use crate::physics::lanes::{LANES, Lane, Number, grouped, neighbours};

/// Contacts and masses of a chain.
pub(crate) trait Chain: Clone + Send {
    /// Force of the floor's contact and the power it loses, as in [`ContactLaw::push`].
    fn floor(&mut self, g: f64, w: f64) -> (f64, f64);

    /// The same for the contacts of group `k`; also asked for the gaps beyond the last
    /// bead that fill up a group.
    fn pairs(&mut self, k: usize, g: Lane, w: Lane) -> (Lane, Lane);

    /// Accelerations of the gaps of group `k` under their own contacts' forces and
    /// those of the contacts below and above them.
    fn accelerations(&self, k: usize, below: Lane, here: Lane, above: Lane) -> Lane;

    /// Acceleration of bead 1, that is of gap 0 over a floor that does not accelerate.
    fn first(&self, here: f64, above: f64) -> f64;
}

/// What the contacts of a group remember under law `L`.
type Group<L> = <Lane as Number>::Each<<L as ContactLaw>::Memory>;

/// Equal beads: the floor's contact, and one law for all others.
#[derive(Clone)]
pub(crate) struct Equal<L: ContactLaw> {
    floor: (L, L::Memory),
    pair: L,
    memories: Memories<Group<L>>,
}

impl<L: ContactLaw> Equal<L> {
    /// The chain with these laws, those of all pairs being alike.
    pub fn new(laws: &[L]) -> Self {
        Self {
            floor: (laws[0], L::Memory::default()),
            pair: *laws.last().expect("a column has beads"),
            memories: Memories::new(laws[1..].len().div_ceil(LANES)),
        }
    }
}

impl<L: ContactLaw> Chain for Equal<L> {
    #[inline]
    fn floor(&mut self, g: f64, w: f64) -> (f64, f64) {
        let (law, memory) = &mut self.floor;
        law.push(g, w, memory)
    }

    #[inline]
    fn pairs(&mut self, k: usize, g: Lane, w: Lane) -> (Lane, Lane) {
        let pair = self.pair;
        self.memories.with(k, |memory| pair.push(g, w, memory))
    }

    #[inline]
    fn accelerations(&self, _: usize, below: Lane, here: Lane, above: Lane) -> Lane {
        here + here - below - above
    }

    #[inline]
    fn first(&self, here: f64, above: f64) -> f64 {
        here - above
    }
}

/// Beads of different masses: a law a contact, a mass a bead.
#[derive(Clone)]
pub(crate) struct Unequal<L: ContactLaw> {
    floor: (L, L::Memory),
    pairs: Vec<[L; LANES]>,
    memories: Memories<Group<L>>,
    /// 1/m of bead 1, of the beads above each gap, and of those below.
    first: f64,
    above: Vec<Lane>,
    below: Vec<Lane>,
}

impl<L: ContactLaw> Unequal<L> {
    /// The chain with these laws, and masses in mean bead masses.
    pub fn new(laws: &[L], masses: &[f64]) -> Self {
        let inverse: Vec<f64> = masses.iter().map(|m| 1.0 / m).collect();
        let shifted: Vec<f64> = std::iter::once(0.0)
            .chain(inverse.iter().copied())
            .collect();
        let group = |chunk: &[L]| std::array::from_fn(|l| chunk[l.min(chunk.len() - 1)]);
        Self {
            floor: (laws[0], L::Memory::default()),
            pairs: laws[1..].chunks(LANES).map(group).collect(),
            memories: Memories::new(laws[1..].len().div_ceil(LANES)),
            first: inverse[0],
            above: grouped(&inverse, 0.0),
            below: grouped(&shifted[..masses.len()], 0.0),
        }
    }
}

impl<L: ContactLaw> Chain for Unequal<L> {
    #[inline]
    fn floor(&mut self, g: f64, w: f64) -> (f64, f64) {
        let (law, memory) = &mut self.floor;
        law.push(g, w, memory)
    }

    #[inline]
    fn pairs(&mut self, k: usize, g: Lane, w: Lane) -> (Lane, Lane) {
        let (g, w) = (g.to_array(), w.to_array());
        let (mut forces, mut powers) = ([0.0; LANES], [0.0; LANES]);
        let pairs = &self.pairs[k];
        self.memories.with(k, |memory| {
            for (l, law) in pairs.iter().enumerate() {
                (forces[l], powers[l]) = law.push(g[l], w[l], &mut memory[l]);
            }
        });
        (Lane::new(forces), Lane::new(powers))
    }

    #[inline]
    fn accelerations(&self, k: usize, below: Lane, here: Lane, above: Lane) -> Lane {
        (here - above) * self.above[k] - (below - here) * self.below[k]
    }

    #[inline]
    fn first(&self, here: f64, above: f64) -> f64 {
        (here - above) * self.first
    }
}

/// Contact forces of a chain.
#[derive(Clone)]
pub(super) struct Forces {
    /// In the floor's contact.
    pub floor: f64,
    /// In the others, and a group of 0 for the free end.
    pub rest: Vec<Lane>,
}

impl Forces {
    /// The forces at these gaps and rates; the gaps beyond the last bead are open.
    pub fn new<C: Chain>(chain: &mut C, (gap, gaps): (f64, &[Lane]), rates: &[f64]) -> Self {
        let pairs = gaps.iter().zip(grouped(rates, 0.0)).enumerate();
        Self {
            floor: chain.floor(gap, rates[0]).0,
            rest: pairs
                .map(|(k, (g, w))| chain.pairs(k, *g, w).0)
                .chain([Lane::ZERO])
                .collect(),
        }
    }

    /// The first of the forces above the floor's.
    #[inline]
    pub fn second(&self) -> f64 {
        self.rest[0].to_array()[0]
    }

    /// Accelerations of all gaps, the lowest also feeling `pull`.
    pub fn accelerations<C: Chain>(&self, chain: &C, pull: f64) -> (f64, Vec<Lane>) {
        let mut under = self.floor;
        let rest = self.rest.windows(2).enumerate().map(|(k, forces)| {
            let (below, above) = neighbours(under, forces[0], forces[1]);
            under = forces[0].to_array()[LANES - 1];
            chain.accelerations(k, below, forces[0], above)
        });
        let rest = rest.collect();
        (chain.first(self.floor, self.second()) + pull, rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::physics::contact_law::Counting;

    fn check(mut chain: impl Chain) {
        let mut looks = [0.0; 6];
        // Contacts by look, the floor's first.
        for closed in [0b11_1111, 0b10_1101, 0b11_1001, 0b00_0110, 0b11_1111] {
            let gap = |i: usize| if closed >> i & 1 == 1 { -1e-9 } else { 1e-9 };
            for (i, looks) in looks.iter_mut().enumerate() {
                *looks = if gap(i) <= 0.0 { *looks + 1.0 } else { 0.0 };
            }
            assert_eq!(chain.floor(gap(0), 0.0).0, looks[0]);
            for k in 0..2 {
                let (a, b) = (1 + LANES * k, 2 + LANES * k);
                let (force, _) = chain.pairs(k, Lane::new([gap(a), gap(b)]), Lane::ZERO);
                assert_eq!(force.to_array(), [looks[a], looks[b]]);
            }
        }
    }

    #[test]
    fn each_contact_remembers_for_itself_until_it_ends() {
        check(Equal::new(&[Counting; 5]));
        check(Unequal::new(&[Counting; 5], &[1.0, 0.5, 2.0, 1.0, 3.0]));
    }
}
