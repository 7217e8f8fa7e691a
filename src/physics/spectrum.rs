//! The spectrum of a linear column whose contacts are all closed, and the largest
//! step with which a fixed-step method stays stable on it.
//!
//! Closed, the column is M ẍ = −Aᵀ(K A x + C A ẋ) with gaps g = A x. Where c/K is the
//! same in all contacts the modes of the springs are those of the dashpots too, and
//! every mode is ẍ = −λ x − ν ẋ with ν = (c/K) λ, whose stiffest one decides. Equal
//! beads are such a column. Otherwise the stiffest spring mode and the most damped
//! dashpot mode are taken for one, which is on the safe side.

use super::column::{masses, springs};
use super::md::CORRECTOR;
use super::spring::Spring;
use crate::math;
use crate::scene::{Arrangement, Integrator, Scene};
use nalgebra::{DMatrix, Matrix3, Matrix6, RowVector3, RowVector6, Schur, Vector6};
use std::f64::consts::PI;

/// Growth in a step, beyond 1, that is not rounding: the two roots of a slow mode are
/// nearly one, and rounding moves such a pair by the root of its own size.
const ROUNDING: f64 = 1e-6;

/// Ratio of two steps between which no instability hides.
const STRIDE: f64 = 1.02;

/// Iterations after which an eigenvalue is given up.
const MOST_ITERATIONS: usize = 1000;

/// The stiffest mode of a closed column: ẍ = −λ x − ν ẋ.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Mode {
    /// λ, 1/s².
    pub stiffness: f64,
    /// ν, 1/s.
    pub damping: f64,
}

/// The stiffest mode of the scene's column when all contacts are closed; none for
/// hard spheres and for power laws, whose stiffness depends on the overlap.
pub fn stiffest_mode(scene: &Scene) -> Option<Mode> {
    if !scene.is_md() || scene.depends_on_speed() {
        return None;
    }
    let masses = masses(scene);
    let springs = springs(scene, &masses);
    if let Arrangement::Lattice { tangential, .. } = scene.arrangement {
        return Some(lattice_mode(&springs, tangential));
    }
    let uniform = scene.width == 0.0 && springs.iter().all(|s| s.stiffness == springs[0].stiffness);
    let stiffness = if uniform {
        // Modes of a chain of equal springs, held below and free above.
        let wave = math::cos(PI / (2 * scene.n + 1) as f64);
        4.0 * springs[0].stiffness * wave * wave
    } else {
        largest_eigenvalue(&masses, &springs, |spring| spring.stiffness)
    };
    let ratio = springs[0].dashpot / springs[0].stiffness;
    let proportional = |s: &Spring| (s.dashpot / s.stiffness - ratio).abs() <= 1e-12 * ratio;
    let damping = if springs.iter().all(proportional) {
        ratio * stiffness
    } else {
        largest_eigenvalue(&masses, &springs, |spring| spring.dashpot)
    };
    Some(Mode { stiffness, damping })
}

/// The stiffest mode of a triangular lattice of equal springs: λ = 6K, where rows move
/// against each other. Drag across contacts damps some modes by up to 6 D_t more; taken
/// together that is on the safe side.
fn lattice_mode(springs: &[Spring], tangential: f64) -> Mode {
    let (floor, pair) = (springs[0], springs[springs.len() - 1]);
    // The floor takes the place of two springs that together have 3/2 K upwards.
    let beyond = |floor: f64, pair: f64| (floor - 1.5 * pair).max(0.0);
    Mode {
        stiffness: 6.0 * pair.stiffness + beyond(floor.stiffness, pair.stiffness),
        damping: 6.0 * (pair.dashpot + tangential) + beyond(floor.dashpot, pair.dashpot),
    }
}

/// The largest time step, s, with which an integrator is stable on the scene's column
/// when all contacts are closed; none where there is no [`stiffest_mode`].
pub fn largest_stable_step(scene: &Scene, integrator: Integrator) -> Option<f64> {
    let mode = stiffest_mode(scene)?;
    let stable = |h: f64| growth(mode, h, integrator) <= 1.0 + ROUNDING;
    // Where nothing happens in a step any method is stable.
    let mut below = 0.01 / mode.stiffness.sqrt().max(mode.damping);
    let mut above = below * STRIDE;
    while stable(above) {
        (below, above) = (above, above * STRIDE);
    }
    while above / below > 1.0 + 1e-9 {
        let middle = (below * above).sqrt();
        if stable(middle) {
            below = middle;
        } else {
            above = middle;
        }
    }
    Some(below)
}

