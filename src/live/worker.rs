//! The loop of the simulation thread.

mod scenes;
mod tape;
mod travel;

use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError};

use super::clock::Clock;
use super::history::{ColumnSample, History, Sample};
use super::past::{Past, Position};
use super::recording::{Played, Written};
use super::runner::{Build, Runner};
use super::shadow::Shadow;
use super::slot::Outlet;
use super::{Frame, Order, Sampling, Side};

/// The columns move for this long between two looks at the orders.
const SLICE: Duration = Duration::from_millis(4);
/// How often they are moved while they keep up.
const TICK: Duration = Duration::from_millis(8);
/// And at most this long apart, however long they take to make.
const RAREST: Duration = Duration::from_millis(500);
/// Frames are not published more often than this.
const FRAME: Duration = Duration::from_millis(15);
/// A time of the past that is sought for longer is seen coming.
const SEEN_ON_THE_WAY: Duration = Duration::from_millis(300);
/// Samples of one slice; when the sweep is so fast that there were more, some are skipped.
const SAMPLES_PER_SLICE: u32 = 64;

/// What the simulation thread owns.
pub(super) struct Worker {
    build: Build,
    outlet: Outlet,
    position: Position,
    /// When the columns are on their way to another time, that time, s.
    under_way: Option<f64>,
    past: Past,
    /// The tape that is written, and the one that is played.
    written: Option<Written>,
    played: Option<Played>,
    /// Since when another time of the past is sought, while it is not reached.
    sought: Option<Instant>,
    /// Whether it goes on from a time that it is on its way to.
    goes_on: bool,
    /// The shadow of each column, while they are asked for.
    shadows: Option<Vec<Option<Shadow>>>,
    clock: Clock,
    speed: f64,
    sweep: Sampling,
    /// Simulated time that both columns cover before either goes further, s.
    stretch: f64,
    /// Every how many-th sample is taken.
    stride: i64,
    generation: u64,
    paused: bool,
    held: bool,
    history: History,
    notes: Vec<String>,
    orders: u64,
    next_frame: Instant,
}

impl Worker {
    pub(super) fn new(build: Build, outlet: Outlet, memory: usize) -> Worker {
        let now = Instant::now();
        Worker {
            build,
            outlet,
            position: Position::default(),
            under_way: None,
            past: Past::new(memory),
            written: None,
            played: None,
            sought: None,
            goes_on: false,
            shadows: None,
            clock: Clock::new(now),
            speed: 1.0,
            sweep: Sampling {
                origin: 0.0,
                span: 1.0,
                columns: 1,
                hold: false,
            },
            stretch: 1.0,
            stride: 1,
            generation: 0,
            paused: true,
            held: false,
            history: History::new(1),
            notes: Vec::new(),
            orders: 0,
            next_frame: now,
        }
    }

    /// Carries out orders and moves the columns until the other end is gone.
    pub(super) fn run(mut self, inbox: &Receiver<Order>) {
        let mut busy = false;
        loop {
            let wait = if busy { Duration::ZERO } else { TICK };
            let first = if self.is_idle() {
                inbox.recv().map_err(|_| RecvTimeoutError::Disconnected)
            } else {
                inbox.recv_timeout(wait)
            };
            let asked = match first {
                Ok(order) => {
                    self.carry_out(order);
                    inbox.try_iter().for_each(|order| self.carry_out(order));
                    true
                }
                Err(RecvTimeoutError::Timeout) => false,
                Err(RecvTimeoutError::Disconnected) => {
                    self.end_tape();
                    return;
                }
            };
            if !self.paused {
                self.clock.tick(self.position.reached, Instant::now());
            }
            let arrived = self.advance();
            if arrived && self.sought.is_some() && self.shadows.is_some() {
                self.shade(true);
            }
            if arrived && self.goes_on {
                self.set_running(true);
            }
            self.follow(arrived);
            busy = !arrived || self.is_shadow_waited_for();
            self.publish(asked || self.is_idle());
        }
    }

    /// Whether nothing moves before the next order.
    fn is_idle(&self) -> bool {
        let moving = !self.paused || self.position.reached < self.clock.goal();
        let still = !moving || !self.position.is_alive();
        still && !self.is_shadow_waited_for()
    }

    fn carry_out(&mut self, order: Order) {
        self.orders += 1;
        match order {
            Order::Load {
                generation,
                scenes,
                sweep,
                speed,
                running,
                shadow,
            } => {
                self.generation = generation;
                self.set_sweep(sweep);
                self.set_speed(speed);
                self.notes.clear();
                self.restart(scenes);
                self.shade(shadow);
                self.set_running(running);
            }
            Order::Edit { scenes, from } => {
                self.edit(scenes, from.clone());
                self.shade_again(&from);
            }
            Order::Record(recording) => self.record(recording.as_ref()),
            Order::Play(tape) => self.play(&tape),
            Order::Shadow(on) => self.shade(on),
            Order::Run(running) => self.set_running(running),
            Order::Speed(speed) => self.set_speed(speed),
            Order::Sampling(sweep) => self.set_sweep(sweep),
            Order::Leap(leap) => self.leap(leap),
            Order::LookInto { speed, lead } => {
                self.set_speed(speed);
                self.leap_before_landing(lead);
                self.goes_on = true;
            }
        }
    }

    fn set_running(&mut self, running: bool) {
        // What it is on its way to comes first.
        self.goes_on = running && self.is_travelling();
        if self.goes_on {
            return;
        }
        if self.paused == running {
            self.paused = !running;
            self.clock.stand_at(self.position.reached, Instant::now());
        }
        self.held = false;
    }

    fn set_speed(&mut self, speed: f64) {
        self.speed = speed;
        self.clock.set_speed(speed);
    }

