//! The command line as its users meet it: what it prints.

use std::fs;
use std::path::PathBuf;
use std::process::{Command, Stdio};

use crate::program::{failed, json, printed, table};
use crate::unsound_runs::UNSTABLE;

/// All fields that there are, in their order.
const FIELDS: [&str; 39] = [
    "preset",
    "method",
    "law",
    "beta",
    "gamma",
    "stiffness",
    "damping",
    "n",
    "restitution",
    "floor_restitution",
    "restitution_min",
    "restitution_max",
    "contact_time",
    "v0",
    "s0",
    "sigma0",
    "eps_eff",
    "er_over_ef",
    "contact_duration",
    "h_cm_mean",
    "h_cm_error",
    "er_over_e_mean",
    "er_over_e_error",
    "sigma",
    "overlap_max",
    "energy_drift",
    "step_error",
    "sensitivity",
    "er_over_ef_sensitivity",
    "contact_duration_sensitivity",
    "er_over_e_mean_sensitivity",
    "sigma_sensitivity",
    "events",
    "steps",
    "sim_time",
    "verdict",
    "verdict_why",
    "wall_time",
    "speed",
];

/// What only power laws have.
const POWER: [&str; 4] = ["beta", "gamma", "stiffness", "damping"];

#[test]
fn json_has_what_the_scene_has_and_nothing_else() {
    let ten_beads = ["duration=0.2", "n=3"];
    for (preset, settings, absent) in [
        ("fig1b", &[][..], &["h_cm_mean", "events"][..]),
        (
            "fig1e",
            &[],
            &[
                "law",
                "contact_time",
                "sigma0",
                "h_cm_mean",
                "sigma",
                "steps",
                "verdict",
            ],
        ),
        (
            "fig5b",
            &ten_beads,
            &[
                "v0",
                "s0",
                "sigma0",
                "eps_eff",
                "er_over_ef",
                "contact_duration",
                "events",
            ],
        ),
        (
            "tc-rule",
            &ten_beads,
            &[
                "law",
                "v0",
                "s0",
                "sigma0",
                "eps_eff",
                "er_over_ef",
                "contact_duration",
                "steps",
            ],
        ),
    ] {
        let mut arguments = vec![preset];
        arguments.extend(settings.iter().flat_map(|setting| ["--set", setting]));
        let object = json(&arguments);
        let object = object.as_object().expect("an object");
        for field in FIELDS {
            // The mean of a height has a standard error, a collision a sensitivity.
            let lacks = match field {
                "h_cm_error" | "er_over_e_mean" | "er_over_e_error" => {
                    absent.contains(&"h_cm_mean")
                }
                "sensitivity" | "er_over_ef_sensitivity" | "contact_duration_sensitivity" => {
                    absent.contains(&"eps_eff")
                }
                "sigma_sensitivity" => absent.contains(&"eps_eff") || absent.contains(&"sigma"),
                "step_error" => absent.contains(&"eps_eff") || absent.contains(&"steps"),
                "overlap_max" => absent.contains(&"steps"),
                // Of a mean only when asked for; of unequal beads.
                "er_over_e_mean_sensitivity" | "restitution_min" | "restitution_max" => true,
                _ => absent.contains(&field) || POWER.contains(&field),
            };
            assert_eq!(object.contains_key(field), !lacks, "{preset}: {field}");
        }
        assert!(
            object.keys().all(|key| FIELDS.contains(&key.as_str())),
            "{object:?}"
        );
        assert!(
            object
                .values()
                .all(|value| value.is_string() || value.is_number()),
            "{object:?}"
        );
    }
}

