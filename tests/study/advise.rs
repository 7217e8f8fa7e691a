//! `beadlab advise`: its answers against scaling laws and against single runs.

use crate::program::{beadlab, json, printed, refused};
use serde_json::Value;
use std::time::{Duration, Instant};

/// The tables of an answer.
fn advise(arguments: &[&str]) -> Vec<Value> {
    let all = [&["advise"], arguments, &["--format", "json"]].concat();
    serde_json::from_str(&printed(&all)).expect("a list of tables")
}

fn table<'a>(tables: &'a [Value], name: &str) -> &'a Value {
    let found = tables.iter().find(|table| table["name"] == name);
    found.unwrap_or_else(|| panic!("no table {name}"))
}

fn rows<'a>(tables: &'a [Value], name: &str) -> &'a [Value] {
    let rows = table(tables, name)["rows"].as_array().expect("rows");
    assert!(!rows.is_empty(), "{name} is empty");
    rows
}

/// A row of the answer: limit, longest, beyond, undecided or scene.
fn row<'a>(tables: &'a [Value], what: &str) -> Option<&'a Value> {
    rows(tables, "advise")
        .iter()
        .find(|row| row["what"] == what)
}

fn number(row: &Value, column: &str) -> f64 {
    row[column]
        .as_f64()
        .unwrap_or_else(|| panic!("no {column} in {row}"))
}

fn contact_time(tables: &[Value], what: &str) -> f64 {
    let row = row(tables, what).unwrap_or_else(|| panic!("no row {what}"));
    number(row, "contact_time")
}

fn notes(tables: &[Value]) -> String {
    table(tables, "advise")["notes"].to_string()
}

fn title(tables: &[Value]) -> &str {
    table(tables, "advise")["title"].as_str().expect("a title")
}

/// ε_eff of Fig. 1(b)'s column with another contact time, by a run of its own.
fn eps_eff(contact_time: f64, more: &[&str]) -> f64 {
    let t_c = format!("contact_time={contact_time:e}");
    let method = ["fig1b", "--method", "exact", "--set", &t_c];
    let results = json(&[&method[..], more].concat());
    results["eps_eff"].as_f64().expect("a floor collision")
}

#[test]
fn the_answer_scales_with_the_time_of_flight() {
    // Without gravity ε_eff depends on σ_0 = s_0/(|v_0| t_c) alone: the answer is
    // s_0/|v_0| over one σ. It is known to the bracket, 1 %, and rounded to 4 digits.
    let sigma = |tables: &[Value]| {
        let longest = row(tables, "longest").expect("an answer");
        (number(longest, "contact_time"), number(longest, "sigma0"))
    };
    let (time, common) = sigma(&advise(&["fig1b"]));
    for (setting, factor) in [("s0=1e-5", 10.0), ("s0=1e-7", 0.1), ("v0=-2", 0.1)] {
        let (other, sigma0) = sigma(&advise(&["fig1b", "--set", setting]));
        assert!(
            (other / time / factor - 1.0).abs() < 0.012,
            "{setting}: {other}"
        );
        assert!((sigma0 / common - 1.0).abs() < 0.012, "{setting}: {sigma0}");
    }
    // The paper's curve of Fig. 2(a): between detachment and hard spheres lies σ of order 1.
    assert!(common > 0.5 && common < 5.0, "{common}");
}

#[test]
fn runs_of_their_own_confirm_the_bracket() {
    let hard = json(&["fig1e"])["eps_eff"].as_f64().expect("a collision");
    for (tolerance, quick) in [(0.01, false), (0.1, false), (1e-4, true)] {
        let part = tolerance.to_string();
        let mut arguments = vec!["fig1b", "--tolerance", &part];
        arguments.extend(quick.then_some("--quick"));
        let tables = advise(&arguments);
        let (within, beyond) = (
            contact_time(&tables, "longest"),
            contact_time(&tables, "beyond"),
        );
        let bracket = if quick { 1.05 } else { 1.01 };
        assert!(
            within < beyond && beyond / within < bracket,
            "{within} {beyond}"
        );
        let off = |t_c: f64| (eps_eff(t_c, &[]) / hard - 1.0).abs();
        assert!(off(within) <= tolerance, "{within}: {}", off(within));
        assert!(off(beyond) > tolerance, "{beyond}: {}", off(beyond));
        // What is said of them is what runs find; both have all digits.
        let longest = row(&tables, "longest").expect("an answer");
        assert!((number(longest, "eps_eff_off") - off(within)).abs() < 1e-9);
        let limit = row(&tables, "limit").expect("a limit");
        assert!((number(limit, "eps_eff") - hard).abs() < 1e-12);
    }
}

