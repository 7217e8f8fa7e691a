//! Soft contacts to rounding: contact changes are located, and between them the column
//! is propagated as what it is, a linear system.
//!
//! Every gap keeps its value and rate at a time of its own, as in the event-driven
//! engine. Gaps that feel a force (pushing contacts and the gaps beside them) form
//! clusters, which move independently of each other; a cluster costs one Taylor series
//! per step of about half a contact time, or to its next contact change. Gaps outside
//! clusters are in free flight and cost nothing until they close.

mod centre;
mod cluster;
mod crossing;
mod encounter;
mod landing;
mod pair;
mod passage;
mod repose;
mod rest;
mod series;
mod upkeep;

use super::column::{masses, springs};
use super::flight::{Free, Gap, Ground, Shaken, Weight};
use super::ledger::{Ledger, Sum};
use super::moment::Moment;
use super::observation::Observation;
use super::power_law::Spring;
use super::state::{Books, State, weight};
use super::tournament::Tournament;
use super::{Engine, EngineError, Outcome};
use crate::math;
use crate::scene::{Floor, Scene};
use centre::Centre;
use cluster::Plan;
use crossing::ROWS;
use encounter::Encounter;
use landing::Landing;
use repose::Repose;
use series::Coupling;

/// Contact times in a tick of the epoch. What is known of a time is a bit of its distance
/// from the epoch, and of a flight through a gap a bit of its length: ticks are short, so
/// that clocks lose no more than gaps do.
const TICK: f64 = 2.0;
/// Beads per event at which the epoch may move, since that costs O(N): in a long column
/// as many events lie in a flight through a gap.
const BEADS_AN_EVENT: usize = 4;
/// Places behind the last gap: whole lanes, and the forces at both ends.
const PADDING: usize = 6;
/// Events between two looks whether creeping contacts have spent all energy.
const INSPECTION: u64 = 256;

/// Builds the engine of a scene with the exact solver.
pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let plate = state.plate;
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), plate);
            Box::new(Exact::new(scene, state, ground))
        }
        (Floor::Fixed, Some(gravity)) => {
            let ground = Weight::new(gravity, plate, scene.diameter);
            Box::new(Exact::new(scene, state, ground))
        }
        (Floor::Fixed, None) => Box::new(Exact::new(scene, state, Free { plate })),
    }
}

/// What a gap does.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Mode {
    /// It is open.
    Open,
    /// It is a contact, and its force acts.
    Pushing,
    /// It is a contact whose attraction is cut off.
    Idle,
}

/// A soft column, exactly.
struct Exact<G> {
    ground: G,
    masses: Vec<f64>,
    /// 1/m of each bead.
    inverse: Vec<f64>,
    springs: Vec<Spring>,
    /// How each contact goes when nothing else touches its beads.
    encounters: Vec<Option<Encounter>>,
    /// The contact of bead 1 alone with the floor, under gravity.
    landing: Option<Landing>,
    attraction: bool,
    gravity: f64,
    /// The most that a free lowest gap can accelerate towards the floor, m/s².
    pull: f64,
    gaps: Vec<Gap>,
    modes: Vec<Mode>,
    /// The first gap of the cluster that each gap is in; itself in flight.
    first: Vec<usize>,
    /// One past the last gap of the cluster that starts at each gap.
    end: Vec<usize>,
    /// How the cluster that starts at each gap moves.
    plans: Vec<Plan>,
    /// Taylor coefficients, in the space of each cluster's gaps.
    coefficients: Vec<f64>,
    coupling: Coupling,
    /// Room to work in.
    room: Room,
    /// When the plan of each cluster ends, at the cluster's first gap.
    queue: Tournament,
    /// Time of the epoch: `origin`, s, and `ticks` ticks of `tick` s, a power of two.
    origin: f64,
    ticks: f64,
    tick: f64,
    /// Now, s from the epoch.
    now: f64,
    repose: Repose,
    centre: Centre,
    /// Events since the epoch was moved.
    since: usize,
    /// Energy at the start or after an edit, m²/s²; without gravity it only falls.
    energy_at_first: f64,
    /// Contact changes, and steps, after which it is looked whether the collision is over.
    check_at: (u64, u64),
    /// Changes in a row that took no time.
    instant: usize,
    over: bool,
    state: State,
}

