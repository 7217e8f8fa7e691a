//! The explorer's real loop, drawn on screens of many sizes.

use crate::play::{ASCII, Act, COLOURS, Fault, faulty, play, real, type_text};
use crossterm::event::KeyCode;

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

/// Words that a screen of 80 by 24 has all the time, of which it may choose one in the last row:
/// the second where the machine is too busy for the first.
const TAUGHT: &[&str] = &[
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
];
const SPEEDS: [&str; 2] = ["1/20 real time", "1/20 asked, "];

/// Words that a screen of 80 by 24 says sooner or later.
const TOLD: &[&str] = &[
    "= free flight / t_c",
    "detachment: MD fails",
    "look for: Hard spheres stay together",
    "the method does that, not the physics.",
    "energy E",
];

fn dots(screen: &str) -> usize {
    let is_dot = |c: &char| ('\u{2801}'..='\u{28ff}').contains(c);
    screen.chars().filter(is_dot).count()
}

fn assert_all(screen: &str, words: &[&str]) {
    for word in words {
        assert!(screen.contains(word), "{word} is missing:\n{screen}");
    }
}

#[test]
fn everything_needed_to_teach_is_on_80_by_24() {
    let is_drawn = |screen: &str| {
        let told = SPEEDS.iter().any(|speed| screen.contains(speed));
        // Beads that move take more dots or fewer: the last screen may have some less.
        told && dots(screen) > 150 && TAUGHT.iter().all(|word| screen.contains(word))
    };
    let script = vec![Act::Until(is_drawn)];
    let screen = joined(&play("shaken", COLOURS, (80, 24), real(), script));
    assert_all(&screen, TAUGHT);
    assert!(
        SPEEDS.iter().any(|speed| screen.contains(speed)),
        "no speed:\n{screen}"
    );
    assert!(dots(&screen) > 100, "nothing is drawn:\n{screen}");
}

/// Whether E_r/E of both columns stands there, under its words or short.
fn has_both_shares(screen: &str) -> bool {
    let shares = ["E_r/E MD 0.", "E_r/E 0."].map(|start| {
        let rest = screen.split(start).nth(1).unwrap_or_default();
        let rest = rest.chars().skip_while(char::is_ascii_digit);
        rest.take(5).collect::<String>()
    });
    shares[0].starts_with(" ED 0") || shares[1].starts_with("/0")
}

/// The verdict of shaken, and E_r/E of both columns.
#[test]
fn small_screens_keep_the_verdict_and_both_energy_shares() {
    for size in [(60, 20), (60, 18), (40, 12), (30, 10)] {
        for theme in [COLOURS, ASCII] {
            let is_told = |screen: &str| screen.contains("detachment") && has_both_shares(screen);
            let script = vec![Act::Until(is_told)];
            let screen = joined(&play("shaken", theme, size, real(), script));
            assert!(screen.contains("detachment"), "{size:?}:\n{screen}");
            assert!(has_both_shares(&screen), "{size:?}:\n{screen}");
        }
    }
    let words = &["shaken  detachment"];
    let script = vec![Act::See(words)];
    let screen = joined(&play("shaken", COLOURS, (20, 5), real(), script));
    assert_all(&screen, words);
}

#[test]
fn signs_and_numbers_are_told_in_words_on_80_by_24() {
    let script = vec![Act::See(TOLD)];
    let screen = joined(&play("shaken", COLOURS, (80, 24), real(), script));
    assert_all(&screen, TOLD);
}

#[test]
fn every_size_can_be_drawn_with_every_overlay() {
    for size in SIZES {
        for key in [' ', '?', 'p', ':', 'w'] {
            let script = vec![Act::Frames(1), Act::Key(KeyCode::Char(key))];
            play("shaken", COLOURS, size, real(), script);
        }
    }
}

#[test]
fn ascii_terminals_get_ascii_only() {
    for size in [(80, 24), (120, 40), (20, 5), (1, 1)] {
        for keys in ["", "?", "p", ":alpha", "w", "m"] {
            let mut script = vec![Act::Frames(2)];
            script.extend(type_text(keys));
            let screen = joined(&play("shaken", ASCII, size, real(), script));
            assert!(screen.is_ascii(), "{size:?} {keys}:\n{screen}");
        }
    }
}

#[test]
fn every_preset_can_be_shown() {
    for (name, _) in beadlab::scene::preset::embedded() {
        let script = vec![Act::See(&["ε_eff", "quit"])];
        let screen = joined(&play(name, COLOURS, (80, 24), real(), script));
        assert!(screen.contains(name), "{screen}");
        assert!(!screen.contains("stopped"), "{screen}");
    }
}

#[test]
fn a_panicking_engine_leaves_a_message_and_its_twin_going() {
    // The clock goes on far beyond the fault.
    let goes_on = |screen: &str| screen.contains("a bead escaped") && time(screen) > 0.03;
    let fault = faulty(Fault::Panics, 0.01);
    let script = vec![Act::Until(goes_on)];
    let screen = joined(&play("shaken", COLOURS, (80, 24), fault, script));
    assert!(screen.contains("stopped: its engine"), "{screen}");
    assert!(
        screen.contains("MD stopped: its engine panicked (a bead escaped)"),
        "{screen}"
    );
    assert!(time(&screen) > 0.03, "{screen}");
}

/// The simulated time in the first row, s.
fn time(screen: &str) -> f64 {
    let time = screen.split(" t ").nth(1).and_then(|t| t.split(' ').next());
    time.and_then(|t| t.parse().ok()).unwrap_or(f64::NAN)
}

#[test]
fn an_engine_error_is_told_and_an_edit_goes_on_from_the_twin() {
    let fault = || faulty(Fault::Errs, 0.01);
    let script = || vec![Act::See(&["became unstable"])];
    let screen = joined(&play("shaken", COLOURS, (80, 24), fault(), script()));
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
    let goes_on = |screen: &str| screen.contains("0.61") && !screen.contains("stopped");
    let edit = [Act::Key(KeyCode::Char('E')), Act::Until(goes_on)];
    let script = script().into_iter().chain(edit).collect();
    let screen = joined(&play("shaken", COLOURS, (80, 24), once, script));
    assert!(!screen.contains("stopped"), "{screen}");
    assert!(screen.contains("0.61"), "{screen}");
}

#[test]
fn a_resize_is_followed() {
    let mut script = Vec::new();
    for (width, height) in [(1, 1), (200, 60), (0, 0), (30, 7), (80, 24)] {
        script.push(Act::Resize(width, height));
        script.push(Act::Frames(2));
    }
    script.push(Act::See(&["ε_eff"]));
    let screen = joined(&play("shaken", COLOURS, (80, 24), real(), script));
    assert!(screen.contains("ε_eff"), "{screen}");
}

#[test]
fn a_floor_collision_holds_when_its_page_is_full() {
    let mut script = type_text("]]]]");
    script.push(Act::See(&["r restarts", "over"]));
    let screen = joined(&play("fig1a", COLOURS, (80, 24), real(), script));
    assert!(screen.contains("r restarts"), "{screen}");
    assert!(screen.contains("over"), "{screen}");
}
