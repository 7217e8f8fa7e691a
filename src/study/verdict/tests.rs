use super::twins::columns;
use super::*;
use crate::scene::Preset;
use std::ops::ControlFlow;

fn preset(name: &str) -> Scene {
    Preset::load(name).expect("the preset is embedded").scene
}

fn mean(value: f64, error: f64) -> Mean {
    Mean {
        value,
        error: Some(error),
    }
}

/// E_r/E of 0.40 and `hard` with such errors, and equal rises known to `rise` of them.
fn pair(hard: f64, error: f64, rise: f64) -> [Compared; 2] {
    [
        Compared::energy_share(mean(0.4, error), mean(hard, 0.0)),
        Compared::rise(mean(1.0, rise), mean(1.0, 0.0), 0.1),
    ]
}

#[test]
fn a_word_is_clear_of_its_limits_by_two_errors() {
    // δ = 0.01, 0.15 and 0.75; the limits are at 0.05 and 0.5.
    for (hard, error, word) in [
        (0.396, 0.004, Some(Word::Agreement)),
        (0.396, 0.012, None),
        (0.34, 0.016, Some(Word::Crossover)),
        (0.34, 0.024, None),
        (0.1, 0.04, Some(Word::Detachment)),
        (0.1, 0.06, None),
    ] {
        assert_eq!(
            decide(&pair(hard, error, 0.01), SURE),
            word,
            "{hard} {error}"
        );
    }
    // A rise that is hardly known proves nothing.
    assert_eq!(decide(&pair(0.396, 0.004, 0.1), SURE), None);
    // One that differs for sure refuses.
    let mut lower = pair(0.396, 0.004, 0.01);
    lower[1].hard = 0.9;
    assert_eq!(decide(&lower, SURE), Some(Word::Crossover));
    lower[1].hard = 0.4;
    assert_eq!(decide(&lower, SURE), Some(Word::Detachment));
}

#[test]
fn what_is_small_in_both_agrees() {
    for both in [[1e-12, 0.0], [0.009, 0.0], [1.0, 0.96]] {
        let compared = [Compared::eps_eff("eps_eff", both)];
        assert_eq!(decide(&compared, SURE), Some(Word::Agreement), "{both:?}");
    }
    // Nearly all is kept, but hard spheres lose six times as much.
    let both = [0.992, 0.95];
    let compared = [Compared::eps_eff("eps_eff", both), Compared::loss(both)];
    assert_eq!(decide(&compared, SURE), Some(Word::Crossover));
}

/// What has been seen of a motion for 5 s never says otherwise than what has been seen
/// for longer, up to a minute, and says it then.
fn is_steady(name: &str, word: Word) {
    let watch = &mut |_| ControlFlow::Continue(());
    let [mut soft, mut hard] = columns(&preset(name), u64::MAX).expect("both can be had");
    let mut said = Vec::new();
    for periods in (100..=1200).step_by(50) {
        let followed = soft.follow(periods, watch).is_ok() && hard.follow(periods, watch).is_ok();
        assert!(followed, "{name}: no end of {periods} periods");
        let Preset { scene, .. } = Preset::load(name).expect("embedded");
        let crate::scene::Floor::Vibrating(crate::scene::Shake { amplitude, .. }) = scene.floor
        else {
            panic!("{name} stands on a plate");
        };
        let Ok(compared) = soft.means(&hard, amplitude) else {
            panic!("{name}: no means of {periods} periods");
        };
        said.extend(decide(&compared, SURE).map(|word| (periods, word)));
    }
    assert!(
        said.iter().all(|(_, said)| *said == word),
        "{name}: {said:?}"
    );
    let last = said.last().map(|(periods, _)| *periods);
    assert_eq!(last, Some(1200), "{name}: {said:?}");
}

#[test]
fn steady_from_five_seconds_to_a_minute() {
    is_steady("fig5a", Word::Detachment);
    is_steady("fig5b", Word::Detachment);
    is_steady("steel", Word::Crossover);
    is_steady("fig7-md", Word::Agreement);
}

#[test]
fn who_looks_on_may_stop_it() {
    let mut looks = 0;
    let mut watch = |_| {
        looks += 1;
        if looks < 100 {
            ControlFlow::Continue(())
        } else {
            ControlFlow::Break(())
        }
    };
    assert!(verdict(&preset("fig5b"), &mut watch).is_err());
    assert_eq!(looks, 100);
}

#[test]
fn without_a_twin_the_landings_decide() {
    let watch = &mut |_| ControlFlow::Continue(());
    for (name, word) in [
        ("fig5b", Word::Detachment),
        ("fig5a", Word::Detachment),
        // Its soft column lands loosely: what parts it from hard spheres σ does not show.
        ("steel", Word::Agreement),
    ] {
        let [mut soft, _] = columns(&preset(name), u64::MAX).expect("both can be had");
        assert!(soft.follow(200, watch).is_ok());
        let judged = soft.by_landings("hard spheres take too much work");
        assert_eq!(judged.word, Some(word), "{name}: {}", judged.because);
        assert!(
            judged.because.starts_with("by sigma alone"),
            "{}",
            judged.because
        );
    }
}
