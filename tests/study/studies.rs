//! `beadlab accuracy` and `beadlab stability`, and the studies behind them.

use crate::program::{beadlab, file, printed, refused};
use beadlab::scene::{MethodName, Preset, Scene};
use beadlab::study::accuracy::{Effort, Report, accuracy};
use beadlab::study::stability::{CaseVerdict, cases, judge};
use beadlab::study::table::{Cell, Table};
use std::path::{Path, PathBuf};
use std::time::Duration;

fn scene(preset: &str) -> Scene {
    Preset::load(preset).expect("an embedded preset").scene
}

fn report(preset: &str, quick: bool) -> Report {
    let effort = Effort {
        quick,
        time: Duration::from_secs(3),
    };
    accuracy(&scene(preset), effort, &mut |_, _| {}).expect("a report")
}

fn number(table: &Table, row: usize, column: &str) -> f64 {
    match table.get(row, column) {
        Some(Cell::Number(x)) => *x,
        other => panic!("{column} of row {row} is {other:?}"),
    }
}

fn rows<'a>(table: &'a Table, method: &'a str) -> impl Iterator<Item = usize> + 'a {
    let is = move |&row: &usize| table.get(row, "method") == Some(&Cell::from(method));
    (0..table.rows().len()).filter(is)
}

#[test]
fn fixed_steps_are_of_first_order_and_the_exact_method_of_none() {
    let report = report("fig1b", false);
    let [errors, orders] = report.tables.as_slice() else {
        panic!("two tables");
    };
    for row in 0..orders.rows().len() {
        // The dashpot's force jumps at the first touch, which falls anywhere in a step:
        // first order, with scatter of a factor of some at each of the 8 rungs.
        for of in ["eps_eff_order", "er_over_ef_order", "trajectory_order"] {
            let order = number(orders, row, of);
            assert!((0.7..1.6).contains(&order), "{of} of row {row}: {order}");
        }
    }
    assert_eq!(orders.rows().len(), 2);
    for method in ["gear", "verlet"] {
        let finest = rows(errors, method).last().expect("a ladder");
        // Two thousand times finer than a contact.
        assert!(number(errors, finest, "eps_eff_error") < 1e-4, "{method}");
    }
    let exact = rows(errors, "exact").next().expect("the reference");
    assert!(number(errors, exact, "eps_eff_error") < 1e-8);
    // Soft contacts' 0.539255 against hard spheres' 0.3415.
    let hard = rows(errors, "ed").next().expect("hard spheres");
    let distance = number(errors, hard, "eps_eff_error");
    assert!(
        (distance - (1.0 - 0.3415 / 0.539_255)).abs() < 2e-3,
        "{distance}"
    );
    assert_eq!(errors.get(hard, "error_kind"), Some(&Cell::from("model")));
}

#[test]
fn a_plate_parts_right_runs_but_not_their_means() {
    let report = report("fig7-md", true);
    let [growth, means] = report.tables.as_slice() else {
        panic!("two tables");
    };
    // One bit apart, 1e-16 of a height: never below rounding, and it grows.
    let first = number(growth, 0, "first_distance");
    assert!((1e-18..1e-10).contains(&first), "{first}");
    // By tenfold in a second at least, and no faster than by tenfold in a contact time.
    let rate = number(growth, 0, "growth_rate");
    assert!((2.0..2e4).contains(&rate), "{rate}");
    assert!(number(growth, 0, "parted") > 0.0);
    // Two right runs: 5 standard errors apart once in a million.
    assert!(number(means, 1, "height_difference") < 5.0);
    assert!(number(means, 1, "relative_share_difference") < 5.0);
}

/// All methods, within an allowance that some need more than. That it ends at all is
/// part of the test. How often the exact method was confirmed.
fn judged(quick: bool, slices: u64) -> usize {
    let mut confirmed = 0;
    for case in cases(quick) {
        let judgements = judge(&case, slices, &mut |_| {});
        let methods: Vec<_> = judgements.iter().map(|j| j.method).collect();
        assert_eq!(methods, MethodName::ALL);
        for judgement in &judgements {
            let of = format!("{}, {}", case.name, judgement.method.as_str());
            assert!(judgement.verdict.short().chars().count() <= 12, "{of}");
            let text = judgement.verdict.long();
            assert!(
                !text.contains("NaN") && !text.contains("inf"),
                "{of}: {text}"
            );
            // The exact method is right wherever anything can tell: to what the last bit
            // changes, or to what the adaptive method's own tolerance leaves of it.
            if judgement.method == MethodName::Exact {
                let is_off = matches!(
                    judgement.verdict,
                    CaseVerdict::Off(_) | CaseVerdict::Breaks(..)
                );
                assert!(!is_off, "{of}: {text}");
                // Two methods that share nothing: their tolerances and what is amplified.
                if let CaseVerdict::Confirmed { error, bits } = judgement.verdict {
                    let last_bits = 10.0 * bits.unwrap_or(0.0);
                    assert!(error < last_bits.max(1e-8), "{of}: {text}");
                    confirmed += 1;
                }
            }
        }
    }
    confirmed
}

