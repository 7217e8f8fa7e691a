//! Everything that the screen shows, and how frames change it.

mod bench;
mod fit;
mod ghost;
mod keep;
mod lens;
mod message;
mod overlay;
mod pace;
mod page;
mod prompt;
mod room;
mod scale;

pub use bench::{Bench, Change};
use fit::sweep;
pub use ghost::Ghost;
pub use keep::Origin;
pub use lens::Lens;
pub use message::Message;
pub(super) use overlay::moved;
pub use overlay::{Menu, Overlay};
pub use pace::{Speed, speed_text};
pub use page::Page;
pub use prompt::{Note, Place, Prompt};
pub use room::Notice;
pub use scale::Scale;

use std::time::{Duration, Instant};

use super::caption::ReadingTime;
use super::layout;
use super::theme::Theme;
use crate::live::{Accuracy, Frame, History, Order, Side, Status};
use crate::scene::{Preset, Scene};
use crate::study::verdict::Verdict;

/// Numbers are written this often: five times a second is read better than thirty.
const NUMBERS: Duration = Duration::from_millis(200);
/// The beads of the column now are drawn this often.
const COLUMN: Duration = Duration::from_millis(100);
/// Discs on no more cells than this are drawn as often.
const FEW_CELLS: u32 = 520;

/// Something seen of the columns, refreshed at its own rate.
#[derive(Debug, Clone, Default)]
pub struct Glimpse {
    /// The columns.
    pub sides: Vec<Side>,
    /// Simulated time, s.
    pub time: f64,
    /// Simulated seconds in a second, reached lately.
    pub achieved: Option<f64>,
    taken: Option<Instant>,
}

/// The row of the parameter panel selected at first: the restitution, which every scene
/// has and which changes without a restart.
fn first_row(bench: &Bench) -> usize {
    let rows = bench.parameters();
    let found = rows.iter().position(|row| row.name == "restitution");
    found.unwrap_or(0)
}

/// Everything that the screen shows.
#[derive(Debug)]
pub struct Model {
    /// What the shell would call it, and how it came.
    pub(super) origin: Origin,
    /// The preset on the bench.
    pub preset: Preset,
    /// Its scenes, and their edits.
    pub bench: Bench,
    /// Speed asked for.
    pub speed: Speed,
    /// Whether simulated time stands still.
    pub paused: bool,
    /// How many orders the simulation thread was given.
    pub orders: u64,
    /// Whether it stands still by itself, the page being full.
    pub held: bool,
    /// Whether exact runs were asked for in the shadow of soft columns.
    pub shadow: bool,
    /// Simulated time that the columns have come to, s, however far it is gone back.
    pub end: f64,
    /// The traces.
    pub page: Page,
    /// What the numbers are written from.
    pub numbers: Glimpse,
    /// What the column now is drawn from.
    pub column: Glimpse,
    /// The selected row of the parameter panel.
    pub selected: usize,
    /// The scene that was last asked to be judged, and its verdict when it is there.
    judged: Option<(Scene, Option<Verdict>)>,
    /// What lies over the main screen.
    pub overlay: Overlay,
    /// Lines that were typed into prompts, the latest last.
    pub entered: Vec<String>,
    /// The line of the moment.
    pub message: Option<Message>,
    /// What the tape is called that was begun last.
    pub tape_name: Option<String>,
    /// Up to when a tape is written, s, while one is.
    pub recorded: Option<f64>,
    /// A line for the shell, on leaving.
    pub parting: Option<String>,
    /// For how long the preset's texts have been read.
    pub(super) reading: ReadingTime,
    /// Characters and colours.
    pub theme: Theme,
    /// Width and height of the screen, cells.
    pub size: (u16, u16),
    pub(super) generation: u64,
    /// The speed that suits the scenes as they were last started.
    fitting: Speed,
    /// The speed before a landing was looked into, while it is.
    looked_into: Option<Speed>,
}

