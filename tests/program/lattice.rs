//! A lattice on the command line.

use crate::program::{beadlab, printed};

#[test]
fn what_a_lattice_cannot_have_is_refused_in_one_line() {
    for (arguments, words) in [
        (
            &["fig4", "--method", "ed"][..],
            &["method = ed", "gear or verlet"][..],
        ),
        (
            &["fig4", "--method", "exact"],
            &["method = exact", "gear or verlet"],
        ),
        (&["fig4", "--set", "n=130"], &["n = 130", "rows"]),
        (&["fig4", "--set", "rows=0"], &["rows = 0", "from 1"]),
        (&["fig4", "--set", "columns=2"], &["columns = 2", "from 3"]),
        (
            &["fig4", "--set", "width=1e-4"],
            &["width = 1e-4", "columns"],
        ),
        (&["fig4", "--set", "gravity=9.81"], &["gravity = 9.81"]),
        (
            &["fig4", "--set", "tangential_damping=-1"],
            &["tangential_damping = -1"],
        ),
        (&["fig1a", "--set", "rows=3"], &["rows = 3", "lattice"]),
        (
            &["fig1a", "--set", "tangential_damping=0"],
            &["tangential_damping", "lattice"],
        ),
        (
            &["fig4", "--set", "rows=90000", "--set", "columns=900"],
            &["rows = 90000", "1000000"],
        ),
    ] {
        let output = beadlab(&[&["run"], arguments].concat());
        let told = String::from_utf8_lossy(&output.stderr);
        assert_eq!(output.status.code(), Some(2), "{arguments:?}: {told}");
        assert_eq!(told.lines().count(), 1, "{told}");
        assert!(words.iter().all(|word| told.contains(word)), "{told}");
    }
    let told = beadlab(&["accuracy", "fig4"]);
    assert_eq!(told.status.code(), Some(2));
    assert!(String::from_utf8_lossy(&told.stderr).contains("no exact run"));
}

#[test]
fn the_motion_as_csv_has_both_directions() {
    let csv = printed(&[
        "run",
        "fig4",
        "--set",
        "rows=2",
        "--set",
        "columns=3",
        "--format",
        "csv",
        "--every",
        "1e-4",
    ]);
    let header = csv.lines().next().expect("a header");
    assert_eq!(
        header,
        "time,floor,x1,x2,x3,x4,x5,x6,z1,z2,z3,z4,z5,z6,kinetic,relative,sigma"
    );
    let count = header.split(',').count();
    assert!(csv.lines().count() > 3);
    assert!(csv.lines().all(|line| line.split(',').count() == count));
}

#[test]
fn json_has_rows_columns_and_results() {
    let text = printed(&["run", "fig4", "--set", "rows=3", "--format", "json"]);
    let object: serde_json::Value = serde_json::from_str(&text).expect("an object");
    assert_eq!(
        (&object["n"], &object["rows"], &object["columns"]),
        (&39.into(), &3.into(), &13.into())
    );
    for field in [
        "eps_eff",
        "er_over_ef",
        "contact_duration",
        "sigma",
        "energy_drift",
    ] {
        assert!(object[field].is_number(), "{field}");
    }
}

#[test]
fn a_slow_lattice_that_touches_ends_when_it_is_over() {
    // Its rows touch for ever. To be stepped through the time in which it would move by
    // some part of a diameter, as looks at columns are apart, would be 10¹⁰ steps.
    let settings = ["rows=3", "s0=0", "v0=-1e-9"].map(|setting| ["--set", setting]);
    let text = printed(
        &[
            &["run", "fig4", "--format", "json"],
            settings.as_flattened(),
        ]
        .concat(),
    );
    let object: serde_json::Value = serde_json::from_str(&text).expect("an object");
    assert!(object["eps_eff"].is_number(), "{text}");
    let steps = object["steps"].as_f64().expect("steps");
    assert!((100.0..1e5).contains(&steps), "{text}");
}
