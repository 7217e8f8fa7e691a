//! The one place where facts become a scene.

use super::parameters::{self, Value};
use super::{Facts, Launch, PowerLaw, Scene, SceneError, Soft, Start};

/// Largest width of the diameters, over the mean diameter: up to 1:100 and beyond.
const WIDEST: f64 = 1.97;

/// Slowest approach to a floor without gravity, m/s: the square of a slower one, its
/// energy, leaves the range of numbers before a column has spent it.
const SLOWEST: f64 = 1e-60;

/// Beads of a lattice, as of a column.
const MOST_BEADS: usize = 1_000_000;

/// Shortest and longest contact, s, of a pair under a power law.
const CONTACT_TIMES: (f64, f64) = (1e-12, 1e3);

impl Scene {
    /// Checks the facts: every value in the range of the parameter table, and all
    /// of them consistent. Under a power law the restitution follows from the others.
    ///
    /// # Errors
    /// The first thing found wrong, in one sentence.
    pub fn new(mut facts: Facts) -> Result<Self, SceneError> {
        for parameter in parameters::table() {
            // α only repeats what amplitude, frequency and gravity say.
            if parameter.name != "alpha"
                && let Some(value) = (parameter.get)(&facts)
            {
                parameter.check(value)?;
            }
        }
        check_frame(&facts)?;
        check_duration(&facts)?;
        check_width(&facts)?;
        check_lattice(&facts)?;
        check_restitution(&facts)?;
        check_solver(&facts)?;
        if let Some(soft) = facts.soft() {
            let speed = facts.own_speed();
            if let Some(power) = soft.law.power() {
                check_power(power, speed)?;
            }
            let follows = soft.law.rebound(soft.attraction, speed);
            facts.restitution = follows.unwrap_or(facts.restitution);
        }
        check_start(&facts)?;
        Ok(Self(facts))
    }

    /// The facts, to be edited and checked again.
    pub fn facts(&self) -> &Facts {
        &self.0
    }
}

fn check_width(facts: &Facts) -> Result<(), SceneError> {
    if facts.width <= WIDEST * facts.diameter {
        return Ok(());
    }
    let reason = format!(
        "must be at most {WIDEST} times the diameter {}, so that every bead has a size",
        Value::Number(facts.diameter)
    );
    Err(inconsistent("width", Value::Number(facts.width), reason))
}

fn check_restitution(facts: &Facts) -> Result<(), SceneError> {
    if facts.restitution > 0.0 || !facts.is_md() || facts.depends_on_speed() {
        return Ok(());
    }
    let reason = "must be above 0 and at most 1 for soft contacts, whose damping is \
                  -ln(restitution)/contact_time; hard spheres (method ed) may have 0";
    Err(inconsistent(
        "restitution",
        Value::Number(facts.restitution),
        reason,
    ))
}

fn check_solver(facts: &Facts) -> Result<(), SceneError> {
    let Some(Soft { law, solver, .. }) = facts.soft() else {
        return Ok(());
    };
    if law.allows(&solver) {
        return Ok(());
    }
    let reason = "does not go with the solver: the exact one is the linear law's, the adaptive \
                  one the power laws'";
    Err(inconsistent(
        "law",
        Value::Choice(law.name().as_str()),
        reason,
    ))
}

/// Refuses power laws whose contacts are beyond all numbers or absurdly short or long.
fn check_power(power: &PowerLaw, speed: f64) -> Result<(), SceneError> {
    let contact_time = power.contact_time(speed);
    let depth = power.penetration(speed);
    let (shortest, longest) = CONTACT_TIMES;
    if (shortest..=longest).contains(&contact_time) && depth.is_normal() {
        return Ok(());
    }
    let reason = format!(
        "makes a contact of two beads that meet at {} m/s last {contact_time:.1e} s; it must \
         last from {shortest:e} to {longest:e} s",
        Value::Number(speed)
    );
    Err(inconsistent(
        "stiffness",
        Value::Number(power.stiffness),
        reason,
    ))
}

fn check_duration(facts: &Facts) -> Result<(), SceneError> {
    if facts.gravity.is_some() && facts.duration.is_none() {
        return Err(SceneError::Missing {
            name: "duration",
            belongs_to: "scenes with gravity",
        });
    }
    Ok(())
}

