//! A session as lines of text: scenes, and the edits with the simulated time at which they
//! acted. Played again it gives the same bits, on every machine: hashes of the states tell.
//!
//! JSON Lines, an object a line: what the file is, then a start, edits, and hashes of the
//! state in between. A step back that went on otherwise leaves its line too. Each line has a
//! check sum over itself and all lines before it.

mod line;
mod player;
mod recorder;

pub use line::TapeError;
pub use player::{Player, Replay, sources};
pub use recorder::Recorder;

use crate::physics::State;
use crate::scene::Scene;
use line::{Sums, TapeLine, VERSION};

/// An edit of a session.
#[derive(Debug, Clone, PartialEq)]
pub struct Edit {
    /// When it acted, s.
    pub time: f64,
    /// What the columns are of from then on.
    pub scenes: Vec<Scene>,
    /// Which of the columns before each goes on from.
    pub from: Vec<usize>,
}

/// The columns' states at a time, as hashes; "" where an engine has failed.
#[derive(Debug, Clone, PartialEq)]
pub struct StateMark {
    /// When, s.
    pub time: f64,
    /// How many edits had acted.
    pub edits: usize,
    /// A hash a column.
    pub hashes: Vec<String>,
}

/// A session that can be played again.
#[derive(Debug, Clone, PartialEq)]
pub struct Tape {
    /// What the columns are of at t = 0.
    pub scenes: Vec<Scene>,
    /// The edits that count, by time.
    pub edits: Vec<Edit>,
    /// Their states, by time.
    pub marks: Vec<StateMark>,
    /// Where it was cut off, if it was: the number of its first line that is not whole.
    pub cut: Option<usize>,
}

impl Tape {
    /// Up to when it tells of the session, s.
    pub fn end(&self) -> f64 {
        let marked = self.marks.last().map_or(0.0, |mark| mark.time);
        let edited = self.edits.last().map_or(0.0, |edit| edit.time);
        marked.max(edited)
    }

    /// Reads the lines of a tape.
    ///
    /// # Errors
    /// When it is no tape, one of a newer version, or a line was altered, with that line.
    pub fn read(text: &str) -> Result<Tape, TapeError> {
        let mut sums = Sums::default();
        let mut tape: Option<Tape> = None;
        let mut cut = None;
        for (number, line) in (1..).zip(text.split_inclusive('\n')) {
            // What was being written when it ended.
            let Some(line) = line.strip_suffix('\n') else {
                cut = Some(number);
                break;
            };
            let line = sums.check(number, line)?;
            match (line, tape.as_mut()) {
                (TapeLine::Tape { version, .. }, _) if version > VERSION => {
                    return Err(TapeError::Newer { version });
                }
                (TapeLine::Tape { .. }, _) if number == 1 => {}
                (_, _) if number == 1 => return Err(TapeError::NoTape),
                (TapeLine::Start { columns }, _) => {
                    tape = Some(Tape {
                        scenes: line::scenes(number, &columns)?,
                        edits: Vec::new(),
                        marks: Vec::new(),
                        cut: None,
                    });
                }
                (
                    TapeLine::Edit {
                        time,
                        columns,
                        from,
                    },
                    Some(tape),
                ) => tape.edits.push(Edit {
                    time,
                    scenes: line::scenes(number, &columns)?,
                    from,
                }),
                (TapeLine::Back { time, edits }, Some(tape)) => {
                    tape.edits.truncate(edits);
                    tape.marks
                        .retain(|mark| mark.time <= time && mark.edits <= edits);
                }
                (TapeLine::State { time, hashes }, Some(tape)) => tape.marks.push(StateMark {
                    time,
                    edits: tape.edits.len(),
                    hashes,
                }),
                (_, _) => return Err(TapeError::Altered { line: number }),
            }
        }
        let mut tape = tape.ok_or(TapeError::Empty)?;
        tape.cut = cut;
        if tape
            .edits
            .windows(2)
            .any(|pair| pair[0].time > pair[1].time)
        {
            return Err(TapeError::Altered { line: 1 });
        }
        Ok(tape)
    }
}

/// The hashes of columns in these states; "" of one whose engine has failed.
pub fn hashes(states: impl Iterator<Item = Option<State>>) -> Vec<String> {
    let hash = |state: Option<State>| state.map_or_else(String::new, |state| digest(&state));
    states.map(hash).collect()
}

/// A hash of a column's whole motion: its time, its gaps and their rates, to the last bit
/// (FNV-1a, 64 bits).
fn digest(state: &State) -> String {
    let numbers = [state.time].into_iter();
    let numbers = numbers.chain(state.gaps.iter().copied());
    let bytes = numbers
        .chain(state.rates.iter().copied())
        .flat_map(|x| x.to_bits().to_le_bytes());
    format!("{:016x}", line::fnv(line::SEED, bytes))
}
