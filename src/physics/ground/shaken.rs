//! Flight over a vibrating plate, and rest on it.

use std::f64::consts::{PI, TAU};

use super::{Ground, first_root, power_of_two};
use crate::math;
use crate::physics::ledger::Sum;
use crate::physics::plate::Plate;

/// Nothing takes off up to this α. Just above 1 the plate falls away for so short a time that
/// rounding hides it, and a bead would take off and come to rest again without end.
const BARELY: f64 = 1.0 + 1e-9;

/// A vibrating plate under gravity.
#[derive(Clone)]
pub(crate) struct Shaken {
    gravity: f64,
    /// The plate as it was `since` s before the epoch.
    plate: Plate,
    since: Sum,
    /// Aω², m/s².
    shake: f64,
    /// Phase asin(1/α) at which a resting bead takes off; None when α ≤ 1.
    take_off: Option<f64>,
    /// About a period, s.
    tick: f64,
    riders: usize,
}

/// A bead that falls freely over the plate. It had gap `g` and rate `w` at τ = 0.
#[derive(Clone)]
struct Fall {
    g: f64,
    w: f64,
    gravity: f64,
    omega: f64,
    /// A sin θ and A cos θ at τ = 0.
    sin: f64,
    cos: f64,
}

impl Fall {
    /// Gap, m, and rate, m/s, at τ. At small τ what cancels is left out, so that no digits are
    /// lost.
    fn at(&self, tau: f64) -> (f64, f64) {
        let x = self.omega * tau;
        if x < 0.5 {
            let a = self.sin * self.omega * self.omega - self.gravity;
            let (sine, cosine) = beyond_taylor(x);
            let g = self.g + (self.w + 0.5 * a * tau) * tau - self.sin * cosine + self.cos * sine;
            // The derivative of x²/2 − (1 − cos x) is x − sin x, whose derivative is 1 − cos x.
            let w = self.w
                + a * tau
                + self.omega * (self.cos * (0.5 * x * x - cosine) - self.sin * sine);
            return (g, w);
        }
        let (sin, cos) = math::sin_cos(x);
        let (plate, speed) = (
            self.sin * cos + self.cos * sin,
            self.omega * (self.cos * cos - self.sin * sin),
        );
        let (h, v) = self.height();
        (
            h + (v - 0.5 * self.gravity * tau) * tau - plate,
            v - self.gravity * tau - speed,
        )
    }

    /// Height over the plate's centre and velocity, at τ = 0.
    fn height(&self) -> (f64, f64) {
        (self.sin + self.g, self.omega * self.cos + self.w)
    }

    /// Size of the terms whose sum the gap at τ is, m: its rounding is a bit of this.
    fn size(&self, tau: f64) -> f64 {
        let (h, v) = self.height();
        h.abs() + (v.abs() + 0.5 * self.gravity * tau) * tau + math::hypot(self.sin, self.cos)
    }
}

/// x − sin x and x²/2 − (1 − cos x) for 0 ≤ x ≤ ½, to full relative precision, by their
/// Taylor series.
fn beyond_taylor(x: f64) -> (f64, f64) {
    let xx = x * x;
    let nested = |divisors: [f64; 6]| divisors.iter().rev().fold(1.0, |sum, d| 1.0 - xx / d * sum);
    let sine = x * xx / 6.0 * nested([20.0, 42.0, 72.0, 110.0, 156.0, 210.0]);
    let cosine = xx * xx / 24.0 * nested([30.0, 56.0, 90.0, 132.0, 182.0, 240.0]);
    (sine, cosine)
}

/// Writes the Taylor coefficients in s of a sin(θ + xs), where `sin` and `cos` are those of θ.
fn oscillation(a: f64, sin: f64, cos: f64, x: f64, into: &mut [f64]) {
    let mut size = a;
    let mut quarter = [sin, cos, -sin, -cos].into_iter().cycle();
    for (k, c) in into.iter_mut().enumerate() {
        *c = size * quarter.next().unwrap_or_default();
        size *= x / (k + 1) as f64;
    }
}

