//! A clone of an engine goes on with the same bits, whatever it carries.

use beadlab::physics::{Engine, State, build};
use beadlab::scene::preset::embedded;
use beadlab::scene::{MethodName, Preset, Scene};

/// How far the engines go, s: through a landing of a shaken column under all methods that
/// are fast, a part of it under those that step.
fn span(scene: &Scene) -> f64 {
    let long = if scene.grid().is_some() { 0.02 } else { 0.2 };
    scene.period().map_or(long, |period| long.min(2.0 * period))
}

/// Moves on by `pieces` of `piece` s, and says which state it comes to.
fn go_on(engine: &mut Box<dyn Engine>, from: f64, piece: f64, pieces: u32) -> State {
    for k in 1..=pieces {
        let until = from + f64::from(k) * piece;
        engine.advance(until, u64::MAX).expect("a sound run");
    }
    engine.state()
}

/// The scene with its plate shaken harder, or, on a fixed floor, with another restitution.
fn edited(scene: &Scene) -> Scene {
    let mut facts = scene.facts().clone();
    facts.restitution *= 0.875;
    if let Some(shake) = facts.shake_mut() {
        shake.amplitude *= 1.25;
    }
    Scene::new(facts).expect("a valid scene")
}

/// Presets under every method they may have, cloned on the way, before and after an edit (of
/// the plate too, whose new motion is still to come). The clone goes on in other pieces than
/// the original: its bits are the same all the same, so there is no tolerance.
#[test]
fn a_clone_goes_on_with_the_same_bits() {
    let methods = [
        MethodName::Gear,
        MethodName::Verlet,
        MethodName::Exact,
        MethodName::Ed,
    ];
    let mut cloned = 0;
    for (name, source) in embedded() {
        let preset = Preset::parse(name, source, name).expect("an embedded preset");
        for method in methods {
            let Ok(scene) = preset.scene.with_method(method) else {
                continue;
            };
            let case = format!("{name} {method:?}");
            let piece = span(&scene) / 8.0;
            let mut engine = build(&scene, None).0;
            for (part, scene) in [(0.0, edited(&scene)), (3.0, edited(&edited(&scene)))] {
                let start = part * piece;
                let half = go_on(&mut engine, start, piece, 1);
                let mut clone = engine.clone();
                let whole = go_on(&mut engine, start + piece, piece, 2);
                assert_ne!(half, whole, "{case}: nothing moves");
                let again = go_on(&mut clone, start + piece, piece / 4.0, 8);
                assert_eq!(again, whole, "{case} from {start} s");
                assert_eq!(again, clone.clone().state(), "{case}");
                engine = build(&scene, Some(&clone.state())).0;
                cloned += 1;
            }
        }
    }
    assert!(cloned > 100, "{cloned} clones");
}
