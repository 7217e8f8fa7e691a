//! The explorer's real loop, drawn on screens of many sizes.

#[path = "support/explorer.rs"]
mod explorer;

use crossterm::event::KeyCode;
use explorer::{ASCII, Act, COLOURS, Fault, faulty, play, real, type_text};

const SIZES: [(u16, u16); 9] = [
    (80, 24),
    (120, 40),
    (200, 60),
    (60, 18),
    (40, 12),
    (20, 5),
    (5, 3),
    (2, 2),
    (1, 1),
];

fn joined(rows: &[String]) -> String {
    rows.join("\n")
}

#[test]
fn everything_needed_to_teach_is_on_80_by_24() {
    let screen = joined(&play(
        "shaken",
        COLOURS,
        (80, 24),
        real(),
        vec![Act::Wait(4000)],
    ));
    for word in [
        "MD",
        "ED",
        "shaken",
        "mm",
        "E_r/E",
        "σ",
        "ε_eff",
        "restitution",
        "contact time",
        "amplitude",
        "frequency",
        "e/E",
        "t/T",
        "a/A",
        "f/F",
        "gap×",
        "drift",
        "space",
        "quit",
    ] {
        assert!(screen.contains(word), "{word} is missing:\n{screen}");
    }
    // The second where the machine is too busy for it.
    let speeds = ["1/20 real time", "1/20 asked, "];
    assert!(
        speeds.iter().any(|speed| screen.contains(speed)),
        "no speed:\n{screen}"
    );
    let dots = screen
        .chars()
        .filter(|c| ('\u{2801}'..='\u{28ff}').contains(c))
        .count();
    assert!(dots > 100, "nothing is drawn:\n{screen}");
}

/// The verdict of shaken, and E_r/E of both columns, under its words or short.
#[test]
fn small_screens_keep_the_verdict_and_both_energy_shares() {
    for size in [(60, 20), (60, 18), (40, 12), (30, 10)] {
        for theme in [COLOURS, ASCII] {
            let script = vec![Act::Wait(2000)];
            let screen = joined(&play("shaken", theme, size, real(), script));
            assert!(screen.contains("detachment"), "{size:?}:\n{screen}");
            let shares = ["E_r/E MD 0.", "E_r/E 0."].map(|start| {
                let rest = screen.split(start).nth(1).unwrap_or_default();
                rest.chars()
                    .skip_while(char::is_ascii_digit)
                    .take(5)
                    .collect::<String>()
            });
            let whole = shares[0].starts_with(" ED 0") || shares[1].starts_with("/0");
            assert!(whole, "{size:?}:\n{screen}");
        }
    }
    let screen = joined(&play(
        "shaken",
        COLOURS,
        (20, 5),
        real(),
        vec![Act::Wait(2000)],
    ));
    assert!(screen.contains("shaken  detachment"), "{screen}");
}

#[test]
fn signs_and_numbers_are_told_in_words_on_80_by_24() {
    let script = vec![Act::Wait(4000)];
    let screen = joined(&play("shaken", COLOURS, (80, 24), real(), script));
    for words in [
        "= free flight / t_c",
        "detachment: MD fails",
        "look for: Hard spheres stay together",
        "the method does that, not the physics.",
        "energy E",
    ] {
        assert!(screen.contains(words), "{words} is missing:\n{screen}");
    }
}

#[test]
fn every_size_can_be_drawn_with_every_overlay() {
    for size in SIZES {
        for key in [' ', '?', 'p', ':', 'w'] {
            let script = vec![Act::Wait(40), Act::Key(KeyCode::Char(key))];
            play("shaken", COLOURS, size, real(), script);
        }
    }
}

#[test]
fn ascii_terminals_get_ascii_only() {
    for size in [(80, 24), (120, 40), (20, 5), (1, 1)] {
        for keys in ["", "?", "p", ":alpha", "w", "m"] {
            let mut script = vec![Act::Wait(100)];
            script.extend(type_text(keys));
            let screen = joined(&play("shaken", ASCII, size, real(), script));
            assert!(screen.is_ascii(), "{size:?} {keys}:\n{screen}");
        }
    }
}

#[test]
fn every_preset_can_be_shown() {
    for (name, _) in beadlab::scene::preset::embedded() {
        let screen = joined(&play(name, COLOURS, (80, 24), real(), vec![Act::Wait(150)]));
        assert!(screen.contains(name), "{screen}");
        assert!(!screen.contains("stopped"), "{screen}");
    }
}

#[test]
fn a_panicking_engine_leaves_a_message_and_its_twin_going() {
    let screen = play(
        "shaken",
        COLOURS,
        (80, 24),
        faulty(Fault::Panics, 0.01),
        vec![Act::Wait(1200)],
    );
    let all = joined(&screen);
    assert!(all.contains("stopped: its engine"), "{all}");
    assert!(
        all.contains("MD stopped: its engine panicked (a bead escaped)"),
        "{all}"
    );
    // The clock has gone on far beyond the fault.
    let time: f64 = screen[0]
        .split(" t ")
        .nth(1)
        .and_then(|t| t.split(' ').next())
        .and_then(|t| t.parse().ok())
        .expect("a time is shown");
    assert!(time > 0.03, "{all}");
}

#[test]
fn an_engine_error_is_told_and_an_edit_goes_on_from_the_twin() {
    let fault = || faulty(Fault::Errs, 0.01);
    let screen = joined(&play(
        "shaken",
        COLOURS,
        (80, 24),
        fault(),
        vec![Act::Wait(700)],
    ));
    assert!(screen.contains("became unstable"), "{screen}");
    let mut first = true;
    let once = Box::new(
        move |scene: &beadlab::scene::Scene, from: Option<&beadlab::physics::State>| {
            let mut build = if std::mem::replace(&mut first, false) {
                fault()
            } else {
                real()
            };
            build(scene, from)
        },
    );
    let script = vec![Act::Wait(700), Act::Key(KeyCode::Char('E')), Act::Wait(300)];
    let screen = joined(&play("shaken", COLOURS, (80, 24), once, script));
    assert!(!screen.contains("stopped"), "{screen}");
    assert!(screen.contains("0.61"), "{screen}");
}

#[test]
fn a_resize_is_followed() {
    let mut script = Vec::new();
    for (width, height) in [(1, 1), (200, 60), (0, 0), (30, 7), (80, 24)] {
        script.push(Act::Resize(width, height));
        script.push(Act::Wait(60));
    }
    script.push(Act::Wait(300));
    let screen = joined(&play("shaken", COLOURS, (80, 24), real(), script));
    assert!(screen.contains("ε_eff"), "{screen}");
}

#[test]
fn a_floor_collision_holds_when_its_page_is_full() {
    let mut script = type_text("]]]]");
    script.push(Act::Wait(1500));
    let screen = joined(&play("fig1a", COLOURS, (80, 24), real(), script));
    assert!(screen.contains("r restarts"), "{screen}");
    assert!(screen.contains("over"), "{screen}");
}
