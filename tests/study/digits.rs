//! No digit is printed that a result does not have, and what says so says it of all.

use std::f64::consts::PI;

use crate::program::{beadlab, failed, file, json, table};
use beadlab::numerals::{digits, rounded};
use beadlab::physics::{Observation, build};
use beadlab::scene::{Preset, diameters};

fn number(object: &serde_json::Value, name: &str) -> f64 {
    let x = object[name].as_f64();
    x.unwrap_or_else(|| panic!("{name}: {object}"))
}

/// What `run` prints of a preset with these settings.
fn run(preset: &str, settings: &[&str]) -> serde_json::Value {
    let settings = settings.iter().flat_map(|setting| ["--set", setting]);
    json(&[&[preset][..], &settings.collect::<Vec<_>>()].concat())
}

/// Every result that has a sensitivity of its own, with the name of that.
const PAIRS: [(&str, &str); 4] = [
    ("eps_eff", "sensitivity"),
    ("er_over_ef", "er_over_ef_sensitivity"),
    ("contact_duration", "contact_duration_sensitivity"),
    ("sigma", "sigma_sensitivity"),
];

#[test]
fn no_result_has_digits_beyond_its_own_sensitivity() {
    for (preset, settings) in [
        ("fig1b", &[][..]),
        ("fig1b", &["n=30", "s0=3e-6", "steps_per_contact=40"]),
        ("fig3-hertz", &["n=5"]),
        ("fig4", &["rows=2"]),
    ] {
        let object = run(preset, settings);
        for (name, sensitivity) in PAIRS {
            let (x, part) = (number(&object, name), number(&object, sensitivity));
            assert!(part > 0.0, "{preset}: {sensitivity}");
            // The sensitivity itself is printed to two digits.
            assert_eq!(x, rounded(x, digits(0.9 * part)), "{preset}: {name} {part}");
        }
    }
}

#[test]
fn what_the_step_decides_is_no_digit() {
    // By an independent reference: two lattices, to all digits given here.
    for (settings, truth) in [
        (&[][..], 0.908_185),
        (
            &[
                "rows=4",
                "restitution=0.6",
                "contact_time=7e-6",
                "v0=-0.2",
                "s0=1e-5",
            ],
            0.221_68,
        ),
    ] {
        let object = run("fig4", settings);
        let (found, part) = (number(&object, "eps_eff"), number(&object, "sensitivity"));
        let off = (found / truth - 1.0).abs();
        assert!(off <= part, "{found} ± {part}, {truth}");
        assert!(part < 0.1, "and it is known to more than nothing: {part}");
        assert_eq!(object["step_error"], object["sensitivity"]);
    }
    // Ten columns: errors against the exact method, and what other steps say of them.
    let mut told = 0;
    for k in 0..10 {
        let s0 = format!("s0={}e-7", 2 + 7 * k);
        let n = format!("n={}", 3 + 2 * k);
        let settings = [&s0[..], &n[..]];
        let grid = run("fig1b", &settings);
        let all = [
            &["fig1b", "--method", "exact"][..],
            &["--set", &s0, "--set", &n],
        ]
        .concat();
        let truth = number(&json(&all), "eps_eff");
        let off = (number(&grid, "eps_eff") / truth - 1.0).abs();
        let part = number(&grid, "step_error");
        told += usize::from(off <= part);
        assert!(off <= 5.0 * part, "{settings:?}: {off} {part}");
    }
    // An estimate from three other phases, not a bound.
    assert!(told >= 8, "{told} of 10");
}

#[test]
fn what_the_tolerance_decides_is_no_digit() {
    let settings = [
        "n=9",
        "s0=3.026e-6",
        "v0=-0.01341",
        "stiffness=2e12",
        "damping=8.559e5",
    ];
    let object = run("fig3-hkk", &settings);
    let tight = run("fig3-hkk", &[&settings[..], &["tolerance=1e-13"]].concat());
    let (x, y) = (number(&object, "eps_eff"), number(&tight, "eps_eff"));
    let part = number(&object, "sensitivity");
    assert!((x / y - 1.0).abs() <= part, "{x} {y} {part}");
    // To the tolerance, which is of one step of many, and not far beyond.
    assert!(part < 1e-6, "{part}");
}

#[test]
fn sigma_is_that_of_the_last_contacts_end() {
    // Whenever it is looked at.
    let scene = Preset::load("fig1b").expect("embedded").scene;
    let sigma = |looks: f64| {
        let (mut engine, _) = build(&scene, None);
        let (mut seen, mut k) = (Observation::default(), 0.0);
        while !engine.is_over() {
            k += 1.0;
            engine.advance(k * looks, u64::MAX).expect("a sound run");
        }
        engine.observe(&mut seen);
        seen.settled_flight.expect("contacts") / scene.contact_time().expect("soft")
    };
    assert_eq!(sigma(1e-5), sigma(7.77e-5));
    let printed = number(&run("fig1b", &[]), "sigma");
    let part = number(&run("fig1b", &[]), "sigma_sensitivity");
    assert!((printed / sigma(1e-5) - 1.0).abs() <= part, "{printed}");
}

