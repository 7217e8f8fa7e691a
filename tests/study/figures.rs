//! `beadlab figure`: its numbers against the paper's own and against closed forms.

use crate::program::{json, printed, refused};
use serde_json::Value;
use std::fs;
use std::path::{Path, PathBuf};
#[cfg(unix)]
use std::process::Command;

/// The tables of a quick figure.
fn tables(name: &str) -> Vec<Value> {
    let text = printed(&["figure", name, "--quick", "--format", "json"]);
    serde_json::from_str(&text).expect("a list of tables")
}

fn rows<'a>(tables: &'a [Value], name: &str) -> &'a [Value] {
    let table = tables.iter().find(|table| table["name"] == name);
    let table = table.unwrap_or_else(|| panic!("no table {name}"));
    table["rows"].as_array().expect("rows")
}

fn number(row: &Value, column: &str) -> f64 {
    row[column]
        .as_f64()
        .unwrap_or_else(|| panic!("no {column} in {row}"))
}

/// What a claim found, by the beginning of what it is about.
fn claim(tables: &[Value], what: &str) -> (f64, String) {
    let claims = &tables[0]["rows"];
    let row = claims.as_array().expect("rows").iter().find(|row| {
        let text = row["what"].as_str().unwrap_or_default();
        text.starts_with(what)
    });
    let row = row.unwrap_or_else(|| panic!("no claim {what}"));
    let within = row["within"].as_str().unwrap_or_default().to_owned();
    (number(row, "beadlab"), within)
}

/// Slope of ln y over ln x, by the first and the last row.
fn power(rows: &[&Value], x: &str, y: &str) -> f64 {
    let (first, last) = (rows[0], rows[rows.len() - 1]);
    (number(last, y) / number(first, y)).ln() / (number(last, x) / number(first, x)).ln()
}

#[test]
fn exponents_of_table_1_over_fifteen_decades() {
    let tables = tables("table1");
    let all = rows(&tables, "table1");
    for (beta, gamma) in [(0.0, 0.0), (0.0, 0.2), (0.5, 0.0), (0.5, 0.5), (0.5, 0.25)] {
        let mine: Vec<&Value> = all
            .iter()
            .filter(|row| number(row, "beta") == beta && number(row, "gamma") == gamma)
            .collect();
        let decades = (number(mine[mine.len() - 1], "v0") / number(mine[0], "v0")).log10();
        assert!(decades > 14.99, "{decades}");
        // Losses are at most 1e-3, and so are the corrections to the three powers, which
        // over 15 decades are less than a thousandth of the exponent's unit.
        for (column, exponent) in [
            ("x_max", 2.0 / (2.0 + beta)),
            ("t_c", -beta / (2.0 + beta)),
            ("loss", (2.0 * gamma - beta) / (2.0 + beta)),
        ] {
            let found = power(&mine, "v0", column);
            assert!(
                (found - exponent).abs() < 1e-3,
                "{beta} {gamma} {column}: {found} {exponent}"
            );
        }
        for row in mine {
            // Within 0.1 %, as the appendix says of weak damping; here 1 − ε <= 1e-3.
            let depth = number(row, "x_max") / number(row, "x_max_a1") - 1.0;
            let time = number(row, "t_c") / number(row, "t_c_a2") - 1.0;
            assert!(depth.abs() < 1e-3 && time.abs() < 1e-3, "{row}");
        }
    }
}

#[test]
fn a_linear_pair_at_a_tenth_lost_is_not_within_a_thousandth_of_a1() {
    // x_max ω_0/v = exp(−(μ/ω) atan(ω/μ)) and t_c ω_0/π = √(1 + (μ/ω)²), with
    // μ/ω = −ln(ε)/π: closed forms at ε = 0.9.
    let ratio = -0.9_f64.ln() / std::f64::consts::PI;
    let depth = (-ratio * (1.0 / ratio).atan()).exp() - 1.0;
    let time = (1.0 + ratio * ratio).sqrt() - 1.0;
    let tables = tables("table1");
    let row = &rows(&tables, "table1-damped")[0];
    // The interpolated depth has ten digits, and ε is bisected to 1e-10.
    assert!((number(row, "restitution") - 0.9).abs() < 1e-9);
    assert!((number(row, "x_max_off") - depth).abs() < 1e-8, "{row}");
    assert!((number(row, "t_c_off") - time).abs() < 1e-8, "{row}");
    assert_eq!(claim(&tables, "Hooke, eps 0.9: x_max").1, "NO");
    assert_eq!(claim(&tables, "Hooke, eps 0.9: t_c").1, "yes");
}