impl Shaken {
    pub fn new(gravity: f64, plate: Plate) -> Self {
        let shake = plate.shake();
        let take_off = (shake > gravity * BARELY).then(|| math::asin(gravity / shake));
        let tick = power_of_two(TAU / plate.omega);
        Self {
            gravity,
            plate,
            since: Sum::default(),
            shake,
            take_off,
            tick,
            riders: 0,
        }
    }

    /// Phase of the plate at `t`, in [0, 2π).
    fn phase(&self, t: f64) -> f64 {
        (self.plate.phase + self.plate.omega * (self.since.total() + t)).rem_euclid(TAU)
    }

    fn falling(&self, t0: f64, g: f64, w: f64) -> Fall {
        let (sin, cos) = math::sin_cos(self.phase(t0));
        let Plate {
            amplitude, omega, ..
        } = self.plate;
        Fall {
            g,
            w,
            gravity: self.gravity,
            omega,
            sin: amplitude * sin,
            cos: amplitude * cos,
        }
    }

    /// How long from `t0` on the plate falls away faster than g, s; 0 if it does not.
    fn window(&self, t0: f64) -> f64 {
        let Some(take_off) = self.take_off else {
            return 0.0;
        };
        let phase = self.phase(t0);
        // A bead that has just taken off is at the beginning of this, but for a rounding.
        let inside = phase > take_off - 1e-12 && phase < PI - take_off;
        if inside {
            (PI - take_off - phase) / self.plate.omega
        } else {
            0.0
        }
    }

    /// Between which times τ a bead is higher than the plate can rise. It has height `h` over
    /// the plate's centre and velocity `v` at τ = 0. None if it never is.
    fn out_of_reach(&self, h: f64, v: f64) -> Option<(f64, f64)> {
        let discriminant = v * v + 2.0 * self.gravity * (h - self.plate.amplitude);
        (discriminant > 0.0).then(|| {
            let root = discriminant.sqrt();
            ((v - root) / self.gravity, (v + root) / self.gravity)
        })
    }
}

impl Ground for Shaken {
    const PULLS: bool = true;
    const MOVES: bool = true;

    fn riders(&self) -> usize {
        self.riders
    }

    fn set_riders(&mut self, riders: usize) {
        self.riders = riders;
    }

    fn gravity(&self) -> f64 {
        self.gravity
    }

    fn fall(&self, t0: f64, g: f64, w: f64, t: f64) -> (f64, f64) {
        self.falling(t0, g, w).at(t - t0)
    }

    /// Conservative advancement. The gap's acceleration is at least −M, M = g + Aω², so it
    /// cannot close before the first root of gap + rate τ − Mτ²/2. A step to there never passes
    /// a hit, not even a grazing one. Steps converge quadratically unless the hit is grazing.
    fn hit(&self, t0: f64, g: f64, w: f64) -> f64 {
        if g <= 0.0 && w < 0.0 {
            return t0;
        }
        let fall = self.falling(t0, g.max(0.0), w);
        let most = self.gravity + self.shake;
        let (h, v) = fall.height();
        let above = self.out_of_reach(h, v);
        let mut tau = if w >= 0.0 { self.window(t0) } else { 0.0 };
        loop {
            if let Some((rise, sink)) = above
                && tau > rise
                && tau < sink
            {
                tau = sink;
            }
            let (gap, rate) = fall.at(tau);
            if gap <= 4.0 * f64::EPSILON * fall.size(tau) && rate <= 0.0 {
                return t0 + tau;
            }
            let next = tau + first_root(gap.max(0.0), rate, most);
            if next <= tau {
                return t0 + tau;
            }
            tau = next;
        }
    }

    fn pressing(&self, t: f64) -> f64 {
        let pressing = self.gravity - self.shake * math::sin(self.phase(t));
        // Where nothing takes off it is positive, but for rounding.
        if self.take_off.is_some() {
            pressing
        } else {
            pressing.max(f64::MIN_POSITIVE)
        }
    }

    fn take_off(&self, t: f64) -> f64 {
        let Some(take_off) = self.take_off else {
            return f64::INFINITY;
        };
        let phase = self.phase(t);
        if phase >= take_off && phase < PI - take_off {
            return t;
        }
        t + (take_off - phase).rem_euclid(TAU) / self.plate.omega
    }

