//! Axes: what is plotted along them, on which scale, with which ticks.

use super::Bounds;
use crate::math;

/// How numbers are laid out along an axis.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum AxisScale {
    /// Equal distances are equal differences.
    Linear,
    /// Equal distances are equal ratios; only numbers above 0 have a place.
    Log,
}

/// An axis.
#[derive(Debug, Clone, PartialEq)]
pub struct Axis {
    /// What is plotted along it, with its unit.
    pub label: String,
    /// How.
    pub scale: AxisScale,
}

/// A mark on an axis.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Tick {
    /// Where, in the coordinates of the scale.
    pub place: f64,
    /// What stands there.
    pub label: String,
}

impl Axis {
    /// An axis whose equal distances are equal differences.
    pub fn linear(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            scale: AxisScale::Linear,
        }
    }

    /// An axis whose equal distances are equal ratios.
    pub fn log(label: impl Into<String>) -> Self {
        Self {
            label: label.into(),
            scale: AxisScale::Log,
        }
    }

    /// Where a number is, in the coordinates of the scale; none where it has no place.
    pub(super) fn place(&self, x: f64) -> Option<f64> {
        let place = match self.scale {
            AxisScale::Linear => x,
            AxisScale::Log if x > 0.0 => math::log10(x),
            AxisScale::Log => return None,
        };
        // Beyond that differences of places overflow.
        (place.abs() < 1e300).then_some(place)
    }

    /// A span that holds all places with a little room about them.
    pub(super) fn bounds(&self, places: impl Iterator<Item = f64>) -> Option<Bounds> {
        let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
        for place in places {
            low = low.min(place);
            high = high.max(place);
        }
        if low > high {
            return None;
        }
        // One number alone gets a span of its own size.
        let least = match self.scale {
            AxisScale::Log => 1.0,
            AxisScale::Linear => (low.abs().max(high.abs()) * 1e-6).max(f64::MIN_POSITIVE * 1e6),
        };
        let room = (0.05 * (high - low)).max(0.5 * (least - (high - low)));
        let (mut from, mut to) = (low - room, high + room);
        // Many quantities begin at 0, and then so does their axis.
        if self.scale == AxisScale::Linear && low >= 0.0 && low <= 0.2 * high {
            from = 0.0;
        }
        if from >= to {
            (from, to) = (low - 1.0, low + 1.0);
        }
        Some(Bounds {
            low: from,
            high: to,
        })
    }

    /// At most about `most` ticks within the bounds, at round numbers.
    pub(super) fn ticks(&self, bounds: Bounds, most: usize) -> Vec<Tick> {
        let most = most.max(2) as f64;
        let step = match self.scale {
            AxisScale::Linear => round_step((bounds.high - bounds.low) / most),
            AxisScale::Log => ((bounds.high - bounds.low) / most).ceil().max(1.0),
        };
        let mut ticks = self.multiples(bounds, step);
        // Less than two decades: 1, 2, 5 within them.
        if self.scale == AxisScale::Log && ticks.len() < 3 {
            ticks = one_two_five(bounds);
        }
        ticks
    }

    fn multiples(&self, bounds: Bounds, step: f64) -> Vec<Tick> {
        let first = (bounds.low / step).ceil();
        let count = ((bounds.high - first * step) / step).floor();
        let mut ticks = Vec::new();
        let mut k = 0.0;
        // A hundred is more than any picture has; it ends whatever the bounds.
        while k <= count && k < 100.0 {
            let place = (first + k) * step;
            let label = match self.scale {
                AxisScale::Linear => linear_label(place, step),
                AxisScale::Log => power_label(1, place),
            };
            ticks.push(Tick { place, label });
            k += 1.0;
        }
        ticks
    }
}

/// Ticks within a decade or two.
fn one_two_five(bounds: Bounds) -> Vec<Tick> {
    let mut ticks = Vec::new();
    let mut decade = bounds.low.floor();
    while decade <= bounds.high {
        for digit in [1_u8, 2, 5] {
            let place = decade + math::log10(f64::from(digit));
            if (bounds.low..=bounds.high).contains(&place) {
                let label = power_label(digit, decade);
                ticks.push(Tick { place, label });
            }
        }
        decade += 1.0;
    }
    ticks
}

/// The nearest 1, 2 or 5 times a power of ten that is not below `step`.
fn round_step(step: f64) -> f64 {
    let power = math::powf(10.0, math::log10(step).floor());
    let step = [1.0, 2.0, 5.0, 10.0]
        .into_iter()
        .map(|digit| digit * power)
        .find(|&round| round >= step * (1.0 - 1e-9));
    step.unwrap_or(10.0 * power)
}

/// A decimal with as many places as the step needs, where that is short.
fn linear_label(x: f64, step: f64) -> String {
    let size = x.abs().max(step);
    if !(1e-3..1e5).contains(&size) && x != 0.0 {
        // Digits down to the step, so that neighbours differ.
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 15"
        )]
        let digits =
            (math::log10(size).floor() - math::log10(step).floor()).clamp(0.0, 15.0) as usize;
        return format!("{x:.digits$e}");
    }
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "0 to 15"
    )]
    let places = (-math::log10(step).floor()).clamp(0.0, 15.0) as usize;
    // −0 is a sign that means nothing.
    format!("{:.places$}", x + 0.0)
}

/// `digit`·10^`exponent`: in decimals near 1.
fn power_label(digit: u8, exponent: f64) -> String {
    if (-2.0..=3.0).contains(&exponent) {
        let x = f64::from(digit) * math::powf(10.0, exponent);
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "0 to 2"
        )]
        let places = (-exponent).max(0.0) as usize;
        return format!("{x:.places$}");
    }
    format!("{digit}e{exponent:.0}")
}
