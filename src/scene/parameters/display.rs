//! Values and parameters in words for people.

use super::{Parameter, Value, table};
use crate::math;
use std::fmt::{self, Display, Formatter};

/// SI prefixes by powers of 1000 below and above 1.
const PREFIXES: [(i32, &str, &str); 7] = [
    (-12, "p", "p"),
    (-9, "n", "n"),
    (-6, "µ", "u"),
    (-3, "m", "m"),
    (0, "", ""),
    (3, "k", "k"),
    (6, "M", "M"),
];

/// Exactly as it may be typed back: SI units, shortest form.
impl Display for Value {
    fn fmt(&self, f: &mut Formatter<'_>) -> fmt::Result {
        match *self {
            Self::Number(x) if x == 0.0 || (1e-4..1e6).contains(&x.abs()) => write!(f, "{x}"),
            Self::Number(x) if x.is_finite() => write!(f, "{x:e}"),
            Self::Number(x) => write!(f, "{x}"),
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
        unit.replace('²', "^2")
    } else {
        unit.to_owned()
    };
    format!("{} {prefix}{unit}", digits(x / math::powi(10.0, power)))
}

/// The prefix that leaves one to three digits before the point. Only plain units
/// take one: 200 mm/s reads worse than 0.20 m/s.
fn prefix_of(x: f64, unit: &str, ascii: bool) -> (i32, &'static str) {
    let plain = matches!(unit, "s" | "m" | "Hz");
    let power = exponent(x).div_euclid(3) * 3;
    // Seconds and metres are not counted in thousands.
    let largest = if unit == "Hz" { 6 } else { 0 };
    PREFIXES
        .iter()
        .find(|&&(of, ..)| plain && x != 0.0 && of == power.min(largest))
        .map_or((0, ""), |&(of, prefix, typed)| {
            (of, if ascii { typed } else { prefix })
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

/// Drops zeros at the end, but keeps `least` decimals.
fn trimmed(text: &str, least: usize) -> String {
    let Some((whole, decimals)) = text.split_once('.') else {
        return text.to_owned();
    };
    let kept = decimals
        .trim_end_matches('0')
        .len()
        .max(least.min(decimals.len()));
    if kept == 0 {
        whole.to_owned()
    } else {
        format!("{whole}.{}", &decimals[..kept])
    }
}

/// The table as help text: a line for each parameter, and its range below.
pub fn help() -> String {
    let mut lines = vec!["Parameters (SI units):\n".to_owned()];
    for parameter in table() {
        let Parameter { name, help, .. } = parameter;
        lines.push(format!(
            "  {name:<18} {help}\n  {:<18} {}\n",
            "",
            parameter.allowed()
        ));
    }
    lines.concat()
}
