//! One step of a column under a power law: as far as the tolerance allows, or to the first
//! beginning or end of a contact.

use super::equations::Equations;
use super::extrapolation::Extrapolation;
use super::hermite::{Crossing, HermiteQuintic, Jet};
use crate::math;
use crate::physics::flight::Gap;
use crate::physics::ground::Ground;

/// Part of the scene's tolerance that a step may use up, since a contact takes many.
const SHARE: f64 = 0.1;
/// Attempts at one step at most.
const TRIES: u32 = 100;
/// Longest step, in contact times.
const LONGEST: f64 = 10.0;

/// A step that has been computed, but not taken yet.
#[derive(Clone)]
pub(super) struct Ahead {
    /// How long it is, s; infinite for a flight that never ends.
    pub h: f64,
    /// Gaps and rates at its end, and energy lost and work of the plate in it.
    pub y: Vec<f64>,
    /// The gap whose contact begins or ends at its end.
    pub event: Option<usize>,
    /// Whether all beads fly.
    pub flight: bool,
    /// The step to take next, s.
    next: f64,
}

/// A column that moves.
#[derive(Clone)]
pub(super) struct Motion<G> {
    pub ground: G,
    pub equations: Equations,
    /// Gaps, rates, and two zeros for what a step enters in the ledger.
    pub y: Vec<f64>,
    /// Which gaps are contacts.
    pub closed: Vec<bool>,
    /// The scene's contact time, s, against which steps are long or short.
    pub contact_time: f64,
    tolerance: f64,
    /// The first step of a contact, s. It is so short that the power of time in it that is
    /// not smooth is below the tolerance.
    first: f64,
    /// The step to try next, s.
    next: f64,
    /// Speed of each contact's own motion, m/s.
    speeds: Vec<f64>,
    /// A contact ends when its gap is this wide, m. That is below the tolerance, but above the
    /// errors of contacts that hardly move yet.
    parted: f64,
    /// The error that each increment may have.
    allowed: Vec<f64>,
    method: Extrapolation,
    /// The column at the end of the step last tried, and its derivative there.
    end: Vec<f64>,
    end_slope: Vec<f64>,
}

/// What happens first within a step.
enum First {
    /// No contact begins or ends.
    Nothing,
    /// One may, but only a shorter step can tell.
    Unclear,
    /// The contact of this gap begins or ends, at this part of the step.
    Change(usize, f64),
}