/// Rows to work in, as long as the longest cluster, padded.
#[derive(Debug, Default)]
struct Room {
    a: Vec<f64>,
    b: Vec<f64>,
    sign: Vec<f64>,
    /// As long as that cluster's series.
    series: Vec<f64>,
}

impl Room {
    fn of(n: usize) -> Self {
        Self {
            a: vec![0.0; n + PADDING],
            b: vec![0.0; n + PADDING],
            sign: Vec::with_capacity(n + PADDING),
            series: vec![0.0; ROWS * (n + PADDING)],
        }
    }
}

impl<G: Ground> Exact<G> {
    fn new(scene: &Scene, state: State, ground: G) -> Self {
        let (Some(soft), Some(contact_time)) = (scene.soft(), scene.contact_time()) else {
            unreachable!("physics::build hands scenes of soft contacts to this room");
        };
        let n = scene.n;
        let masses = masses(scene);
        let springs = springs(scene, &masses);
        let shake = state.plate.amplitude * math::powi(state.plate.omega, 2);
        let gap = |(&g, &w): (&f64, &f64)| Gap { g, w, t: 0.0 };
        let mut exact = Self {
            encounters: Encounter::all(&springs, &masses),
            landing: None,
            springs,
            pull: weight(scene) + shake,
            inverse: masses.iter().map(|m| 1.0 / m).collect(),
            attraction: soft.attraction,
            gravity: weight(scene),
            gaps: state.gaps.iter().zip(&state.rates).map(gap).collect(),
            modes: vec![Mode::Open; n],
            first: (0..n).collect(),
            end: (1..=n).collect(),
            plans: vec![Plan::Flight; n],
            // A cluster of one gap, padded to four, is the whole of a single bead.
            coefficients: vec![0.0; ROWS * (2 * n).max(4)],
            coupling: Coupling::default(),
            room: Room::of(n),
            queue: Tournament::new(n),
            origin: state.time,
            ticks: 0.0,
            tick: math::exp2(math::log2(TICK * contact_time).round()),
            now: 0.0,
            repose: Repose::new(),
            centre: Centre::default(),
            since: 0,
            energy_at_first: f64::INFINITY,
            check_at: (0, INSPECTION),
            instant: 0,
            over: false,
            masses,
            ground,
            state,
        };
        exact.begin();
        exact
    }

    /// Finds the contacts, opens the ledger and plans every cluster.
    fn begin(&mut self) {
        let n = self.gaps.len();
        for i in 0..n {
            self.modes[i] = self.mode_of(i);
            let closed = self.modes[i] != Mode::Open;
            self.state.books.contacts.note(i, closed, self.state.time);
        }
        let (gaps, rates) = self.gaps_and_rates(0.0);
        if self.modes[0] != Mode::Open {
            let arrival = self.moment(&gaps, &rates, 0.0).arrival();
            self.state.books.bounce.begin(arrival);
        }
        let energy = self.moment(&gaps, &rates, 0.0).energy();
        self.energy_at_first = energy.kinetic + energy.elastic;
        let error = self.state.ledger_error;
        self.state.books.ledger.open(energy, error);
        self.regroup(0, n, 0.0);
        self.centre = self.weighed(Sum::default());
    }

    /// What a gap does by its place and rate. Beads just touching are in contact.
    fn mode_of(&self, i: usize) -> Mode {
        let Gap { g, w, .. } = self.gaps[i];
        let spring = self.springs[i];
        match () {
            () if g > 0.0 => Mode::Open,
            () if self.attraction || spring.stiffness * g + spring.dashpot * w <= 0.0 => {
                Mode::Pushing
            }
            () => Mode::Idle,
        }
    }

