//! The line of the screen on which names and values are typed.

use std::time::Instant;

use beadlab::tui::model::Model;
use beadlab::tui::model::Overlay;
use beadlab::tui::update::{Msg, update};
use crossterm::event::{KeyCode, KeyEvent, KeyModifiers};

use crate::typist::{edited, enter, model, press, refuse, restarted, restitutions, type_keys};

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
