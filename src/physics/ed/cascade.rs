//! What happens at one instant: a collision, those of all beads that touch, and what rests
//! afterwards.

use super::{Ed, Gap, Rule};
use crate::physics::EngineError;
use crate::physics::column::{totally_inelastic, velocities};
use crate::physics::ground::Ground;
use crate::physics::matter::translation;
use crate::physics::shell::Mover;

/// Collisions after which a cascade is left for a pause. A caller with a budget then does not
/// have to wait for the end of a long one.
const PAUSE: i32 = 20_000;

impl<G: Ground, R: Rule> Ed<G, R> {
    /// Gap `i` closes at time `t`: its collision, those of the beads in contact with
    /// it, and what comes to rest.
    pub(super) fn collide_at(&mut self, i: usize, t: f64) -> Result<(), EngineError> {
        if self.pair_meets(i, t) {
            return Ok(());
        }
        self.sync(i, t);
        self.gaps[i].g = 0.0;
        if !self.gaps[i].w.is_finite() {
            let what = "a relative velocity is not finite";
            return Err(EngineError::Lost {
                time: self.absolute(t),
                bead: i + 1,
                what,
            });
        }
        let (low, high) = self.touching_block(i, t);
        if low == 0 {
            self.floor_contact_begins(t);
        }
        self.cascades += 1;
        self.cascade(low, high, t);
        Ok(())
    }

    /// Goes on with the cascade of the touching gaps from `low` to `high`, to its end or to a
    /// pause.
    pub(super) fn cascade(&mut self, low: usize, high: usize, t: f64) {
        if !self.largest_velocity_first(low, high, t) {
            self.paused = Some((low, high));
            return;
        }
        self.paused = None;
        self.stick(low, high, t);
        if low == 0 {
            self.settle_on_floor(high, t);
        }
        self.note(low, high, t);
        self.schedule(low.saturating_sub(1), (high + 1).min(self.gaps.len() - 1));
        if low == 0 {
            self.schedule_take_off();
        }
    }

    /// The first and the last of the touching gaps around `i`. They are brought to time `t`,
    /// and so is the next gap on either side, whose rate the cascade changes too.
    fn touching_block(&mut self, i: usize, t: f64) -> (usize, usize) {
        let (mut low, mut high) = (i, i);
        while low > 0 {
            self.sync(low - 1, t);
            if self.gaps[low - 1].g > 0.0 {
                break;
            }
            low -= 1;
        }
        while high + 1 < self.gaps.len() {
            self.sync(high + 1, t);
            if self.gaps[high + 1].g > 0.0 {
                break;
            }
            high += 1;
        }
        (low, high)
    }

    /// The largest relative velocity goes first (LRV, Sec. II B): of all touching pairs the
    /// one that approaches fastest collides, until none approaches. False where a pause comes
    /// first.
    fn largest_velocity_first(&mut self, low: usize, high: usize, t: f64) -> bool {
        if low == high {
            if self.gaps[low].w < -self.closing.speed {
                self.collide(low, t);
            }
            return true;
        }
        for j in low..=high {
            self.approach.write(j, self.gaps[j].w);
        }
        self.approach.play_again(low, high);
        let most = self.closing.cascade(&self.pairs[low..=high]);
        let mut done = false;
        for _ in 0..most.unwrap_or(PAUSE) {
            let (j, w) = self.approach.first();
            done = w >= -self.closing.speed;
            if done {
                break;
            }
            self.collide(j, t);
            let (first, last) = (j.saturating_sub(1).max(low), (j + 1).min(high));
            for k in first..=last {
                self.approach.write(k, self.gaps[k].w);
            }
            self.approach.play_again(first, last);
        }
        for j in low..=high {
            self.approach.write(j, f64::INFINITY);
        }
        self.approach.play_again(low, high);
        done || most.is_some()
    }

    /// The beads at gap `j` collide at `t`, to which they and their neighbours are brought.
    fn collide(&mut self, j: usize, t: f64) {
        let w = self.gaps[j].w;
        let elastic = self.rule.elastic(j.checked_sub(1), j, t);
        let pair = self.pairs[j];
        let (after, change, lost) = pair.collide(w, elastic);
        self.gaps[j].w = after;
        if j + 1 < self.gaps.len() {
            self.gaps[j + 1].w -= change * pair.above;
        }
        if j > 0 {
            self.gaps[j - 1].w -= change * pair.below;
        } else {
            self.floor_acts(pair.reduced * change, t);
        }
        self.books.ledger.lost.add(lost);
        self.books.events += 1;
        self.collided[j] = self.cascades;
    }

