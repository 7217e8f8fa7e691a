//! The beads: masses, and the constants of their contacts.

use super::linear_law::{pair_restitution, same_spring_floor};
use super::spring::Spring;
use crate::math;
use crate::scene::{FloorContact, Law, Scene, diameters};

/// Masses of the beads of a scene, in mean bead masses (m ∝ d³).
pub(crate) fn masses(scene: &Scene) -> Vec<f64> {
    diameters(scene)
        .iter()
        .map(|d| math::powi(d / scene.diameter, 3))
        .collect()
}

/// Reduced mass of the contact at gap `i`: that of bead 1 on the floor for gap 0.
pub(crate) fn reduced_mass(masses: &[f64], i: usize) -> f64 {
    if i == 0 {
        masses[0]
    } else {
        masses[i] * masses[i - 1] / (masses[i] + masses[i - 1])
    }
}

/// Restitution of every contact of a column of hard beads, as its soft twin has it:
/// all contacts share K and D_n, so unequal pairs rebound unequally.
pub(crate) fn restitutions(scene: &Scene, masses: &[f64]) -> Vec<f64> {
    let floor = match scene.floor_contact {
        FloorContact::SameSpring => same_spring_floor(scene.restitution, masses[0]),
        FloorContact::SameRestitution => scene.restitution,
    };
    let pair = |i| {
        let reduced = reduced_mass(masses, i);
        // An equal pair has exactly ε; the formula would round it.
        if reduced == 0.5 {
            scene.restitution
        } else {
            pair_restitution(scene.restitution, reduced)
        }
    };
    std::iter::once(floor)
        .chain((1..masses.len()).map(pair))
        .collect()
}

/// The least and the largest restitution of two neighbours in a column of unequal beads
/// with linear contacts, which share K and D_n; none where all have the scene's own.
pub fn restitution_range(scene: &Scene) -> Option<(f64, f64)> {
    if scene.width == 0.0 || scene.n < 2 || scene.depends_on_speed() {
        return None;
    }
    let pairs = restitutions(scene, &masses(scene));
    let (least, most) = (f64::INFINITY, 0.0_f64);
    let range = |(least, most): (f64, f64), &x: &f64| (least.min(x), most.max(x));
    Some(pairs[1..].iter().fold((least, most), range))
}

/// Restitution of the floor contact in force in a scene; under a power law that of a
/// bead that arrives at the scene's own speed.
pub fn floor_restitution(scene: &Scene) -> f64 {
    if let Some(soft) = scene.soft() {
        let masses = masses(scene);
        let floor = springs(scene, &masses)[0];
        let law = alone(soft.law, &floor, masses[0]);
        if let Some(restitution) = law.rebound(soft.attraction, scene.own_speed()) {
            return restitution;
        }
    }
    match scene.floor_contact {
        FloorContact::SameRestitution => scene.restitution,
        FloorContact::SameSpring => {
            let first = diameters(scene)[0] / scene.diameter;
            same_spring_floor(scene.restitution, math::powi(first, 3))
        }
    }
}

/// Spring and dashpot of every contact of a soft column; index 0 is the floor's. Hard
/// beads have none.
pub(crate) fn springs(scene: &Scene, masses: &[f64]) -> Vec<Spring> {
    let Some(law) = scene.law() else {
        return Vec::new();
    };
    let law = law.in_powers(scene.restitution);
    let pair_stiffness = 0.5 * law.stiffness;
    // Of a contact between masses of which `twice` the reduced one is given, Eqs. (3), (8).
    let spring = |stiffness, twice| Spring {
        stiffness,
        dashpot: law.damping * twice,
        beta: law.exponents.beta(),
        gamma: law.exponents.gamma(),
    };
    let floor = match scene.floor_contact {
        FloorContact::SameSpring => spring(pair_stiffness, masses[0]),
        FloorContact::SameRestitution => spring(2.0 * pair_stiffness * masses[0], 2.0 * masses[0]),
    };
    let pair = |i| spring(pair_stiffness, 2.0 * reduced_mass(masses, i));
    std::iter::once(floor)
        .chain((1..masses.len()).map(pair))
        .collect()
}

/// The law of a contact by itself, in the terms of a pair of mean beads, where it is given
/// in powers of the overlap.
pub(crate) fn alone(mut law: Law, spring: &Spring, reduced: f64) -> Law {
    if let Some(power) = law.power_mut() {
        power.stiffness = spring.stiffness / reduced;
        power.damping = 0.5 * spring.dashpot / reduced;
    }
    law
}

