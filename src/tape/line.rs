//! The lines of a tape, and their check sums.

use crate::scene::{Preset, Scene};
use serde::{Deserialize, Serialize};

/// What this program writes, and the newest that it reads.
pub(super) const VERSION: u32 = 1;

/// Where a hash begins (FNV-1a, Fowler, Noll and Vo).
pub(super) const SEED: u64 = 0xcbf2_9ce4_8422_2325;
const PRIME: u64 = 0x0100_0000_01b3;

/// What the check sum of a line stands behind, and how long it is with its quotes.
const SUM: &str = ",\"sum\":\"";
const DIGITS: usize = 16;

/// Why there is no tape; every sentence is one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TapeError {
    /// The first line is not that of a tape.
    #[error("line 1: this is no tape of beadlab")]
    NoTape,
    /// A later program wrote it.
    #[error("line 1: a tape of version {version}, and this beadlab reads version {VERSION}")]
    Newer {
        /// Its version.
        version: u32,
    },
    /// A line is not as it was written, or one before it is missing.
    #[error("line {line}: was altered, or a line before it is missing: its check sum is another")]
    Altered {
        /// Its number, from 1.
        line: usize,
    },
    /// A line is whole, but tells of nothing that this program has.
    #[error("line {line}: {why}")]
    Unknown {
        /// Its number, from 1.
        line: usize,
        /// What is wrong.
        why: String,
    },
    /// It was cut before it tells of anything.
    #[error("the tape is cut before its start: there is nothing to play")]
    Empty,
}

/// A line. Scenes are written as the lines of a preset file.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(rename_all = "lowercase")]
pub(super) enum TapeLine {
    /// What this is.
    Tape { version: u32, program: String },
    /// Columns that start at t = 0; all that was before counts no longer.
    Start { columns: Vec<String> },
    /// An edit.
    Edit {
        time: f64,
        columns: Vec<String>,
        from: Vec<usize>,
    },
    /// It goes on from a time before, after so many edits; what was later counts no longer.
    Back { time: f64, edits: usize },
    /// States.
    State { time: f64, hashes: Vec<String> },
}

/// FNV-1a, 64 bits.
pub(super) fn fnv(seed: u64, bytes: impl Iterator<Item = u8>) -> u64 {
    bytes.fold(seed, |hash, byte| {
        (hash ^ u64::from(byte)).wrapping_mul(PRIME)
    })
}

/// The check sums of the lines so far.
#[derive(Debug, Clone)]
pub(super) struct Sums(u64);

impl Default for Sums {
    fn default() -> Self {
        Self(SEED)
    }
}

impl Sums {
    /// A line as it is written, with its check sum and its end.
    pub fn write(&mut self, line: &TapeLine) -> String {
        let body = serde_json::to_string(line).unwrap_or_default();
        self.0 = fnv(self.0, body.bytes());
        let open = body.strip_suffix('}').unwrap_or(&body);
        format!("{open}{SUM}{:016x}\"}}\n", self.0)
    }

    /// The line of that number, if it is as it was written.
    pub fn check(&mut self, number: usize, text: &str) -> Result<TapeLine, TapeError> {
        let altered = match number {
            1 => TapeError::NoTape,
            line => TapeError::Altered { line },
        };
        let Some((open, sum)) = text.rsplit_once(SUM) else {
            return Err(altered);
        };
        let body = format!("{open}}}");
        let found = fnv(self.0, body.bytes());
        if sum.len() != DIGITS + 2 || sum != format!("{found:016x}\"}}") {
            // A newer one may have other sums; it says so itself.
            return Err(newer(number, text).unwrap_or(altered));
        }
        self.0 = found;
        serde_json::from_str(&body).map_err(|error| {
            newer(number, text).unwrap_or_else(|| TapeError::Unknown {
                line: number,
                why: crate::scene::words::one_line(&error.to_string()),
            })
        })
    }
}

/// The error of a first line that a later program wrote.
fn newer(number: usize, text: &str) -> Option<TapeError> {
    let value: serde_json::Value = serde_json::from_str(text).ok().filter(|_| number == 1)?;
    let version = value.get("tape")?.get("version")?.as_u64()?;
    let version = u32::try_from(version).unwrap_or(u32::MAX);
    (version > VERSION).then_some(TapeError::Newer { version })
}

/// The scenes of a line.
pub(super) fn scenes(number: usize, columns: &[String]) -> Result<Vec<Scene>, TapeError> {
    let scene = |text: &String| {
        Preset::parse("tape", text, "its scene")
            .map(|preset| preset.scene)
            .map_err(|error| TapeError::Unknown {
                line: number,
                why: error.to_string(),
            })
    };
    let scenes: Vec<Scene> = columns.iter().map(scene).collect::<Result<_, _>>()?;
    if scenes.is_empty() {
        let why = "no column".to_owned();
        return Err(TapeError::Unknown { line: number, why });
    }
    Ok(scenes)
}
