//! One column on the simulation thread, whatever its engine does.

use std::any::Any;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::time::{Duration, Instant};

use super::{Side, Status};
use crate::physics::{Engine, Handover, Observation, Outcome, State};
use crate::scene::Scene;

/// How engines are built: [`crate::physics::build`], or a stand-in for it.
pub type Build = Box<dyn FnMut(&Scene, Option<&State>) -> (Box<dyn Engine>, Handover) + Send>;

/// One call of an engine should last about this long, so that orders are answered.
const CALL: Duration = Duration::from_millis(1);
/// Steps or events of the first call.
const FIRST_BUDGET: u64 = 256;

/// Memory of an engine and of what was last seen of it: the exact one, which has the most,
/// takes 6 KB with one bead and 14 with ten, and a lattice 0.4 KB a bead.
const BYTES: usize = 8 << 10;
const BYTES_A_BEAD: usize = 1 << 10;

/// One column, its engine kept apart from the thread that drives it: what the
/// engine raises, an error or a panic, ends here and becomes a sentence.
#[derive(Clone)]
pub(super) struct Runner {
    scene: Scene,
    engine: Result<Box<dyn Engine>, String>,
    reached: f64,
    budget: u64,
    seen: Observation,
    note: Option<String>,
    plate_note: Option<&'static str>,
}

impl Runner {
    /// Builds the engine of `scene`, from the start or from a state at `time`.
    pub(super) fn new(build: &mut Build, scene: Scene, from: Option<&State>, time: f64) -> Runner {
        let built = catch_unwind(AssertUnwindSafe(|| build(&scene, from)));
        let mut runner = Runner {
            scene,
            engine: Err(String::new()),
            reached: time,
            budget: FIRST_BUDGET,
            seen: Observation::default(),
            note: None,
            plate_note: None,
        };
        match built {
            Ok((engine, handover)) => {
                runner.engine = Ok(engine);
                runner.note = handover
                    .describe()
                    .map(|what| format!("{}: {what}", runner.label()));
                runner.plate_note = handover.describe_plate();
                runner.observe();
            }
            Err(panic) => runner.fail(&describe(panic.as_ref())),
        }
        runner
    }

    pub(super) fn is_alive(&self) -> bool {
        self.engine.is_ok()
    }

    /// Why its engine stopped, if it did.
    pub(super) fn failure(&self) -> Option<&str> {
        self.engine.as_ref().err().map(String::as_str)
    }

    pub(super) fn scene(&self) -> &Scene {
        &self.scene
    }

    /// Moves towards `until` for about [`CALL`]; whether it has come there. A column
    /// whose engine has failed holds nobody up.
    pub(super) fn advance(&mut self, until: f64) -> bool {
        if self.reached >= until {
            return true;
        }
        let budget = self.budget;
        let started = Instant::now();
        match self.guarded(|engine| engine.advance(until, budget)) {
            Some(Ok(Outcome::OutOfBudget)) => {
                self.fit_budget(started.elapsed());
                return false;
            }
            Some(Ok(Outcome::Reached | Outcome::Over)) => self.reached = until,
            Some(Err(error)) => {
                self.observe();
                self.fail(&error.to_string());
            }
            None => {}
        }
        true
    }

    fn fit_budget(&mut self, took: Duration) {
        if took < CALL / 2 {
            self.budget = self.budget.saturating_mul(2);
        } else if took > CALL {
            self.budget = (self.budget / 2).max(1);
        }
    }

    /// Whether its floor collision is over; nothing more is to come of a failed one.
    pub(super) fn is_over(&mut self) -> bool {
        self.guarded(|engine| engine.is_over()).unwrap_or(true)
    }

    pub(super) fn next_event(&mut self) -> Option<f64> {
        self.guarded(|engine| engine.next_event()).flatten()
    }

    pub(super) fn state(&mut self) -> Option<State> {
        self.guarded(|engine| engine.state())
    }

    /// Looks at the column anew; a failed one stays as it was last seen.
    pub(super) fn observe(&mut self) -> &Observation {
        let mut seen = std::mem::take(&mut self.seen);
        self.guarded(|engine| engine.observe(&mut seen));
        self.seen = seen;
        &self.seen
    }

    /// The column as it was last looked at.
    pub(super) fn seen(&self) -> &Observation {
        &self.seen
    }

    /// How much memory it takes at most, bytes.
    pub(super) fn bytes(&self) -> usize {
        BYTES + BYTES_A_BEAD * self.scene.n
    }

    pub(super) fn side(&mut self) -> Side {
        self.observe();
        let over = self.is_over();
        let status = match &self.engine {
            Err(why) => Status::Failed(why.clone()),
            Ok(_) if over => Status::Over,
            Ok(_) => Status::Running,
        };
        Side {
            seen: self.seen.clone(),
            status,
            accuracy: None,
        }
    }

    /// The sentence that it has for the screen, once.
    pub(super) fn take_note(&mut self) -> Option<String> {
        self.note.take()
    }

    /// What it has to say of the plate, which other columns have too, once.
    pub(super) fn take_plate_note(&mut self) -> Option<&'static str> {
        self.plate_note.take()
    }

    fn label(&self) -> &'static str {
        match self.scene.is_md() {
            _ if self.scene.sites().is_some() => "2D",
            true => "MD",
            false => "ED",
        }
    }

    fn fail(&mut self, why: &str) {
        self.note = Some(format!("{} stopped: {why}", self.label()));
        self.engine = Err(why.to_owned());
    }

    /// What `work` gives, unless the engine has failed or panics at it.
    fn guarded<T>(&mut self, work: impl FnOnce(&mut dyn Engine) -> T) -> Option<T> {
        let engine = self.engine.as_mut().ok()?;
        match catch_unwind(AssertUnwindSafe(|| work(engine.as_mut()))) {
            Ok(result) => Some(result),
            Err(panic) => {
                self.fail(&describe(panic.as_ref()));
                None
            }
        }
    }
}

fn describe(panic: &(dyn Any + Send)) -> String {
    let text = panic
        .downcast_ref::<&str>()
        .copied()
        .or_else(|| panic.downcast_ref::<String>().map(String::as_str))
        .unwrap_or("no reason given");
    let line = text.lines().next().unwrap_or_default();
    format!("its engine panicked ({line})")
}
