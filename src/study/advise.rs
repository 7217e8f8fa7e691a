//! The longest contact time that one can afford: how soft contacts may be before what
//! is measured leaves its limit, and what the methods cost there.
//!
//! The limit is that of hard spheres, or of another, shorter contact time. All contact
//! times are looked at with the exact method, on a ladder first and then by bisection;
//! the curve need not be monotone, so the answer is the longest contact time up to
//! which everything that was looked at is within the tolerance.

mod answer;
mod cost;
mod family;
mod probe;
mod search;
mod tables;

pub use search::Standing;

use super::plot::Plot;
use super::table::Table;
use super::verdict::verdict;
use super::{RunError, Tell};
use crate::scene::preset::Preset;
use crate::scene::{Scene, SceneError};
use std::ops::ControlFlow;
use std::time::Duration;

/// What a soft column is compared with.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Against {
    /// Hard spheres.
    Hard,
    /// The contact time of the scene itself, taken for the material's.
    Material,
    /// Another contact time, s.
    Time(f64),
}

/// What is asked.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Question {
    /// The limit.
    pub against: Against,
    /// What is allowed: a part of the limit, or the difference itself where the limit is 0.
    pub tolerance: f64,
    /// Shortest and longest contact time to look at, s, where somebody says so.
    pub between: Option<(f64, f64)>,
    /// A coarser ladder and a wider bracket.
    pub quick: bool,
    /// Wall-clock time of the search; measuring the cost takes a little more.
    pub time: Duration,
    /// Threads; the answer does not depend on them where the time does not run out.
    pub threads: usize,
}

/// What is answered.
#[derive(Debug, Clone, PartialEq)]
pub struct Advice {
    /// The longest contact time within the tolerance, s, if there is one.
    pub contact_time: Option<f64>,
    /// How that is to be understood.
    pub standing: Standing,
    /// The answer beside the limit and the scene itself.
    pub answer: Table,
    /// What the methods cost there; empty without an answer.
    pub cost: Table,
    /// All that was looked at.
    pub curve: Table,
    /// The same as a picture.
    pub plot: Plot,
}

/// Why there is no advice.
#[derive(Debug, Clone, PartialEq, thiserror::Error)]
pub enum AdviseError {
    /// The scene cannot have soft contacts, or not those that are asked for.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// There is no exact method for it.
    #[error("a lattice has no exact run to look at contact times with; ask about a column")]
    Lattice,
    /// Hard spheres are not what the law comes to.
    #[error(
        "law {law}: hard spheres have one restitution at all speeds and a floor after the linear \
         law, so they are not its limit; compare with a contact time: --against material or \
         --against SECONDS"
    )]
    NotItsLimit {
        /// The law.
        law: &'static str,
    },
    /// The scene has no contact time of its own.
    #[error("--against material: the scene has no contact time; give one: --against SECONDS")]
    NoMaterial,
    /// Nothing to look at.
    #[error("--between {from:e}:{to:e}: of such contact times the scene can have none or only one")]
    NoRange {
        /// The shortest, s.
        from: f64,
        /// The longest, s.
        to: f64,
    },
    /// The limit is not found.
    #[error("the limit cannot be measured: {0}")]
    Limit(RunError),
    /// The limit takes longer than there is time.
    #[error(
        "the limit alone takes more than its share of the time, {share} s, a quarter of all; \
         --budget gives more (hard spheres near inelastic collapse may take minutes)"
    )]
    LimitTooSlow {
        /// What it had, s.
        share: f64,
    },
    /// No run with soft contacts gave anything.
    #[error("no contact time gives a result: {0}")]
    Nothing(String),
    /// The limit is not a number.
    #[error("the limit cannot be measured: {0}")]
    NoLimit(String),
}

/// What of a scene is compared.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum SceneKind {
    /// A floor collision without gravity: its ε_eff.
    Launched,
    /// A column that falls on a floor at rest: its mean height.
    Falling,
    /// A column on a plate that vibrates: means over many periods.
    Shaken,
}

impl SceneKind {
    fn of(scene: &Scene) -> Self {
        match (scene.gravity, scene.alpha()) {
            (None, _) => Self::Launched,
            (Some(_), Some(alpha)) if alpha > 0.0 => Self::Shaken,
            _ => Self::Falling,
        }
    }
}

/// The tolerance where nobody says otherwise: means on a plate have errors of their own.
pub fn common_tolerance(scene: &Scene) -> f64 {
    match SceneKind::of(scene) {
        SceneKind::Launched | SceneKind::Falling => 0.01,
        SceneKind::Shaken => 0.05,
    }
}

/// The longest contact time of a preset's scene within a tolerance of a limit.
///
/// # Errors
/// When there is nothing to compare, or the limit cannot be measured.
pub fn advise(preset: &Preset, question: Question, tell: &mut Tell) -> Result<Advice, AdviseError> {
    let family = family::Family::of(preset)?;
    let search = search::Search::run(&family, question, tell)?;
    tell("the verdict", None);
    let judged =
        verdict(&preset.scene, &mut |_| ControlFlow::Continue(())).map_err(AdviseError::Limit)?;
    let cost = search
        .longest()
        .map(|probe| cost::costs(&probe.scene, &preset.scene, search.kind, question, tell));
    Ok(answer::advice(
        &search, &family, preset, question, cost, &judged,
    ))
}
