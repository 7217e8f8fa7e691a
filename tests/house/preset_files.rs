//! Presets of one's own: what a file may say, and what it is told when it is wrong.

use std::fs;
use std::path::PathBuf;

use beadlab::scene::Preset;

use crate::program::beadlab;

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
