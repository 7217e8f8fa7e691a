//! Hard collisions, event driven (Sec. II B): exact flight from event to event.
//!
//! Every gap keeps its value and rate at a time of its own. Between beads in flight a gap
//! changes linearly. Only one gap feels gravity and the plate: that between the lowest free
//! bead and the floor, or the stack that rides the floor. A collision changes three gaps, so
//! an event costs O(log N).
//!
//! Near inelastic collapse gaps, rates and the times between collisions shrink by hundreds of
//! decades and may grow again. No digit is lost on the way. Times are counted from an epoch
//! that moves on with the collisions (see [`times`]). Without gravity lengths and times are
//! kept in units so small that numbers do not underflow (see [`closing`]).

mod cascade;
mod closing;
mod pair;
mod rule;
mod tally;
mod times;

use super::column::{much_to_come, nothing_to_come};
use super::flight::Gap;
use super::ground::{Ground, OverGround};
use super::ledger::{Ledger, Sum};
use super::matter::{BeadColumn, Snapshot};
use super::observation::{Energy, Observation};
use super::shell::{Mover, Shell};
use super::state::{Books, State};
use super::tournament::Tournament;
use super::{Engine, EngineError};
use crate::scene::{CollisionRule, Method, Scene};
use closing::Closing;
use pair::{Pair, pairs};
use rule::{Always, LastCollisions, Rule};
use tally::Tally;

/// A floor collision is over when the collisions to come can change the kinetic energy by
/// this part of itself at most. No digit of a double shows it.
const OVER: f64 = 1e-32;

/// Events, for scenes of hard beads.
pub(super) struct HardEvents;

impl OverGround for HardEvents {
    fn over<G: Ground>(scene: &Scene, state: State, ground: G) -> Box<dyn Engine> {
        match scene.method {
            Method::Hard(CollisionRule::Tc { contact_time }) => {
                let contact_time = contact_time * Closing::scale(scene, &state);
                let rule = LastCollisions::new(scene.n, contact_time);
                Shell::boxed(Ed::new(scene, state, ground, rule))
            }
            _ => Shell::boxed(Ed::new(scene, state, ground, Always)),
        }
    }
}

/// A hard column. Its gaps and times are kept in units of 1/`scale` m and s.
#[derive(Clone)]
struct Ed<G, R> {
    ground: G,
    rule: R,
    column: BeadColumn,
    pairs: Vec<Pair>,
    gaps: Vec<Gap>,
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
    /// Time from there to the epoch, in units: two doubles, since it moves to any time.
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
    books: Books,
}

impl<G: Ground, R: Rule> Ed<G, R> {
    fn new(scene: &Scene, state: State, ground: G, rule: R) -> Self {
        let n = scene.n;
        let column = BeadColumn::of(scene);
        let pairs = pairs(scene, &column.masses);
        let scale = Closing::scale(scene, &state);
        let mut ed = Self {
            closing: Closing::of(scene, &pairs, state.closing),
            pairs,
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
            queue: Tournament::new(n + 2),
            approach: Tournament::new(n),
            collided: vec![0; n],
            cascades: 0,
            scale,
            origin: state.time,
            epoch: Sum::default(),
            soon: false,
            soonest: times::soonest(n),
            now: 0.0,
            ride_from: 0.0,
            paused: None,
            tally: Tally::default(),
            kinetic_at_first: f64::INFINITY,
            next_look: 0,
            column,
            ground,
            rule,
            books: state.books,
        };
        ed.settle();
        ed
    }

    /// Finds what rests.
    fn settle(&mut self) {
        if G::PULLS && self.ground.pressing(0.0) > 0.0 {
            let resting = self.gaps.iter().take_while(|gap| self.rests(gap));
            self.ground.set_riders(resting.count());
        }
        for gap in &mut self.gaps[..self.ground.riders()] {
            (gap.g, gap.w) = (0.0, 0.0);
        }
        self.ride_from = self.floor_energy(0.0);
    }

    /// Whether the beads at a gap, which is as it was at the start, touch and do not move.
    fn rests(&self, gap: &Gap) -> bool {
        gap.g <= 0.0 && gap.w.abs() <= self.closing.speed
    }

    /// Simulated time of `t`, s.
    fn absolute(&self, t: f64) -> f64 {
        self.origin + self.epoch.with(t) / self.scale
    }

