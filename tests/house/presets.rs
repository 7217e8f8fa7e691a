//! The embedded presets: that they are all there, teach, and have the paper's numbers.

use beadlab::scene::preset::embedded;
use beadlab::scene::{
    Arrangement, Floor, GridSettings, Launch, Method, MethodName, Preset, Shake, Soft, Solver,
    Start,
};
use std::fs;
use std::path::PathBuf;

use crate::program::printed;

fn load(name: &str) -> Preset {
    Preset::load(name).unwrap_or_else(|error| panic!("{error}"))
}

/// Lines of at most `width` columns, as a screen breaks a paragraph.
fn lines(paragraph: &str, width: usize) -> usize {
    let (mut lines, mut column) = (1, 0);
    for word in paragraph.split(' ').map(|word| word.chars().count()) {
        if column > 0 && column + 1 + word > width {
            (lines, column) = (lines + 1, word);
        } else {
            column += word + usize::from(column > 0);
        }
    }
    lines
}

#[test]
fn the_presets_of_the_paper_are_embedded_and_teach() {
    let names: Vec<_> = embedded().iter().map(|&(name, _)| name).collect();
    for name in [
        "fig1a",
        "fig1b",
        "fig1c",
        "fig1d",
        "fig1e",
        "fig1f",
        "fig4",
        "fig5a",
        "fig5b",
        "fig6a",
        "fig6b",
        "fig7-md",
        "fig7-ed",
        "steel",
        "aluminium",
        "fig3-hooke",
        "fig3-hertz",
        "fig3-hkk",
        "single-ball",
        "shaken",
    ] {
        assert!(names.contains(&name), "{name}");
    }
    for name in &names {
        let preset = load(name);
        assert_eq!(preset.name, *name);
        assert!(
            !preset.title.is_empty() && preset.title.chars().count() <= 70,
            "{name}"
        );
        for text in [&preset.caption, &preset.look_for, &preset.try_next] {
            assert!(!text.is_empty() && !text.contains('\n'), "{name}: {text:?}");
            assert!(lines(text, 70) <= 3, "{name}: {text}");
        }
    }
}

#[test]
fn every_file_of_the_folder_is_embedded() {
    let folder = PathBuf::from(env!("CARGO_MANIFEST_DIR")).join("presets");
    let mut files: Vec<String> = fs::read_dir(folder)
        .expect("the folder of presets")
        .map(|entry| entry.expect("an entry").path())
        .map(|path| {
            path.file_stem()
                .expect("a name")
                .to_string_lossy()
                .into_owned()
        })
        .collect();
    files.sort();
    let mut names: Vec<_> = embedded()
        .iter()
        .map(|&(name, _)| name.to_owned())
        .collect();
    names.sort();
    assert_eq!(files, names);
}

/// Amplitude A₀, m, frequency, Hz, and reduced acceleration α.
fn plate(preset: &Preset) -> (f64, f64, f64) {
    match preset.scene.floor {
        Floor::Vibrating(Shake {
            amplitude,
            frequency,
        }) => (amplitude, frequency, preset.scene.alpha().expect("gravity")),
        Floor::Fixed => panic!("{} has no plate", preset.name),
    }
}

fn close(a: f64, b: f64) -> bool {
    (a - b).abs() <= 1e-12 * b.abs()
}

#[test]
fn the_floor_collisions_have_the_papers_numbers() {
    for (soft, hard, separation) in [
        ("fig1a", "fig1d", 0.0),
        ("fig1b", "fig1e", 1e-6),
        ("fig1c", "fig1f", 1e-5),
    ] {
        for name in [soft, hard] {
            let scene = load(name).scene;
            let start = Start::Launched(Launch {
                s0: separation,
                jitter: false,
                v0: -0.2,
            });
            assert_eq!((scene.n, scene.start), (10, start), "{name}");
            assert!(
                close(scene.diameter, 1e-3) && close(scene.restitution, 0.9),
                "{name}"
            );
            assert_eq!((scene.gravity, scene.floor), (None, Floor::Fixed), "{name}");
        }
        let scene = load(soft).scene;
        assert!(close(scene.contact_time().expect("soft"), 0.7e-5));
        assert_eq!(scene.method.name(), MethodName::Gear);
        assert!(
            matches!(scene.method, Method::Soft(Soft { solver: Solver::Grid(GridSettings { steps_per_contact, .. }), attraction: true, .. })
                if close(steps_per_contact, 100.0))
        );
        assert_eq!(load(soft).beside.as_deref(), Some(hard));
        assert_eq!(load(hard).beside.as_deref(), Some(soft));
        assert_eq!(
            load(soft).scene.with_method(MethodName::Ed),
            Ok(load(hard).scene)
        );
    }
}

