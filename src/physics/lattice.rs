//! Beads in a plane (Sec. IV C): a triangular lattice that is periodic across is thrown
//! at a floor. Soft contacts on a grid of time steps.
//!
//! The state is the displacement of every bead from its site, and two beads' gap is
//! (r² − d²)/(r + d) with r² − d² = (R² − d²) + 2R·δ + δ², R being the vector between
//! their sites and δ the difference of their displacements. R² − d² comes from whole
//! numbers and s₀, so an overlap keeps all digits that the displacements have; a lattice
//! that just touches does so exactly.

mod between_steps;
mod engine;
mod forces;
mod gear;
mod list;
mod stepper;
mod verlet;
mod view;
mod walker;

use super::Engine;
use super::column::{masses, springs};
use super::contact_law::{self, ContactLaw, UnderLaw};
use super::grid::Settings;
use super::spring::Spring;
use super::state::State;
use crate::scene::lattice::Sites;
use crate::scene::{Arrangement, Integrator, Scene};
use engine::Lattice;
use forces::{LatticeForces, Laws, Rubbing, Smooth, Surface};
use gear::LatticeGear;
use stepper::PlaneStepper;
use verlet::LatticeVerlet;
use walker::PlaneWalking;

/// What a lattice is, whatever moves it.
#[derive(Clone)]
struct Plane {
    sites: Sites,
    floor: Spring,
    pair: Spring,
    tangential: f64,
    settings: Settings,
    /// The collision is over when nothing has touched for so long, s.
    wait: f64,
}

/// Builds the engine of a lattice.
pub(super) fn build(scene: &Scene, sites: Sites, state: State) -> Box<dyn Engine> {
    let Arrangement::Lattice { tangential, .. } = scene.arrangement else {
        unreachable!("a lattice has sites");
    };
    let settings = Settings::of(scene);
    let springs = springs(scene, &masses(scene));
    // The paper's 2N s₀/|v₀| is no time at all without separation. Contacts that touch part
    // within some t_c, which is the least time for a crossing.
    let crossing = sites.separation / scene.own_speed();
    let plane = Plane {
        sites,
        floor: springs[0],
        pair: springs[springs.len() - 1],
        tangential,
        settings,
        wait: 2.0 * scene.n as f64 * crossing.max(settings.contact_time),
    };
    contact_law::build(scene, LatticeParts { plane, state })
}

/// All that an engine is built of but the contact law.
struct LatticeParts {
    plane: Plane,
    state: State,
}

impl UnderLaw for LatticeParts {
    fn under<L: ContactLaw + 'static>(self, law: impl Fn(Spring) -> L) -> Box<dyn Engine> {
        let Self { plane, state } = self;
        let laws = Laws {
            floor: law(plane.floor),
            pair: law(plane.pair),
        };
        if plane.tangential == 0.0 {
            with_surface(plane, state, laws, Smooth)
        } else {
            let rubbing = Rubbing(plane.tangential);
            with_surface(plane, state, laws, rubbing)
        }
    }
}

fn with_surface<L: ContactLaw + 'static, S: Surface + 'static>(
    plane: Plane,
    state: State,
    laws: Laws<L>,
    surface: S,
) -> Box<dyn Engine> {
    match plane.settings.integrator {
        Integrator::Gear => moved_by::<LatticeGear, L, S>(plane, state, laws, surface),
        Integrator::Verlet => moved_by::<LatticeVerlet, L, S>(plane, state, laws, surface),
    }
}

fn moved_by<M: PlaneStepper + 'static, L: ContactLaw + 'static, S: Surface + 'static>(
    plane: Plane,
    mut state: State,
    laws: Laws<L>,
    surface: S,
) -> Box<dyn Engine> {
    let places = std::mem::take(&mut state.gaps);
    let rates = std::mem::take(&mut state.rates);
    let forces = LatticeForces::new(plane.sites, laws, surface, &places);
    let h = plane.settings.step();
    let walker = PlaneWalking::<M, L, S>::new(places, &rates, h, forces);
    Lattice::boxed(plane, state, Box::new(walker), rates)
}
