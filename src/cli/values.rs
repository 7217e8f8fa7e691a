//! Values of options, and what is wrong with those that are none.

/// A number above 0.
pub(super) fn positive(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if x > 0.0 && x.is_finite() => Ok(x),
        _ => Err("must be a number above 0".to_owned()),
    }
}

/// Seconds that a person would wait.
pub(super) fn budget(text: &str) -> Result<f64, String> {
    match positive(text)? {
        x if x <= 1e6 => Ok(x),
        _ => Err("must be a number above 0 and at most 1e6".to_owned()),
    }
}

/// A part of something that may differ.
pub(super) fn tolerance(text: &str) -> Result<f64, String> {
    match text.parse::<f64>() {
        Ok(x) if (1e-12..=1.0).contains(&x) => Ok(x),
        _ => Err("must be a number from 1e-12 to 1".to_owned()),
    }
}

/// Two contact times, the shorter one first.
pub(super) fn between(text: &str) -> Result<(f64, f64), String> {
    let parts = text.split_once(':');
    let numbers = parts.and_then(|(a, b)| Some((positive(a).ok()?, positive(b).ok()?)));
    match numbers {
        Some((from, to)) if from < to => Ok((from, to)),
        _ => Err("must be two numbers above 0, the smaller one first, like 1e-7:1e-4".to_owned()),
    }
}

/// A number, or a fraction like 1/50.
pub(super) fn speed(text: &str) -> Result<f64, String> {
    let value = match text.split_once('/') {
        Some((above, below)) => positive(above)? / positive(below)?,
        None => positive(text)?,
    };
    positive(&value.to_string())
}
