//! Soft contacts on a fixed grid of time steps (molecular dynamics).
//!
//! One engine, specialised at compile time by integrator, ground, kind of chain and
//! attraction, so that a scene pays only for what it has. Contact changes fall
//! between steps, so every fixed-step method is of first order here, whatever its name.

mod chain;
mod gear;
mod ground;
mod lanes;
mod powered;
mod stepper;
mod verlet;

use super::column::{OVER, masses, nothing_to_come, springs};
use super::ledger::Ledger;
use super::moment::Moment;
use super::observation::Observation;
use super::power_law::Spring;
use super::state::{Books, State, weight};
use super::{Engine, EngineError, Outcome};
use crate::scene::{self, Floor, Integrator, Method, Scene, Solver};
use chain::{Chain, Equal, Law, Linear, Unequal};
pub(super) use gear::CORRECTOR;
use gear::Gear;
use ground::{Free, Ground, Shaken, Weight};
use powered::Powered;
use stepper::{Power, Stepper};
use verlet::Verlet;

/// Steps between two looks at the numbers themselves.
const HOUSEKEEPING: u64 = 32;
/// Steps between two looks at the energy.
const INSPECTION: u64 = 1024;
/// Steps that a time can count, 2^53.
const MOST_STEPS: f64 = 9_007_199_254_740_992.0;

/// What a scene on a grid has.
#[derive(Clone, Copy)]
struct Grid {
    contact_time: f64,
    steps_per_contact: f64,
    attraction: bool,
}

/// Builds the engine of an MD scene on a grid of time steps.
pub(super) fn build(scene: &Scene, state: State) -> Box<dyn Engine> {
    let (
        Method::Md {
            solver:
                Solver::Grid {
                    integrator,
                    steps_per_contact,
                },
            attraction,
            ..
        },
        Some(contact_time),
    ) = (scene.method, scene.contact_time())
    else {
        unreachable!("physics::build hands scenes on a grid to this room");
    };
    let grid = Grid {
        contact_time,
        steps_per_contact,
        attraction,
    };
    match integrator {
        Integrator::Gear => with_ground::<Gear>(scene, grid, state),
        Integrator::Verlet => with_ground::<Verlet>(scene, grid, state),
    }
}

fn with_ground<S: Stepper + 'static>(scene: &Scene, grid: Grid, state: State) -> Box<dyn Engine> {
    match (scene.floor, scene.gravity) {
        (Floor::Vibrating { .. }, gravity) => {
            let ground = Shaken::new(gravity.unwrap_or(0.0), state.plate);
            with_chain::<S, _>(scene, grid, state, ground)
        }
        (Floor::Fixed, Some(gravity)) => {
            let ground = Weight::new(gravity, state.plate);
            with_chain::<S, _>(scene, grid, state, ground)
        }
        (Floor::Fixed, None) => {
            let ground = Free::new(state.plate);
            with_chain::<S, _>(scene, grid, state, ground)
        }
    }
}

fn with_chain<S: Stepper + 'static, G: Ground + 'static>(
    scene: &Scene,
    grid: Grid,
    state: State,
    ground: G,
) -> Box<dyn Engine> {
    let masses = masses(scene);
    let springs = springs(scene, &masses);
    let column = Column {
        ground,
        masses,
        springs,
    };
    let power = matches!(scene.law(), Some(scene::Law::Power(_)));
    match (power, grid.attraction) {
        (false, true) => with_law::<S, _, _>(scene, grid, state, column, Linear::<true>),
        (false, false) => with_law::<S, _, _>(scene, grid, state, column, Linear::<false>),
        (true, true) => with_law::<S, _, _>(scene, grid, state, column, Powered::<true>),
        (true, false) => with_law::<S, _, _>(scene, grid, state, column, Powered::<false>),
    }
}

fn with_law<S: Stepper + 'static, G: Ground + 'static, L: Law + 'static>(
    scene: &Scene,
    grid: Grid,
    state: State,
    column: Column<G>,
    law: impl Fn(Spring) -> L,
) -> Box<dyn Engine> {
    let laws: Vec<L> = column.springs.iter().map(|&spring| law(spring)).collect();
    if scene.width == 0.0 {
        Md::<S, G, _>::boxed(scene, grid, state, column, Equal::new(&laws))
    } else {
        let chain = Unequal::new(&laws, &column.masses);
        Md::<S, G, _>::boxed(scene, grid, state, column, chain)
    }
}

/// What a column is, whatever moves it.
struct Column<G> {
    ground: G,
    masses: Vec<f64>,
    springs: Vec<Spring>,
}

