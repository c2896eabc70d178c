//! Rotation about an axis: a vector turned, and the angle that takes one direction to another.
//!
//! Nearly each rotary axis lies along X, Y or Z. About such an axis a rotation changes two
//! coordinates alone, which takes a fraction of the general product and gives the same values.

use nalgebra::{Rotation3, Unit, Vector3};

/// Directions closer than this (radians, about 0.0006 degrees) count as equal.
pub(crate) const SAME: f64 = 1e-5;

/// A vector turned about a direction by an angle, degrees, by the right-hand rule.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(crate) fn turned(
    about: Unit<Vector3<f64>>,
    vector: Vector3<f64>,
    degrees: f64,
) -> Vector3<f64> {
    let Some((line, sign)) = Line::of(about) else { return turned_aslant(about, vector, degrees) };
    let (sine, cosine) = libm::sincos(degrees.to_radians());
    let sine = sign * sine;
    let [along, first, second] = line.seen(vector);
    line.back([along, cosine * first - sine * second, sine * first + cosine * second])
}

#[inline(never)]
fn turned_aslant(about: Unit<Vector3<f64>>, vector: Vector3<f64>, degrees: f64) -> Vector3<f64> {
    // The product row by row: the general one of matrices takes several times as long.
    let m = Rotation3::from_axis_angle(&about, degrees.to_radians()).into_inner();
    let row = |n: usize| m[(n, 0)] * vector.x + m[(n, 1)] * vector.y + m[(n, 2)] * vector.z;
    Vector3::new(row(0), row(1), row(2))
}

/// Angle in degrees of the rotation about `about` that takes the direction `from`, of length
/// 1, to that of `to`, of any length but 0; `free` when both lie along the axis, `None` when
/// impossible: they must be as far from the axis as each other, which near it their cosines
/// hardly tell.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(crate) fn turn(
    about: Unit<Vector3<f64>>,
    from: Vector3<f64>,
    to: Vector3<f64>,
    free: f64,
) -> Option<f64> {
    let Some((line, sign)) = Line::of(about) else { return turn_aslant(about, from, to, free) };
    let [[along_from, x, y], [along_to, u, v]] = [line.seen(from), line.seen(to)];
    let length = to.norm();
    let to = Distances { along: along_to, square: u * u + v * v };
    let from = Distances { along: along_from, square: x * x + y * y }.times(length);
    angle([from, to], length, [sign * (x * v - y * u), x * u + y * v], free)
}

#[inline(never)]
fn turn_aslant(
    about: Unit<Vector3<f64>>,
    from: Vector3<f64>,
    to: Vector3<f64>,
    free: f64,
) -> Option<f64> {
    let (along_from, along_to) = (about.dot(&from), about.dot(&to));
    let (flat_from, flat_to) = (from - about.scale(along_from), to - about.scale(along_to));
    let sine = about.dot(&flat_from.cross(&flat_to));
    let length = to.norm();
    let to = Distances { along: along_to, square: flat_to.norm_squared() };
    let from = Distances { along: along_from, square: flat_from.norm_squared() }.times(length);
    angle([from, to], length, [sine, flat_from.dot(&flat_to)], free)
}

/// Where the end of a direction lies beside an axis.
#[derive(Clone, Copy)]
struct Distances {
    /// Along the axis.
    along: f64,
    /// Square of the distance from it.
    square: f64,
}

impl Distances {
    /// Those of a direction, for a vector of a length along it. No angle waits for the length,
    /// as it would for a vector brought to length 1.
    #[inline]
    fn times(self, length: f64) -> Self {
        Distances { along: self.along * length, square: self.square * (length * length) }
    }
}

/// The same for two vectors of one length, from the sine and cosine between them, to one scale.
#[inline]
fn angle(
    [from, to]: [Distances; 2],
    length: f64,
    [sine, cosine]: [f64; 2],
    free: f64,
) -> Option<f64> {
    let same = SAME * length;
    let apart = from.square - to.square;
    if (from.along - to.along).abs() > same
        || apart * apart > same * same * (from.square + to.square)
    {
        return None;
    }
    if from.square < same * same || to.square < same * same {
        return Some(free);
    }
    // A half turn is one of 180 degrees, whatever sign a zero has.
    Some(libm::atan2(sine + 0.0, cosine).to_degrees())
}

/// The line through X, Y or Z.
#[derive(Clone, Copy)]
enum Line {
    X,
    Y,
    Z,
}

impl Line {
    /// The line of a direction, and the direction's sign on it; `None` for one aslant.
    #[inline]
    fn of(direction: Unit<Vector3<f64>>) -> Option<(Self, f64)> {
        let along = *direction;
        match [along.x != 0.0, along.y != 0.0, along.z != 0.0] {
            [true, false, false] => Some((Line::X, along.x)),
            [false, true, false] => Some((Line::Y, along.y)),
            [false, false, true] => Some((Line::Z, along.z)),
            _ => None,
        }
    }

    /// The coordinates of a vector along the line, and across it: the next two in turn.
    #[inline]
    fn seen(self, vector: Vector3<f64>) -> [f64; 3] {
        match self {
            Line::X => [vector.x, vector.y, vector.z],
            Line::Y => [vector.y, vector.z, vector.x],
            Line::Z => [vector.z, vector.x, vector.y],
        }
    }

    /// What [`Line::seen`] undoes.
    #[inline]
    fn back(self, [along, first, second]: [f64; 3]) -> Vector3<f64> {
        match self {
            Line::X => Vector3::new(along, first, second),
            Line::Y => Vector3::new(second, along, first),
            Line::Z => Vector3::new(first, second, along),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn vector() -> impl Strategy<Value = Vector3<f64>> {
        [-1e3f64..1e3, -1e3f64..1e3, -1e3f64..1e3].prop_map(Vector3::from)
    }

    proptest! {
        #[test]
        fn about_a_line_a_rotation_has_the_values_of_the_general_one(
            line in 0usize..3, flipped: bool, from in vector(), to in vector(),
            degrees in -720f64..720.0
        ) {
            let mut about = Vector3::zeros();
            about[line] = if flipped { -1.0 } else { 1.0 };
            let about = Unit::new_unchecked(about);
            prop_assert_eq!(turned(about, from, degrees), turned_aslant(about, from, degrees));
            let turned = turned(about, from, degrees);
            for to in [to, turned] {
                let from = from.normalize();
                prop_assert_eq!(turn(about, from, to, 7.0), turn_aslant(about, from, to, 7.0));
            }
        }
    }

    #[test]
    fn a_direction_along_the_axis_is_free_and_one_at_another_height_is_not_reached() {
        let (x, z) = (Vector3::x_axis(), Vector3::z_axis());
        assert_eq!(turn(z, *z, *z, 7.0), Some(7.0));
        assert_eq!(turn(z, *z, *x, 7.0), None);
    }

    #[test]
    fn a_half_turn_is_one_of_180_degrees() {
        for about in [Vector3::z_axis(), -Vector3::z_axis()] {
            for (from, to) in [(1.0, -1.0), (-1.0, 1.0)] {
                let along_x = |x: f64| Vector3::new(x, -0.0, 0.0);
                assert_eq!(turn(about, along_x(from), along_x(to), 7.0), Some(180.0));
            }
        }
    }
}