/// Checks what does not depend on any number: what needs gravity has it.
pub(in crate::scene) fn check_frame(facts: &Facts) -> Result<(), SceneError> {
    if facts.sites().is_some() {
        check_lattice_frame(facts)?;
    }
    if facts.gravity.is_some() {
        return Ok(());
    }
    if facts.shake().is_some() {
        let reason = "needs gravity, without which no bead comes back to the plate";
        return Err(inconsistent("floor", Value::Choice("vibrating"), reason));
    }
    if facts.start == Start::Resting {
        let reason = "needs gravity, which holds the column on the floor";
        return Err(inconsistent("start", Value::Choice("resting"), reason));
    }
    Ok(())
}

/// A lattice is thrown at a fixed floor, by soft contacts on a grid of time steps.
fn check_lattice_frame(facts: &Facts) -> Result<(), SceneError> {
    if facts.grid().is_none() {
        let name = facts.method.name().as_str();
        let reason = "a lattice takes gear or verlet, soft contacts on a grid of time steps";
        return Err(inconsistent("method", Value::Choice(name), reason));
    }
    if facts.shake().is_some() {
        let reason = "a lattice has a fixed floor and no gravity";
        return Err(inconsistent("floor", Value::Choice("vibrating"), reason));
    }
    if let Some(gravity) = facts.gravity {
        let reason = "a lattice has no gravity; columns may have it";
        return Err(inconsistent("gravity", Value::Number(gravity), reason));
    }
    Ok(())
}

/// Refuses lattices of too many beads, or of unequal ones.
fn check_lattice(facts: &Facts) -> Result<(), SceneError> {
    let Some(sites) = facts.sites() else {
        return Ok(());
    };
    if facts.width != 0.0 {
        let reason = "a lattice has beads of equal size; columns may have others";
        return Err(inconsistent("width", Value::Number(facts.width), reason));
    }
    let (columns, rows) = (sites.columns, Value::Whole(sites.rows as u64));
    if sites.count() != facts.n {
        let reason = format!("of {columns} beads do not make {} beads", facts.n);
        return Err(inconsistent("rows", rows, reason));
    }
    if facts.n > MOST_BEADS {
        let reason = format!("times the {columns} beads of a row must be at most {MOST_BEADS}");
        return Err(inconsistent("rows", rows, reason));
    }
    Ok(())
}

fn check_start(facts: &Facts) -> Result<(), SceneError> {
    let Some(Launch { v0, .. }) = facts.launch() else {
        return Ok(());
    };
    if facts.gravity.is_none() && v0 > -SLOWEST {
        let reason = format!(
            "must be at most -{}, towards the floor: without gravity nothing else brings \
             the column there",
            Value::Number(SLOWEST)
        );
        return Err(inconsistent("v0", Value::Number(v0), reason));
    }
    if facts.sigma0().is_some_and(|sigma0| !sigma0.is_finite()) {
        let reason = "is too small: s0/(|v0| contact_time) is beyond all numbers";
        return Err(inconsistent("v0", Value::Number(v0), reason));
    }
    Ok(())
}

fn inconsistent(name: &'static str, value: Value, reason: impl Into<String>) -> SceneError {
    SceneError::Inconsistent {
        name,
        value: value.to_string(),
        reason: reason.into(),
    }
}

/// A floor collision as in Fig. 1(b), for tests.
#[cfg(test)]
pub(in crate::scene) fn example() -> Facts {
    Facts {
        arrangement: super::Arrangement::Column,
        n: 10,
        diameter: 1e-3,
        width: 0.0,
        seed: 1,
        restitution: 0.9,
        floor_contact: super::FloorContact::SameSpring,
        start: Start::Launched(Launch {
            s0: 1e-6,
            jitter: false,
            v0: -0.2,
        }),
        gravity: None,
        floor: super::Floor::Fixed,
        method: super::Method::Soft(Soft {
            law: super::Law::linear(7e-6),
            solver: super::Solver::Grid(super::GridSettings {
                integrator: super::Integrator::Gear,
                steps_per_contact: 100.0,
            }),
            attraction: true,
        }),
        duration: None,
    }
}
