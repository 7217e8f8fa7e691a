//! Numbers in words for people: few digits, units with a prefix.

use crate::math;
use crate::scene::parameters::PREFIXES;

/// Two or three significant digits: `0.034`, `12.5`, `1.2e-6`; and `0`.
pub fn short(x: f64) -> String {
    if !x.is_finite() {
        return if x > 0.0 { "∞".into() } else { "?".into() };
    }
    match x.abs() {
        0.0 => "0".into(),
        size if !(0.000_995..9999.5).contains(&size) => scientific(x),
        size if size >= 99.95 => format!("{x:.0}"),
        size if size >= 9.995 => format!("{x:.1}"),
        size if size >= 0.0995 => format!("{x:.2}"),
        size if size >= 0.00995 => format!("{x:.3}"),
        _ => format!("{x:.4}"),
    }
}

/// Two significant digits and a power of ten.
pub fn scientific(x: f64) -> String {
    format!("{x:.1e}")
}

/// The largest power of ten with a prefix here.
const LARGEST: i32 = 3;

/// The unit to write a quantity of about `size` in: its factor and prefix. Numbers that
/// round to 1000 of one are written as 1.00 of the next.
pub fn prefix(size: f64) -> (f64, &'static str) {
    let size = size.abs();
    let mut best = (1.0, "");
    if size > 0.0 && size.is_finite() {
        best = (1e-12, "p");
        for prefix in PREFIXES.iter().filter(|prefix| prefix.power <= LARGEST) {
            let factor = math::powi(10.0, prefix.power);
            if size >= factor * 0.9995 {
                best = (factor, prefix.symbol);
            }
        }
    }
    best
}

/// A quantity with its unit: `7.0 µs`, `1.24 mm`.
pub fn with_unit(x: f64, unit: &str) -> String {
    let (factor, prefix) = prefix(x);
    format!("{} {prefix}{unit}", short(x / factor))
}

/// A time to read off a running clock: so many decimals that a page of length
/// `span` is divided in a hundred, in the unit that suits the page.
pub fn clock(time: f64, span: f64) -> String {
    let (factor, prefix) = if span >= 0.01 {
        (1.0, "")
    } else {
        prefix(span)
    };
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=6"
    )]
    let decimals = (2.0 - math::log10(span / factor).floor()).clamp(0.0, 6.0) as usize;
    format!("{:.decimals$} {prefix}s", time / factor)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn few_digits() {
        assert_eq!(short(0.0), "0");
        assert_eq!(short(0.412_34), "0.41");
        assert_eq!(short(0.031_6), "0.032");
        assert_eq!(short(12.345), "12.3");
        assert_eq!(short(1.2e-6), "1.2e-6");
        assert_eq!(short(f64::INFINITY), "∞");
        assert_eq!(short(f64::NAN), "?");
    }

    #[test]
    fn units_have_prefixes() {
        assert_eq!(with_unit(7e-6, "s"), "7.00 µs");
        assert_eq!(with_unit(1.24e-3, "m"), "1.24 mm");
        assert_eq!(with_unit(0.0, "m"), "0 m");
        assert_eq!(with_unit(999.96e-6, "m"), "1.00 mm");
        assert_eq!(with_unit(999.4e-6, "m"), "999 µm");
        assert_eq!(with_unit(1e-16, "m"), "1.0e-4 pm");
    }

    #[test]
    fn a_clock_suits_its_page() {
        assert_eq!(clock(1.2345, 0.3), "1.234 s");
        assert_eq!(clock(0.000_21, 0.000_3), "210 µs");
    }
}