#[test]
fn materials_of_section_3() {
    let tables = tables("table1");
    // The paper's inputs have three digits.
    let (time, _) = claim(&tables, "steel, 1 m/s: t_c");
    assert!((time - 4.56).abs() < 0.005, "{time}");
    let (depth, _) = claim(&tables, "steel, 1 m/s: x_max");
    assert!((depth - 1.55).abs() < 0.005, "{depth}");
}

#[test]
fn one_curve_over_sigma() {
    let tables = tables("2a");
    assert!(rows(&tables, "fig2a").len() >= 300);
    // Without gravity the linear column has no other scale: only rounding is left.
    assert!(claim(&tables, "even starts").0 < 1e-9);
    assert_eq!(claim(&tables, "eps_eff of ED").1, "yes");
    let all = rows(&tables, "fig2a").iter();
    let touching: Vec<_> = all.filter(|row| number(row, "sigma") < 1e-5).collect();
    assert!(touching.len() > 10, "{}", touching.len());
    for row in touching {
        // Fig. 1(a)'s limit, to the order of σ.
        assert!((number(row, "eps_eff") - 0.966_687).abs() < 1e-4, "{row}");
    }
    // The fall from that to the hard spheres' 0.3415, at σ of launched columns.
    assert!((claim(&tables, "sigma at 10 %").0 - 0.15).abs() < 0.01);
    assert!((claim(&tables, "sigma at 90 %").0 - 1.08).abs() < 0.05);
}

#[test]
fn slopes_and_sentences_of_columns_without_gaps() {
    let tables = tables("2b");
    for (what, slope) in [
        ("slope, eps 0.6, N 50", -0.5),
        ("slope, eps 0.975, N 50", -0.315),
    ] {
        // Guides for the eye in the paper, towards which the points tend.
        assert!((claim(&tables, what).0 - slope).abs() < 0.03);
    }
    // Far longer columns lose what waves lose: extrapolated from lengths whose corrections
    // of the order N^(-1/2) are 5 to 15 %, and taken out but for their square.
    for what in ["eps 0.6: loss/limit", "eps 0.9: loss/limit"] {
        assert!((claim(&tables, what).0 - 1.0).abs() < 0.01, "{what}");
    }
    // An independent reference in quadruple precision has 0.955 of the limit for 1000 beads
    // at ε = 0.9; the limit by hand: √(2√2 · 0.033518/(1000π)), 0.033518 being μ/ω_0.
    let column = ["fig1a", "--method", "exact", "--set", "n=1000"];
    let lost = 1.0 - number(&json(&column), "eps_eff");
    let part = lost / (8.0_f64.sqrt() * 0.033_518 / (1000.0 * std::f64::consts::PI)).sqrt();
    assert!((part - 0.955).abs() < 5e-4, "{part}");
    // Weakly damped columns pass through the paper's -0.315 and go on.
    assert_eq!(claim(&tables, "slope, eps 0.975, N 100 to 300").1, "NO");
    let tables = self::tables("sec4a");
    // Waves go up and down 300 beads in 2N√2/ω_0, and the ends add less than a contact time.
    assert!((claim(&tables, "t_k/(N t_c) of waves").0 - 0.8998).abs() < 1.0 / 300.0);
    // t_k is N t_c but for the column's ends; E_r goes with v² but for rounding.
    assert!((claim(&tables, "t_k/(N t_c), N = 10,").0 - 1.0).abs() < 0.1);
    assert!((claim(&tables, "power of v0 in E_r").0 - 2.0).abs() < 1e-9);
    assert_eq!(claim(&tables, "eps > 0.9: eps_eff/eps").1, "NO");
    assert_eq!(claim(&tables, "ED, N 10, eps 0.6").1, "yes");
}

#[test]
fn three_laws_over_the_length() {
    let tables = tables("3");
    let all = rows(&tables, "fig3");
    let at = |law: &str, n: u64| {
        let row = all.iter().find(|row| row["law"] == law && row["n"] == n);
        number(row.unwrap_or_else(|| panic!("{law} {n}")), "eps_eff")
    };
    // Known to five digits.
    for (n, eps) in [(1, 0.85414), (10, 0.94005), (50, 0.96860)] {
        assert!((at("Hooke", n) - eps).abs() < 1e-5, "{n}");
    }
    for (law, preset) in [("Hertz", "fig3-hertz"), ("Hertz-Kuwabara-Kono", "fig3-hkk")] {
        // The same run by another command.
        let run = json(&[preset, "--set", "n=5"]);
        let eps = number(&run, "eps_eff");
        assert!((at(law, 5) - eps).abs() < 1e-6, "{law}: {eps}");
    }
}

