//! A lattice on the explorer's screen: the real loop, and discs that are put where the
//! test wants them.

use crate::play::{
    ASCII, Act, COLOURS, Fault, MEMORY, faulty, load, play, play_preset, preset, real, sweep,
    twins, type_text, until,
};
use crate::typist::{self, type_keys};
use beadlab::live;
use beadlab::physics::{self, Discs, Engine, EngineError, Handover, Observation, Outcome, State};
use beadlab::scene::parameters::Setting;
use beadlab::scene::{Preset, Scene};
use beadlab::tui::model::{Model, Overlay};
use crossterm::event::KeyCode;

const SIZE: (u16, u16) = (80, 24);
/// Cells of the discs at that size; thirteen discs of two cells each.
const DISCS: usize = 26;

/// `fig4` with other values.
fn lattice(pairs: &[(&str, &str)]) -> Preset {
    let settings: Vec<Setting> = pairs
        .iter()
        .map(|(name, value)| Setting::read(name, value).expect("a setting"))
        .collect();
    let changed = preset("fig4").with(None, &settings);
    changed.expect("a lattice")
}

/// A lattice that stands still where it was put.
#[derive(Clone)]
struct Posed {
    engine: Box<dyn Engine>,
    pose: fn(&mut Observation),
}

impl Engine for Posed {
    fn time(&self) -> f64 {
        self.engine.time()
    }

    fn advance(&mut self, _until: f64, _budget: u64) -> Result<Outcome, EngineError> {
        Ok(Outcome::Reached)
    }

    fn is_over(&self) -> bool {
        false
    }

    fn next_event(&self) -> Option<f64> {
        None
    }

    fn observe(&self, into: &mut Observation) {
        self.engine.observe(into);
        into.reduced.fill(0.0);
        if let Some(discs) = &mut into.discs {
            discs.touching.fill(false);
            (self.pose)(into);
        }
    }

    fn state(&self) -> State {
        self.engine.state()
    }
}

/// One row of thirteen discs on the floor, posed.
fn posed(theme: beadlab::tui::theme::Theme, pose: fn(&mut Observation)) -> Vec<String> {
    let build = Box::new(move |scene: &Scene, from: Option<&State>| {
        let (engine, handover): (_, Handover) = physics::build(scene, from);
        let posed: Box<dyn Engine> = Box::new(Posed { engine, pose });
        (posed, handover)
    });
    let pause = Act::Key(KeyCode::Char(' '));
    let still = vec![Act::Until(has_discs), pause, Act::See(&["paused"])];
    let one_row = lattice(&[("rows", "1"), ("s0", "0"), ("jitter", "off")]);
    play_preset(one_row, theme, SIZE, build, still)
}

fn discs(into: &mut Observation) -> &mut Discs {
    into.discs.as_mut().expect("a lattice has discs")
}

/// Whether the plane has discs, of dots or of characters.
fn has_discs(screen: &str) -> bool {
    let rows: Vec<String> = screen.lines().map(str::to_owned).collect();
    let is_disc = |c: char| matches!(c, 'o' | '@' | '\u{2801}'..='\u{28ff}');
    rows.len() > 20 && plane(&rows).iter().any(|row| row.contains(is_disc))
}

/// The rows of the screen that have discs, as far as the discs go; the rule above them
/// and the scale below are not among them.
fn plane(screen: &[String]) -> Vec<String> {
    let rows = screen[2..20].iter();
    rows.map(|row| row.chars().take(DISCS).collect()).collect()
}

/// Where a character stands on the plane: columns and rows.
fn found(plane: &[String], wanted: char) -> Vec<(usize, usize)> {
    let row = |(y, row): (usize, &String)| -> Vec<(usize, usize)> {
        let cells = row.chars().enumerate();
        cells
            .filter(|(_, c)| *c == wanted)
            .map(|(x, _)| (x, y))
            .collect()
    };
    plane.iter().enumerate().flat_map(row).collect()
}

/// Dots of a metre on the plane, from the scale on the screen: the discs, of 1 mm, are
/// four dots wide.
fn dots_per_metre(screen: &[String]) -> f64 {
    let scale: String = screen[20].chars().take(DISCS).collect();
    let number = scale.split("gap").nth(1).expect("the scale is told");
    let number: f64 = number[1..].trim().parse().expect("a number");
    number * 4.0 / 1e-3
}

