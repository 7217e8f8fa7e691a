//! Values as people type them, and as keys move them.

use super::*;

#[test]
fn values_read_as_people_write_them() {
    for (name, value, expected, ascii) in [
        ("contact_time", 7e-6, "7.0 µs", "7.0 us"),
        ("contact_time", 0.7e-3, "700 µs", "700 us"),
        ("amplitude", 1.24e-3, "1.24 mm", "1.24 mm"),
        ("frequency", 20.0, "20 Hz", "20 Hz"),
        ("frequency", 1500.0, "1.5 kHz", "1.5 kHz"),
        ("restitution", 0.6, "0.60", "0.60"),
        ("restitution", 0.975, "0.975", "0.975"),
        ("restitution", 1.0, "1.0", "1.0"),
        ("restitution", 1e-5, "1.0e-5", "1.0e-5"),
        ("alpha", 1.996_04, "1.996", "1.996"),
        ("v0", -0.2, "-0.20 m/s", "-0.20 m/s"),
        ("gravity", 9.81, "9.81 m/s²", "9.81 m/s^2"),
        ("s0", 0.0, "0 m", "0 m"),
        ("s0", 9.9999e-7, "1.0 µm", "1.0 um"),
        ("duration", 2500.0, "2500 s", "2500 s"),
        ("steps_per_contact", 100.0, "100", "100"),
    ] {
        let parameter = find(name).expect("a row");
        assert_eq!(display(parameter, Value::Number(value)), expected);
        assert_eq!(display_ascii(parameter, Value::Number(value)), ascii);
    }
}

#[test]
fn what_is_shown_exactly_can_be_typed_back() {
    let parameter = find("contact_time").expect("a row");
    for x in [0.7e-5, 1e-12, 123.456, 1.0 / 3.0] {
        let typed = Value::Number(x).to_string();
        assert_eq!(parse(parameter, &typed), Ok(Value::Number(x)));
    }
}

#[test]
fn key_presses_move_by_steps_and_stop_at_the_ends() {
    let press = |name: &str, from: f64, steps, coarse| match nudge(
        find(name).expect("a row"),
        Value::Number(from),
        steps,
        coarse,
    ) {
        Value::Number(x) => x,
        other => panic!("{other:?}"),
    };
    let cases = [
        ("restitution", 0.6, 1, false, 0.61),
        ("restitution", 0.6, -7, true, 0.0),
        ("restitution", 0.95, 1, true, 1.0),
        ("contact_time", 7e-6, 1, false, 7.7e-6),
        ("contact_time", 7.7e-6, -1, false, 7e-6),
        ("contact_time", 7e-6, 2, true, 2.8e-5),
        ("s0", 0.0, 1, false, 1e-9),
        ("s0", 1e-9, -1, false, 0.0),
        ("v0", -0.01, 1, false, 0.0),
        ("steps_per_contact", 2.0, -1, true, 2.0),
    ];
    for (name, from, steps, coarse, to) in cases {
        let moved = press(name, from, steps, coarse);
        assert!(
            (moved - to).abs() <= 1e-12 * to.abs(),
            "{name} {from} {steps}: {moved}"
        );
    }
    let n = find("n").expect("a row");
    assert_eq!(nudge(n, Value::Whole(3), -1, true), Value::Whole(1));
    let floor = find("floor_contact").expect("a row");
    let word = Value::Choice("same-spring");
    assert_eq!(
        nudge(floor, word, 1, false),
        Value::Choice("same-restitution")
    );
    assert_eq!(nudge(floor, word, -2, false), word);
}
