//! What does not change while a column moves.

use super::oscillator::Oscillator;
use super::taylor::PHASE;
use crate::math;
use crate::physics::column::reduced_mass;
use crate::physics::matter::BeadColumn;
use crate::physics::state::State;
use crate::scene::Scene;

/// The constants of a soft column.
#[derive(Clone, Debug)]
pub(super) struct Constants {
    pub column: BeadColumn,
    /// 1/m of each bead.
    inverse_masses: Vec<f64>,
    /// Each contact as an oscillator; None where it is overdamped.
    pub oscillators: Vec<Option<Oscillator>>,
    /// Whether a contact may pull its beads together at its end, as the linear law says.
    pub attraction: bool,
    /// g + Aω², m/s²: the most that gravity and plate accelerate the lowest gap downwards.
    pub pull: f64,
    /// The least rate, 1/s, for which a series is made. A cluster in which no force acts
    /// has no rate of its own; this one lets it go on for a tick.
    pub slowest: f64,
}

impl Constants {
    /// The constants of a scene from a state on, for a clock with this tick, s.
    pub fn new(scene: &Scene, state: &State, attraction: bool, tick: f64) -> Self {
        let column = BeadColumn::of(scene);
        let masses = &column.masses;
        let shake = state.plate.amplitude * math::powi(state.plate.omega, 2);
        let contacts = column.springs.iter().enumerate();
        Self {
            oscillators: contacts
                .map(|(i, spring)| Oscillator::new(*spring, reduced_mass(masses, i)))
                .collect(),
            inverse_masses: masses.iter().map(|m| 1.0 / m).collect(),
            attraction,
            pull: column.gravity + shake,
            slowest: PHASE / tick,
            column,
        }
    }

    /// 1/m of the bead below gap `i`, which is 0 for the floor, and of the bead above it.
    pub fn inverse_masses(&self, i: usize) -> (f64, f64) {
        let below = if i == 0 {
            0.0
        } else {
            self.inverse_masses[i - 1]
        };
        (below, self.inverse_masses[i])
    }

    /// 1/m of the bead that gaps `i` and `j`, neighbours, have between them.
    pub fn inverse_mass_between(&self, i: usize, j: usize) -> f64 {
        self.inverse_masses[i.min(j)]
    }
}
