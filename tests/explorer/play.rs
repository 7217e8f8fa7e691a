//! What tests of the explorer share: the real loop on a screen in memory, keys
//! typed by a script, and engines that misbehave on purpose.

use std::cell::Cell;
use std::ops::ControlFlow;
use std::sync::Arc;
use std::thread;
use std::time::{Duration, Instant};

use beadlab::live::{self, Build, Frame, Live, Order, Sampling};
use beadlab::physics::{self, Engine, EngineError, Handover, Observation, Outcome, State};
use beadlab::scene::{Preset, Scene};
use beadlab::study::verdict::verdict;
use beadlab::tui::event_loop::{Ending, EventLoop, Stage, Wires};
use beadlab::tui::input::Heard;
use beadlab::tui::judge::Judge;
use beadlab::tui::link::Link;
use beadlab::tui::model::Model;
use beadlab::tui::outbox::{Outbox, StatusRequest};
use beadlab::tui::theme::Theme;
use beadlab::tui::update::NewFile;
use crossbeam_channel::{Sender, bounded, never, unbounded};
use crossterm::event::{Event, KeyCode, KeyEvent, KeyModifiers};
use ratatui::Terminal;
use ratatui::backend::TestBackend;

use crate::screen::{Screen, Shown};

pub const COLOURS: Theme = Theme {
    ascii: false,
    colour: true,
};
pub const ASCII: Theme = Theme {
    ascii: true,
    colour: false,
};

/// Memory for what was, bytes.
pub const MEMORY: usize = 64 << 20;

/// Nothing here takes so long.
const LONG: Duration = Duration::from_secs(20);

/// A terminal that needs no manners.
pub struct NoStage;

impl Stage for NoStage {
    fn can_be_continued(&self) -> bool {
        true
    }
    fn stop_job(&mut self) {}
    fn leave_screen(&mut self) {}
    fn stop(&mut self) {}
    fn resume(&mut self) {}
    fn copy(&mut self, _: &str) {}
    fn open_tape(&mut self, stem: &str) -> Result<(String, live::Recording), String> {
        Ok((
            stem.to_owned(),
            live::Recording::new(Box::new(std::io::sink())),
        ))
    }
    fn keep(&mut self, stem: &str, files: &[NewFile]) -> Result<Vec<String>, String> {
        let name = |file: &NewFile| format!("{stem}.{}", file.ending);
        Ok(files.iter().map(name).collect())
    }
}

/// What a script does.
pub enum Act {
    Key(KeyCode),
    /// Waits until all of this stands on the screen.
    See(&'static [&'static str]),
    /// Waits until the screen is so.
    Until(fn(&str) -> bool),
    /// Waits for so many frames, for what shows nothing that could be waited for.
    Frames(u32),
    Resize(u16, u16),
}

/// Types a text; a line end is the enter key.
pub fn type_text(text: &str) -> Vec<Act> {
    let key = |c| match c {
        '\n' => KeyCode::Enter,
        c => KeyCode::Char(c),
    };
    text.chars().map(|c| Act::Key(key(c))).collect()
}

pub fn preset(name: &str) -> Preset {
    Preset::load(name).expect("the preset is embedded")
}

pub fn real() -> Build {
    Box::new(physics::build)
}

/// Runs the real loop on a screen of that size, types the script and quits; what
/// the screen shows at the end, row by row.
pub fn play(
    name: &str,
    theme: Theme,
    size: (u16, u16),
    build: Build,
    script: Vec<Act>,
) -> Vec<String> {
    play_preset(preset(name), theme, size, build, script)
}

/// The same with a preset of the test's own.
pub fn play_preset(
    preset: Preset,
    theme: Theme,
    size: (u16, u16),
    build: Build,
    script: Vec<Act>,
) -> Vec<String> {
    let (mut model, start) =
        Model::new(preset, None, theme, size).expect("the preset has its twin");
    let live = live::spawn(build, MEMORY).expect("threads are to be had");
    live.orders
        .send(start)
        .expect("the simulation thread listens");
    let (keys, input) = unbounded();
    let (_keep, signals) = bounded(1);
    let (screen, shown) = Screen::new(TestBackend::new(size.0, size.1));
    let mut terminal = Terminal::new(screen).expect("memory is to be had");
    let (outbox, _) = Outbox::new(StatusRequest::Plain);
    let mut link = Link::new(outbox, Instant::now());
    let wires = Wires {
        heard: Heard {
            events: input,
            receipts: never(),
            leave: never(),
        },
        signals,
        live,
        judge: eager_judge(),
    };
    let last = shown.clone();
    let typist = thread::spawn(move || run_script(&keys, &shown, script));
    let ended = EventLoop {
        terminal: &mut terminal,
        model: &mut model,
        wires: &wires,
        link: &mut link,
        stage: &mut NoStage,
        pending: std::collections::VecDeque::new(),
    }
    .run()
    .expect("a screen in memory can be drawn to");
    typist.join().expect("the typist does not panic");
    assert_eq!(ended, Ending::Quit);
    last.rows()
}

