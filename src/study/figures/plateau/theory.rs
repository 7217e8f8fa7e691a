//! How dense a column lands that took off from rest, by theory.

use crate::math;
use crate::scene::{Scene, angular};
use std::f64::consts::PI;

/// Flight of a totally inelastic body that the plate throws, s, and the speed at which it
/// meets the plate again, m/s.
fn flight(scene: &Scene) -> Option<(f64, f64)> {
    let (alpha, gravity, period) = (scene.alpha()?, scene.gravity?, scene.period()?);
    let omega = angular(1.0 / period);
    let amplitude = alpha * gravity / (omega * omega);
    // It takes off where the plate falls away with g, and meets it again once.
    let phase = math::asin(1.0 / alpha);
    let rise = |t: f64| {
        let plate = amplitude * (math::sin(phase + omega * t) - math::sin(phase));
        amplitude * omega * math::cos(phase) * t - 0.5 * gravity * t * t - plate
    };
    // Long past the start, where the height is of third order, and before the landing.
    let (mut before, mut after) = (0.25 * period, 2.0 * alpha * period);
    while after - before > f64::EPSILON * after {
        let middle = 0.5 * (before + after);
        if middle <= before || middle >= after {
            break;
        }
        if rise(middle) > 0.0 {
            before = middle;
        } else {
            after = middle;
        }
    }
    let plate = amplitude * omega * math::cos(phase + omega * before);
    let body = amplitude * omega * math::cos(phase) - gravity * before;
    Some((before, plate - body))
}

/// σ of the landing after a rest, over t_c, 1/s, of linear contacts.
pub(super) fn density(scene: &Scene) -> f64 {
    let density = || {
        let (alpha, gravity, period) = (scene.alpha()?, scene.gravity?, scene.period()?);
        let (flight, speed) = flight(scene)?;
        let rate = gravity * angular(1.0 / period) * (alpha * alpha - 1.0).sqrt();
        // (ω_0 t_c)².
        let angle = PI * PI + math::powi(math::ln(scene.restitution), 2);
        Some(scene.n as f64 * rate * flight / (angle * speed))
    };
    density().unwrap_or(f64::NAN)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::study::figures::runs::preset;

    #[test]
    fn the_inelastic_body_flies_as_its_closed_form_says() {
        // α = 2: 0.74148 periods, the root of a transcendental equation, to five digits.
        let scene = preset("fig6b", None, &[]).expect("a preset");
        let period = scene.period().expect("a plate");
        let (flight, _) = flight(&scene).expect("α > 1");
        assert!((flight / period - 0.741_48).abs() < 5e-6, "{flight}");
    }
}