#[test]
fn a_run_that_has_blown_up_fails_however_short_it_is() {
    let settings = ["--set", "steps_per_contact=2", "--set", "duration=1e-2"];
    let short = [&["run", "fig7-md"][..], &settings].concat();
    let line = failed(&short, 1);
    assert!(line.contains("became unstable"), "{line}");
    // The motion too, whose rows up to then are good.
    let rows = [&short[..], &["--format", "csv", "--every", "1e-3"]].concat();
    let output = beadlab(&rows);
    assert_eq!(output.status.code(), Some(1));
    let motion = String::from_utf8(output.stdout).expect("UTF-8");
    // It starts with 10 mm of beads.
    let heights = motion.lines().skip(1).flat_map(|line| line.split(','));
    let heights: Vec<f64> = heights.filter_map(|cell| cell.parse().ok()).collect();
    assert!(heights.len() > 10, "{motion}");
    assert!(heights.iter().all(|x| x.abs() < 1e3), "{motion}");
    let out = file("blown.csv", "");
    let sweep = [
        &["sweep", "fig7-md", "--over", "n=2,10"][..],
        &settings,
        &["--out", &out, "--overwrite"],
    ]
    .concat();
    assert_eq!(beadlab(&sweep).status.code(), Some(1));
    let text = std::fs::read_to_string(&out).expect("a file");
    assert!(text.contains("became unstable"), "{text}");
    // A lattice in a slice of time shorter than between two looks at its energy.
    let lattice = [
        "run",
        "fig4",
        "--method",
        "verlet",
        "--set",
        "steps_per_contact=2",
        "--set",
        "duration=2e-3",
    ];
    assert!(failed(&lattice, 1).contains("became unstable"));
}

#[test]
fn the_deepest_overlap_of_one_contact() {
    // A ball on a floor without gravity: |v|/ω₀ e^{−(μ/ω) atan(ω/μ)}, with 2ω₀² of a pair
    // for ω₀², and half of μ (the paper's floor of the same spring).
    let (t_c, restitution, v) = (7e-6_f64, 0.9_f64, 0.2);
    let mu = -restitution.ln() / t_c;
    let stiffness = 0.5 * ((PI / t_c).powi(2) + mu * mu);
    let half = 0.5 * mu;
    let omega = (stiffness - half * half).sqrt();
    let depth = v / stiffness.sqrt() * (-half / omega * (omega / half).atan()).exp() / 1e-3;
    let exact = json(&["fig1b", "--method", "exact", "--set", "n=1"]);
    let found = number(&exact, "overlap_max");
    // Printed to two digits.
    assert_eq!(found, rounded(depth, 2));
    let grid = number(&run("fig1b", &["n=1"]), "overlap_max");
    // Looked at every 32 of 100 steps: at least sin of 90° less 29° of it.
    assert!(
        (0.87 * depth..1.03 * depth).contains(&grid),
        "{grid} {depth}"
    );
    let deep = beadlab(&["run", "fig1b", "--set", "n=1", "--set", "v0=-80"]);
    assert_eq!(deep.status.code(), Some(0));
    let note = String::from_utf8(deep.stderr).expect("UTF-8");
    assert!(note.contains("of a diameter"), "{note}");
}

#[test]
fn unequal_pairs_have_restitutions_of_their_own() {
    let scene = Preset::load("mixed-sizes").expect("embedded").scene;
    let object = run("mixed-sizes", &["duration=0.01"]);
    let d = diameters(&scene);
    let m: Vec<f64> = d.iter().map(|d| (d / scene.diameter).powi(3)).collect();
    // Two beads of reduced mass ρ: ω₀² = K/ρ, with K and μ those of a mean pair.
    let mu = -scene.restitution.ln();
    let stiffness = 0.5 * (PI * PI + mu * mu);
    let pair = |pair: &[f64]| {
        let reduced = pair[0] * pair[1] / (pair[0] + pair[1]);
        let omega = (stiffness / reduced - mu * mu).sqrt();
        (-PI * mu / omega).exp()
    };
    let all: Vec<f64> = m.windows(2).map(pair).collect();
    let least = all.iter().copied().fold(f64::INFINITY, f64::min);
    let most = all.iter().copied().fold(0.0, f64::max);
    assert!((number(&object, "restitution_min") - least).abs() < 1e-12);
    assert!((number(&object, "restitution_max") - most).abs() < 1e-12);
    for method in ["ed", "exact"] {
        let other = json(&["mixed-sizes", "--method", method, "--set", "duration=0.01"]);
        assert_eq!(other["restitution_min"], object["restitution_min"]);
    }
    assert!(run("fig1b", &[]).get("restitution_min").is_none());
}

#[test]
fn a_long_run_prints_what_its_method_vouches_for() {
    let object = run("fig5b", &["duration=0.2"]);
    assert!(object.get("sensitivity").is_none());
    let mean = number(&object, "h_cm_mean");
    let part = (number(&object, "h_cm_error") / mean).max(1e-3);
    // 100 steps in a contact: a tenth of one.
    assert_eq!(mean, rounded(mean, digits(0.9 * part)));
    let csv =
        crate::program::printed(&["run", "fig5b", "--set", "duration=0.2", "--format", "csv"]);
    let (header, rows) = table(&csv);
    let column = header.iter().position(|name| name == "h_cm_mean");
    assert_eq!(rows[0][column.expect("a column")], mean.to_string());
}
