//! The scenes on the bench: the column and its twin, or a lattice and a column as high,
//! and the edits of them.

mod undo;

use std::cell::OnceCell;

use crate::live::reference;
use crate::physics::spectrum::too_few_steps;
use crate::scene::parameters::{self, Parameter, Setting, Value, table};
use crate::scene::{Draft, Facts, Method, MethodName, Preset, Scene, SceneError};

/// Edits that can be undone.
const UNDO: usize = 200;

/// The scenes of a preset: one, or two with soft contacts on the left.
#[derive(Debug, Clone)]
pub struct Bench {
    scenes: Vec<Scene>,
    original: Vec<Scene>,
    undo: Vec<Vec<Scene>>,
    /// What was undone, the last one last; nothing after another edit.
    redo: Vec<Vec<Scene>>,
    /// Which of two scenes is the preset's own, now and in the preset.
    own: usize,
    first_own: usize,
    /// The soft-contact method last in force, to come back to.
    soft: Option<Method>,
    /// The hard-sphere method last in force.
    hard: Option<Method>,
    /// Steps in a contact time, and the tolerance, last in force.
    steps: Option<f64>,
    tolerance: Option<f64>,
    references: Vec<Result<Scene, String>>,
    /// Worked out when the screen asks: a held key edits more often than the screen is drawn.
    least_steps: Vec<OnceCell<Option<f64>>>,
}

/// What an edit means for the running columns.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Change {
    /// They go on, each from the column of that index.
    GoOn(Vec<usize>),
    /// They start again from t = 0.
    Restart,
}

impl Bench {
    /// The scenes of a preset: its own, and its twin where there is one. A lattice has a
    /// column on its right.
    ///
    /// # Errors
    /// When the preset that is to run beside it cannot be loaded.
    pub fn new(preset: &Preset) -> Result<Bench, String> {
        let own = preset.scene.clone();
        let twin = match &preset.beside {
            Some(name) => Some(Preset::load(name).map_err(|error| error.to_string())?.scene),
            None => match own.column_as_high() {
                Some(column) => column.ok(),
                None if own.is_md() => own.with_method(MethodName::Ed).ok(),
                None => None,
            },
        };
        let (scenes, own) = match twin {
            Some(twin) if twin.is_md() && !own.is_md() => (vec![twin, own], 1),
            Some(twin) => (vec![own, twin], 0),
            None => (vec![own], 0),
        };
        let mut bench = Bench {
            original: scenes.clone(),
            scenes,
            undo: Vec::new(),
            redo: Vec::new(),
            own,
            first_own: own,
            soft: None,
            hard: None,
            steps: None,
            tolerance: None,
            references: Vec::new(),
            least_steps: Vec::new(),
        };
        bench.settle();
        Ok(bench)
    }

    /// The scenes, left to right.
    pub fn scenes(&self) -> &[Scene] {
        &self.scenes
    }

    /// The preset's own scene, edited.
    pub fn own(&self) -> &Scene {
        &self.scenes[self.own.min(self.scenes.len() - 1)]
    }

    /// Whether the first scene is a lattice.
    pub fn is_lattice(&self) -> bool {
        self.scenes[0].sites().is_some()
    }

    /// The scenes that are edited: the column beside a lattice follows it.
    fn edited_ones(&self) -> &[Scene] {
        let count = if self.is_lattice() {
            1
        } else {
            self.scenes.len()
        };
        &self.scenes[..count]
    }

    /// The scene to hold each one's results against, or why there is none.
    pub fn references(&self) -> &[Result<Scene, String>] {
        &self.references
    }

    /// The least steps in a contact time, where the scene of that index has fewer.
    pub fn least_steps(&self, index: usize) -> Option<f64> {
        *self.least_steps[index].get_or_init(|| too_few_steps(&self.scenes[index]))
    }

    /// The contact time that σ is taken with, s: that of the soft contacts, or of
    /// the TC rule; none among hard spheres alone.
    pub fn contact_time(&self) -> Option<f64> {
        let soft = self.scenes.iter().find(|scene| scene.is_md());
        soft.and_then(|scene| scene.contact_time())
            .or_else(|| self.scenes.iter().find_map(|scene| scene.contact_time()))
    }

