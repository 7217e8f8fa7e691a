//! A scene and its like with other contact times.

use super::{AdviseError, Against, Question, SceneKind};
use crate::math;
use crate::numerals::rounded;
use crate::scene::parameters::{Setting, Value, named};
use crate::scene::preset::Preset;
use crate::scene::{Law, MethodName, Scene, SceneError};
use crate::study::vary;

/// A contact time for a scene that has none, s; it is varied anyway.
const ANY: f64 = 1e-6;

/// Digits of contact times that are tried, so that what is printed is what was run.
pub(super) const DIGITS: usize = 4;

/// Shortest and longest contact times that are looked at, over the scene's own time:
/// s_0/|v_0|, a fall by a diameter, or the plate's period. The longest there is one in
/// which a column of ten is half a period in contact.
const LAUNCHED: (f64, f64) = (1e-4, 1e2);
const FALLING: (f64, f64) = (1e-6, 1e-1);
const SHAKEN: (f64, f64) = (1e-7, 5e-2);

/// Longest contact time over that of the limit.
const OVER_MATERIAL: f64 = 1e4;

/// Rungs of the ladder in a decade.
const RUNGS: (f64, f64) = (2.0, 4.0);

/// The exact method's scenes, one a contact time.
pub(super) struct Family {
    base: Scene,
    base_time: f64,
    /// The contact time of the scene that was asked about, s.
    pub own: Option<f64>,
}

impl Family {
    /// Of a preset's scene; hard spheres stand for their soft twins.
    pub fn of(preset: &Preset) -> Result<Self, AdviseError> {
        if preset.scene.sites().is_some() {
            return Err(AdviseError::Lattice);
        }
        let own = preset.scene.contact_time();
        let base = if own.is_some() {
            preset.scene.with_method(MethodName::Exact)?
        } else {
            let any = Setting {
                parameter: named("contact_time")?,
                value: Value::Number(ANY),
            };
            preset.with(Some(MethodName::Exact), &[any])?.scene
        };
        Ok(Self {
            base_time: own.unwrap_or(ANY),
            base,
            own,
        })
    }

    /// The scene, with whatever contact time.
    pub fn scene(&self) -> &Scene {
        &self.base
    }

    /// The same with another contact time, s. Under a power law stiffness and damping
    /// are those with which every collision takes as much longer and loses the same:
    /// K ∝ t_c^−(2+β) and D_n ∝ t_c^−(1+γ), by Eqs. (A1) and (A2).
    pub fn at(&self, contact_time: f64) -> Result<Scene, SceneError> {
        let law = self.base.law();
        match law.as_ref().and_then(Law::power) {
            Some(power) => {
                let longer = contact_time / self.base_time;
                let (beta, gamma) = (power.exponents.beta(), power.exponents.gamma());
                let stiffness = power.stiffness * math::powf(longer, -2.0 - beta);
                let damping = power.damping * math::powf(longer, -1.0 - gamma);
                vary(
                    &self.base,
                    None,
                    &[
                        ("stiffness", Value::Number(stiffness)),
                        ("damping", Value::Number(damping)),
                    ],
                )
            }
            None => vary(
                &self.base,
                None,
                &[("contact_time", Value::Number(contact_time))],
            ),
        }
    }

    /// The scene of the limit, and its contact time, s, where it has one.
    pub fn limit(&self, against: Against) -> Result<(Scene, Option<f64>), AdviseError> {
        let time = match (against, self.own) {
            (Against::Hard, _) => return Ok((self.hard()?, None)),
            (Against::Time(time), _) | (Against::Material, Some(time)) => time,
            (Against::Material, None) => return Err(AdviseError::NoMaterial),
        };
        Ok((self.at(time)?, Some(time)))
    }

    fn hard(&self) -> Result<Scene, AdviseError> {
        if let Some(law) = self.base.law()
            && let Some(power) = law.power()
            && (power.exponents.beta(), power.exponents.gamma()) != (0.0, 0.0)
        {
            let law = law.name().as_str();
            return Err(AdviseError::NotItsLimit { law });
        }
        Ok(self.base.with_method(MethodName::Ed)?)
    }

    /// The ladder of contact times, s, rising; the scene's own among them.
    pub fn ladder(&self, question: Question, limit: Option<f64>) -> Result<Vec<f64>, AdviseError> {
        let (from, to) = question.between.unwrap_or_else(|| self.range(limit));
        let per_decade = if question.quick { RUNGS.0 } else { RUNGS.1 };
        let steps = (math::log10(to / from) * per_decade).ceil().clamp(1.0, 1e3);
        let mut rung = 0.0;
        let mut ladder = Vec::new();
        while rung <= steps {
            ladder.push(rounded(from * math::powf(to / from, rung / steps), DIGITS));
            rung += 1.0;
        }
        if question.between.is_none() {
            ladder.extend(self.own);
        }
        // The limit is within any tolerance of itself.
        ladder.retain(|&t| self.at(t).is_ok() && limit.is_none_or(|limit| t > limit));
        ladder.sort_by(f64::total_cmp);
        ladder.dedup();
        if ladder.len() < 2 {
            return Err(AdviseError::NoRange { from, to });
        }
        Ok(ladder)
    }

    fn range(&self, limit: Option<f64>) -> (f64, f64) {
        let scene = &self.base;
        let fall = (scene.diameter / scene.gravity.unwrap_or(f64::NAN)).sqrt();
        let (time, (least, most)) = match SceneKind::of(scene) {
            SceneKind::Launched => (self.flight().unwrap_or(self.base_time), LAUNCHED),
            SceneKind::Falling => (fall, FALLING),
            SceneKind::Shaken => (scene.period().unwrap_or(fall), SHAKEN),
        };
        match limit {
            Some(limit) => (
                limit,
                (most * time).clamp(10.0 * limit, OVER_MATERIAL * limit),
            ),
            None => (least * time, most * time),
        }
    }

    /// s_0/|v_0| of a launched column whose beads do not touch, s.
    fn flight(&self) -> Option<f64> {
        let launch = self.base.launch()?;
        (launch.v0 != 0.0 && launch.s0 > 0.0).then(|| launch.s0 / launch.v0.abs())
    }

    /// Why the contact time does not matter, if it cannot.
    pub fn indifference(&self) -> Option<&'static str> {
        let scene = &self.base;
        if SceneKind::of(scene) != SceneKind::Launched || scene.period().is_some() {
            return None;
        }
        if scene.n == 1 {
            return Some(
                "A single bead meets nothing but the floor, and keeps the same part of its speed \
                 there whatever the contact time.",
            );
        }
        self.flight().is_none().then_some(
            "The beads touch at the start: sigma_0 = 0 at any contact time, and without gravity \
             nothing else has a time to compare it with. All contact times give the same eps_eff.",
        )
    }
}
