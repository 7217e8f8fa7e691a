//! Edits of the contact law.

use super::*;

#[test]
fn a_power_law_replaces_what_the_linear_law_has() {
    for method in MethodName::ALL {
        let Ok(scene) = example_scene().with_method(method) else {
            panic!("every method has a scene")
        };
        let edited = layered(&scene, &[("law", "hertz")]);
        if method == MethodName::Ed {
            assert_eq!(edited.expect_err("hard").parameter(), "law");
            continue;
        }
        let hertz = edited.expect("a working scene");
        assert_eq!(hertz.method.name(), method);
        let has = |name: &str| (find(name).expect("a row").get)(&hertz).is_some();
        for name in ["stiffness", "damping", "attraction"] {
            assert!(has(name), "{name}");
        }
        for name in ["restitution", "contact_time", "beta", "gamma"] {
            assert!(!has(name), "{name}");
        }
        assert_eq!(has("tolerance"), method == MethodName::Exact);
        // The column's own t_c and ε stay near those of the linear law that it replaces,
        // and the hard twin has them.
        let contact_time = hertz.contact_time().expect("soft");
        assert!((contact_time / 7e-6 - 1.0).abs() < 0.1, "{contact_time}");
        assert!((hertz.restitution - 0.9).abs() < 0.02);
        let hard = hertz.with_method(MethodName::Ed).expect("a hard twin");
        assert_eq!(hard.restitution, hertz.restitution);
        // There and back again.
        let back = layered(&hertz, &[("law", "hooke")]).expect("linear");
        assert_eq!(back.method.name(), method);
        assert!((back.restitution - 0.9).abs() < 1e-10);
        assert!((back.contact_time().expect("soft") / 7e-6 - 1.0).abs() < 1e-10);
    }
}

#[test]
fn stiffness_and_damping_override_what_a_change_of_law_chooses() {
    let settings = [("damping", "2e3"), ("stiffness", "2e12"), ("law", "hertz")];
    let scene = layered(&example_scene(), &settings).expect("a power law");
    let Some(crate::scene::Law::Power(law)) = scene.law() else {
        panic!("a power law")
    };
    assert_eq!((law.stiffness, law.damping), (2e12, 2e3));
    // A stiffness that belongs to another law is refused with the time it gives.
    let settings = [("law", "hertz"), ("stiffness", "1e-9")];
    let error = layered(&example_scene(), &settings).expect_err("too soft");
    assert_eq!(error.parameter(), "stiffness");
    assert!(error.to_string().contains("last"), "{error}");
}

#[test]
fn free_exponents_keep_the_collision_alike() {
    let scene = layered(&example_scene(), &[("law", "power")]).expect("a power law");
    let before = scene.contact_time().expect("soft");
    assert!((scene.restitution - 0.9).abs() < 1e-9);
    for (name, value) in [("beta", "0.5"), ("gamma", "1.25"), ("beta", "3")] {
        let edited = layered(&scene, &[(name, value)]).expect("in range");
        let after = edited.contact_time().expect("soft");
        // I(β) falls from π to 2 as β grows; the depth stays.
        assert!(after / before > 2.0 / 3.2 && after / before <= 1.0 + 1e-10);
        assert!(
            (edited.restitution - 0.9).abs() < 0.1,
            "{}",
            edited.restitution
        );
    }
}
