//! One name, one thing.

use std::collections::BTreeMap;

use crate::source::Source;

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
    assert!(places.is_empty(), "{places:#?}");
}
