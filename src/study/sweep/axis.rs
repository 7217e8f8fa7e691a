//! A range of a parameter, as it is typed.

use crate::math;
use crate::numerals::rounded;
use crate::scene::SceneError;
use crate::scene::parameters::{self, Kind, Parameter, Value, named};
use crate::scene::words::quote;
use crate::study::sweep::MOST_ROWS;

/// A parameter and the values that it takes one after another.
#[derive(Debug, Clone)]
pub struct SweepAxis {
    /// The parameter.
    pub parameter: &'static Parameter,
    /// At least two values, all allowed and no two alike.
    pub values: Vec<Value>,
    /// As it was typed.
    pub written: String,
}

/// Why a text is not a range.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum AxisError {
    /// It does not look like one.
    #[error("must be NAME=START:END:COUNT, NAME=START:END:log:COUNT or a list NAME=A,B,C")]
    Form,
    /// No such parameter, or a value that it does not take.
    #[error(transparent)]
    Scene(#[from] SceneError),
    /// A range of words.
    #[error("{name} takes no range; give a list: {name}=A,B")]
    Words {
        /// The parameter.
        name: &'static str,
    },
    /// The number of values is none.
    #[error("COUNT = {count}: must be a whole number from 2 to {MOST_ROWS}")]
    Count {
        /// What was given.
        count: String,
    },
    /// Nothing lies between start and end.
    #[error("START and END are the same")]
    NoLength,
    /// A logarithmic range that comes to 0.
    #[error("log needs START and END above 0, or both below 0")]
    Log,
    /// A list of one.
    #[error("one value makes no range; use --set {name}={value}")]
    One {
        /// The parameter.
        name: &'static str,
        /// The value.
        value: String,
    },
    /// A value is in the list twice.
    #[error("{value} is in the list twice")]
    Repeated {
        /// The value.
        value: String,
    },
}

impl SweepAxis {
    /// Reads `name=start:end:count`, `name=start:end:log:count` or `name=a,b,c`.
    /// Whole numbers of a range are rounded, and those that fall together are taken once.
    ///
    /// # Errors
    /// When the text is none of these, or a value is not allowed.
    pub fn parse(text: &str) -> Result<Self, AxisError> {
        let (name, spec) = text.split_once('=').ok_or(AxisError::Form)?;
        let parameter = named(name.trim())?;
        let values = if spec.contains(':') {
            range(parameter, spec)?
        } else {
            list(parameter, spec)?
        };
        Ok(Self {
            parameter,
            values,
            written: format!("{}={}", parameter.name, quote(spec)),
        })
    }
}

fn list(parameter: &'static Parameter, spec: &str) -> Result<Vec<Value>, AxisError> {
    let mut values: Vec<Value> = Vec::new();
    for text in spec.split(',') {
        let value = parameters::parse(parameter, text)?;
        if values.contains(&value) {
            let value = value.to_string();
            return Err(AxisError::Repeated { value });
        }
        values.push(value);
    }
    match values.as_slice() {
        [value] => Err(AxisError::One {
            name: parameter.name,
            value: value.to_string(),
        }),
        _ => Ok(values),
    }
}

fn range(parameter: &'static Parameter, spec: &str) -> Result<Vec<Value>, AxisError> {
    let name = parameter.name;
    if matches!(parameter.kind, Kind::Flag | Kind::Choice(_)) {
        return Err(AxisError::Words { name });
    }
    let parts: Vec<&str> = spec.split(':').map(str::trim).collect();
    let (start, end, count, log) = match parts.as_slice() {
        [start, end, count] => (start, end, count, false),
        [start, end, "log", count] => (start, end, count, true),
        _ => return Err(AxisError::Form),
    };
    let (first, last) = (end_of(parameter, start)?, end_of(parameter, end)?);
    let count = match count.parse::<usize>() {
        Ok(k) if (2..=MOST_ROWS).contains(&k) => k,
        _ => {
            let count = quote(count);
            return Err(AxisError::Count { count });
        }
    };
    if first == last {
        return Err(AxisError::NoLength);
    }
    if log && first * last <= 0.0 {
        return Err(AxisError::Log);
    }
    let mut values: Vec<Value> = Vec::with_capacity(count);
    for k in 0..count {
        let value = value_of(parameter, between(first, last, k, count, log));
        parameter.check(value)?;
        // The values only rise or only fall.
        if values.last() != Some(&value) {
            values.push(value);
        }
    }
    Ok(values)
}

