//! What every engine does alike, whatever moves its beads: it starts, is looked at, and hands
//! its state over. This costs something per call, and nothing per step or event.

use super::bounce::Arrival;
use super::course::Course;
use super::ledger::Ledger;
use super::matter::{Matter, Snapshot};
use super::observation::{Energy, Observation};
use super::state::{Books, Depth, State};
use super::{Engine, EngineError, Outcome};

/// What moves beads, and knows how they stand now.
pub(super) trait Mover: Clone + Send + 'static {
    /// What the beads are.
    type Matter: Matter;

    /// Simulated time, s.
    fn time(&self) -> f64;

    /// Moves on as [`Engine::advance`] does; whether it came so far.
    ///
    /// # Errors
    /// [`EngineError`] when it cannot go on.
    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError>;

    /// The time of the next event, s, where it is known.
    fn next_event(&self) -> Option<f64> {
        None
    }

    /// Notes in the books which contacts have begun or ended.
    fn note_contacts(&mut self);

    /// Plans ahead, once: the books are open, and `energy` is what the beads start with.
    fn begin(&mut self, _energy: Energy) {}

    /// The books, as they were last written.
    fn books(&self) -> &Books;

    /// The same, to be written to.
    fn books_mut(&mut self) -> &mut Books;

    /// What the ledger comes to now.
    fn ledger(&self) -> Ledger;

    /// Steps done by now.
    fn steps(&self) -> u64 {
        self.books().steps
    }

    /// The beads now.
    fn now(&self) -> Snapshot;

    /// What they are.
    fn matter(&self) -> &Self::Matter;

    /// Tells the books that the floor's contact has begun or ended, where it has since it
    /// `was_closed`.
    fn note_bounce(&mut self, was_closed: bool) {
        let is_closed = self.books().contacts.closed()[0];
        if is_closed != was_closed {
            let arrival = self.arrival_now();
            self.books_mut().bounce.turn(is_closed, arrival);
        }
    }

    /// Fills in what only this mover knows, or better than the books.
    fn fill_in(&self, _into: &mut Observation) {}

    /// Stored energies now.
    fn energy_now(&self) -> Energy {
        self.matter().energy(&self.now())
    }

    /// The beads as they arrive at their floor now, or leave it.
    fn arrival_now(&self) -> Arrival {
        self.matter().arrival(&self.now())
    }
}

/// A mover as an engine.
#[derive(Clone)]
pub(super) struct Shell<M> {
    mover: M,
}

impl<M: Mover> Shell<M> {
    /// Starts it: finds the contacts and opens the ledger.
    pub fn boxed(mut mover: M) -> Box<dyn Engine> {
        mover.note_contacts();
        if mover.books().contacts.closed()[0] {
            let arrival = mover.arrival_now();
            mover.books_mut().bounce.begin(arrival);
        }
        let energy = mover.energy_now();
        mover.books_mut().ledger.open(energy);
        mover.begin(energy);
        Box::new(Self { mover })
    }
}

impl<M: Mover> Engine for Shell<M> {
    fn time(&self) -> f64 {
        self.mover.time()
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let reached = self.mover.advance(until, budget)?;
        Ok(match (reached, self.is_over()) {
            (false, _) => Outcome::OutOfBudget,
            (true, false) => Outcome::Reached,
            (true, true) => Outcome::Over,
        })
    }

    fn is_over(&self) -> bool {
        self.mover.books().over
    }

    fn next_event(&self) -> Option<f64> {
        self.mover.next_event()
    }

    fn observe(&self, into: &mut Observation) {
        let Self { mover } = self;
        let (now, matter, books) = (mover.now(), mover.matter(), mover.books());
        into.time = now.time;
        into.integrals = None;
        matter.observe(&now, books.contacts.closed(), into);
        into.energy = mover.ledger().closed(matter.energy(&now));
        // The books are looked at often, and not copied for it.
        books.observe(now.time, now.plate.period(), into);
        into.steps = mover.steps();
        mover.fill_in(into);
    }

    fn state(&self) -> State {
        let Self { mover } = self;
        let (now, matter) = (mover.now(), mover.matter());
        let ledger = mover.ledger().handed_over(matter.energy(&now));
        State {
            time: now.time,
            gaps: now.gaps,
            rates: now.rates,
            plate: now.plate,
            course: Course::default(),
            settled: now.time,
            closing: Depth::default(),
            springs: matter.springs(),
            bonds: matter.bonds(),
            books: Books {
                ledger,
                steps: mover.steps(),
                over: false,
                ..mover.books().clone()
            },
        }
    }
}
