//! One name, one thing.

use std::collections::BTreeMap;

use crate::source::Source;

/// Names of types that still stand for two things, with the reason why they may.
const KNOWN: [(&str, &str); 4] = [
    ("Free", GROUND),
    ("Ground", GROUND),
    ("Shaken", GROUND),
    ("Weight", GROUND),
];
/// Engines that make events and those that make steps ask the ground for different things.
const GROUND: &str = "one ground is to answer both kinds of engines";

/// Who reads a name knows what it is of, wherever it stands; who looks for where it is declared
/// finds one place.
#[test]
fn no_type_name_stands_for_two_things() {
    let source = Source::read(true);
    let mut places: BTreeMap<&str, Vec<String>> = BTreeMap::new();
    for module in source.modules() {
        for name in source.types(module) {
            places.entry(name).or_default().push(module.join("::"));
        }
    }
    // It is the program that was looked at.
    assert_eq!(places["Scene"], ["scene"]);
    places.retain(|_, modules| modules.len() > 1);
    for (name, why) in KNOWN {
        let modules = places.remove(name).unwrap_or_default();
        assert!(modules.len() > 1, "{name} is one thing: no longer {why}");
    }
    assert!(places.is_empty(), "{places:#?}");
}
