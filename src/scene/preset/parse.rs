//! From entries to a preset. A file is one layer of settings over a frame that
//! the words `method`, `start` and `floor` give.

use super::entries::{Entries, Entry};
use super::{Preset, PresetError, embedded};
use crate::scene::parameters::{self, Kind, Parameter, Setting, Value};
use crate::scene::validate::check_frame;
use crate::scene::words::{did_you_mean, one_line, quote};
use crate::scene::{
    Arrangement, Draft, Facts, Floor, FloorContact, Launch, Law, Method, MethodName, Scene,
    SceneError, Shake, Soft, Solver, Start,
};
use toml::de::DeValue;

/// The texts, and how many characters each may have: lines of 70 columns.
const TEXTS: [(&str, usize); 4] = [
    ("title", 70),
    ("caption", 210),
    ("look_for", 210),
    ("try_next", 210),
];

/// The words that decide which parameters a scene has.
const FRAME: [(&str, &[&str]); 4] = [
    ("arrangement", &["column", "lattice"]),
    ("method", &["gear", "verlet", "exact", "ed"]),
    ("start", &["separated", "resting"]),
    ("floor", &["fixed", "vibrating"]),
];

const BESIDE: &str = "beside";

/// Beads in a row of a lattice, as in the paper.
const COLUMNS: usize = 13;

/// A run with gravity has no end of its own.
const DEFAULT_DURATION: f64 = 1.0;

pub(super) fn preset(name: &str, text: &str, origin: &str) -> Result<Preset, PresetError> {
    let mut entries = Entries::read(text, origin)?;
    // Parameters may be called by their symbols; the words of the file come first.
    entries.rename(|key| match parameters::called(key) {
        Some(parameter) if !known_keys().any(|known| known == key) => Some(parameter.name),
        _ => None,
    })?;
    refuse_unknown_keys(&entries)?;
    Ok(Preset {
        name: name.to_owned(),
        title: paragraph(&entries, "title")?.unwrap_or_else(|| name.to_owned()),
        caption: paragraph(&entries, "caption")?.unwrap_or_default(),
        look_for: paragraph(&entries, "look_for")?.unwrap_or_default(),
        try_next: paragraph(&entries, "try_next")?.unwrap_or_default(),
        scene: scene(&entries)?,
        beside: beside(&entries)?,
    })
}

fn known_keys() -> impl Iterator<Item = &'static str> {
    let texts = TEXTS.iter().map(|&(key, _)| key);
    let frame = FRAME.iter().map(|&(key, _)| key);
    let parameters = parameters::table().iter().map(|parameter| parameter.name);
    texts.chain(frame).chain([BESIDE]).chain(parameters)
}

fn refuse_unknown_keys(entries: &Entries) -> Result<(), PresetError> {
    for entry in entries.iter() {
        let key = quote(&entry.key);
        if !known_keys().any(|known| known == entry.key) {
            let mut hint = did_you_mean(&entry.key, known_keys());
            if hint.is_empty() {
                hint = format!(
                    "; there are {}",
                    known_keys().collect::<Vec<_>>().join(", ")
                );
            }
            return Err(entries.at(entry.key_at, format!("{key}: unknown key{hint}")));
        }
        if let DeValue::Table(_) = entry.value {
            let what = format!("{key}: is a table, but a preset has only lines of key = value");
            return Err(entries.at(entry.key_at, what));
        }
    }
    Ok(())
}

/// A text of the file as one paragraph.
fn paragraph(entries: &Entries, key: &'static str) -> Result<Option<String>, PresetError> {
    let Some(entry) = entries.find(key) else {
        return Ok(None);
    };
    let refuse = |allowed: &str| Err(entries.at(entry.value_at, must_be(entry, allowed)));
    let DeValue::String(text) = &entry.value else {
        return refuse("a text in quotes");
    };
    // An escape sequence in a file must not reach anybody's terminal.
    if text.chars().any(|c| c.is_control() && !c.is_whitespace()) {
        return refuse("a text without control characters");
    }
    let text = one_line(text);
    let most = TEXTS
        .iter()
        .find(|&&(each, _)| each == key)
        .map_or(0, |&(_, most)| most);
    if text.chars().count() > most {
        return refuse(&format!("at most {most} characters long"));
    }
    Ok(Some(text))
}

fn beside(entries: &Entries) -> Result<Option<String>, PresetError> {
    let Some(entry) = entries.find(BESIDE) else {
        return Ok(None);
    };
    match &entry.value {
        DeValue::String(name) if embedded::text(name).is_some() => Ok(Some(name.to_string())),
        DeValue::String(name) => {
            let hint = did_you_mean(name, embedded::names());
            let allowed = format!("the name of an embedded preset{hint}");
            Err(entries.at(entry.value_at, must_be(entry, &allowed)))
        }
        _ => Err(entries.at(
            entry.value_at,
            must_be(entry, "the name of a preset in quotes"),
        )),
    }
}

fn must_be(entry: &Entry, allowed: &str) -> String {
    format!("{} = {}: must be {allowed}", entry.key, entry.written)
}

