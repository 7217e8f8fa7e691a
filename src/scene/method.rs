//! Methods by the names that people type, and the change from one to another.

use super::{CollisionRule, Facts, GridSettings, Integrator, Law, LawName, Method, Soft, Solver};

/// Steps in a contact time where nobody says otherwise.
const COMMON_STEPS: f64 = 100.0;

/// The name of a method on the command line and in preset files.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum MethodName {
    /// Soft contacts, Gear's fifth-order predictor–corrector.
    Gear,
    /// Soft contacts, velocity Verlet.
    Verlet,
    /// Soft contacts, to rounding; under power laws to a tolerance.
    Exact,
    /// Hard spheres, event driven.
    Ed,
}

impl MethodName {
    /// All methods, in the order in which they are shown.
    pub const ALL: [Self; 4] = [Self::Gear, Self::Verlet, Self::Exact, Self::Ed];

    /// As it is typed.
    pub fn as_str(self) -> &'static str {
        match self {
            Self::Gear => "gear",
            Self::Verlet => "verlet",
            Self::Exact => "exact",
            Self::Ed => "ed",
        }
    }

    /// What it is, in a few words.
    pub fn meaning(self) -> &'static str {
        match self {
            Self::Gear => "soft contacts, Gear's predictor-corrector of fifth order",
            Self::Verlet => "soft contacts, velocity Verlet",
            Self::Exact => "soft contacts to rounding (power laws: to tolerance)",
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
            Self::Soft(soft) => match soft.solver {
                Solver::Grid(grid) => match grid.integrator {
                    Integrator::Gear => MethodName::Gear,
                    Integrator::Verlet => MethodName::Verlet,
                },
                Solver::Exact | Solver::Adaptive { .. } => MethodName::Exact,
            },
            Self::Hard(_) => MethodName::Ed,
        }
    }
}

impl Facts {
    /// Puts another method in force. What it shares with the old one is kept.
    pub(in crate::scene) fn turn_to(&mut self, name: MethodName) {
        self.method = match name {
            MethodName::Gear => self.softened(self.on_grid(Integrator::Gear)),
            MethodName::Verlet => self.softened(self.on_grid(Integrator::Verlet)),
            MethodName::Exact => self.softened(self.located()),
            MethodName::Ed => match self.method {
                Method::Soft(_) => Method::Hard(CollisionRule::Lrv),
                hard @ Method::Hard(_) => hard,
            },
        };
    }

    /// The grid in force, or a common one, for this integrator.
    fn on_grid(&self, integrator: Integrator) -> Solver {
        let steps = self.grid().map(|grid| grid.steps_per_contact);
        Solver::Grid(GridSettings {
            integrator,
            steps_per_contact: steps.unwrap_or(COMMON_STEPS),
        })
    }

    /// The solver that locates contact changes, for the law in force.
    fn located(&self) -> Solver {
        match self.soft() {
            Some(soft) if self.grid().is_none() => soft.solver,
            Some(soft) => soft.law.locating(),
            None => Solver::Exact,
        }
    }

    /// Puts another law in force whose collisions at the scene's own speed are as alike
    /// as can be (see [`PowerLaw::like`](super::PowerLaw::like)), and where the solver does
    /// not go with it one that does.
    pub(in crate::scene) fn obey(&mut self, name: LawName) {
        let (speed, restitution) = (self.own_speed(), self.restitution);
        let Some(soft) = self.soft_mut().filter(|soft| soft.law.name() != name) else {
            return;
        };
        let then;
        (soft.law, then) = soft.law.turned(name, restitution, speed);
        if !soft.law.allows(&soft.solver) {
            soft.solver = soft.law.locating();
        }
        self.restitution = then;
    }

    /// The soft contacts in force, or those of the linear law, under this solver.
    fn softened(&self, solver: Solver) -> Method {
        let linear = Soft {
            // Who has no contact time yet has it missing (`Draft`).
            law: Law::linear(self.contact_time().unwrap_or(1.0)),
            solver,
            attraction: true,
        };
        Method::Soft(Soft {
            solver,
            ..self.soft().unwrap_or(linear)
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::Scene;
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