#[test]
fn against_a_contact_time_the_limit_is_that_of_the_contact_time() {
    let tables = advise(&["fig1b", "--against", "material", "--tolerance", "0.05"]);
    let material = eps_eff(7e-6, &[]);
    let limit = row(&tables, "limit").expect("a limit");
    assert!((number(limit, "contact_time") - 7e-6).abs() < 1e-18);
    assert!((number(limit, "eps_eff") - material).abs() < 1e-12);
    let (within, beyond) = (
        contact_time(&tables, "longest"),
        contact_time(&tables, "beyond"),
    );
    assert!(within > 7e-6);
    assert!((eps_eff(within, &[]) / material - 1.0).abs() <= 0.05);
    assert!((eps_eff(beyond, &[]) / material - 1.0).abs() > 0.05);
    let same = advise(&["fig1b", "--against", "7e-6", "--tolerance", "0.05"]);
    assert_eq!(contact_time(&same, "longest"), within);
}

#[test]
fn hard_spheres_stand_for_their_soft_twins() {
    // Fig. 1(e) is Fig. 1(b) with hard spheres.
    let soft = advise(&["fig1b"]);
    let hard = advise(&["fig1e"]);
    assert_eq!(
        contact_time(&soft, "longest"),
        contact_time(&hard, "longest")
    );
    assert!(row(&soft, "scene").is_some() && row(&hard, "scene").is_none());
}

#[test]
fn the_cost_is_that_of_the_answer() {
    let tables = advise(&["fig1b", "--set", "steps_per_contact=50"]);
    let time = contact_time(&tables, "longest");
    let costs = rows(&tables, "advise-cost");
    let names: Vec<&str> = costs
        .iter()
        .filter_map(|row| row["method"].as_str())
        .collect();
    assert_eq!(names, ["exact", "verlet", "gear", "ed"]);
    for row in costs {
        assert!(number(row, "run_time") > 0.0);
        let off = number(row, "eps_eff_off");
        match row["method"].as_str() {
            // The step is the scene's grid at the answer; the stable step is that of a
            // column of ten at ε = 0.9, 6.9 and 2.4 steps in a contact time.
            Some(name @ ("verlet" | "gear")) => {
                assert!((number(row, "step") / (time / 50.0) - 1.0).abs() < 1e-12);
                let steps = time / number(row, "largest_stable_step");
                let known = if name == "gear" { 6.9 } else { 2.4 };
                assert!((steps - known).abs() < 0.05, "{name}: {steps}");
                // First order at 50 steps: some 1e-3 beside the tolerance.
                assert!(off < 0.02, "{name}: {off}");
            }
            Some("exact") => assert!(off <= 0.01, "{off}"),
            _ => assert!(off == 0.0),
        }
    }
}

#[test]
fn what_no_contact_time_changes_is_said_so() {
    let alone = advise(&["fig1b", "--set", "n=1", "--quick"]);
    assert!(title(&alone).contains("any t_c"), "{}", title(&alone));
    assert!(notes(&alone).contains("single bead"), "{}", notes(&alone));
    // Touching beads: 0.9667 at any t_c, where hard spheres have 0.3415.
    let touching = advise(&["fig1d", "--quick"]);
    assert!(title(&touching).contains("no t_c"), "{}", title(&touching));
    assert!(notes(&touching).contains("sigma_0 = 0 at any"));
    for point in rows(&touching, "advise-curve") {
        assert!((number(point, "eps_eff") - 0.966_687).abs() < 1e-6);
    }
    let same = advise(&["fig1a", "--against", "material", "--quick"]);
    assert!(title(&same).contains("any t_c"), "{}", title(&same));
}

#[test]
fn a_collapsing_column_gets_a_plain_sentence() {
    // N(1 − ε) = 4: hard spheres come to rest at the floor, soft ones never nearly.
    let tables = advise(&[
        "fig1b",
        "--set",
        "restitution=0.6",
        "--between",
        "1e-6:1e-4",
    ]);
    assert!(title(&tables).contains("no t_c"), "{}", title(&tables));
    assert!(notes(&tables).contains("inelastic collapse"));
    assert!(row(&tables, "longest").is_none());
    assert!(rows(&tables, "advise-curve").len() >= 8);
    let names: Vec<&Value> = tables.iter().map(|table| &table["name"]).collect();
    assert!(!names.contains(&&Value::from("advise-cost")), "{names:?}");
}

