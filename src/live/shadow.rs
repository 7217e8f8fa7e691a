//! A run in the shadow of a soft column that is exact, or more so, and how far the
//! column is off it.
//!
//! The shadow starts from the column's state and then goes from mark to mark: a mark is
//! the column as it was at one of its own times. The columns never wait for it: it
//! works when they have come to where the clock wants them. A mark that it does not
//! reach for too long is its last.

use std::time::{Duration, Instant};

use super::runner::{Build, Runner};
use crate::scene::{Facts, Method, Scene, Soft, Solver};

/// Shadows work for this long between two looks at the orders.
const SLICE: Duration = Duration::from_millis(4);
/// Turns of the loop, each a few milliseconds, that a mark may wait: about two seconds.
const PATIENCE: u32 = 500;
/// Tolerance beside columns that have none of their own; the grids of fixed steps are
/// coarser by far.
const TIGHT: f64 = 1e-12;
/// Tighter than the tolerance of a column by this factor.
const TIGHTER: f64 = 0.01;
/// No tolerance is tighter.
const TIGHTEST: f64 = 1e-14;

/// How far a column is off its shadow.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Distance {
    /// When they were compared, s: a time of the column.
    pub time: f64,
    /// The largest difference of a bead's height, m.
    pub height: f64,
    /// Difference of the kinetic energy, relative to the larger one.
    pub energy: f64,
}

/// What is known of the error of a column.
#[derive(Debug, Clone, PartialEq)]
pub enum Accuracy {
    /// The shadow follows.
    Follows {
        /// When it started from the column's state, s.
        since: f64,
        /// How far off the column was when they were last compared.
        distance: Option<Distance>,
    },
    /// The shadow has been given up, and why.
    GivenUp(String),
}

/// The scene of the shadow of a column: exact, or by the adaptive method at a tighter
/// tolerance than the column's own.
///
/// # Errors
/// Why there is none, in a sentence.
pub fn reference(scene: &Scene) -> Result<Scene, String> {
    let Some(soft) = scene.soft() else {
        return Err("hard spheres are another model, and have no exact run".into());
    };
    if scene.sites().is_some() {
        return Err("a lattice has no exact run".into());
    }
    let solver = match (soft.law.locating(), soft.solver) {
        (Solver::Adaptive { .. }, Solver::Adaptive { tolerance }) if tolerance <= TIGHTEST => {
            return Err(format!(
                "no tolerance is tighter than {tolerance:.0e}: no better run to compare with"
            ));
        }
        (Solver::Adaptive { .. }, Solver::Adaptive { tolerance }) => Solver::Adaptive {
            tolerance: (TIGHTER * tolerance).clamp(TIGHTEST, TIGHT),
        },
        (Solver::Adaptive { .. }, _) => Solver::Adaptive { tolerance: TIGHT },
        (exact, _) => exact,
    };
    Scene::new(Facts {
        method: Method::Soft(Soft { solver, ..soft }),
        ..scene.facts().clone()
    })
    .map_err(|error| error.to_string())
}

/// The column as it was at one of its times.
struct Mark {
    time: f64,
    reduced: Vec<f64>,
    kinetic: f64,
}

/// A shadow that follows.
struct Follower {
    runner: Runner,
    since: f64,
    distance: Option<Distance>,
    mark: Option<Mark>,
    /// Time of the last mark, s.
    marked: f64,
    /// Turns that the mark has waited.
    turns: u32,
}

/// The shadow of a column.
pub(super) struct Shadow(Result<Box<Follower>, String>);

impl Shadow {
    /// The shadow of a column from its state now; none beside columns that cannot have
    /// one.
    pub(super) fn of(build: &mut Build, column: &mut Runner) -> Option<Shadow> {
        let scene = reference(column.scene()).ok()?;
        let state = column.state()?;
        let since = column.observe().time;
        let runner = Runner::new(build, scene, Some(&state), since);
        Some(Shadow(Ok(Box::new(Follower {
            runner,
            since,
            distance: None,
            mark: None,
            marked: f64::NEG_INFINITY,
            turns: 0,
        }))))
    }

    /// Whether it has been given up.
    pub(super) fn is_given_up(&self) -> bool {
        self.0.is_err()
    }

    /// Whether a mark is still ahead of it.
    pub(super) fn is_waited_for(&self) -> bool {
        matches!(&self.0, Ok(follower) if follower.mark.is_some())
    }

    /// Goes on towards its mark, the column as it is now where there was none; only when
    /// there `is_time`. It is given up when a mark waits for too long.
    pub(super) fn follow(&mut self, column: &mut Runner, is_time: bool) {
        let Ok(follower) = &mut self.0 else {
            return;
        };
        follower.look_at(column);
        if is_time {
            follower.work();
        }
        if let Some(why) = follower.failure() {
            self.0 = Err(why);
        }
    }

    /// The largest difference of a bead's height when last compared, m.
    pub(super) fn height(&self) -> Option<f64> {
        let follower = self.0.as_ref().ok()?;
        Some(follower.distance?.height)
    }

    /// What is known of the error.
    pub(super) fn accuracy(&self) -> Accuracy {
        match &self.0 {
            Ok(follower) => Accuracy::Follows {
                since: follower.since,
                distance: follower.distance,
            },
            Err(why) => Accuracy::GivenUp(why.clone()),
        }
    }
}

impl Follower {
    /// Takes the next mark, if it is free for one and the column has moved.
    fn look_at(&mut self, column: &mut Runner) {
        if self.mark.is_some() {
            return;
        }
        let seen = column.observe();
        if seen.time > self.marked {
            self.marked = seen.time;
            self.turns = 0;
            self.mark = Some(Mark {
                time: seen.time,
                reduced: seen.reduced.clone(),
                kinetic: seen.energy.kinetic,
            });
        }
    }

    fn work(&mut self) {
        let started = Instant::now();
        while let Some(mark) = &self.mark {
            if self.runner.advance(mark.time) {
                self.distance = Some(mark.distance(&mut self.runner));
                self.mark = None;
            }
            if started.elapsed() >= SLICE {
                return;
            }
        }
    }

    /// Why it must be given up, one turn later.
    fn failure(&mut self) -> Option<String> {
        if let Some(why) = self.runner.failure() {
            return Some(format!("it stopped: {why}"));
        }
        self.turns += u32::from(self.mark.is_some());
        (self.turns > PATIENCE).then(|| "it cannot keep up".to_owned())
    }
}

impl Mark {
    fn distance(&self, shadow: &mut Runner) -> Distance {
        let seen = shadow.observe();
        let beads = self.reduced.iter().zip(&seen.reduced);
        let kinetic = seen.energy.kinetic;
        let larger = self.kinetic.max(kinetic);
        let energy = (self.kinetic - kinetic).abs();
        Distance {
            time: self.time,
            height: beads.map(|(a, b)| (a - b).abs()).fold(0.0, f64::max),
            energy: if larger > 0.0 { energy / larger } else { 0.0 },
        }
    }
}