/// The least steps in a contact time with which the scene's own grid would be stable,
/// if the scene is on a grid that is coarser than that.
pub fn too_few_steps(scene: &Scene) -> Option<f64> {
    let grid = scene.grid()?;
    let least = scene.contact_time()? / largest_stable_step(scene, grid.integrator)?;
    (grid.steps_per_contact < least).then_some(least)
}

/// Largest eigenvalue of M^(−½) Aᵀ diag(constants) A M^(−½), a tridiagonal matrix, by
/// bisection on Sturm's count.
fn largest_eigenvalue(
    masses: &[f64],
    springs: &[Spring],
    constant: impl Fn(&Spring) -> f64,
) -> f64 {
    let n = masses.len();
    let at = |i: usize| springs.get(i).map_or(0.0, &constant);
    let diagonal: Vec<f64> = (0..n).map(|i| (at(i) + at(i + 1)) / masses[i]).collect();
    // Square of the element between beads i − 1 and i.
    let beside = |i: usize| at(i) * at(i) / (masses[i - 1] * masses[i]);
    let all_below = |x: f64| {
        let mut pivot = diagonal[0] - x;
        for i in 1..n {
            if pivot >= 0.0 {
                return false;
            }
            pivot = diagonal[i] - x - beside(i) / pivot;
        }
        pivot < 0.0
    };
    // Gershgorin, twice over: the matrix is positive definite.
    let mut high = 4.0 * diagonal.iter().fold(0.0, |a, &b| f64::max(a, b));
    let mut low = 0.0;
    while high - low > 1e-14 * high {
        let middle = 0.5 * (low + high);
        if middle <= low || middle >= high {
            break;
        }
        if all_below(middle) {
            high = middle;
        } else {
            low = middle;
        }
    }
    high
}

/// The largest factor by which a step of `h` multiplies a part of the mode.
pub fn growth(mode: Mode, h: f64, integrator: Integrator) -> f64 {
    let (stiffness, damping) = (mode.stiffness * h * h, mode.damping * h);
    match integrator {
        Integrator::Verlet => radius(DMatrix::from_column_slice(
            3,
            3,
            verlet(stiffness, damping).as_slice(),
        )),
        Integrator::Gear => radius(DMatrix::from_column_slice(
            6,
            6,
            gear(stiffness, damping).as_slice(),
        )),
    }
}

/// The largest modulus of an eigenvalue; infinite where it cannot be found.
fn radius(matrix: DMatrix<f64>) -> f64 {
    let Some(schur) = Schur::try_new(matrix, f64::EPSILON, MOST_ITERATIONS) else {
        return f64::INFINITY;
    };
    let moduli = schur.complex_eigenvalues();
    moduli
        .iter()
        .fold(0.0, |most, z| math::polar(*z).0.max(most))
}

/// A step of Verlet for (x, h ẋ, h² ẍ); the dashpot sees the velocity that the old
/// acceleration predicts, so the acceleration is a variable of its own.
fn verlet(stiffness: f64, damping: f64) -> Matrix3<f64> {
    let position = RowVector3::new(1.0, 1.0, 0.5);
    let predicted = RowVector3::new(0.0, 1.0, 1.0);
    let acceleration = -stiffness * position - damping * predicted;
    let velocity = RowVector3::new(0.0, 1.0, 0.5) + 0.5 * acceleration;
    Matrix3::from_rows(&[position, velocity, acceleration])
}

/// A step of Gear's method for the scaled derivatives r₀..r₅: Pascal's triangle
/// predicts, Δ = ½h² ẍ − r₂ corrects.
fn gear(stiffness: f64, damping: f64) -> Matrix6<f64> {
    let pascal = Matrix6::new(
        1.0, 1.0, 1.0, 1.0, 1.0, 1.0, //
        0.0, 1.0, 2.0, 3.0, 4.0, 5.0, //
        0.0, 0.0, 1.0, 3.0, 6.0, 10.0, //
        0.0, 0.0, 0.0, 1.0, 4.0, 10.0, //
        0.0, 0.0, 0.0, 0.0, 1.0, 5.0, //
        0.0, 0.0, 0.0, 0.0, 0.0, 1.0,
    );
    let delta = RowVector6::new(-0.5 * stiffness, -0.5 * damping, -1.0, 0.0, 0.0, 0.0);
    (Matrix6::identity() + Vector6::from(CORRECTOR) * delta) * pascal
}

#[cfg(test)]
mod tests;