    /// Closes the cascade: touching beads that still approach go on together, with their
    /// momentum.
    fn stick(&mut self, low: usize, high: usize, t: f64) {
        if self.gaps[low..=high].iter().all(|gap| gap.w >= 0.0) {
            return;
        }
        self.books.closed += 1;
        // Velocities relative to the floor, or to the lowest bead of the block.
        let first = low.saturating_sub(1);
        let on_floor = low == 0;
        let lowest = (!on_floor).then_some(0.0);
        let rates = self.gaps[low..=high].iter().map(|gap| gap.w);
        let before = velocities(lowest.into_iter().chain(rates));
        let mut after = before.clone();
        totally_inelastic(&mut after, &self.column.masses[first..=high], on_floor);
        self.set_velocities(first, on_floor, &before, &after, t);
    }

    /// Gives the beads from `first` on the velocities `after` in place of `before`, and books
    /// the difference. Both are relative to one body, the floor where it takes part.
    fn set_velocities(
        &mut self,
        first: usize,
        on_floor: bool,
        before: &[f64],
        after: &[f64],
        t: f64,
    ) {
        let (mut lost, mut momentum) = (0.0, 0.0);
        for (k, (u, v)) in before.iter().zip(after).enumerate() {
            let (bead, change) = (first + k, v - u);
            let m = self.column.masses[bead];
            lost -= 0.5 * m * change * (u + v);
            momentum += m * change;
            // Beads that got the same velocity must not part by a rounding.
            let together = if k == 0 {
                on_floor && *v == 0.0
            } else {
                after[k - 1] == *v
            };
            self.gaps[bead].w = if together {
                0.0
            } else {
                self.gaps[bead].w + change
            };
            if bead + 1 < self.gaps.len() {
                self.gaps[bead + 1].w -= change;
            }
        }
        self.books.ledger.lost.add(lost);
        // Without the floor no momentum is gained.
        if on_floor {
            self.floor_acts(momentum, t);
        }
    }

    /// Finds which beads of a block on the floor rest now, from below. A bead that leaves at
    /// rate u rests when all its bounces to come, which last 2u/(a(1 − ε)), are shorter than the
    /// rest time; a is what presses it onto the floor.
    fn settle_on_floor(&mut self, high: usize, t: f64) {
        let pressing = if G::PULLS {
            self.ground.pressing(t)
        } else {
            0.0
        };
        let mut stack = 0;
        if pressing > 0.0 {
            for j in 0..=high {
                let slowest =
                    0.5 * self.closing.rest_time * pressing * (1.0 - self.pairs[j].restitution);
                if self.gaps[j].w > slowest {
                    break;
                }
                self.rest(j, t);
                stack = j + 1;
            }
        }
        if stack != self.ground.riders() {
            self.set_stack(stack, t);
        }
        if stack == self.gaps.len() {
            self.books.bounce.rest();
        }
    }

    /// Bead `j`, which leaves the resting stack very slowly, stays on it.
    fn rest(&mut self, j: usize, t: f64) {
        let w = self.gaps[j].w;
        self.gaps[j] = Gap { g: 0.0, w: 0.0, t };
        if w != 0.0 {
            let m = self.column.masses[j];
            if j + 1 < self.gaps.len() {
                self.gaps[j + 1].w += w;
            }
            self.books.ledger.lost.add(0.5 * m * w * w);
            self.floor_acts(-m * w, t);
        }
    }

    /// Begins a bounce of the whole column, if the floor's contact is new and it arrives.
    fn floor_contact_begins(&mut self, t: f64) {
        let books = &self.books;
        let new = !books.contacts.closed()[0] && !books.bounce.has_arrived();
        if new && self.translation(t) < 0.0 {
            let arrival = self.arrival_now();
            self.books.bounce.begin(arrival);
        }
    }

    /// [`Arrival::translation`](crate::physics::bounce::Arrival) at time `t`.
    fn translation(&self, t: f64) -> f64 {
        let rates = (0..self.gaps.len()).map(|i| self.at(i, t).1);
        translation(rates, &self.column.masses)
    }

    /// Notes which contacts of a block began, ended, or did both.
    fn note(&mut self, low: usize, high: usize, t: f64) {
        let time = self.absolute(t);
        let floor_was_closed = self.books.contacts.closed()[0];
        for j in low..=high {
            let collided = self.collided[j] == self.cascades;
            let together = self.gaps[j].w == 0.0;
            let contacts = &mut self.books.contacts;
            match (together, collided) {
                (true, _) => contacts.note(j, true, time),
                (false, true) => contacts.touch(j, time),
                (false, false) => contacts.note(j, false, time),
            }
        }
        // The next gap on either side has opened, if it was a contact.
        for j in [low.checked_sub(1), Some(high + 1)].into_iter().flatten() {
            if j < self.gaps.len() && self.gaps[j].w != 0.0 {
                self.books.contacts.note(j, false, time);
            }
        }
        let floor_hit = low == 0 && (floor_was_closed || self.collided[0] == self.cascades);
        if floor_hit && !self.books.contacts.closed()[0] {
            let translation = self.translation(t);
            self.books.bounce.end(translation);
        }
    }
}
