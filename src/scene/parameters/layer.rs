//! Settings that belong together: a file is one layer, the command line's `--set`
//! options are the next, an edit in the explorer is one of its own.

use super::{Parameter, Value, find, table};
use crate::scene::{Facts, Scene, SceneError};

/// A parameter and the value it is to have.
#[derive(Debug, Clone, Copy)]
pub struct Setting {
    /// The parameter.
    pub parameter: &'static Parameter,
    /// Its value.
    pub value: Value,
}

impl Setting {
    /// Reads `name` and `value` as they are typed.
    ///
    /// # Errors
    /// When there is no such parameter, or it does not take that value.
    pub fn read(name: &str, value: &str) -> Result<Self, SceneError> {
        let parameter = super::named(name.trim())?;
        Ok(Self {
            parameter,
            value: super::parse(parameter, value)?,
        })
    }
}

/// Puts a layer of settings into facts, whatever the order they are written in:
/// the rule decides whether there is a contact time, α is turned into an amplitude by
/// the frequency and gravity in force after all that moves the column, and a change of
/// law keeps collisions alike at the speed that follows; what the law has comes last.
///
/// The facts still have to be checked by [`Scene::new`].
///
/// # Errors
/// When a value is not allowed, the scene does not have the parameter, or both
/// amplitude and α are given.
pub fn apply(facts: &mut Facts, layer: &[Setting]) -> Result<(), SceneError> {
    refuse_both_amplitudes(layer)?;
    let mut ordered: Vec<&Setting> = layer.iter().collect();
    ordered.sort_by_key(|setting| match setting.parameter.name {
        "rule" => 0,
        "alpha" => 2,
        "law" => 3,
        "beta" | "gamma" => 4,
        "restitution" | "contact_time" | "stiffness" | "damping" | "tolerance" => 5,
        _ => 1,
    });
    for &&Setting { parameter, value } in &ordered {
        parameter.check(value)?;
        if !parameter.applies(facts) {
            return Err(SceneError::Absent {
                name: parameter.name,
                value: value.to_string(),
                belongs_to: parameter.belongs_to,
            });
        }
        (parameter.set)(facts, value);
        if parameter.name == "alpha" {
            check_amplitude_of(facts, value)?;
        }
    }
    Ok(())
}

/// Refuses facts in which a number that the scene must have is not given yet.
///
/// # Errors
/// When there is one.
pub fn complete(facts: &Facts) -> Result<(), SceneError> {
    // α needs the frequency, so that may be what the amplitude lacks.
    let first = find("frequency").into_iter();
    for parameter in first
        .chain(table())
        .filter(|parameter| parameter.name != "alpha")
    {
        let missing = match (parameter.get)(facts) {
            Some(Value::Number(x)) => x.is_nan(),
            Some(Value::Whole(k)) => matches!(parameter.name, "n" | "rows") && k == 0,
            _ => false,
        };
        if missing {
            let Parameter {
                name, belongs_to, ..
            } = *parameter;
            return Err(SceneError::Missing { name, belongs_to });
        }
    }
    Ok(())
}

/// The scene with one parameter changed.
///
/// # Errors
/// When the value is not allowed in this scene; the scene stays as it is.
pub fn edit(
    scene: &Scene,
    parameter: &'static Parameter,
    value: Value,
) -> Result<Scene, SceneError> {
    let mut facts = scene.facts().clone();
    apply(&mut facts, &[Setting { parameter, value }])?;
    complete(&facts)?;
    Scene::new(facts)
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

/// Refuses an α whose amplitude is out of range.
fn check_amplitude_of(facts: &Facts, alpha: Value) -> Result<(), SceneError> {
    let row = find("amplitude").expect("the table has an amplitude");
    match (row.get)(facts) {
        // Not given yet: frequency or gravity is missing, and that is the error to show.
        Some(Value::Number(amplitude)) if amplitude.is_nan() => Ok(()),
        Some(amplitude) if !row.allows(amplitude) => Err(SceneError::Inconsistent {
            name: "alpha",
            value: alpha.to_string(),
            reason: format!(
                "gives the amplitude {amplitude}, which must be {}",
                row.allowed()
            ),
        }),
        _ => Ok(()),
    }
}
