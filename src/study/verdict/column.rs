//! One of the two columns that are compared, on its way.

use super::{Compared, DENSE_SHARE, LANDINGS, Verdict, Word};
use crate::numerals::significant;
use crate::physics::{Engine, Observation, build};
use crate::scene::{Facts, Scene};
use crate::study::means::Means;
use crate::study::{Allowance, Drive, RunError, Watch, measure};
use std::ops::Range;

/// Work for a column: a second on an ordinary machine, if it takes so long to decide.
pub(super) const SLICES: u64 = 100;

/// Looks at beads that are as much work as a slice.
const LOOKS_AT_BEADS: f64 = 1e5;

/// Looks in a period, or in a fall by a diameter.
const LOOKS: usize = 100;

/// The part of the periods that is left out: the start still shows in it.
const SETTLING: f64 = 0.1;

/// A column that keeps no more than this part of the most kinetic energy that it had
/// while its floor is closed has come to rest.
const AT_REST: f64 = 1e-12;

/// Why there is nothing to compare.
pub(super) enum Missing {
    /// Who looks on wants it no longer.
    Stopped(RunError),
    /// In a few words.
    Why(String),
}

/// Of a period: dense landings, and all.
type LandingCount = (u64, u64);

/// A column on its way.
pub(super) struct FollowedColumn {
    scene: Scene,
    /// Its beads, in words.
    whose: &'static str,
    engine: Option<Box<dyn Engine>>,
    seen: Observation,
    means: Means,
    looks: f64,
    landings: Vec<LandingCount>,
    /// Slices of work so far, and allowed.
    work: f64,
    allowed: u64,
}

impl FollowedColumn {
    /// A column of beads that are called so, and the slices of work that it may take.
    pub fn new(scene: Scene, whose: &'static str, allowed: u64) -> Self {
        let (engine, mut seen) = (build(&scene, None).0, Observation::default());
        engine.observe(&mut seen);
        let mut means = Means::new(&scene, LOOKS);
        means.look(&seen);
        Self {
            engine: Some(engine),
            scene,
            whose,
            seen,
            means,
            looks: 0.0,
            landings: Vec::new(),
            work: 0.0,
            allowed,
        }
    }

    /// Whether it has had all the work that it may have.
    pub fn is_spent(&self) -> bool {
        self.work >= self.allowed as f64
    }

    /// What `work` gives with the column's engine on a drive of what work is left, while
    /// nobody stops it.
    fn driven<T>(
        &mut self,
        watch: &mut Watch,
        work: impl FnOnce(&mut Self, &mut Drive) -> Result<T, RunError>,
    ) -> Result<T, Missing> {
        let mut stopped = false;
        let mut look = |time| {
            let flow = watch(time);
            stopped |= flow.is_break();
            flow
        };
        let engine = self.engine.take();
        let engine = engine.unwrap_or_else(|| build(&self.scene, None).0);
        let allowance = Allowance {
            slices: self.allowed,
            end: None,
        };
        let mut drive = Drive::of(engine, &self.scene, &mut look).within(allowance);
        let done = work(self, &mut drive);
        self.engine = Some(drive.into_engine());
        let whose = self.whose;
        done.map_err(|error| match error {
            RunError::Stopped { .. } if stopped => Missing::Stopped(error),
            RunError::Stopped { .. } => Missing::Why(format!("{whose} take too much work")),
            RunError::Engine(error) => Missing::Why(format!("{whose} fail: {error}")),
        })
    }

    /// ε_eff of the floor collision.
    pub fn collide(&mut self, watch: &mut Watch) -> Result<f64, Missing> {
        let endless = Facts {
            duration: None,
            ..self.scene.facts().clone()
        };
        let endless = Scene::new(endless).map_err(|error| Missing::Why(error.to_string()))?;
        let results = self.driven(watch, |_, drive| measure(&endless, drive))?;
        let none = || Missing::Why(format!("the collision of {} has no end", self.whose));
        results.eps_eff.ok_or_else(none)
    }

