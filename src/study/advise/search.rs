//! The search: a ladder of contact times, longer looks where they are not decided, and
//! bisection of the bracket.

use super::family::{DIGITS, Family};
use super::probe::{ERRORS, Probe, ProbeOutcome, Suitability};
use super::{AdviseError, Question, SceneKind};
use crate::math;
use crate::numerals::rounded;
use crate::study::{Tell, sweep};
use std::ops::ControlFlow;
use std::sync::Mutex;
use std::sync::atomic::AtomicBool;
use std::time::{Duration, Instant};

/// Periods that a shaken column is followed at first, and at most.
const FIRST_PERIODS: usize = 300;
const QUICK_PERIODS: usize = 100;
const MOST_PERIODS: usize = 200_000;

/// The limit enters every difference, so it is looked at longer.
const LIMIT_LONGER: usize = 4;

/// Undecided contact times that are followed further at once.
const AT_ONCE: usize = 2;

/// New contact times in a bracket at once.
const SECTIONS: usize = 3;

/// Ratio of the bracket's ends at which it is narrow enough.
const NARROW: f64 = 1.01;
const NARROW_QUICK: f64 = 1.05;
const NARROW_SHAKEN: f64 = 1.2;

/// Errors over the tolerance that are small.
const SETTLED: f64 = 0.2;

/// Most contact times that are looked at.
const MOST_PROBES: usize = 200;

/// Part of the time that a single run may take.
const SHARE: u32 = 4;

/// How the answer is to be understood.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Standing {
    /// Up to the answer all that was looked at is within, and the next is not.
    Found,
    /// Everything that was looked at is within.
    Any,
    /// Even the shortest contact time is beyond.
    None,
    /// The shortest contact time that is not within is not decided either.
    Open,
}

/// All that was looked at.
pub(super) struct Search<'a> {
    pub kind: SceneKind,
    pub question: Question,
    pub limit: Probe,
    /// In the order of their contact times.
    pub probes: Vec<Probe>,
    /// Those of which looking gave nothing.
    pub silent: Vec<Probe>,
    family: &'a Family,
    started: Instant,
}

impl<'a> Search<'a> {
    /// Looks at as much as it takes, or as there is time for.
    pub fn run(
        family: &'a Family,
        question: Question,
        tell: &mut Tell,
    ) -> Result<Self, AdviseError> {
        let (limit, limit_time) = family.limit(question.against)?;
        let ladder = family.ladder(question, limit_time)?;
        let mut search = Self {
            kind: SceneKind::of(family.scene()),
            question,
            limit: Probe::new(limit, limit_time),
            probes: Vec::new(),
            silent: Vec::new(),
            family,
            started: Instant::now(),
        };
        search.look_at_limit(tell)?;
        if !search.add(&ladder, search.first_periods(), "the ladder", tell) {
            let failure = search.silent.first().and_then(Probe::failure);
            return Err(AdviseError::Nothing(failure.unwrap_or_default()));
        }
        while search.goes_on() && search.refine(tell) {}
        Ok(search)
    }

    fn look_at_limit(&mut self, tell: &mut Tell) -> Result<(), AdviseError> {
        tell(&self.told("the limit"), None);
        let end = self.end_of_one();
        let periods = LIMIT_LONGER * self.first_periods();
        self.limit.look(self.kind, periods, end);
        match &self.limit.outcome {
            ProbeOutcome::Failed(error) => Err(AdviseError::Limit(error.clone())),
            ProbeOutcome::TooSlow | ProbeOutcome::Unseen => {
                let share = (self.question.time / SHARE).as_secs_f64();
                Err(AdviseError::LimitTooSlow { share })
            }
            ProbeOutcome::Nothing(why) => Err(AdviseError::NoLimit((*why).to_owned())),
            ProbeOutcome::Seen(_) => Ok(()),
        }
    }

    /// The limit in a few words.
    pub fn against(&self) -> String {
        match self.limit.contact_time {
            None => "hard spheres".to_owned(),
            Some(time) => format!("t_c = {} s", in_full(time)),
        }
    }

    /// The verdict on the scene's own contact time.
    pub fn own(&self) -> Option<(&Probe, Suitability)> {
        let own = self.family.own?;
        let mut both = self.probes.iter().zip(self.verdicts());
        both.find(|(probe, _)| probe.contact_time == Some(own))
    }

    /// What the search is at, and its end at the latest: when it is sure nobody knows.
    fn told(&self, what: &str) -> String {
        let time = self.question.time.as_secs_f64();
        format!("{what} (the search takes {time} s at most)")
    }

