//! Going back and forth in what was.

use std::time::{Duration, Instant};

use super::Worker;
use crate::live::past::{Count, Position};
use crate::live::runner::Runner;
use crate::live::{Leap, Way};

/// Looking for something that happens may take so long.
const SEARCH: Duration = Duration::from_secs(2);
/// The first stretch in which it is looked for, as a part of the time between two samples.
const FIRST_STRETCH: f64 = 1.0 / 16.0;

impl Worker {
    /// Stands still, and goes there.
    pub(super) fn leap(&mut self, leap: Leap) {
        // Keys that come faster than they are followed add up.
        let from = if self.is_travelling() {
            self.clock.goal()
        } else {
            self.position.reached
        };
        self.set_running(false);
        match leap {
            Leap::By(time) => self.travel(from + time),
            Leap::To(time) => self.travel(time),
            Leap::End => self.travel(self.past.end()),
            Leap::Period(way) => {
                let scene = self.position.runners.first().map(Runner::scene);
                match (scene.and_then(|scene| scene.period()), way) {
                    (Some(period), Way::Back) => self.travel(from - period),
                    (Some(period), Way::On) => self.travel(from + period),
                    (None, _) => self.notes.push("no plate here, and no period".into()),
                }
            }
            Leap::Change(way) => self.travel_to(Count::Changes, way),
            Leap::Landing(way) => self.travel_to(Count::Landings, way),
        }
    }

    /// Whether it is on its way to another time than the one it is asked to show.
    pub(super) fn is_travelling(&self) -> bool {
        self.paused && self.position.reached < self.clock.goal()
    }

    /// Goes to `time`, s, as far as that is not before the start.
    fn travel(&mut self, time: f64) {
        let time = time.max(0.0);
        let here = self.position.reached;
        let moment = self.past.at(time);
        if time < here && moment.is_none() {
            let why = "so many beads leave no room to go back: more --memory would help";
            self.notes.push(why.into());
            return;
        }
        let closer = |moment: &&Position| time < here || moment.reached > here;
        if let Some(moment) = moment.filter(closer) {
            self.position = moment.clone();
            self.under_way = None;
            self.sought.get_or_insert_with(Instant::now);
        }
        self.clock.ask_for(time);
    }

    fn travel_to(&mut self, what: Count, way: Way) {
        let deadline = Instant::now() + SEARCH;
        // What the columns are on their way to has not happened yet.
        self.bring_to_goal(deadline);
        let found = match way {
            Way::Back => self.last(what, deadline),
            Way::On => self.next(what, deadline),
        };
        match found {
            Ok(time) => self.travel(time),
            Err(why) => self.notes.push(why.to_owned()),
        }
    }

    /// Goes to so long before the next landing, s, unless that is past.
    pub(super) fn leap_before_landing(&mut self, lead: f64) {
        let deadline = Instant::now() + SEARCH;
        self.set_running(false);
        self.bring_to_goal(deadline);
        match self.next(Count::Landings, deadline) {
            Ok(time) => {
                let here = self.position.reached;
                self.travel((time - lead).max(here));
                // What comes before is not drawn.
                self.sought.get_or_insert_with(Instant::now);
            }
            Err(why) => self.notes.push(why.to_owned()),
        }
    }

    /// Goes all the way to where it is on its way to, if there is time.
    pub(super) fn bring_to_goal(&mut self, deadline: Instant) {
        let goal = self.clock.goal();
        let mut position = std::mem::take(&mut self.position);
        self.bring(&mut position, goal, deadline);
        position.look();
        self.position = position;
    }

    /// When something last happened before now, s.
    fn last(&mut self, what: Count, deadline: Instant) -> Result<f64, &'static str> {
        let now = self.position.reached;
        let Some(mut before) = self.past.at(now.next_down()).cloned() else {
            return Err("this is the start");
        };
        if !self.bring(&mut before, now.next_down(), deadline) {
            return Err(LONG);
        }
        before.look();
        let count = before.count(what);
        match self.past.before(what, count) {
            Some((moment, next)) => {
                let (low, high) = (moment.clone(), next.unwrap_or(now).min(now.next_down()));
                self.first(what, count, low, high, deadline)
            }
            // Nothing happened since the start.
            None => Ok(0.0),
        }
    }

    /// When something happens next, s.
    fn next(&mut self, what: Count, deadline: Instant) -> Result<f64, &'static str> {
        let count = self.position.count(what) + 1;
        let mut low = self.position.clone();
        let known = self.past.before(what, count);
        if let Some((moment, next)) = known {
            if moment.reached > low.reached {
                low = moment.clone();
            }
            if let Some(high) = next.filter(|next| *next > low.reached) {
                return self.first(what, count, low, high, deadline);
            }
        }
        // It has not happened yet as far as moments tell: it is simulated ahead.
        let mut stretch = FIRST_STRETCH * self.sweep.interval();
        loop {
            let mut high = low.clone();
            let event = high.runners.iter_mut().filter_map(Runner::next_event);
            let event = event.fold(f64::INFINITY, f64::min);
            let until = (low.reached + stretch).min(event.max(low.reached.next_up()));
            if !self.bring(&mut high, until, deadline) {
                return Err(LONG);
            }
            high.look();
            if high.count(what) >= count {
                return self.first(what, count, low, until, deadline);
            }
            if high.runners.iter_mut().all(Runner::is_over) {
                return Err("nothing of the kind is to come");
            }
            (low, stretch) = (high, 2.0 * stretch);
        }
    }

    /// The first time after `low` at which something has happened `count` times; by `high`,
    /// s, it has.
    fn first(
        &mut self,
        what: Count,
        count: u64,
        mut low: Position,
        mut high: f64,
        deadline: Instant,
    ) -> Result<f64, &'static str> {
        loop {
            let middle = low.reached.midpoint(high);
            if middle <= low.reached || middle >= high {
                return Ok(high);
            }
            let mut between = low.clone();
            if !self.bring(&mut between, middle, deadline) {
                return Err(LONG);
            }
            between.look();
            if between.count(what) >= count {
                high = middle;
            } else {
                low = between;
            }
        }
    }

    /// Brings columns to `until`, s, with the edits on the way; whether there was time.
    fn bring(&mut self, position: &mut Position, until: f64, deadline: Instant) -> bool {
        loop {
            let edit = self.past.edit_after(position.edits);
            let edit = edit.map_or(f64::INFINITY, |edit| edit.time);
            let goal = until.min(edit);
            while !position.advance(goal) {
                if Instant::now() >= deadline {
                    return false;
                }
            }
            position.reached = position.reached.max(goal);
            if edit > until {
                return true;
            }
            self.make_again(position);
        }
    }
}

/// Why a search was given up.
const LONG: &str = "looked for it for two seconds, and stays here";
