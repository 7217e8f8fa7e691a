//! The cases: one thing at a time is taken to its extreme, then several together.

use crate::scene::parameters::{Setting, Value};
use crate::scene::{MethodName, Preset, Scene, SceneError};
use crate::study::vary;

/// Periods of a plate that are looked at: later runs part, however right.
const PERIODS: f64 = 2.0;

/// Width of the diameters, m, and a seed with which the first ten beads are as unequal
/// as 1 to 104: a mass ratio of 10⁶.
const WIDE: f64 = 1.97e-3;
const EXTREME: f64 = 143.0;

/// What a case starts from.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Base {
    /// Fig. 1(b): N = 10, ε = 0.9, t_c = 7 µs, s₀ = 1 µm, v₀ = −0.2 m/s.
    Collision,
    /// Fig. 5(b): N = 10, ε = 0.6, t_c = 7 µs, α = 2 at 20 Hz.
    Plate,
    /// Dropped from 1 mm onto a fixed floor, ε = 0.9, t_c = 7 µs.
    Dropped,
}

/// A scene to run all methods on.
#[derive(Debug, Clone, PartialEq)]
pub struct Case {
    /// What is extreme, in at most 22 characters.
    pub name: &'static str,
    base: Base,
    values: &'static [(&'static str, f64)],
    /// The scene, with the exact method; or why there is none.
    pub scene: Result<Scene, SceneError>,
}

