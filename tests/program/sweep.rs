//! `beadlab sweep`: the file it leaves, whatever happens to it on the way.

use crate::program::{failed, file_text as text, json, no_file, refused, sweep};
use std::fs;
use std::path::Path;
use std::process::{Child, Command, Stdio};
use std::thread;
use std::time::Duration;

/// The rows, each a list of cells; the first is the names of the columns.
fn cells(path: &str) -> Vec<Vec<String>> {
    csv::ReaderBuilder::new()
        .comment(Some(b'#'))
        .has_headers(false)
        .from_path(path)
        .expect("a file")
        .records()
        .map(|row| {
            let row = row.expect("rows of equal length");
            row.iter().map(str::to_owned).collect()
        })
        .collect()
}

/// A child of this test that is still there when the test fails would outlive it.
struct Running(Child);

impl Drop for Running {
    fn drop(&mut self) {
        let _ = self.0.kill();
        let _ = self.0.wait();
    }
}

fn start(arguments: &[&str], out: &str) -> Running {
    Running(
        Command::new(env!("CARGO_BIN_EXE_beadlab"))
            .arg("sweep")
            .args(arguments)
            .args(["--out", out])
            .stdin(Stdio::null())
            .stderr(Stdio::piped())
            .spawn()
            .expect("the program starts"),
    )
}

fn wait_for_lines(path: &str, lines: usize) {
    // A minute: a machine that is this slow has other troubles.
    for _ in 0..12_000 {
        if fs::read_to_string(path).is_ok_and(|text| text.lines().count() >= lines) {
            return;
        }
        thread::sleep(Duration::from_millis(5));
    }
    panic!("{path} does not grow");
}

/// Forty rows of different lengths in time, together about half a second.
const GRID: [&str; 7] = [
    "fig1b",
    "--method",
    "verlet",
    "--over",
    "n=1,5,10,20",
    "--over",
    "contact_time=1e-4:1e-6:log:10",
];

/// Two hundred rows that take long enough to be interrupted.
const LONG: [&str; 7] = [
    "fig1b",
    "--over",
    "steps_per_contact=20000:60000:20",
    "--over",
    "n=20:11:10",
    "--jobs",
    "2",
];

#[test]
fn rows_are_those_of_single_runs_in_the_order_of_the_product() {
    let out = no_file("sweep-rows.csv");
    sweep(
        &[
            "fig1b",
            "--set",
            "s0=1e-5",
            "--over",
            "n=5,10",
            "--over",
            "restitution=0.8:0.9:2",
        ],
        &out,
    );
    let rows = cells(&out);
    assert_eq!(
        rows[0].join(","),
        "n,restitution,eps_eff,er_over_ef,contact_duration,h_cm_mean,h_cm_error,\
         er_over_e_mean,er_over_e_error,sigma,overlap_max,energy_drift,step_error,\
         sensitivity,er_over_ef_sensitivity,contact_duration_sensitivity,\
         er_over_e_mean_sensitivity,sigma_sensitivity,events,steps,sim_time,note"
    );
    let points: Vec<String> = rows[1..].iter().map(|row| row[..2].join(" ")).collect();
    assert_eq!(points, ["5 0.8", "5 0.9", "10 0.8", "10 0.9"]);
    for row in &rows[1..] {
        let (n, restitution) = (format!("n={}", row[0]), format!("restitution={}", row[1]));
        let run = json(&[
            "fig1b",
            "--set",
            "s0=1e-5",
            "--set",
            &n,
            "--set",
            &restitution,
        ]);
        let eps_eff: f64 = row[2].parse().expect("a number");
        let printed = run["eps_eff"].as_f64().expect("a number");
        // The same digits.
        assert!(eps_eff == printed, "{n} {restitution}");
        assert_eq!(row[19], run["steps"].to_string());
        // No gravity, no hard spheres, nothing to remark.
        assert!(
            [5, 6, 7, 8, 16, 18, 21].iter().all(|&k| row[k].is_empty()),
            "{row:?}"
        );
    }
    let text = text(&out);
    for line in [
        "# preset: fig1b",
        "# set: s0=1e-5",
        "# over: n=5,10 (2 values)",
        "# seed: 1",
    ] {
        assert!(text.lines().any(|found| found == line), "{line}");
    }
}

