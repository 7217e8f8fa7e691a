//! What is simulated, to be kept and shared: as a preset, and as a command line.

use super::Model;
use super::pace::speed_text;
use crate::scene::{Preset, Scene};

/// Where a preset came from.
#[derive(Debug, Clone)]
pub struct Origin {
    /// What it is called on the command line: a name, or a path.
    pub name: String,
    /// The scene as it stands there.
    pub scene: Scene,
}

impl Origin {
    /// That of an embedded preset.
    pub(super) fn of(preset: &Preset) -> Origin {
        Origin {
            name: preset.name.clone(),
            scene: preset.scene.clone(),
        }
    }
}

impl Model {
    /// The same model, of a preset that came from there.
    #[must_use]
    pub fn from_origin(mut self, origin: Origin) -> Model {
        self.origin = origin;
        self
    }

    /// The command that opens the explorer on what is simulated now, if there is one.
    pub fn command_line(&self) -> Option<String> {
        let (method, settings) = self.origin.scene.difference(self.bench.own())?;
        let mut words = vec!["beadlab".to_owned(), quoted(&self.origin.name)];
        words.extend(method.map(|name| format!("--method {}", name.as_str())));
        let setting = |set: &crate::scene::parameters::Setting| {
            format!("--set {}={}", set.parameter.name, set.value)
        };
        words.extend(settings.iter().map(setting));
        if self.speed != self.fitting {
            let speed = speed_text(self.speed.factor()).replace(' ', "");
            words.push(format!("--speed {speed}"));
        }
        Some(words.join(" "))
    }

    /// What is simulated now, as a preset of its own.
    pub fn as_preset(&self) -> Preset {
        let scene = self.bench.own().clone();
        if scene == self.preset.scene {
            return self.preset.clone();
        }
        let changed = " (changed)";
        let title = self.preset.title.trim_end_matches(changed);
        Preset {
            title: format!("{title}{changed}"),
            scene,
            beside: None,
            ..self.preset.clone()
        }
    }
}

/// A word as a shell takes it for one.
fn quoted(word: &str) -> String {
    let plain = |c: char| c.is_ascii_alphanumeric() || "-_./".contains(c);
    if !word.is_empty() && word.chars().all(plain) {
        word.to_owned()
    } else {
        format!("'{}'", word.replace('\'', "'\\''"))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn words_are_quoted_for_a_shell() {
        for (word, written) in [
            ("fig5b", "fig5b"),
            ("../my presets/a.toml", "'../my presets/a.toml'"),
            ("it's", "'it'\\''s'"),
        ] {
            assert_eq!(quoted(word), written);
        }
    }
}
