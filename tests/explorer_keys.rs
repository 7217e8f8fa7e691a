//! What keys do to the model, and what they ask of the simulation.

#![allow(
    clippy::needless_pass_by_value,
    reason = "predicates of what was just returned"
)]

#[path = "support/explorer.rs"]
mod explorer;

use std::time::Instant;

use beadlab::live::Order;
use beadlab::scene::{Launch, MethodName, Start};
use beadlab::tui::model::{Model, Overlay};
use beadlab::tui::update::{Command, Msg, update};
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};
use explorer::{ASCII, COLOURS, preset};

fn model(name: &str) -> Model {
    Model::new(preset(name), None, COLOURS, (80, 24))
        .expect("the preset has its twin")
        .0
}

fn press(model: &mut Model, code: KeyCode) -> Option<Command> {
    let key = KeyEvent::new(code, KeyModifiers::NONE);
    update(model, Msg::Key(key), Instant::now())
}

fn type_keys(model: &mut Model, keys: &str) -> Option<Command> {
    keys.chars()
        .map(|c| press(model, KeyCode::Char(c)))
        .last()
        .flatten()
}

fn enter(model: &mut Model, text: &str) -> Option<Command> {
    type_keys(model, text);
    press(model, KeyCode::Enter)
}

/// Types a line that is refused: what is said of it, and the line with a bar at the fault.
/// The line is left.
fn refuse(model: &mut Model, text: &str) -> (String, String) {
    assert!(enter(model, text).is_none(), "{text}");
    let Overlay::Prompt(prompt) = &model.overlay else {
        panic!("{text}: the line stays open")
    };
    let note = prompt.note.as_ref().expect("it is told");
    assert!(note.alarm && note.text.lines().count() == 1, "{text}");
    let (before, after) = prompt.text().split_at(prompt.cursor());
    let told = (note.text.clone(), format!("{before}|{after}"));
    press(model, KeyCode::Esc);
    told
}

fn message(model: &Model) -> &str {
    model.message.as_ref().map_or("", |message| &message.text)
}

fn edited(command: Option<Command>) -> bool {
    matches!(command, Some(Command::Order(Order::Edit { .. })))
}

fn restarted(command: Option<Command>) -> bool {
    matches!(command, Some(Command::Order(Order::Load { .. })))
}

fn restitutions(model: &Model) -> Vec<f64> {
    model
        .bench
        .scenes()
        .iter()
        .map(|scene| scene.restitution)
        .collect()
}

#[test]
fn an_edit_reaches_both_twins() {
    let mut model = model("shaken");
    assert!(edited(type_keys(&mut model, "E")));
    assert_eq!(restitutions(&model), [0.61, 0.61]);
    assert!(edited(type_keys(&mut model, "t")));
    assert!(model.bench.contact_time().expect("MD has one") < 7e-6);
    assert!(edited(type_keys(&mut model, "A")) && edited(type_keys(&mut model, "f")));
}

#[test]
fn an_edit_that_one_twin_refuses_reaches_none() {
    let mut model = model("shaken");
    // Hard spheres could have it, soft ones cannot.
    let (why, _) = refuse(&mut model, ":restitution=0");
    assert_eq!(restitutions(&model), [0.6, 0.6]);
    assert!(why.contains("restitution"), "{why}");
}

#[test]
fn bad_entries_change_nothing_and_are_told_in_a_line() {
    let mut model = model("shaken");
    let before = model.bench.scenes().to_vec();
    for text in [
        ":restitution=nan",
        ":foo=1",
        ":v0=1",
        ":n=0",
        ":frequency=inf",
        ":alpha=x",
        ":oops",
        ":speed=-1",
    ] {
        refuse(&mut model, text);
    }
    assert_eq!(model.bench.scenes(), before);
}

#[test]
fn a_wrong_line_points_at_the_place_and_can_be_mended() {
    let mut model = model("shaken");
    for (line, pointed, says) in [
        (
            ":t_c=4mm",
            "t_c=4|mm",
            "contact_time = 4mm: must be in s, ms",
        ),
        (":t_c = 4 mm", "t_c = 4 |mm", "not in mm"),
        (":ε = 1.6", "ε = |1.6", "restitution = 1.6: must be"),
        (
            ":restituton=1",
            "|restituton=1",
            "did you mean restitution?",
        ),
        (":v0=1", "|v0=1", "does not have v0"),
        (":speed=-1", "speed=|-1", "above 0"),
        (":oops", "oops|", "name=value"),
    ] {
        let (why, at) = refuse(&mut model, line);
        assert_eq!(at, pointed);
        assert!(why.contains(says), "{why}");
    }
    // The unit is mended where the cursor stands.
    assert!(enter(&mut model, ":t_c=4mm").is_none());
    press(&mut model, KeyCode::Delete);
    press(&mut model, KeyCode::Delete);
    assert!(edited(enter(&mut model, "us")));
    assert_eq!(model.bench.contact_time(), Some(4e-6));
    assert!(matches!(model.overlay, Overlay::None));
    // A line that was left can be brought back.
    type_keys(&mut model, ":ε=7");
    press(&mut model, KeyCode::Esc);
    type_keys(&mut model, ":");
    press(&mut model, KeyCode::Up);
    press(&mut model, KeyCode::Backspace);
    assert!(edited(enter(&mut model, "0.7")));
    assert_eq!(restitutions(&model), [0.7, 0.7]);
}

