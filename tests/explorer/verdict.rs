//! The verdict on soft contacts: the paper's cases, what has none, and that all who print
//! it print the same.

use std::ops::ControlFlow;
use std::process::Command;

use crate::play::{Act, COLOURS, play, real, type_text};
use beadlab::scene::parameters::{Setting, named, parse};
use beadlab::scene::{MethodName, Preset, Scene};
use beadlab::study::verdict::{Verdict, Word, verdict};
use serde_json::Value;

fn judge(scene: &Scene) -> Verdict {
    verdict(scene, &mut |_| ControlFlow::Continue(())).expect("nobody stops it")
}

fn load(name: &str, settings: &[(&str, &str)]) -> Scene {
    let layer: Vec<Setting> = settings
        .iter()
        .map(|(name, value)| {
            let parameter = named(name).expect("a parameter");
            let value = parse(parameter, value).expect("a value");
            Setting { parameter, value }
        })
        .collect();
    let preset = Preset::load(name).expect("the preset is embedded");
    preset.with(None, &layer).expect("a scene").scene
}

#[test]
fn the_papers_cases() {
    // Figs. 1 and 5 part, Fig. 7 agrees; steel is the case between, on which hard spheres
    // part as well.
    for (name, word) in [
        ("fig1a", Word::Detachment),
        ("fig1b", Word::Crossover),
        ("fig1c", Word::Agreement),
        ("fig3-hooke", Word::Detachment),
        ("fig3-hertz", Word::Detachment),
        ("fig4", Word::Detachment),
        ("fig5a", Word::Detachment),
        ("fig5b", Word::Detachment),
        ("fig6b", Word::Detachment),
        ("fig7-md", Word::Agreement),
        ("aluminium", Word::Detachment),
        ("steel", Word::Crossover),
        ("dropped", Word::Detachment),
        ("mixed-sizes", Word::Detachment),
        ("tc-rule", Word::Detachment),
    ] {
        let judged = judge(&load(name, &[]));
        assert_eq!(judged.word, Some(word), "{name}: {}", judged.because);
    }
}

#[test]
fn what_cannot_have_one_says_why() {
    for (name, why) in [
        ("fig1d", "no contact time"),
        ("fig6a", "no contact time"),
        ("inelastic-ball", "no contact time"),
        ("single-ball", "single bead"),
    ] {
        let judged = judge(&load(name, &[]));
        assert_eq!(judged.word, None, "{name}");
        assert!(judged.because.contains(why), "{name}: {}", judged.because);
    }
}

/// Hard spheres know neither length nor speed, and soft ones only σ₀: the verdict on a
/// launched column is the same where that is.
#[test]
fn only_sigma0_counts_without_gravity() {
    for (s0, word) in [
        ("0", Word::Detachment),
        ("1", Word::Crossover),
        ("100", Word::Agreement),
    ] {
        for (v0, contact_time) in [(-0.2, 1e-6), (-1e-3, 1e-3), (-50.0, 1e-7)] {
            let s0: f64 = s0.parse::<f64>().expect("a number") * contact_time * -v0;
            let [s0, v0, t_c] = [s0, v0, contact_time].map(|x: f64| x.to_string());
            let settings = [("s0", &*s0), ("v0", &*v0), ("contact_time", &*t_c)];
            let judged = judge(&load("fig1b", &settings));
            assert_eq!(judged.word, Some(word), "{settings:?}: {}", judged.because);
        }
    }
}

/// It is the scene's: neither the method nor the length of a run changes a letter.
#[test]
fn the_same_by_any_method_and_for_any_duration() {
    let all = |name: &str, durations: &[&str]| {
        let mut said: Vec<Verdict> = Vec::new();
        for duration in durations {
            let scene = load(name, &[("duration", duration)]);
            for method in [MethodName::Gear, MethodName::Verlet, MethodName::Exact] {
                said.push(judge(&scene.with_method(method).expect("it is soft")));
            }
        }
        assert!(said.windows(2).all(|pair| pair[0] == pair[1]), "{said:?}");
    };
    all("fig5b", &["0.1", "60"]);
    all("fig1a", &["1e-5", "1"]);
}

#[test]
fn a_column_that_never_leaves_its_plate_agrees() {
    let judged = judge(&load("fig5b", &[("alpha", "0.9")]));
    assert_eq!(judged.word, Some(Word::Agreement), "{}", judged.because);
}

/// A thousand beads that touch on a plate are too much work: said, not waited for.
#[test]
fn what_is_too_much_work_says_so() {
    let judged = judge(&load("fig1b", &[("n", "2000"), ("s0", "1e-5")]));
    let why = &judged.because;
    assert!(
        why.contains("by sigma_0 = 7.14 alone") && why.contains("too much work"),
        "{why}"
    );
    assert_eq!(judged.word, Some(Word::Agreement));
}

fn beadlab(arguments: &[&str]) -> Value {
    let output = Command::new(env!("CARGO_BIN_EXE_beadlab"))
        .args(arguments)
        .args(["--format", "json"])
        .output()
        .expect("the program runs");
    assert!(output.status.success(), "{arguments:?}");
    serde_json::from_slice(&output.stdout).expect("JSON")
}

#[test]
fn run_advise_and_explorer_say_the_same() {
    let run = beadlab(&["run", "fig1a"]);
    let judged = judge(&load("fig1a", &[]));
    assert_eq!(run["verdict"], "detachment");
    assert_eq!(run["verdict_why"], judged.because);
    let advise = beadlab(&["advise", "fig1a", "--quick"]);
    let text = advise.to_string();
    assert!(
        text.contains("scene_verdict") && text.contains(&judged.because),
        "{text}"
    );
    let screen = play(
        "fig1a",
        COLOURS,
        (80, 24),
        real(),
        vec![Act::See(&["detachment"])],
    )
    .join("\n");
    assert!(screen.contains("detachment"), "{screen}");
    // Hard spheres: no word, but a reason.
    let hard = beadlab(&["run", "fig1d"]);
    assert!(
        hard.get("verdict").is_none() && hard["verdict_why"].is_string(),
        "{hard}"
    );
}

/// An edit has the scene judged anew, and the old verdict is gone at once.
#[test]
fn an_edit_asks_again() {
    let after = |text: &str, is_so: fn(&str) -> bool| {
        let mut script = vec![Act::See(&["detachment"])];
        script.extend(type_text(text));
        script.push(Act::Until(is_so));
        play("fig1a", COLOURS, (80, 24), real(), script).join("\n")
    };
    let agrees = |screen: &str| screen.contains("agreement") && !screen.contains("detachment");
    let screen = after(":s0=1e-4\n", agrees);
    assert!(agrees(&screen), "{screen}");
    let is_single = |screen: &str| screen.contains("single bead");
    let screen = after(":n=1\n", is_single);
    assert!(is_single(&screen), "{screen}");
}
