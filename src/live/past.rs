//! What was: moments to go back to, edits, and the samples of the traces.
//!
//! A moment is a clone of the columns, so that going on from it gives the same bits. Moments
//! are dense where they are recent and sparse where they are old; what lies between two is
//! simulated again from the first.

use std::collections::VecDeque;
use std::time::Duration;

use super::History;
use super::history::Sample;
use super::runner::Runner;
use crate::scene::Scene;
use crate::tape::{Edit, Tape};

/// Moments may cost this part of the time in which columns move.
const COST: u32 = 64;
/// The part of the memory that samples of traces may take.
const FOR_SAMPLES: usize = 4;

/// The columns at one time.
#[derive(Clone, Default)]
pub(super) struct Position {
    pub runners: Vec<Runner>,
    /// Simulated time that all of them have come to, s.
    pub reached: f64,
    /// How many edits have acted on them.
    pub edits: usize,
}

/// What can be counted of columns, and gone to.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Count {
    /// Contacts begun and ended, and collisions.
    Changes,
    /// Landings on the floor.
    Landings,
}

impl Position {
    /// How often it has happened so far, in all columns, as they were last looked at.
    pub fn count(&self, what: Count) -> u64 {
        let seen = self.runners.iter().map(Runner::seen);
        match what {
            Count::Changes => seen.map(|seen| seen.changes).sum(),
            Count::Landings => seen.map(|seen| seen.landings).sum(),
        }
    }

    /// What each column is of.
    pub fn scenes(&self) -> Vec<Scene> {
        self.runners
            .iter()
            .map(|column| column.scene().clone())
            .collect()
    }

    /// Whether any column can go on.
    pub fn is_alive(&self) -> bool {
        self.runners.iter().any(Runner::is_alive)
    }

    /// Moves all columns towards `until`, s, for about a call each; whether they have come
    /// there.
    pub fn advance(&mut self, until: f64) -> bool {
        let arrived = |all, column: &mut Runner| column.advance(until) && all;
        self.runners.iter_mut().fold(true, arrived)
    }

    /// Looks at all columns.
    pub fn look(&mut self) {
        for column in &mut self.runners {
            column.observe();
        }
    }

    fn bytes(&self) -> usize {
        self.runners.iter().map(Runner::bytes).sum()
    }
}

/// All that can be gone back to, within its memory.
pub(super) struct Past {
    /// By time, no two at the same.
    moments: Vec<Position>,
    /// What the columns were of at the start.
    scenes: Vec<Scene>,
    edits: Vec<Edit>,
    samples: VecDeque<Sample>,
    /// Simulated time up to which it is known, s, and up to which columns have moved here.
    end: f64,
    simulated: f64,
    /// Memory for all this, bytes, and what the moments take of it.
    memory: usize,
    held: usize,
    /// Time in which columns moved, and that which the moments took.
    driven: Duration,
    spent: Duration,
}

impl Past {
    /// No past, for which there is so much memory, bytes.
    pub fn new(memory: usize) -> Past {
        Past {
            moments: Vec::new(),
            scenes: Vec::new(),
            edits: Vec::new(),
            samples: VecDeque::new(),
            end: 0.0,
            simulated: 0.0,
            memory,
            held: 0,
            driven: Duration::ZERO,
            spent: Duration::ZERO,
        }
    }

    /// Begins anew with these columns.
    pub fn begin(&mut self, position: &Position) {
        *self = Past::new(self.memory);
        self.scenes = position.scenes();
        self.keep(position);
    }

    /// Takes for known what a tape has of the columns that begin.
    pub fn foretell(&mut self, tape: &Tape) {
        self.edits.clone_from(&tape.edits);
        self.end = self.end.max(tape.end());
    }

    /// What the columns were of at the start.
    pub fn scenes(&self) -> &[Scene] {
        &self.scenes
    }

    /// All edits so far.
    pub fn edits(&self) -> &[Edit] {
        &self.edits
    }

    /// Whether a moment at `time`, s, would be later than all there are.
    pub fn is_new(&self, time: f64) -> bool {
        self.moments.last().is_none_or(|last| last.reached < time)
    }

    /// Up to when it is known, s.
    pub fn end(&self) -> f64 {
        self.end
    }

    /// The columns have come to `time`, s, in so much time of work.
    pub fn reach(&mut self, time: f64, took: Duration) {
        if time > self.simulated {
            self.simulated = time;
            self.driven += took;
        }
        self.end = self.end.max(time);
    }

