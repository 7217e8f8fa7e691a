//! Columns on one clock, edits and all, without a thread or a screen.

use super::{Edit, Tape, hashes};
use crate::physics::{self, Engine, EngineError, Observation, Outcome, State};
use crate::scene::Scene;

/// The states that other scenes go on from, each from the column it follows, or from another
/// where that has failed; none if no column is of the right kind. `states` are those of
/// columns of `present` that have come to `reached`, s.
pub fn sources(
    present: &[Scene],
    mut states: Vec<Option<State>>,
    reached: f64,
    scenes: &[Scene],
    from: &[usize],
) -> Option<Vec<State>> {
    // A column may be ahead of the other by some time: the plate turns after both.
    let times = states.iter().flatten().map(|state| state.time);
    let latest = times.fold(reached, f64::max);
    let known = states.iter_mut().flatten();
    known.for_each(|state| state.settle(latest));
    let shape = |scene: &Scene| (scene.n, scene.sites().is_some());
    let fits = |scene: &Scene, index: usize| {
        let of = present.get(index).map(shape);
        states
            .get(index)?
            .as_ref()
            .filter(|_| of == Some(shape(scene)))
    };
    scenes
        .iter()
        .zip(from)
        .map(|(scene, &own)| {
            let source = fits(scene, own);
            source
                .or_else(|| (0..states.len()).find_map(|other| fits(scene, other)))
                .cloned()
        })
        .collect()
}

/// Steps or events between two words about how far it is.
const BUDGET: u64 = 200_000;

/// A tape that is played again.
pub struct Replay {
    /// Its columns.
    pub player: Player,
    /// Edits made.
    pub edits: usize,
    /// States compared.
    pub compared: usize,
    /// When a state first was another than on the tape, s, and of which column, from 1.
    pub differs: Option<(f64, usize)>,
}

impl Replay {
    /// The start of a tape.
    pub fn new(tape: &Tape) -> Replay {
        Replay {
            player: Player::new(&tape.scenes),
            edits: 0,
            compared: 0,
            differs: None,
        }
    }

    /// Moves on to `until`, s, through all that the tape has on the way; `told` hears how far
    /// it is.
    pub fn go(&mut self, tape: &Tape, until: f64, told: &mut dyn FnMut(f64)) {
        loop {
            let edit = tape.edits.get(self.edits);
            let mark = tape.marks.get(self.compared);
            let next = edit.map_or(f64::INFINITY, |edit| edit.time);
            let next = next.min(mark.map_or(f64::INFINITY, |mark| mark.time));
            let goal = until.min(next);
            while !self.player.advance(goal, BUDGET) {
                told(self.player.reached());
            }
            told(self.player.reached());
            // A state from before an edit at the same time comes first.
            if let Some(mark) = mark.filter(|mark| mark.time <= goal && mark.edits <= self.edits) {
                let hashes = self.player.hashes();
                let pairs = mark.hashes.iter().zip(&hashes);
                let same = pairs.take_while(|(before, now)| before == now).count();
                if same < mark.hashes.len().max(hashes.len()) && self.differs.is_none() {
                    self.differs = Some((mark.time, same + 1));
                }
                self.compared += 1;
            } else if let Some(edit) = edit.filter(|edit| edit.time <= goal) {
                self.player.edit(edit);
                self.edits += 1;
            } else {
                return;
            }
        }
    }
}

/// A column that is played.
struct Playing {
    scene: Scene,
    engine: Result<Box<dyn Engine>, EngineError>,
}

/// The columns of a tape as they move.
pub struct Player {
    columns: Vec<Playing>,
    reached: f64,
}

impl Player {
    /// The columns at t = 0.
    pub fn new(scenes: &[Scene]) -> Player {
        let column = |scene: &Scene| Playing {
            scene: scene.clone(),
            engine: Ok(physics::build(scene, None).0),
        };
        Player {
            columns: scenes.iter().map(column).collect(),
            reached: 0.0,
        }
    }

    /// Simulated time that all columns have come to, s.
    pub fn reached(&self) -> f64 {
        self.reached
    }

    /// How many columns there are.
    pub fn columns(&self) -> usize {
        self.columns.len()
    }

    /// What a column is of.
    pub fn scene(&self, column: usize) -> Option<&Scene> {
        self.columns.get(column).map(|column| &column.scene)
    }

    /// Why a column stopped, if it did.
    pub fn failure(&self, column: usize) -> Option<&EngineError> {
        self.columns.get(column)?.engine.as_ref().err()
    }

    /// Looks at a column; whether it still moves.
    pub fn observe(&self, column: usize, into: &mut Observation) -> bool {
        match self.columns.get(column).map(|column| &column.engine) {
            Some(Ok(engine)) => {
                engine.observe(into);
                true
            }
            _ => false,
        }
    }

    /// Moves on to `until`, s, in at most so many steps or events a column; whether all have
    /// come there.
    pub fn advance(&mut self, until: f64, budget: u64) -> bool {
        // An edit may leave an engine at its last step, a little before.
        if until <= self.reached {
            return true;
        }
        let mut arrived = true;
        for column in &mut self.columns {
            let Ok(engine) = &mut column.engine else {
                continue;
            };
            match engine.advance(until, budget) {
                Ok(Outcome::OutOfBudget) => arrived = false,
                Ok(_) => {}
                Err(error) => column.engine = Err(error),
            }
        }
        if arrived {
            self.reached = self.reached.max(until);
        }
        arrived
    }

    /// Makes an edit, whose time the columns have come to; whether there was a column to go
    /// on from.
    pub fn edit(&mut self, edit: &Edit) -> bool {
        let states = self.states().collect();
        let present: Vec<Scene> = self.columns.iter().map(|each| each.scene.clone()).collect();
        let Some(states) = sources(&present, states, self.reached, &edit.scenes, &edit.from) else {
            return false;
        };
        let column = |(scene, state): (&Scene, &State)| Playing {
            scene: scene.clone(),
            engine: Ok(physics::build(scene, Some(state)).0),
        };
        self.columns = edit.scenes.iter().zip(&states).map(column).collect();
        true
    }

    /// The columns' states; none of a column whose engine has failed.
    fn states(&self) -> impl Iterator<Item = Option<State>> {
        self.columns.iter().map(|column| {
            let engine = column.engine.as_ref().ok();
            engine.map(|engine| engine.state())
        })
    }

    /// The hashes of the columns' states.
    pub fn hashes(&self) -> Vec<String> {
        hashes(self.states())
    }
}
