use super::*;

fn call(name: &str, arguments: &[f64]) -> Option<f64> {
    match BUILTINS[find(name).unwrap()].kind {
        Numbers(_, body) | Fold(body) => body(arguments).filter(|value| value.is_finite()),
        _ => panic!("{name} is not a function of numbers"),
    }
}

#[test]
fn no_name_stands_twice() {
    for (index, builtin) in BUILTINS.iter().enumerate() {
        let first = BUILTINS.iter().position(|other| other.name == builtin.name);
        assert_eq!(first, Some(index));
    }
}

#[test]
fn angles_are_degrees_and_round_angles_are_exact() {
    for (angle, sine) in [
        (0.0, 0.0),
        (30.0, 0.5),
        (90.0, 1.0),
        (150.0, 0.5),
        (180.0, 0.0),
        (210.0, -0.5),
        (270.0, -1.0),
        (360.0, 0.0),
        (-30.0, -0.5),
        (-90.0, -1.0),
        (390.0, 0.5),
    ] {
        assert_eq!(call("SINF", &[angle]), Some(sine), "SINF({angle})");
        assert_eq!(call("COSF", &[angle - 90.0]), Some(sine), "COSF({angle} - 90)");
    }
    assert_eq!(call("TANF", &[45.0]), Some(1.0));
    assert_eq!(call("ATANF", &[1.0]), Some(45.0));
    assert_eq!(call("ATAN2F", &[1.0, -1.0]), Some(135.0));
}

#[test]
fn outside_of_the_domain_there_is_no_value() {
    assert_eq!(call("SQRTF", &[-1.0]), None);
    assert_eq!(call("LOGF", &[0.0]), None);
    assert_eq!(call("TANF", &[90.0]), None);
    assert_eq!(call("ASINF", &[1.1]), None);
    assert_eq!(call("MODF", &[1.0, 0.0]), None);
    assert_eq!(call("ATAN2F", &[0.0, 0.0]), None);
    assert_eq!(call("EXPF", &[1000.0]), None);
}
