//! Runs that have no result, or a poor one, and say so.

use std::process::Output;

use crate::program::{beadlab, failed};

/// Two steps in a contact are beyond the stability of Gear's method.
pub const UNSTABLE: [&str; 6] = [
    "run",
    "fig5b",
    "--set",
    "steps_per_contact=2",
    "--set",
    "duration=0.1",
];

#[test]
fn an_engine_that_cannot_go_on_is_no_bad_input() {
    let line = failed(&UNSTABLE, 1);
    assert!(line.contains("unstable"), "{line}");
}

#[test]
fn an_unfinished_floor_collision_has_no_eps_eff() {
    let output = beadlab(&["run", "fig1b", "--set", "duration=1e-5", "--format", "json"]);
    assert_eq!(output.status.code(), Some(0));
    let note = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(
        note.contains("not over") && note.lines().count() == 1,
        "{note}"
    );
    let object: serde_json::Value = serde_json::from_slice(&output.stdout).expect("JSON");
    assert!(
        object.get("eps_eff").is_none() && object.get("sim_time").is_some(),
        "{object}"
    );
}

/// A run of `preset` with too few Verlet steps in a contact time.
fn coarse(preset: &str, steps: &str) -> Output {
    let steps = format!("steps_per_contact={steps}");
    beadlab(&["run", preset, "--method", "verlet", "--set", &steps])
}

#[test]
fn a_run_with_a_poor_energy_ledger_is_remarked_upon() {
    let output = coarse("fig1b", "3");
    assert_eq!(output.status.code(), Some(0));
    let note = String::from_utf8(output.stderr).expect("UTF-8");
    assert!(
        note.contains("energy ledger is off by") && note.lines().count() == 1,
        "{note}"
    );
}

#[test]
fn a_run_that_becomes_unstable_fails_and_says_when() {
    for preset in ["fig1a", "fig1b", "fig1c"] {
        let output = coarse(preset, "2");
        assert_eq!(output.status.code(), Some(1), "{preset}");
        assert!(output.stdout.is_empty(), "{preset}");
        let error = String::from_utf8(output.stderr).expect("UTF-8");
        assert!(
            error.contains("became unstable at t = ") && error.lines().count() == 1,
            "{error}"
        );
    }
}