#[test]
fn names_and_units_of_the_screen_are_understood() {
    let mut model = model("shaken");
    for line in [
        ":t_c=4.6us",
        ":ε=0.8",
        ":eps=.8",
        ":A=2mm",
        ":f=30",
        ":alpha=2",
    ] {
        assert!(edited(enter(&mut model, line)), "{line}");
    }
    for line in [":N=20", ":n=1e1"] {
        assert!(restarted(enter(&mut model, line)), "{line}");
    }
    let scene = &model.bench.scenes()[0];
    assert_eq!(scene.contact_time(), Some(4.6e-6));
    assert_eq!((scene.restitution, scene.n), (0.8, 10));
}

#[test]
fn the_prompt_takes_the_keys_of_a_shell() {
    let mut model = model("shaken");
    let control = |model: &mut Model, c| {
        let key = KeyEvent::new(KeyCode::Char(c), KeyModifiers::CONTROL);
        assert!(update(model, Msg::Key(key), Instant::now()).is_none());
    };
    let line = |model: &Model| match &model.overlay {
        Overlay::Prompt(prompt) => prompt.text().to_owned(),
        _ => panic!("the prompt is open"),
    };
    type_keys(&mut model, ":f=25Hz");
    control(&mut model, 'w');
    assert_eq!(line(&model), "f=");
    control(&mut model, 'a');
    type_keys(&mut model, "x");
    press(&mut model, KeyCode::Delete);
    control(&mut model, 'e');
    type_keys(&mut model, "0");
    assert_eq!(line(&model), "x=0");
    press(&mut model, KeyCode::Home);
    control(&mut model, 'k');
    control(&mut model, 'x');
    assert_eq!(line(&model), "");
    type_keys(&mut model, "rul");
    press(&mut model, KeyCode::Tab);
    assert_eq!(line(&model), "rule=");
    type_keys(&mut model, "t");
    press(&mut model, KeyCode::Tab);
    assert_eq!(line(&model), "rule=tc");
    assert!(edited(press(&mut model, KeyCode::Enter)));
    // A value typed for a row comes back with its name.
    press(&mut model, KeyCode::Enter);
    enter(&mut model, ".8");
    type_keys(&mut model, ":");
    press(&mut model, KeyCode::Up);
    assert_eq!(line(&model), "restitution=.8");
}

#[test]
fn every_edit_is_repeated() {
    let mut model = model("shaken");
    for (keys, told) in [
        (":t_c=4.6us\n", "t_c 7.0 µs → 4.6 µs"),
        ("E", "ε 0.60 → 0.61"),
        ("u", "ε 0.61 → 0.60"),
        (":alpha=3\n", "α 1.996 → 3.0"),
        (":ε=.6\n", "ε 0.60, as before"),
        (":ε=.600001\n", "ε 0.6 → 0.600001"),
        (":speed=1/50\n", "speed 1/20 → 1/50"),
        ("m", "method gear → verlet"),
        (
            ":N=20\n",
            "N 10 → 20; this acts from the start: started again from t = 0",
        ),
        ("0", "this acts from the start: started again from t = 0"),
        ("0", "this is the preset as it came"),
    ] {
        for c in keys.chars() {
            press(
                &mut model,
                if c == '\n' {
                    KeyCode::Enter
                } else {
                    KeyCode::Char(c)
                },
            );
        }
        assert_eq!(message(&model), told);
    }
    let ascii = Model::new(preset("shaken"), None, ASCII, (80, 24));
    let mut model = ascii.expect("the preset has its twin").0;
    enter(&mut model, ":t_c=4.6us");
    assert_eq!(message(&model), "t_c 7.0 us -> 4.6 us");
}

#[test]
fn exact_values_are_typed_for_the_selected_row_or_by_name() {
    let mut model = model("shaken");
    let row = model
        .bench
        .parameters()
        .iter()
        .position(|p| p.name == "frequency");
    for _ in model.selected..row.expect("the plate has one") {
        press(&mut model, KeyCode::Down);
    }
    press(&mut model, KeyCode::Enter);
    assert!(edited(enter(&mut model, "25")));
    let periods: Vec<_> = model.bench.scenes().iter().map(|s| s.period()).collect();
    assert_eq!(periods, [Some(0.04), Some(0.04)]);
    assert!(edited(enter(&mut model, ":alpha=3")));
    let alpha = model.bench.scenes()[1].alpha().expect("the plate shakes");
    assert!((alpha - 3.0).abs() < 1e-9);
}