    /// Gap `i` and its rate at time `t`.
    fn at(&self, i: usize, t: f64) -> (f64, f64) {
        self.ground.flown(i, &self.gaps[i], t)
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
        if i < self.ground.riders() {
            return f64::INFINITY;
        }
        self.ground.closes(i, &self.gaps[i])
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
            let time = if self.ground.riders() > 0 {
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
        0.5 * v * v + self.column.gravity * z
    }

    fn stack_mass(&self) -> f64 {
        self.column.masses[..self.ground.riders()].iter().sum()
    }

    /// Changes how many beads ride the floor, and books the work that it has done on the
    /// riders so far.
    fn set_stack(&mut self, stack: usize, t: f64) {
        self.riders_change(t);
        let energy = self.floor_energy(t);
        let work = self.stack_mass() * (energy - self.ride_from);
        self.books.ledger.plate_work.add(work);
        self.ride_from = energy;
        self.ground.set_riders(stack);
    }

    /// The plate falls away from under the stack. Its beads fly on with one velocity.
    fn take_off(&mut self, t: f64) {
        let stack = self.ground.riders();
        if stack < self.gaps.len() {
            self.sync(stack, t);
        }
        self.set_stack(0, t);
        for gap in &mut self.gaps[..stack] {
            *gap = Gap { g: 0.0, w: 0.0, t };
        }
        let time = self.absolute(t);
        self.books.contacts.note(0, false, time);
        self.schedule(0, stack.min(self.gaps.len() - 1));
        self.schedule_take_off();
    }

    /// Looks once in N events whether a floor collision without gravity is over. The next
    /// event is given.
    fn look_whether_over(&mut self, (next, when): (usize, f64)) {
        if G::PULLS || self.books.over {
            return;
        }
        let never = when.is_infinite();
        if !never && self.books.events < self.next_look {
            return;
        }
        self.next_look = self.books.events + self.gaps.len() as u64;
        let rate = self.gaps.get(next).map_or(0.0, |gap| gap.w);
        if !never
            && much_to_come(
                &self.column.masses,
                next,
                rate,
                OVER * self.kinetic_at_first,
            )
        {
            return;
        }
        let rates = self.gaps.iter().map(|gap| gap.w);
        self.books.over = never || nothing_to_come(rates, &self.column.masses, OVER);
    }
}

impl<G: Ground, R: Rule> Mover for Ed<G, R> {
    type Matter = BeadColumn;

    fn time(&self) -> f64 {
        self.absolute(self.now)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<bool, EngineError> {
        let n = self.gaps.len();
        let (collisions, mut others) = (self.books.events, 0);
        let mut next = self.queue.first();
        loop {
            if let Some((low, high)) = self.paused {
                if self.books.events - collisions >= budget {
                    return Ok(false);
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
                return Ok(true);
            }
            // Take-offs and landings without a collision count too, so that no budget is endless.
            if self.books.events - collisions + others >= budget {
                return Ok(false);
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

    fn next_event(&self) -> Option<f64> {
        let n = self.gaps.len();
        let next = (0..=n)
            .map(|i| self.queue.get(i))
            .fold(f64::INFINITY, f64::min);
        next.is_finite().then(|| self.absolute(next))
    }

    fn note_contacts(&mut self) {
        let time = self.time();
        for i in 0..self.gaps.len() {
            let closed = self.rests(&self.gaps[i]);
            self.books.contacts.note(i, closed, time);
        }
    }

    fn begin(&mut self, energy: Energy) {
        self.kinetic_at_first = energy.kinetic;
        self.weigh();
        self.schedule(0, self.gaps.len() - 1);
        self.schedule_take_off();
        self.queue.set(self.gaps.len() + 1, self.ground.tick());
    }

    fn books(&self) -> &Books {
        &self.books
    }

    fn books_mut(&mut self) -> &mut Books {
        &mut self.books
    }

    /// With the work on the riders since the stack last changed.
    fn ledger(&self) -> Ledger {
        let mut ledger = self.books.ledger;
        let ride = self.floor_energy(self.now) - self.ride_from;
        ledger.plate_work.add(self.stack_mass() * ride);
        ledger
    }

    fn now(&self) -> Snapshot {
        let seen = |i| {
            let (g, w) = self.at(i, self.now);
            (g / self.scale, w)
        };
        let (gaps, rates) = (0..self.gaps.len()).map(seen).unzip();
        Snapshot {
            time: self.time(),
            gaps,
            rates,
            plate: self.ground.plate(self.now),
        }
    }

    fn matter(&self) -> &BeadColumn {
        &self.column
    }

    fn fill_in(&self, into: &mut Observation) {
        into.integrals = self.integrals();
    }
}