#[test]
fn json_says_what_was_run() {
    let soft = json(&[
        "fig1b", "--method", "verlet", "--set", "n=7", "--set", "s0=2e-6",
    ]);
    assert_eq!(soft["preset"], "fig1b");
    assert_eq!(soft["method"], "verlet");
    assert_eq!(soft["law"], "hooke");
    assert_eq!(soft["n"], 7);
    assert_eq!(soft["s0"], 2e-6);
    assert_eq!(soft["contact_time"], 0.7e-5);
    let sigma0 = soft["sigma0"].as_f64().expect("a number");
    assert!((sigma0 - 2e-6 / (0.2 * 0.7e-5)).abs() < 1e-12, "{sigma0}");
    let hard = json(&["fig1b", "--method", "ed"]);
    assert_eq!(hard["method"], "ed");
    // The floor's own restitution, and with it the paper's 0.341.
    let floor = hard["floor_restitution"].as_f64().expect("a number");
    assert!((floor - 0.928_226).abs() < 1e-6, "{floor}");
    let eps_eff = hard["eps_eff"].as_f64().expect("a number");
    assert!((eps_eff - 0.341_547_47).abs() < 1e-6, "{eps_eff}");
}

#[test]
fn the_mean_height_is_that_of_the_centre_of_mass() {
    // Below α = 1 a hard column rides on the plate: its mean height is that of a
    // stack, N d/2, since whole periods of the plate average to nothing.
    let riding = ["fig6a", "--set", "alpha=0.5", "--set", "duration=10"];
    let mean = json(&riding)["h_cm_mean"].as_f64().expect("a number");
    assert!((mean - 10.0 * 3e-3 / 2.0).abs() < 1e-9, "{mean}");
    // Two beads of sizes that the seed decides: heavier beads count more.
    let sizes = [&riding[..], &["--set", "width=2e-3", "--set", "n=2"]].concat();
    let mixed = json(&sizes)["h_cm_mean"].as_f64().expect("a number");
    let facts = beadlab::scene::Preset::load("fig6a")
        .expect("embedded")
        .scene
        .facts()
        .clone();
    let d = beadlab::scene::diameters(&beadlab::scene::Facts {
        n: 2,
        width: 2e-3,
        ..facts
    });
    let (m, h) = (
        [d[0].powi(3), d[1].powi(3)],
        [d[0] / 2.0, d[0] + d[1] / 2.0],
    );
    let expected = (m[0] * h[0] + m[1] * h[1]) / (m[0] + m[1]);
    assert!((mixed - expected).abs() < 1e-9, "{mixed} {expected}");
}

#[test]
fn the_same_scene_and_seed_give_the_same_bytes() {
    let random = ["mixed-sizes", "--set", "n=4", "--set", "duration=0.1"];
    let jittered = ["fig1b", "--set", "jitter=true", "--set", "width=5e-4"];
    let hard = [&jittered[..], &["--method", "ed"]].concat();
    let text = &[][..];
    let series = &["--format", "csv", "--every", "1e-5"][..];
    for scene in [&random[..], &jittered, &hard] {
        for format in [text, &["--format", "csv"], series] {
            let arguments = [&["run"], scene, format].concat();
            assert_eq!(printed(&arguments), printed(&arguments), "{arguments:?}");
            let reseeded = [&arguments[..], &["--set", "seed=2"]].concat();
            assert_ne!(printed(&arguments), printed(&reseeded), "{arguments:?}");
        }
    }
}

#[test]
fn a_symbol_and_a_unit_say_the_same_as_the_name_in_si() {
    for (preset, short, long) in [
        ("fig1b", "t_c=4.6us", "contact_time=4.6e-6"),
        ("fig1b", "ε=.8", "restitution=0.8"),
        ("fig1b", "N=1.2e1", "n=12"),
        ("fig1b", "s_0=10 µm", "s0=1e-5"),
        ("fig1d", "v_0=-.5m/s", "v0=-0.5"),
    ] {
        let run = |setting| printed(&["run", preset, "--set", setting]);
        let (short, long) = (run(short), run(long));
        assert_eq!(short, long);
        assert_ne!(short, printed(&["run", preset]));
    }
}