/// A judge that does not rest: nobody looks at the columns meanwhile.
fn eager_judge() -> Judge {
    let (scenes, inbox) = unbounded::<Scene>();
    let (outlet, verdicts) = unbounded();
    thread::spawn(move || {
        while let Ok(scene) = inbox.recv() {
            let scene = inbox.try_iter().last().unwrap_or(scene);
            let mut newer = |_: f64| {
                if inbox.is_empty() {
                    ControlFlow::Continue(())
                } else {
                    ControlFlow::Break(())
                }
            };
            if let Ok(judged) = verdict(&scene, &mut newer)
                && outlet.send((scene, judged)).is_err()
            {
                return;
            }
        }
    });
    Judge { scenes, verdicts }
}

fn run_script(keys: &Sender<Event>, shown: &Shown, script: Vec<Act>) {
    let press = |code| {
        keys.send(Event::Key(KeyEvent::new(code, KeyModifiers::NONE)))
            .expect("the loop listens");
    };
    for act in script {
        match act {
            Act::Key(code) => press(code),
            Act::See(words) => shown.wait(|screen| words.iter().all(|word| screen.contains(word))),
            Act::Until(is_so) => shown.wait(is_so),
            Act::Frames(count) => shown.wait_for_frames(count),
            Act::Resize(width, height) => keys
                .send(Event::Resize(width, height))
                .expect("the loop listens"),
        }
    }
    // Ctrl-C leaves from everywhere. One frame may have been on its way before the last act.
    shown.wait_for_frames(2);
    let quit = KeyEvent::new(KeyCode::Char('c'), KeyModifiers::CONTROL);
    keys.send(Event::Key(quit)).expect("the loop listens");
}

/// How an engine misbehaves, at a simulated time.
#[derive(Debug, Clone, Copy)]
pub enum Fault {
    Panics,
    Errs,
}

/// What stands in for a real engine's advance to a time; None: the real one.
pub type StandIn = Arc<dyn Fn(f64) -> Option<Result<Outcome, EngineError>> + Send + Sync>;

/// A real engine, but for its advance.
#[derive(Clone)]
pub struct Behind {
    pub engine: Box<dyn Engine>,
    pub advance: StandIn,
}

impl Engine for Behind {
    fn time(&self) -> f64 {
        self.engine.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        (self.advance)(until).unwrap_or_else(|| self.engine.advance(until, budget))
    }

    fn is_over(&self) -> bool {
        self.engine.is_over()
    }

    fn next_event(&self) -> Option<f64> {
        self.engine.next_event()
    }

    fn observe(&self, into: &mut Observation) {
        self.engine.observe(into);
    }

    fn state(&self) -> State {
        self.engine.state()
    }
}

/// Builds real engines, but soft-contact ones misbehave from `at` on.
pub fn faulty(fault: Fault, at: f64) -> Build {
    let misbehave = move |until: f64| match fault {
        _ if until < at => None,
        Fault::Panics => panic!("a bead escaped"),
        Fault::Errs => Some(Err(EngineError::Unstable {
            time: until,
            steps_per_contact: 2.0,
        })),
    };
    Box::new(
        move |scene: &Scene, from: Option<&State>| -> (Box<dyn Engine>, Handover) {
            let (engine, handover) = physics::build(scene, from);
            if !scene.is_md() {
                return (engine, handover);
            }
            let advance = Arc::new(misbehave);
            (Box::new(Behind { engine, advance }), handover)
        },
    )
}

/// A preset and its hard twin.
pub fn twins(name: &str) -> Vec<Scene> {
    let soft = preset(name).scene;
    let hard = soft
        .with_method(beadlab::scene::MethodName::Ed)
        .expect("every scene can be hard");
    vec![soft, hard]
}

pub fn sweep(span: f64, hold: bool) -> Sampling {
    Sampling {
        origin: 0.0,
        span,
        columns: 60,
        hold,
    }
}

pub fn load(live: &Live, scenes: Vec<Scene>, sweep: Sampling, speed: f64, running: bool) {
    let order = Order::Load {
        generation: 1,
        scenes,
        sweep,
        speed,
        running,
        shadow: false,
    };
    live.orders
        .send(order)
        .expect("the simulation thread listens");
}

/// The first frame that is as wanted.
pub fn until(live: &Live, wanted: impl Fn(&Frame) -> bool) -> Frame {
    let start = Instant::now();
    while start.elapsed() < LONG {
        let frame = live.frames.recv_timeout(LONG).expect("frames come");
        if wanted(&frame) {
            return frame;
        }
    }
    panic!("no such frame in {LONG:?}");
}

/// The simulation thread, and how many orders it was given.
pub struct Session {
    pub thread: Live,
    given: Cell<u64>,
}

impl Session {
    /// One that stands still at t = 0, with that page and memory.
    pub fn paused(scenes: Vec<Scene>, sweep: Sampling, memory: usize) -> Session {
        let thread = live::spawn(real(), memory).expect("threads are to be had");
        load(&thread, scenes, sweep, 0.1, false);
        until(&thread, |frame| frame.orders == 1);
        let given = Cell::new(1);
        Session { thread, given }
    }

    /// Gives an order.
    pub fn tell(&self, order: Order) {
        self.given.set(self.given.get() + 1);
        self.thread.orders.send(order).expect("the thread listens");
    }

    /// Gives an order, and waits for the frame that it comes to.
    pub fn ask(&self, order: Order) -> Frame {
        self.tell(order);
        until(&self.thread, |frame| {
            frame.orders == self.given.get() && frame.towards.is_none()
        })
    }
}
