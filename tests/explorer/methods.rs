//! Methods and their errors on the model and the screen: the key for the run in the shadow,
//! the methods that come round, and what the screen says of them.

use beadlab::live::Order;
use beadlab::scene::MethodName;
use beadlab::tui::model::Model;
use beadlab::tui::update::Command;

use crate::play::{Act, COLOURS, play, real, type_text};
use crate::typist::{self, model, type_keys};

fn shadow(command: Option<&Command>) -> Option<bool> {
    match command {
        Some(Command::Order(Order::Shadow(on))) => Some(*on),
        _ => None,
    }
}

#[test]
fn the_key_asks_and_hard_spheres_say_why_not() {
    let mut model = model("shaken");
    assert!(model.notices().is_empty());
    let command = type_keys(&mut model, "x");
    assert_eq!(shadow(command.as_ref()), Some(true));
    let message = model.message.as_ref().expect("the twin has none");
    assert!(message.text.contains("hard spheres") && !message.alarm);
    assert_eq!(model.notices().len(), 1);
    let command = type_keys(&mut model, "x");
    assert_eq!(shadow(command.as_ref()), Some(false));
    assert!(model.notices().is_empty() && model.message.is_none());
    // Hard spheres on both sides.
    type_keys(&mut model, "mmm");
    let command = type_keys(&mut model, "x");
    assert_eq!(shadow(command.as_ref()), Some(false));
    let message = model.message.as_ref().expect("the reason is told");
    assert!(message.alarm && message.text.contains("hard spheres"));
}

#[test]
fn the_methods_come_round_with_their_numbers() {
    let mut model = model("shaken");
    let name = |model: &Model| model.bench.scenes()[0].method.name();
    type_keys(&mut model, ":steps_per_contact=37\n");
    let own = model.bench.scenes()[0].method;
    for next in [MethodName::Verlet, MethodName::Exact, MethodName::Ed] {
        type_keys(&mut model, "m");
        assert_eq!(name(&model), next);
    }
    type_keys(&mut model, "m");
    assert_eq!(model.bench.scenes()[0].method, own);

    let mut model = typist::model("fig3-hertz");
    type_keys(&mut model, ":tolerance=1e-7\n");
    let own = model.bench.scenes()[0].clone();
    for next in [
        MethodName::Ed,
        MethodName::Gear,
        MethodName::Verlet,
        MethodName::Exact,
    ] {
        type_keys(&mut model, "m");
        assert_eq!(name(&model), next);
        assert!((model.bench.scenes()[0].restitution / own.restitution - 1.0).abs() < 1e-12);
    }
    assert_eq!(model.bench.scenes()[0], own);
    // The hard twin has the restitution at the scene's own speed.
    type_keys(&mut model, ":v0=-0.5\n");
    let scenes = model.bench.scenes();
    assert!(scenes[0].restitution != own.restitution);
    assert_eq!(
        scenes[0].restitution.to_bits(),
        scenes[1].restitution.to_bits()
    );
}

/// Keys, and what is waited for after them.
type Step<'a> = (&'a str, fn(&str) -> bool);

/// What the screen shows at the end of these steps.
fn screen(name: &str, size: (u16, u16), steps: &[Step]) -> String {
    let mut script = vec![Act::See(&[" t "])];
    for (keys, is_so) in steps {
        script.extend(type_text(keys));
        script.push(Act::Until(*is_so));
    }
    play(name, COLOURS, size, real(), script).join("\n")
}

#[test]
fn the_error_is_on_the_screen_while_it_is_asked_for() {
    let is_told = |shown: &str| shown.contains("exact by");
    for size in [(80, 24), (60, 18), (40, 12)] {
        let shown = screen("shaken", size, &[("x", is_told)]);
        assert!(is_told(&shown), "{size:?}\n{shown}");
    }
    let is_gone = |shown: &str| !shown.contains("exact by");
    let shown = screen("shaken", (80, 24), &[("x", is_told), ("x", is_gone)]);
    assert!(is_gone(&shown), "{shown}");
    let is_drawn = |shown: &str| shown.contains(" error/d ") && shown.contains("1e-18");
    let shown = screen("shaken", (120, 40), &[("x", is_drawn)]);
    assert!(is_drawn(&shown), "{shown}");
    let is_told = |shown: &str| shown.contains("tolerance 1e-12 by");
    let shown = screen("fig3-hertz", (80, 24), &[("x", is_told)]);
    assert!(is_told(&shown), "{shown}");
}

#[test]
fn too_few_steps_are_warned_of_until_they_are_enough() {
    let coarse = "m:steps_per_contact=3\n";
    let warned = |shown: &str| {
        shown.contains("unstable: closed contacts need steps_per_contact of at least 4")
    };
    let shown = screen("shaken", (80, 24), &[(coarse, warned)]);
    assert!(warned(&shown), "{shown}");
    let mended = |shown: &str| !shown.contains("unstable");
    let shown = screen("shaken", (80, 24), &[(coarse, warned), ("u", mended)]);
    assert!(mended(&shown), "{shown}");
    // Where there is no room for a row of its own it is the line of the moment.
    let in_short = |shown: &str| shown.contains("unstable");
    let shown = screen("shaken", (60, 9), &[(coarse, in_short)]);
    assert!(in_short(&shown), "{shown}");
}

#[test]
fn titles_name_the_method_and_screens_the_law() {
    let adaptive = |shown: &str| shown.contains("adaptive, 1e-10") && shown.contains("N 10  hertz");
    let shown = screen("fig3-hertz", (80, 24), &[("", adaptive)]);
    assert!(adaptive(&shown), "{shown}");
    let verlet = |shown: &str| shown.contains("Verlet, t_c/100, Hertz-KK");
    let shown = screen("fig3-hkk", (200, 60), &[("mmm", verlet)]);
    assert!(verlet(&shown), "{shown}");
    let exact = |shown: &str| shown.contains("MD  exact");
    let shown = screen("shaken", (80, 24), &[("mm", exact)]);
    assert!(exact(&shown), "{shown}");
}