    /// ε_eff of the last bounce of a column that falls, when it has come to rest.
    pub fn settle(&mut self, watch: &mut Watch) -> Result<f64, Missing> {
        let gravity = self.scene.gravity.unwrap_or(f64::NAN);
        let interval = (2.0 * self.scene.diameter / gravity).sqrt() / LOOKS as f64;
        let mut most = 0.0_f64;
        loop {
            self.look(interval, watch)?;
            let kinetic = self.seen.energy.kinetic;
            most = most.max(kinetic);
            let closed = self.seen.contacts.iter().all(|closed| *closed);
            if closed && kinetic <= AT_REST * most {
                break;
            }
            if self.is_spent() {
                return Err(Missing::Why(format!("{} take too much work", self.whose)));
            }
        }
        let none = || Missing::Why("the column rests from the start".to_owned());
        self.seen.bounce.ok_or_else(none)
    }

    /// Follows it for so many periods since the start, or until its work is spent.
    pub fn follow(&mut self, periods: usize, watch: &mut Watch) -> Result<(), Missing> {
        let interval = self.scene.period().unwrap_or(f64::NAN) / LOOKS as f64;
        while self.means.blocks() < periods && !self.is_spent() {
            let before = self.seen.crossing;
            self.look(interval, watch)?;
            self.means.look(&self.seen);
            if self.landings.len() <= self.means.blocks() {
                self.landings.push((0, 0));
            }
            let time = self.scene.contact_time();
            let sigma = self
                .seen
                .crossing
                .zip(time)
                .map(|(crossing, t_c)| crossing / t_c);
            if let (Some(sigma), Some(of_period)) = (sigma, self.landings.last_mut())
                && self.seen.crossing != before
            {
                of_period.0 += u64::from(sigma < 1.0);
                of_period.1 += 1;
            }
        }
        Ok(())
    }

    /// Moves on by an interval, s, and looks.
    fn look(&mut self, interval: f64, watch: &mut Watch) -> Result<(), Missing> {
        self.looks += 1.0;
        let until = self.looks * interval;
        let done = |seen: &Observation| seen.steps + seen.events;
        let before = done(&self.seen);
        let work = self.driven(watch, |column, drive| {
            drive.advance(until)?;
            drive.observe(&mut column.seen);
            Ok(drive.in_slices(done(&column.seen) - before))
        })?;
        self.work += work + self.scene.n as f64 / LOOKS_AT_BEADS;
        Ok(())
    }

    /// The periods that no longer show the start.
    fn settled(&self) -> Range<usize> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a count"
        )]
        let skip = (SETTLING * self.means.blocks() as f64).ceil() as usize;
        skip..self.means.blocks()
    }

    /// What both columns give on a plate of that amplitude, m.
    pub fn means(&self, hard: &Self, amplitude: f64) -> Result<[Compared; 2], Missing> {
        let of = |column: &Self| {
            let all = column.settled();
            let share = column.means.share(all.clone());
            share.zip(column.means.height(all))
        };
        let both = of(self).zip(of(hard));
        let none = || Missing::Why(format!("{} take too much work", self.whose));
        let ((share, rise), (hard_share, hard_rise)) = both.ok_or_else(none)?;
        Ok([
            Compared::energy_share(share, hard_share),
            Compared::rise(rise, hard_rise, amplitude),
        ])
    }

    /// Dense landings and all of them.
    fn landings(&self) -> LandingCount {
        let settled = self.landings.get(self.settled()).unwrap_or_default();
        let add = |sum: LandingCount, period: &LandingCount| (sum.0 + period.0, sum.1 + period.1);
        settled.iter().fold((0, 0), add)
    }

    /// What its landings are like.
    pub fn told(&self) -> String {
        let (dense, all) = self.landings();
        if all < LANDINGS {
            return String::new();
        }
        let percent = significant(100.0 * dense as f64 / all as f64, 2);
        format!("; sigma < 1 at {percent} % of {all} landings, in runs of their own")
    }

    /// By its landings alone, because `why` there is no comparison.
    pub fn by_landings(&self, why: &str) -> Verdict {
        let (dense, all) = self.landings();
        if all < LANDINGS {
            return Verdict::none(why);
        }
        let word = match dense as f64 / all as f64 {
            part if part >= DENSE_SHARE => Word::Detachment,
            part if part > 0.0 => Word::Crossover,
            _ => Word::Agreement,
        };
        let because = format!("by sigma alone, since {why}{}", self.told());
        Verdict {
            word: Some(word),
            ..Verdict::none(because)
        }
    }
}
