//! Single runs of scenes, without anybody who looks on.

use super::FigureError;
use crate::math;
use crate::physics::Observation;
use crate::scene::parameters::Value;
use crate::scene::{MethodName, Preset, Scene};
use crate::study::{Drive, Results, measure, vary};
use std::ops::ControlFlow;

/// A preset's scene under a method, with other values.
pub(super) fn preset(
    name: &str,
    method: Option<MethodName>,
    values: &[(&'static str, Value)],
) -> Result<Scene, FigureError> {
    Ok(vary(&Preset::load(name)?.scene, method, values)?)
}

/// What a run measures.
pub(super) fn results(scene: &Scene) -> Result<Results, FigureError> {
    let mut watch = |_| ControlFlow::Continue(());
    Ok(measure(scene, &mut Drive::new(scene, &mut watch))?)
}

/// Looks at a run at so many even times from 0 to `end`, s.
pub(super) fn looks(
    scene: &Scene,
    end: f64,
    count: u32,
    mut look: impl FnMut(&Observation),
) -> Result<(), FigureError> {
    let mut watch = |_| ControlFlow::Continue(());
    let mut drive = Drive::new(scene, &mut watch);
    let mut seen = Observation::default();
    for k in 0..=count {
        drive.advance(end * f64::from(k) / f64::from(count))?;
        drive.observe(&mut seen);
        look(&seen);
    }
    Ok(())
}

/// Numbers from `from` to `to` in even ratios, both ends included.
pub(super) fn decades(from: f64, to: f64, count: u32) -> Vec<f64> {
    let step = math::ln(to / from) / f64::from(count.max(2) - 1);
    (0..count)
        .map(|k| match k {
            k if k + 1 == count => to,
            k => from * math::exp(f64::from(k) * step),
        })
        .collect()
}

/// The largest of the values. NaN of none and where one is NaN, so that no claim about
/// it holds then.
pub(super) fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    extreme(values, f64::max)
}

/// The smallest of the values; NaN as the largest is.
pub(super) fn smallest(values: impl IntoIterator<Item = f64>) -> f64 {
    extreme(values, f64::min)
}

fn extreme(values: impl IntoIterator<Item = f64>, of: fn(f64, f64) -> f64) -> f64 {
    let beyond = |a: f64, b: f64| {
        if a.is_nan() || b.is_nan() {
            f64::NAN
        } else {
            of(a, b)
        }
    };
    values.into_iter().reduce(beyond).unwrap_or(f64::NAN)
}

/// Where a curve first falls below a level, on a logarithmic axis.
pub(super) fn crossing(curve: &[(f64, f64)], level: f64) -> f64 {
    let pair = curve.windows(2).find(|p| p[0].1 >= level && p[1].1 < level);
    pair.map_or(f64::NAN, |p| {
        let u = (level - p[0].1) / (p[1].1 - p[0].1);
        math::exp(math::ln(p[0].0) + u * math::ln(p[1].0 / p[0].0))
    })
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn extremes_of_nothing_and_of_what_is_not_a_number_are_none() {
        assert_eq!(largest([1.0, 3.0, 2.0]), 3.0);
        assert_eq!(smallest([2.0, 1.0, 3.0]), 1.0);
        for values in [&[][..], &[f64::NAN, 1.0], &[1.0, f64::NAN, 2.0]] {
            assert!(largest(values.iter().copied()).is_nan());
            assert!(smallest(values.iter().copied()).is_nan());
        }
    }
}
