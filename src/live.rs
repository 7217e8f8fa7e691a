//! The simulation thread and its channels.
//!
//! One thread owns the engines: a column and, where there is one, its twin, on one
//! clock. [`Order`]s reach it over a bounded channel and are never dropped; while
//! it is paused it blocks on that channel. [`Frame`]s leave through a slot that
//! holds the newest one only, so neither side ever waits for the other; the trace
//! samples of a frame that nobody fetched travel in the next one. An engine that
//! fails or panics becomes a [`Status::Failed`], and its twin goes on. When asked, a
//! run that is exact goes on in the shadow of each soft column, in the time that the
//! columns leave, and tells their [`Accuracy`].

mod clock;
mod history;
mod past;
mod recording;
mod runner;
mod sampling;
mod shadow;
mod slot;
mod worker;

pub use history::{ColumnSample, History, Sample, stride};
pub use recording::Recording;
pub use runner::Build;
pub use sampling::Sampling;
pub use shadow::{Accuracy, Distance, reference};

use std::sync::Arc;
use std::thread;

use crossbeam_channel::{Receiver, Sender, bounded};

use crate::physics::Observation;
use crate::scene::Scene;
use crate::tape::Tape;

/// Orders waiting for the simulation thread; when so many wait, the sender waits.
const ORDERS: usize = 64;

/// What the screen asks of the simulation thread.
#[derive(Debug, Clone)]
pub enum Order {
    /// Start these columns from t = 0.
    Load {
        /// Number of this start; frames carry it.
        generation: u64,
        /// One column, or two on one clock.
        scenes: Vec<Scene>,
        /// When to sample the traces.
        sweep: Sampling,
        /// Simulated seconds in a second.
        speed: f64,
        /// Whether to run at once.
        running: bool,
        /// Whether exact runs go on in the shadow of soft columns.
        shadow: bool,
    },
    /// Go on with other scenes from the state in force.
    Edit {
        /// One column, or two on one clock.
        scenes: Vec<Scene>,
        /// For each of them, which of the present columns it goes on from.
        from: Vec<usize>,
    },
    /// Write a tape of the session there, or end the one that is written.
    Record(Option<Recording>),
    /// Play a tape from its start.
    Play(Arc<Tape>),
    /// Run (true) or pause.
    Run(bool),
    /// Simulated seconds in a second.
    Speed(f64),
    /// Let exact runs start in the shadow of soft columns, from their present state
    /// (true), or end.
    Shadow(bool),
    /// Sample the traces at other times.
    Sampling(Sampling),
    /// Pause, and go to another time.
    Leap(Leap),
    /// Go to just before the next landing, and on from there.
    LookInto {
        /// Simulated seconds in a second.
        speed: f64,
        /// How long before it, s.
        lead: f64,
    },
}

/// Back in what was, or on.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Way {
    /// To earlier times.
    Back,
    /// To later ones.
    On,
}

/// Where to in time.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Leap {
    /// By this many simulated seconds, back where it is negative.
    By(f64),
    /// To where a contact begins or ends, or hard beads collide.
    Change(Way),
    /// To where a column lands on its floor.
    Landing(Way),
    /// By a period of the plate.
    Period(Way),
    /// To this time, s.
    To(f64),
    /// To where the columns have come to.
    End,
}

/// How a column fares.
#[derive(Debug, Clone, PartialEq)]
pub enum Status {
    /// It moves.
    Running,
    /// It moves, and its floor collision is over.
    Over,
    /// Its engine stopped, and why.
    Failed(String),
}

/// One column as seen at the moment of a frame.
#[derive(Debug, Clone)]
pub struct Side {
    /// What can be seen of it.
    pub seen: Observation,
    /// How it fares.
    pub status: Status,
    /// Its error, while there is a run in its shadow.
    pub accuracy: Option<Accuracy>,
}

/// What the simulation thread shows of itself.
#[derive(Debug, Clone)]
pub struct Frame {
    /// The start that this frame belongs to.
    pub generation: u64,
    /// Simulated time, s.
    pub time: f64,
    /// The columns, in the order of their scenes.
    pub sides: Vec<Side>,
    /// What they are of, edits in force then included.
    pub scenes: Vec<Scene>,
    /// Simulated time up to which they have come, s; later than `time` while that is gone
    /// back in.
    pub end: f64,
    /// Up to when a tape is written, s, while one is.
    pub recorded: Option<f64>,
    /// Trace samples since the last frame that was fetched.
    pub history: History,
    /// Whether these are all samples of the page, in place of those before.
    pub whole: bool,
    /// A time that was asked for, s, while the columns are on their way to it.
    pub towards: Option<f64>,
    /// Sentences for the screen since the last frame that was fetched.
    pub notes: Vec<String>,
    /// Whether simulated time stands still.
    pub paused: bool,
    /// Whether it stands still by itself, its page being full.
    pub held: bool,
    /// Orders carried out so far.
    pub orders: u64,
    /// Simulated seconds in a second that were reached lately.
    pub achieved: Option<f64>,
}

/// The ends of the channels that the screen holds. Dropping `orders` ends the thread.
#[derive(Debug)]
pub struct Live {
    /// Orders to the simulation thread.
    pub orders: Sender<Order>,
    /// Its newest frame.
    pub frames: Receiver<Frame>,
}

/// Starts the simulation thread. It builds its engines by `build`, keeps so many bytes of
/// what was to go back to, and waits for its first [`Order::Load`].
///
/// # Errors
/// When the system refuses the thread.
pub fn spawn(build: Build, memory: usize) -> std::io::Result<Live> {
    let (orders, inbox) = bounded(ORDERS);
    let (outlet, frames) = slot::slot();
    thread::Builder::new()
        .name("simulation".into())
        .spawn(move || worker::Worker::new(build, outlet, memory).run(&inbox))?;
    Ok(Live { orders, frames })
}