fn scene(entries: &Entries) -> Result<Scene, PresetError> {
    let facts = frame(entries)?;
    check_frame(&facts).map_err(|error| locate(entries, error))?;
    let mut draft = Draft::framed(facts);
    let mut layer = Vec::new();
    for entry in entries.iter() {
        if let Some(parameter) = parameters::find(&entry.key) {
            let value = value(parameter, entry).map_err(|error| locate(entries, error))?;
            layer.push(Setting { parameter, value });
        }
    }
    draft
        .set(&layer)
        .and_then(|()| draft.finish())
        .map_err(|error| locate(entries, error))
}

/// An error of the scene at its line in the file.
fn locate(entries: &Entries, error: SceneError) -> PresetError {
    let key = error.parameter().to_owned();
    let error = match entries.find(&key) {
        Some(entry) => error.with_written(&entry.written),
        None => error,
    };
    // A missing amplitude may as well be given as α.
    let what = match error {
        SceneError::Missing {
            name: "amplitude", ..
        } => "amplitude: missing; scenes with a vibrating floor must have it or alpha".to_owned(),
        _ => error.to_string(),
    };
    entries.about(&key, what)
}

/// Facts with the right frame, of which no number that the file must give is given yet.
fn frame(entries: &Entries) -> Result<Facts, PresetError> {
    let gravity = entries.find("gravity").map(|_| 1.0);
    let method = word(entries, "method")?.ok_or_else(|| missing(entries, "method"))?;
    let start = word(entries, "start")?.ok_or_else(|| missing(entries, "start"))?;
    let floor = word(entries, "floor")?.unwrap_or("fixed");
    let arrangement = word(entries, "arrangement")?.unwrap_or("column");
    let mut facts = Facts {
        arrangement: match arrangement {
            "lattice" => Arrangement::Lattice {
                columns: COLUMNS,
                tangential: 0.0,
            },
            _ => Arrangement::Column,
        },
        n: COLUMNS,
        diameter: 1.0,
        width: 0.0,
        seed: 1,
        restitution: 1.0,
        floor_contact: FloorContact::SameSpring,
        start: match start {
            "resting" => Start::Resting,
            _ => Start::Launched(Launch {
                s0: 0.0,
                jitter: false,
                v0: -1.0,
            }),
        },
        gravity,
        floor: match floor {
            "vibrating" => Floor::Vibrating(Shake {
                amplitude: 0.0,
                frequency: 1.0,
            }),
            _ => Floor::Fixed,
        },
        method: Method::Soft(Soft {
            law: Law::linear(1.0),
            solver: Solver::Exact,
            attraction: true,
        }),
        duration: gravity.map(|_| DEFAULT_DURATION),
    };
    facts.turn_to(MethodName::find(method).unwrap_or(MethodName::Gear));
    Ok(facts)
}

/// One of the words of the frame, if the file has it.
fn word(entries: &Entries, key: &str) -> Result<Option<&'static str>, PresetError> {
    let Some(entry) = entries.find(key) else {
        return Ok(None);
    };
    let words = FRAME
        .iter()
        .find(|&&(each, _)| each == key)
        .map_or(&[][..], |&(_, words)| words);
    let found = match &entry.value {
        DeValue::String(text) => words.iter().find(|&&word| word == text),
        _ => None,
    };
    match found {
        Some(word) => Ok(Some(word)),
        None => Err(entries.at(entry.value_at, must_be(entry, &in_quotes(words)))),
    }
}

fn missing(entries: &Entries, key: &str) -> PresetError {
    let words = FRAME
        .iter()
        .find(|&&(each, _)| each == key)
        .map_or(&[][..], |&(_, words)| words);
    entries.about(key, format!("{key}: missing; must be {}", in_quotes(words)))
}

fn in_quotes(words: &[&str]) -> String {
    words
        .iter()
        .map(|word| format!("{word:?}"))
        .collect::<Vec<_>>()
        .join(" or ")
}

/// The value of a parameter, from the types that TOML has; a text may be a number with a
/// unit.
fn value(parameter: &Parameter, entry: &Entry) -> Result<Value, SceneError> {
    let value = match (parameter.kind, &entry.value) {
        (Kind::Number { .. } | Kind::Whole { .. }, DeValue::Float(x)) => {
            return parameters::parse(parameter, x.as_str());
        }
        (Kind::Number { .. }, DeValue::Integer(k)) => i64::from_str_radix(k.as_str(), k.radix())
            .ok()
            .map(|k| Value::Number(k as f64)),
        (Kind::Whole { .. }, DeValue::Integer(k)) => u64::from_str_radix(k.as_str(), k.radix())
            .ok()
            .map(Value::Whole),
        (Kind::Flag, DeValue::Boolean(on)) => Some(Value::Flag(*on)),
        (Kind::Number { .. } | Kind::Whole { .. } | Kind::Choice(_), DeValue::String(text)) => {
            return parameters::parse(parameter, text);
        }
        _ => None,
    };
    value
        .filter(|&value| parameter.allows(value))
        .ok_or_else(|| parameter.refuse(&entry.written))
}
