//! What became of a method on a case, in words.

use super::runs::RunEnd;
use crate::scene::MethodName;

/// What became of a method on a case.
#[derive(Debug, Clone, PartialEq)]
pub enum CaseVerdict {
    /// Its relative error is small enough.
    Right(f64),
    /// It is the exact method, and an independent one comes so near.
    Confirmed {
        /// Relative distance of the two.
        error: f64,
        /// What the last bit of the start changes, if there was time for it.
        bits: Option<f64>,
    },
    /// It is not.
    Off(f64),
    /// Another model, so far from the reference.
    Model(f64),
    /// It came to its end, and nothing says how right; what the last bit changes, if
    /// that is known.
    Ran(Option<f64>),
    /// It became unstable or lost the column: when, s, and the engine's words.
    Breaks(f64, String),
    /// It would take so long, s, where that is known.
    Slow(Option<f64>),
    /// The scene is not allowed: the words for it.
    Refused(String),
}

/// A method and what became of it.
#[derive(Debug, Clone, PartialEq)]
pub struct Judgement {
    /// The method.
    pub method: MethodName,
    /// What became of it.
    pub verdict: CaseVerdict,
}

impl CaseVerdict {
    /// In at most 12 characters.
    pub fn short(&self) -> String {
        match self {
            Self::Right(error) | Self::Confirmed { error, .. } => {
                format!("right {}", brief(*error))
            }
            Self::Off(error) => format!("off {}", brief(*error)),
            Self::Model(error) => format!("model {}", brief(*error)),
            Self::Ran(Some(bits)) => format!("ran {}", brief(*bits)),
            Self::Ran(None) => "ran".to_owned(),
            Self::Breaks(time, _) => format!("breaks {}", brief(*time)),
            Self::Slow(Some(needed)) => format!("slow {}", brief(*needed)),
            Self::Slow(None) => "slow".to_owned(),
            Self::Refused(_) => "refused".to_owned(),
        }
    }

    /// In full.
    pub fn long(&self) -> String {
        match self {
            Self::Right(error) => format!("right, error {error:e}"),
            Self::Confirmed { error, bits } => {
                let bits = bits.map_or(String::new(), |bits| {
                    format!("; the last bit changes {bits:.1e}")
                });
                format!("right, {error:.1e} from the adaptive method{bits}")
            }
            Self::Off(error) => format!("inaccurate, error {error:e}"),
            Self::Model(error) => format!("another model, distance {error:e}"),
            Self::Ran(Some(bits)) => format!("came to its end; the last bit changes {bits:e}"),
            Self::Ran(None) => "came to its end, with nothing to compare with".to_owned(),
            Self::Breaks(time, why) => format!("breaks at {time:e} s: {why}"),
            Self::Slow(Some(needed)) => format!("too slow, would take {needed:.1} s"),
            Self::Slow(None) => "too slow, for an unknown time".to_owned(),
            Self::Refused(why) => format!("refused: {why}"),
        }
    }
}

/// One digit, as short as it goes.
fn brief(x: f64) -> String {
    if (0.01..1.0).contains(&x) {
        return format!("{x:.2}");
    }
    if (1.0..1000.0).contains(&x) || x == 0.0 {
        return format!("{x:.0}");
    }
    format!("{x:.0e}")
}

/// The verdict where there is nothing to compare.
pub(super) fn unfinished(ending: &RunEnd) -> CaseVerdict {
    match ending {
        RunEnd::Done { .. } => CaseVerdict::Ran(None),
        RunEnd::Slow { needed } => CaseVerdict::Slow(*needed),
        RunEnd::Broken { error } => CaseVerdict::Breaks(error.time(), error.to_string()),
    }
}
