//! STAND-IN until the exact engine lands: Verlet on a fine grid.
use super::state::State;
use super::{Engine, md};
use crate::scene::{Facts, Integrator, Method, Scene, Solver};

pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let Method::Md {
        law, attraction,
        ..
    } = scene.method
    else {
        unreachable!()
    };
    let solver = Solver::Grid {
        integrator: Integrator::Verlet,
        steps_per_contact: 2000.0,
    };
    let method = Method::Md {
        law,
        solver,
        attraction,
    };
    let facts = Facts {
        method,
        ..scene.facts().clone()
    };
    md::build(&Scene::new(facts).expect("as before"), state)
}
