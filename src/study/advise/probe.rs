//! A contact time that is looked at.

use super::SceneKind;
use crate::math;
use crate::physics::{Engine, Observation, build};
use crate::scene::Scene;
use crate::study::means::{Mean, Means};
use crate::study::measure::stacking_height;
use crate::study::{Drive, RunError, in_time, measure, one_ulp_off};
use std::ops::Range;
use std::time::Instant;

/// Looks at a shaken column in a period.
const LOOKS: usize = 100;

/// Of the periods that a shaken column was followed, the part that is left out.
const SETTLING: f64 = 0.15;

/// Fewest periods that say something.
const LEAST_PERIODS: usize = 60;

/// Standard errors, or changes by the last bit, by which a difference must be below the
/// tolerance to be within, and above it to be beyond: of many means that are looked at
/// again and again, some are three errors off by chance, and one of them would end it.
pub(super) const ERRORS: f64 = 3.0;
pub(super) const BEYOND_ERRORS: f64 = 5.0;

/// A limit below this counts as none, and the difference itself is compared.
pub(super) const NAUGHT: f64 = 1e-3;

/// What is compared.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Observable {
    /// Name in CSV and JSON, of its error, of the difference from the limit, and of that
    /// one's error.
    pub names: [&'static str; 4],
    /// Name in text.
    pub heading: &'static str,
    /// SI unit.
    pub unit: &'static str,
    /// Whether the answer depends on it.
    pub judged: bool,
}

const EPS_EFF: Observable = Observable {
    names: [
        "eps_eff",
        "eps_eff_error",
        "eps_eff_off",
        "eps_eff_off_error",
    ],
    heading: "eps_eff",
    unit: "",
    judged: true,
};

const ER_OVER_EF: Observable = Observable {
    names: [
        "er_over_ef",
        "er_over_ef_error",
        "er_over_ef_off",
        "er_over_ef_off_error",
    ],
    heading: "E_r/E_f",
    unit: "",
    judged: false,
};

const ER_OVER_E: Observable = Observable {
    names: [
        "er_over_e",
        "er_over_e_error",
        "er_over_e_off",
        "er_over_e_off_error",
    ],
    heading: "E_r/E",
    unit: "",
    judged: true,
};

const H_CM: Observable = Observable {
    names: ["h_cm_mean", "h_cm_error", "h_cm_off", "h_cm_off_error"],
    heading: "h_cm",
    unit: "m",
    judged: true,
};

impl SceneKind {
    /// What is compared, in the order of the readings.
    pub fn observables(self) -> &'static [Observable] {
        match self {
            Self::Launched => &[EPS_EFF, ER_OVER_EF],
            Self::Falling => &[H_CM],
            Self::Shaken => &[ER_OVER_E, H_CM],
        }
    }
}

/// A number and what it may be off by.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Reading {
    pub value: f64,
    pub error: f64,
}

impl Observable {
    /// Distance from a limit, and its error: parts of the limit, where that is one.
    pub fn off(&self, here: Reading, limit: Reading) -> Reading {
        let scale = if self.is_naught(limit) {
            1.0
        } else {
            limit.value.abs()
        };
        Reading {
            value: (here.value - limit.value).abs() / scale,
            error: math::hypot(here.error, limit.error) / scale,
        }
    }

    /// Whether a limit is so small that parts of it mean nothing.
    pub fn is_naught(&self, limit: Reading) -> bool {
        self.unit.is_empty() && limit.value.abs() < NAUGHT
    }
}

/// What looking gave.
#[derive(Debug, Clone, PartialEq)]
pub(super) enum ProbeOutcome {
    /// Nothing yet.
    Unseen,
    /// A reading for every observable.
    Seen(Vec<Reading>),
    /// No end in the time that there was.
    TooSlow,
    /// No end.
    Failed(RunError),
    /// An end without a number.
    Nothing(&'static str),
}

/// Whether a contact time will do.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Suitability {
    Within,
    Beyond,
    Undecided,
}

impl Suitability {
    pub fn word(self) -> &'static str {
        match self {
            Self::Within => "within",
            Self::Beyond => "beyond",
            Self::Undecided => "not decided",
        }
    }
}

/// A scene that is looked at.
pub(super) struct Probe {
    /// Its contact time, s; none of hard spheres.
    pub contact_time: Option<f64>,
    pub scene: Scene,
    pub outcome: ProbeOutcome,
    /// Where a shaken column has come to.
    engine: Option<Box<dyn Engine>>,
    means: Means,
    looks: f64,
}

impl Probe {
    pub fn new(scene: Scene, contact_time: Option<f64>) -> Self {
        Self {
            contact_time,
            means: Means::new(&scene, LOOKS),
            scene,
            outcome: ProbeOutcome::Unseen,
            engine: None,
            looks: 0.0,
        }
    }

    /// Periods that a shaken column was followed.
    pub fn periods(&self) -> usize {
        self.means.blocks()
    }

    /// Looks at the scene until `end` at most; at a shaken column for so many periods
    /// since its start.
    pub fn look(&mut self, kind: SceneKind, periods: usize, end: Instant) {
        self.outcome = match kind {
            SceneKind::Shaken => {
                let followed = self.follow(periods, end);
                self.judge(followed)
            }
            _ => alone(&self.scene, kind, end),
        };
    }

