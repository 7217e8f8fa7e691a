//! The vertical axis: the heights of the ticks, and their unit.
//!
//! A label is written whole or not at all, since a part of it would be another height, and
//! one of the labels has the unit of them all.

use ratatui::buffer::Buffer;
use ratatui::layout::Rect;

use crate::math;
use crate::numerals::{rounded, trimmed};
use crate::scene::parameters::PREFIXES;
use crate::tui::model::Scale;
use crate::tui::numbers;
use crate::tui::text::{columns, line};
use crate::tui::theme::Theme;

/// A row of the axis, counted from its top, and what stands there.
type HeightLabel = (u16, String);

/// Draws the axis.
pub fn render(theme: Theme, scale: &Scale, area: Rect, buffer: &mut Buffer) {
    for (row, label) in labels(scale, area.height, area.width) {
        line(theme, buffer, area, row).put(&label, theme.quiet());
    }
}

/// The labels of the ticks on an axis of so many rows and columns, from the top down.
fn labels(scale: &Scale, rows: u16, width: u16) -> Vec<HeightLabel> {
    if rows == 0 {
        return Vec::new();
    }
    let ticks = placed(scale, rows);
    let size = scale.top().abs().max(scale.bottom().abs());
    let suits = numbers::prefix(size).0;
    let mut prefixes: Vec<(f64, &str)> = PREFIXES
        .iter()
        .map(|prefix| (math::powi(10.0, prefix.power), prefix.symbol))
        .collect();
    // The one that suits the numbers first, then those next to it.
    let apart = |factor: f64| math::log10(factor / suits).abs();
    prefixes.sort_by(|a, b| apart(a.0).total_cmp(&apart(b.0)));
    let plain = prefixes.into_iter().map(|(factor, prefix)| {
        let number = |tick: f64| decimal(tick / factor, scale.tick / factor);
        (labelled(&ticks, number), format!("{prefix}m"))
    });
    let powers = (labelled(&ticks, power_of_ten), "m".to_owned());
    plain
        .chain([powers])
        .filter(|(labels, _)| labels.iter().all(|(_, label)| columns(label) <= width))
        .find_map(|(labels, unit)| with_unit(labels, &unit, rows, width))
        .unwrap_or_default()
}

/// The ticks with their rows, from the top down; of those that share a row the highest.
fn placed(scale: &Scale, rows: u16) -> Vec<(u16, f64)> {
    let last = f64::from(rows - 1);
    let ticks: Vec<f64> = scale.ticks().collect();
    let mut placed: Vec<(u16, f64)> = Vec::new();
    for &tick in ticks.iter().rev() {
        #[expect(
            clippy::cast_possible_truncation,
            clippy::cast_sign_loss,
            reason = "a row of the axis"
        )]
        let row = ((1.0 - scale.place(tick)) * last).round().clamp(0.0, last) as u16;
        if placed.last().is_none_or(|&(taken, _)| taken != row) {
            placed.push((row, tick));
        }
    }
    placed
}

fn labelled(ticks: &[(u16, f64)], number: impl Fn(f64) -> String) -> Vec<HeightLabel> {
    let label = |&(row, tick): &(u16, f64)| (row, number(tick));
    ticks.iter().map(label).collect()
}

/// A multiple of a step, with as many decimals as the step has and no needless zeros.
fn decimal(x: f64, step: f64) -> String {
    // A step that is a power of ten may be a little less than it.
    let decimals = -math::log10(step * 1.000_001).floor();
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "clamped to 0..=30"
    )]
    let decimals = decimals.clamp(0.0, 30.0) as usize;
    let text = trimmed(&format!("{x:.decimals$}"), 0);
    if text == "-0" { "0".to_owned() } else { text }
}

/// Metres in powers of ten, for heights that no prefix suits: three digits.
fn power_of_ten(x: f64) -> String {
    format!("{:e}", rounded(x, 3))
}