/// Name, base, what differs from it, and whether a quick look includes it.
type CaseRow = (&'static str, Base, &'static [(&'static str, f64)], bool);

const LINES: &[CaseRow] = &[
    ("Fig. 1(b)", Base::Collision, &[], true),
    ("t_c 1e-9", Base::Collision, &[("contact_time", 1e-9)], true),
    ("t_c 1e-2", Base::Collision, &[("contact_time", 1e-2)], true),
    ("eps 1", Base::Collision, &[("restitution", 1.0)], true),
    ("eps 0.1", Base::Collision, &[("restitution", 0.1)], true),
    ("eps 1e-3", Base::Collision, &[("restitution", 1e-3)], false),
    ("eps 1e-6", Base::Collision, &[("restitution", 1e-6)], true),
    ("N 1", Base::Collision, &[("n", 1.0)], true),
    ("N 100", Base::Collision, &[("n", 100.0)], false),
    ("N 1000", Base::Collision, &[("n", 1000.0)], false),
    ("v0 1e-12", Base::Collision, &[("v0", -1e-12)], true),
    ("v0 10", Base::Collision, &[("v0", -10.0)], false),
    ("s0 0", Base::Collision, &[("s0", 0.0)], true),
    ("s0 1e-15", Base::Collision, &[("s0", 1e-15)], true),
    ("s0 1", Base::Collision, &[("s0", 1.0)], false),
    (
        "diameters 1:104",
        Base::Collision,
        &[("width", WIDE), ("seed", EXTREME)],
        true,
    ),
    (
        "eps 1e-6, s0 0",
        Base::Collision,
        &[("restitution", 1e-6), ("s0", 0.0)],
        false,
    ),
    (
        "eps 1e-6, N 1000, s0 0",
        Base::Collision,
        &[("restitution", 1e-6), ("n", 1000.0), ("s0", 0.0)],
        false,
    ),
    (
        "eps 0.5, N 100, s 10um",
        Base::Collision,
        &[("restitution", 0.5), ("n", 100.0), ("s0", 1e-5)],
        false,
    ),
    (
        "t_c 1e-9, N 1000, s0 0",
        Base::Collision,
        &[("contact_time", 1e-9), ("n", 1000.0), ("s0", 0.0)],
        false,
    ),
    (
        "v0 1e-12, s0 1e-15",
        Base::Collision,
        &[("v0", -1e-12), ("s0", 1e-15)],
        false,
    ),
    (
        "diameters 1:104, N 100",
        Base::Collision,
        &[("width", WIDE), ("seed", EXTREME), ("n", 100.0)],
        false,
    ),
    (
        "1:104, eps 1e-3",
        Base::Collision,
        &[("width", WIDE), ("seed", EXTREME), ("restitution", 1e-3)],
        false,
    ),
    ("plate: Fig. 5(b)", Base::Plate, &[], true),
    (
        "plate: t_c 1e-9",
        Base::Plate,
        &[("contact_time", 1e-9)],
        true,
    ),
    (
        "plate: t_c 1e-2",
        Base::Plate,
        &[("contact_time", 1e-2)],
        true,
    ),
    ("plate: alpha 1000", Base::Plate, &[("alpha", 1000.0)], true),
    (
        "plate: 1000 g",
        Base::Plate,
        &[("gravity", 9810.0), ("alpha", 2.0)],
        true,
    ),
    ("plate: eps 1", Base::Plate, &[("restitution", 1.0)], false),
    (
        "plate: eps 1e-6",
        Base::Plate,
        &[("restitution", 1e-6)],
        false,
    ),
    ("plate: N 1", Base::Plate, &[("n", 1.0)], false),
    ("plate: N 1000", Base::Plate, &[("n", 1000.0)], false),
    (
        "plate: diameters 1:104",
        Base::Plate,
        &[("width", WIDE), ("seed", EXTREME)],
        false,
    ),
    (
        "plate: 1000 g, 1000 a",
        Base::Plate,
        &[("gravity", 9810.0), ("alpha", 1000.0)],
        false,
    ),
    (
        "plate: at rest, a 0.5",
        Base::Plate,
        &[("alpha", 0.5)],
        false,
    ),
    ("dropped", Base::Dropped, &[], false),
    (
        "dropped: 1000 g",
        Base::Dropped,
        &[("gravity", 9810.0)],
        true,
    ),
    (
        "dropped: t_c 1e-9",
        Base::Dropped,
        &[("contact_time", 1e-9)],
        false,
    ),
];

/// All cases, or those of a quick look.
pub fn cases(quick: bool) -> Vec<Case> {
    let wanted = LINES.iter().filter(|line| line.3 || !quick);
    wanted
        .map(|&(name, base, values, _)| Case::new(name, base, values))
        .collect()
}

impl Case {
    fn new(name: &'static str, base: Base, values: &'static [(&'static str, f64)]) -> Self {
        Self {
            name,
            base,
            values,
            scene: scene(base, values),
        }
    }

    /// What differs from the base, as it would be set on the command line.
    pub fn settings(&self) -> String {
        let values = self.values.iter();
        let set: Vec<_> = values.map(|(name, x)| format!("{name}={x}")).collect();
        format!("{} {}", self.base.preset(), set.join(" "))
            .trim_end()
            .to_owned()
    }

    /// What is compared.
    pub fn compared(&self) -> &'static str {
        match self.base {
            Base::Collision => "eps_eff",
            Base::Plate | Base::Dropped => "height of the centre of mass",
        }
    }
}

impl Base {
    fn preset(self) -> &'static str {
        match self {
            Self::Collision => "fig1b",
            Self::Plate => "fig5b",
            Self::Dropped => "dropped",
        }
    }
}

fn scene(base: Base, values: &[(&'static str, f64)]) -> Result<Scene, SceneError> {
    let preset = Preset::load(base.preset()).expect("the preset is embedded");
    let mut layer = Vec::new();
    for &(name, x) in values {
        // A whole number is written without a point.
        layer.push(Setting::read(name, &x.to_string())?);
    }
    let scene = preset.with(Some(MethodName::Exact), &layer)?.scene;
    let duration = match base {
        Base::Collision => return Ok(scene),
        Base::Plate => PERIODS * scene.period().unwrap_or(1.0),
        // It falls by 1 mm and comes to rest within some bounces.
        Base::Dropped => 5.0 * (2.0 * scene.diameter / scene.gravity.unwrap_or(1.0)).sqrt(),
    };
    vary(&scene, None, &[("duration", Value::Number(duration))])
}
