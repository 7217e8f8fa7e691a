//! How long a page is, and how fast simulated time goes.

use crate::math;
use crate::numerals::trimmed;
use crate::scene::{Floor, Scene};

/// A speed of the ladder 1, 2, 5, 10 … in simulated seconds in a second.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub struct Speed(i32);

/// Wall time that a page of a floor collision takes, s.
const PAGE_SECONDS: f64 = 8.0;
/// Wall time that a plate period takes, s.
const PERIOD_SECONDS: f64 = 1.0;

impl Speed {
    const SLOWEST: i32 = -30;
    const FASTEST: i32 = 9;

    /// The speed of the ladder that is nearest to `factor`.
    pub fn nearest(factor: f64) -> Speed {
        let rungs = (Self::SLOWEST..=Self::FASTEST).map(Speed);
        let distance = |speed: &Speed| math::ln(speed.factor() / factor).abs();
        rungs
            .min_by(|a, b| distance(a).total_cmp(&distance(b)))
            .unwrap_or(Speed(0))
    }

    /// Simulated seconds in a second.
    pub fn factor(self) -> f64 {
        let mantissa = [1.0, 2.0, 5.0][self.0.rem_euclid(3) as usize % 3];
        mantissa * math::powi(10.0, self.0.div_euclid(3))
    }

    /// This speed in units of another.
    pub fn over(self, other: Speed) -> f64 {
        self.factor() / other.factor()
    }

    /// So many rungs faster, or slower if negative.
    #[must_use]
    pub fn shifted(self, rungs: i32) -> Speed {
        Speed((self.0 + rungs).clamp(Self::SLOWEST, Self::FASTEST))
    }
}

/// A factor against real time in words: `1/20`, `1`, `5`.
pub fn speed_text(factor: f64) -> String {
    if factor <= 0.0 {
        "0".into()
    } else if factor < 0.95 {
        format!("1/{}", grouped(1.0 / factor))
    } else if factor < 9.5 {
        trimmed(&format!("{factor:.1}"), 0)
    } else {
        grouped(factor)
    }
}

/// Two significant digits, thousands apart: `50 000`.
fn grouped(x: f64) -> String {
    let round = math::powf(10.0, (math::log10(x).floor() - 1.0).max(0.0));
    let digits = format!("{:.0}", (x / round).round() * round);
    let mut text = String::new();
    for (k, digit) in digits.chars().enumerate() {
        if k > 0 && digits.len() > 4 && (digits.len() - k).is_multiple_of(3) {
            text.push(' ');
        }
        text.push(digit);
    }
    text
}

/// The speed at which a scene is first shown.
pub fn first_speed(scenes: &[Scene], span: f64) -> Speed {
    match scenes.first().and_then(|scene| scene.period()) {
        Some(period) => Speed::nearest(period / PERIOD_SECONDS),
        None => Speed::nearest(span / PAGE_SECONDS),
    }
}

/// Length of a page on traces that are `cells` wide, s.
pub fn span(scenes: &[Scene], cells: u16) -> f64 {
    let Some(scene) = scenes.first() else {
        return 1.0;
    };
    let span = match (scene.floor, scene.gravity) {
        (Floor::Vibrating(shake), _) => periods(cells) / shake.frequency,
        (Floor::Fixed, Some(gravity)) => bounces(scene, gravity),
        (Floor::Fixed, None) => collision(scenes),
    };
    if span.is_finite() && span > 0.0 {
        span
    } else {
        1.0
    }
}

/// Whether the scene comes to an end by itself.
pub fn ends(scenes: &[Scene]) -> bool {
    scenes
        .iter()
        .all(|scene| scene.floor == Floor::Fixed && scene.gravity.is_none())
}

/// Plate periods of a page: more on wider traces, not only larger ones.
fn periods(cells: u16) -> f64 {
    (f64::from(cells) / 5.0).floor().clamp(4.0, 16.0)
}

/// A column that falls on a floor: a few times the longest flight.
fn bounces(scene: &Scene, gravity: f64) -> f64 {
    let (s0, v0) = separated(scene);
    let height = (s0 * scene.layers() as f64).max(0.0) + v0 * v0 / (2.0 * gravity);
    let flight = (2.0 * height / gravity).sqrt();
    if flight > 0.0 { 6.0 * flight } else { 0.5 }
}

/// A floor collision without gravity: all beads arrive, the shock runs up the
/// column and back, and they part for as long again.
fn collision(scenes: &[Scene]) -> f64 {
    let duration = |scene: &Scene, contact_time: f64| {
        let (s0, v0) = separated(scene);
        let beads = scene.layers() as f64;
        let arrival = if v0 < 0.0 { beads * s0 / -v0 } else { 0.0 };
        4.0 * arrival + 2.5 * (beads + 1.0) * contact_time
    };
    let contact_time = scenes
        .iter()
        .find_map(|scene| scene.contact_time())
        .unwrap_or(0.0);
    let longest = scenes
        .iter()
        .map(|scene| duration(scene, contact_time))
        .fold(0.0, f64::max);
    if longest > 0.0 {
        return longest;
    }
    // Hard beads that touch: nothing but the beads' size is left to measure by.
    let (_, v0) = separated(&scenes[0]);
    0.05 * scenes[0].diameter / v0.abs().max(1e-9)
}

fn separated(scene: &Scene) -> (f64, f64) {
    scene
        .launch()
        .map_or((0.0, 0.0), |launch| (launch.s0, launch.v0))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn speeds_go_in_steps_of_one_two_five() {
        let speed = Speed::nearest(0.05);
        assert_eq!(speed_text(speed.factor()), "1/20");
        assert_eq!(speed_text(speed.shifted(1).factor()), "1/10");
        assert_eq!(speed_text(speed.shifted(-1).factor()), "1/50");
        assert_eq!(speed_text(Speed::nearest(2e-5).factor()), "1/50 000");
        assert_eq!(speed_text(Speed::nearest(1.0).factor()), "1");
        assert_eq!(speed_text(1.0 / 83.4), "1/83");
        assert_eq!(speed_text(0.0), "0");
    }
}
