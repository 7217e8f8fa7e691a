//! Why facts are not a scene, in sentences for people.

use super::words::quote;

/// Why facts are not a scene. Every sentence is one line and names the
/// parameter, what it was given, and what is allowed.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum SceneError {
    /// No parameter has this name.
    #[error("{name}: no such parameter{hint}")]
    Unknown {
        /// The name given.
        name: String,
        /// What may have been meant, with its own punctuation; may be empty.
        hint: String,
    },
    /// The value is of the wrong type, not finite or out of range.
    #[error("{name} = {value}: must be {allowed}")]
    Invalid {
        /// The parameter.
        name: &'static str,
        /// The value given.
        value: String,
        /// What is allowed.
        allowed: String,
    },
    /// The value has a unit that the parameter does not take.
    #[error("{name} = {value}: must be {allowed}")]
    Unit {
        /// The parameter.
        name: &'static str,
        /// The value given.
        value: String,
        /// The unit given.
        unit: String,
        /// What is allowed.
        allowed: String,
    },
    /// The parameter exists, but not in this scene.
    #[error("{name} = {value}: this scene does not have {name}; {belongs_to} have it")]
    Absent {
        /// The parameter.
        name: &'static str,
        /// The value given.
        value: String,
        /// Which scenes have the parameter.
        belongs_to: &'static str,
    },
    /// The scene needs a value for the parameter.
    #[error("{name}: missing; {belongs_to} must have it")]
    Missing {
        /// The parameter.
        name: &'static str,
        /// Which scenes have the parameter.
        belongs_to: &'static str,
    },
    /// The value is in range, but does not go together with the rest of the scene.
    #[error("{name} = {value}: {reason}")]
    Inconsistent {
        /// The parameter.
        name: &'static str,
        /// The value given.
        value: String,
        /// What it does not go together with, and what would.
        reason: String,
    },
}

impl SceneError {
    /// The parameter that the error is about.
    pub fn parameter(&self) -> &str {
        match self {
            Self::Unknown { name, .. } => name,
            Self::Invalid { name, .. }
            | Self::Unit { name, .. }
            | Self::Absent { name, .. }
            | Self::Missing { name, .. }
            | Self::Inconsistent { name, .. } => name,
        }
    }

    /// The same error with the value as it was written, where one is named.
    #[must_use]
    pub(crate) fn with_written(mut self, written: &str) -> Self {
        if let Self::Invalid { value, .. }
        | Self::Unit { value, .. }
        | Self::Absent { value, .. }
        | Self::Inconsistent { value, .. } = &mut self
        {
            *value = quote(written);
        }
        self
    }
}
