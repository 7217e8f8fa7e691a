//! Facts on their way to a scene.

use std::collections::BTreeSet;

use super::parameters::{Parameter, Setting, Value, find, table};
use super::{Facts, MethodName, Scene, SceneError};

/// Facts some of whose numbers may not be given yet. What stands in the place of such a
/// number means nothing.
#[derive(Debug, Clone)]
pub struct Draft {
    facts: Facts,
    /// Rows of the table that nobody has given yet.
    missing: BTreeSet<&'static str>,
}

impl Draft {
    /// The facts of a scene, to be changed.
    pub fn of(scene: &Scene) -> Self {
        Self {
            facts: scene.facts().clone(),
            missing: BTreeSet::new(),
        }
    }

    /// Facts of which only the frame is given, no number that a scene needs.
    pub(in crate::scene) fn framed(facts: Facts) -> Self {
        Self {
            facts,
            missing: needed().map(|parameter| parameter.name).collect(),
        }
    }

    /// The same facts under another method. What the new method shares with the old one is
    /// kept.
    #[must_use]
    pub fn under(mut self, method: MethodName) -> Self {
        self.change(|facts| facts.turn_to(method));
        self
    }

    /// Puts a layer of settings into the facts, whatever the order they are written in: in
    /// the order of [`Parameter::order`].
    ///
    /// # Errors
    /// When a value is not allowed, the scene does not have the parameter, or both
    /// amplitude and α are given.
    pub fn set(&mut self, layer: &[Setting]) -> Result<(), SceneError> {
        refuse_both_amplitudes(layer)?;
        let mut ordered: Vec<&Setting> = layer.iter().collect();
        ordered.sort_by_key(|setting| setting.parameter.order);
        for &&Setting { parameter, value } in &ordered {
            parameter.check(value)?;
            if !parameter.applies(&self.facts) {
                return Err(SceneError::Absent {
                    name: parameter.name,
                    value: value.to_string(),
                    belongs_to: parameter.belongs_to,
                });
            }
            self.change(|facts| (parameter.set)(facts, value));
            self.missing.remove(parameter.name);
            if parameter.name == "alpha" {
                self.missing.remove("amplitude");
                self.check_amplitude_of(value)?;
            }
        }
        Ok(())
    }

    /// The scene of these facts.
    ///
    /// # Errors
    /// When a number that it must have is not given, or the facts make no scene.
    pub fn finish(self) -> Result<Scene, SceneError> {
        let lacks = |parameter: &&Parameter| {
            self.missing.contains(parameter.name) && parameter.applies(&self.facts)
        };
        match needed().find(lacks) {
            Some(&Parameter {
                name, belongs_to, ..
            }) => Err(SceneError::Missing { name, belongs_to }),
            None => Scene::new(self.facts),
        }
    }

    /// Changes the facts. What a scene needs only then follows from what it needed before,
    /// as stiffness and damping do from restitution and contact time; where it needed nothing
    /// before, or that is missing, it is missing too.
    fn change(&mut self, change: impl FnOnce(&mut Facts)) {
        let before: Vec<_> = applying(&self.facts).collect();
        change(&mut self.facts);
        let now: Vec<_> = applying(&self.facts).collect();
        let mut gone = before.iter().filter(|name| !now.contains(name)).peekable();
        let follows = gone.peek().is_some() && gone.all(|name| !self.missing.contains(name));
        if !follows {
            let new = now.iter().filter(|name| !before.contains(name));
            self.missing.extend(new);
        }
    }

    /// Refuses an α whose amplitude is out of range. Without a frequency there is none yet.
    fn check_amplitude_of(&self, alpha: Value) -> Result<(), SceneError> {
        let row = find("amplitude").expect("the table has an amplitude");
        match (row.get)(&self.facts) {
            Some(amplitude) if !self.missing.contains("frequency") && !row.allows(amplitude) => {
                Err(SceneError::Inconsistent {
                    name: "alpha",
                    value: alpha.to_string(),
                    reason: format!(
                        "gives the amplitude {amplitude}, which must be {}",
                        row.allowed()
                    ),
                })
            }
            _ => Ok(()),
        }
    }
}

impl Scene {
    /// The same scene under another method: hard spheres drop the contact's law, but
    /// keep the restitution of a pair that meets at the scene's own speed.
    ///
    /// # Errors
    /// When the scene has no contact time for soft contacts, or a restitution of
    /// 0, which they cannot have.
    pub fn with_method(&self, name: MethodName) -> Result<Self, SceneError> {
        Draft::of(self).under(name).finish()
    }
}

/// The rows that a scene cannot do without.
fn needed() -> impl Iterator<Item = &'static Parameter> {
    table().iter().filter(|parameter| parameter.needed)
}

/// The names of those of them that the facts have.
fn applying(facts: &Facts) -> impl Iterator<Item = &'static str> {
    needed()
        .filter(|parameter| parameter.applies(facts))
        .map(|parameter| parameter.name)
}

fn refuse_both_amplitudes(layer: &[Setting]) -> Result<(), SceneError> {
    let given = |name: &str| layer.iter().find(|setting| setting.parameter.name == name);
    match (given("amplitude"), given("alpha")) {
        (Some(amplitude), Some(alpha)) => Err(SceneError::Inconsistent {
            name: "alpha",
            value: alpha.value.to_string(),
            reason: format!(
                "sets the amplitude, which is also given as {}; give one of them",
                amplitude.value
            ),
        }),
        _ => Ok(()),
    }
}