    fn end(&self) -> Instant {
        self.started + self.question.time
    }

    fn end_of_one(&self) -> Instant {
        let share: Duration = self.question.time / SHARE;
        self.end().min(Instant::now() + share)
    }

    fn first_periods(&self) -> usize {
        if self.question.quick {
            QUICK_PERIODS
        } else {
            FIRST_PERIODS
        }
    }

    fn goes_on(&self) -> bool {
        Instant::now() < self.end() && self.probes.len() + self.silent.len() < MOST_PROBES
    }

    /// One step towards the answer; false when there is nothing more to do.
    fn refine(&mut self, tell: &mut Tell) -> bool {
        let verdicts = self.verdicts();
        let within = leading(&verdicts);
        let Some(stop) = verdicts.get(within) else {
            return false;
        };
        if *stop == Suitability::Undecided && self.kind == SceneKind::Shaken {
            // Near the tolerance nothing is ever decided: what is known well enough to
            // say that is as good as beyond, and the bracket is narrowed about it.
            return (!self.is_settled(within) && self.look_longer(&verdicts, tell))
                || self.bisect(within, tell)
                || self.bisect_above(&verdicts, tell)
                || self.look_longer(&verdicts, tell);
        }
        self.bisect(within, tell)
    }

    /// Whether a shaken column's errors are small beside the tolerance.
    fn is_settled(&self, k: usize) -> bool {
        let observables = self.kind.observables().iter();
        let pairs = self.probes[k].readings().iter().zip(self.limit.readings());
        let mut errors = observables
            .zip(pairs)
            .map(|(observable, (here, limit))| observable.off(*here, *limit).error);
        errors.all(|error| ERRORS * error < SETTLED * self.question.tolerance)
    }

    /// Narrows the bracket between what is not decided and what is beyond.
    fn bisect_above(&mut self, verdicts: &[Suitability], tell: &mut Tell) -> bool {
        let beyond = verdicts.iter().position(|v| *v == Suitability::Beyond);
        beyond.is_some_and(|k| self.bisect(k, tell))
    }

    /// New contact times between one and that before it, if they are far enough apart.
    fn bisect(&mut self, k: usize, tell: &mut Tell) -> bool {
        let below = match k.checked_sub(1) {
            Some(below) => Some(self.time(below)),
            // The limit is within any tolerance of itself.
            None => self.limit.contact_time,
        };
        let Some(low) = below else {
            return false;
        };
        let high = self.time(k);
        if high / low <= self.narrow() {
            return false;
        }
        let section = |k: usize| {
            let part = k as f64 / (SECTIONS + 1) as f64;
            rounded(low * math::powf(high / low, part), DIGITS)
        };
        let mut times: Vec<f64> = (1..=SECTIONS).map(section).collect();
        times.retain(|t| *t > low && *t < high);
        times.dedup();
        let periods = (self.probes[k].periods() / 4).max(self.first_periods());
        !times.is_empty() && self.add(&times, periods, "the bracket", tell)
    }

    fn narrow(&self) -> f64 {
        match (self.kind, self.question.quick) {
            (SceneKind::Shaken, _) => NARROW_SHAKEN,
            (_, true) => NARROW_QUICK,
            _ => NARROW,
        }
    }

    /// Follows the shortest that are not decided, below the first that is beyond, for
    /// twice as many periods. False when there is nothing more to follow.
    fn look_longer(&mut self, verdicts: &[Suitability], tell: &mut Tell) -> bool {
        let beyond = verdicts.iter().position(|v| *v == Suitability::Beyond);
        let below = &verdicts[..beyond.unwrap_or(verdicts.len())];
        let is_open = |k: &usize| {
            below[*k] == Suitability::Undecided && self.probes[*k].periods() < MOST_PERIODS
        };
        // The answer hangs on the shortest of them.
        let open: Vec<usize> = (0..below.len()).filter(is_open).take(AT_ONCE).collect();
        !open.is_empty() && self.extend(&open, tell)
    }

