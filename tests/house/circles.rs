//! No circle between files.

use std::collections::{BTreeMap, BTreeSet};

use crate::source::{Names, Source};

/// Who names whom among the children of one module, and where.
type Graph = BTreeMap<String, BTreeMap<String, BTreeSet<String>>>;

/// Circles that are known, as `module: children in a circle`, with the reason why they may stay.
const KNOWN: [(&str, &str); 0] = [];

/// The children of each module, each with all that is below it, by who names whom.
///
/// A name that a module hands on by `use` counts as one of the module that it comes from. What
/// a module and those below it name of each other does not count: a parent is made of its
/// children, and holds what they share. Nor does what stands in tests.
fn graphs(source: &Source) -> BTreeMap<Names, Graph> {
    let mut graphs: BTreeMap<Names, Graph> = BTreeMap::new();
    for module in source.modules() {
        for path in source.paths(module) {
            let Some(home) = source.home(module, path) else {
                continue;
            };
            let common = module.iter().zip(&home).take_while(|(a, b)| a == b).count();
            let (Some(from), Some(to)) = (module.get(common), home.get(common)) else {
                continue;
            };
            let graph = graphs.entry(module[..common].to_vec()).or_default();
            let named = graph.entry(from.clone()).or_default();
            let place = format!("{} names {}", module.join("::"), path.join("::"));
            named.entry(to.clone()).or_default().insert(place);
        }
    }
    graphs
}

/// All that can be reached from a child.
fn reached(graph: &Graph, from: &str) -> BTreeSet<String> {
    let mut all = BTreeSet::new();
    let mut open = vec![from.to_owned()];
    while let Some(here) = open.pop() {
        for next in graph.get(&here).into_iter().flat_map(BTreeMap::keys) {
            if all.insert(next.clone()) {
                open.push(next.clone());
            }
        }
    }
    all
}

/// The circles of a graph: children that can all be reached from each other.
fn circles(graph: &Graph) -> BTreeSet<BTreeSet<String>> {
    let reached: BTreeMap<&String, _> = graph.keys().map(|k| (k, reached(graph, k))).collect();
    let of = |child: &String| -> BTreeSet<String> {
        let there = reached[child].iter();
        let back = |other: &&String| reached.get(*other).is_some_and(|all| all.contains(child));
        there.filter(back).cloned().collect()
    };
    let all = graph.keys().map(of);
    all.filter(|circle| !circle.is_empty()).collect()
}

/// A circle exists where two or more modules with one parent, each with all below it, name each
/// other all the way round: none of them can be read, changed or moved by itself.
#[test]
fn no_files_stand_in_a_circle() {
    let source = Source::read(false);
    let graphs = graphs(&source);
    let mut found = Vec::new();
    for (parent, graph) in &graphs {
        for circle in circles(graph) {
            let children: Vec<&str> = circle.iter().map(String::as_str).collect();
            let name = format!("{}: {}", parent.join("::"), children.join(", "));
            if KNOWN.iter().any(|(known, _)| *known == name) {
                continue;
            }
            let places = circle.iter().flat_map(|from| {
                let to = graph[from].iter().filter(|(to, _)| circle.contains(*to));
                to.flat_map(|(_, places)| places.iter().map(|place| format!("  {place}")))
            });
            found.push(name);
            found.extend(places);
        }
    }
    assert!(found.is_empty(), "circles:\n{}", found.join("\n"));
    // It is the program that was looked at, and rooms name others.
    assert!(graphs[&Vec::new()]["commands"].contains_key("study"));
    assert!(graphs.len() > 10, "{}", graphs.len());
}

#[test]
fn a_circle_is_found() {
    let edge = |to: &str| BTreeMap::from([(to.to_owned(), BTreeSet::new())]);
    let graph = |edges: &[(&str, &str)]| -> Graph {
        let named = edges
            .iter()
            .map(|(from, to)| ((*from).to_owned(), edge(to)));
        named.collect()
    };
    assert!(circles(&graph(&[("a", "b"), ("b", "c"), ("d", "a")])).is_empty());
    let found = circles(&graph(&[("a", "b"), ("b", "c"), ("c", "a"), ("d", "a")]));
    let expected = ["a", "b", "c"].map(str::to_owned);
    assert_eq!(found, BTreeSet::from([BTreeSet::from(expected)]));
}
