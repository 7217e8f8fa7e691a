//! The directions in which rooms may depend on each other, and what is none of their business.

use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

use crate::source::Source;

/// Each room, and the rooms that it may name, in tests of its own too.
const ROOMS: [(&str, &[&str]); 10] = [
    ("math", &[]),
    ("numerals", &["math"]),
    ("scene", &["math", "numerals"]),
    ("physics", &["math", "scene"]),
    ("study", &["math", "numerals", "scene", "physics"]),
    ("tape", &["scene", "physics"]),
    ("live", &["math", "scene", "physics", "tape"]),
    (
        "tui",
        &[
            "math", "numerals", "scene", "physics", "study", "tape", "live",
        ],
    ),
    ("cli", &["scene", "study"]),
    (
        "commands",
        &[
            "math", "numerals", "scene", "physics", "study", "tape", "live", "tui", "cli",
        ],
    ),
];

/// The terminal.
const SCREEN: [&str; 3] = ["ratatui", "crossterm", "vte"];

/// What the program's surroundings are reached by.
const OUTSIDE: [&str; 7] = [
    "std::io",
    "std::fs",
    "std::env",
    "std::process",
    "std::thread",
    "std::time",
    "crossbeam_channel",
];

/// What a room names of these, as `module: path`.
fn named(source: &Source, room: &str, forbidden: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for module in source
        .modules()
        .filter(|module| module.first().is_some_and(|r| r == room))
    {
        for path in source.paths(module).iter().map(|path| path.join("::")) {
            let is = |of: &&&str| path == **of || path.starts_with(&format!("{of}::"));
            if forbidden.iter().any(|of| is(&of)) {
                found.push(format!("{}: {path}", module.join("::")));
            }
        }
    }
    found
}

#[test]
fn rooms_name_none_above_them() {
    let source = Source::read(true);
    let rooms: BTreeSet<&str> = ROOMS.iter().map(|(room, _)| *room).collect();
    let there: BTreeSet<&str> = source
        .modules()
        .filter_map(|module| module.first().map(String::as_str))
        .collect();
    assert_eq!(rooms, there, "every room has its place in the list");
    let mut wrong = Vec::new();
    for module in source.modules() {
        let Some(room) = module.first() else { continue };
        let allowed = ROOMS.iter().find(|(name, _)| name == room);
        let (_, allowed) = allowed.expect("just compared");
        for path in source.paths(module) {
            let Some(other) = source
                .home(module, path)
                .and_then(|home| home.first().cloned())
            else {
                continue;
            };
            if other != *room && !allowed.contains(&other.as_str()) {
                wrong.push(format!("{}: {}", module.join("::"), path.join("::")));
            }
        }
    }
    assert_eq!(wrong, Vec::<String>::new());
}

#[test]
fn physics_is_pure() {
    let source = Source::read(true);
    for room in ["math", "physics"] {
        let forbidden = [&SCREEN[..], &OUTSIDE].concat();
        assert_eq!(named(&source, room, &forbidden), Vec::<String>::new());
    }
    assert!(
        !named(&source, "physics", &["std::f64"]).is_empty(),
        "paths are seen at all"
    );
}

#[test]
fn only_the_face_knows_a_screen() {
    let source = Source::read(true);
    for room in ["scene", "study", "live"] {
        assert_eq!(named(&source, room, &SCREEN), Vec::<String>::new());
    }
    assert!(
        !named(&source, "tui", &SCREEN).is_empty(),
        "it is seen at all"
    );
}

/// Studies return what they find; commands write it.
#[test]
fn studies_and_physics_write_nothing() {
    let source = Source::read(true);
    assert_eq!(named(&source, "study", &["std::fs"]), Vec::<String>::new());
    for file in ["math", "scene", "physics", "study"]
        .iter()
        .flat_map(|name| room(name))
    {
        let text = fs::read_to_string(&file).expect("a readable source file");
        assert!(!text.contains("println!"), "{}", file.display());
    }
}

fn rust_files(folder: &Path) -> Vec<PathBuf> {
    let mut files = Vec::new();
    for entry in fs::read_dir(folder).expect("a source folder").flatten() {
        let path = entry.path();
        if path.is_dir() {
            files.extend(rust_files(&path));
        } else if path.extension().is_some_and(|extension| extension == "rs") {
            files.push(path);
        }
    }
    files
}

/// Files of a room: `src/room.rs` and all below `src/room/`, if there is such a folder.
fn room(name: &str) -> Vec<PathBuf> {
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let folder = source.join(name);
    let mut files = if folder.is_dir() {
        rust_files(&folder)
    } else {
        Vec::new()
    };
    files.push(source.join(name).with_extension("rs"));
    files
}

/// A law answers for itself: who names its variants elsewhere would silently do without a
/// new one.
#[test]
fn two_files_name_the_contact_laws() {
    let naming: Vec<PathBuf> = ["scene", "physics", "study", "live", "tui", "commands"]
        .iter()
        .flat_map(|name| room(name))
        .filter(|file| !file.ends_with("tests.rs") && !file.iter().any(|part| part == "tests"))
        .filter(|file| {
            let text = fs::read_to_string(file).expect("a readable source file");
            let code = text.split("#[cfg(test)]").next().unwrap_or_default();
            let in_law = file.ends_with("scene/law.rs");
            code.contains("Law::Hooke") || code.contains("Law::Power") || in_law
        })
        .collect();
    let source = Path::new(env!("CARGO_MANIFEST_DIR")).join("src");
    let expected = ["scene/law.rs", "physics/contact_law.rs"].map(|file| source.join(file));
    assert_eq!(naming, expected);
}
