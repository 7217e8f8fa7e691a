//! The whole state of a column, and how it passes from one engine to another.

use super::bounce::Bounce;
use super::contacts::ContactLog;
use super::course::{Course, Turn};
use super::ledger::Ledger;
use super::matter::BeadColumn;
use super::observation::Observation;
use super::plate::Plate;
use super::spring::Spring;
use crate::scene::{Floor, Scene, Start, initial_gaps};

/// What a run keeps account of, whatever moves it.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Books {
    pub contacts: ContactLog,
    pub ledger: Ledger,
    pub bounce: Bounce,
    /// The deepest overlap that was seen, m.
    pub deepest: f64,
    pub steps: u64,
    pub events: u64,
    /// Collapses of hard beads that were closed.
    pub closed: u64,
    /// Whether the floor collision is over; who goes on from a state finds that out anew.
    pub over: bool,
}

/// How far hard beads follow a collapse before they close it.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(crate) enum Depth {
    /// As far as there are digits for it.
    #[default]
    Full,
    /// Half as far: what this changes of the results nobody can know.
    Half,
}

impl Depth {
    /// How far to go, of what full depth is: powers of two, or collisions.
    pub fn of(self, full: i32) -> i32 {
        match self {
            Self::Full => full,
            Self::Half => full / 2,
        }
    }
}

impl Books {
    /// Fills in what the books know at `time`, s, on a floor of that period, s. The energies
    /// are there already.
    pub fn observe(&self, time: f64, period: f64, into: &mut Observation) {
        into.free_flight = self.contacts.free_flight(time);
        into.settled_flight = self.contacts.settled_flight();
        into.deepest = self.deepest;
        into.bounce = self.bounce.restitution(into.energy.relative);
        into.crossing = self.bounce.crossing();
        into.densest = self.bounce.densest(time, period);
        into.landings = self.bounce.arrivals();
        into.changes = self.contacts.changes() + self.events;
        (into.floor_touched, into.floor_left) = self.contacts.floor();
        (into.steps, into.events, into.closed) = (self.steps, self.events, self.closed);
    }

    /// Sees how deep the contacts of some gaps are.
    pub fn measure(&mut self, gaps: impl Iterator<Item = f64>) {
        self.deepest = gaps.fold(self.deepest, |deepest, g| deepest.max(-g));
    }
}

/// The whole state of a column or a lattice.
#[derive(Debug, Clone, PartialEq)]
pub struct State {
    /// Simulated time, s.
    pub time: f64,
    /// Gaps, m; index 0 is between floor and bead 1. Of a lattice the displacements of
    /// its beads from their sites: all across, then all up.
    pub gaps: Vec<f64>,
    /// Rates of those, m/s.
    pub rates: Vec<f64>,
    pub(crate) plate: Plate,
    /// How the plate is going to move.
    pub(crate) course: Course,
    /// Up to when its motion is settled, s, whatever is edited.
    pub(crate) settled: f64,
    pub(crate) books: Books,
    /// How far hard beads follow a collapse before they close it.
    pub(crate) closing: Depth,
    /// Springs of the engine that left this state; none of hard beads.
    pub(crate) springs: Vec<Spring>,
    /// Of a lattice the pairs whose contacts the log has, after the floor's.
    pub(crate) bonds: Vec<[u32; 2]>,
}

/// What had to be resolved to go on from the state of another engine.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Handover {
    /// Overlaps that hard beads cannot have, set to zero.
    pub overlaps_removed: usize,
    /// The deepest of them, m.
    pub deepest: f64,
    /// Contacts that were given the overlap that carries their load.
    pub overlaps_loaded: usize,
    /// How long until an edit of the plate's motion begins to act, s, if there was one.
    pub plate_waits: Option<f64>,
}

impl Handover {
    /// One sentence for the screen on the contacts, if there is anything to say.
    pub fn describe(&self) -> Option<String> {
        let plural = |count: usize| if count == 1 { "" } else { "s" };
        if self.overlaps_removed > 0 {
            let Self {
                overlaps_removed: count,
                deepest,
                ..
            } = self;
            Some(format!(
                "{count} overlap{} removed for hard spheres (deepest {deepest:.1e} m); their elastic energy is gone",
                plural(*count)
            ))
        } else if self.overlaps_loaded > 0 {
            let count = self.overlaps_loaded;
            Some(format!(
                "{count} resting contact{} given the overlap that carries its load",
                plural(count)
            ))
        } else {
            None
        }
    }

    /// The same on the plate, on which all columns stand.
    pub fn describe_plate(&self) -> Option<&'static str> {
        self.plate_waits
            .map(|_| "acts from when the plate next passes its middle, over about a period")
    }
}

