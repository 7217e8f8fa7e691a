//! Where a power series of 32-digit numbers changes its sign: by dense samples, minima
//! between them included, and bisection.

use crate::double_double::Double;

/// Samples on [0, 1].
const SAMPLES: usize = 16;

/// A series and its derivative at `s`.
pub fn value_and_slope(series: &[Double], s: Double) -> (Double, Double) {
    let start = (Double::ZERO, Double::ZERO);
    series.iter().rev().fold(start, |(value, slope), c| {
        (value * s + *c, slope * s + value)
    })
}

/// The first s in [0, 1] where a series that should not be negative becomes so.
pub fn first_below_zero(series: &[Double]) -> Option<Double> {
    let leading = series.iter().find(|c| c.hi != 0.0)?;
    if series[0].hi <= 0.0 && leading.hi < 0.0 {
        return Some(Double::ZERO);
    }
    let rounding = 1e-13 * series.iter().map(|c| c.hi.abs()).sum::<f64>();
    let sample = |s: f64| {
        let start = (0.0, 0.0);
        let (value, slope) = series.iter().rev().fold(start, |(value, slope), c| {
            (value * s + c.hi, slope * s + value)
        });
        if value.abs() > rounding && slope.abs() > rounding * 32.0 {
            return (value, slope);
        }
        let (value, slope) = value_and_slope(series, s.into());
        (value.hi, slope.hi)
    };
    let width = 1.0 / SAMPLES as f64;
    let mut left = sample(0.0);
    for j in 0..SAMPLES {
        let (from, to) = (j as f64 * width, (j + 1) as f64 * width);
        let right = sample(to);
        let mut high = None;
        if right.0 < 0.0 {
            high = Some(Double::from(to));
        } else if left.1 < 0.0 && right.1 > 0.0 && left.0 + 2.0 * width * left.1 < 0.0 {
            // A minimum between the samples; where the slope changes its sign.
            let low = bisect(from.into(), to.into(), |s| {
                value_and_slope(series, s).1.hi > 0.0
            });
            high = (value_and_slope(series, low).0.hi < 0.0).then_some(low);
        }
        if let Some(high) = high {
            let below = |s| value_and_slope(series, s).0.hi < 0.0;
            return Some(bisect(from.into(), high, below));
        }
        left = right;
    }
    None
}

/// Where `beyond` becomes true between `low` and `high`, where it is.
fn bisect(mut low: Double, mut high: Double, beyond: impl Fn(Double) -> bool) -> Double {
    for _ in 0..110 {
        let middle = (low + high) * 0.5;
        if beyond(middle) {
            high = middle;
        } else {
            low = middle;
        }
        if (high - low).hi <= 1e-30 * high.hi {
            break;
        }
    }
    high
}
