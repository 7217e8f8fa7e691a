//! Numbers as digits: rounded to so many, and written by rules that several rooms share.

use crate::math;

/// Digits of a number of which this part is not known, and one to spare.
pub fn digits(part: f64) -> usize {
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "between 1 and 17"
    )]
    let digits = (1.0 - math::log10(part).floor()).clamp(1.0, 17.0) as usize;
    digits
}

/// `x` to so many significant digits, one at least.
pub fn rounded(x: f64, digits: usize) -> f64 {
    let after = digits.saturating_sub(1);
    format!("{x:.after$e}").parse().unwrap_or(x)
}

/// The shortest text that reads as the same number: a decimal from 1e-4 to below `most`,
/// else with a power of ten.
pub fn shortest(x: f64, most: f64) -> String {
    if x == 0.0 || (1e-4..most).contains(&x.abs()) {
        x.to_string()
    } else {
        format!("{x:e}")
    }
}

/// `x` with so many significant digits: as a decimal where that is short.
pub fn significant(x: f64, count: usize) -> String {
    if x == 0.0 {
        return "0".to_owned();
    }
    let after = count.saturating_sub(1);
    let scientific = format!("{x:.after$e}");
    let exponent: i32 = scientific
        .split_once('e')
        .and_then(|(_, e)| e.parse().ok())
        .unwrap_or(0);
    let whole = i32::try_from(after).unwrap_or(i32::MAX);
    if (-3..=whole.max(2)).contains(&exponent) {
        let places = usize::try_from(whole.saturating_sub(exponent)).unwrap_or(0);
        return format!("{x:.places$}");
    }
    scientific
}

/// A decimal without the zeros at its end, but with `least` decimals as far as it has them.
pub fn trimmed(text: &str, least: usize) -> String {
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

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn what_is_not_known_takes_digits_away() {
        assert_eq!(rounded(123_456.0, digits(0.02)), 123_000.0);
        assert_eq!(rounded(-0.001_999_6, 4), -0.002);
        assert_eq!(rounded(7.0, 0), 7.0);
        assert_eq!(digits(0.0), 17);
        assert_eq!(digits(3.0), 1);
    }

    #[test]
    fn the_shortest_text_reads_as_the_same_number() {
        for x in [0.1 + 0.2, -1e-4, 9.9e-5, 999_999.5, 1e6, -0.0, f64::MAX] {
            let read: f64 = shortest(x, 1e6).parse().expect("a number");
            assert_eq!(read.to_bits(), x.to_bits());
        }
        assert_eq!(shortest(1e6, 1e6), "1e6");
        assert_eq!(shortest(1e6, 1e7), "1000000");
        assert_eq!(shortest(f64::NAN, 1e6), "NaN");
    }

    #[test]
    fn zeros_at_the_end_of_decimals_say_nothing() {
        assert_eq!(trimmed("1.2300", 0), "1.23");
        assert_eq!(trimmed("1.000", 0), "1");
        assert_eq!(trimmed("1.000", 2), "1.00");
        assert_eq!(trimmed("1.5", 4), "1.5");
        assert_eq!(trimmed("100", 0), "100");
    }
}