#[test]
fn discs_stand_where_they_are() {
    let on_the_floor = posed(ASCII, |_| {});
    let plane_now = plane(&on_the_floor);
    let row = plane_now.iter().position(|row| row.contains('o'));
    let row = row.expect("discs are drawn");
    assert_eq!(plane_now[row], " o".repeat(13), "{plane_now:#?}");
    assert_eq!(found(&plane_now, 'o').len(), 13);
    let floor = found(&plane_now, '/').first().copied().expect("a floor");
    assert!(floor.1 - row <= 1, "the discs stand on the floor");

    let one_up = posed(ASCII, |seen| {
        seen.reduced[3] = 1.5e-6;
        discs(seen).touching[3] = true;
    });
    let plane_now = plane(&one_up);
    let risen = 1.5e-6 * dots_per_metre(&one_up) / 4.0;
    let [(x, y)] = found(&plane_now, '@')[..] else {
        panic!("one disc touches: {plane_now:#?}");
    };
    assert_eq!(x, 7);
    // A character stands in one of the rows of four dots each.
    let difference = (row - y) as f64 - risen;
    assert!(difference.abs() <= 1.0 && risen > 2.0, "{plane_now:#?}");
}

#[test]
fn what_leaves_on_one_side_enters_on_the_other() {
    let shifts: [fn(&mut Observation); 6] = [
        |seen| shift(seen, 0.0),
        |seen| shift(seen, 1e-6),
        |seen| shift(seen, 2e-6),
        |seen| shift(seen, 4e-6),
        |seen| shift(seen, -3e-6),
        |seen| shift(seen, 1e-3),
    ];
    for (pose, by) in shifts
        .into_iter()
        .zip([0.0f64, 1e-6, 2e-6, 4e-6, -3e-6, 1e-3])
    {
        let screen = posed(ASCII, pose);
        let plane = plane(&screen);
        let all = found(&plane, 'o').len() + found(&plane, '@').len();
        assert_eq!(all, 13, "shifted by {by}: {plane:#?}");
        let [(x, _)] = found(&plane, '@')[..] else {
            panic!("one disc touches: {plane:#?}");
        };
        if by.abs() < 1e-5 {
            // The scale on the screen has two digits or three.
            let place = (23.0f64 + by * dots_per_metre(&screen) / 2.0).rem_euclid(26.0);
            let off = (x as f64 - place).abs();
            assert!(off.min(26.0 - off) <= 1.5, "{x} is not {place}");
        }
    }
}

/// All discs to the right, the twelfth marked.
fn shift(seen: &mut Observation, by: f64) {
    let discs = discs(seen);
    discs.x.iter_mut().for_each(|x| *x += by);
    discs.touching[11] = true;
}

#[test]
fn discs_that_touch_are_filled() {
    let dots = |screen: &[String]| -> u32 {
        let plane = plane(screen);
        let cells = plane.iter().flat_map(|row| row.chars());
        let masks = cells.filter_map(|c| (c as u32).checked_sub(0x2800));
        masks.map(u32::count_ones).sum()
    };
    let free = dots(&posed(COLOURS, |_| {}));
    let touching = dots(&posed(COLOURS, |seen| {
        discs(seen).touching[2] = true;
        discs(seen).touching[7] = true;
    }));
    // An outline of four dots has eight, a filled disc twelve.
    assert_eq!(touching, free + 2 * 4);
    assert!(free >= 13 * 8);
}

/// What stands beside a lattice on 80 by 24, sooner or later.
const TAUGHT: &[&str] = &[
    "130 discs",
    "filled: touching",
    "gap×",
    "2D",
    "1D",
    "µm",
    "E_r/E",
    "free flight / t_c",
    "detachment: 2D fails",
    "ε_eff",
    "rows",
    "restitution",
    "e/E",
    "t/T",
    "real time",
];

#[test]
fn everything_needed_to_teach_is_on_80_by_24() {
    let screen = play("fig4", COLOURS, SIZE, real(), vec![Act::See(TAUGHT)]).join("\n");
    for word in TAUGHT {
        assert!(screen.contains(word), "{word} is missing:\n{screen}");
    }
}

#[test]
fn every_size_can_be_drawn_and_every_key_pressed() {
    for size in [
        (120, 40),
        (60, 18),
        (41, 12),
        (39, 9),
        (20, 5),
        (2, 2),
        (1, 1),
    ] {
        for theme in [COLOURS, ASCII] {
            let mut script = type_text("mwuwx.p");
            script.push(Act::Frames(1));
            play("fig4", theme, size, real(), script);
        }
    }
    let mut script = Vec::new();
    for (width, height) in [(1, 1), (200, 60), (0, 0), (30, 7), (20, 5)] {
        script.push(Act::Resize(width, height));
        script.push(Act::Frames(2));
    }
    let screen = play("fig4", COLOURS, SIZE, real(), script).join("");
    let dots = screen
        .chars()
        .filter(|c| ('\u{2801}'..='\u{28ff}').contains(c));
    assert!(dots.count() > 10, "no discs on 20 by 5: {screen}");
}

