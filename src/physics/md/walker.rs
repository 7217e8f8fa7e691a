//! What takes the steps of a soft column on a grid: integrator, ground and chain together.

use dyn_clone::DynClone;

use super::chain::Chain;
use super::pace::Pace;
use super::stepper::{Power, Stepper};
use crate::physics::ground::Ground;
use crate::physics::plate::Plate;

/// What takes the steps, behind one call for many of them.
pub(super) trait Walker: DynClone + Send {
    /// Up to `steps` steps, to where contacts change: how many it did, and whether any
    /// contact may have changed in the last.
    fn run(&mut self, steps: u64) -> (u64, bool);
    /// Flies on for `steps` steps at constant rates.
    fn coast(&mut self, steps: u64);
    /// Writes the gaps, m.
    fn gaps(&self, into: &mut Vec<f64>);
    /// The rates, m/s.
    fn rates(&self) -> Vec<f64>;
    /// Clears numbers too small to matter.
    fn clear(&mut self);
    /// Powers of the steps since they were last taken.
    fn power(&self) -> Power;
    /// Takes them.
    fn take_power(&mut self) -> Power;
    /// The floor now.
    fn plate(&self) -> Plate;
    /// Whether there is gravity.
    fn pulls(&self) -> bool;
}

dyn_clone::clone_trait_object!(Walker);

/// The steps of an integrator over a ground.
#[derive(Clone)]
pub(super) struct Walking<S, G, C> {
    stepper: S,
    ground: Pace<G>,
    chain: C,
    power: Power,
}

impl<S, G, C> Walking<S, G, C> {
    pub fn new(stepper: S, ground: Pace<G>, chain: C) -> Self {
        Self {
            stepper,
            ground,
            chain,
            power: Power::default(),
        }
    }
}

impl<S: Stepper, G: Ground, C: Chain> Walker for Walking<S, G, C> {
    fn run(&mut self, steps: u64) -> (u64, bool) {
        let Self {
            stepper,
            ground,
            chain,
            power,
        } = self;
        let (mut done, mut changed) = (0, false);
        while done < steps && !changed {
            changed = stepper.step(chain, ground, power);
            done += 1;
        }
        (done, changed)
    }

    fn coast(&mut self, steps: u64) {
        self.stepper.coast(steps);
    }

    fn gaps(&self, into: &mut Vec<f64>) {
        into.clear();
        into.extend(self.stepper.gaps());
    }

    fn rates(&self) -> Vec<f64> {
        self.stepper.rates(&self.chain, &self.ground)
    }

    fn clear(&mut self) {
        self.stepper.clear();
    }

    fn power(&self) -> Power {
        self.power
    }

    fn take_power(&mut self) -> Power {
        std::mem::take(&mut self.power)
    }

    fn plate(&self) -> Plate {
        self.ground.plate()
    }

    fn pulls(&self) -> bool {
        G::PULLS
    }
}
