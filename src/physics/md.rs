//! Soft contacts on a fixed grid of time steps (molecular dynamics).
//!
//! One engine is specialised at compile time by integrator, ground, kind of chain and contact
//! law, so that a scene pays only for what it has. Contact changes fall between steps. Every
//! fixed-step method is therefore of first order here, whatever its name.

mod between_steps;
mod chain;
mod engine;
mod gear;
mod ground;
mod mover;
mod stepper;
mod verlet;

use std::marker::PhantomData;

use super::Engine;
use super::column::{masses, springs};
use super::contact_law::{self, ContactLaw, UnderLaw};
use super::grid::Settings;
use super::spring::Spring;
use super::state::State;
use crate::scene::{Floor, Integrator, Scene};
use chain::{Equal, Unequal};
use engine::Md;
use gear::Gear;
pub(super) use gear::{CORRECTOR, corrected, predicted};
use ground::{Free, Ground, Shaken, Weight};
use stepper::Stepper;
use verlet::Verlet;

/// Builds the engine of an MD scene on a grid of time steps.
pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let settings = Settings::of(scene);
    match settings.integrator {
        Integrator::Gear => with_ground::<Gear>(scene, settings, state),
        Integrator::Verlet => with_ground::<Verlet>(scene, settings, state),
    }
}

fn with_ground<S: Stepper + 'static>(
    scene: &Scene,
    settings: Settings,
    state: State,
) -> Box<dyn Engine> {
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), state.plate);
            with_chain::<S, _>(scene, settings, state, ground)
        }
        (Floor::Fixed, Some(gravity)) => {
            let ground = Weight::new(gravity, state.plate);
            with_chain::<S, _>(scene, settings, state, ground)
        }
        (Floor::Fixed, None) => {
            let ground = Free::new(state.plate);
            with_chain::<S, _>(scene, settings, state, ground)
        }
    }
}

fn with_chain<S: Stepper + 'static, G: Ground + 'static>(
    scene: &Scene,
    settings: Settings,
    state: State,
    ground: G,
) -> Box<dyn Engine> {
    let masses = masses(scene);
    let springs = springs(scene, &masses);
    let column = SoftColumn {
        ground,
        masses,
        springs,
    };
    contact_law::build(
        scene,
        ChainParts {
            scene,
            settings,
            state,
            column,
            stepper: PhantomData::<S>,
        },
    )
}

/// All that an engine is built of but the contact law.
struct ChainParts<'a, S, G> {
    scene: &'a Scene,
    settings: Settings,
    state: State,
    column: SoftColumn<G>,
    stepper: PhantomData<S>,
}

impl<S: Stepper + 'static, G: Ground + 'static> UnderLaw for ChainParts<'_, S, G> {
    fn under<L: ContactLaw + 'static>(self, law: impl Fn(Spring) -> L) -> Box<dyn Engine> {
        let Self {
            scene,
            settings,
            state,
            column,
            ..
        } = self;
        let laws: Vec<L> = column.springs.iter().map(|&spring| law(spring)).collect();
        if scene.width == 0.0 {
            Md::boxed::<S, G, _>(scene, settings, state, column, Equal::new(&laws))
        } else {
            let chain = Unequal::new(&laws, &column.masses);
            Md::boxed::<S, G, _>(scene, settings, state, column, chain)
        }
    }
}

/// What a column is, whatever moves it.
struct SoftColumn<G> {
    ground: G,
    masses: Vec<f64>,
    springs: Vec<Spring>,
}