    /// The period of the plate, s, where it vibrates.
    pub fn period(&self) -> Option<f64> {
        self.scenes[0].period()
    }

    /// The parameters that the scenes have, in the order of the table. A run's
    /// duration is not the explorer's.
    pub fn parameters(&self) -> Vec<&'static Parameter> {
        table()
            .iter()
            .filter(|p| p.name != "duration" && self.value(p).is_some())
            .collect()
    }

    /// The value of a parameter in the first scene that has it.
    pub fn value(&self, parameter: &Parameter) -> Option<Value> {
        self.edited_ones()
            .iter()
            .find_map(|scene| (parameter.get)(scene.facts()))
    }

    /// Sets a parameter in every scene that has it: in all of them or, when one of
    /// them refuses, in none.
    ///
    /// # Errors
    /// The first scene's reason to refuse.
    pub fn set(
        &mut self,
        parameter: &'static Parameter,
        value: Value,
    ) -> Result<Change, SceneError> {
        let has = |scene: &Scene| parameter.applies(scene.facts());
        if !self.edited_ones().iter().any(has) {
            Draft::of(&self.scenes[0]).set(&[Setting { parameter, value }])?;
        }
        let mut edited = self
            .scenes
            .iter()
            .map(|scene| {
                if has(scene) {
                    self.edited(scene, parameter, value)
                } else {
                    Ok(scene.clone())
                }
            })
            .collect::<Result<Vec<Scene>, SceneError>>()?;
        self.follow(&mut edited)?;
        Ok(self.put(edited))
    }

    /// What follows the edit of the other: the column beside a lattice is always as high.
    /// Under a power law restitution follows from the law: when an edit changes it, the
    /// hard twin has the new one.
    fn follow(&self, edited: &mut [Scene]) -> Result<(), SceneError> {
        let [soft, hard] = edited else {
            return Ok(());
        };
        if let Some(column) = soft.column_as_high() {
            *hard = column?;
            return Ok(());
        }
        let before = &self.scenes[0];
        let ruled = |scene: &Scene| scene.depends_on_speed();
        if hard.is_md() || soft.restitution == before.restitution || !(ruled(soft) || ruled(before))
        {
            return Ok(());
        }
        *hard = Scene::new(Facts {
            restitution: soft.restitution,
            ..hard.facts().clone()
        })?;
        Ok(())
    }

    fn edited(
        &self,
        scene: &Scene,
        parameter: &'static Parameter,
        value: Value,
    ) -> Result<Scene, SceneError> {
        let mut draft = Draft::of(scene);
        let mut layer = vec![Setting { parameter, value }];
        // The TC rule needs a contact time, and the soft twin has one.
        if let (Value::Choice("tc"), Some(time), Some(row)) =
            (value, self.contact_time(), parameters::find("contact_time"))
        {
            layer.push(Setting {
                parameter: row,
                value: Value::Number(time),
            });
        }
        draft.set(&layer)?;
        draft.finish()
    }

    /// Back to the preset, if something was edited. This can be undone.
    pub fn reset(&mut self) -> Option<Change> {
        if self.scenes == self.original {
            return None;
        }
        let original = self.original.clone();
        self.own = self.first_own;
        Some(self.put(original))
    }

    /// The next method for the left column: Gear, Verlet, exact, ED, and so on round; of a
    /// lattice the first two.
    ///
    /// # Errors
    /// When the scene cannot have any other method, in a sentence.
    pub fn next_method(&mut self) -> Result<Change, String> {
        let scene = &self.scenes[0];
        let next = match scene.method.name() {
            MethodName::Gear => scene.with_method(MethodName::Verlet),
            // A lattice has no more methods than these two.
            MethodName::Verlet if scene.sites().is_some() => scene.with_method(MethodName::Gear),
            MethodName::Verlet => scene.with_method(MethodName::Exact),
            MethodName::Exact => {
                Self::with(scene, self.hard).unwrap_or_else(|| scene.with_method(MethodName::Ed))
            }
            MethodName::Ed => Self::with(scene, self.soft)
                .unwrap_or_else(|| scene.with_method(MethodName::Gear))
                .and_then(|soft| soft.with_method(MethodName::Gear)),
        };
        let next = next.and_then(|scene| self.as_before(&scene));
        let mut scenes = self.scenes.clone();
        let refused = |error| format!("no other method: {error}");
        scenes[0] = next.map_err(refused)?;
        self.follow(&mut scenes).map_err(refused)?;
        Ok(self.put(scenes))
    }

    /// The scene with the steps, or the tolerance, that were last in force.
    fn as_before(&self, scene: &Scene) -> Result<Scene, SceneError> {
        let mut facts = scene.facts().clone();
        if let (Some(grid), Some(steps)) = (facts.grid_mut(), self.steps) {
            grid.steps_per_contact = steps;
        }
        if let (Some(now), Some(before)) = (facts.tolerance_mut(), self.tolerance) {
            *now = before;
        }
        Scene::new(facts)
    }

    /// Puts the twin beside the column, from its present state, or takes it away; a column
    /// beside a lattice starts with it.
    ///
    /// # Errors
    /// When there can be no twin, in a sentence.
    pub fn toggle_twin(&mut self) -> Result<Change, String> {
        if self.scenes.len() == 2 {
            let kept = self.own.min(1);
            self.scenes = vec![self.scenes[kept].clone()];
            self.forget_edits();
            self.settle();
            return Ok(Change::GoOn(vec![kept]));
        }
        let own = self.scenes[0].clone();
        if let Some(column) = own.column_as_high() {
            let column = column.map_err(|error| format!("no column beside it: {error}"))?;
            self.forget_edits();
            self.scenes = vec![own, column];
            self.settle();
            return Ok(Change::Restart);
        }
        let twin = if own.is_md() {
            Self::with(&own, self.hard).unwrap_or_else(|| own.with_method(MethodName::Ed))
        } else {
            Self::with(&own, self.soft).unwrap_or_else(|| own.with_method(MethodName::Gear))
        };
        let twin = twin.map_err(|error| format!("no twin: {error}"))?;
        self.forget_edits();
        self.own = usize::from(twin.is_md());
        self.scenes = if twin.is_md() {
            vec![twin, own]
        } else {
            vec![own, twin]
        };
        self.settle();
        Ok(Change::GoOn(vec![0, 0]))
    }

    /// The scene under a method that was in force before.
    fn with(scene: &Scene, method: Option<Method>) -> Option<Result<Scene, SceneError>> {
        method.map(|method| {
            Scene::new(Facts {
                method,
                ..scene.facts().clone()
            })
        })
    }

    fn put(&mut self, scenes: Vec<Scene>) -> Change {
        let change = self.change_to(&scenes);
        if self.undo.len() == UNDO {
            self.undo.remove(0);
        }
        self.undo.push(std::mem::replace(&mut self.scenes, scenes));
        self.redo.clear();
        self.settle();
        change
    }

    /// Other columns have other scenes than those that could be gone back to.
    fn forget_edits(&mut self) {
        self.undo.clear();
        self.redo.clear();
    }

    /// Remembers the methods in force, and finds what the scenes are held against.
    fn settle(&mut self) {
        for scene in &self.scenes {
            let memory = if scene.is_md() {
                &mut self.soft
            } else {
                &mut self.hard
            };
            *memory = Some(scene.method);
            let steps = scene.grid().map(|grid| grid.steps_per_contact);
            self.steps = steps.or(self.steps);
            self.tolerance = scene.tolerance().or(self.tolerance);
        }
        self.references = self.scenes.iter().map(reference).collect();
        self.least_steps = vec![OnceCell::new(); self.scenes.len()];
    }

    /// What it takes to get from the present scenes to others.
    fn change_to(&self, others: &[Scene]) -> Change {
        let fixed = |scene: &Scene| {
            let rows = table().iter().filter(|parameter| !parameter.live);
            rows.map(|parameter| (parameter.get)(scene.facts()))
                .collect::<Vec<_>>()
        };
        let same = others.len() == self.scenes.len()
            && self
                .scenes
                .iter()
                .zip(others)
                .all(|(a, b)| fixed(a) == fixed(b));
        if same {
            Change::GoOn((0..others.len()).collect())
        } else {
            Change::Restart
        }
    }
}