    /// Follows some for twice as many periods, and the limit if that is as vague.
    fn extend(&mut self, which: &[usize], tell: &mut Tell) -> bool {
        let what = self.told("longer runs");
        let longer = |probe: &Probe| (2 * probe.periods()).min(MOST_PERIODS);
        let vague = which
            .iter()
            .any(|&k| self.limit.is_as_vague_as(&self.probes[k]));
        let ends = (self.end(), self.question.time / SHARE);
        let mut tasks: Vec<(&mut Probe, usize)> = Vec::new();
        for (_, probe) in self
            .probes
            .iter_mut()
            .enumerate()
            .filter(|(k, _)| which.contains(k))
        {
            let periods = longer(probe);
            tasks.push((probe, periods));
        }
        if vague && self.limit.periods() < MOST_PERIODS {
            let periods = longer(&self.limit);
            tasks.push((&mut self.limit, periods));
        }
        tell(&what, None);
        look(self.kind, tasks, self.question.threads, ends, &mut |_| {});
        true
    }

    /// Looks at new contact times. False when none of them could be looked at.
    fn add(&mut self, times: &[f64], periods: usize, what: &str, tell: &mut Tell) -> bool {
        let at = |&time: &f64| Some(Probe::new(self.family.at(time).ok()?, Some(time)));
        let mut new: Vec<Probe> = times.iter().filter_map(at).collect();
        if new.is_empty() {
            return false;
        }
        let all = new.len();
        let tasks = new.iter_mut().map(|probe| (probe, periods)).collect();
        let ends = (self.end(), self.question.time / SHARE);
        let mut count = |done: usize| {
            tell(&self.told(&format!("{what}, {done} of {all}")), None);
        };
        count(0);
        look(self.kind, tasks, self.question.threads, ends, &mut count);
        let (seen, silent): (Vec<_>, Vec<_>) = new
            .into_iter()
            .partition(|probe| !probe.readings().is_empty());
        let any = !seen.is_empty();
        self.silent.extend(silent);
        self.probes.extend(seen);
        let time = |probe: &Probe| probe.contact_time.unwrap_or(f64::NAN);
        self.probes.sort_by(|a, b| time(a).total_cmp(&time(b)));
        any
    }

    fn time(&self, k: usize) -> f64 {
        self.probes[k].contact_time.unwrap_or(f64::NAN)
    }

    /// What the probes come to, in their order.
    pub fn verdicts(&self) -> Vec<Suitability> {
        let verdict =
            |probe: &Probe| probe.verdict(&self.limit, self.kind, self.question.tolerance);
        self.probes.iter().map(verdict).collect()
    }

    /// The longest contact time up to which all are within.
    pub fn longest(&self) -> Option<&Probe> {
        leading(&self.verdicts())
            .checked_sub(1)
            .map(|k| &self.probes[k])
    }

    /// The shortest contact time that is beyond, after those that are within.
    pub fn beyond(&self) -> Option<&Probe> {
        let verdicts = self.verdicts();
        let k = verdicts.iter().position(|v| *v == Suitability::Beyond)?;
        Some(&self.probes[k])
    }

    pub fn standing(&self) -> Standing {
        let verdicts = self.verdicts();
        let within = leading(&verdicts);
        match (within, verdicts.get(within)) {
            (_, None) => Standing::Any,
            (0, Some(Suitability::Beyond)) => Standing::None,
            (_, Some(Suitability::Beyond)) => Standing::Found,
            _ => Standing::Open,
        }
    }

    /// Whether some contact time is within again after one that is beyond.
    pub fn returns(&self) -> bool {
        let verdicts = self.verdicts();
        let after = verdicts.iter().skip_while(|v| **v != Suitability::Beyond);
        after.into_iter().any(|v| *v == Suitability::Within)
    }
}

fn leading(verdicts: &[Suitability]) -> usize {
    verdicts
        .iter()
        .take_while(|v| **v == Suitability::Within)
        .count()
}

/// Looks at scenes side by side, each for a share of the time; tells how many are done.
fn look(
    kind: SceneKind,
    tasks: Vec<(&mut Probe, usize)>,
    threads: usize,
    (end, one): (Instant, Duration),
    done: &mut dyn FnMut(usize),
) {
    let tasks: Vec<Mutex<(&mut Probe, usize)>> = tasks.into_iter().map(Mutex::new).collect();
    sweep::run(
        0..tasks.len(),
        threads,
        &AtomicBool::new(false),
        |row| {
            // Every row is looked at once, by one thread.
            let mut task = tasks[row].lock().ok()?;
            let periods = task.1;
            task.0.look(kind, periods, end.min(Instant::now() + one));
            Some(())
        },
        |row, ()| {
            done(row + 1);
            ControlFlow::Continue(())
        },
    );
}

/// A contact time with the digits that it has.
pub(super) fn in_full(time: f64) -> String {
    format!("{time:e}")
}
