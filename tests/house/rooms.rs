//! The directions in which rooms may depend on each other.

use std::fs;
use std::path::{Path, PathBuf};

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

fn mentions(room_name: &str, forbidden: &[&str]) -> Vec<String> {
    let mut found = Vec::new();
    for file in room(room_name) {
        let text = fs::read_to_string(&file).expect("a readable source file");
        for word in forbidden.iter().filter(|word| text.contains(**word)) {
            found.push(format!("{}: {word}", file.display()));
        }
    }
    found
}

const OUTSIDE: [&str; 8] = [
    "std::io",
    "std::fs",
    "std::thread",
    "std::time",
    "ratatui",
    "crossterm",
    "crossbeam",
    "println!",
];

#[test]
fn mathematics_knows_no_room() {
    assert_eq!(mentions("math", &["crate::"]), Vec::<String>::new());
}

#[test]
fn physics_is_pure() {
    assert!(
        room("physics").len() > 10,
        "the room is where this test looks"
    );
    let mut forbidden = OUTSIDE.to_vec();
    forbidden.extend([
        "crate::study",
        "crate::live",
        "crate::tui",
        "crate::commands",
        "crate::cli",
    ]);
    assert_eq!(mentions("physics", &forbidden), Vec::<String>::new());
}

#[test]
fn scenes_know_no_physics_and_no_face() {
    let forbidden = [
        "crate::physics",
        "crate::study",
        "crate::live",
        "crate::tui",
        "crate::commands",
        "ratatui",
    ];
    assert_eq!(mentions("scene", &forbidden), Vec::<String>::new());
}

#[test]
fn the_simulation_thread_knows_no_screen() {
    let forbidden = [
        "crate::study",
        "crate::tui",
        "crate::commands",
        "ratatui",
        "crossterm",
    ];
    assert_eq!(mentions("live", &forbidden), Vec::<String>::new());
}

#[test]
fn studies_know_no_face() {
    let forbidden = [
        "crate::live",
        "crate::tui",
        "crate::commands",
        "crate::cli",
        "crossterm",
        "std::fs",
        "println!",
    ];
    assert_eq!(mentions("study", &forbidden), Vec::<String>::new());
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
