//! What a run gives, described once: names, units, meanings, where each number comes from
//! and how well it is known. `run` in all its formats, `sweep` and the explorer read it. One
//! more is a row of [`table`], and what measures it, if nothing does yet.

mod rows;

use super::measure::Results;
use super::sensitivity::{Measured, Sensitivity};
use super::table::Cell;
use super::verdict::Verdict;
use crate::physics::Observation;
use crate::scene::{Preset, Scene};

/// A quantity.
#[derive(Debug, Clone, Copy)]
pub struct Quantity {
    /// Its name, in every format.
    pub name: &'static str,
    /// SI unit; empty for pure numbers, counts and words.
    pub unit: &'static str,
    /// How it is seen of a column that moves, if it is.
    pub seen: Option<Seen>,
    meaning: Meaning,
    source: Source,
}

/// What the explorer shows of a column at any moment.
#[derive(Debug, Clone, Copy)]
pub struct Seen {
    /// What it is called there.
    pub symbol: &'static str,
    /// Where it stands: what has a higher rank is given up first.
    pub rank: u8,
    /// Which scenes have it.
    pub of: fn(&Scene) -> bool,
    /// Its value now; empty as long as it has none.
    pub now: fn(&Observation) -> Cell,
}

/// What it is, in a few words.
#[derive(Debug, Clone, Copy)]
enum Meaning {
    Always(&'static str),
    /// Under a linear law, or none, and under power laws.
    ByLaw(&'static str, &'static str),
    /// Where it depends on what else the scene is.
    Of(fn(&Scene) -> &'static str),
}

/// Where it comes from.
#[derive(Debug, Clone, Copy)]
enum Source {
    /// What was run by that name.
    Preset(fn(&Preset) -> Cell),
    /// What was run, exactly.
    Scene(fn(&Scene) -> Cell),
    /// The same of a lattice; columns do not even have the name.
    Lattice(fn(&Scene) -> Cell),
    /// A result of the run, whose digits are measured.
    Result(Measured),
    /// An error, or what is no better known than one: two digits.
    Rough(fn(&Results) -> Option<f64>),
    /// A relative change of a result: two digits.
    Change(fn(&Sensitivity) -> Option<f64>),
    /// A whole number of the run.
    Count(fn(&Scene, &Results) -> Option<u64>),
    /// Simulated time, exactly.
    Time(fn(&Results) -> f64),
    /// Of the machine that ran it, by the seconds that it took: another run gives another
    /// value.
    Machine(fn(&Results, f64) -> f64),
    /// The verdict on the scene's soft contacts.
    Verdict(fn(&Verdict) -> Cell),
}

/// All of them, in the order in which they are written.
pub fn table() -> &'static [Quantity] {
    &rows::ROWS
}

/// Those of a run itself: the columns of a sweep.
pub fn of_runs() -> impl Iterator<Item = &'static Quantity> {
    table().iter().filter(|quantity| {
        matches!(
            quantity.source,
            Source::Result(_)
                | Source::Rough(_)
                | Source::Change(_)
                | Source::Count(_)
                | Source::Time(_)
        )
    })
}

/// The results whose digits are measured, by name.
pub(super) fn measured() -> impl Iterator<Item = (&'static str, Measured)> {
    table().iter().filter_map(|quantity| match quantity.source {
        Source::Result(measured) => Some((quantity.name, measured)),
        _ => None,
    })
}

/// A run, and what is known of it.
#[derive(Debug, Clone, Copy)]
pub(super) struct Run<'a> {
    pub scene: &'a Scene,
    pub results: &'a Results,
    pub sensitivity: &'a Sensitivity,
}

/// What else `beadlab run` says.
#[derive(Debug, Clone, Copy)]
pub(super) struct Around<'a> {
    pub preset: &'a Preset,
    /// Time that the run took, s.
    pub wall_time: f64,
    pub verdict: &'a Verdict,
}

/// The part of an error that is printed.
const ROUGHLY: f64 = 0.1;

impl Quantity {
    /// What it is, of a scene, in a few words; may be empty.
    pub fn meaning(&self, scene: &Scene) -> &'static str {
        match self.meaning {
            Meaning::ByLaw(_, words) if has_powers(scene) => words,
            Meaning::Always(words) | Meaning::ByLaw(words, _) => words,
            Meaning::Of(words) => words(scene),
        }
    }

    /// Whether it is of the machine, not of the scene: another run gives another value.
    pub fn is_of_the_machine(&self) -> bool {
        matches!(self.source, Source::Machine(_))
    }

    /// Whether it is an error, or no better known than one.
    pub fn is_rough(&self) -> bool {
        matches!(self.source, Source::Rough(_) | Source::Change(_))
    }

    /// Whether its values are whole numbers.
    pub fn is_count(&self) -> bool {
        matches!(self.source, Source::Count(_))
    }

    /// Whether every run has it.
    pub fn is_certain(&self) -> bool {
        matches!(self.source, Source::Time(_))
    }

    /// Whether results of such a scene have it, be it empty.
    pub(super) fn is_of(&self, scene: &Scene) -> bool {
        !matches!(self.source, Source::Lattice(_)) || scene.sites().is_some()
    }

    /// Its value with all its digits; empty where there is none.
    pub(super) fn value(&self, run: Run, around: Option<Around>) -> Cell {
        let (results, sensitivity) = (run.results, run.sensitivity);
        match (self.source, around) {
            (Source::Preset(get), Some(around)) => get(around.preset),
            (Source::Machine(get), Some(around)) => Cell::Number(get(results, around.wall_time)),
            (Source::Verdict(get), Some(around)) => get(around.verdict),
            (Source::Preset(_) | Source::Machine(_) | Source::Verdict(_), None) => Cell::Empty,
            (Source::Scene(get) | Source::Lattice(get), _) => get(run.scene),
            (Source::Result(measured), _) => number((measured.get)(results)),
            (Source::Rough(get), _) => number(get(results)),
            (Source::Change(get), _) => number(get(sensitivity)),
            (Source::Count(get), _) => get(run.scene, results).into(),
            (Source::Time(get), _) => Cell::Number(get(results)),
        }
    }

    /// The part of it that is not known; none of what is exact.
    pub(super) fn unknown(&self, run: Run) -> Option<f64> {
        match self.source {
            Source::Result(measured) => {
                run.sensitivity
                    .unknown(self.name, measured, run.scene, run.results)
            }
            _ => self.is_rough().then_some(ROUGHLY),
        }
    }
}

/// Whether contacts depend on the speed, as under power laws.
fn has_powers(scene: &Scene) -> bool {
    scene.law().is_some_and(|law| law.power().is_some())
}

/// A number that is as it is, finite or not: one that is not is no result, but an error.
fn number(x: Option<f64>) -> Cell {
    x.map_or(Cell::Empty, Cell::Number)
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::collections::HashSet;

    #[test]
    fn names_are_names_and_no_two_are_the_same() {
        let names: HashSet<&str> = table().iter().map(|quantity| quantity.name).collect();
        assert_eq!(names.len(), table().len());
        let is_plain = |c: char| c.is_ascii_lowercase() || c.is_ascii_digit() || c == '_';
        assert!(names.iter().all(|name| name.chars().all(is_plain)));
    }

    #[test]
    fn every_sensitivity_is_that_of_a_result() {
        for quantity in table() {
            let Source::Change(_) = quantity.source else {
                continue;
            };
            let Some(of) = quantity.name.strip_suffix("_sensitivity") else {
                continue;
            };
            assert!(measured().any(|(name, _)| name == of), "{of}");
        }
    }
}