    /// Whether there is time for another moment.
    pub fn affords(&self) -> bool {
        self.spent * COST <= self.driven
    }

    /// A moment took so much time.
    pub fn spend(&mut self, took: Duration) {
        self.spent += took;
    }

    /// Remembers the columns as they are.
    pub fn keep(&mut self, position: &Position) {
        if let Some(last) = self.moments.last() {
            if last.reached > position.reached {
                return;
            }
            if last.reached == position.reached {
                self.held -= last.bytes();
                self.moments.pop();
            }
        }
        let bytes = position.bytes();
        // Columns that are so large can only go on.
        if bytes > self.for_moments() / 2 {
            return;
        }
        self.held += bytes;
        self.moments.push(position.clone());
        self.end = self.end.max(position.reached);
        while self.held > self.for_moments() && self.thin() {}
    }

    fn for_moments(&self) -> usize {
        self.memory - self.memory / FOR_SAMPLES
    }

    /// Gives up the moment that is missed least: where its neighbours are close, measured by
    /// their age. The first and the last stay.
    fn thin(&mut self) -> bool {
        let time = |k: usize| self.moments[k].reached;
        let missed = |k: usize| (time(k + 1) - time(k - 1)) / (self.end - time(k - 1));
        let inner = 1..self.moments.len().saturating_sub(1);
        let Some(least) = inner.min_by(|&a, &b| missed(a).total_cmp(&missed(b))) else {
            return false;
        };
        self.held -= self.moments.remove(least).bytes();
        true
    }

    /// Remembers an edit that acts on columns at `time`, s.
    pub fn edit(&mut self, edit: Edit) {
        self.edits.push(edit);
    }

    /// The edit that comes after so many.
    pub fn edit_after(&self, edits: usize) -> Option<&Edit> {
        self.edits.get(edits)
    }

    /// Forgets all that is later than these columns; how much that was, s, if anything was.
    pub fn fork(&mut self, position: &Position) -> Option<f64> {
        let later = self.end - position.reached;
        if later <= 0.0 && self.edits.len() == position.edits {
            return None;
        }
        self.edits.truncate(position.edits);
        let kept = self.after(position.reached);
        let dropped = self.moments.drain(kept..);
        self.held -= dropped.map(|moment| moment.bytes()).sum::<usize>();
        self.samples
            .retain(|sample| sample.time <= position.reached);
        self.end = position.reached;
        self.simulated = position.reached;
        Some(later)
    }

    /// The number of moments up to `time`, s.
    fn after(&self, time: f64) -> usize {
        self.moments
            .partition_point(|moment| moment.reached <= time)
    }

    /// The last moment not after `time`, s.
    pub fn at(&self, time: f64) -> Option<&Position> {
        let after = self.after(time);
        self.moments[..after].last()
    }

    /// The last moment at which something has happened less often than `count` times, and the
    /// time of the one after it, s, if there is one.
    pub fn before(&self, what: Count, count: u64) -> Option<(&Position, Option<f64>)> {
        let after = self
            .moments
            .partition_point(|moment| moment.count(what) < count);
        let moment = self.moments[..after].last()?;
        let next = self.moments.get(after).map(|moment| moment.reached);
        Some((moment, next))
    }

    /// Remembers a sample of the traces, if it is a new one.
    pub fn add(&mut self, sample: Sample) {
        if self
            .samples
            .back()
            .is_some_and(|last| last.time >= sample.time)
        {
            return;
        }
        self.samples.push_back(sample);
        let size = self.samples.back().map_or(1, Sample::bytes);
        if self.samples.len() * size > self.memory / FOR_SAMPLES {
            self.thin_samples();
        }
    }

    /// Gives up every other sample of the older half: old pages are drawn from fewer.
    fn thin_samples(&mut self) {
        let half = self.samples.len() / 2;
        let mut number = 0;
        self.samples.retain(|_| {
            number += 1;
            number > half || number % 2 == 0
        });
    }

    /// The last samples up to `time`, s, as many as a page has.
    pub fn page(&self, time: f64, capacity: usize) -> History {
        let mut history = History::new(capacity);
        let after = self.samples.partition_point(|sample| sample.time <= time);
        let first = after.saturating_sub(capacity);
        self.samples
            .range(first..after)
            .for_each(|sample| history.push(sample.clone()));
        history
    }
}
