//! Hard collisions, event driven (Sec. II B): exact flight from event to event.
//!
//! Every gap keeps its value and rate at a time of its own. Between beads in flight a gap
//! changes linearly. Only one gap feels gravity and the plate: that between the lowest free
//! bead and the floor, or the stack that rides the floor. A collision changes three gaps, so
//! an event costs O(log N).
//!
//! Near inelastic collapse gaps, rates and the times between collisions shrink by hundreds of
//! decades and may grow again. No digit is lost on the way. Times are counted from an epoch
//! that moves on with the collisions (see [`epoch`]). Without gravity lengths and times are
//! kept in units so small that numbers do not underflow (see [`closing`]).

mod cascade;
mod closing;
mod epoch;
mod pair;
mod rule;
mod tally;

use super::column::{masses, much_to_come, nothing_to_come};
use super::flight::{Free, Gap, Ground, Shaken, Weight};
use super::ledger::{Ledger, Sum};
use super::observation::Observation;
use super::snapshot::Snapshot;
use super::state::{Books, State, weight};
use super::tournament::Tournament;
use super::{Engine, EngineError, Outcome};
use crate::scene::{CollisionRule, Floor, Method, Scene};
use closing::Closing;
use pair::{Pair, pairs};
use rule::{Always, LastCollisions, Rule};
use tally::Tally;

/// A floor collision is over when the collisions to come can change the kinetic energy by
/// this part of itself at most. No digit of a double shows it.
const OVER: f64 = 1e-32;

/// Builds the engine of an ED scene.
pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let plate = state.plate;
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating(_), gravity) => {
            with_rule(scene, state, Shaken::new(gravity.unwrap_or(0.0), plate))
        }
        (Floor::Fixed, Some(gravity)) => {
            with_rule(scene, state, Weight::new(gravity, plate, scene.diameter))
        }
        (Floor::Fixed, None) => with_rule(scene, state, Free { plate }),
    }
}

fn with_rule<G: Ground + 'static>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine> {
    match scene.method {
        Method::Hard(CollisionRule::Tc { contact_time }) => {
            let contact_time = contact_time * Closing::scale(scene, &state);
            let rule = LastCollisions::new(scene.n, contact_time);
            Box::new(Ed::new(scene, state, ground, rule))
        }
        _ => Box::new(Ed::new(scene, state, ground, Always)),
    }
}

/// A hard column. Its gaps and times are kept in units of 1/`scale` m and s.
#[derive(Clone)]
struct Ed<G, R> {
    ground: G,
    rule: R,
    masses: Vec<f64>,
    pairs: Vec<Pair>,
    gravity: f64,
    gaps: Vec<Gap>,
    /// How many beads rest on the floor and move with it.
    stack: usize,
    /// When each gap closes; then the stack's take-off, then the epoch's next move.
    queue: Tournament,
    /// Rates of touching gaps during a cascade.
    approach: Tournament,
    /// Which cascade a gap last collided in.
    collided: Vec<u64>,
    cascades: u64,
    /// Units of length in 1 m, and of time in 1 s: a power of two. It is 1 under gravity,
    /// which sets a scale of its own.
    scale: f64,
    /// Simulated time at which the engine started, s.
    origin: f64,
    /// Time from there to the epoch, in units.
    epoch: Sum,
    /// Whether a gap closes so soon that the epoch has to move to now before that.
    soon: bool,
    /// A gap that closes before this multiple of now closes soon.
    soonest: f64,
    /// Now, from the epoch.
    now: f64,
    /// Energy per mass of what moves with the floor, when the stack last changed, m²/s².
    ride_from: f64,
    tally: Tally,
    closing: Closing,
    /// The first and the last gap of a cascade that was left for a pause, and goes on.
    paused: Option<(usize, usize)>,
    /// Kinetic energy at the start or after an edit, m²/s²; without gravity it only falls.
    kinetic_at_first: f64,
    /// Events up to which there is no need to look whether the collision is over.
    next_look: u64,
    over: bool,
    state: State,
}

