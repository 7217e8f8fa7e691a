//! A floor collision as it is compared: its numbers and its path, and their distance from the
//! reference's.

use crate::physics::Observation;
use crate::scene::Scene;
use crate::study::{Drive, RunError};

/// A collision, and where the beads were at the sample times.
pub(super) struct CollisionTrace {
    pub eps_eff: f64,
    pub er_over_ef: Option<f64>,
    pub path: Vec<f64>,
    pub steps: u64,
    pub events: u64,
    /// When it was over, s.
    pub end: f64,
    /// When bead 1 last left the floor, s.
    pub left: Option<f64>,
}

/// Distance of a run from the reference; relative, the trajectory's over |v₀| t_c.
#[derive(Debug, Clone, Copy, PartialEq, Default)]
pub(super) struct Errors {
    pub eps_eff: f64,
    pub er_over_ef: Option<f64>,
    pub trajectory: f64,
}

impl Errors {
    /// Each of them changed.
    pub fn map(self, change: impl Fn(f64) -> f64) -> Self {
        Self {
            eps_eff: change(self.eps_eff),
            er_over_ef: self.er_over_ef.map(&change),
            trajectory: change(self.trajectory),
        }
    }

    /// Each of them together with the same one of another run.
    pub fn with(self, other: Self, both: impl Fn(f64, f64) -> f64) -> Self {
        let shares = self.er_over_ef.zip(other.er_over_ef);
        Self {
            eps_eff: both(self.eps_eff, other.eps_eff),
            er_over_ef: shares.map(|(a, b)| both(a, b)),
            trajectory: both(self.trajectory, other.trajectory),
        }
    }
}

/// A collision that began so much `early`, s, and where the beads were at times of the one
/// that did not.
pub(super) fn run(
    mut drive: Drive,
    scene: &Scene,
    times: &[f64],
    early: f64,
) -> Result<CollisionTrace, RunError> {
    let mut seen = Observation::default();
    drive.observe(&mut seen);
    let before = seen.energy.kinetic;
    let mut path = Vec::with_capacity(times.len() * scene.n);
    for time in times.iter().map(|time| time + early) {
        // A grid point that rounding put behind the time is meant all the same.
        drive.advance(time * (1.0 + 4.0 * f64::EPSILON))?;
        drive.observe(&mut seen);
        let late = time - seen.time;
        let place = |(z, v): (&f64, &f64)| z + late * v;
        path.extend(seen.reduced.iter().zip(&seen.velocities).map(place));
    }
    drive.collide(scene)?;
    drive.observe(&mut seen);
    let after = seen.energy.kinetic;
    Ok(CollisionTrace {
        eps_eff: (after / before).sqrt(),
        er_over_ef: (after > 0.0).then(|| seen.energy.relative / after),
        path,
        steps: seen.steps,
        events: seen.events,
        end: drive.time(),
        left: seen.floor_left,
    })
}

/// How far a run is from the reference; lengths over the unit, m.
pub(super) fn errors(run: &CollisionTrace, truth: &CollisionTrace, unit_of_length: f64) -> Errors {
    let relative = |x: f64, y: f64| if x == y { 0.0 } else { (x / y - 1.0).abs() };
    let apart = run.path.iter().zip(&truth.path).map(|(a, b)| (a - b).abs());
    Errors {
        eps_eff: relative(run.eps_eff, truth.eps_eff),
        er_over_ef: run
            .er_over_ef
            .zip(truth.er_over_ef)
            .map(|(a, b)| relative(a, b)),
        trajectory: apart.fold(0.0, f64::max) / unit_of_length,
    }
}
