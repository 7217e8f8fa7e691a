//! Bad input: one line that names field, value and what is allowed, exit code 2, and
//! nothing else.

use crate::program::{beadlab, file, printed, refused};

#[test]
fn bad_settings_are_refused_by_name_and_value() {
    for (preset, setting, field, value) in [
        ("fig1a", "restitution=1.5", "restitution", "1.5"),
        ("fig1a", "restitution=0", "restitution", "0"),
        ("fig1a", "restitution=-0.1", "restitution", "-0.1"),
        ("fig1d", "restitution=1.01", "restitution", "1.01"),
        ("fig1d", "restitution=-1e-9", "restitution", "-1e-9"),
        ("fig1a", "contact_time=0", "contact_time", "0"),
        ("fig1a", "contact_time=-1e-5", "contact_time", "-1e-5"),
        ("fig1a", "contact_time=NaN", "contact_time", "NaN"),
        ("fig1a", "contact_time=inf", "contact_time", "inf"),
        ("fig1a", "contact_time=1e400", "contact_time", "1e400"),
        ("fig1a", "n=0", "n", "0"),
        ("fig1a", "n=-1", "n", "-1"),
        ("fig1a", "n=2.5", "n", "2.5"),
        ("fig1a", "n=ten", "n", "ten"),
        ("fig1a", "n=1000001", "n", "1000001"),
        ("fig1a", "v0=0.1", "v0", "0.1"),
        ("fig1a", "v0=0", "v0", "0"),
        ("fig1a", "v0=-1e-300", "v0", "-1e-300"),
        ("fig1a", "s0=-1e-6", "s0", "-1e-6"),
        ("fig1a", "diameter=0", "diameter", "0"),
        ("fig1a", "width=2e-3", "width", "2e-3"),
        ("fig1a", "jitter=perhaps", "jitter", "perhaps"),
        ("fig1a", "floor_contact=hard", "floor_contact", "hard"),
        ("fig1a", "steps_per_contact=1", "steps_per_contact", "1"),
        ("fig1a", "seed=9007199254740993", "seed", "9007199254740993"),
        ("fig1a", "restituton=0.5", "restituton", "restitution"),
        ("fig1a", "colour=red", "colour", "restitution"),
        (
            "fig1a",
            "t_c=4mm",
            "contact_time = 4mm",
            "in s, ms, us, ns or ps",
        ),
        ("fig1a", "ε=0.8s", "restitution = 0.8s", "without a unit"),
        ("fig1a", "N=1e7", "n = 1e7", "1 to 1000000"),
        ("fig5b", "s_0=1um", "s0 = 1um", "does not have s0"),
        ("fig1a", "restitution", "restitution", "NAME=VALUE"),
        ("fig1a", "", "--set", "NAME=VALUE"),
        // What the scene does not have.
        ("fig1a", "amplitude=1e-3", "amplitude", "1e-3"),
        ("fig1a", "alpha=2", "alpha", "2"),
        ("fig1a", "gravity=9.81", "gravity", "9.81"),
        ("fig1a", "rule=tc", "rule", "tc"),
        ("fig1d", "contact_time=1e-5", "contact_time", "1e-5"),
        ("fig1d", "steps_per_contact=50", "steps_per_contact", "50"),
        ("fig5b", "s0=1e-6", "s0", "1e-6"),
        ("fig5b", "v0=-0.2", "v0", "-0.2"),
        ("fig5b", "gravity=0", "gravity", "0"),
        ("fig5b", "frequency=0", "frequency", "0"),
        ("fig5b", "amplitude=-1", "amplitude", "-1"),
        ("fig5b", "duration=0", "duration", "0"),
    ] {
        let line = refused(&["run", preset, "--set", setting]);
        assert!(
            line.contains(field) && line.contains(value),
            "{setting}: {line}"
        );
        let line = refused(&[preset, "--set", setting]);
        assert!(
            line.contains(field) && line.contains(value),
            "explorer, {setting}: {line}"
        );
    }
}