/// Writes the unit behind the highest label that has room for it, or else into a row
/// without one.
fn with_unit(
    mut labels: Vec<HeightLabel>,
    unit: &str,
    rows: u16,
    width: u16,
) -> Option<Vec<HeightLabel>> {
    let fits = |label: &str, apart| columns(label) + columns(apart) + columns(unit) <= width;
    for (_, label) in &mut labels {
        if let Some(apart) = [" ", ""].into_iter().find(|apart| fits(label, apart)) {
            *label = format!("{label}{apart}{unit}");
            return Some(labels);
        }
    }
    let free = (0..rows).find(|row| labels.iter().all(|(taken, _)| taken != row))?;
    labels.push((free, unit.to_owned()));
    labels.sort_by_key(|&(row, _)| row);
    (columns(unit) <= width).then_some(labels)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The factor of a label's unit, and the label without it.
    fn split(label: &str) -> (&str, Option<f64>) {
        let Some(rest) = label.strip_suffix('m') else {
            return (label, None);
        };
        let prefix = PREFIXES
            .iter()
            .find(|prefix| !prefix.symbol.is_empty() && rest.ends_with(prefix.symbol));
        let (symbol, power) = prefix.map_or(("", 0), |prefix| (prefix.symbol, prefix.power));
        let number = rest.strip_suffix(symbol).unwrap_or(rest);
        (number.trim(), Some(10f64.powi(power)))
    }

    /// Every label read back is the height of its tick.
    fn check(scale: &Scale, rows: u16, width: u16) -> usize {
        let labels = labels(scale, rows, width);
        let units: Vec<f64> = labels.iter().filter_map(|(_, l)| split(l).1).collect();
        assert!(
            labels.is_empty() || units.len() == 1,
            "{scale:?} {rows} {width}: {labels:?}"
        );
        let ticks = placed(scale, rows);
        for (row, label) in &labels {
            assert!(*row < rows && columns(label) <= width, "{labels:?}");
            let (number, _) = split(label);
            if number.is_empty() {
                continue;
            }
            let read = number.parse::<f64>().expect("a number") * units[0];
            let (_, tick) = ticks.iter().find(|(at, _)| at == row).expect("a tick");
            let size = scale.top().abs().max(scale.bottom().abs());
            assert!(
                (read - tick).abs() <= 1e-6 * scale.tick + 1e-12 * size
                    || (number.contains('e') && (read - tick).abs() <= 5.1e-3 * tick.abs()),
                "{scale:?} {rows} {width}: {label} for {tick}"
            );
        }
        labels.len()
    }

    #[test]
    fn no_label_is_cut_or_of_another_unit() {
        let scale = Scale {
            tick: 0.05e-3,
            low: 20.0,
            high: 25.0,
        };
        assert_eq!(labels(&scale, 11, 6)[0].1, "1.25mm");
        assert_eq!(labels(&scale, 11, 7)[0].1, "1.25 mm");
        let mut shown = 0;
        for decade in -13..=6 {
            for mantissa in [1.0, 1.24, 1.9, 2.5, 3.3, 5.0, 7.77, 9.99, 9.9999] {
                let top = mantissa * 10f64.powi(decade);
                for part in [0.0, -0.01, -0.3, -2.0, 0.5, 0.9, 0.99, 0.9999] {
                    let scale = Scale::holding(part * top, top);
                    for (rows, width) in [(1, 6), (2, 6), (5, 6), (13, 6), (40, 6), (13, 4)] {
                        shown += usize::from(check(&scale, rows, width) > 0);
                    }
                }
            }
        }
        assert!(shown > 20 * 9 * 8 * 5, "most axes are labelled: {shown}");
    }

    #[test]
    fn usual_axes_read_as_people_write_them() {
        let read = |bottom: f64, top: f64| -> Vec<String> {
            let scale = Scale::holding(bottom, top);
            labels(&scale, 13, 6).into_iter().map(|l| l.1).collect()
        };
        assert_eq!(read(-1.24e-3, 5.2e-3), ["6 mm", "4", "2", "0", "-2"]);
        assert_eq!(read(0.0, 0.8e-6), ["800 nm", "600", "400", "200", "0"]);
        assert_eq!(read(0.0, 1.9), ["2 m", "1.5", "1", "0.5", "0"]);
    }
}