#[test]
fn the_lattice_has_the_papers_numbers() {
    let scene = load("fig4").scene;
    let arrangement = Arrangement::Lattice {
        columns: 13,
        tangential: 0.0,
    };
    assert_eq!((scene.n, scene.arrangement), (130, arrangement));
    assert!(close(scene.diameter, 1e-3) && close(scene.restitution, 0.9));
    let (Start::Launched(Launch { s0, jitter, v0 }), Some(contact_time)) =
        (scene.start, scene.contact_time())
    else {
        panic!("a soft lattice is thrown");
    };
    assert!(jitter && (1e-7..=1e-3).contains(&s0) && (0.01..=1.0).contains(&-v0));
    assert!((0.2e-5..=1e-4).contains(&contact_time));
}

#[test]
fn the_shaken_columns_have_the_papers_numbers() {
    // Name, N, d, ε, t_c, f, α; fig5 and shaken have A₀ = 1.24 d in place of α.
    for (name, n, diameter, restitution, contact_time, frequency, alpha) in [
        ("fig5a", 10, 1e-3, 0.6, Some(0.7e-3), 20.0, None),
        ("fig5b", 10, 1e-3, 0.6, Some(0.7e-5), 20.0, None),
        ("shaken", 10, 1e-3, 0.6, Some(0.7e-5), 20.0, None),
        ("fig6a", 10, 3e-3, 0.6, None, 10.0, Some(2.0)),
        ("fig6b", 10, 3e-3, 0.6, Some(3.6e-6), 10.0, Some(2.0)),
        ("fig7-md", 10, 1e-3, 0.92, Some(1e-4), 20.0, Some(20.0)),
        ("fig7-ed", 10, 1e-3, 0.92, None, 20.0, Some(20.0)),
        ("steel", 10, 1.5e-3, 0.9, Some(4.6e-6), 20.0, Some(2.0)),
        ("aluminium", 10, 1.5e-3, 0.6, Some(4.6e-6), 20.0, Some(2.0)),
        ("single-ball", 1, 1e-3, 0.6, Some(1e-5), 20.0, Some(2.0)),
    ] {
        let preset = load(name);
        let scene = &preset.scene;
        assert_eq!((scene.n, scene.start), (n, Start::Resting), "{name}");
        assert!(
            close(scene.diameter, diameter) && close(scene.restitution, restitution),
            "{name}"
        );
        assert_eq!(scene.contact_time(), contact_time, "{name}");
        assert_eq!(scene.is_md(), contact_time.is_some(), "{name}");
        let (amplitude, f, reduced) = plate(&preset);
        assert!(close(f, frequency), "{name}");
        match alpha {
            Some(alpha) => assert!(close(reduced, alpha), "{name}: α = {reduced}"),
            None => assert!(close(amplitude, 1.24 * diameter) && (reduced - 2.0).abs() < 0.01),
        }
        let periods = scene.duration.expect("gravity") * f;
        assert!(periods > 19.0, "{name}: {periods} periods");
    }
    for (soft, hard) in [("fig6b", "fig6a"), ("fig7-md", "fig7-ed")] {
        assert_eq!(load(soft).beside.as_deref(), Some(hard));
        assert_eq!(load(hard).beside.as_deref(), Some(soft));
    }
    assert!(close(
        load("fig7-md").scene.duration.expect("gravity"),
        25.0
    ));
}

#[test]
fn a_preset_can_be_shown_checked_and_run_as_a_file() {
    for (name, _) in embedded() {
        let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join(format!("shown-{name}.toml"));
        let path = path.to_str().expect("a UTF-8 path");
        fs::write(path, printed(&["presets", "show", name])).expect("a folder of the tests");
        assert!(printed(&["presets", "check", path]).starts_with(path));
        let Preset { scene, .. } = load(path);
        assert_eq!(scene, load(name).scene);
    }
    let path = PathBuf::from(env!("CARGO_TARGET_TMPDIR")).join("shown-fig1e.toml");
    let from_file = printed(&["run", path.to_str().expect("a UTF-8 path")]);
    assert_eq!(
        from_file.replace("shown-fig1e", "fig1e"),
        printed(&["run", "fig1e"])
    );
}

#[test]
fn the_list_names_every_preset_with_its_title() {
    let list = printed(&["presets"]);
    assert_eq!(list, printed(&["presets", "list"]));
    let lines: Vec<_> = list.lines().collect();
    assert_eq!(lines.len(), embedded().len());
    for ((name, _), line) in embedded().iter().zip(lines) {
        assert!(
            line.starts_with(&format!("{name} ")) && line.ends_with(&load(name).title),
            "{line}"
        );
    }
}