    fn follow(&mut self, periods: usize, end: Instant) -> Result<(), RunError> {
        let interval = self.scene.period().unwrap_or(f64::NAN) / LOOKS as f64;
        let mut watch = in_time(end);
        let engine = self.engine.take();
        let engine = engine.unwrap_or_else(|| build(&self.scene, None).0);
        let mut drive = Drive::of(engine, &self.scene, &mut watch);
        let mut seen = Observation::default();
        let mut followed = Ok(());
        if self.looks == 0.0 {
            drive.observe(&mut seen);
            self.means.look(&seen);
        }
        while self.means.blocks() < periods {
            if let Err(error) = drive.advance((self.looks + 1.0) * interval) {
                followed = Err(error);
                break;
            }
            self.looks += 1.0;
            drive.observe(&mut seen);
            self.means.look(&seen);
        }
        self.engine = Some(drive.into_engine());
        followed
    }

    fn judge(&self, followed: Result<(), RunError>) -> ProbeOutcome {
        match followed {
            Ok(()) => {}
            Err(RunError::Stopped { .. }) if self.periods() >= LEAST_PERIODS => {}
            Err(RunError::Stopped { .. }) => return ProbeOutcome::TooSlow,
            Err(error) => return ProbeOutcome::Failed(error),
        }
        let all = self.settled();
        let (Some(share), Some(height)) = (
            self.means.share(all.clone()),
            self.means.height(all.clone()),
        ) else {
            return ProbeOutcome::Nothing("the column never moves");
        };
        let reading = |mean: Mean, [one, other]: [Option<Mean>; 2], above: f64| Reading {
            value: mean.value + above,
            error: error_of(mean, one, other),
        };
        let halves = |of: &dyn Fn(Range<usize>) -> Option<Mean>| {
            let middle = usize::midpoint(all.start, all.end);
            [of(all.start..middle), of(middle..all.end)]
        };
        let shares = halves(&|half| self.means.share(half));
        let heights = halves(&|half| self.means.height(half));
        let resting = stacking_height(&self.scene);
        ProbeOutcome::Seen(vec![
            reading(share, shares, 0.0),
            reading(height, heights, resting),
        ])
    }

    /// The periods that no longer depend on the start, as far as one can tell.
    fn settled(&self) -> Range<usize> {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a part of a count"
        )]
        let skip = (SETTLING * self.periods() as f64).ceil() as usize;
        skip..self.periods()
    }

    /// Whether its errors are no smaller than a third of another's.
    pub fn is_as_vague_as(&self, other: &Self) -> bool {
        let mut pairs = self.readings().iter().zip(other.readings());
        pairs.any(|(here, there)| here.error > 0.0 && 3.0 * here.error > there.error)
    }

    /// The readings, if there are any.
    pub fn readings(&self) -> &[Reading] {
        match &self.outcome {
            ProbeOutcome::Seen(readings) => readings,
            _ => &[],
        }
    }

    /// Why there are none.
    pub fn failure(&self) -> Option<String> {
        match &self.outcome {
            ProbeOutcome::Seen(_) | ProbeOutcome::Unseen => None,
            ProbeOutcome::TooSlow => Some("too slow for the time there was".to_owned()),
            ProbeOutcome::Failed(error) => Some(error.to_string()),
            ProbeOutcome::Nothing(why) => Some((*why).to_owned()),
        }
    }

    /// Whether it is within the tolerance of the limit, as far as the errors of both say.
    pub fn verdict(&self, limit: &Self, kind: SceneKind, tolerance: f64) -> Suitability {
        let (here, there) = (self.readings(), limit.readings());
        if here.is_empty() || there.is_empty() {
            return Suitability::Undecided;
        }
        let judged = kind.observables().iter().zip(here.iter().zip(there));
        let mut verdict = Suitability::Within;
        for (observable, (reading, limit)) in judged.filter(|(o, _)| o.judged) {
            let off = observable.off(*reading, *limit);
            if off.value - BEYOND_ERRORS * off.error > tolerance {
                return Suitability::Beyond;
            }
            // A NaN is not within.
            let within = off.value + ERRORS * off.error <= tolerance;
            if !within {
                verdict = Suitability::Undecided;
            }
        }
        verdict
    }
}

/// The standard error of a mean; or, where a column still remembers its start, half of
/// what the halves of its periods differ by, if that is more.
fn error_of(mean: Mean, one: Option<Mean>, other: Option<Mean>) -> f64 {
    let apart = one.zip(other).map(|(a, b)| 0.5 * (a.value - b.value).abs());
    let both = mean.error.zip(apart);
    both.map_or(f64::INFINITY, |(error, apart)| error.max(apart))
}

/// A run with one right answer: its results, and what the last bit of the start changes.
fn alone(scene: &Scene, kind: SceneKind, end: Instant) -> ProbeOutcome {
    let mut watch = in_time(end);
    let both = measure(scene, &mut Drive::new(scene, &mut watch)).and_then(|here| {
        let mut off = Drive::of(one_ulp_off(scene, 0), scene, &mut watch);
        Ok((here, measure(scene, &mut off)?))
    });
    let (here, near) = match both {
        Ok(both) => both,
        Err(RunError::Stopped { .. }) => return ProbeOutcome::TooSlow,
        Err(error) => return ProbeOutcome::Failed(error),
    };
    let reading = |here: f64, near: Option<f64>| Reading {
        value: here,
        error: near.map_or(f64::INFINITY, |near| (near - here).abs()),
    };
    match (kind, here.eps_eff, here.h_cm_mean) {
        (SceneKind::Launched, Some(eps_eff), _) => {
            let share = here.er_over_ef.unwrap_or(f64::NAN);
            ProbeOutcome::Seen(vec![
                reading(eps_eff, near.eps_eff),
                reading(share, near.er_over_ef),
            ])
        }
        (SceneKind::Launched, None, _) => {
            ProbeOutcome::Nothing("the floor collision is not over within the duration")
        }
        (_, _, Some(height)) => ProbeOutcome::Seen(vec![reading(height, near.h_cm_mean)]),
        _ => ProbeOutcome::Nothing("the run has no mean height"),
    }
}
