//! One step of a column under a power law: to where the tolerance allows, or to the
//! first beginning or end of a contact.

use super::chain::Chain;
use super::crossing::{Course, Fall, Jet};
use super::extrapolation::Extrapolation;
use crate::math;
use crate::physics::flight::{Ground, closing};

/// Part of the scene's tolerance that a step may use up: a contact takes many.
const SHARE: f64 = 0.1;
/// Attempts at one step.
const TRIES: u32 = 100;
/// Contact times that a step is at most.
const LONGEST: f64 = 10.0;

/// A step that has been computed, but not taken yet.
pub(super) struct Ahead {
    /// How long it is, s; infinite for a flight without an end.
    pub h: f64,
    /// Gaps and rates at its end, energy lost and work of the plate during it.
    pub y: Vec<f64>,
    /// The gap that begins or ceases to be a contact at its end.
    pub event: Option<usize>,
    /// Whether all beads fly.
    pub flight: bool,
    /// The step to take next, s.
    next: f64,
}

/// A column that moves.
pub(super) struct Motion<G> {
    pub ground: G,
    pub chain: Chain,
    /// Gaps, rates, and two zeros for what a step enters in the ledger.
    pub y: Vec<f64>,
    /// Which gaps are contacts.
    pub closed: Vec<bool>,
    /// Contact time that lengths of steps are compared with, s.
    pub contact_time: f64,
    tolerance: f64,
    /// The first step of a contact, s: so short that what is not smooth in it is lost in
    /// the tolerance.
    first: f64,
    next: f64,
    speeds: Vec<f64>,
    /// Width of the gap at which a contact is over, m: lost in the tolerance, but wider
    /// than the errors of contacts that hardly move yet.
    parted: f64,
    allowed: Vec<f64>,
    tool: Extrapolation,
    end: Vec<f64>,
    end_slope: Vec<f64>,
}

/// What happens first within a step.
enum First {
    Nothing,
    Unclear,
    /// This gap begins or ceases to be a contact, at that part of the step.
    Change(usize, f64),
}

impl<G: Ground> Motion<G> {
    pub fn new(ground: G, chain: Chain, y: Vec<f64>, tolerance: f64, contact_time: f64) -> Self {
        let n = chain.len();
        let tolerance = SHARE * tolerance;
        // The lowest power of time that is not whole, in units of the contact time.
        let spring = chain.springs[0];
        let roughness = [1.0 + spring.gamma, 2.0 + spring.beta];
        let roughness = roughness.into_iter().filter(|p| p.fract() != 0.0);
        let roughness = roughness.fold(f64::INFINITY, f64::min);
        let first = contact_time * math::powf(tolerance, 1.0 / roughness).min(0.1);
        Self {
            ground,
            closed: y[..n].iter().map(|&g| g <= 0.0).collect(),
            contact_time,
            tolerance,
            first,
            next: first,
            speeds: vec![0.0; n],
            parted: 0.0,
            allowed: vec![0.0; 2 * n + 1],
            tool: Extrapolation::new(y.len()),
            end: y.clone(),
            end_slope: y.clone(),
            y,
            chain,
        }
    }

    pub fn rates(&self) -> &[f64] {
        let n = self.chain.len();
        &self.y[n..2 * n]
    }

    /// Makes contacts of what overlaps, and none of what has parted.
    pub fn settle(&mut self) {
        self.measure();
        let n = self.chain.len();
        for i in 0..n {
            let (g, w) = (self.y[i], self.y[n + i]);
            self.closed[i] = if self.closed[i] {
                g < self.parted
            } else {
                g < 0.0 || (g == 0.0 && w < 0.0)
            };
        }
    }

    fn measure(&mut self) {
        let least = self.chain.speeds(&self.closed, &self.y, &mut self.speeds);
        self.parted = self.tolerance * least * self.contact_time;
    }

    /// Puts the column at the end of a step.
    pub fn take(&mut self, ahead: Ahead) {
        let n = self.chain.len();
        self.y = ahead.y;
        self.y[2 * n..].fill(0.0);
        self.next = ahead.next;
        if let Some(i) = ahead.event {
            self.closed[i] = !self.closed[i];
            if self.closed[i] {
                self.next = self.next.min(self.first);
            }
        }
    }

    /// The next step from time `now` of the ground's; the last length tried when there is none.
    pub fn look_ahead(&mut self, now: f64) -> Result<Ahead, f64> {
        if !self.closed.contains(&true) {
            return Ok(self.flight(now));
        }
        self.measure();
        let mut h = self.next.min(LONGEST * self.contact_time);
        for _ in 0..TRIES {
            let (good, next) = self.attempt(now, h);
            if !good {
                h = next;
                continue;
            }
            match self.first_change(now, h, None) {
                First::Nothing => return Ok(self.step(h, next, None)),
                First::Unclear => h *= 0.5,
                First::Change(i, at) => return Ok(self.step_to(now, i, at * h, h, next)),
            }
        }
        Err(h)
    }