#[test]
fn lattices_of_every_shape_can_be_drawn() {
    for (rows, columns) in [
        ("1", "3"),
        ("60", "3"),
        ("2", "300"),
        ("700", "3"),
        ("1", "5"),
    ] {
        let shape = lattice(&[("rows", rows), ("columns", columns)]);
        for (theme, size) in [(COLOURS, SIZE), (ASCII, SIZE), (COLOURS, (20, 5))] {
            let script = vec![Act::Frames(2)];
            play_preset(shape.clone(), theme, size, real(), script);
        }
    }
}

#[test]
fn columns_have_no_discs() {
    let screen = play(
        "fig1b",
        COLOURS,
        SIZE,
        real(),
        vec![Act::See(&["ε_eff", "quit"])],
    )
    .join("\n");
    assert!(
        !screen.contains("discs") && !screen.contains("filled"),
        "{screen}"
    );
    let live = live::spawn(real(), MEMORY).expect("a thread");
    load(&live, twins("fig1b"), sweep(4e-4, true), 1e-4, true);
    let frame = until(&live, |frame| frame.time > 0.0);
    assert!(frame.sides.iter().all(|side| side.seen.discs.is_none()));
}

#[test]
fn from_a_lattice_to_a_column_and_back() {
    let is_column = |screen: &str| {
        let is_lattice = screen.contains("discs") || screen.contains(" fig4");
        !is_lattice && screen.contains("ε_eff")
    };
    let to_column = || {
        let lattice = [Act::See(&["130 discs"]), Act::Key(KeyCode::Char('p'))];
        let choose = [KeyCode::Up, KeyCode::Enter].map(Act::Key);
        let script = lattice.into_iter().chain(choose);
        script.chain([Act::Until(is_column)]).collect::<Vec<_>>()
    };
    let column = play("fig4", COLOURS, SIZE, real(), to_column()).join("\n");
    assert!(is_column(&column), "{column}");
    let mut script = to_column();
    script.extend([KeyCode::Char('p'), KeyCode::Down, KeyCode::Enter].map(Act::Key));
    script.push(Act::See(&["130 discs", "ε_eff"]));
    let back = play("fig4", COLOURS, SIZE, real(), script).join("\n");
    assert!(
        back.contains("130 discs") && back.contains("ε_eff"),
        "{back}"
    );
}

#[test]
fn a_lattice_that_stops_says_why_and_its_column_too() {
    let see = |fault, size, words| {
        let script = vec![Act::See(words)];
        let screen = play("fig4", COLOURS, size, faulty(fault, 1e-5), script).join("\n");
        assert!(screen.contains(words[0]), "{screen}");
    };
    for size in [SIZE, (39, 10)] {
        see(Fault::Errs, size, &["stopped"]);
    }
    see(Fault::Panics, SIZE, &["a bead"]);
}

#[test]
fn the_column_beside_a_lattice_follows_it() {
    let mut model = typist::model("fig4");
    let beside = |model: &Model| {
        let [lattice, column] = model.bench.scenes() else {
            panic!("a lattice has a column beside it");
        };
        let expected = lattice.column_as_high().expect("a lattice");
        assert_eq!(Ok(column), expected.as_ref());
        column.clone()
    };
    assert_eq!(beside(&model).n, 10);
    type_keys(&mut model, "e");
    assert!((beside(&model).restitution - 0.89).abs() < 1e-12);
    type_keys(&mut model, "T:rows=21\n");
    assert_eq!(beside(&model).n, 21);
    type_keys(&mut model, ":tangential_damping=1e4\nm");
    assert_eq!(beside(&model).method, model.bench.scenes()[0].method);
    type_keys(&mut model, "uu");
    assert_eq!(
        (beside(&model).n, model.label(0), model.label(1)),
        (21, "2D", "1D")
    );
    type_keys(&mut model, "u");
    assert_eq!(beside(&model).n, 10);
    // A number of beads is what the lattice does not have.
    type_keys(&mut model, ":n=5\n");
    let Overlay::Prompt(prompt) = &model.overlay else {
        panic!("the line stays open")
    };
    assert!(prompt.note.as_ref().is_some_and(|note| note.alarm));
    model.overlay = Overlay::None;
    assert_eq!(beside(&model).n, 10);
    type_keys(&mut model, "w");
    assert_eq!(model.bench.scenes().len(), 1);
    type_keys(&mut model, "w");
    assert_eq!(beside(&model).n, 10);
}