#[test]
fn hard_beads_stay_closed_on_a_plate_and_soft_ones_part() {
    let hard = tables("6a");
    assert_eq!(claim(&hard, "widest opening").1, "yes");
    // The closed form of one inelastic body at α = 2, seen at 200 looks a period.
    assert!((claim(&hard, "apex").0 - 1.25).abs() < 1e-3);
    assert_eq!(claim(&tables("6b"), "widest opening").1, "yes");
}

#[test]
fn condensed_and_expanded_states_alternate() {
    let tables = tables("5b");
    let motion = rows(&tables, "fig5b");
    // 60 periods of 200 looks and the start, with every bead.
    assert_eq!(motion.len(), 12_001);
    assert!((1..=10).all(|bead| motion[0].get(format!("z{bead}")).is_some()));
    let landings = rows(&tables, "fig5b-landings");
    // Sec. V A: what lands dense parts, what lands loose closes up again.
    let rises = |dense: bool| {
        let pairs = landings.windows(2);
        let mine = pairs.filter(|pair| (number(&pair[1], "sigma") < 1.0) == dense);
        let ratios: Vec<f64> = mine
            .filter_map(|pair| {
                let after = |row: &Value| row["er_over_e_after"].as_f64();
                Some(after(&pair[1])? / after(&pair[0])?)
            })
            .collect();
        assert!(ratios.len() >= 10, "{}", ratios.len());
        ratios.iter().filter(|ratio| **ratio > 1.0).count() as f64 / ratios.len() as f64
    };
    assert!(rises(true) > 0.7 && (0.1..0.5).contains(&rises(false)));
    // A third of the time; a median of 3 periods from dense to dense holds some 16 of them.
    let condensed = claim(&tables, "time with E_r/E < 1e-3").0;
    assert!((0.15..0.5).contains(&condensed), "{condensed}");
    // What shuffled landings do not do: a test beside the claims shuffles them.
    for what in ["dense again 4 to 11", "dense again whole periods"] {
        assert_eq!(claim(&tables, what).1, "yes", "{what}");
    }
}

#[test]
fn shorter_contacts_make_denser_landings_and_no_cure() {
    let tables = tables("plateau");
    // Hard spheres have 0; soft ones keep, at 7e-8 s and at 7e-5 s, what they have at 7e-6 s.
    for what in ["Hooke: E_r/E", "Hertz: E_r/E", "H.-K.-Kono: E_r/E"] {
        let (share, within) = claim(&tables, what);
        assert!(
            (0.05..0.3).contains(&share) && within == "NO",
            "{what}: {share}"
        );
    }
    assert_eq!(claim(&tables, "the same less at").1, "yes");
    assert_eq!(claim(&tables, "ED: E_r/E"), (0.0, "yes".to_owned()));
    // The rate at which contacts open, and the inelastic body's flight, in closed form:
    // right to the order of t_c over the period, 7e-7 s over 50 ms.
    assert!(claim(&tables, "Hooke: first sigma/theory").0 < 1e-4);
    // σ goes as t_c^((2-β)/(2+3β)), to what the dashpot changes.
    assert!((claim(&tables, "Hooke: power").0 - 1.0).abs() < 1e-4);
    assert!((claim(&tables, "H.-K.-Kono: power").0 - 3.0 / 7.0).abs() < 5e-3);
    // Contacts that creep: more than 3/7.
    let creeping = claim(&tables, "Hertz: power").0;
    assert!((0.45..1.0).contains(&creeping), "{creeping}");
    // By hand: σ/t_c = N gω√(α² − 1) T/((π² + ln²ε) v) with T = 0.7415 periods and
    // v = 0.298 m/s is 261 1/s, at α = 1.996.
    let first = |row: &&Value| row["law"] == "hooke" && row["contact_time"] == 7e-9;
    let row = rows(&tables, "plateau").iter().find(first).expect("a row");
    assert!(
        (number(row, "first_sigma") / 7e-9 - 261.0).abs() < 0.5,
        "{row}"
    );
}