    fn plate(&self, t: f64) -> Plate {
        Plate {
            phase: self.phase(t),
            ..self.plate
        }
    }

    fn tick(&self) -> f64 {
        self.tick
    }

    fn move_epoch(&mut self, by: f64) {
        self.since.add(by);
        // The phase is rounded only here, about once a period.
        if self.since.total() >= self.tick {
            self.plate = self.plate.later(self.tick);
            self.since.add(-self.tick);
        }
    }

    fn set_plate(&mut self, plate: Plate) {
        (self.plate, self.since) = (plate, Sum::default());
    }

    fn pull(&self, t: f64, h: f64, into: &mut [f64]) {
        let (sin, cos) = math::sin_cos(self.phase(t));
        oscillation(self.shake, sin, cos, self.plate.omega * h, into);
        into[0] -= self.gravity;
    }

    fn motion(&self, t: f64, h: f64, into: &mut [f64]) {
        let (sin, cos) = math::sin_cos(self.phase(t));
        let fastest = self.plate.amplitude * self.plate.omega;
        oscillation(fastest, cos, -sin, self.plate.omega * h, into);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shaken(alpha: f64) -> Shaken {
        let omega = TAU * 20.0;
        let amplitude = alpha * 9.81 / (omega * omega);
        Shaken::new(
            9.81,
            Plate {
                amplitude,
                omega,
                ..Plate::default()
            },
        )
    }

    #[test]
    fn series_and_closed_forms_meet() {
        for x in [0.5_f64, 0.3, 0.1] {
            let (sine, cosine) = beyond_taylor(x);
            // 1e-16 of the terms that cancel in the closed forms.
            assert!((sine - (x - x.sin())).abs() < 2e-16);
            assert!((cosine - (0.5 * x * x - (1.0 - x.cos()))).abs() < 2e-16);
        }
        // Both branches of the fall, on either side of their border.
        let fall = shaken(2.0).falling(0.01, 1e-4, 0.1);
        let border = 0.5 / fall.omega;
        let (below, above) = (fall.at(border * (1.0 - 1e-15)), fall.at(border));
        assert!((below.0 - above.0).abs() < 1e-17 && (below.1 - above.1).abs() < 1e-14);
    }

    #[test]
    fn no_hit_is_missed() {
        // Independent method: the first sign change on a fine grid. A graze between two
        // grid points may be found only by `hit`, never the other way round.
        let mut random = 7_u64;
        let mut uniform = move || {
            random = random
                .wrapping_mul(6_364_136_223_846_793_005)
                .wrapping_add(1_442_695_040_888_963_407);
            (random >> 11) as f64 / (1_u64 << 53) as f64
        };
        for alpha in [0.5, 1.0, 1.3, 2.0, 5.0, 30.0, 1000.0] {
            let ground = shaken(alpha);
            let speed = ground.plate.amplitude * ground.plate.omega;
            for _ in 0..200 {
                let t0 = uniform() * 0.05;
                let g = uniform()
                    * 2.0
                    * ground.plate.amplitude
                    * if uniform() < 0.3 { 1e-6 } else { 1.0 };
                let w = (uniform() - 0.5) * 4.0 * speed;
                let found = ground.hit(t0, g, w) - t0;
                let fall = ground.falling(t0, g, w);
                let (gap, rate) = fall.at(found);
                // The time of a hit is rounded to 2⁻⁵³ of itself, the terms of the gap too.
                let rounding = 1e-14 * (fall.size(found) + rate.abs() * (t0 + found));
                assert!(
                    gap.abs() < rounding && rate < 1e-9,
                    "α {alpha}: {gap} {rate}"
                );
                let grid = 40_000;
                let early = (1..grid).map(|k| found * f64::from(k) / f64::from(grid));
                for tau in early {
                    assert!(
                        fall.at(tau).0 > -rounding,
                        "α {alpha}: inside the plate at {tau}"
                    );
                }
            }
        }
    }
}
