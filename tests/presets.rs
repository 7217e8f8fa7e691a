//! Presets: the embedded ones, and what a file of one's own is told.

#[path = "support/program.rs"]
mod program;

use beadlab::scene::preset::embedded;
use beadlab::scene::{
    Arrangement, Floor, GridSettings, Launch, Method, MethodName, Preset, Shake, Soft, Solver,
    Start,
};
use std::fs;
use std::path::PathBuf;

use program::{beadlab, printed};

fn load(name: &str) -> Preset {
    Preset::load(name).unwrap_or_else(|error| panic!("{error}"))
}

/// Lines of at most `width` columns, as a screen breaks a paragraph.
fn lines(paragraph: &str, width: usize) -> usize {
    let (mut lines, mut column) = (1, 0);
    for word in paragraph.split(' ').map(|word| word.chars().count()) {
        if column > 0 && column + 1 + word > width {
            (lines, column) = (lines + 1, word);
        } else {
            column += word + usize::from(column > 0);
        }
    }
    lines
}

#[test]
fn the_presets_of_the_design_are_embedded_and_teach() {
    let names: Vec<_> = embedded().iter().map(|&(name, _)| name).collect();
    for name in [
        "fig1a",
        "fig1b",
        "fig1c",
        "fig1d",
        "fig1e",
        "fig1f",
        "fig4",
        "fig5a",
        "fig5b",
        "fig6a",
        "fig6b",
        "fig7-md",
        "fig7-ed",
        "steel",
        "aluminium",
        "fig3-hooke",
        "fig3-hertz",
        "fig3-hkk",
        "single-ball",
        "shaken",
    ] {
        assert!(names.contains(&name), "{name}");
    }
    for name in &names {
        let preset = load(name);
        assert_eq!(preset.name, *name);
        assert!(
            !preset.title.is_empty() && preset.title.chars().count() <= 70,
            "{name}"
        );
        for text in [&preset.caption, &preset.look_for, &preset.try_next] {
            assert!(!text.is_empty() && !text.contains('\n'), "{name}: {text:?}");
            assert!(lines(text, 70) <= 3, "{name}: {text}");
        }
    }
}

#[test]
fn every_file_of_the_folder_is_embedded() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("presets");
    let mut files: Vec<String> = fs::read_dir(folder)
        .expect("the folder of presets")
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            path.file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    files.sort();
    let mut names: Vec<_> = embedded()
        .iter()
        .map(|&(name, _)| name.to_owned())
        .collect();
    names.sort();
    assert_eq!(files, names);
}

/// Amplitude A₀, m, frequency, Hz, and reduced acceleration α.
fn plate(preset: &Preset) -> (f64, f64, f64) {
    match preset.scene.floor {
        Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }) => (amplitude, frequency, preset.scene.alpha().expect("gravity")),
        Floor::Fixed => panic!("{} has no plate", preset.name),
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn the_floor_collisions_have_the_papers_numbers() {
    for (soft, hard, separation) in [
        ("fig1a", "fig1d", 0.0),
        ("fig1b", "fig1e", 1e-6),
        ("fig1c", "fig1f", 1e-5),
    ] {
        for name in [soft, hard] {
            let scene = load(name).scene;
            let start = Start::Launched(Launch {
                s0: separation,
                jitter: false,
                v0: -0.2,
            });
            assert_eq!((scene.n, scene.start), (10, start), "{name}");
            assert!(
                close(scene.diameter, 1e-3) && close(scene.restitution, 0.9),
                "{name}"
            );
            assert_eq!((scene.gravity, scene.floor), (None, Floor::Fixed), "{name}");
        }
        let scene = load(soft).scene;
        assert!(close(scene.contact_time().expect("soft"), 0.7e-5));
        assert_eq!(scene.method.name(), MethodName::Gear);
        assert!(
            matches!(scene.method, Method::Soft(Soft { solver: Solver::Grid(GridSettings { steps_per_contact, .. }), attraction: true, .. })
                if close(steps_per_contact, 100.0))
        );
        assert_eq!(load(soft).beside.as_deref(), Some(hard));
        assert_eq!(load(hard).beside.as_deref(), Some(soft));
        assert_eq!(
            load(soft).scene.with_method(MethodName::Ed),
            Ok(load(hard).scene)
        );
    }
}