/// A floor collision is over when what is to come cannot change E by this part of it.
pub(crate) const OVER: f64 = 1e-12;

/// Velocities of beads from the rates of the gaps below them, relative to what the
/// lowest gap stands on.
pub(crate) fn velocities(rates: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut v = 0.0;
    let add = |w| {
        v += w;
        v
    };
    rates.map(add).collect()
}

/// Whether gap `i`, which closes at rate `w`, can lose more than `energy` by itself. Then a
/// floor collision is not over, and [`most_to_lose`] need not be computed.
///
/// The least loss that brings gap `i` to rest is ½m*w², and bringing all gaps to rest loses
/// no less. The factor of two is for the rounding of [`most_to_lose`].
pub(crate) fn much_to_come(masses: &[f64], i: usize, w: f64, energy: f64) -> bool {
    w < 0.0 && 0.5 * reduced_mass(masses, i) * w * w > 2.0 * energy
}

/// Whether no collision still to come can change the kinetic energy of free beads above
/// a fixed floor by this part of itself.
pub(crate) fn nothing_to_come(rates: impl Iterator<Item = f64>, masses: &[f64], part: f64) -> bool {
    let now = velocities(rates);
    let energy: f64 = now.iter().zip(masses).map(|(v, m)| 0.5 * m * v * v).sum();
    most_to_lose(now, masses) <= part * energy
}

/// The most energy, m²/s², that collisions still to come can take from free beads with these
/// velocities above a fixed floor.
pub(crate) fn most_to_lose(now: Vec<f64>, masses: &[f64]) -> f64 {
    let mut last = now.clone();
    totally_inelastic(&mut last, masses, true);
    // Bead by bead: a difference of energies would hide losses below 10⁻¹⁶ of them.
    let lost = now.into_iter().zip(last).zip(masses);
    lost.map(|((v, u), m)| 0.5 * m * (v - u) * (v + u)).sum()
}

/// Replaces velocities by those that the beads would have if every collision still to come
/// were totally inelastic, above a floor of velocity 0 where `on_floor`.
///
/// They are the nearest velocities, in the norm of the kinetic energy, at which no two
/// neighbours approach. The pool-adjacent-violators algorithm finds them.
///
/// No sequence of contacts can end with less kinetic energy. Contact impulses push apart, so
/// from v to the end u they obey ⟨u − v, k⟩ ≥ 0 for every k at which nothing approaches. The
/// projection v̂ is such a k, hence ⟨u, v̂⟩ ≥ ⟨v, v̂⟩ = |v̂|², and |u| ≥ |v̂|.
pub(crate) fn totally_inelastic(velocities: &mut [f64], masses: &[f64], on_floor: bool) {
    let mut pools: Vec<(f64, f64, usize)> = Vec::with_capacity(velocities.len());
    for (&v, &m) in velocities.iter().zip(masses) {
        let mut pool = (v, m, 1);
        while let Some(&(below, mass, count)) = pools.last() {
            if below <= pool.0 {
                break;
            }
            pools.pop();
            let total = mass + pool.1;
            pool = (
                (below * mass + pool.0 * pool.1) / total,
                total,
                count + pool.2,
            );
        }
        pools.push(pool);
    }
    let mut i = 0;
    for (v, _, count) in pools {
        let v = if on_floor { v.max(0.0) } else { v };
        velocities[i..i + count].fill(v);
        i += count;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn pooling_conserves_momentum_and_orders() {
        let masses = [1.0, 2.0, 0.5, 1.0, 3.0];
        let before = [0.3, -1.0, 0.7, 0.6, 0.65];
        let mut after = before;
        totally_inelastic(&mut after, &masses, false);
        let momentum = |v: &[f64]| v.iter().zip(&masses).map(|(v, m)| v * m).sum::<f64>();
        assert!((momentum(&before) - momentum(&after)).abs() < 1e-15);
        assert!(after.windows(2).all(|w| w[0] <= w[1]));
        let energy = |v: &[f64]| v.iter().zip(&masses).map(|(v, m)| m * v * v).sum::<f64>();
        assert!(energy(&after) < energy(&before));
    }

    #[test]
    fn a_column_sticks_to_the_floor() {
        let mut v = [-0.2; 10];
        totally_inelastic(&mut v, &[1.0; 10], true);
        assert!(v.iter().all(|&v| v == 0.0));
    }
}
