//! Presets: a scene with what a student should know about it, as a flat TOML file.

mod embedded;
mod entries;
mod file;
mod parse;
mod write;

pub use embedded::embedded;

use super::parameters::Setting;
use super::words::{did_you_mean, quote};
use super::{Draft, MethodName, Scene, SceneError};

/// A scene and its texts. Each text is one paragraph without line breaks: the
/// title fits a line of 70 columns, the others three.
#[derive(Debug, Clone, PartialEq)]
pub struct Preset {
    /// Its name: of the embedded preset, or of the file without `.toml`.
    pub name: String,
    /// What it is, in one line.
    pub title: String,
    /// What is simulated.
    pub caption: String,
    /// What to look for.
    pub look_for: String,
    /// What to try next.
    pub try_next: String,
    /// What is simulated, in numbers.
    pub scene: Scene,
    /// An embedded preset to run beside it. A soft-contact scene without one has
    /// the same scene with hard spheres for a twin.
    pub beside: Option<String>,
}

/// Why there is no preset; every sentence is one line.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum PresetError {
    /// Neither an embedded preset nor a file.
    #[error("{name}: no such preset or file{hint}")]
    Unknown {
        /// The name given.
        name: String,
        /// What may have been meant, with its own punctuation.
        hint: String,
    },
    /// The file cannot be read.
    #[error("{path}: {reason}")]
    Unreadable {
        /// The file.
        path: String,
        /// Why.
        reason: String,
    },
    /// The file is read, but a line of it is wrong.
    #[error("{origin}:{line}:{column}: {what}")]
    Line {
        /// The file.
        origin: String,
        /// Line, from 1.
        line: usize,
        /// Column in characters, from 1.
        column: usize,
        /// What is wrong there.
        what: String,
    },
    /// Something is missing that could stand on any line.
    #[error("{origin}: {what}")]
    Whole {
        /// The file.
        origin: String,
        /// What is missing.
        what: String,
    },
}

impl Preset {
    /// The embedded preset of that name, or else the file at that path.
    ///
    /// # Errors
    /// When there is neither, or the file is not a preset.
    pub fn load(name_or_path: &str) -> Result<Self, PresetError> {
        if let Some(text) = embedded::text(name_or_path) {
            return Self::parse(name_or_path, text, name_or_path);
        }
        if !file::looks_like_path(name_or_path) {
            let hint = match did_you_mean(name_or_path, embedded::names()) {
                hint if hint.is_empty() => "; `beadlab presets` lists them".to_owned(),
                hint => hint,
            };
            return Err(PresetError::Unknown {
                name: quote(name_or_path),
                hint,
            });
        }
        let text = file::read(name_or_path)?;
        Self::parse(&file::stem(name_or_path), &text, name_or_path)
    }

    /// Reads the TOML text of a preset; `origin` stands before errors.
    ///
    /// # Errors
    /// The first thing wrong in the text, with its line and column.
    pub fn parse(name: &str, text: &str, origin: &str) -> Result<Self, PresetError> {
        parse::preset(name, text, origin)
    }

    /// The preset under another method and with other values: one layer over it.
    /// What stood beside it is then no longer its twin, and is dropped; the title says
    /// that it was changed.
    ///
    /// # Errors
    /// When a value is not allowed, or the scene does not have the parameter.
    pub fn with(
        &self,
        method: Option<MethodName>,
        settings: &[Setting],
    ) -> Result<Self, SceneError> {
        if method.is_none() && settings.is_empty() {
            return Ok(self.clone());
        }
        let mut draft = Draft::of(&self.scene);
        if let Some(name) = method {
            draft = draft.under(name);
        }
        draft.set(settings)?;
        Ok(Self {
            scene: draft.finish()?,
            title: format!("{} (changed)", self.title),
            beside: None,
            ..self.clone()
        })
    }
}