impl<G: Ground, R: Rule> Ed<G, R> {
    fn new(scene: &Scene, state: State, ground: G, rule: R) -> Self {
        let n = scene.n;
        let masses = masses(scene);
        let pairs = pairs(scene, &masses);
        let scale = Closing::scale(scene, &state);
        let mut ed = Self {
            closing: Closing::of(scene, &pairs, state.closing),
            pairs,
            gravity: weight(scene),
            gaps: state
                .gaps
                .iter()
                .zip(&state.rates)
                .map(|(&g, &w)| Gap {
                    g: g * scale,
                    w,
                    t: 0.0,
                })
                .collect(),
            stack: 0,
            queue: Tournament::new(n + 2),
            approach: Tournament::new(n),
            collided: vec![0; n],
            cascades: 0,
            scale,
            origin: state.time,
            epoch: Sum::default(),
            soon: false,
            soonest: epoch::soonest(n),
            now: 0.0,
            ride_from: 0.0,
            paused: None,
            tally: Tally::default(),
            kinetic_at_first: f64::INFINITY,
            next_look: 0,
            over: false,
            masses,
            ground,
            rule,
            state,
        };
        ed.begin();
        ed
    }

    /// Finds what rests, opens the ledger, and schedules every gap.
    fn begin(&mut self) {
        if G::PULLS && self.ground.pressing(0.0) > 0.0 {
            let resting = |gap: &Gap| gap.g <= 0.0 && gap.w.abs() <= self.closing.speed;
            self.stack = self.gaps.iter().take_while(|gap| resting(gap)).count();
        }
        for gap in &mut self.gaps[..self.stack] {
            (gap.g, gap.w) = (0.0, 0.0);
        }
        self.ride_from = self.floor_energy(0.0);
        let books = &mut self.state.books;
        for (i, gap) in self.gaps.iter().enumerate() {
            books.contacts.note(
                i,
                gap.g <= 0.0 && gap.w.abs() <= self.closing.speed,
                self.state.time,
            );
        }
        let (gaps, rates) = self.gaps_and_rates(0.0);
        let energy = self.snapshot(&gaps, &rates, 0.0).energy();
        self.kinetic_at_first = energy.kinetic;
        let error = self.state.ledger_error;
        self.state.books.ledger.open(energy, error);
        self.weigh();
        self.schedule(0, self.gaps.len() - 1);
        self.schedule_take_off();
        self.queue.set(self.gaps.len() + 1, self.ground.tick());
    }

    /// Simulated time of `t`, s.
    fn absolute(&self, t: f64) -> f64 {
        self.origin + self.epoch.with(t) / self.scale
    }

    /// Gaps, m, and their rates, m/s.
    fn gaps_and_rates(&self, t: f64) -> (Vec<f64>, Vec<f64>) {
        let seen = |i| {
            let (g, w) = self.at(i, t);
            (g / self.scale, w)
        };
        (0..self.gaps.len()).map(seen).unzip()
    }

    fn snapshot<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64], t: f64) -> Snapshot<'a> {
        Snapshot {
            time: self.absolute(t),
            gaps,
            rates,
            plate: self.ground.plate(t),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &[],
        }
    }

    /// Gap `i` and its rate at time `t`.
    fn at(&self, i: usize, t: f64) -> (f64, f64) {
        self.gaps[i].flown(&self.ground, i == self.stack, t)
    }

    /// Brings gap `i` to time `t`.
    fn sync(&mut self, i: usize, t: f64) {
        let (g, w) = self.at(i, t);
        self.gaps[i] = Gap {
            g: g.max(0.0),
            w,
            t,
        };
    }

    /// When gap `i` closes.
    #[inline]
    fn closes(&self, i: usize) -> f64 {
        if i < self.stack {
            return f64::INFINITY;
        }
        self.gaps[i].closes(&self.ground, i == self.stack)
    }

    /// Schedules the gaps from `low` to `high`.
    fn schedule(&mut self, low: usize, high: usize) {
        let mut soonest = f64::INFINITY;
        for i in low..=high {
            let closes = self.closes(i);
            soonest = soonest.min(closes);
            self.queue.write(i, closes);
        }
        self.queue.play_again(low, high);
        self.look_ahead(soonest, self.now);
    }

    fn schedule_take_off(&mut self) {
        if G::PULLS {
            let time = if self.stack > 0 {
                self.ground.take_off(self.now)
            } else {
                f64::INFINITY
            };
            self.queue.set(self.gaps.len(), time);
        }
    }

    /// Kinetic and gravitational energy per mass of what moves with the floor.
    fn floor_energy(&self, t: f64) -> f64 {
        let (z, v) = self.ground.plate(t).motion();
        0.5 * v * v + self.gravity * z
    }

    fn stack_mass(&self) -> f64 {
        self.masses[..self.stack].iter().sum()
    }

    /// Changes how many beads ride the floor, and books the work that it has done on the
    /// riders so far.
    fn set_stack(&mut self, stack: usize, t: f64) {
        self.riders_change(t);
        let energy = self.floor_energy(t);
        let work = self.stack_mass() * (energy - self.ride_from);
        self.state.books.ledger.plate_work.add(work);
        self.ride_from = energy;
        self.stack = stack;
    }

    /// The plate falls away from under the stack. Its beads fly on with one velocity.
    fn take_off(&mut self, t: f64) {
        let stack = self.stack;
        if stack < self.gaps.len() {
            self.sync(stack, t);
        }
        self.set_stack(0, t);
        for gap in &mut self.gaps[..stack] {
            *gap = Gap { g: 0.0, w: 0.0, t };
        }
        let time = self.absolute(t);
        self.state.books.contacts.note(0, false, time);
        self.schedule(0, stack.min(self.gaps.len() - 1));
        self.schedule_take_off();
    }

    /// Looks once in N events whether a floor collision without gravity is over. The next
    /// event is given.
    fn look_whether_over(&mut self, (next, when): (usize, f64)) {
        if G::PULLS || self.over {
            return;
        }
        let never = when.is_infinite();
        if !never && self.state.books.events < self.next_look {
            return;
        }
        self.next_look = self.state.books.events + self.gaps.len() as u64;
        let rate = self.gaps.get(next).map_or(0.0, |gap| gap.w);
        if !never && much_to_come(&self.masses, next, rate, OVER * self.kinetic_at_first) {
            return;
        }
        let rates = self.gaps.iter().map(|gap| gap.w);
        self.over = never || nothing_to_come(rates, &self.masses, OVER);
    }
}