#[test]
fn the_lattice_has_the_papers_numbers() {
    let scene = load("fig4").scene;
    let arrangement = Arrangement::Lattice {
        columns: 13,
        tangential: 0.0,
    };
    assert_eq!((scene.n, scene.arrangement), (130, arrangement));
    assert!(close(scene.diameter, 1e-3) && close(scene.restitution, 0.9));
    let (Start::Launched(Launch { s0, jitter, v0 }), Some(contact_time)) =
        (scene.start, scene.contact_time())
    else {
        panic!("a soft lattice is thrown");
    };
    assert!(jitter && (1e-7..=1e-3).contains(&s0) && (0.01..=1.0).contains(&-v0));
    assert!((0.2e-5..=1e-4).contains(&contact_time));
}

#[test]
fn the_shaken_columns_have_the_papers_numbers() {
    // Name, N, d, ε, t_c, f, α; fig5 and shaken have A₀ = 1.24 d in place of α.
    for (name, n, diameter, restitution, contact_time, frequency, alpha) in [
        ("fig5a", 10, 1e-3, 0.6, Some(0.7e-3), 20.0, None),
        ("fig5b", 10, 1e-3, 0.6, Some(0.7e-5), 20.0, None),
        ("shaken", 10, 1e-3, 0.6, Some(0.7e-5), 20.0, None),
        ("fig6a", 10, 3e-3, 0.6, None, 10.0, Some(2.0)),
        ("fig6b", 10, 3e-3, 0.6, Some(3.6e-6), 10.0, Some(2.0)),
        ("fig7-md", 10, 1e-3, 0.92, Some(1e-4), 20.0, Some(20.0)),
        ("fig7-ed", 10, 1e-3, 0.92, None, 20.0, Some(20.0)),
        ("steel", 10, 1.5e-3, 0.9, Some(4.6e-6), 20.0, Some(2.0)),
        ("aluminium", 10, 1.5e-3, 0.6, Some(4.6e-6), 20.0, Some(2.0)),
        ("single-ball", 1, 1e-3, 0.6, Some(1e-5), 20.0, Some(2.0)),
    ] {
        let preset = load(name);
        let scene = &preset.scene;
        assert_eq!((scene.n, scene.start), (n, Start::Resting), "{name}");
        assert!(
            close(scene.diameter, diameter) && close(scene.restitution, restitution),
            "{name}"
        );
        assert_eq!(scene.contact_time(), contact_time, "{name}");
        assert_eq!(scene.is_md(), contact_time.is_some(), "{name}");
        let (amplitude, f, reduced) = plate(&preset);
        assert!(close(f, frequency), "{name}");
        match alpha {
            Some(alpha) => assert!(close(reduced, alpha), "{name}: α = {reduced}"),
            None => assert!(close(amplitude, 1.24 * diameter) && (reduced - 2.0).abs() < 0.01),
        }
        let periods = scene.duration.expect("gravity") * f;
        assert!(periods > 19.0, "{name}: {periods} periods");
    }
    for (soft, hard) in [("fig6b", "fig6a"), ("fig7-md", "fig7-ed")] {
        assert_eq!(load(soft).beside.as_deref(), Some(hard));
        assert_eq!(load(hard).beside.as_deref(), Some(soft));
    }
    assert!(close(
        load("fig7-md").scene.duration.expect("gravity"),
        25.0
    ));
}

#[test]
fn a_preset_can_be_shown_checked_and_run_as_a_file() {
    for (name, _) in embedded() {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("shown-{name}.toml"));
        let path = path.to_str().expect("a UTF-8 path");
        fs::write(path, printed(&["presets", "show", name])).expect("a folder of the tests");
        assert!(printed(&["presets", "check", path]).starts_with(path));
        let Preset { scene, .. } = load(path);
        assert_eq!(scene, load(name).scene);
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("shown-fig1e.toml");
    let from_file = printed(&["run", path.to_str().expect("a UTF-8 path")]);
    assert_eq!(
        from_file.replace("shown-fig1e", "fig1e"),
        printed(&["run", "fig1e"])
    );
}

#[test]
fn the_list_names_every_preset_with_its_title() {
    let list = printed(&["presets"]);
    assert_eq!(list, printed(&["presets", "list"]));
    let lines: Vec<_> = list.lines().collect();
    assert_eq!(lines.len(), embedded().len());
    for ((name, _), line) in embedded().iter().zip(lines) {
        assert!(
            line.starts_with(&format!("{name} ")) && line.ends_with(&load(name).title),
            "{line}"
        );
    }
}