impl Model {
    /// The model of a preset on a screen of that size, and the order that starts it.
    ///
    /// # Errors
    /// When the preset's twin cannot be loaded, in a sentence.
    pub fn new(
        preset: Preset,
        speed: Option<f64>,
        theme: Theme,
        size: (u16, u16),
    ) -> Result<(Model, Order), String> {
        let bench = Bench::new(&preset)?;
        let whole = sweep(bench.scenes(), size, 0.0, 1.0);
        let fitting = pace::first_speed(bench.scenes(), whole.span);
        let speed = speed.map_or(fitting, Speed::nearest);
        let sweep = sweep(bench.scenes(), size, 0.0, speed.over(fitting));
        let model = Model {
            end: 0.0,
            page: Page::new(sweep, bench.scenes()),
            selected: first_row(&bench),
            judged: None,
            origin: Origin::of(&preset),
            preset,
            bench,
            speed,
            paused: false,
            orders: 0,
            held: false,
            shadow: false,
            numbers: Glimpse::default(),
            column: Glimpse::default(),
            overlay: Overlay::None,
            entered: Vec::new(),
            message: None,
            tape_name: None,
            recorded: None,
            parting: None,
            reading: ReadingTime::default(),
            theme,
            size,
            generation: 0,
            fitting,
            looked_into: None,
        };
        let mut model = model;
        let order = model.start(true);
        Ok((model, order))
    }

    /// The order that starts the scenes on the bench from t = 0.
    pub(super) fn start(&mut self, running: bool) -> Order {
        self.generation += 1;
        // What was given up is for the person at the keyboard to ask for again.
        self.shadow &= !self.is_shadow_given_up();
        self.held = false;
        self.paused = !running;
        // A speed that somebody chose stays.
        let whole = sweep(self.bench.scenes(), self.size, 0.0, 1.0);
        let fitting = pace::first_speed(self.bench.scenes(), whole.span);
        self.looked_into = None;
        if self.speed == std::mem::replace(&mut self.fitting, fitting) {
            self.speed = fitting;
        }
        let sweep = sweep(
            self.bench.scenes(),
            self.size,
            0.0,
            self.speed.over(fitting),
        );
        let ghost = self.page.ghost.take();
        self.page = Page::new(sweep, self.bench.scenes()).behind(ghost);
        self.end = 0.0;
        (self.numbers, self.column) = (Glimpse::default(), Glimpse::default());
        Order::Load {
            generation: self.generation,
            scenes: self.bench.scenes().to_vec(),
            sweep,
            speed: self.speed.factor(),
            running,
            shadow: self.shadow,
        }
    }

    /// Puts another preset on the bench; the order that starts it.
    pub(super) fn load(&mut self, preset: Preset) -> Result<Order, String> {
        self.bench = Bench::new(&preset)?;
        self.page.ghost = None;
        self.origin = Origin::of(&preset);
        self.preset = preset;
        self.selected = first_row(&self.bench);
        self.reading = ReadingTime::default();
        self.speed = self.fitting;
        Ok(self.start(true))
    }

    /// Shows a frame. A page of another length begins when the page is turned, or at
    /// once where the present one has become far too long or short.
    pub(super) fn show(&mut self, mut frame: Frame, now: Instant) -> Option<Order> {
        if frame.generation != self.generation {
            return None;
        }
        let still = frame.paused || frame.whole;
        // A frame from before the last order would take that order back on the screen.
        if frame.orders >= self.orders {
            (self.paused, self.held) = (frame.paused, frame.held);
            self.recorded = frame.recorded;
            self.bench.show(&frame.scenes);
        }
        let history = std::mem::replace(&mut frame.history, History::new(1));
        let turned = self.page.take(frame.time, history, frame.whole);
        self.page.align_ghost(self.bench.period());
        self.end = frame.end;
        if !frame.notes.is_empty() {
            let failed = |side: &Side| matches!(side.status, Status::Failed(_));
            let alarm = frame.sides.iter().any(failed);
            self.say_after_echo(frame.notes.join("; "), alarm, now);
        }
        self.expire_message(now);
        let covered = self.message.is_some() || self.held;
        if covered || !matches!(self.overlay, Overlay::None) {
            self.reading.rest();
        } else {
            self.reading.go_on(now);
        }
        self.column.refresh(&frame, self.look(), still, now);
        self.numbers.refresh(&frame, NUMBERS, still, now);
        // On the way to another time no page begins, nor by a frame from before it.
        if frame.towards.is_some() || frame.orders < self.orders {
            return None;
        }
        self.fit_page(turned, false)
    }

