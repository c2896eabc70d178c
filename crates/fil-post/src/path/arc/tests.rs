use proptest::prelude::*;

use super::*;

fn about_z(turns: f64) -> Arc {
    let cause = crate::cause::Cause::default();
    Arc { center: Point3::origin(), axis: Vector3::z(), radius: None, turns, line: 1, cause }
}

fn at(radius: f64, degrees: f64) -> Vector3<f64> {
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    Vector3::new(radius * cosine, radius * sine, 0.0)
}

proptest! {
    /// An arc turns by the right-hand rule from its start to its end, and its whole turns on top.
    #[test]
    fn the_sweep_is_the_angle_from_start_to_end(
        radius in 0.5..500.0, start in -180.0..180.0, angle in 0.1..359.9_f64, turns in 0u32..5,
    ) {
        let ends = [at(radius, start), at(radius, start + angle)];
        let found = sweep(&about_z(f64::from(turns)), ends);
        prop_assert!((found - angle - 360.0 * f64::from(turns)).abs() < 1e-6, "{found}");
    }

    /// A point of the axis and the level of a point count for nothing in the vector from the axis.
    #[test]
    fn the_vector_from_the_axis_is_square_to_it(
        axis in [-1.0..1.0, -1.0..1.0, 0.1..1.0], point in [-9.0..9.0, -9.0..9.0, -9.0..9.0],
        rise in -9.0..9.0,
    ) {
        let axis = Vector3::from(axis).normalize();
        let arc = Arc { axis, ..about_z(0.0) };
        let point = Point3::from(point);
        let from = flat(&arc, point);
        prop_assert!(from.dot(&axis).abs() < 1e-9);
        prop_assert!((flat(&arc, point + axis * rise) - from).norm() < 1e-9);
    }
}

#[test]
fn a_start_above_the_end_is_one_turn_or_those_asked_for() {
    let ends = [at(10.0, 30.0), at(10.0, 30.0)];
    assert_eq!(sweep(&about_z(0.0), ends), 360.0);
    assert!((sweep(&about_z(2.0), ends) - 720.0).abs() < 1e-9);
}

#[test]
fn radii_that_disagree_are_refused() {
    let ends = [at(10.0, 0.0), at(10.0005, 90.0)];
    assert_eq!(check_radii(&about_z(0.0), ends).unwrap(), 10.0);
    let ends = [at(10.0, 0.0), at(10.01, 90.0)];
    assert_eq!(check_radii(&about_z(0.0), ends).unwrap_err().code.name(), "E0504");
}
