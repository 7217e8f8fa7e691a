//! From a scene to the text of a preset file, and to the command line that makes it.

use super::Preset;
use crate::scene::parameters::{Setting, Value, table};
use crate::scene::words::wrapped;
use crate::scene::{Arrangement, Floor, MethodName, Scene, Start};
use std::fmt::Write;

/// Columns of the lines of a text.
const WIDTH: u16 = 70;

/// All settings of a scene that make it, in the order of the table. α is left to the
/// amplitude, which is what the scene has.
fn settings(scene: &Scene) -> impl Iterator<Item = Setting> {
    let rows = table().iter().filter(|parameter| parameter.name != "alpha");
    rows.filter_map(|parameter| {
        let value = (parameter.get)(scene.facts())?;
        Some(Setting { parameter, value })
    })
}

/// A value as TOML has it.
fn toml(value: Value) -> String {
    match value {
        Value::Choice(word) => format!("{word:?}"),
        other => other.to_string(),
    }
}

impl Scene {
    /// The lines of a preset file that make this very scene, to the last bit.
    pub fn to_toml(&self) -> String {
        let arrangement = match self.arrangement {
            Arrangement::Column => "column",
            Arrangement::Lattice { .. } => "lattice",
        };
        let start = match self.start {
            Start::Launched(_) => "separated",
            Start::Resting => "resting",
        };
        let floor = match self.floor {
            Floor::Fixed => "fixed",
            Floor::Vibrating(_) => "vibrating",
        };
        let mut text = format!(
            "method = \"{}\"\narrangement = \"{arrangement}\"\nstart = \"{start}\"\nfloor = \"{floor}\"\n",
            self.method.name().as_str()
        );
        for Setting { parameter, value } in settings(self) {
            let _ = writeln!(text, "{} = {}", parameter.name, toml(value));
        }
        text
    }

    /// The method and the settings that make another scene of this one: what follows
    /// `beadlab PRESET` on a command line. None where settings alone cannot.
    pub fn difference(&self, other: &Scene) -> Option<(Option<MethodName>, Vec<Setting>)> {
        let name = other.method.name();
        let method = (name != self.method.name()).then_some(name);
        let from = match method {
            Some(name) => self.with_method(name).ok()?,
            None => self.clone(),
        };
        let all: Vec<Setting> = settings(other).collect();
        let same = |setting: &Setting| (setting.parameter.get)(from.facts()) == Some(setting.value);
        let changed: Vec<Setting> = all.iter().copied().filter(|each| !same(each)).collect();
        let makes_it = |layer: &[Setting]| {
            let mut draft = crate::scene::Draft::of(&from);
            draft.set(layer).is_ok() && draft.finish().is_ok_and(|made| made == *other)
        };
        // Where one setting changes another all of them are told.
        [changed, all]
            .into_iter()
            .find(|layer| makes_it(layer))
            .map(|layer| (method, layer))
    }
}

impl Preset {
    /// The text of a file of this preset.
    pub fn to_toml(&self) -> String {
        let mut text = format!("title = {:?}\n", self.title);
        let paragraphs = [
            ("caption", &self.caption),
            ("look_for", &self.look_for),
            ("try_next", &self.try_next),
        ];
        for (key, paragraph) in paragraphs {
            if !paragraph.is_empty() {
                let _ = writeln!(text, "{key} = \"\"\"\n{}\"\"\"", lines(paragraph));
            }
        }
        if let Some(name) = &self.beside {
            let _ = writeln!(text, "beside = {name:?}");
        }
        format!(
            "{text}\n# SI units; `beadlab run --help` explains every name.\n{}",
            self.scene.to_toml()
        )
    }
}

/// A paragraph in lines, as TOML has it within three quotes.
fn lines(paragraph: &str) -> String {
    let escaped = paragraph.replace('\\', "\\\\").replace('"', "\\\"");
    wrapped(&escaped, WIDTH).join("\n")
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::scene::preset::embedded;

    /// Every preset under every method, and with every parameter moved by a key press.
    fn scenes() -> Vec<(Preset, Scene)> {
        let mut scenes = Vec::new();
        for (name, text) in embedded() {
            let preset = Preset::parse(name, text, name).expect("an embedded preset");
            for method in MethodName::ALL {
                let Ok(scene) = preset.scene.with_method(method) else {
                    continue;
                };
                for parameter in table() {
                    let Some(value) = (parameter.get)(scene.facts()) else {
                        continue;
                    };
                    let value = crate::scene::parameters::nudge(parameter, value, 1, true);
                    let mut draft = crate::scene::Draft::of(&scene);
                    let moved = draft.set(&[Setting { parameter, value }]);
                    if let Some(edited) = moved.ok().and_then(|()| draft.finish().ok()) {
                        scenes.push((preset.clone(), edited));
                    }
                }
                scenes.push((preset.clone(), scene));
            }
        }
        scenes
    }

    /// What is written is what is read, to the last bit: scenes are equal or not.
    #[test]
    fn a_written_scene_is_read_back() {
        let scenes = scenes();
        assert!(scenes.len() > 1000);
        for (preset, scene) in scenes {
            let written = Preset {
                scene: scene.clone(),
                ..preset
            };
            let text = written.to_toml();
            let read = Preset::parse(&written.name, &text, "the text");
            assert_eq!(read.as_ref(), Ok(&written), "{text}");
        }
    }

    #[test]
    fn a_command_line_makes_the_scene() {
        for (preset, scene) in scenes() {
            let difference = preset.scene.difference(&scene);
            let (method, settings) =
                difference.unwrap_or_else(|| panic!("{}: {}", preset.name, scene.to_toml()));
            let made = preset.with(method, &settings).map(|made| made.scene);
            assert_eq!(made.as_ref(), Ok(&scene));
        }
    }
}