    /// Keeps what the page shows behind what follows; whether there was anything.
    pub(super) fn keep_ghost(&mut self) -> bool {
        self.page.keep_ghost(self.bench.period())
    }

    /// How often the beads now are drawn: many large discs less often than small ones, for
    /// the sake of the link.
    fn look(&self) -> Duration {
        let discs = layout::layout(self.size, self.contents()).discs;
        let larger = f64::from(discs.area()) / f64::from(FEW_CELLS);
        COLUMN.mul_f64(larger.sqrt().max(1.0))
    }

    /// The scene to be judged: the soft one where there is one, if it was not asked for.
    pub(super) fn unjudged(&mut self) -> Option<Scene> {
        let scene = &self.bench.scenes()[0];
        if self
            .judged
            .as_ref()
            .is_some_and(|(asked, _)| asked == scene)
        {
            return None;
        }
        self.judged = Some((scene.clone(), None));
        Some(scene.clone())
    }

    /// Takes the verdict on a scene, if that is still asked for.
    pub(super) fn take_verdict(&mut self, (scene, verdict): (Scene, Verdict)) {
        if let Some((asked, judged)) = &mut self.judged
            && *asked == scene
        {
            *judged = Some(verdict);
        }
    }

    /// The verdict on the scene on the bench, when it is there.
    pub fn verdict(&self) -> Option<&Verdict> {
        let (asked, verdict) = self.judged.as_ref()?;
        verdict
            .as_ref()
            .filter(|_| *asked == self.bench.scenes()[0])
    }

    /// Whether a shadow that was asked for has been given up.
    pub(super) fn is_shadow_given_up(&self) -> bool {
        let mut sides = self.numbers.sides.iter();
        sides.any(|side| matches!(side.accuracy, Some(Accuracy::GivenUp(_))))
    }

    /// The name of a column: MD or ED; of a lattice and the column beside it, 2D and 1D.
    pub fn label(&self, index: usize) -> &'static str {
        if self.bench.is_lattice() {
            return if index == 0 { "2D" } else { "1D" };
        }
        match self.bench.scenes().get(index) {
            Some(scene) if !scene.is_md() => "ED",
            _ => "MD",
        }
    }

    /// Whether the screen shows what was, and not what the columns have come to.
    pub fn is_back(&self) -> bool {
        self.page.now < self.end
    }

    /// Whether every floor collision is over.
    pub fn is_over(&self) -> bool {
        let sides = &self.numbers.sides;
        !sides.is_empty() && sides.iter().all(|side| side.status != Status::Running)
    }

    /// Live σ of a column: its mean free flight in contact times; infinite for hard
    /// spheres alone, none before the first flight.
    pub fn sigma(&self, side: &Side) -> Option<f64> {
        side.seen
            .free_flight
            .map(|flight| self.contact_times(flight))
    }

    /// σ of the last landing: mean separation over speed at arrival, over t_c.
    pub fn landing(&self, side: &Side) -> Option<f64> {
        side.seen
            .crossing
            .map(|crossing| self.contact_times(crossing))
    }

    /// The lowest σ of the last few landings.
    pub fn densest(&self, side: &Side) -> Option<f64> {
        side.seen
            .densest
            .map(|crossing| self.contact_times(crossing))
    }

    fn contact_times(&self, time: f64) -> f64 {
        self.bench
            .contact_time()
            .map_or(f64::INFINITY, |contact_time| time / contact_time)
    }
}

impl Glimpse {
    fn refresh(&mut self, frame: &Frame, every: Duration, at_once: bool, now: Instant) {
        let due = self
            .taken
            .is_none_or(|taken| now.duration_since(taken) >= every);
        if due || at_once {
            self.sides.clone_from(&frame.sides);
            self.time = frame.time;
            self.achieved = frame.achieved;
            self.taken = Some(now);
        }
    }
}