    fn set_sweep(&mut self, sweep: Sampling) {
        self.sweep = sweep;
        self.stretch = sweep.interval();
        self.stride = 1;
        self.history.set_capacity(sweep.columns);
    }

    /// Moves towards the clock's goal for about [`SLICE`]; whether it has come there.
    fn advance(&mut self) -> bool {
        let started = Instant::now();
        let (stride, mut taken) = (self.stride, 0);
        while self.position.reached < self.clock.goal() && self.position.is_alive() {
            let reached = self.position.reached;
            let sample = self.sweep.next_sample(reached, stride);
            let sample_time = self.sweep.sample_time(sample);
            let edit = self.past.edit_after(self.position.edits);
            let until = sample_time
                .min(self.clock.goal())
                .min(reached + self.stretch)
                .min(self.next_mark())
                .min(edit.map_or(f64::INFINITY, |edit| edit.time));
            self.under_way = Some(until);
            let arrived = self.position.advance(until);
            if arrived {
                self.arrive(until);
                if until >= sample_time {
                    self.sample();
                    taken += 1;
                    self.hold_if_full(sample);
                }
            }
            let late = started.elapsed() >= SLICE;
            // The faster column is ahead of the slower one by about a slice at most.
            if arrived && !late {
                self.stretch = (1.2 * self.stretch).min(1.0);
            } else if late && !arrived {
                self.stretch *= 0.5;
            }
            if late {
                break;
            }
        }
        self.fit_stride(taken);
        self.past.reach(self.position.reached, started.elapsed());
        self.has_arrived()
    }

    /// Whether the columns have come where the clock wants them, as far as they move.
    fn has_arrived(&self) -> bool {
        self.position.reached >= self.clock.goal() || !self.position.is_alive()
    }

    /// All columns have come to `until`, s, where edits of the past act again.
    fn arrive(&mut self, until: f64) {
        self.position.reached = until;
        self.under_way = None;
        self.mark();
        let due = |past: &Past, edits| {
            past.edit_after(edits)
                .is_some_and(|edit| edit.time <= until)
        };
        while due(&self.past, self.position.edits) {
            let mut position = std::mem::take(&mut self.position);
            self.make_again(&mut position);
            self.position = position;
            self.mark();
        }
    }

    /// Takes fewer samples when the columns run over so many of them in a slice, and
    /// more when they do no longer.
    fn fit_stride(&mut self, taken: u32) {
        if taken > SAMPLES_PER_SLICE {
            self.stride = self.stride.saturating_mul(2);
        } else if taken < SAMPLES_PER_SLICE / 4 {
            self.stride = (self.stride / 2).max(1);
        }
    }

    fn sample(&mut self) {
        let errors: Vec<Option<f64>> = (0..self.position.runners.len())
            .map(|index| self.shadow(index)?.height())
            .collect();
        let rows = self
            .position
            .runners
            .iter_mut()
            .zip(errors)
            .map(|(runner, error)| {
                runner
                    .is_alive()
                    .then(|| ColumnSample::of(runner.observe(), error))
            })
            .collect();
        let sample = Sample {
            time: self.position.reached,
            rows,
        };
        // What is sought is shown when it is found.
        if self.sought.is_none() {
            self.history.push(sample.clone());
        }
        self.past.add(sample);
    }

    /// Stands still at the end of a page that is to be looked at.
    fn hold_if_full(&mut self, sample: i64) {
        if self.sweep.hold && !self.paused && self.sweep.ends_page(sample) {
            self.set_running(false);
            self.held = true;
        }
    }

    fn publish(&mut self, at_once: bool) {
        self.notes.extend(
            self.position
                .runners
                .iter_mut()
                .filter_map(Runner::take_note),
        );
        let started = Instant::now();
        if !at_once && started < self.next_frame {
            return;
        }
        // On the way back there is nothing to see, unless it is long.
        let found = self.has_arrived();
        if !found
            && self
                .sought
                .is_some_and(|since| started < since + SEEN_ON_THE_WAY)
        {
            return;
        }
        let whole = self.sought.take_if(|_| found).is_some();
        if whole {
            let (time, columns) = (self.position.reached, self.sweep.columns);
            self.history = self.past.page(time, columns);
        }
        let mut sides: Vec<Side> = self.position.runners.iter_mut().map(Runner::side).collect();
        for (index, side) in sides.iter_mut().enumerate() {
            side.accuracy = self.shadow(index).map(Shadow::accuracy);
        }
        let empty = History::new(self.sweep.columns);
        self.outlet.publish(Frame {
            generation: self.generation,
            time: self.position.reached,
            sides,
            scenes: self.position.scenes(),
            end: self.past.end(),
            recorded: self.written.as_ref().map(Written::to),
            whole,
            towards: self.is_travelling().then(|| self.clock.goal()),
            history: std::mem::replace(&mut self.history, empty),
            notes: std::mem::take(&mut self.notes),
            paused: self.paused,
            held: self.held,
            orders: self.orders,
            achieved: self.clock.achieved(),
        });
        self.remember();
        // Large columns take long to look at: they shall move for most of the time.
        self.next_frame = started + (4 * started.elapsed()).clamp(FRAME, RAREST);
    }

    /// Keeps this moment, where it is a new one and there is time to.
    fn remember(&mut self) {
        let started = Instant::now();
        let new = self.past.is_new(self.position.reached) && self.under_way.is_none();
        if new && self.past.affords() {
            self.past.keep(&self.position);
            self.past.spend(started.elapsed());
        }
    }
}

/// Adds a sentence that several columns or edits may have.
fn note_once(notes: &mut Vec<String>, note: &str) {
    if !notes.iter().any(|told| told == note) {
        notes.push(note.to_owned());
    }
}
