//! Values and parameters in words for people.

use super::units::{self, PREFIXES};
use super::{Parameter, Value, table};
use crate::math;
use crate::numerals::{shortest, trimmed};
use std::fmt::{self, Display, Formatter};

/// Exactly as it may be typed back: SI units, shortest form.
impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Number(x) => f.write_str(&shortest(x, 1e6)),
            Self::Whole(k) => write!(f, "{k}"),
            Self::Flag(on) => write!(f, "{on}"),
            Self::Choice(word) => f.write_str(word),
        }
    }
}

/// To be read: up to four digits, SI prefix and unit, as in "7.0 µs".
pub fn display(parameter: &Parameter, value: Value) -> String {
    written(parameter, value, false)
}

/// The same without Unicode, as in "7.0 us".
pub fn display_ascii(parameter: &Parameter, value: Value) -> String {
    written(parameter, value, true)
}

fn written(parameter: &Parameter, value: Value, ascii: bool) -> String {
    match value {
        Value::Number(x) => with_unit(x, parameter.unit, ascii),
        Value::Flag(true) => "on".to_owned(),
        Value::Flag(false) => "off".to_owned(),
        Value::Whole(_) | Value::Choice(_) => value.to_string(),
    }
}

fn with_unit(x: f64, unit: &str, ascii: bool) -> String {
    if unit.is_empty() {
        return digits(x);
    }
    let (power, prefix) = prefix_of(x, unit, ascii);
    let unit = if ascii {
        units::in_ascii(unit)
    } else {
        unit.to_owned()
    };
    format!("{} {prefix}{unit}", digits(x / math::powi(10.0, power)))
}

/// The prefix that leaves one to three digits before the point, as far as the unit takes
/// one.
fn prefix_of(x: f64, unit: &str, ascii: bool) -> (i32, &'static str) {
    let powers = units::powers(unit);
    let power = (exponent(x).div_euclid(3) * 3).min(*powers.end());
    PREFIXES
        .iter()
        .find(|each| x != 0.0 && each.power == power && powers.contains(&power))
        .map_or((0, ""), |each| {
            (power, if ascii { each.ascii } else { each.symbol })
        })
}

/// Four significant digits without needless zeros, but at least two digits.
fn digits(x: f64) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let (mantissa, exponent) = scientific(x);
    if !(-3..6).contains(&exponent) {
        return format!("{}e{exponent}", trimmed(&mantissa, 1));
    }
    let decimals = usize::try_from(3 - exponent).unwrap_or(0);
    let least = usize::try_from(1 - exponent).unwrap_or(0);
    trimmed(&format!("{x:.decimals$}"), least)
}

/// The decimal exponent after rounding to four digits.
fn exponent(x: f64) -> i32 {
    scientific(x).1
}

/// Mantissa and exponent, rounded to four digits.
fn scientific(x: f64) -> (String, i32) {
    let text = format!("{x:.3e}");
    match text.split_once('e') {
        Some((mantissa, power)) => (mantissa.to_owned(), power.parse().unwrap_or(0)),
        None => (text, 0),
    }
}

/// Columns of help beside the names, of 80.
const BELOW: usize = 58;

/// The table as help text: a line for each parameter, and what else it is called and its
/// range below.
pub fn help() -> String {
    let mut lines = vec![
        "Parameters, by name or symbol; in SI units where none is typed, else in s, ms, us, ns,\n\
         ps, m, mm, um, nm, pm, Hz, kHz or MHz (u may be µ), as in t_c=4.6us:\n"
            .to_owned(),
    ];
    for parameter in table() {
        let Parameter { name, help, .. } = parameter;
        let mut others: Vec<&str> = Vec::new();
        for other in parameter.names().skip(1) {
            if other != *name && !others.contains(&other) {
                others.push(other);
            }
        }
        let (others, allowed) = (others.join(", "), parameter.allowed());
        let both = format!("{others}: {allowed}");
        let below = if others.is_empty() {
            vec![allowed]
        } else if both.chars().count() <= BELOW {
            vec![both]
        } else {
            vec![others + ":", allowed]
        };
        lines.push(format!("  {name:<18} {help}\n"));
        lines.extend(below.iter().map(|text| format!("  {:<18} {text}\n", "")));
    }
    lines.concat()
}
