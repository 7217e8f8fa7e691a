//! The loop of the simulation thread.

use std::time::{Duration, Instant};

use crossbeam_channel::{Receiver, RecvTimeoutError};

use super::clock::Clock;
use super::history::{ColumnSample, History, Sample};
use super::runner::{Build, Runner};
use super::shadow::Shadow;
use super::slot::Outlet;
use super::{Frame, Order, Sampling, Side};
use crate::physics::State;
use crate::scene::Scene;

/// The columns move for this long between two looks at the orders.
const SLICE: Duration = Duration::from_millis(4);
/// How often they are moved while they keep up.
const TICK: Duration = Duration::from_millis(8);
/// And at most this long apart, however long they take to make.
const RAREST: Duration = Duration::from_millis(500);
/// Frames are not published more often than this.
const FRAME: Duration = Duration::from_millis(15);
/// Samples of one slice; when the sweep is so fast that there were more, some are skipped.
const SAMPLES_PER_SLICE: u32 = 64;

/// What the simulation thread owns.
pub(super) struct Worker {
    build: Build,
    outlet: Outlet,
    runners: Vec<Runner>,
    /// The shadow of each column, while they are asked for.
    shadows: Option<Vec<Option<Shadow>>>,
    clock: Clock,
    reached: f64,
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
    pub(super) fn new(build: Build, outlet: Outlet) -> Worker {
        let now = Instant::now();
        Worker {
            build,
            outlet,
            runners: Vec::new(),
            shadows: None,
            clock: Clock::new(now),
            reached: 0.0,
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
                Err(RecvTimeoutError::Disconnected) => return,
            };
            if !self.paused {
                self.clock.tick(self.reached, Instant::now());
            }
            let arrived = self.advance();
            self.follow(arrived);
            busy = !arrived || self.is_shadow_waited_for();
            self.publish(asked || self.is_idle());
        }
    }

    /// Whether nothing moves before the next order.
    fn is_idle(&self) -> bool {
        let moving = !self.paused || self.reached < self.clock.goal();
        let still = !moving || !self.runners.iter().any(Runner::is_alive);
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
                self.edit(scenes, &from);
                self.shade_again(&from);
            }
            Order::Shadow(on) => self.shade(on),
            Order::Run(running) => self.set_running(running),
            Order::Speed(speed) => self.set_speed(speed),
            Order::Sampling(sweep) => self.set_sweep(sweep),
            Order::Step(time) => {
                self.set_running(false);
                self.clock.ask_for(self.reached + time);
            }
            Order::NextEvent => self.step_to_event(),
        }
    }

    fn restart(&mut self, scenes: Vec<Scene>) {
        let build = &mut self.build;
        self.runners = scenes
            .into_iter()
            .map(|scene| Runner::new(build, scene, None, 0.0))
            .collect();
        self.reached = 0.0;
        self.held = false;
        self.clock.stand_at(0.0, Instant::now());
        self.history.clear();
        self.record();
    }

    /// Other scenes, each from the state of the column it follows. The follower of a
    /// failed column takes the state of its twin; when there is none, all start anew.
    fn edit(&mut self, scenes: Vec<Scene>, from: &[usize]) {
        let mut states: Vec<Option<State>> = self.runners.iter_mut().map(Runner::state).collect();
        // A column may be ahead of the other by some time: the plate turns after both.
        let times = states.iter().flatten().map(|state| state.time);
        let latest = times.fold(self.reached, f64::max);
        let present = states.iter_mut().flatten();
        present.for_each(|state| state.settle(latest));
        let shape = |scene: &Scene| (scene.n, scene.sites().is_some());
        let shapes: Vec<_> = self
            .runners
            .iter()
            .map(|runner| shape(runner.scene()))
            .collect();
        let fits = |scene: &Scene, index: usize| {
            states
                .get(index)?
                .as_ref()
                .filter(|_| shapes.get(index) == Some(&shape(scene)))
        };
        let sources: Option<Vec<&State>> = scenes
            .iter()
            .zip(from)
            .map(|(scene, &own)| {
                fits(scene, own).or_else(|| (0..states.len()).find_map(|other| fits(scene, other)))
            })
            .collect();
        let Some(sources) = sources else {
            self.restart(scenes);
            self.notes
                .push("no running column to go on from: started again".into());
            return;
        };
        let (build, time) = (&mut self.build, self.reached);
        self.runners = scenes
            .into_iter()
            .zip(sources)
            .map(|(scene, state)| Runner::new(build, scene, Some(state), time))
            .collect();
        let mut columns = self.runners.iter_mut();
        if let Some(note) = columns.find_map(Runner::take_plate_note) {
            note_once(&mut self.notes, note);
        }
    }

    /// Starts the shadows from the present state of the columns, or ends them.
    fn shade(&mut self, on: bool) {
        let build = &mut self.build;
        let columns = self.runners.iter_mut();
        self.shadows = on.then(|| columns.map(|column| Shadow::of(build, column)).collect());
    }

    /// Starts the shadows anew after an edit; those that were given up stay so.
    fn shade_again(&mut self, from: &[usize]) {
        let Some(mut before) = self.shadows.take() else {
            return;
        };
        self.shade(true);
        let after = self.shadows.iter_mut().flatten();
        for (shadow, &own) in after.zip(from) {
            let old = before.get_mut(own);
            if let Some(old) = old.filter(|old| old.as_ref().is_some_and(Shadow::is_given_up)) {
                *shadow = shadow.take().and(old.take());
            } else if shadow.is_some() {
                note_once(&mut self.notes, "the exact run starts again from here");
            }
        }
    }

    /// The shadows work on when the columns have `arrived` where the clock wants them.
    fn follow(&mut self, arrived: bool) {
        let Some(shadows) = &mut self.shadows else {
            return;
        };
        for (shadow, column) in shadows.iter_mut().zip(&mut self.runners) {
            // The error of a column that has stopped is known no longer.
            shadow.take_if(|_| !column.is_alive());
            if let Some(shadow) = shadow {
                shadow.follow(column, arrived);
            }
        }
    }

    fn is_shadow_waited_for(&self) -> bool {
        let mut shadows = self.shadows.iter().flatten().flatten();
        shadows.any(Shadow::is_waited_for)
    }

    /// The shadow of a column, where there is one.
    fn shadow(&self, index: usize) -> Option<&Shadow> {
        self.shadows.as_ref()?.get(index)?.as_ref()
    }

    fn set_running(&mut self, running: bool) {
        if self.paused == running {
            self.paused = !running;
            self.clock.stand_at(self.reached, Instant::now());
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

    fn step_to_event(&mut self) {
        self.set_running(false);
        let ahead = self
            .runners
            .iter_mut()
            .filter_map(Runner::next_event)
            .reduce(f64::min);
        if let Some(time) = ahead {
            // An event that is due now is carried out by the smallest move.
            self.clock.ask_for(time.max(self.reached.next_up()));
        } else {
            self.notes.push("no event ahead: one sample further".into());
            self.clock.ask_for(self.reached + self.sweep.interval());
        }
    }

    /// Moves towards the clock's goal for about [`SLICE`]; whether it has come there.
    fn advance(&mut self) -> bool {
        let started = Instant::now();
        let (stride, mut taken) = (self.stride, 0);
        while self.reached < self.clock.goal() && self.runners.iter().any(Runner::is_alive) {
            let sample = self.sweep.next_sample(self.reached, stride);
            let sample_time = self.sweep.sample_time(sample);
            let until = sample_time
                .min(self.clock.goal())
                .min(self.reached + self.stretch);
            let mut arrived = true;
            for runner in &mut self.runners {
                arrived &= runner.advance(until);
            }
            if arrived {
                self.reached = until;
                if until >= sample_time {
                    self.record();
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
        self.reached >= self.clock.goal() || !self.runners.iter().any(Runner::is_alive)
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

    fn record(&mut self) {
        let errors: Vec<Option<f64>> = (0..self.runners.len())
            .map(|index| self.shadow(index)?.height())
            .collect();
        let rows = self
            .runners
            .iter_mut()
            .zip(errors)
            .map(|(runner, error)| {
                runner
                    .is_alive()
                    .then(|| ColumnSample::of(runner.observe(), error))
            })
            .collect();
        self.history.push(Sample {
            time: self.reached,
            rows,
        });
    }

    /// Stands still at the end of a page that is to be looked at.
    fn hold_if_full(&mut self, sample: i64) {
        if self.sweep.hold && !self.paused && self.sweep.ends_page(sample) {
            self.set_running(false);
            self.held = true;
        }
    }

    fn publish(&mut self, at_once: bool) {
        self.notes
            .extend(self.runners.iter_mut().filter_map(Runner::take_note));
        let started = Instant::now();
        if !at_once && started < self.next_frame {
            return;
        }
        let mut sides: Vec<Side> = self.runners.iter_mut().map(Runner::side).collect();
        for (index, side) in sides.iter_mut().enumerate() {
            side.accuracy = self.shadow(index).map(Shadow::accuracy);
        }
        let empty = History::new(self.sweep.columns);
        self.outlet.publish(Frame {
            generation: self.generation,
            time: self.reached,
            sides,
            history: std::mem::replace(&mut self.history, empty),
            notes: std::mem::take(&mut self.notes),
            paused: self.paused,
            held: self.held,
            orders: self.orders,
            achieved: self.clock.achieved(),
        });
        // Large columns take long to look at: they shall move for most of the time.
        self.next_frame = started + (4 * started.elapsed()).clamp(FRAME, RAREST);
    }
}

/// Adds a sentence that several columns or edits may have.
fn note_once(notes: &mut Vec<String>, note: &str) {
    if !notes.iter().any(|told| told == note) {
        notes.push(note.to_owned());
    }
}