#[test]
fn undo_redo_and_reset_lead_back() {
    let mut model = model("shaken");
    let start = model.bench.scenes().to_vec();
    type_keys(&mut model, "EEE");
    assert!(edited(type_keys(&mut model, "u")));
    assert_eq!(restitutions(&model), [0.62, 0.62]);
    assert!(edited(type_keys(&mut model, "0")));
    assert_eq!(model.bench.scenes(), start);
    assert!(edited(type_keys(&mut model, "u")));
    assert_eq!(restitutions(&model), [0.62, 0.62]);
    type_keys(&mut model, "uu");
    assert!(
        type_keys(&mut model, "u").is_none(),
        "there is nothing more to undo"
    );
    assert!(edited(type_keys(&mut model, "U")));
    assert_eq!(restitutions(&model), [0.61, 0.61]);
    type_keys(&mut model, "U");
    assert_eq!(restitutions(&model), [0.62, 0.62]);
    assert!(edited(type_keys(&mut model, "u")));
    assert_eq!(restitutions(&model), [0.61, 0.61]);
    type_keys(&mut model, "e");
    assert!(
        type_keys(&mut model, "U").is_none(),
        "another edit leaves nothing to redo"
    );
}

#[test]
fn what_acts_from_the_start_restarts() {
    let mut model = model("fig1b");
    assert!(restarted(enter(&mut model, ":s0=1e-5")));
    assert!(
        matches!(model.bench.scenes()[0].start, Start::Launched(Launch { s0, .. }) if (s0 - 1e-5).abs() < 1e-18)
    );
    assert!(restarted(enter(&mut model, ":n=20")));
    assert!(model.bench.scenes().iter().all(|scene| scene.n == 20));
    assert!(restarted(type_keys(&mut model, "u")));
    assert!(edited(type_keys(&mut model, "E")));
}

#[test]
fn m_goes_round_the_methods_and_keeps_the_contact_time() {
    let mut model = model("shaken");
    let name = |model: &Model| model.bench.scenes()[0].method.name();
    for expected in [
        MethodName::Verlet,
        MethodName::Exact,
        MethodName::Ed,
        MethodName::Gear,
    ] {
        assert!(edited(type_keys(&mut model, "m")));
        assert_eq!(name(&model), expected);
    }
    assert_eq!(
        model.bench.scenes()[0].contact_time(),
        preset("shaken").scene.contact_time()
    );
}

#[test]
fn w_takes_the_twin_away_and_brings_it_back_from_here() {
    let mut model = model("shaken");
    let off = type_keys(&mut model, "w");
    assert!(
        matches!(off, Some(Command::Order(Order::Edit { scenes, from })) if scenes.len() == 1 && from == [0])
    );
    let on = type_keys(&mut model, "w");
    assert!(
        matches!(on, Some(Command::Order(Order::Edit { scenes, from })) if scenes.len() == 2 && from == [0, 0])
    );
}

#[test]
fn only_parameters_of_the_scene_are_on_the_panel() {
    let names = |name: &str| {
        model(name)
            .bench
            .parameters()
            .iter()
            .map(|p| p.name)
            .collect::<Vec<_>>()
    };
    let collision = names("fig1a");
    assert!(
        collision.contains(&"s0")
            && !collision.contains(&"amplitude")
            && !collision.contains(&"gravity")
    );
    let shaken = names("shaken");
    assert!(shaken.contains(&"alpha") && !shaken.contains(&"v0"));
    let mut model = model("fig1a");
    assert!(type_keys(&mut model, "A").is_none());
    assert!(
        model
            .message
            .is_some_and(|message| message.text.contains("amplitude"))
    );
}

#[test]
fn space_steps_and_speeds_ask_for_what_they_say() {
    let mut model = model("shaken");
    assert!(matches!(
        type_keys(&mut model, " "),
        Some(Command::Order(Order::Run(false)))
    ));
    assert!(matches!(
        type_keys(&mut model, " "),
        Some(Command::Order(Order::Run(true)))
    ));
    assert!(
        matches!(type_keys(&mut model, "."), Some(Command::Order(Order::Step(time))) if time > 0.0)
    );
    assert!(matches!(
        type_keys(&mut model, ">"),
        Some(Command::Order(Order::NextEvent))
    ));
    assert!(
        matches!(type_keys(&mut model, "["), Some(Command::Order(Order::Speed(s))) if (s - 0.02).abs() < 1e-12)
    );
    assert!(
        matches!(type_keys(&mut model, "]"), Some(Command::Order(Order::Speed(s))) if (s - 0.05).abs() < 1e-12)
    );
    assert!(restarted(type_keys(&mut model, "r")));
    assert!(matches!(type_keys(&mut model, "q"), Some(Command::Quit)));
}

#[test]
fn a_preset_is_chosen_from_the_list() {
    let mut model = model("shaken");
    type_keys(&mut model, "p");
    assert!(matches!(model.overlay, Overlay::Presets(_)));
    press(&mut model, KeyCode::Down);
    assert!(restarted(press(&mut model, KeyCode::Enter)));
    assert_eq!(model.preset.name, "fig1a");
    type_keys(&mut model, "p");
    press(&mut model, KeyCode::Esc);
    assert!(matches!(model.overlay, Overlay::None));
}