impl<G: Ground + 'static, R: Rule + 'static> Engine for Ed<G, R> {
    fn time(&self) -> f64 {
        self.absolute(self.now)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let n = self.gaps.len();
        let (collisions, mut others) = (self.state.books.events, 0);
        let mut next = self.queue.first();
        loop {
            if let Some((low, high)) = self.paused {
                if self.state.books.events - collisions >= budget {
                    return Ok(Outcome::OutOfBudget);
                }
                self.cascade(low, high, self.now);
                self.keep_tally();
                next = self.queue.first();
                continue;
            }
            let (i, t) = next;
            // As `next_event` says it, so that advancing to there includes the event.
            if self.absolute(t) > until || t.is_infinite() {
                // Not past the next event, which rounding could do.
                let end = self.epoch.until((until - self.origin) * self.scale).min(t);
                self.now = self.now.max(end);
                self.look_whether_over(next);
                return Ok(if self.over {
                    Outcome::Over
                } else {
                    Outcome::Reached
                });
            }
            // Take-offs and landings without a collision count too, so that no budget is endless.
            if self.state.books.events - collisions + others >= budget {
                return Ok(Outcome::OutOfBudget);
            }
            others += 1;
            self.now = self.now.max(t);
            match i.cmp(&n) {
                std::cmp::Ordering::Less => self.collide_at(i, self.now)?,
                std::cmp::Ordering::Equal => self.take_off(self.now),
                // A tick is a power of two: a move by it changes no bit of an absolute time.
                std::cmp::Ordering::Greater => self.move_epoch(self.ground.tick()),
            }
            self.keep_tally();
            if self.soon {
                self.follow();
            }
            next = self.queue.first();
            self.look_whether_over(next);
        }
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn next_event(&self) -> Option<f64> {
        let n = self.gaps.len();
        let next = (0..=n)
            .map(|i| self.queue.get(i))
            .fold(f64::INFINITY, f64::min);
        next.is_finite().then(|| self.absolute(next))
    }

    fn observe(&self, into: &mut Observation) {
        let (gaps, rates) = self.gaps_and_rates(self.now);
        self.snapshot(&gaps, &rates, self.now)
            .observe(&self.state.books, self.ledger(), into);
        into.integrals = self.integrals();
    }

    fn state(&self) -> State {
        let (gaps, rates) = self.gaps_and_rates(self.now);
        let books = Books {
            ledger: self.ledger(),
            ..self.state.books.clone()
        };
        self.snapshot(&gaps, &rates, self.now).state(books)
    }
}

impl<G: Ground, R: Rule> Ed<G, R> {
    /// What is accounted for up to now, with the work on the riders since the stack last
    /// changed.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.state.books.ledger;
        let ride = self.floor_energy(self.now) - self.ride_from;
        ledger.plate_work.add(self.stack_mass() * ride);
        ledger
    }
}
