//! What the columns are of: starts and edits, and the shadows with them.

use std::time::{Duration, Instant};

use super::{Worker, note_once};
use crate::live::past::Position;
use crate::live::runner::{Build, Runner};
use crate::live::shadow::Shadow;
use crate::physics::State;
use crate::scene::Scene;
use crate::tape::{Edit, sources};

/// Columns are brought to one time before an edit for so long at most.
const ALIGN: Duration = Duration::from_secs(2);

impl Worker {
    pub(super) fn restart(&mut self, scenes: Vec<Scene>) {
        let build = &mut self.build;
        let runners = scenes
            .into_iter()
            .map(|scene| Runner::new(build, scene, None, 0.0))
            .collect();
        self.position = Position {
            runners,
            ..Position::default()
        };
        (self.under_way, self.held, self.sought) = (None, false, None);
        self.clock.stand_at(0.0, Instant::now());
        self.history.clear();
        self.past.begin(&self.position);
        self.played = None;
        let (scenes, every) = (self.position.scenes(), self.marks_apart());
        self.write(|written, _| written.start(&scenes, every));
        self.sample();
    }

    /// Makes an edit now; what was known to come later is forgotten.
    pub(super) fn edit(&mut self, scenes: Vec<Scene>, from: Vec<usize>) {
        self.align();
        let forked = self.past.fork(&self.position);
        if let Some(later) = forked.filter(|later| *later > 0.0) {
            self.notes.push(format!(
                "going on from here: {later:.3} s that came after are dropped"
            ));
        }
        if let Some(played) = &mut self.played {
            played.fork(&self.position);
        }
        let (time, edits) = (self.position.reached, self.position.edits);
        let edit = Edit { time, scenes, from };
        if !change(&mut self.build, &mut self.position, &edit) {
            self.restart(edit.scenes);
            self.notes
                .push("no running column to go on from: started again".into());
            return;
        }
        let mut columns = self.position.runners.iter_mut();
        if let Some(note) = columns.find_map(Runner::take_plate_note) {
            note_once(&mut self.notes, note);
        }
        self.write(|written, _| written.edit(&edit, edits, forked.is_some()));
        self.past.edit(edit);
        self.past.keep(&self.position);
    }

    /// Brings the columns to one time: to that which they are on their way to, or to the one
    /// that the faster is ahead by, about a slice.
    pub(super) fn align(&mut self) {
        let deadline = Instant::now() + ALIGN;
        if self.is_travelling() {
            self.bring_to_goal(deadline);
            self.under_way = None;
            self.past.reach(self.position.reached, Duration::ZERO);
        }
        let Some(until) = self.under_way else {
            return;
        };
        while !self.position.advance(until) {
            if Instant::now() >= deadline {
                return;
            }
        }
        self.arrive(until);
    }

    /// Makes the next edit of the past again on columns that have come to its time.
    pub(super) fn make_again(&mut self, position: &mut Position) {
        let Some(edit) = self.past.edit_after(position.edits).cloned() else {
            return;
        };
        change(&mut self.build, position, &edit);
        // What they have to say was said when the edit was made.
        for column in &mut position.runners {
            column.take_note();
            column.take_plate_note();
        }
    }

    /// Starts the shadows from the present state of the columns, or ends them.
    pub(super) fn shade(&mut self, on: bool) {
        let build = &mut self.build;
        let columns = self.position.runners.iter_mut();
        self.shadows = on.then(|| columns.map(|column| Shadow::of(build, column)).collect());
    }

    /// Starts the shadows anew after an edit; those that were given up stay so.
    pub(super) fn shade_again(&mut self, from: &[usize]) {
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
    pub(super) fn follow(&mut self, arrived: bool) {
        let Some(shadows) = &mut self.shadows else {
            return;
        };
        for (shadow, column) in shadows.iter_mut().zip(&mut self.position.runners) {
            // The error of a column that has stopped is known no longer.
            shadow.take_if(|_| !column.is_alive());
            if let Some(shadow) = shadow {
                shadow.follow(column, arrived);
            }
        }
    }

    pub(super) fn is_shadow_waited_for(&self) -> bool {
        let mut shadows = self.shadows.iter().flatten().flatten();
        shadows.any(Shadow::is_waited_for)
    }

    /// The shadow of a column, where there is one.
    pub(super) fn shadow(&self, index: usize) -> Option<&Shadow> {
        self.shadows.as_ref()?.get(index)?.as_ref()
    }
}

/// Other scenes, each from the state of the column it follows. The follower of a failed
/// column takes the state of its twin; whether there is one to go on from.
fn change(build: &mut Build, position: &mut Position, edit: &Edit) -> bool {
    let present = position.scenes();
    let states = position.runners.iter_mut().map(Runner::state).collect();
    let (scenes, time) = (&edit.scenes, position.reached);
    let Some(states) = sources(&present, states, time, scenes, &edit.from) else {
        return false;
    };
    let mut column =
        |(scene, state): (&Scene, &State)| Runner::new(build, scene.clone(), Some(state), time);
    position.runners = scenes.iter().zip(&states).map(&mut column).collect();
    position.edits += 1;
    true
}
