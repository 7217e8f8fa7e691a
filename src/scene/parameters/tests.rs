mod laws;
mod names;
mod typing;

use super::*;
use crate::scene::validate::example;
use crate::scene::{Arrangement, Draft, Floor, Launch, MethodName, Scene, Shake, Start};

fn example_scene() -> Scene {
    Scene::new(example()).expect("the example is a scene")
}

/// A column at rest on a plate.
fn shaken() -> Scene {
    Scene::new(Facts {
        start: Start::Resting,
        gravity: Some(9.81),
        floor: Floor::Vibrating(Shake {
            amplitude: 1e-3,
            frequency: 20.0,
        }),
        duration: Some(1.0),
        ..example()
    })
    .expect("a column on a plate is a scene")
}

/// Ten rows of thirteen beads.
fn lattice() -> Scene {
    Scene::new(Facts {
        arrangement: Arrangement::Lattice {
            columns: 13,
            tangential: 0.0,
        },
        n: 130,
        ..example()
    })
    .expect("whole rows are a lattice")
}

fn settings(pairs: &[(&str, &str)]) -> Vec<Setting> {
    let read = |&(name, value): &(&str, &str)| Setting::read(name, value).expect("a good setting");
    pairs.iter().map(read).collect()
}

fn layered(scene: &Scene, pairs: &[(&str, &str)]) -> Result<Scene, SceneError> {
    let mut draft = Draft::of(scene);
    draft.set(&settings(pairs))?;
    draft.finish()
}

/// The bits of a scene's amplitude.
fn amplitude(scene: &Scene) -> f64 {
    match scene.floor {
        Floor::Vibrating(Shake { amplitude, .. }) => amplitude,
        Floor::Fixed => f64::NAN,
    }
}

#[test]
fn every_row_gets_what_it_sets() {
    let timed = layered(
        &shaken().with_method(MethodName::Ed).expect("hard"),
        &[("rule", "tc"), ("contact_time", "1e-5")],
    )
    .expect("a TC scene");
    let power = layered(
        &example_scene()
            .with_method(MethodName::Exact)
            .expect("soft"),
        &[("law", "power"), ("beta", "0.5"), ("gamma", "0.5")],
    )
    .expect("a power law");
    let scenes = [example_scene(), shaken(), timed, power, lattice()];
    for parameter in table() {
        let scene = scenes
            .iter()
            .find(|scene| (parameter.get)(scene).is_some() && parameter.applies(scene))
            .or_else(|| scenes.iter().find(|scene| parameter.applies(scene)))
            .unwrap_or_else(|| panic!("no scene has {}", parameter.name));
        let before = (parameter.get)(scene).unwrap_or(Value::Number(1.0));
        for steps in [1, -1] {
            let wanted = nudge(parameter, before, steps, false);
            let mut facts = scene.facts().clone();
            (parameter.set)(&mut facts, wanted);
            let got = (parameter.get)(&facts).expect("it has a value now");
            match (wanted, got) {
                (Value::Number(a), Value::Number(b)) => {
                    assert!(
                        (a - b).abs() <= 1e-12 * a.abs(),
                        "{}: {a} {b}",
                        parameter.name
                    );
                }
                _ => assert_eq!(wanted, got, "{}", parameter.name),
            }
        }
        let moved = [1, -1].map(|steps| nudge(parameter, before, steps, false));
        assert!(
            moved.iter().any(|&to| to != before),
            "{} cannot be moved",
            parameter.name
        );
    }
}

#[test]
fn values_outside_the_range_are_refused_with_name_and_value() {
    for (name, text) in [
        ("restitution", "1.5"),
        ("restitution", "-0.1"),
        ("restitution", "NaN"),
        ("contact_time", "0"),
        ("contact_time", "inf"),
        ("contact_time", "1e999"),
        ("n", "0"),
        ("n", "1.5"),
        ("n", "-3"),
        ("seed", "9007199254740993"),
        ("jitter", "maybe"),
        ("floor_contact", "soft"),
        ("steps_per_contact", "1"),
    ] {
        let error = Setting::read(name, text).expect_err(text).to_string();
        assert!(
            error.starts_with(&format!("{name} = {text}: must be ")),
            "{error}"
        );
        assert_eq!(error.lines().count(), 1);
    }
}

#[test]
fn a_scene_is_refused_by_field_when_its_facts_do_not_go_together() {
    let resting = Facts {
        start: Start::Resting,
        ..example()
    };
    let plate = Floor::Vibrating(Shake {
        amplitude: 1e-3,
        frequency: 20.0,
    });
    let rising = Start::Launched(Launch {
        s0: 0.0,
        jitter: false,
        v0: 0.1,
    });
    for (facts, field) in [
        (resting, "start"),
        (
            Facts {
                floor: plate,
                ..example()
            },
            "floor",
        ),
        (
            Facts {
                start: rising,
                ..example()
            },
            "v0",
        ),
        (
            Facts {
                restitution: 0.0,
                ..example()
            },
            "restitution",
        ),
        (
            Facts {
                restitution: f64::NAN,
                ..example()
            },
            "restitution",
        ),
        (
            Facts {
                width: 1.98e-3,
                ..example()
            },
            "width",
        ),
        (Facts { n: 0, ..example() }, "n"),
        (
            Facts {
                gravity: Some(9.81),
                ..example()
            },
            "duration",
        ),
        (
            Facts {
                gravity: Some(f64::INFINITY),
                duration: Some(1.0),
                ..example()
            },
            "gravity",
        ),
        (
            Facts {
                diameter: 0.0,
                ..example()
            },
            "diameter",
        ),
        (
            Facts {
                duration: Some(0.0),
                ..example()
            },
            "duration",
        ),
    ] {
        let error = Scene::new(facts).expect_err(field);
        assert_eq!(error.parameter(), field, "{error}");
    }
}

