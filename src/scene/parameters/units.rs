//! Numbers with units, as they are typed.

use super::Parameter;
use crate::scene::SceneError;
use crate::scene::words::quote;
use std::ops::RangeInclusive;

/// An SI prefix.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Prefix {
    /// The power of ten that it stands for.
    pub power: i32,
    /// As it is shown.
    pub symbol: &'static str,
    /// As it is shown on a terminal without Unicode.
    pub ascii: &'static str,
}

const fn prefix(power: i32, symbol: &'static str, ascii: &'static str) -> Prefix {
    Prefix {
        power,
        symbol,
        ascii,
    }
}

/// The prefixes, by powers of 1000 below and above 1.
pub const PREFIXES: [Prefix; 7] = [
    prefix(-12, "p", "p"),
    prefix(-9, "n", "n"),
    prefix(-6, "µ", "u"),
    prefix(-3, "m", "m"),
    prefix(0, "", ""),
    prefix(3, "k", "k"),
    prefix(6, "M", "M"),
];

/// The powers of ten whose prefixes a unit takes. Only plain units take any: 200 mm/s
/// reads worse than 0.20 m/s; and seconds and metres are not counted in thousands.
pub(super) fn powers(unit: &str) -> RangeInclusive<i32> {
    match unit {
        "s" | "m" => -12..=0,
        "Hz" => -3..=6,
        _ => 0..=0,
    }
}

/// A unit without Unicode.
pub(super) fn in_ascii(unit: &str) -> String {
    unit.replace('²', "^2")
}

/// Reads a number, and takes it into SI by the unit that may follow it; none where no
/// number stands first. It has the same bits as the number with a power of ten.
///
/// # Errors
/// When what follows is no unit of the parameter.
pub(super) fn read(parameter: &Parameter, text: &str) -> Result<Option<f64>, SceneError> {
    let (number, unit) = text.split_at(length(text));
    let unit = unit.trim_start();
    if number.is_empty() {
        return Ok(None);
    }
    match power(parameter.unit, unit) {
        Some(power) => Ok(shifted(number, power)),
        // Another number is no unit.
        None if unit.starts_with(|c: char| c.is_ascii_digit() || c == '.') => Ok(None),
        None => Err(SceneError::Unit {
            name: parameter.name,
            value: quote(text),
            unit: quote(unit),
            allowed: allowed(parameter, &quote(unit)),
        }),
    }
}

/// How many bytes of the text are a number.
fn length(text: &str) -> usize {
    let bytes = text.as_bytes();
    let is = |at: usize, any: &[u8]| bytes.get(at).is_some_and(|byte| any.contains(byte));
    let digits = |from: usize| {
        let rest = bytes.iter().skip(from);
        rest.take_while(|byte| byte.is_ascii_digit()).count()
    };
    let start = usize::from(is(0, b"+-"));
    let whole = digits(start);
    let mut end = start + whole;
    let mut decimals = 0;
    if is(end, b".") {
        decimals = digits(end + 1);
        end += 1 + decimals;
    }
    if whole + decimals == 0 {
        return 0;
    }
    if is(end, b"eE") {
        let power = end + 1 + usize::from(is(end + 1, b"+-"));
        if digits(power) > 0 {
            end = power + digits(power);
        }
    }
    end
}

/// The power of ten by which a typed unit differs from that of the parameter; a bare
/// number is in SI.
fn power(unit: &str, typed: &str) -> Option<i32> {
    // There are two characters that look like this: micro, and the Greek letter.
    let typed = typed.replace('μ', "µ");
    let plain = [unit.to_owned(), in_ascii(unit), unit.replace('²', "2")];
    if typed.is_empty() || plain.contains(&typed) {
        return Some(0);
    }
    let prefix = typed.strip_suffix(unit).filter(|_| !unit.is_empty())?;
    PREFIXES
        .iter()
        .filter(|each| powers(unit).contains(&each.power))
        .find(|each| prefix == each.symbol || prefix == each.ascii)
        .map(|each| each.power)
}

/// The number times a power of ten, rounded once.
fn shifted(number: &str, power: i32) -> Option<f64> {
    let (mantissa, exponent) = number.split_once(['e', 'E']).unwrap_or((number, "0"));
    let exponent: i32 = exponent.parse().ok()?;
    let exponent = exponent.checked_add(power)?;
    format!("{mantissa}e{exponent}").parse().ok()
}

/// What units are allowed in the place of a wrong one, as the end of a sentence.
fn allowed(parameter: &Parameter, wrong: &str) -> String {
    if parameter.unit.is_empty() {
        return format!("{}, without a unit", parameter.allowed());
    }
    let units: Vec<String> = PREFIXES
        .iter()
        .rev()
        .filter(|each| powers(parameter.unit).contains(&each.power))
        .map(|each| format!("{}{}", each.ascii, parameter.unit))
        .collect();
    let units = match units.split_last() {
        Some((last, rest)) if !rest.is_empty() => format!("{} or {last}", rest.join(", ")),
        _ => units.concat(),
    };
    format!("in {units}, not in {wrong}")
}