impl<G: Ground> Motion<G> {
    pub fn new(
        ground: G,
        equations: Equations,
        y: Vec<f64>,
        tolerance: f64,
        contact_time: f64,
    ) -> Self {
        let n = equations.len();
        let tolerance = SHARE * tolerance;
        // A new contact has x = wτ: its force grows as τ^γ and τ^(1+β), its rate by these powers.
        // The lowest that is not whole is not smooth.
        let spring = equations.column.springs[0];
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
            method: Extrapolation::new(y.len()),
            end: y.clone(),
            end_slope: y.clone(),
            y,
            equations,
        }
    }

    /// The rates of the gaps, m/s.
    pub fn rates(&self) -> &[f64] {
        let n = self.equations.len();
        &self.y[n..2 * n]
    }

    /// Finds which gaps are contacts now.
    pub fn settle(&mut self) {
        self.measure();
        let n = self.equations.len();
        for i in 0..n {
            let (g, w) = (self.y[i], self.y[n + i]);
            self.closed[i] = if self.closed[i] {
                g < self.parted
            } else {
                g < 0.0 || (g == 0.0 && w < 0.0)
            };
        }
    }

    /// Finds how fast each contact moves, and so what errors it may have.
    fn measure(&mut self) {
        let least = self
            .equations
            .speeds(&self.closed, &self.y, &mut self.speeds);
        self.parted = self.tolerance * least * self.contact_time;
    }

    /// Puts the column at the end of a step.
    pub fn take(&mut self, ahead: Ahead) {
        let n = self.equations.len();
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

    /// The next step, from `now`, s from the epoch.
    ///
    /// # Errors
    /// The last length tried, s, when none is good.
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

    /// Tries a step of `h` s from `now`: whether it is good, and the length to try next, s.
    fn attempt(&mut self, now: f64, h: f64) -> (bool, f64) {
        let n = self.equations.len();
        for i in 0..n {
            let overlap = if self.closed[i] { self.y[i].abs() } else { 0.0 };
            let speed = self.speeds[i];
            self.allowed[i] = self.tolerance * (overlap + h * speed);
            self.allowed[n + i] = self.tolerance * speed;
        }
        self.allowed[2 * n] = self.tolerance * self.equations.energy(&self.speeds);
        let (equations, ground, closed) = (&self.equations, &self.ground, &self.closed);
        let rate = |tau: f64, y: &[f64], dy: &mut [f64]| {
            equations.rate(ground, now + tau, closed, y, dy);
        };
        let attempt = self.method.step(&rate, &self.y, h, &self.allowed);
        for ((end, y), increment) in self
            .end
            .iter_mut()
            .zip(&self.y)
            .zip(self.method.increment())
        {
            *end = y + increment;
        }
        (attempt.good, attempt.next)
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

    /// What falls to zero when the contact of gap `i` begins or ends, with slope and curvature
    /// in units of a step of `h` s. For an open gap that is the gap. For a contact it is what
    /// the gap lacks of [`Motion::parted`].
    fn jet(&self, y: &[f64], slope: &[f64], i: usize, h: f64) -> Jet {
        let n = self.equations.len();
        let (g, w, a) = (y[i], y[n + i], slope[n + i]);
        if self.closed[i] {
            [self.parted - g, -h * w, -h * h * a]
        } else {
            [g, h * w, h * h * a]
        }
    }

    /// What happens first in the step of `h` s last tried, leaving out gap `known`.
    fn first_change(&mut self, now: f64, h: f64, known: Option<usize>) -> First {
        let mut slope = std::mem::take(&mut self.end_slope);
        self.equations
            .rate(&self.ground, now + h, &self.closed, &self.end, &mut slope);
        let mut first = First::Nothing;
        let mut earliest = f64::INFINITY;
        for i in (0..self.equations.len()).filter(|&i| Some(i) != known) {
            let gap = HermiteQuintic::new(
                self.jet(&self.y, self.method.first(), i, h),
                self.jet(&self.end, &slope, i, h),
            );
            match gap.fall() {
                Crossing::At(at) if at < earliest => {
                    earliest = at;
                    first = First::Change(i, at);
                }
                Crossing::Perhaps
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

    /// The step to the change of gap `i`, or of another that comes first. `h` is about where it
    /// is, s, and it is not beyond `most`. Newton's method finds the length.
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
            // Where it only grazes zero there is no slope, and no better place.
            let small = change.abs() <= ROUNDING * h;
            if slope >= 0.0 || small || !(0.0..=most).contains(&(h + change)) {
                break;
            }
            h += change;
        }
        self.attempt(now, h);
        let mut ahead = self.step(h, next, Some(i));
        // The gap must be on the right side of zero whatever the rounding.
        ahead.y[i] = if self.closed[i] {
            ahead.y[i].max(self.parted)
        } else {
            ahead.y[i].min(0.0)
        };
        ahead
    }

    /// The flight to the next contact.
    fn flight(&self, now: f64) -> Ahead {
        let (gaps, rates) = (&self.y[..self.equations.len()], self.rates());
        let mut event = (f64::INFINITY, 0);
        for (i, (&g, &w)) in gaps.iter().zip(rates).enumerate() {
            let touch = self.ground.lasts(i, &Gap { g, w, t: now });
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

    /// The column `tau` s after `now`, if no contact acts until then.
    fn flown(&self, now: f64, tau: f64) -> Vec<f64> {
        let n = self.equations.len();
        let mut y = self.y.clone();
        for i in 0..n {
            let gap = Gap {
                g: y[i],
                w: y[n + i],
                t: now,
            };
            (y[i], y[n + i]) = self.ground.after(i, &gap, tau);
        }
        y
    }

    /// The column `tau` s after `now`, within the step ahead.
    pub fn glimpse(&mut self, now: f64, tau: f64, flight: bool) -> Vec<f64> {
        if flight {
            return self.flown(now, tau);
        }
        self.measure();
        self.attempt(now, tau);
        self.end.clone()
    }
}
