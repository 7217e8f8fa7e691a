//! Settings that belong together: a file is one layer, the command line's `--set`
//! options are the next, an edit in the explorer is one of its own.

use super::{Parameter, Value};
use crate::scene::SceneError;

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
