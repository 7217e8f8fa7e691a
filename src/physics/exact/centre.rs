//! The integral over time of the column's height, in closed form.
//!
//! Beads push each other without moving their centre of mass: it falls freely but for
//! the floor's push, whose moments the plans of the floor's cluster give.

use super::cluster::Plan;
use super::{Exact, Mode, PADDING};
use crate::physics::flight::Ground;
use crate::physics::ledger::Sum;
use crate::physics::observation::Integrals;

/// Moves of the epoch after which rounding errors are ended.
const AGE: u32 = 64;

/// The centre of mass at a time of its own, and the integral of its height up to there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Centre {
    /// s from the epoch; not after that of the lowest gap where the floor pushes.
    pub t: f64,
    /// Moves of the epoch since the column was weighed.
    aged: u32,
    mass: f64,
    /// Σ m z and Σ m v.
    moment: f64,
    momentum: f64,
    /// ∫ Σ m z dt.
    height: Sum,
}

impl Centre {
    /// Falls for `tau` s.
    fn fall(&mut self, tau: f64, gravity: f64) {
        let (pull, p) = (self.mass * gravity * tau, self.momentum);
        self.height
            .add(tau * (self.moment + tau * (0.5 * p - pull / 6.0)));
        self.moment += tau * (p - 0.5 * pull);
        self.momentum -= pull;
        self.t += tau;
    }

    /// What a push of Σ f_k (τ/tau)^k adds over the last `tau` s.
    fn pushed(&mut self, tau: f64, push: &[f64]) {
        let (mut moments, mut k) = ([0.0; 3], 0.0);
        for f in push {
            let once = f / (k + 1.0);
            let twice = once / (k + 2.0);
            moments[0] += once;
            moments[1] += twice;
            moments[2] += twice / (k + 3.0);
            k += 1.0;
        }
        self.momentum += tau * moments[0];
        self.moment += tau * tau * moments[1];
        self.height.add(tau * tau * tau * moments[2]);
    }
}

impl<G: Ground> Exact<G> {
    /// The centre of mass at `t`, within the plan of the floor's cluster, whose gaps and
    /// rates are these then.
    pub(super) fn centre_at(&self, t: f64, gaps: &[f64], rates: &[f64]) -> Centre {
        let mut centre = self.centre;
        if self.modes[0] != Mode::Pushing {
            centre.fall(t - centre.t, self.gravity);
            return centre;
        }
        let t0 = self.gaps[0].t;
        centre.fall(t0 - centre.t, self.gravity);
        match self.plans[0] {
            Plan::Landing => return self.carried(&centre, t, &gaps[..1], rates),
            Plan::Rest => {
                return self.carried(&centre, t, &gaps[..self.beads_at_rest()], rates);
            }
            Plan::Series { h, reach, .. } => {
                let s = self.progress(0, t, h, reach);
                let push = self.series(0, h).force(0, self.springs[0], 1.0, s);
                centre.fall(s * h, self.gravity);
                centre.pushed(s * h, &push);
                centre.t = t;
            }
            Plan::Flight | Plan::Encounter(_) => {}
        }
        centre
    }

    /// Takes the centre on to `t` with the beads above these gaps, whose contacts go on
    /// pushing below them and not above, while the others fall. By F_i = −(K_i g_i + c_i ġ_i), and
    /// F_i being what the beads from i to the stack's top gain in momentum, the integrals
    /// of the gaps follow from both ends.
    fn carried(&self, centre: &Centre, t: f64, gaps: &[f64], rates: &[f64]) -> Centre {
        let m = gaps.len();
        let t0 = self.gaps[0].t;
        let tau = t - t0;
        let from = self.ground.plate(t0);
        // Places and velocities of a bead at both ends.
        let mut before = from.motion();
        let mut after = if G::MOVES {
            self.ground.plate(t).motion()
        } else {
            before
        };
        let (mut others, mut stack) = (*centre, Centre::default());
        let mut gained = vec![0.0; m];
        for i in 0..m {
            before = (before.0 + self.gaps[i].g, before.1 + self.gaps[i].w);
            after = (after.0 + gaps[i], after.1 + rates[i]);
            let bead = self.masses[i];
            others.mass -= bead;
            others.moment -= bead * before.0;
            others.momentum -= bead * before.1;
            stack.mass += bead;
            stack.moment += bead * after.0;
            stack.momentum += bead * after.1;
            gained[i] = bead * (after.1 - before.1 + self.gravity * tau);
        }
        others.fall(tau, self.gravity);
        let mut height = stack.mass * from.swept(tau).0;
        let (mut push, mut above) = (0.0, 0.0);
        for i in (0..m).rev() {
            push += gained[i];
            above += self.masses[i];
            let spring = self.springs[i];
            let damped = spring.dashpot * (gaps[i] - self.gaps[i].g);
            height -= above * (push + damped) / spring.stiffness;
        }
        others.height.add(height);
        Centre {
            t,
            aged: centre.aged,
            mass: centre.mass,
            moment: others.moment + stack.moment,
            momentum: others.momentum + stack.momentum,
            height: others.height,
        }
    }

    /// The epoch has moved on by `shift`. Now and then the column is weighed anew, if it
    /// flies: rounding errors end with that.
    pub(super) fn shift_centre(&mut self, shift: f64) {
        self.centre.t -= shift;
        self.centre.aged = self.centre.aged.saturating_add(1);
        let due = G::PULLS && self.centre.aged >= AGE;
        if !due || !self.state.books.contacts.all_open() {
            return;
        }
        self.centre = self.weighed(self.centre_now().height);
    }

    /// The centre of mass now.
    fn centre_now(&self) -> Centre {
        let room = || vec![0.0; self.end[0] + PADDING];
        let (mut gaps, mut rates) = (room(), room());
        self.at(0, self.now, &mut gaps, &mut rates);
        self.centre_at(self.now, &gaps, &rates)
    }

    /// The centre of mass now, with this integral so far.
    pub(super) fn weighed(&self, height: Sum) -> Centre {
        let plate = self.ground.plate(self.now);
        let (gaps, rates) = self.gaps_and_rates(self.now);
        let (mut z, mut v) = (plate.position(), plate.velocity());
        let mut centre = Centre {
            t: self.now,
            height,
            ..Centre::default()
        };
        for ((g, w), m) in gaps.iter().zip(&rates).zip(&self.masses) {
            z += g;
            v += w;
            centre.mass += m;
            centre.moment += m * z;
            centre.momentum += m * v;
        }
        centre
    }

    /// The integral since the start, up to now; none without gravity.
    pub(super) fn integrals(&self) -> Option<Integrals> {
        G::PULLS.then(|| {
            let centre = self.centre_now();
            Integrals {
                height: centre.height.total() / centre.mass,
                energies: None,
            }
        })
    }
}
