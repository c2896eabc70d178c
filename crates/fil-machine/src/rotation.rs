//! Rotation about an axis: a vector turned, and the angle that takes one direction to another.
//!
//! Nearly each rotary axis lies along X, Y or Z. About such an axis a rotation changes two
//! coordinates alone, which takes a fraction of the general product and gives the same values.

use nalgebra::{Rotation3, Unit, Vector3};

/// Directions closer than this (radians, about 0.0006 degrees) count as equal.
pub(crate) const SAME: f64 = 1e-5;

/// Angles nearer than this to one whose sine is known take theirs from it, radians: what the
/// series leave out there is below the last bit.
const BESIDE: f64 = 1e-4;

/// An angle with its sine and cosine.
#[derive(Clone, Copy, Debug)]
pub struct Turn {
    /// The angle, degrees.
    pub degrees: f64,
    sine: f64,
    cosine: f64,
}

impl Default for Turn {
    fn default() -> Self {
        Turn { degrees: 0.0, sine: 0.0, cosine: 1.0 }
    }
}

impl Turn {
    /// That of an angle in degrees.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn of(degrees: f64) -> Self {
        let (sine, cosine) = libm::sincos(degrees.to_radians());
        Turn { degrees, sine, cosine }
    }

    /// That of another angle in degrees; of one nearby, such as the same as the tape has it, by
    /// the sine and cosine of a sum, which takes a fraction of the time.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub fn beside(self, degrees: f64) -> Self {
        let by = (degrees - self.degrees).to_radians();
        if by.abs() > BESIDE {
            return Turn::of(degrees);
        }
        let (sine, cosine) = (by - by * by * by * (1.0 / 6.0), 1.0 - by * by / 2.0);
        Turn {
            degrees,
            sine: self.sine * cosine + self.cosine * sine,
            cosine: self.cosine * cosine - self.sine * sine,
        }
    }

    /// The same with whole turns.
    #[inline]
    pub(crate) fn at(self, degrees: f64) -> Self {
        Turn { degrees, ..self }
    }

    /// The way back.
    #[inline]
    pub(crate) fn back(self) -> Self {
        Turn { degrees: -self.degrees, sine: -self.sine, ..self }
    }
}

/// A vector turned about a direction by an angle, degrees, by the right-hand rule.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(crate) fn turned(
    about: Unit<Vector3<f64>>,
    vector: Vector3<f64>,
    degrees: f64,
) -> Vector3<f64> {
    match Line::of(about) {
        Some(line) => turned_about(line, vector, Turn::of(degrees)),
        None => turned_aslant(about, vector, degrees),
    }
}

/// The same by an angle whose sine is known.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(crate) fn turned_by(
    about: Unit<Vector3<f64>>,
    vector: Vector3<f64>,
    turn: Turn,
) -> Vector3<f64> {
    match Line::of(about) {
        Some(line) => turned_about(line, vector, turn),
        None => turned_aslant(about, vector, turn.degrees),
    }
}

#[cfg_attr(not(target_family = "wasm"), inline(always))]
fn turned_about((line, sign): (Line, f64), vector: Vector3<f64>, turn: Turn) -> Vector3<f64> {
    let (sine, cosine) = (sign * turn.sine, turn.cosine);
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
    let Some(line) = Line::of(about) else { return turn_aslant(about, from, to, free) };
    let Seen { ends, length, sides } = Seen::of(line, from, to);
    angle(ends, length, sides, free)
}

/// The same about X, Y or Z, with its sine and cosine; `None` about another axis too.
#[cfg_attr(not(target_family = "wasm"), inline(always))]
pub(crate) fn turn_about_a_line(
    about: Unit<Vector3<f64>>,
    from: Vector3<f64>,
    to: Vector3<f64>,
    free: f64,
) -> Option<Turn> {
    let Seen { ends, length, sides } = Seen::of(Line::of(about)?, from, to);
    match how_it_turns(ends, length)? {
        Turns::Free => Some(Turn::of(free)),
        Turns::ByAnAngle => {
            let [sine, cosine] = sides;
            // They need no angle, which comes last.
            let scale = 1.0 / (sine * sine + cosine * cosine).sqrt();
            let degrees = degrees_of(sides);
            Some(Turn { degrees, sine: sine * scale, cosine: cosine * scale })
        }
    }
}

/// Two directions as they are seen along a line.
struct Seen {
    ends: [Distances; 2],
    length: f64,
    /// Sine and cosine between them, to one scale.
    sides: [f64; 2],
}

impl Seen {
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    fn of((line, sign): (Line, f64), from: Vector3<f64>, to: Vector3<f64>) -> Self {
        let [[along_from, x, y], [along_to, u, v]] = [line.seen(from), line.seen(to)];
        let length = to.norm();
        let to = Distances { along: along_to, square: u * u + v * v };
        let from = Distances { along: along_from, square: x * x + y * y }.times(length);
        let sides = [sign * (x * v - y * u), x * u + y * v];
        Seen { ends: [from, to], length, sides }
    }
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

/// Whether two directions say an angle between them.
enum Turns {
    ByAnAngle,
    /// Both lie along the axis.
    Free,
}

/// The same for two vectors of one length, from the sine and cosine between them, to one scale.
#[inline]
fn angle(ends: [Distances; 2], length: f64, sides: [f64; 2], free: f64) -> Option<f64> {
    match how_it_turns(ends, length)? {
        Turns::Free => Some(free),
        Turns::ByAnAngle => Some(degrees_of(sides)),
    }
}

#[inline]
fn degrees_of([sine, cosine]: [f64; 2]) -> f64 {
    // A half turn is one of 180 degrees, whatever sign a zero has.
    libm::atan2(sine + 0.0, cosine).to_degrees()
}

/// `None` for directions that lie at different angles to the axis.
#[inline]
fn how_it_turns([from, to]: [Distances; 2], length: f64) -> Option<Turns> {
    let same = SAME * length;
    let apart = from.square - to.square;
    if (from.along - to.along).abs() > same
        || apart * apart > same * same * (from.square + to.square)
    {
        return None;
    }
    let along = from.square < same * same || to.square < same * same;
    Some(if along { Turns::Free } else { Turns::ByAnAngle })
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

        #[test]
        fn the_sine_of_a_turn_is_that_of_its_angle(
            line in 0usize..3, from in vector(), degrees in -180f64..180.0, by in -0.004f64..0.004
        ) {
            let mut about = Vector3::zeros();
            about[line] = 1.0;
            let about = Unit::new_unchecked(about);
            let from = from.normalize();
            let to = turned(about, from, degrees) * 3.0;
            let found = turn_about_a_line(about, from, to, degrees).expect("a turn");
            for turn in [found, found.beside(found.degrees + by), found.beside(degrees + 30.0)] {
                let exact = Turn::of(turn.degrees);
                prop_assert!((turn.sine - exact.sine).abs() < 1e-15, "{:?} {:?}", turn, exact);
                prop_assert!((turn.cosine - exact.cosine).abs() < 1e-15, "{:?} {:?}", turn, exact);
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
