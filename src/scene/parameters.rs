//! The one table of parameters: `--set`, preset files, errors, help and the
//! explorer's panel all read it. A new parameter is a new row.

mod access;
mod display;
mod layer;
mod nudge;
mod rows;
mod units;

pub use display::{display, display_ascii, help};
pub use layer::Setting;
pub use nudge::nudge;
pub use units::{PREFIXES, Prefix};

use super::words::{did_you_mean, quote};
use super::{Facts, SceneError};

/// A value of a parameter.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Value {
    /// A number, in SI units.
    Number(f64),
    /// A whole number.
    Whole(u64),
    /// Yes or no.
    Flag(bool),
    /// One of a few words.
    Choice(&'static str),
}

/// What values a parameter takes, and how a key press moves it.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Kind {
    /// A finite number from `min` to `max`.
    Number {
        /// Smallest value, SI.
        min: f64,
        /// Largest value, SI.
        max: f64,
        /// How a key press moves it.
        scale: NudgeScale,
    },
    /// A whole number from `min` to `max`.
    Whole {
        /// Smallest value.
        min: u64,
        /// Largest value.
        max: u64,
        /// Step of one key press.
        fine: u64,
        /// Step of one coarse key press.
        coarse: u64,
    },
    /// Yes or no.
    Flag,
    /// One of a few words.
    Choice(&'static [&'static str]),
}

/// What one key press does to a number.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum NudgeScale {
    /// Adds a step, SI.
    Linear {
        /// Step of one key press.
        fine: f64,
        /// Step of one coarse key press.
        coarse: f64,
    },
    /// Multiplies by a factor.
    Log {
        /// Factor of one key press.
        fine: f64,
        /// Factor of one coarse key press.
        coarse: f64,
        /// Smallest value above 0: one press further down is the least allowed.
        smallest: f64,
    },
}

/// A row of the table.
#[derive(Debug)]
pub struct Parameter {
    /// Name in files, on the command line and in errors.
    pub name: &'static str,
    /// The paper's symbol.
    pub symbol: &'static str,
    /// The symbol on a terminal without Unicode.
    pub symbol_ascii: &'static str,
    /// What else it is called.
    pub aliases: &'static [&'static str],
    /// SI unit; empty for a pure number.
    pub unit: &'static str,
    /// What it is, in a few words.
    pub help: &'static str,
    /// What values it takes.
    pub kind: Kind,
    /// What else bounds it, to follow the range in a sentence; may be empty.
    pub note: &'static str,
    /// Which scenes have it, to begin a sentence: "vibrating floors".
    pub belongs_to: &'static str,
    /// Whether an edit acts on the running state; otherwise the scene restarts.
    pub live: bool,
    /// Whether a scene that has the parameter may leave it without a value.
    pub optional: bool,
    /// Whether a file must give it, where the scene has it and nothing else says it.
    pub needed: bool,
    /// When it is set among others of a layer: the lower ones first.
    pub order: u8,
    /// Its value in a scene, if the scene has one.
    pub get: fn(&Facts) -> Option<Value>,
    /// Puts a value that [`Parameter::check`] allows into a scene that has it.
    pub set: fn(&mut Facts, Value),
}

/// All parameters, in the order in which they are shown.
pub fn table() -> &'static [Parameter] {
    rows::ROWS
}

/// The parameter of that name.
pub fn find(name: &str) -> Option<&'static Parameter> {
    table().iter().find(|parameter| parameter.name == name)
}

/// The parameter that is called so: by its name, which may have spaces as on the screen,
/// by its symbol, or by an alias.
pub fn called(name: &str) -> Option<&'static Parameter> {
    let name = name.trim().replace(' ', "_");
    let is = |parameter: &&Parameter| parameter.names().any(|each| each == name);
    table().iter().find(is)
}