#[test]
fn the_bytes_depend_neither_on_the_jobs_nor_on_a_kill() {
    let [one, two, killed] = ["one", "two", "killed"].map(|k| no_file(&format!("sweep-{k}.csv")));
    sweep(&[&GRID[..], &["--jobs", "1"]].concat(), &one);
    sweep(&[&GRID[..], &["--jobs", "2"]].concat(), &two);
    let whole = text(&one);
    assert_eq!(whole, text(&two));
    assert_eq!(cells(&one).len(), 41);
    // Wherever a kill cuts the file, in the header, at a row or within one, the rest is
    // the same again.
    let header = whole.find("\nn,").expect("names of columns");
    for length in [
        0,
        9,
        header + 20,
        whole.len() / 2,
        whole.len() - 1,
        whole.len(),
    ] {
        fs::write(&killed, &whole[..length]).expect("a file");
        sweep(&[&GRID[..], &["--resume"]].concat(), &killed);
        assert_eq!(text(&killed), whole, "cut at {length}");
    }
}

#[test]
fn resume_after_a_real_kill_computes_only_what_is_missing() {
    let out = no_file("sweep-kill.csv");
    let mut running = start(&LONG, &out);
    wait_for_lines(&out, 13);
    running.0.kill().expect("it is still running");
    running.0.wait().expect("it ends");
    drop(running);
    let before = text(&out);
    let rows = before.lines().filter(|line| !line.starts_with('#')).count() - 1;
    assert!((1..200).contains(&rows), "{rows} rows");
    // A row that is there is not measured again: not even when it is false.
    let mut lines: Vec<&str> = before.lines().collect();
    let first = lines
        .iter()
        .position(|line| line.starts_with("steps_per"))
        .expect("names")
        + 1;
    let changed = lines[first].replacen(",0.", ",7.", 1);
    lines[first] = &changed;
    fs::write(&out, lines.join("\n") + "\n").expect("a file");
    let mut resumed = start(&[&LONG[..], &["--resume"]].concat(), &out);
    wait_for_lines(&out, lines.len() + 2);
    resumed.0.kill().expect("it is still running");
    drop(resumed);
    let after = text(&out);
    assert!(after.starts_with(&lines.join("\n")));
    let points: Vec<Vec<String>> = cells(&out)[1..]
        .iter()
        .map(|row| row[..2].to_vec())
        .collect();
    for (k, point) in points.iter().enumerate() {
        assert_eq!(point[1], (20 - k % 10).to_string(), "row {k}");
    }
}

#[cfg(unix)]
#[test]
fn ctrl_c_and_term_leave_a_file_to_go_on_with() {
    use std::io::Read;

    for (signal, code) in [("INT", 130), ("TERM", 143)] {
        let out = no_file(&format!("sweep-{signal}.csv"));
        let mut running = start(&LONG, &out);
        wait_for_lines(&out, 12);
        let killed = Command::new("kill")
            .args([&format!("-{signal}"), &running.0.id().to_string()])
            .status();
        assert!(killed.expect("kill runs").success());
        let status = running.0.wait().expect("it ends");
        assert_eq!(status.code(), Some(code));
        let mut said = String::new();
        let stderr = running.0.stderr.as_mut().expect("a pipe");
        stderr.read_to_string(&mut said).expect("text");
        let rows = cells(&out).len() - 1;
        let told = format!("beadlab: stopped: {rows} of 200 rows are in ");
        assert!(
            said.starts_with(&told) && said.contains("--resume"),
            "{said}"
        );
        assert_eq!(said.lines().count(), 1);
        assert!(text(&out).ends_with('\n'));
    }
}

