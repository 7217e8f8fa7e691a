//! Methods by the names that people type, and the change from one to another.

use super::{CollisionRule, Facts, Integrator, Method, Scene, SceneError};
use crate::scene::parameters;

/// The name of a method on the command line and in preset files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MethodName {
    /// Soft contacts, Gear's fifth-order predictor–corrector.
    Gear,
    /// Soft contacts, velocity Verlet.
    Verlet,
    /// Hard spheres, event driven.
    Ed,
}

impl MethodName {
    /// All methods, in the order in which they are shown.
    pub const ALL: [Self; 3] = [Self::Gear, Self::Verlet, Self::Ed];

    /// As it is typed.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Gear => "gear",
            Self::Verlet => "verlet",
            Self::Ed => "ed",
        }
    }

    /// What it is, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Gear => "soft contacts, Gear's predictor-corrector of fifth order",
            Self::Verlet => "soft contacts, velocity Verlet",
            Self::Ed => "hard spheres, event driven",
        }
    }

    /// The method of that name.
    pub fn find(name: &str) -> Option<Self> {
        Self::ALL.into_iter().find(|method| method.as_str() == name)
    }
}

impl Method {
    /// Its name.
    pub fn name(&self) -> MethodName {
        match self {
            Self::Md {
                integrator: Integrator::Gear,
                ..
            } => MethodName::Gear,
            Self::Md {
                integrator: Integrator::Verlet,
                ..
            } => MethodName::Verlet,
            Self::Ed { .. } => MethodName::Ed,
        }
    }
}

impl Facts {
    /// The same facts under another method. What the new method shares with the
    /// old one is kept; a contact time that it needs and nobody has is NaN, "not
    /// given yet".
    pub(in crate::scene) fn under(&self, name: MethodName) -> Self {
        let method = match name {
            MethodName::Gear => self.soft(Integrator::Gear),
            MethodName::Verlet => self.soft(Integrator::Verlet),
            MethodName::Ed => match self.method {
                Method::Md { .. } => Method::Ed {
                    rule: CollisionRule::Lrv,
                },
                hard @ Method::Ed { .. } => hard,
            },
        };
        Self {
            method,
            ..self.clone()
        }
    }

    fn soft(&self, integrator: Integrator) -> Method {
        match self.method {
            Method::Md {
                contact_time,
                steps_per_contact,
                attraction,
                ..
            } => Method::Md {
                contact_time,
                integrator,
                steps_per_contact,
                attraction,
            },
            Method::Ed { .. } => Method::Md {
                contact_time: self.contact_time().unwrap_or(f64::NAN),
                integrator,
                steps_per_contact: 100.0,
                attraction: true,
            },
        }
    }
}

impl Scene {
    /// The same scene under another method: hard spheres drop the contact time.
    ///
    /// # Errors
    /// When the scene has no contact time for soft contacts, or a restitution of
    /// 0, which they cannot have.
    pub fn with_method(&self, name: MethodName) -> Result<Self, SceneError> {
        let facts = self.facts().under(name);
        parameters::complete(&facts)?;
        Self::new(facts)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::validate::example;

    fn scene() -> Scene {
        Scene::new(example()).expect("the example is a scene")
    }

    #[test]
    fn soft_contacts_become_hard_and_lose_the_contact_time() {
        let hard = scene()
            .with_method(MethodName::Ed)
            .expect("every scene can be hard");
        assert_eq!(hard.contact_time(), None);
        assert_eq!(hard.restitution.to_bits(), scene().restitution.to_bits());
        let error = hard
            .with_method(MethodName::Gear)
            .expect_err("no contact time");
        assert_eq!(error.parameter(), "contact_time");
    }

    #[test]
    fn a_change_of_integrator_keeps_the_rest() {
        let there = scene()
            .with_method(MethodName::Verlet)
            .expect("both are soft");
        assert_eq!(there.method.name(), MethodName::Verlet);
        assert_eq!(
            there.with_method(MethodName::Gear).expect("both are soft"),
            scene()
        );
    }
}
