//! What keys do to the model, and what they ask of the simulation.

use crate::play::{ASCII, preset};
use crate::typist::{
    edited, enter, message, model, press, refuse, restarted, restitutions, type_keys,
};
use beadlab::live::{ColumnSample, History, Leap, Order, Sample, Way};
use beadlab::scene::{Launch, MethodName, Start};
use beadlab::tui::model::{Model, Overlay};
use beadlab::tui::update::Command;
use crossterm::event::KeyCode;

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
        matches!(type_keys(&mut model, "."), Some(Command::Order(Order::Leap(Leap::By(time)))) if time > 0.0)
    );
    assert!(matches!(
        type_keys(&mut model, ">"),
        Some(Command::Order(Order::Leap(Leap::Change(Way::On))))
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

/// Draws something on the page.
fn draw(model: &mut Model) {
    let row = ColumnSample {
        floor: 0.0,
        reduced: vec![1e-3; 10],
        kinetic: 1.0,
        relative: 0.0,
        error: None,
    };
    let rows = vec![Some(row.clone()), Some(row)];
    let mut history = History::new(8);
    history.push(Sample { time: 0.01, rows });
    model.page.take(0.01, history, false);
}

#[test]
fn g_keeps_the_page_over_edits_and_restarts_until_another_preset() {
    let mut model = model("shaken");
    assert!(type_keys(&mut model, "g").is_none());
    assert!(model.page.ghost.is_none(), "nothing is drawn yet");
    draw(&mut model);
    type_keys(&mut model, "g");
    let drawn = |model: &Model| {
        let ghost = model.page.shown_ghost().expect("it is kept");
        assert_eq!(ghost.samples().count(), 1);
        model
            .page
            .ghost_rows(0)
            .filter(|row| row.1.is_some())
            .count()
    };
    assert_eq!(drawn(&model), 1);
    assert!(edited(type_keys(&mut model, "E")) && edited(type_keys(&mut model, "m")));
    assert!(edited(type_keys(&mut model, "u")) && edited(type_keys(&mut model, "0")));
    assert_eq!(drawn(&model), 1);
    assert!(restarted(type_keys(&mut model, "r")));
    assert!(restarted(enter(&mut model, ":n=20")));
    assert_eq!(drawn(&model), 1);
    // A press lets it go, and what follows can be kept again.
    type_keys(&mut model, "g");
    assert!(model.page.ghost.is_none());
    draw(&mut model);
    type_keys(&mut model, "g");
    assert!(model.page.ghost.is_some());
    type_keys(&mut model, "pj");
    assert!(restarted(press(&mut model, KeyCode::Enter)));
    assert!(
        model.page.ghost.is_none(),
        "of another preset it tells nothing"
    );
}

#[test]
fn what_is_saved_has_the_name_of_its_preset() {
    let mut model = model("shaken");
    draw(&mut model);
    let mut endings = |key| {
        let Some(Command::Keep { stem, files }) = type_keys(&mut model, key) else {
            panic!("{key} saves")
        };
        assert_eq!(stem, "shaken");
        assert!(files.iter().all(|file| file.text.ends_with('\n')));
        files.iter().map(|file| file.ending).collect::<Vec<_>>()
    };
    assert_eq!(endings("s"), ["toml"]);
    assert_eq!(endings("P"), ["svg", "csv"]);
}
