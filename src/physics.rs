//! How a column moves. Pure: no I/O, no thread, no clock, no terminal.
//!
//! The state is kept in gaps (g₁ between floor and bead 1, gᵢ between beads i−1
//! and i; overlap is −g): differences of heights lose every digit that a small
//! overlap has. In code gap and bead indices count from 0. Masses are in units of
//! the mean bead's mass, so energies are per mean bead mass, m²/s².

mod adaptive;
mod bounce;
mod column;
mod contact_law;
mod contacts;
mod course;
mod ed;
mod epoch;
mod exact;
mod flight;
mod grid;
mod ground;
mod lanes;
mod lattice;
mod ledger;
mod linear_law;
mod matter;
mod md;
mod observation;
mod plate;
mod shell;
pub mod spectrum;
mod spring;
mod state;
mod steered;
mod tournament;

pub(crate) use column::masses;
pub use column::{floor_restitution, restitution_range};
pub use linear_law::LinearLaw;
pub use observation::{Discs, Energies, Energy, Integrals, Observation};
pub use state::{Handover, State};

use dyn_clone::DynClone;

use crate::scene::{Method, Scene, Solver};

/// Why an engine cannot go on.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum EngineError {
    /// The integration blew up.
    #[error(
        "the integration became unstable at t = {time:.6e} s: \
         {steps_per_contact} steps in a contact time are too few for this column"
    )]
    Unstable {
        /// When it was noticed, s.
        time: f64,
        /// The step in force.
        steps_per_contact: f64,
    },
    /// So many steps lie ahead that the time after one is the time before it.
    #[error(
        "the next contact lies {steps:.1e} steps ahead of t = {time:.6e} s, \
         more than a time can count (2^53)"
    )]
    BeyondTime {
        /// When it was noticed, s.
        time: f64,
        /// Steps to the next contact.
        steps: f64,
    },
    /// The adaptive method would need steps too short to get anywhere.
    #[error(
        "the adaptive method is stuck at t = {time:.6e} s: its steps of {step:.1e} s do not \
         add up to a contact time"
    )]
    Stuck {
        /// When, s.
        time: f64,
        /// The last step, s.
        step: f64,
    },
    /// Strongly damped contacts that let go ever more slowly, and never to an end.
    #[error(
        "the contacts only creep from t = {time:.6e} s on: with so much damping they never \
         let go, and the collision never ends"
    )]
    Creeping {
        /// When it was noticed, s.
        time: f64,
    },
    /// Hard spheres produced a state that cannot be.
    #[error("the event engine lost the column at t = {time:.6e} s, bead {bead}: {what}")]
    Lost {
        /// When, s.
        time: f64,
        /// Which bead, counted from 1 at the floor.
        bead: usize,
        /// What was found.
        what: &'static str,
    },
}

impl EngineError {
    /// When the engine could not go on, s.
    pub fn time(&self) -> f64 {
        match self {
            Self::Unstable { time, .. }
            | Self::BeyondTime { time, .. }
            | Self::Stuck { time, .. }
            | Self::Creeping { time, .. }
            | Self::Lost { time, .. } => *time,
        }
    }
}

/// How an [`Engine::advance`] ended.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Outcome {
    /// The time asked for was reached.
    Reached,
    /// The budget of steps or events was spent first.
    OutOfBudget,
    /// The time was reached, and the floor collision is over: no contact and no
    /// collision to come that could change the kinetic energy by 10⁻¹² of itself.
    Over,
}

/// A column in motion.
///
/// The same scene, seed and edits give the same bits. Splitting an advance in two
/// gives the same bits too, and a clone goes on with the same bits.
pub trait Engine: DynClone + Send {
    /// Simulated time, s. A fixed-step engine stops at its last grid point.
    fn time(&self) -> f64;

    /// Moves on to `until`, s, in at most `budget` steps or events.
    ///
    /// # Errors
    /// [`EngineError`] when the engine cannot go on; its state stays as it was then.
    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError>;

    /// Whether the floor collision is over, as in [`Outcome::Over`].
    fn is_over(&self) -> bool;

    /// The time of the next event, s, for engines that know it.
    fn next_event(&self) -> Option<f64>;

    /// Fills in what can be seen now, reusing the buffers of `into`.
    fn observe(&self, into: &mut Observation);

    /// The whole state, to go on with in another engine or after an edit.
    fn state(&self) -> State;
}

dyn_clone::clone_trait_object!(Engine);

/// Builds the engine of a scene, at its start or from the state of another engine
/// of the same column (an edit, or a change of method).
///
/// The [`Handover`] says what had to be resolved to go on from that state.
///
/// # Panics
/// If the state has another number of beads than the scene, or another kind of floor.
pub fn build(scene: &Scene, from: Option<&State>) -> (Box<dyn Engine>, Handover) {
    let (state, handover) = match from {
        None => (State::initial(scene), Handover::default()),
        Some(state) => state.adopt(scene),
    };
    (engine(scene, state), handover)
}

/// Builds the engine of a scene that follows collapses of hard beads half as far as
/// [`build`]'s before it closes them: what this changes of the results is not known.
pub fn build_half_as_deep(scene: &Scene) -> Box<dyn Engine> {
    let state = State {
        closing: state::Depth::Half,
        ..State::initial(scene)
    };
    engine(scene, state)
}

fn engine(scene: &Scene, state: State) -> Box<dyn Engine> {
    if state.course.is_untouched() {
        unsteered(scene, state)
    } else {
        steered::build(scene, state)
    }
}

/// The engine of a scene whose plate goes on as it moves in that state.
fn unsteered(scene: &Scene, state: State) -> Box<dyn Engine> {
    if let Some(sites) = scene.sites() {
        return lattice::build(scene, sites, state);
    }
    match scene.method {
        Method::Soft(soft) => match soft.solver {
            Solver::Grid(_) => ground::build::<md::GridSteps>(scene, state),
            Solver::Exact => ground::build::<exact::LinearEvents>(scene, state),
            Solver::Adaptive { .. } => ground::build::<adaptive::AdaptiveSteps>(scene, state),
        },
        Method::Hard(_) => ground::build::<ed::HardEvents>(scene, state),
    }
}
