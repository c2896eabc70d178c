use fil_machine::modes::Plane;
use proptest::prelude::*;

use super::*;
use crate::cause::Cause;
use crate::path::trial::post;

/// An arc in X and Y that rises in Z.
fn plane_arc(
    center: [f64; 2],
    radius: f64,
    angle: f64,
    sweep: f64,
    ccw: bool,
    z: [f64; 2],
) -> PlaneArc {
    let at = |degrees: f64| {
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        [center[0] + radius * cosine, center[1] + radius * sine]
    };
    let end = at(angle + if ccw { sweep } else { -sweep });
    let start = at(angle);
    PlaneArc {
        plane: Plane::Xy,
        counterclockwise: ccw,
        center,
        start,
        radius,
        from: [start[0], start[1], z[0], 0.0, 0.0],
        to: [end[0], end[1], z[1], 0.0, 0.0],
        sweep,
        word: 6,
        cause: Cause::default(),
    }
}

proptest! {
    /// The parts of an arc begin where the one before has ended, on its circle, and turn as far
    /// together as the whole.
    #[test]
    fn parts_join_to_the_whole(
        center in [-200.0..200.0, -200.0..200.0], radius in 1.0..300.0, angle in -180.0..180.0,
        sweep in 1.0..1080.0, ccw in any::<bool>(), z in [-50.0..50.0, -50.0..50.0],
    ) {
        let post = post(&[]);
        let whole = plane_arc(center, radius, angle, sweep, ccw, z);
        for (step, most) in [(Step::Turns, 360.0), (Step::Halves, 180.0), (Step::Quadrants, 90.0)] {
            let least = least_angle(&post.control, &whole);
            let mut parts = Parts::new(&whole, step, least);
            let (mut at, mut done) = (whole.from, 0.0);
            while let Some(part) = parts.next(&post.control).unwrap() {
                prop_assert_eq!(part.from, at);
                prop_assert!(part.sweep > 0.0 && part.sweep <= most + least + 1e-9, "{}", part.sweep);
                let off = libm::hypot(part.to[0] - center[0], part.to[1] - center[1]) - radius;
                prop_assert!(off.abs() < 1e-9 * (1.0 + radius));
                done += part.sweep;
                let rise = z[0] + (z[1] - z[0]) * done / sweep;
                prop_assert!((part.to[2] - rise).abs() < 1e-9, "{} for {rise}", part.to[2]);
                // The word of the record's point is that of the last part alone.
                prop_assert_eq!(part.word != 0, (done - sweep).abs() < 1e-9);
                at = part.to;
            }
            prop_assert_eq!(at, whole.to);
            prop_assert!((done - sweep).abs() < 1e-9);
        }
    }
}