/// A soft column on a grid of steps.
struct Md<S, G, C> {
    stepper: S,
    /// Since the last look at the numbers.
    power: Power,
    ground: G,
    chain: C,
    masses: Vec<f64>,
    springs: Vec<Spring>,
    gravity: f64,
    steps_per_contact: f64,
    /// Energy in which the column would fall by a diameter, m²/s².
    least_energy: f64,
    /// Time of grid point 0, s: the start, or the last edit.
    origin: f64,
    h: f64,
    /// Grid points done.
    n: u64,
    /// Where a flight without any contact or force began and where it will be
    /// stepped again; in between gaps are linear in time and need no steps.
    flight: Option<(u64, u64)>,
    /// Grid points passed in finished flights.
    skipped: u64,
    state: State,
    over: bool,
}

impl<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static> Md<S, G, C> {
    fn boxed(
        scene: &Scene,
        grid: Grid,
        state: State,
        column: Column<G>,
        chain: C,
    ) -> Box<dyn Engine> {
        let Column {
            mut ground,
            masses,
            springs,
        } = column;
        let h = grid.contact_time / grid.steps_per_contact;
        ground.set_step(h);
        let mut md = Self {
            stepper: S::start(&state.gaps, &state.rates, h, &chain, &ground),
            power: Power::default(),
            gravity: weight(scene),
            least_energy: weight(scene) * scene.diameter * masses.iter().sum::<f64>(),
            origin: state.time,
            n: 0,
            flight: None,
            skipped: 0,
            over: false,
            ground,
            chain,
            masses,
            springs,
            steps_per_contact: grid.steps_per_contact,
            h,
            state,
        };
        md.note_contacts();
        let (gaps, rates) = (md.gaps(), md.rates());
        if md.state.books.contacts.closed()[0] {
            let arrival = md.moment(&gaps, &rates).arrival();
            md.state.books.bounce.begin(arrival);
        }
        let energy = md.moment(&gaps, &rates).energy();
        let error = md.state.ledger_error;
        md.state.books.ledger.open(energy, error);
        Box::new(md)
    }