impl State {
    /// The start of a scene. Contacts that just touch are closed.
    pub fn initial(scene: &Scene) -> Self {
        let gaps = initial_gaps(scene);
        let velocity = scene.launch().map_or(0.0, |launch| launch.v0);
        if let Some(sites) = scene.sites() {
            let rates = [vec![0.0; scene.n], vec![velocity; scene.n]].concat();
            // The floor is the first contact of the log; pairs join when they touch.
            return Self::at_start(scene, sites.shifts(scene), rates, vec![false]);
        }
        let mut rates = vec![0.0; scene.n];
        let plate = Plate::of(scene);
        // A resting column moves with the plate; a launched one has v₀ in the laboratory.
        if scene.launch().is_some() {
            rates[0] = velocity - plate.velocity();
        }
        let closed = gaps.iter().map(|&g| g <= 0.0).collect();
        let mut state = Self::at_start(scene, gaps, rates, closed);
        if scene.start == Start::Resting {
            state.load_resting_contacts(scene);
        }
        state
    }

    /// The state at t = 0; `closed` tells which contacts are closed.
    fn at_start(scene: &Scene, gaps: Vec<f64>, rates: Vec<f64>, closed: Vec<bool>) -> Self {
        Self {
            time: 0.0,
            gaps,
            rates,
            plate: Plate::of(scene),
            course: Course::default(),
            settled: 0.0,
            books: Books {
                contacts: ContactLog::new(closed, 0.0, scene.period()),
                ledger: Ledger::default(),
                bounce: Bounce::default(),
                deepest: 0.0,
                steps: 0,
                events: 0,
                closed: 0,
                over: false,
            },
            closing: Depth::default(),
            springs: Vec::new(),
            bonds: Vec::new(),
        }
    }

    /// Lets edits change nothing of the plate's motion up to `time`, s. Columns on one clock
    /// stand on one plate, but may have come to different times, of which this is the latest.
    pub fn settle(&mut self, time: f64) {
        self.settled = self.settled.max(time);
    }

    /// The same state under the facts of another scene of as many beads on the same kind
    /// of floor: beads and plate keep their places and velocities, only overlaps are made
    /// to fit the law. Another motion of the plate begins when it next passes its middle.
    pub(crate) fn adopt(&self, scene: &Scene) -> (Self, Handover) {
        let directions = if scene.sites().is_some() { 2 } else { 1 };
        assert_eq!(
            self.gaps.len(),
            directions * scene.n,
            "a state goes on with the column it is of"
        );
        assert_eq!(
            self.plate.omega == 0.0,
            scene.floor == Floor::Fixed,
            "a state goes on with the kind of floor it is on"
        );
        let mut state = self.clone();
        if scene.sites().is_some() {
            // Beads of a plane share their overlaps: none can be changed by itself.
            return (state, Handover::default());
        }
        state.books.contacts.set_period(scene.period());
        let mut handover = Handover::default();
        if scene.floor != Floor::Fixed {
            let after = self.settled.max(self.time);
            let begins = state.course.lead(self.plate, Plate::of(scene), after);
            handover.plate_waits = begins.map(|time| time - after);
        }
        match scene.law() {
            Some(_) if self.springs.is_empty() => {
                handover.overlaps_loaded = state.load_resting_contacts(scene);
            }
            Some(_) => {
                let new = BeadColumn::of(scene).springs;
                for ((g, old), new) in state.gaps.iter_mut().zip(&self.springs).zip(&new) {
                    if *g < 0.0 {
                        *g = -new.takes_over(old, -*g);
                    }
                }
            }
            None => {
                for g in state.gaps.iter_mut().filter(|g| **g < 0.0) {
                    handover.overlaps_removed += 1;
                    handover.deepest = handover.deepest.max(-*g);
                    *g = 0.0;
                }
            }
        }
        (state, handover)
    }

    /// The same state as the plate takes a turn, which it has come to.
    pub(crate) fn turned(mut self, turn: Turn, scene: &Scene) -> Self {
        if scene.grid().is_some() {
            // The last grid point lies up to a step before the turn. The plate moves in its new
            // way from that point on; the beads stay where they are.
            let plate = turn.plate.later(self.time - turn.time);
            self.gaps[0] += self.plate.position() - plate.position();
            self.rates[0] += self.plate.velocity() - plate.velocity();
            self.plate = plate;
        } else {
            (self.time, self.plate) = (turn.time, turn.plate);
        }
        self
    }

    /// Gives the soft contacts of beads that rest on the floor the overlap that
    /// carries their load; how many they are.
    fn load_resting_contacts(&mut self, scene: &Scene) -> usize {
        let Some(gravity) = scene.gravity.filter(|_| scene.is_md()) else {
            return 0;
        };
        let pull = gravity + self.plate.acceleration();
        let resting = self
            .gaps
            .iter()
            .zip(&self.rates)
            .take_while(|(g, w)| **g <= 0.0 && **w == 0.0)
            .count();
        if pull <= 0.0 {
            return 0;
        }
        BeadColumn::of(scene).rest(&mut self.gaps[..resting], pull);
        resting
    }
}