#[test]
fn a_file_that_is_there_is_safe() {
    let quick = ["fig1b", "--over", "n=1,2"];
    let out = no_file("sweep-there.csv");
    let with = |more: &[&'static str]| -> Vec<String> {
        let all = [&["sweep"], &quick[..], &["--out"], &[out.as_str()], more].concat();
        all.into_iter().map(str::to_owned).collect()
    };
    let refused = |more: &[&'static str]| {
        let all = with(more);
        refused(&all.iter().map(String::as_str).collect::<Vec<_>>())
    };
    sweep(&quick, &out);
    let whole = text(&out);
    assert!(refused(&[]).contains("is there already; --resume goes on"));
    let other = refused(&["--resume", "--set", "restitution=0.8"]);
    assert!(other.contains("is of another sweep: line 4"), "{other}");
    assert_eq!(text(&out), whole);
    fs::write(&out, "my notes\n").expect("a file");
    assert!(refused(&["--resume"]).contains("is of another sweep"));
    assert_eq!(text(&out), "my notes\n");
    sweep(&[&quick[..], &["--overwrite"]].concat(), &out);
    assert_eq!(text(&out), whole);
}

#[test]
fn bad_ranges_are_told_in_one_line_before_anything_runs() {
    let out = no_file("sweep-bad.csv");
    for (arguments, reason) in [
        (vec!["--over", "restitution=0.5:0.9:1"], "COUNT = 1"),
        (vec!["--over", "restitution=0.5:0.5:9"], "the same"),
        (vec!["--over", "s0=0:1:log:9"], "log needs"),
        (vec!["--over", "restituton=0.5:0.9:3"], "did you mean"),
        (vec!["--over", "n=1,2", "--over", "n=3,4"], "n: given twice"),
        (vec!["--over", "n=1,2", "--set", "n=3"], "n: given twice"),
        (vec!["--over", "restitution=0.9,1.1"], "restitution = 1.1"),
        (
            vec!["--over", "restitution=0:1:3"],
            "row 1, restitution = 0",
        ),
        (
            vec!["--over", "alpha=1:3:3"],
            "alpha = 1: this scene does not have",
        ),
        (vec!["--over", "n=1,2", "--jobs", "0"], "--jobs"),
        (vec![], "--over"),
    ] {
        let all = [&["sweep", "fig1b", "--out", &out], &arguments[..]].concat();
        let line = refused(&all);
        assert!(line.contains(reason), "{arguments:?}: {line}");
        assert!(!Path::new(&out).exists(), "{arguments:?} left a file");
    }
}

#[test]
fn a_point_that_fails_leaves_its_reason_and_the_sweep_goes_on() {
    let out = no_file("sweep-failing.csv");
    // Verlet takes no two steps a contact time in a column whose contacts are closed.
    let arguments = [
        "sweep",
        "fig1a",
        "--method",
        "verlet",
        "--over",
        "steps_per_contact=100,2,50",
        "--out",
        &out,
    ];
    let line = failed(&arguments, 1);
    assert!(line.starts_with("1 row has no results"), "{line}");
    let rows = cells(&out);
    assert_eq!(rows.len(), 4);
    for (k, row) in rows[1..].iter().enumerate() {
        let (results, note) = (&row[1..20], &row[20]);
        if k == 1 {
            assert!(results.iter().all(String::is_empty), "{row:?}");
            assert!(note.contains("became unstable"), "{note}");
        } else {
            assert!(
                results[0].parse::<f64>().is_ok() && note.is_empty(),
                "{row:?}"
            );
        }
    }
    // A row that failed is done, and the file still says that it failed.
    let again = failed(&[&arguments[..], &["--resume"]].concat(), 1);
    assert!(again.starts_with("1 row has no results"), "{again}");
}

#[test]
fn a_folder_that_is_not_there_and_a_full_disk_are_told_in_one_line() {
    let arguments = ["sweep", "fig1b", "--over", "n=1,2", "--out"];
    let line = refused(&[&arguments[..], &["/no/such/folder/x.csv"]].concat());
    assert!(
        line.contains("cannot be written: there is no such folder"),
        "{line}"
    );
    if Path::new("/dev/full").exists() {
        let line = failed(&[&arguments[..], &["/dev/full"]].concat(), 1);
        assert!(line.contains("/dev/full: cannot be written"), "{line}");
    }
}
