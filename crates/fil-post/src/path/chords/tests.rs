use proptest::prelude::*;

use nalgebra::Vector3;

use super::*;
use crate::path::trial::post;

proptest! {
    /// No line leaves its arc by more than the tolerance, and fewer lines would.
    #[test]
    fn chords_keep_within_the_tolerance(
        radius in 0.5..400.0, sweep in 1.0..720.0, rise in -50.0..50.0, tolerance in 0.001..0.1,
    ) {
        let mut post = post(&[("circle.chord_tolerance", tolerance)]);
        let start = Point3::new(radius, 0.0, 0.0);
        post.path.point = Some(start);
        let (sine, cosine) = libm::sincos(f64::to_radians(sweep));
        let end = Point3::new(radius * cosine, radius * sine, rise);
        let cause = crate::cause::Cause::default();
        let turns = (sweep / 360.0_f64).floor();
        let (center, axis) = (Point3::origin(), Vector3::z());
        let arc = Arc { center, axis, radius: None, turns, line: 1, cause };
        let target = Target { point: end, axis, word: 0 };
        let chords = Chords::new(&post, &arc, start, sweep, target).unwrap();
        let height = |count: u32| {
            radius * (1.0 - libm::cos((sweep / f64::from(count) / 2.0).to_radians()))
        };
        prop_assert!(height(chords.count) <= tolerance + 1e-9, "{}", height(chords.count));
        let is_least = chords.count == 1 || height(chords.count - 1) > tolerance - 1e-9;
        let is_finest = sweep / f64::from(chords.count) <= FINEST + 1e-9;
        prop_assert!(is_least || is_finest, "{} lines", chords.count);
        for number in 0..=chords.count {
            let share = f64::from(number) / f64::from(chords.count);
            let at = chords.at(share).point;
            prop_assert!((libm::hypot(at.x, at.y) - radius).abs() < 1e-9 * radius.max(1.0));
            prop_assert!((at.z - rise * share).abs() < 1e-9);
        }
    }
}