/// A scene that is good as it stands.
const GOOD: &str = "\
method = \"gear\"
start = \"resting\"
floor = \"vibrating\"
n = 5
diameter = 1e-3
restitution = 0.6
contact_time = 1e-5
gravity = 9.81
alpha = 2
frequency = 20
";

fn parse(text: &str) -> Result<Preset, String> {
    Preset::parse("own", text, "own.toml").map_err(|error| error.to_string())
}

#[test]
fn a_file_may_leave_out_what_has_a_default() {
    let preset = parse(GOOD).expect("good");
    assert_eq!(
        (preset.title.as_str(), preset.scene.duration),
        ("own", Some(1.0))
    );
    assert!((preset.scene.alpha().expect("a plate") - 2.0).abs() < 1e-12);
    // Windows line ends, a byte order mark and another order change nothing.
    let scrambled: Vec<_> = GOOD.lines().rev().collect();
    let scrambled = format!("\u{feff}{}\r\n", scrambled.join("\r\n"));
    assert_eq!(
        parse(&scrambled).map(|preset| preset.scene),
        Ok(preset.scene)
    );
}

#[test]
#[expect(clippy::too_many_lines, reason = "a table")]
fn a_bad_file_is_told_line_column_key_and_value() {
    // What stands in the good scene, what replaces it, and the error that follows.
    for (from, to, error) in [
        (
            "n = 5",
            "n = 0",
            "own.toml:4:5: n = 0: must be a whole number from 1 to 1000000",
        ),
        (
            "n = 5",
            "n = 5.5",
            "own.toml:4:5: n = 5.5: must be a whole number",
        ),
        (
            "n = 5",
            "n = \"five\"",
            "own.toml:4:5: n = \"five\": must be a whole number",
        ),
        ("n = 5", "n = [5]", "own.toml:4:5: n = [5]: must be"),
        ("n = 5", "n.x = 5", "own.toml:4:1: n: is a table"),
        (
            "n = 5",
            "n = 99999999999999999999999",
            "n = 99999999999999999999999: must be",
        ),
        ("n = 5\n", "", "own.toml: n: missing"),
        (
            "0.6",
            "nan",
            "own.toml:6:15: restitution = nan: must be a number from 0 to 1",
        ),
        (
            "0.6",
            "1.5",
            "own.toml:6:15: restitution = 1.5: must be a number from 0 to 1",
        ),
        (
            "0.6",
            "0",
            "own.toml:6:15: restitution = 0: must be above 0",
        ),
        (
            "1e-5",
            "+inf",
            "own.toml:7:16: contact_time = +inf: must be a number",
        ),
        ("1e-5", "-1e-5", "contact_time = -1e-5: must be a number"),
        ("1e-5", "1e-999", "contact_time = 1e-999: must be a number"),
        ("1e-5", "true", "contact_time = true: must be a number"),
        (
            "contact_time = 1e-5\n",
            "",
            "own.toml: contact_time: missing; scenes with soft",
        ),
        (
            "contact_time",
            "contact-time",
            "own.toml:7:1: contact-time: unknown key; did you mean contact_time?",
        ),
        (
            "contact_time",
            "  colour",
            "own.toml:7:3: colour: unknown key; there are title",
        ),
        ("n = 5", "[n]", "own.toml:4:2: n: is a table"),
        (
            "\"gear\"",
            "\"euler\"",
            "own.toml:1:10: method = \"euler\": must be \"gear\" or \"verlet\" or \"exact\" or \"ed\"",
        ),
        (
            "\"gear\"",
            "\"ed\"",
            "own.toml:7:16: contact_time = 1e-5: this scene does not have",
        ),
        (
            "method = \"gear\"\n",
            "",
            "own.toml: method: missing; must be \"gear\"",
        ),
        ("\"resting\"", "\"separated\"", "own.toml: s0: missing"),
        (
            "gravity = 9.81\n",
            "",
            "own.toml:3:9: floor = \"vibrating\": needs gravity",
        ),
        ("9.81", "0", "own.toml:8:11: gravity = 0: must be a number"),
        (
            "\"vibrating\"",
            "\"fixed\"",
            "own.toml:10:13: frequency = 20: this scene does not have frequency",
        ),
        (
            "alpha = 2",
            "alpha = 2\namplitude = 1e-3",
            "own.toml:9:9: alpha = 2: sets the amplitude",
        ),
        (
            "alpha = 2\n",
            "",
            "own.toml: amplitude: missing; scenes with a vibrating floor must have it or alpha",
        ),
        ("frequency = 20\n", "", "own.toml: frequency: missing"),
        (
            "frequency = 20",
            "frequency = 20\nfrequency = 30",
            "own.toml:11:1: ",
        ),
        ("frequency = 20", "frequency = ", "own.toml:10:"),
        ("frequency = 20", "title = \"a", "own.toml:10:"),
        (
            "frequency = 20",
            "title = 5",
            "own.toml:10:9: title = 5: must be a text in quotes",
        ),
        ("frequency = 20", "title = \"\\u001b[31m\"", "title = "),
        (
            "frequency = 20",
            "frequency = 20\nbeside = \"fig1x\"",
            "own.toml:11:10: beside = \"fig1x\": must be",
        ),
        (
            "frequency = 20",
            "jitter = true\nfrequency = 20",
            "jitter = true: this scene does not have",
        ),
    ] {
        assert!(GOOD.contains(from), "{from}");
        let told = parse(&GOOD.replacen(from, to, 1)).expect_err(to);
        assert!(told.contains(error), "{to:?} was told: {told}");
        assert!(told.starts_with("own.toml:"), "{told}");
        assert_eq!(told.lines().count(), 1, "{told}");
    }
    let long = parse(&format!("{GOOD}title = \"{}\"", "x".repeat(71))).expect_err("too long");
    assert!(
        long.contains("title") && long.chars().count() < 200,
        "{long}"
    );
}

