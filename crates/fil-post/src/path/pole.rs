//! How far the tool leans out of the plane of its ends while the rotary axes turn: most near a pole.

use fil_machine::axis_chain::AxisChain;
use nalgebra::Vector3;

/// Points between the ends at which the tool is looked at.
pub(super) const SAMPLES: u32 = 32;

/// Positions of a rotary axis nearer than this are one, degrees.
const SAME: f64 = 1e-6;

/// True for other positions of the rotary axes.
pub(super) fn apart(a: [f64; 2], b: [f64; 2]) -> bool {
    a.iter().zip(b).any(|(a, b)| (a - b).abs() > SAME)
}

/// Two positions of rotary axes in a message.
pub(super) fn spelled(angles: [f64; 2]) -> String {
    format!("{:.3}/{:.3}", angles[0], angles[1])
}

/// An angle that the tool can't lean out of the plane of its ends, degrees: it bends no more
/// than as if both axes turned it about one line, and a curve lies no farther from its chord
/// than an eighth of the most that it bends.
pub(super) fn most_off_its_plane(from: [f64; 2], to: [f64; 2]) -> f64 {
    let turned = (0..2).map(|n| (to[n] - from[n]).abs().to_radians()).sum::<f64>();
    let apart = turned * turned / 8.0;
    if apart < 1.0 { libm::asin(apart).to_degrees() } else { 180.0 }
}

/// The largest angle between the tool and the way that turns it straight from one end to
/// the other, degrees, while the rotary axes go evenly.
pub(super) fn off_its_plane(chain: &AxisChain, from: [f64; 2], to: [f64; 2]) -> f64 {
    let [first, last] = [from, to].map(|angles| chain.axis_at(angles));
    (1..SAMPLES)
        .map(|number| {
            let share = f64::from(number) / f64::from(SAMPLES);
            let angles = [0, 1].map(|n| from[n] + (to[n] - from[n]) * share);
            off_the_way(first, last, chain.axis_at(angles))
        })
        .fold(0.0, f64::max)
}

/// The angle between a direction and the nearest one on the shorter turn from one to
/// another, degrees.
fn off_the_way(from: Vector3<f64>, to: Vector3<f64>, at: Vector3<f64>) -> f64 {
    let nearer = || from.angle(&at).min(to.angle(&at)).to_degrees();
    let normal = from.cross(&to);
    let Some(normal) = normal.try_normalize(1e-9) else { return nearer() };
    let foot = at - normal * normal.dot(&at);
    let between = from.cross(&foot).dot(&normal) >= 0.0 && foot.cross(&to).dot(&normal) >= 0.0;
    if !between {
        return nearer();
    }
    libm::asin(normal.dot(&at).abs().min(1.0)).to_degrees()
}

#[cfg(test)]
mod tests {
    use fil_machine::axis_chain::{Carries, ROTARY_LETTERS, Rotary};
    use fil_machine::zones::Zones;
    use nalgebra::{Point3, Unit};

    use super::*;

    proptest::proptest! {
        #[test]
        fn no_way_leaves_its_plane_by_more_than_the_bound(
            first in [-1f64..1.0, -1f64..1.0, 0.1f64..1.0],
            second in [-1f64..1.0, -1f64..1.0, 0.1f64..1.0],
            from in [-180f64..180.0, -180f64..180.0], turn in [-80f64..80.0, -80f64..80.0],
        ) {
            let rotary = |direction: [f64; 3]| Rotary {
                carries: Carries::Table,
                direction: Unit::new_normalize(Vector3::from(direction)),
                center: Point3::origin(),
                letter: ROTARY_LETTERS[0],
                axis: 0,
                min: None,
                max: None,
                zones: Zones::default(),
            };
            let rotaries = [first, second].map(|direction| Some(rotary(direction)));
            let chain = AxisChain { rotaries, ..AxisChain::default() };
            let to = [from[0] + turn[0], from[1] + turn[1]];
            let (off, most) = (off_its_plane(&chain, from, to), most_off_its_plane(from, to));
            proptest::prop_assert!(off <= most + 1e-6, "{} {}", off, most);
        }
    }

    #[test]
    fn a_direction_beside_the_way_is_as_far_as_its_nearest_point() {
        let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
        assert!((off_the_way(x, y, z) - 90.0).abs() < 1e-9);
        assert!(off_the_way(x, y, (x + y).normalize()) < 1e-9);
        assert!((off_the_way(x, y, (x - y).normalize()) - 45.0).abs() < 1e-9);
        assert!((off_the_way(z, z, (x + z).normalize()) - 45.0).abs() < 1e-9);
        let leaning = (x + y).normalize() * 0.8 + z * 0.6;
        assert!((off_the_way(x, y, leaning) - libm::asin(0.6).to_degrees()).abs() < 1e-9);
    }
}
