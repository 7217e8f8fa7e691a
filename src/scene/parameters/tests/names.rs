//! Names and values as the screen shows them.

use super::*;

#[test]
fn no_name_means_two_parameters() {
    for parameter in table() {
        for name in parameter.names() {
            let meant = called(name).expect("a parameter");
            assert_eq!(meant.name, parameter.name, "{name}");
            // A name with an = or a : could be typed nowhere.
            assert!(!name.contains(['=', ':', ',', ' ']), "{name}");
        }
        let spaced = parameter.name.replace('_', " ");
        assert_eq!(called(&spaced).map(|p| p.name), Some(parameter.name));
    }
}

#[test]
fn people_and_the_paper_call_them_so() {
    for (name, meant) in [
        ("t_c", "contact_time"),
        ("tc", "contact_time"),
        ("ε", "restitution"),
        ("eps", "restitution"),
        ("epsilon", "restitution"),
        ("A", "amplitude"),
        ("A_0", "amplitude"),
        ("f", "frequency"),
        ("N", "n"),
        ("n", "n"),
        ("α", "alpha"),
        ("β", "beta"),
        ("h", "rows"),
        ("T", "duration"),
        ("steps per contact", "steps_per_contact"),
    ] {
        assert_eq!(named(name).map(|p| p.name), Ok(meant), "{name}");
    }
    for (slip, hint) in [
        ("T_C", "did you mean t_c?"),
        ("EPS", "did you mean eps?"),
        ("F", "did you mean f?"),
        ("contact-time", "did you mean contact_time?"),
        ("", "there are n, rows"),
        ("a", "did you mean A?"),
        ("colour", "there are n, rows"),
    ] {
        let error = named(slip).expect_err(slip).to_string();
        assert!(error.contains(hint), "{error}");
    }
}

#[test]
fn what_the_screen_shows_can_be_typed_back() {
    for parameter in table() {
        let values: Vec<Value> = match parameter.kind {
            Kind::Number { min, max, .. } => {
                let decades = (-40..=40).map(|k| 10f64.powf(f64::from(k) / 2.0));
                let numbers = decades.flat_map(|x| [x, -x, 1.234_567 * x, 0.999_96 * x, 0.0]);
                let ends = [min, max].into_iter();
                let inside = numbers.chain(ends).filter(|x| (min..=max).contains(x));
                inside.map(Value::Number).collect()
            }
            Kind::Whole { min, max, .. } => vec![Value::Whole(min), Value::Whole(max)],
            Kind::Flag => vec![Value::Flag(true), Value::Flag(false)],
            Kind::Choice(words) => words.iter().map(|word| Value::Choice(word)).collect(),
        };
        assert!(values.len() > 1, "{}", parameter.name);
        for value in values {
            for shown in [display(parameter, value), display_ascii(parameter, value)] {
                // Rounding to four digits may lead beyond the range, by as little.
                let Ok(typed) = parse(parameter, &shown) else {
                    let Value::Number(x) = value else {
                        panic!("{} {shown}", parameter.name)
                    };
                    assert!(!parameter.allows(Value::Number(x * 1.000_5)), "{shown}");
                    continue;
                };
                match (value, typed) {
                    (Value::Number(x), Value::Number(y)) => {
                        assert!((x - y).abs() <= 5e-4 * x.abs(), "{shown} for {x}: {y}");
                    }
                    _ => assert_eq!(value, typed, "{shown}"),
                }
                let again = [display(parameter, typed), display_ascii(parameter, typed)];
                assert!(again.contains(&shown), "{shown}: {again:?}");
            }
        }
    }
}

#[test]
fn a_number_with_a_unit_has_the_bits_of_one_in_si() {
    for (name, typed, si) in [
        ("contact_time", "4.6us", "4.6e-6"),
        ("contact_time", "4.6 µs", "4.6e-6"),
        ("contact_time", "4.6μs", "4.6e-6"),
        ("contact_time", "+4.6e0us", "4.6e-6"),
        ("contact_time", "0.7ms", "7e-4"),
        ("contact_time", ".7E+1 ns", "7e-9"),
        ("contact_time", "3.ps", "3e-12"),
        ("contact_time", "0.3s", "0.3"),
        ("amplitude", "2mm", "2e-3"),
        ("amplitude", "1.24mm", "1.24e-3"),
        ("amplitude", "2 m", "2"),
        ("s0", "10um", "1e-5"),
        ("s0", "3 nm", "3e-9"),
        ("frequency", "30Hz", "30"),
        ("frequency", "1.7kHz", "1700"),
        ("frequency", "5 mHz", "5e-3"),
        ("gravity", "9.81 m/s²", "9.81"),
        ("gravity", "9.81m/s^2", "9.81"),
        ("v0", "-.2m/s", "-0.2"),
        ("restitution", ".8", "0.8"),
        ("n", "1e3", "1000"),
        ("n", "20.0", "20"),
        ("n", "+20", "20"),
        ("seed", "1e15", "1000000000000000"),
    ] {
        let parameter = find(name).expect("a row");
        let value = match parameter.kind {
            Kind::Whole { .. } => Value::Whole(si.parse().expect("whole")),
            _ => Value::Number(si.parse().expect("a number")),
        };
        assert_eq!(parse(parameter, typed), Ok(value), "{name} {typed}");
    }
}

#[test]
fn a_unit_of_something_else_is_refused_with_those_allowed() {
    for (name, typed, allowed) in [
        ("contact_time", "4mm", "in s, ms, us, ns or ps, not in mm"),
        ("contact_time", "4 ks", "in s, ms, us, ns or ps, not in ks"),
        ("contact_time", "4e", "in s, ms, us, ns or ps, not in e"),
        ("amplitude", "2 us", "in m, mm, um, nm or pm, not in us"),
        ("frequency", "20hz", "in MHz, kHz, Hz or mHz, not in hz"),
        ("v0", "-20mm/s", "in m/s, not in mm/s"),
        (
            "n",
            "20mm",
            "a whole number from 1 to 1000000, without a unit",
        ),
        ("alpha", "2m", "a number from 0 to 1e6, without a unit"),
    ] {
        let error = parse(find(name).expect("a row"), typed).expect_err(typed);
        assert!(matches!(error, SceneError::Unit { .. }), "{error:?}");
        assert_eq!(
            error.to_string(),
            format!("{name} = {typed}: must be {allowed}")
        );
    }
    for (name, typed) in [
        ("contact_time", "us"),
        ("contact_time", "0us"),
        ("contact_time", "-1us"),
        ("contact_time", "1e400us"),
        ("contact_time", "1e99999999999us"),
        ("contact_time", "4.6 7us"),
        ("contact_time", "1.2.3"),
        ("contact_time", "e5"),
        ("contact_time", "."),
        ("contact_time", "-"),
        ("amplitude", "inf m"),
        ("amplitude", "nan"),
        ("n", "1e7"),
        ("n", "2.5"),
        ("n", "-1e3"),
        ("n", "1e-3"),
        ("seed", "9007199254740993.0"),
    ] {
        let error = parse(find(name).expect("a row"), typed).expect_err(typed);
        assert!(matches!(error, SceneError::Invalid { .. }), "{error:?}");
        let start = format!("{name} = {typed}: must be a ");
        assert!(error.to_string().starts_with(&start), "{error}");
    }
}