    /// Simulated time of `t`, s.
    fn absolute(&self, t: f64) -> f64 {
        self.origin + (self.ticks * self.tick + t)
    }

    fn moment<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64], t: f64) -> Moment<'a> {
        Moment {
            time: self.absolute(t),
            gaps,
            rates,
            plate: self.ground.plate(t),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.springs,
        }
    }

    /// Moves the epoch to the last tick before now, so that times keep their digits.
    fn move_epoch(&mut self) {
        if self.now < self.tick || BEADS_AN_EVENT * self.since < self.gaps.len() {
            return;
        }
        self.since = 0;
        let ticks = (self.now / self.tick).floor();
        let shift = ticks * self.tick;
        self.ticks += ticks;
        self.now -= shift;
        for gap in &mut self.gaps {
            gap.t -= shift;
        }
        self.queue.shift(shift);
        self.ground
            .set_plate(self.state.plate.later(self.ticks * self.tick));
        self.shift_centre(shift);
    }

    /// Carries out what the cluster that starts at `i` has planned, at `t`.
    fn carry_out(&mut self, i: usize, t: f64) -> Result<(), EngineError> {
        self.since += 1;
        let taken = t - self.gaps[i].t;
        self.instant = if taken > 0.0 { 0 } else { self.instant + 1 };
        let done = match self.plans[i] {
            Plan::Flight => self.pair_meets(i, t),
            Plan::Encounter(contact) => self.pair_parts(i, contact, t),
            _ => false,
        };
        if done {
            return Ok(());
        }
        let end = self.end[i];
        let change = self.finish(i, t);
        if let Some((gap, mode)) = change {
            self.change(gap, mode, t);
        }
        let what = match () {
            () if !self.gaps[i].w.is_finite() => "a relative velocity is not finite",
            () if self.instant > 1000 + 20 * self.gaps.len() => {
                "contacts open and close without end at one instant"
            }
            () => {
                self.regroup(i, end, t);
                return Ok(());
            }
        };
        Err(EngineError::Lost {
            time: self.absolute(t),
            bead: i + 1,
            what,
        })
    }

    /// What is accounted for, up to now.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        let mut room = Room::of(self.gaps.len());
        let mut i = 0;
        while i < self.gaps.len() {
            self.account(i, self.now, &mut ledger, &mut room);
            i = self.end[i];
        }
        ledger
    }
}

impl<G: Ground> Engine for Exact<G> {
    fn time(&self) -> f64 {
        self.absolute(self.now)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let mut left = budget;
        loop {
            let (i, t) = self.queue.first();
            // As `next_event` says it, so that advancing to there includes the event.
            if self.absolute(t) > until || t.is_infinite() {
                // Not past the next event, which rounding could do.
                let end = ((until - self.origin) - self.ticks * self.tick).min(t);
                self.now = self.now.max(end);
                self.over |= !G::PULLS && t.is_infinite();
                return Ok(if self.over {
                    Outcome::Over
                } else {
                    Outcome::Reached
                });
            }
            if left == 0 {
                return Ok(Outcome::OutOfBudget);
            }
            left -= 1;
            // An observation may have moved `now` on, but never past this.
            self.now = self.now.max(t);
            self.carry_out(i, self.now)?;
            self.look_whether_over();
            self.move_epoch();
        }
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn next_event(&self) -> Option<f64> {
        let (_, t) = self.queue.first();
        t.is_finite().then(|| self.absolute(t))
    }

    fn observe(&self, into: &mut Observation) {
        let (gaps, rates) = self.gaps_and_rates(self.now);
        self.moment(&gaps, &rates, self.now)
            .observe(&self.state.books, self.ledger(), into);
        into.integrals = self.integrals();
    }

    fn state(&self) -> State {
        let (gaps, rates) = self.gaps_and_rates(self.now);
        let books = Books {
            ledger: self.ledger(),
            ..self.state.books.clone()
        };
        self.moment(&gaps, &rates, self.now).state(books)
    }
}
