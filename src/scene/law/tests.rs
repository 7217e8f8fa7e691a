//! Changes from one law to another, against the paper's constants.

use super::*;

#[test]
fn laws_are_typed_as_they_are_called() {
    assert_eq!(LawName::ALL.map(LawName::as_str), LawName::WORDS);
}

#[test]
fn the_papers_linear_constants() {
    // Sec. IV B: K/m = 2e9 and D_n = 3.17e3 are ε = 0.800 and t_c = 7.0e-5 s.
    let law = PowerLaw {
        exponents: Exponents::Free {
            beta: 0.0,
            gamma: 0.0,
        },
        stiffness: 2e9,
        damping: 3.17e3,
    };
    let (restitution, contact_time) = law.hooke(0.05);
    assert!((restitution - 0.800).abs() < 5e-4, "{restitution}");
    assert!((contact_time - 7.0e-5).abs() < 5e-7, "{contact_time}");
}

#[test]
fn a_change_of_law_and_back_is_none() {
    for (restitution, contact_time) in [(0.9, 7e-6), (0.6, 0.7e-3), (0.05, 1e-9)] {
        let linear = PowerLaw::linear(restitution, contact_time);
        for exponents in [
            Exponents::Hertz,
            Exponents::HertzKuwabaraKono,
            Exponents::Taguchi,
            Exponents::Free {
                beta: 1.5,
                gamma: 2.0,
            },
        ] {
            let there = linear.like(exponents, 0.2);
            let depth = there.penetration(0.2) / linear.penetration(0.2);
            assert!((depth - 1.0).abs() < 1e-10, "{depth}");
            // Twelve digits survive, less the conditioning of ε ≪ 1.
            let (e, t) = there.hooke(0.2);
            assert!((e / restitution - 1.0).abs() < 1e-10, "{e}");
            assert!((t / contact_time - 1.0).abs() < 1e-10, "{t}");
        }
    }
}

#[test]
fn too_much_damping_for_a_rebound_becomes_the_least_one() {
    let law = PowerLaw {
        exponents: Exponents::Hertz,
        stiffness: 2e12,
        damping: 1e9,
    };
    let (restitution, contact_time) = law.hooke(0.05);
    assert!((restitution / FEEBLEST - 1.0).abs() < 1e-9);
    assert!(contact_time > 0.0 && contact_time.is_finite());
}