#[test]
fn a_power_law_is_printed_with_its_constants() {
    let object = json(&["fig3-hertz", "--set", "n=2"]);
    for (field, value) in [
        ("beta", 0.5),
        ("gamma", 0.0),
        ("stiffness", 2e12),
        ("damping", 2e3),
    ] {
        assert_eq!(object[field].as_f64(), Some(value), "{field}");
    }
    assert_eq!(object["law"], "hertz");
    // Those of a pair at the scene's own speed.
    let contact_time = object["contact_time"].as_f64().expect("a number");
    assert!((contact_time - 7.04e-5).abs() < 1e-7, "{contact_time}");
    let restitution = object["restitution"].as_f64().expect("a number");
    assert!((restitution - 0.853).abs() < 1e-3, "{restitution}");
}

#[test]
fn csv_without_an_interval_is_one_row_of_the_same_fields() {
    let (header, rows) = table(&printed(&["run", "fig1e", "--format", "csv"]));
    assert_eq!(
        header,
        FIELDS[..37],
        "wall_time and speed measure the machine"
    );
    assert_eq!(rows.len(), 1);
    let object = printed(&["run", "fig1e", "--format", "json"]);
    for (name, cell) in header.iter().zip(&rows[0]) {
        let line = object
            .lines()
            .find(|line| line.contains(&format!("\"{name}\": ")));
        match line.and_then(|line| line.split_once(": ")) {
            None => assert_eq!(cell, "", "{name}"),
            Some((_, value)) => assert_eq!(cell, value.trim_matches([',', '"']), "{name}"),
        }
    }
}

#[test]
fn text_leaves_out_what_the_scene_lacks_and_what_the_clock_says() {
    let text = printed(&["run", "fig1e"]);
    for name in ["preset", "eps_eff", "floor_restitution", "events"] {
        assert_eq!(
            text.lines().filter(|line| line.starts_with(name)).count(),
            1,
            "{name}: {text}"
        );
    }
    for name in [
        "contact_time",
        "h_cm_mean",
        "steps",
        "wall_time",
        "speed",
        "took",
    ] {
        assert!(
            !text.lines().any(|line| line.starts_with(name)),
            "{name}: {text}"
        );
    }
    assert!(
        text.lines().all(|line| line.chars().count() < 100),
        "{text}"
    );
}

#[test]
fn a_file_appears_complete_or_not_at_all() {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("out");
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir(&folder).expect("the folder of the tests can be written");
    let path = folder.join("fig1e.txt");
    let out = path.to_str().expect("a UTF-8 path");
    assert_eq!(printed(&["run", "fig1e", "--out", out]), "");
    assert_eq!(
        fs::read_to_string(&path).expect("a file"),
        printed(&["run", "fig1e"])
    );
    failed(&[&UNSTABLE[..], &["--out", out]].concat(), 1);
    assert_eq!(
        fs::read_to_string(&path).expect("a file"),
        printed(&["run", "fig1e"])
    );
    let names: Vec<_> = fs::read_dir(&folder).expect("a folder").collect();
    assert_eq!(names.len(), 1, "nothing else is left: {names:?}");
}

#[test]
fn a_reader_that_has_seen_enough_is_no_failure() {
    let long = ["run", "fig7-ed", "--format", "csv", "--every", "1e-4"];
    for arguments in [&long[..], &["presets"], &["--help"]] {
        let mut child = Command::new(env!("CARGO_BIN_EXE_beadlab"))
            .args(arguments)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts");
        drop(child.stdout.take());
        let output = child.wait_with_output().expect("it ends");
        assert_eq!(output.status.code(), Some(0), "{arguments:?}");
        assert_eq!(String::from_utf8_lossy(&output.stderr), "", "{arguments:?}");
    }
}

#[test]
fn help_tells_every_parameter() {
    // Wherever its lines are broken.
    let help = printed(&["run", "--help"])
        .split_whitespace()
        .collect::<Vec<_>>()
        .join(" ");
    for parameter in beadlab::scene::parameters::table() {
        let entry = format!("{} {}", parameter.name, parameter.help);
        assert!(help.contains(&entry), "{entry}");
        assert!(
            parameter.help.len() <= 58,
            "fits 80 columns: {}",
            parameter.help
        );
    }
    assert!(printed(&["--help"]).contains("Examples:"));
    assert!(printed(&["--version"]).starts_with("beadlab "));
}
