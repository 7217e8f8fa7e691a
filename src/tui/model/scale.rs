//! The vertical scale of the traces: round ticks that hold what is seen.

use crate::live::{ColumnSample, Sample};
use crate::math;

/// Ticks that a scale should have about.
const TICKS: f64 = 4.0;
/// A page that needs less than this part of the scale gets a smaller one.
const LOOSE: f64 = 0.55;

/// A vertical scale from `low` to `high` ticks.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Scale {
    /// Distance of two ticks, m: 1, 2 or 5 times a power of ten.
    pub tick: f64,
    /// Lower end, in ticks.
    pub low: f64,
    /// Upper end, in ticks.
    pub high: f64,
}

impl Scale {
    /// The scale that holds everything from `bottom` to `top`, m.
    pub fn holding(bottom: f64, top: f64) -> Scale {
        let (bottom, top) = (finite(bottom), finite(top).max(finite(bottom)));
        let extent = (top - bottom).max(1e-12).max(1e-9 * top.abs());
        let tick = round_up(extent / TICKS);
        let (low, high) = ((bottom / tick).floor(), (top / tick).ceil());
        Scale {
            tick,
            low,
            high: high.max(low + 1.0),
        }
    }

    /// Lower end, m.
    pub fn bottom(&self) -> f64 {
        self.low * self.tick
    }

    /// Upper end, m.
    pub fn top(&self) -> f64 {
        self.high * self.tick
    }

    /// Where `height` lies between the ends: 0 at the bottom, 1 at the top.
    pub fn place(&self, height: f64) -> f64 {
        (height / self.tick - self.low) / (self.high - self.low)
    }

    /// The scale after something from `bottom` to `top` was seen: larger at once
    /// when it must be.
    #[must_use]
    pub fn grown(self, bottom: f64, top: f64) -> Scale {
        if bottom >= self.bottom() && top <= self.top() {
            return self;
        }
        // A tenth more, so that a rising bead does not rescale the screen at every step.
        let reach = 0.1 * (top - bottom);
        let top = if top > self.top() {
            top + reach
        } else {
            self.top()
        };
        let bottom = if bottom < self.bottom() {
            bottom - 0.3 * reach
        } else {
            self.bottom()
        };
        Scale::holding(bottom, top)
    }

    /// The scale for the next page, after one that lay between `bottom` and `top`:
    /// smaller when much of it stayed empty.
    #[must_use]
    pub fn for_next_page(self, bottom: f64, top: f64) -> Scale {
        let fit = Scale::holding(bottom, top + 0.05 * (top - bottom));
        let shrunk = (fit.top() - fit.bottom()) < LOOSE * (self.top() - self.bottom());
        if shrunk { fit } else { self }
    }

    /// The heights of all ticks, bottom to top, m.
    pub fn ticks(&self) -> impl Iterator<Item = f64> + '_ {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a few ticks"
        )]
        let count = (self.high - self.low).clamp(0.0, 64.0) as u32;
        (0..=count).map(|k| (self.low + f64::from(k)) * self.tick)
    }
}

/// The lowest and the highest thing in the samples, m.
pub(super) fn extent<'a>(samples: impl Iterator<Item = &'a Sample>) -> Option<(f64, f64)> {
    let heights = samples
        .flat_map(|sample| sample.rows.iter().flatten())
        .flat_map(|row: &ColumnSample| row.reduced.iter().chain([&row.floor]))
        .copied()
        .filter(|z| z.is_finite());
    let (low, high) = heights.fold((f32::INFINITY, f32::NEG_INFINITY), |(low, high), z| {
        (low.min(z), high.max(z))
    });
    (low <= high).then(|| (f64::from(low), f64::from(high)))
}

fn finite(x: f64) -> f64 {
    if x.is_finite() {
        x.clamp(-1e30, 1e30)
    } else {
        0.0
    }
}

/// The next 1, 2 or 5 times a power of ten.
fn round_up(x: f64) -> f64 {
    let decade = math::powf(10.0, math::log10(x).floor());
    [1.0, 2.0, 5.0]
        .into_iter()
        .map(|m| m * decade)
        .find(|&m| m >= x * 0.999_999)
        .unwrap_or(10.0 * decade)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_are_round_and_hold_everything() {
        let scale = Scale::holding(-1.24e-3, 8.3e-3);
        assert!(scale.bottom() <= -1.24e-3 && scale.top() >= 8.3e-3);
        assert!((scale.tick - 5e-3).abs() < 1e-12);
    }

    #[test]
    fn a_scale_grows_at_once_and_shrinks_only_when_much_is_empty() {
        let scale = Scale::holding(0.0, 1.0);
        assert_eq!(scale.grown(0.1, 0.9), scale);
        assert!(scale.grown(0.0, 1.5).top() >= 1.5);
        assert_eq!(scale.for_next_page(0.0, 0.8), scale);
        assert!(scale.for_next_page(0.0, 0.2).top() < 0.5);
    }

    #[test]
    fn nonsense_makes_a_scale_too() {
        for (bottom, top) in [
            (f64::NAN, 1.0),
            (0.0, f64::INFINITY),
            (2.0, 1.0),
            (0.0, 0.0),
        ] {
            let scale = Scale::holding(bottom, top);
            assert!(scale.top() > scale.bottom() && scale.tick > 0.0);
            assert!(
                scale
                    .place(0.5 * (scale.top() + scale.bottom()))
                    .is_finite()
            );
        }
    }
}
