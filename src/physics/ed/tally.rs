//! Integrals over time of the column's height and energies, in closed form.
//!
//! The column is two bodies: the beads in flight, and those that ride the floor. Collisions
//! between beads do not act on the centre of mass of the first. Its E_r falls by what they
//! lose. So an event costs O(1), unless the floor acts.

use super::{Ed, Rule};
use crate::physics::ground::Ground;
use crate::physics::ledger::Sum;
use crate::physics::observation::{Energies, Integrals};
use crate::physics::plate::Plate;

/// Ticks of the ground after which the bodies are computed anew from the beads, which ends the
/// sum of rounding errors.
const AGE: f64 = 16.0;

/// The column as two bodies at a time of their own, and the integrals up to there.
#[derive(Debug, Clone, Copy, Default)]
pub(super) struct Tally {
    /// That time, s from the epoch.
    t: f64,
    /// Mass of the beads in flight.
    flying: f64,
    /// Mass of the beads that ride the floor.
    riding: f64,
    /// Σ m z and Σ m v of the beads in flight.
    moment: f64,
    momentum: f64,
    /// Their E_r about their own centre of mass.
    relative: f64,
    /// Since when that is so, s from the epoch.
    since: f64,
    /// The integral of it from `t` to `since`.
    warmth: f64,
    /// What the ledger had as lost then.
    lost: f64,
    /// How far the epoch has moved since the bodies were computed from the beads, s.
    aged: f64,
    /// Whether they have to be computed anew.
    stale: bool,
    /// ∫ Σ m z dt of the whole column.
    height: Sum,
    /// ∫ (Σ m v)² dt.
    squares: Sum,
    /// ∫ E_r dt.
    heat: Sum,
}

impl Tally {
    /// The integrals of Σ m z, of (Σ m v)² and of E_r over the `tau` s from `t` on. `plate` is
    /// the floor at `t`.
    fn ahead(&self, tau: f64, gravity: f64, plate: Plate) -> [f64; 3] {
        let Self {
            flying,
            riding,
            momentum,
            ..
        } = *self;
        let fall = gravity * tau;
        let height = tau * (self.moment + tau * (0.5 * momentum - flying * fall / 6.0));
        let warmth = self.warmth + self.relative * (self.t + tau - self.since);
        let speed = if flying > 0.0 { momentum / flying } else { 0.0 };
        let flown = tau * (speed * (speed - fall) + fall * fall / 3.0);
        if riding == 0.0 {
            return [height, flying * flying * flown, warmth];
        }
        let (ride, ridden) = plate.swept(tau);
        // ∫ v ż₀ dt of the velocities of both bodies, by parts.
        let start = plate.position();
        let risen = plate.later(tau).position() - start;
        let mixed = (speed - fall) * risen + gravity * (ride - start * tau);
        let squares = flying * (flying * flown + 2.0 * riding * mixed) + riding * riding * ridden;
        let apart = flying * riding / (flying + riding) * (flown - 2.0 * mixed + ridden);
        [
            height + riding * ride,
            squares,
            warmth + 0.5 * apart.max(0.0),
        ]
    }

    /// Notes what collisions have lost in all, up to `t`.
    #[inline]
    fn loses(&mut self, lost: f64, t: f64) {
        self.warmth += self.relative * (t - self.since);
        self.since = t;
        self.relative -= lost - self.lost;
        self.lost = lost;
    }
}

impl<G: Ground, R: Rule> Ed<G, R> {
    /// Integrates up to `t`, and moves both bodies there.
    pub(super) fn settle_tally(&mut self, t: f64) {
        if t == self.tally.t {
            return;
        }
        let plate = self.ground.plate(self.tally.t);
        let tally = &mut self.tally;
        let tau = t - tally.t;
        let [height, squares, heat] = tally.ahead(tau, self.column.gravity, plate);
        tally.height.add(height);
        tally.squares.add(squares);
        tally.heat.add(heat);
        tally.warmth = 0.0;
        (tally.t, tally.since) = (t, t);
        let fall = self.column.gravity * tau;
        tally.moment += tau * (tally.momentum - 0.5 * tally.flying * fall);
        tally.momentum -= tally.flying * fall;
    }

    /// The floor gives the column an impulse at `t`. Only a moving floor does work with it.
    pub(super) fn floor_acts(&mut self, impulse: f64, t: f64) {
        let mut work = 0.0;
        if G::MOVES {
            work = impulse * self.ground.plate(t).velocity();
            self.books.ledger.plate_work.add(work);
        }
        if !G::PULLS {
            return;
        }
        self.settle_tally(t);
        let tally = &mut self.tally;
        if tally.riding > 0.0 {
            tally.stale = true;
            return;
        }
        // E_r gets what of the work the centre of mass does not. What the collision loses is
        // taken from it in `keep_tally`.
        let of_centre = impulse * (tally.momentum + 0.5 * impulse) / tally.flying;
        tally.relative += work - of_centre;
        tally.momentum += impulse;
    }

    /// Other beads than before ride the floor from `t` on.
    pub(super) fn riders_change(&mut self, t: f64) {
        if G::PULLS {
            self.settle_tally(t);
            self.tally.stale = true;
        }
    }

    /// Follows the epoch, which has moved on.
    pub(super) fn shift_tally(&mut self, by: f64) {
        let tally = &mut self.tally;
        tally.t -= by;
        tally.since -= by;
        tally.aged += by;
        tally.stale |= tally.aged >= AGE * self.ground.tick();
    }

    /// Takes in an event: what it lost, and which beads ride now.
    #[inline]
    pub(super) fn keep_tally(&mut self) {
        if !G::PULLS {
            return;
        }
        let lost = self.books.ledger.lost.total();
        self.tally.loses(lost, self.now);
        if self.tally.stale {
            self.settle_tally(self.now);
            self.weigh();
        }
    }

    /// Computes both bodies from the beads, now.
    pub(super) fn weigh(&mut self) {
        let t = self.now;
        let plate = self.ground.plate(t);
        let (mut z, mut v) = (plate.position(), plate.velocity());
        let (mut mass, mut moment, mut mean, mut squares) = (0.0, 0.0, 0.0, 0.0);
        for (i, m) in self.column.masses.iter().enumerate() {
            let (g, w) = self.at(i, t);
            z += g;
            v += w;
            if i >= self.ground.riders() {
                mass += m;
                moment += m * z;
                // Welford's sums about the mean so far: beads of one velocity have no E_r.
                let off = v - mean;
                mean += off * m / mass;
                squares += m * off * (v - mean);
            }
        }
        self.tally = Tally {
            t,
            flying: mass,
            riding: self.stack_mass(),
            moment,
            momentum: mass * mean,
            relative: 0.5 * squares,
            since: t,
            warmth: 0.0,
            lost: self.books.ledger.lost.total(),
            aged: 0.0,
            stale: false,
            ..self.tally
        };
    }

    /// The integrals from the start to now; None without gravity.
    pub(super) fn integrals(&self) -> Option<Integrals> {
        let tally = &self.tally;
        let plate = self.ground.plate(tally.t);
        let [height, squares, heat] = tally.ahead(self.now - tally.t, self.column.gravity, plate);
        let mass = tally.flying + tally.riding;
        G::PULLS.then(|| Integrals {
            height: tally.height.with(height) / mass,
            energies: Some(Energies {
                squares: tally.squares.with(squares) / (mass * mass),
                relative: tally.heat.with(heat),
            }),
        })
    }
}