#[test]
fn no_case_hangs() {
    // With so little time, the short ones.
    assert!(judged(true, 2) >= 5);
}

#[test]
#[ignore = "all cases with all the time they need: minutes"]
fn the_exact_method_is_right_in_all_cases() {
    assert!(judged(false, 1000) >= 30);
}

#[test]
fn every_case_is_a_scene() {
    for case in cases(false) {
        assert!(case.name.chars().count() <= 22, "{}", case.name);
        assert!(case.scene.is_ok(), "{}: {:?}", case.name, case.scene);
    }
}

fn folder(name: &str) -> String {
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    // Of an earlier run; there may be none.
    let _ = std::fs::remove_dir_all(&path);
    path.into_os_string().into_string().expect("a UTF-8 path")
}

#[test]
fn a_folder_gets_the_whole_report() {
    let out = folder("accuracy-report");
    let text = printed(&["accuracy", "--quick", "--budget", "0.5", "--out", &out]);
    assert!(
        text.lines().all(|line| line.chars().count() <= 80),
        "{text}"
    );
    let mut names: Vec<_> = std::fs::read_dir(&out)
        .expect("the folder was made")
        .map(|entry| entry.expect("an entry").file_name())
        .collect();
    names.sort();
    let expected = [
        "accuracy.csv",
        "accuracy.svg",
        "orders.csv",
        "report.json",
        "report.txt",
    ];
    assert_eq!(names, expected);
    let csv = std::fs::read_to_string(Path::new(&out).join("accuracy.csv")).expect("the table");
    for line in ["# scene = fig1b", "# seed = 1", "# s0 = 1e-6 m"] {
        assert!(csv.lines().any(|l| l == line), "{line} in {csv}");
    }
}

#[test]
fn formats_are_read_by_machines() {
    let json = printed(&["accuracy", "--quick", "--budget", "0.5", "--format", "json"]);
    let json: serde_json::Value = serde_json::from_str(&json).expect("JSON");
    assert_eq!(json[0]["name"], "accuracy");
    assert_eq!(json[0]["rows"][0]["method"], "gear");
    let steps = printed(&["stability", "--quick", "--steps", "--format", "csv"]);
    let mut reader = csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .from_reader(steps.as_bytes());
    let header = reader.headers().expect("a header").clone();
    let at = |name| header.iter().position(|h| h == name).expect("a column");
    let (found, theory) = (at("gear_found"), at("gear_theory"));
    let mut compared = 0;
    for row in reader.records() {
        let row = row.expect("a record");
        let number = |k: usize| row[k].parse::<f64>();
        if let (Ok(found), Ok(theory)) = (number(found), number(theory))
            && &row[at("restitution")] != "1"
        {
            // Bisection to a part in a thousand of a growth that some steps show.
            assert!((found / theory - 1.0).abs() < 0.01, "{row:?}");
            compared += 1;
        }
    }
    assert_eq!(compared, 15);
}

#[test]
fn bad_input_is_one_line() {
    for (arguments, line) in [
        (
            &["accuracy", "nosuch"][..],
            "nosuch: no such preset or file",
        ),
        (
            &["accuracy", "fig4"],
            "a lattice has no exact run to compare",
        ),
        (
            &["accuracy", "--set", "n=0"],
            "n = 0: must be a whole number",
        ),
        (
            &["accuracy", "--budget", "0"],
            "invalid value '0' for '--budget",
        ),
        (
            &["stability", "--budget", "nan"],
            "invalid value 'nan' for '--budget",
        ),
        (
            &["accuracy", "--out", "/no/such/folder"],
            "--out /no/such/folder: cannot be made",
        ),
        (
            &["stability", "--out", "/dev/null"],
            "--out /dev/null: is not a folder",
        ),
    ] {
        let refusal = refused(arguments);
        assert!(refusal.starts_with(line), "{arguments:?}: {refusal}");
    }
    let file = file("not-a-folder", "");
    assert!(refused(&["accuracy", "--out", &file]).ends_with("is not a folder"));
}

#[test]
fn a_reference_without_time_says_so() {
    let output = beadlab(&["accuracy", "fig5b", "--budget", "1e-4"]);
    assert_eq!(output.status.code(), Some(1));
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert!(stderr.contains("the reference run takes"), "{stderr}");
}

#[test]
fn run_says_when_the_grid_is_too_coarse() {
    // Loose enough never to be closed as a whole, so that it comes to its end.
    let arguments = [
        "run",
        "fig1c",
        "--set",
        "restitution=0.6",
        "--set",
        "steps_per_contact=13",
    ];
    let stderr = String::from_utf8(beadlab(&arguments).stderr).expect("UTF-8");
    let told = |line: &str| line.starts_with("beadlab: note: gear becomes unstable");
    assert_eq!(
        stderr.lines().filter(|line| told(line)).count(),
        1,
        "{stderr}"
    );
}

#[test]
fn a_hard_preset_is_compared_by_the_soft_one_beside_it() {
    let run = beadlab(&["accuracy", "fig1d", "--quick", "--budget", "0.5"]);
    assert!(run.status.success());
    let note = String::from_utf8_lossy(&run.stderr);
    assert!(note.contains("fig1a"), "{note}");
}