#[test]
fn what_is_no_text_or_too_long_is_refused() {
    let path = |name: &str| PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    fs::write(path("binary.toml"), b"n = 1\n\xff\xfe").expect("a folder of the tests");
    fs::write(path("long.toml"), "#".repeat((1 << 20) + 1)).expect("a folder of the tests");
    fs::create_dir_all(path("folder.toml")).expect("a folder of the tests");
    for (name, reason) in [
        ("binary.toml", "is not UTF-8 text (line 2)"),
        ("long.toml", "is larger than 1 MiB"),
        ("folder.toml", "is a directory"),
    ] {
        let path = path(name);
        let told = Preset::load(path.to_str().expect("UTF-8"))
            .expect_err(name)
            .to_string();
        assert!(told.contains(reason) && told.contains(name), "{told}");
        let output = beadlab(&["run", path.to_str().expect("UTF-8")]);
        assert_eq!(output.status.code(), Some(2));
        assert_eq!(
            String::from_utf8_lossy(&output.stderr),
            format!("beadlab: {told}\n")
        );
    }
}

#[test]
fn a_file_may_have_symbols_and_units() {
    let plain = parse(GOOD).expect("good").scene;
    for (from, to) in [
        ("contact_time = 1e-5", "t_c = \"10 µs\""),
        ("contact_time = 1e-5", "contact_time = \"10us\""),
        ("restitution = 0.6", "\"ε\" = 0.6"),
        ("restitution = 0.6", "eps = \".6\""),
        ("n = 5", "N = 5.0"),
        ("n = 5", "n = 0.5e1"),
        ("gravity = 9.81", "g = \"9.81 m/s^2\""),
        ("frequency = 20", "f = \"20 Hz\""),
        ("diameter = 1e-3", "d = \"1mm\""),
    ] {
        let text = GOOD.replacen(from, to, 1);
        assert_eq!(parse(&text).map(|preset| preset.scene), Ok(plain.clone()));
    }
    for (from, to, error) in [
        (
            "contact_time = 1e-5",
            "t_c = \"1mm\"",
            "own.toml:7:7: contact_time = \"1mm\": must be in s, ms, us, ns or ps, not in mm",
        ),
        (
            "restitution = 0.6",
            "eps = 1.6",
            "own.toml:6:7: restitution = 1.6: must be a number from 0 to 1",
        ),
        (
            "contact_time = 1e-5",
            "t_c = 4.6us # soft",
            "; write \"4.6us\", in quotes",
        ),
        ("restitution = 0.6", "ε = 0.6", "; write \"ε\", in quotes"),
        (
            "frequency = 20",
            "frequency = 20\nf = 20",
            "own.toml:11:1: f: frequency is given twice",
        ),
    ] {
        assert!(GOOD.contains(from));
        let got = parse(&GOOD.replacen(from, to, 1)).expect_err(to);
        assert!(got.contains(error), "{got}");
    }
}