#[test]
fn hard_spheres_may_be_totally_inelastic() {
    let hard = example_scene().with_method(MethodName::Ed).expect("hard");
    let dead = layered(&hard, &[("restitution", "0")]).expect("ED allows 0");
    let error = dead
        .with_method(MethodName::Gear)
        .expect_err("no contact time");
    assert_eq!(error.parameter(), "contact_time");
}

#[test]
fn a_parameter_that_the_scene_lacks_is_refused() {
    let fixed = example_scene();
    let hard = fixed.with_method(MethodName::Ed).expect("hard");
    for (scene, name, value) in [
        (&fixed, "amplitude", "1e-3"),
        (&fixed, "alpha", "2"),
        (&fixed, "gravity", "9.81"),
        (&fixed, "rule", "tc"),
        (&hard, "contact_time", "1e-5"),
        (&hard, "attraction", "false"),
        (&hard, "steps_per_contact", "50"),
        (&shaken(), "s0", "1e-6"),
        (&shaken(), "jitter", "true"),
    ] {
        let error = layered(scene, &[(name, value)]).expect_err(name);
        assert!(matches!(error, SceneError::Absent { .. }), "{error}");
        assert_eq!(error.parameter(), name);
    }
    // A run without gravity has no duration, but may be given one.
    assert_eq!(
        layered(&fixed, &[("duration", "2")]).map(|scene| scene.duration),
        Ok(Some(2.0))
    );
}

#[test]
fn alpha_uses_the_frequency_of_its_layer_in_any_order() {
    let one = layered(&shaken(), &[("alpha", "3"), ("frequency", "40")]).expect("in range");
    let two = layered(&shaken(), &[("frequency", "40"), ("alpha", "3")]).expect("in range");
    assert_eq!(one, two);
    let expected = 3.0 * 9.81 / (std::f64::consts::TAU * 40.0).powi(2);
    assert!((amplitude(&one) / expected - 1.0).abs() < 1e-14);
}

#[test]
fn editing_the_frequency_keeps_the_amplitude() {
    let edited = layered(&shaken(), &[("frequency", "30")]).expect("in range");
    assert_eq!(amplitude(&edited).to_bits(), amplitude(&shaken()).to_bits());
    let alpha = edited.alpha().expect("a plate") / shaken().alpha().expect("a plate");
    assert!((alpha - 2.25).abs() < 1e-12, "{alpha}");
}

#[test]
fn amplitude_and_alpha_together_and_an_endless_amplitude_are_refused() {
    let both = layered(&shaken(), &[("amplitude", "1e-3"), ("alpha", "2")]);
    assert_eq!(both.expect_err("both").parameter(), "alpha");
    let endless = layered(
        &shaken(),
        &[("alpha", "1e6"), ("gravity", "1e6"), ("frequency", "1e-3")],
    );
    let error = endless.expect_err("an amplitude of 1e16 m");
    assert_eq!(error.parameter(), "alpha");
    assert!(error.to_string().contains("gives the amplitude"), "{error}");
}

#[test]
fn the_tc_rule_asks_for_its_contact_time() {
    let hard = example_scene().with_method(MethodName::Ed).expect("hard");
    let error = layered(&hard, &[("rule", "tc")]).expect_err("no contact time");
    assert_eq!(
        error,
        SceneError::Missing {
            name: "contact_time",
            belongs_to: find("contact_time").expect("a row").belongs_to,
        }
    );
    let timed = layered(&hard, &[("contact_time", "1e-5"), ("rule", "tc")]).expect("complete");
    assert_eq!(timed.contact_time(), Some(1e-5));
}

#[test]
fn rows_and_columns_make_the_beads_in_any_order() {
    for pairs in [
        [("rows", "7"), ("columns", "5")],
        [("columns", "5"), ("rows", "7")],
    ] {
        let scene = layered(&lattice(), &pairs).expect("a lattice");
        assert_eq!((scene.n, scene.layers()), (35, 7));
    }
    let refused = |facts| Scene::new(facts).expect_err("no lattice");
    let whole = lattice().facts().clone();
    for (facts, name) in [
        (
            Facts {
                n: 131,
                ..whole.clone()
            },
            "rows",
        ),
        (
            Facts {
                width: 1e-4,
                ..whole.clone()
            },
            "width",
        ),
        (
            Facts {
                gravity: Some(9.81),
                duration: Some(1.0),
                ..whole
            },
            "gravity",
        ),
    ] {
        assert_eq!(refused(facts).parameter(), name);
    }
}
