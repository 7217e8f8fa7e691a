//! Soft contacts on a fixed grid of time steps (molecular dynamics).
//!
//! One engine is specialised at compile time by integrator, ground, kind of chain and contact
//! law, so that a scene pays only for what it has. Contact changes fall between steps. Every
//! fixed-step method is therefore of first order here, whatever its name.

mod between_steps;
mod chain;
mod engine;
mod gear;
mod pace;
mod stepper;
mod verlet;
mod walker;

use std::marker::PhantomData;

use super::Engine;
use super::contact_law::{self, ContactLaw, UnderLaw};
use super::grid::Settings;
use super::ground::{Ground, OverGround};
use super::matter::BeadColumn;
use super::spring::Spring;
use super::state::State;
use crate::scene::{Integrator, Scene};
use chain::{Equal, Unequal};
use engine::Md;
use gear::Gear;
pub(super) use gear::{CORRECTOR, corrected, predicted};
use stepper::Stepper;
use verlet::Verlet;

/// Steps on a grid, for scenes that have one.
pub(super) struct GridSteps;

impl OverGround for GridSteps {
    fn over<G: Ground>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine> {
        let settings = Settings::of(scene);
        match settings.integrator {
            Integrator::Gear => with_chain::<Gear, G>(scene, settings, state, ground),
            Integrator::Verlet => with_chain::<Verlet, G>(scene, settings, state, ground),
        }
    }
}

fn with_chain<S: Stepper + 'static, G: Ground>(
    scene: &Scene,
    settings: Settings,
    state: State,
    ground: G,
) -> Box<dyn Engine> {
    contact_law::build(
        scene,
        ChainParts {
            scene,
            settings,
            state,
            ground,
            column: BeadColumn::of(scene),
            stepper: PhantomData::<S>,
        },
    )
}

/// All that an engine is built of but the contact law.
struct ChainParts<'a, S, G> {
    scene: &'a Scene,
    settings: Settings,
    state: State,
    ground: G,
    column: BeadColumn,
    stepper: PhantomData<S>,
}

impl<S: Stepper + 'static, G: Ground> UnderLaw for ChainParts<'_, S, G> {
    fn under<L: ContactLaw + 'static>(self, law: impl Fn(Spring) -> L) -> Box<dyn Engine> {
        let Self {
            scene,
            settings,
            state,
            ground,
            column,
            ..
        } = self;
        let laws: Vec<L> = column.springs.iter().map(|&spring| law(spring)).collect();
        if scene.width == 0.0 {
            let chain = Equal::new(&laws);
            Md::boxed::<S, G, _>(scene, settings, state, ground, column, chain)
        } else {
            let chain = Unequal::new(&laws, &column.masses);
            Md::boxed::<S, G, _>(scene, settings, state, ground, column, chain)
        }
    }
}