#[test]
fn a_closed_orbit_of_hard_spheres_is_that_of_very_stiff_ones() {
    // Strong shaking from rest: at this α the column lands gently, as one body, every
    // time. Soft contacts of 1e-9 s, which find that by themselves, agree to what they
    // are compressed and delayed by: parts of 1e-5 and less.
    let common = ["--set", "alpha=39.25536332185396", "--set", "duration=2"];
    let hard = json(&[&["fig7-ed"][..], &common].concat());
    let stiff = ["fig7-md", "--method", "exact", "--set", "contact_time=1e-9"];
    let soft = json(&[&stiff[..], &common].concat());
    let (hard, soft) = (number(&hard, "h_cm_mean"), number(&soft, "h_cm_mean"));
    assert!((soft / hard - 1.0).abs() < 1e-4, "{soft} {hard}");
    // Flights of 13 periods as parabolas, gT²/12 = 0.345 m in the mean, of which 2.8 are
    // seen: a fifth of what loose columns reach.
    assert!((hard - 0.345).abs() < 0.05, "{hard}");
}

#[test]
fn exponents_stand_beside_the_equations_and_the_misprint_beside_the_table() {
    let tables = tables("table1");
    let of_a2 = claim(&tables, "(1/2, 1/2): t_c over v0");
    assert_eq!(
        claim(&tables, "(1/2, 1/2): t_c over v0, as printed").1,
        "NO"
    );
    assert!((of_a2.0 + 0.2).abs() < 1e-3, "{}", of_a2.0);
}

/// A folder of this test that holds nothing.
fn empty_folder(name: &str) -> PathBuf {
    let folder = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(name);
    // It may not be there.
    let _ = fs::remove_dir_all(&folder);
    fs::create_dir(&folder).expect("the folder of the tests can be written");
    folder
}

fn names(folder: &Path) -> Vec<String> {
    let entries = fs::read_dir(folder).expect("a folder");
    let mut names: Vec<String> = entries
        .filter_map(|entry| entry.ok()?.file_name().into_string().ok())
        .collect();
    names.sort();
    names
}

#[test]
fn a_report_takes_its_place_as_a_whole() {
    let folder = empty_folder("figure-whole");
    let out = folder.to_str().expect("UTF-8");
    printed(&["figure", "2c", "--quick", "--out", out]);
    let expected = [
        "claims-2c.csv",
        "fig2c.csv",
        "fig2c.svg",
        "report.json",
        "report.txt",
    ];
    assert_eq!(names(&folder), expected);
}

#[cfg(unix)]
#[test]
fn a_full_disk_leaves_what_was_there() {
    let folder = empty_folder("figure-full");
    fs::write(folder.join("fig2a.csv"), "before").expect("a file");
    // No file may be longer than 8 KiB, which the points of the figure are.
    let script = "trap '' XFSZ; ulimit -f 8; exec \"$0\" figure 2a --quick --out \"$1\"";
    let output = Command::new("bash")
        .args(["-c", script, env!("CARGO_BIN_EXE_beadlab")])
        .arg(&folder)
        .output()
        .expect("a shell");
    let stderr = String::from_utf8_lossy(&output.stderr);
    assert_eq!(output.status.code(), Some(1), "{stderr}");
    assert!(
        stderr.contains("cannot be written") && stderr.lines().count() == 1,
        "{stderr}"
    );
    assert_eq!(names(&folder), ["fig2a.csv"]);
    let kept = fs::read_to_string(folder.join("fig2a.csv")).expect("a file");
    assert_eq!(kept, "before");
}

#[test]
fn the_same_figure_twice_is_the_same_bytes() {
    let once = || printed(&["figure", "2c", "--quick", "--format", "csv"]);
    let text = once();
    assert_eq!(text, once());
    assert!(text.contains("# seed = ") && text.contains("# units: "));
}

#[test]
fn bad_names_and_folders_are_refused_in_a_line() {
    let line = refused(&["figure", "2x"]);
    assert!(
        line.contains("2x") && line.contains("did you mean 2a?"),
        "{line}"
    );
    let line = refused(&["figure", "tabel1"]);
    assert!(line.contains("did you mean table1?"), "{line}");
    let line = refused(&["figure", "1a", "--out", "/no/such/folder/here"]);
    assert!(
        line.contains("--out") && line.contains("/no/such"),
        "{line}"
    );
}