/// The parameter that is called so, or what may have been meant.
///
/// # Errors
/// When there is none.
pub fn named(name: &str) -> Result<&'static Parameter, SceneError> {
    called(name).ok_or_else(|| {
        let mut hint = did_you_mean(name, table().iter().flat_map(Parameter::names));
        if hint.is_empty() {
            let names: Vec<_> = table().iter().map(|parameter| parameter.name).collect();
            hint = format!("; there are {}", names.join(", "));
        }
        SceneError::Unknown {
            name: quote(name),
            hint,
        }
    })
}

/// Reads a value as it is typed: numbers in SI units, or with a unit as in "4.6us", flags
/// as true or false.
///
/// # Errors
/// When the text is not a value that the parameter takes.
pub fn parse(parameter: &Parameter, text: &str) -> Result<Value, SceneError> {
    let text = text.trim();
    let value = match parameter.kind {
        Kind::Number { .. } => units::read(parameter, text)?.map(Value::Number),
        Kind::Whole { .. } => match text.parse() {
            Ok(k) => Some(Value::Whole(k)),
            Err(_) => units::read(parameter, text)?.and_then(whole),
        },
        Kind::Flag => match text {
            "true" | "on" | "yes" => Some(Value::Flag(true)),
            "false" | "off" | "no" => Some(Value::Flag(false)),
            _ => None,
        },
        Kind::Choice(words) => words
            .iter()
            .find(|&&word| word == text)
            .map(|&word| Value::Choice(word)),
    };
    value
        .filter(|&value| parameter.allows(value))
        .ok_or_else(|| parameter.refuse(&quote(text)))
}

/// A whole number that is written as in 1e3.
fn whole(x: f64) -> Option<Value> {
    // From 2^53 on the number may stand for a neighbour of what was typed.
    let exact = x.fract() == 0.0 && (0.0..9_007_199_254_740_992.0).contains(&x);
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "a whole number in range"
    )]
    exact.then_some(Value::Whole(x as u64))
}

impl Parameter {
    /// What it is called: its name first, then symbols and aliases. Some may be alike.
    pub fn names(&self) -> impl Iterator<Item = &'static str> + use<> {
        let symbols = [self.name, self.symbol, self.symbol_ascii];
        symbols.into_iter().chain(self.aliases.iter().copied())
    }

    /// Whether the scene has this parameter, with or without a value.
    pub fn applies(&self, facts: &Facts) -> bool {
        self.optional || (self.get)(facts).is_some()
    }

    /// Whether the value is of the right type, finite and in range.
    pub fn allows(&self, value: Value) -> bool {
        match (self.kind, value) {
            // A NaN is in no range.
            (Kind::Number { min, max, .. }, Value::Number(x)) => (min..=max).contains(&x),
            (Kind::Whole { min, max, .. }, Value::Whole(k)) => (min..=max).contains(&k),
            (Kind::Flag, Value::Flag(_)) => true,
            (Kind::Choice(words), Value::Choice(word)) => words.contains(&word),
            _ => false,
        }
    }

    /// Refuses a value that is of the wrong type, not finite or out of range.
    ///
    /// # Errors
    /// When it is.
    pub fn check(&self, value: Value) -> Result<(), SceneError> {
        if self.allows(value) {
            Ok(())
        } else {
            Err(self.refuse(&value.to_string()))
        }
    }

    /// The error of a value, as it was written, that is not allowed.
    pub(crate) fn refuse(&self, written: &str) -> SceneError {
        SceneError::Invalid {
            name: self.name,
            value: written.to_owned(),
            allowed: self.allowed(),
        }
    }

    /// What values are allowed, as the end of a sentence: "a number from 0 to 1".
    pub fn allowed(&self) -> String {
        let range = match self.kind {
            Kind::Number { min, max, .. } => {
                let unit = if self.unit.is_empty() { "" } else { " " };
                format!(
                    "a number from {} to {}{unit}{}",
                    Value::Number(min),
                    Value::Number(max),
                    self.unit
                )
            }
            Kind::Whole { min, max, .. } => format!("a whole number from {min} to {max}"),
            Kind::Flag => "true or false".to_owned(),
            Kind::Choice(words) => words.join(" or "),
        };
        range + self.note
    }
}

#[cfg(test)]
mod tests;