/// An end of a range, which the parameter must take too.
fn end_of(parameter: &'static Parameter, text: &str) -> Result<f64, AxisError> {
    Ok(match parameters::parse(parameter, text)? {
        Value::Whole(k) => k as f64,
        Value::Number(x) => x,
        Value::Flag(_) | Value::Choice(_) => {
            let name = parameter.name;
            return Err(AxisError::Words { name });
        }
    })
}

fn value_of(parameter: &Parameter, x: f64) -> Value {
    match parameter.kind {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "as saturates, and what is out of range is refused"
        )]
        Kind::Whole { .. } => Value::Whole(x.round() as u64),
        _ => Value::Number(x),
    }
}

/// Value `k` of `count` from `first` to `last`, both included. Those in between are
/// rounded to 15 digits, so that 1e-6:1e-3:log:4 gives 1e-5 and not its neighbour.
fn between(first: f64, last: f64, k: usize, count: usize, log: bool) -> f64 {
    if k == 0 {
        return first;
    }
    if k + 1 == count {
        return last;
    }
    let part = k as f64 / (count - 1) as f64;
    let x = if log {
        first * math::powf(last / first, part)
    } else {
        first + (last - first) * part
    };
    rounded(x, 15)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn values(text: &str) -> Vec<String> {
        let axis = SweepAxis::parse(text).expect("a range");
        axis.values.iter().map(Value::to_string).collect()
    }

    fn refused(text: &str) -> String {
        SweepAxis::parse(text).expect_err(text).to_string()
    }

    #[test]
    fn ranges_give_the_numbers_that_are_meant() {
        assert_eq!(
            values("restitution=0.1:0.5:5").join(" "),
            "0.1 0.2 0.3 0.4 0.5"
        );
        assert_eq!(
            values("contact_time=1e-6:1e-3:log:4").join(" "),
            "1e-6 1e-5 0.0001 0.001"
        );
        assert_eq!(values("v0=-1:-0.01:log:3").join(" "), "-1 -0.1 -0.01");
        assert_eq!(values("n=100:1:log:3").join(" "), "100 10 1");
        assert_eq!(
            values("t_c=1us:1ms:log:4"),
            values("contact_time=1e-6:1e-3:log:4")
        );
        // 1, 1.5, 2, 2.5, 3: ties are rounded up.
        assert_eq!(values("n=1:3:5").join(" "), "1 2 3");
        assert_eq!(values("n=1,2, 5").join(" "), "1 2 5");
        assert_eq!(values("jitter=on,off").join(" "), "true false");
    }

    #[test]
    fn what_is_no_range_is_told_in_a_line() {
        for (text, reason) in [
            ("restitution", "must be NAME="),
            ("restitution=0.5:0.9", "must be NAME="),
            ("restitution=0.5:0.9:lin:3", "must be NAME="),
            ("restituton=0.5:0.9:3", "did you mean restitution?"),
            ("restitution=0.5:0.9:1", "COUNT = 1: must be a whole number"),
            ("restitution=0.5:0.9:1e9", "COUNT = 1e9"),
            ("restitution=0.5:0.5:3", "are the same"),
            ("restitution=0.5:1.5:3", "restitution = 1.5: must be"),
            ("restitution=nan:1:3", "restitution = nan: must be"),
            ("s0=0:1e-3:log:3", "log needs"),
            ("v0=-1:1:log:3", "log needs"),
            ("n=0:5:3", "n = 0: must be"),
            ("n=1.5:5:3", "n = 1.5: must be"),
            ("jitter=on:off:2", "takes no range"),
            ("n=5", "use --set n=5"),
            ("n=5,7,5", "5 is in the list twice"),
            ("n=5,,7", "n = : must be"),
        ] {
            let line = refused(text);
            assert!(line.contains(reason), "{text}: {line}");
        }
    }
}