    /// Tries a step of `h` s; whether it is within the tolerance, and a better length.
    fn attempt(&mut self, now: f64, h: f64) -> (bool, f64) {
        let n = self.chain.len();
        for i in 0..n {
            let overlap = if self.closed[i] { self.y[i].abs() } else { 0.0 };
            let speed = self.speeds[i];
            self.allowed[i] = self.tolerance * (overlap + h * speed);
            self.allowed[n + i] = self.tolerance * speed;
        }
        self.allowed[2 * n] = self.tolerance * self.chain.energy(&self.speeds);
        let (chain, ground, closed) = (&self.chain, &self.ground, &self.closed);
        let rate = |tau: f64, y: &[f64], dy: &mut [f64]| {
            chain.rate(ground, now + tau, closed, y, dy);
        };
        let verdict = self.tool.step(&rate, &self.y, h, &self.allowed);
        for ((end, y), increment) in self.end.iter_mut().zip(&self.y).zip(self.tool.increment()) {
            *end = y + increment;
        }
        (verdict.good, verdict.next)
    }

    fn step(&self, h: f64, next: f64, event: Option<usize>) -> Ahead {
        Ahead {
            h,
            y: self.end.clone(),
            event,
            flight: false,
            next,
        }
    }

    /// Value, slope and curvature over a step of `h` s of what falls to zero when gap `i`
    /// changes: the gap until a contact begins, what it lacks of [`Motion::parted`] until
    /// one ends.
    fn jet(&self, y: &[f64], slope: &[f64], i: usize, h: f64) -> Jet {
        let n = self.chain.len();
        let (g, w, a) = (y[i], y[n + i], slope[n + i]);
        if self.closed[i] {
            [self.parted - g, -h * w, -h * h * a]
        } else {
            [g, h * w, h * h * a]
        }
    }

    /// What happens first in the step of `h` s last tried, to another gap than `known`.
    fn first_change(&mut self, now: f64, h: f64, known: Option<usize>) -> First {
        let mut slope = std::mem::take(&mut self.end_slope);
        self.chain
            .rate(&self.ground, now + h, &self.closed, &self.end, &mut slope);
        let mut first = First::Nothing;
        let mut earliest = f64::INFINITY;
        for i in (0..self.chain.len()).filter(|&i| Some(i) != known) {
            let course = Course::new(
                self.jet(&self.y, self.tool.first(), i, h),
                self.jet(&self.end, &slope, i, h),
            );
            match course.fall() {
                Fall::At(at) if at < earliest => {
                    earliest = at;
                    first = First::Change(i, at);
                }
                Fall::Perhaps
                    if matches!(first, First::Nothing) && h > 1e-6 * self.contact_time =>
                {
                    first = First::Unclear;
                }
                _ => {}
            }
        }
        self.end_slope = slope;
        first
    }

    /// The step to the change of gap `i`, which is `h` s away or nearly so and within
    /// `most`; or to another gap's, if that comes first.
    fn step_to(&mut self, now: f64, mut i: usize, mut h: f64, most: f64, next: f64) -> Ahead {
        const ROUNDING: f64 = 4.0 * f64::EPSILON;
        for _ in 0..16 {
            self.attempt(now, h);
            if let First::Change(other, at) = self.first_change(now, h, Some(i))
                && at < 1.0 - ROUNDING
            {
                (i, h) = (other, at * h);
                continue;
            }
            let [value, slope, _] = self.jet(&self.end, &self.end_slope, i, 1.0);
            let change = -value / slope;
            // Where it only grazes zero, the place is as good as it gets.
            let small = change.abs() <= ROUNDING * h;
            if slope >= 0.0 || small || !(0.0..=most).contains(&(h + change)) {
                break;
            }
            h += change;
        }
        self.attempt(now, h);
        let mut ahead = self.step(h, next, Some(i));
        // Rounding must not undo what the step was made for.
        ahead.y[i] = if self.closed[i] {
            ahead.y[i].max(self.parted)
        } else {
            ahead.y[i].min(0.0)
        };
        ahead
    }

    /// The flight to the next touch.
    fn flight(&self, now: f64) -> Ahead {
        let (gaps, rates) = (&self.y[..self.chain.len()], self.rates());
        let mut event = (f64::INFINITY, 0);
        for (i, (&g, &w)) in gaps.iter().zip(rates).enumerate() {
            let touch = if i == 0 {
                self.ground.hit(now, g, w) - now
            } else {
                closing(0.0, g, w)
            };
            if touch < event.0 {
                event = (touch, i);
            }
        }
        let (h, i) = event;
        let mut ahead = Ahead {
            h,
            y: Vec::new(),
            event: None,
            flight: true,
            next: self.first,
        };
        if h.is_finite() {
            ahead.y = self.flown(now, h);
            ahead.y[i] = 0.0;
            ahead.event = Some(i);
        }
        ahead
    }

    /// All gaps and rates `tau` s later if no contact acts.
    fn flown(&self, now: f64, tau: f64) -> Vec<f64> {
        let n = self.chain.len();
        let mut y = self.y.clone();
        for i in 1..n {
            y[i] += y[n + i] * tau;
        }
        (y[0], y[n]) = self.ground.fall(now, y[0], y[n], now + tau);
        y
    }

    /// The column `tau` s later, within the step ahead.
    pub fn glimpse(&mut self, now: f64, tau: f64, flight: bool) -> Vec<f64> {
        if flight {
            return self.flown(now, tau);
        }
        self.measure();
        self.attempt(now, tau);
        self.end.clone()
    }
}