    fn moment<'a>(&'a self, gaps: &'a [f64], rates: &'a [f64]) -> Moment<'a> {
        Moment {
            time: self.time(),
            gaps,
            rates,
            plate: self.ground.plate(),
            masses: &self.masses,
            gravity: self.gravity,
            springs: &self.springs,
        }
    }

    fn grid(&self, n: u64) -> f64 {
        self.origin + n as f64 * self.h
    }

    /// The last grid point not after `until`.
    fn last_step(&self, until: f64) -> u64 {
        let estimate = ((until - self.origin) / self.h).max(0.0);
        if estimate >= MOST_STEPS {
            return u64::MAX;
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "between 0 and 2^53"
        )]
        let mut n = estimate as u64;
        while n > 0 && self.grid(n) > until {
            n -= 1;
        }
        while self.grid(n + 1) <= until {
            n += 1;
        }
        n
    }

    /// Looks which contacts began or ended in the last step.
    fn note_contacts(&mut self) {
        let time = self.time();
        let floor_was_closed = self.state.books.contacts.closed()[0];
        for (i, g) in self.stepper.gaps().enumerate() {
            self.state.books.contacts.note(i, g <= 0.0, time);
        }
        let floor_is_closed = self.state.books.contacts.closed()[0];
        if floor_is_closed != floor_was_closed {
            let (gaps, rates) = (self.gaps(), self.rates());
            let arrival = self.moment(&gaps, &rates).arrival();
            if floor_is_closed {
                self.state.books.bounce.begin(arrival);
            } else {
                self.state.books.bounce.end(arrival.translation);
            }
        }
        if !G::PULLS && !self.over && self.state.books.contacts.all_open() {
            self.over = self.nothing_to_come();
        }
    }

    /// Does up to `steps` steps, not past a look at the numbers; how many it did.
    fn run(&mut self, steps: u64) -> Result<u64, EngineError> {
        let steps = steps.min(HOUSEKEEPING - self.n % HOUSEKEEPING);
        let (mut done, mut changed) = (0, false);
        while done < steps && !changed {
            changed = self
                .stepper
                .step(&self.chain, &mut self.ground, &mut self.power);
            done += 1;
        }
        self.n += done;
        if changed {
            self.note_contacts();
            if self.over && self.lost_the_energy() {
                return Err(self.unstable());
            }
        }
        if self.n.is_multiple_of(HOUSEKEEPING) {
            self.housekeeping()?;
        }
        Ok(done)
    }

    fn unstable(&self) -> EngineError {
        EngineError::Unstable {
            time: self.time(),
            steps_per_contact: self.steps_per_contact,
        }
    }

    fn rates(&self) -> Vec<f64> {
        self.stepper.rates(&self.chain, &self.ground)
    }

    fn nothing_to_come(&self) -> bool {
        nothing_to_come(self.rates().into_iter(), &self.masses)
    }

    /// The gaps now, those of a flight included.
    fn gaps(&self) -> Vec<f64> {
        let gaps = self.stepper.gaps();
        let Some((from, _)) = self.flight else {
            return gaps.collect();
        };
        let flown = (self.n - from) as f64 * self.h;
        gaps.zip(self.rates()).map(|(g, w)| g + flown * w).collect()
    }

    /// Goes on in one flight to just before the next contact, if nothing pulls and no
    /// contact has been closed since the last look.
    fn look_for_flight(&mut self) -> Result<(), EngineError> {
        let since = self.state.books.contacts.last().unwrap_or(self.origin);
        let settled = self.time() - since > HOUSEKEEPING as f64 * self.h;
        if G::PULLS || !settled || !self.state.books.contacts.all_open() {
            return Ok(());
        }
        let closing = |(g, w): (f64, f64)| if w < 0.0 { -g / w } else { f64::INFINITY };
        let gaps = self.stepper.gaps();
        let next = gaps
            .zip(self.rates())
            .map(closing)
            .fold(f64::INFINITY, f64::min);
        let ahead = next / self.h;
        if ahead.is_finite() && self.n as f64 + ahead >= MOST_STEPS && !self.over {
            return Err(EngineError::BeyondTime {
                time: self.time(),
                steps: ahead,
            });
        }
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a count of steps, or infinite"
        )]
        let steps = ahead.min(u64::MAX as f64) as u64;
        // The last steps are done one by one: the closed form must not overshoot.
        let steps = steps.saturating_sub(2) / HOUSEKEEPING * HOUSEKEEPING;
        if steps > 0 {
            self.flight = Some((self.n, self.n.saturating_add(steps)));
        }
        Ok(())
    }

    /// Passes through a flight, up to grid point `last` at most.
    fn fly(&mut self, last: u64) {
        let Some((from, end)) = self.flight else {
            return;
        };
        self.n = end.min(last).max(self.n);
        if self.n == end {
            self.stepper.coast(end - from);
            self.skipped += end - from;
            self.flight = None;
        }
    }

    /// What is accounted for, up to now.
    fn books(&self) -> Books {
        let mut books = self.state.books.clone();
        fold(&mut books.ledger, &self.power, self.h);
        let flying = self.flight.map_or(0, |(from, _)| self.n - from);
        books.steps += self.n - self.skipped - flying;
        books
    }

    /// Every so often, whatever the slices a run is advanced in.
    fn housekeeping(&mut self) -> Result<(), EngineError> {
        fold(&mut self.state.books.ledger, &self.power, self.h);
        self.power = Power::default();
        self.stepper.clear();
        self.look_for_flight()?;
        let sound = self.stepper.gaps().sum::<f64>().is_finite();
        if sound && !self.n.is_multiple_of(INSPECTION) {
            return Ok(());
        }
        if !sound || self.lost_the_energy() {
            return Err(self.unstable());
        }
        // Overdamped contacts of heavy pairs never open, but spend all they have.
        if !G::PULLS && !self.over {
            let energy = self.moment(&self.gaps(), &self.rates()).energy();
            self.over = energy.elastic <= OVER * energy.kinetic && self.nothing_to_come();
        }
        Ok(())
    }

    /// Whether the ledger shows that the integration blows up.
    fn lost_the_energy(&self) -> bool {
        let energy = self.moment(&self.gaps(), &self.rates()).energy();
        self.books().ledger.is_broken(energy, self.least_energy)
    }
}

fn fold(ledger: &mut Ledger, power: &Power, h: f64) {
    ledger.lost.add(power.all_lost() * h);
    ledger.plate_work.add(power.plate * h);
}

impl<S: Stepper + 'static, G: Ground + 'static, C: Chain + 'static> Engine for Md<S, G, C> {
    fn time(&self) -> f64 {
        self.grid(self.n)
    }

    fn advance(&mut self, until: f64, budget: u64) -> Result<Outcome, EngineError> {
        let target = self.last_step(until);
        let mut left = budget;
        loop {
            self.fly(target);
            if self.n >= target || left == 0 {
                break;
            }
            left -= self.run(left.min(target - self.n))?;
        }
        Ok(match (self.n >= target, self.over) {
            (false, _) => Outcome::OutOfBudget,
            (true, true) => Outcome::Over,
            (true, false) => Outcome::Reached,
        })
    }

    fn is_over(&self) -> bool {
        self.over
    }

    fn next_event(&self) -> Option<f64> {
        None
    }

    fn observe(&self, into: &mut Observation) {
        self.moment(&self.gaps(), &self.rates())
            .observe(&self.books(), into);
    }

    fn state(&self) -> State {
        let (gaps, rates, books) = (self.gaps(), self.rates(), self.books());
        let energy = self.moment(&gaps, &rates).energy();
        State {
            time: self.time(),
            plate: self.ground.plate(),
            ledger_error: books.ledger.error(energy),
            springs: self.springs.clone(),
            books,
            gaps,
            rates,
        }
    }
}