#[test]
fn settings_that_contradict_each_other_are_refused() {
    let both = refused(&[
        "run",
        "fig5b",
        "--set",
        "alpha=2",
        "--set",
        "amplitude=1e-3",
    ]);
    assert!(
        both.contains("alpha = 2") && both.contains("amplitude"),
        "{both}"
    );
    let endless = &["run", "fig5b", "--set", "alpha=1e6", "--set", "gravity=1e6"];
    let endless = refused(&[endless, &["--set", "frequency=1e-3"][..]].concat());
    assert!(
        endless.contains("alpha = 1e6: gives the amplitude"),
        "{endless}"
    );
    let timeless = refused(&["run", "fig1d", "--method", "gear"]);
    assert!(timeless.contains("contact_time: missing"), "{timeless}");
    let dead = &[
        "run",
        "inelastic-ball",
        "--method",
        "gear",
        "--set",
        "contact_time=1e-5",
    ];
    assert!(refused(dead).contains("restitution = 0: must be above 0"));
    let hard = &[
        "run",
        "fig1a",
        "--method",
        "ed",
        "--set",
        "contact_time=1e-5",
    ];
    assert!(refused(hard).contains("contact_time = 1e-5: this scene does not have"));
    let untimed = refused(&["run", "fig1d", "--set", "rule=tc"]);
    assert!(untimed.contains("contact_time: missing"), "{untimed}");
}

#[test]
fn bad_arguments_are_refused_in_one_line() {
    for (arguments, words) in [
        (&["run"][..], &["PRESET"][..]),
        (&["run", "fig1a", "--colour"], &["--colour"]),
        (&["--colour"], &["--colour"]),
        (
            &["run", "fig1a", "--format", "xml"],
            &["--format", "xml", "json"],
        ),
        (
            &["run", "fig1a", "--method", "euler"],
            &["--method", "euler", "verlet"],
        ),
        (&["run", "fig1a", "fig1b"], &["fig1b"]),
        (&["rum", "fig1a"], &["'fig1a' cannot be used with"]),
        (&["run", "fig1a", "--every", "1e-6"], &["--every", "csv"]),
        (
            &["run", "fig1a", "--format", "json", "--every", "1e-6"],
            &["--every", "csv"],
        ),
        (
            &["run", "fig1a", "--format", "csv", "--every", "0"],
            &["--every", "'0'"],
        ),
        (
            &["run", "fig1a", "--format", "csv", "--every", "-1"],
            &["--every", "-1"],
        ),
        (
            &["run", "fig1a", "--format", "csv", "--every", "NaN"],
            &["--every", "NaN"],
        ),
        (
            &["run", "fig1a", "--format", "csv", "--every", "inf"],
            &["--every", "inf"],
        ),
        (
            &["run", "fig5b", "--format", "csv", "--every", "1e-12"],
            &["--every 1e-12", "rows"],
        ),
        (
            &["run", "no-such-preset"],
            &["no-such-preset", "no such preset"],
        ),
        (&["run", "fig1g"], &["fig1g", "did you mean fig1"]),
        (&["run", "missing.toml"], &["missing.toml", "no such file"]),
        (&["missing.toml"], &["missing.toml", "no such file"]),
        (&["run", "/"], &["/", "is a directory"]),
        (
            &["run", "two\nlines.toml"],
            &["two lines.toml", "no such file"],
        ),
        (&["run", "two\nlines"], &["two lines", "no such preset"]),
        (&["no-such-preset"], &["no-such-preset", "no such preset"]),
        (&["fig1a", "--speed", "0"], &["--speed", "'0'"]),
        (&["fig1a", "--speed", "1/0"], &["--speed", "1/0"]),
        (&["presets", "show", "no-such-preset"], &["no-such-preset"]),
        (&["presets", "show"], &["PRESET|FILE.toml"]),
        (&["presets", "check"], &["FILE"]),
        (
            &["presets", "check", "missing.toml"],
            &["missing.toml", "no such file"],
        ),
        (&["presets", "sing"], &["sing"]),
        (
            &["run", "fig1a", "--out", "/no/such/folder/x"],
            &["--out /no/such/folder/x"],
        ),
        (&["run", "fig1a", "--out", "/"], &["--out /"]),
    ] {
        let line = refused(arguments);
        for word in words {
            assert!(line.contains(word), "{arguments:?}: {line}");
        }
    }
}

#[test]
fn every_bad_file_gets_its_line() {
    let good = file("checked-good.toml", printed(&["presets", "show", "fig1b"]));
    let bad = file("checked-bad.toml", "n = 0\n");
    let output = beadlab(&["presets", "check", &good, &bad, "missing.toml"]);
    assert_eq!(output.status.code(), Some(2));
    assert!(output.stdout.is_empty());
    let stderr = String::from_utf8(output.stderr).expect("UTF-8");
    let lines: Vec<_> = stderr.lines().collect();
    assert_eq!(lines.len(), 2, "{stderr}");
    assert!(lines[0].starts_with(&format!("beadlab: {bad}")), "{stderr}");
    assert!(lines[1].starts_with("beadlab: missing.toml"), "{stderr}");
}