#[test]
fn a_plate_is_answered_no_better_than_its_errors_allow() {
    // Strong shaking: MD and ED agree at any of these, Sec. V C. 20 % is far above the
    // means' errors of some per cent, and above the softest column's distance.
    let wide = advise(&[
        "fig7-md",
        "--tolerance",
        "0.2",
        "--between",
        "1e-6:1e-4",
        "--budget",
        "10",
        "--quick",
    ]);
    assert!(title(&wide).contains("any t_c"), "{}", title(&wide));
    for point in rows(&wide, "advise-curve") {
        assert_eq!(point["verdict"], "within");
        for of in ["er_over_e", "h_cm"] {
            let off = number(point, &format!("{of}_off"));
            let error = number(point, &format!("{of}_off_error"));
            assert!(error > 0.0 && off + 3.0 * error <= 0.2, "{point}");
        }
    }
    // A tolerance that no such time can decide is not decided, whatever the means say.
    let narrow = advise(&[
        "fig7-md",
        "--tolerance",
        "1e-5",
        "--between",
        "1e-6:1e-5",
        "--budget",
        "1",
        "--quick",
    ]);
    assert!(title(&narrow).contains("not decided"), "{}", title(&narrow));
    assert!(row(&narrow, "longest").is_none());
    assert!(notes(&narrow).contains("--budget"), "{}", notes(&narrow));
}

#[test]
fn a_power_law_keeps_its_collisions_at_every_contact_time() {
    // Every member of the family loses the same at the scene's own speed; 1e-5 is left
    // to the last digits of stiffness and damping, which are written in full.
    let tables = advise(&[
        "fig3-hkk",
        "--set",
        "s0=1e-6",
        "--against",
        "1e-6",
        "--quick",
        "--tolerance",
        "0.05",
    ]);
    let time = contact_time(&tables, "longest");
    let own = json(&["fig3-hkk"]);
    let longer = time / own["contact_time"].as_f64().expect("a contact time");
    let (stiffness, damping) = (2e12 * longer.powf(-2.5), 1e5 * longer.powf(-1.5));
    let (stiffness, damping) = (
        format!("stiffness={stiffness:e}"),
        format!("damping={damping:e}"),
    );
    let settings = [
        "fig3-hkk", "--set", "s0=1e-6", "--set", &stiffness, "--set", &damping,
    ];
    let run = json(&settings);
    let of = |run: &Value, name: &str| run[name].as_f64().expect("a number");
    assert!((of(&run, "contact_time") / time - 1.0).abs() < 1e-9);
    assert!((of(&run, "restitution") - of(&own, "restitution")).abs() < 1e-9);
    let longest = row(&tables, "longest").expect("an answer");
    // Both by the adaptive method at 1e-10.
    assert!((of(&run, "eps_eff") - number(longest, "eps_eff")).abs() < 1e-7);
    let line = refused(&["advise", "fig3-hertz"]);
    assert!(
        line.contains("law hertz") && line.contains("--against"),
        "{line}"
    );
}

#[test]
fn a_budget_is_kept() {
    // A thousand beads near collapse take long; the search ends with what it has.
    let arguments = [
        "advise", "fig1b", "--set", "n=1000", "--budget", "1", "--quick",
    ];
    let start = Instant::now();
    let output = beadlab(&arguments);
    // Alone it takes what it is given; a busy machine may hold it up.
    assert!(
        start.elapsed() < Duration::from_secs(60),
        "{:?}",
        start.elapsed()
    );
    let said = String::from_utf8_lossy(&output.stderr);
    match output.status.code() {
        Some(0) => assert_eq!(said, ""),
        code => {
            assert_eq!(code, Some(1));
            assert!(said.contains("--budget gives more"), "{said}");
        }
    }
}

#[test]
fn wrong_input_is_one_line() {
    for (arguments, said) in [
        (&["fig1z"][..], "no such preset"),
        (&["fig1b", "--tolerance", "0"], "--tolerance"),
        (&["fig1b", "--tolerance", "nan"], "from 1e-12 to 1"),
        (&["fig1b", "--tolerance", "-1"], "--tolerance"),
        (&["fig1b", "--against", "soft"], "--against soft: must be"),
        (&["fig1b", "--against", "-1e-6"], "--against -1e-6"),
        (&["fig1b", "--against", "1e9"], "contact_time = 1e9"),
        (&["fig1b", "--between", "1e-5"], "--between"),
        (
            &["fig1b", "--between", "1e-5:1e-6"],
            "the smaller one first",
        ),
        (
            &["fig1b", "--between", "1e-30:1e-20"],
            "--between 1e-30:1e-20",
        ),
        (&["fig1b", "--budget", "0"], "--budget"),
        (&["fig1d", "--against", "material"], "no contact time"),
        (&["inelastic-ball"], "restitution = 0"),
        (&["fig4"], "a lattice has no exact run"),
        (&["fig1b", "--set", "n=0"], "n = 0"),
        (&["fig1b", "--out", "no/such/folder"], "--out"),
    ] {
        let line = refused(&[&["advise"], arguments].concat());
        assert!(line.contains(said), "{arguments:?}: {line}");
    }
}
