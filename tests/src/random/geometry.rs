//! Points, planes and frames of the model.

use crate::path::{Axis, Point};

use super::statement::Trans;

/// The plane's axes, first to second counterclockwise, then the normal.
pub fn axes(normal: Axis) -> [usize; 3] {
    match normal {
        Axis::X => [1, 2, 0],
        Axis::Y => [2, 0, 1],
        Axis::Z => [0, 1, 2],
    }
}

/// Sum of two vectors.
pub fn add(a: Point, b: Point) -> Point {
    std::array::from_fn(|axis| a[axis] + b[axis])
}

/// A vector with another length.
pub fn times(a: Point, factor: f64) -> Point {
    a.map(|value| value * factor)
}

/// Distance of two points.
pub fn distance(a: Point, b: Point) -> f64 {
    (0..3).map(|axis| (a[axis] - b[axis]) * (a[axis] - b[axis])).sum::<f64>().sqrt()
}

/// How CL points come to lie on the machine: a turn or mirror, then a shift in mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Frame {
    rows: [Point; 3],
    shift: Point,
}

impl Default for Frame {
    fn default() -> Self {
        Frame { rows: [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0], [0.0, 0.0, 1.0]], shift: [0.0; 3] }
    }
}

impl Frame {
    /// The frame of TRANS; `unit` is the CL unit in mm.
    pub fn new(trans: &Trans, unit: f64) -> Self {
        match *trans {
            Trans::Shift(by) => Frame { shift: times(by, unit), ..Frame::default() },
            Trans::Matrix { about, angle, mirror, shift, .. } => {
                let mut rows = turn(about, angle);
                if mirror {
                    rows = rows.map(|[x, y, z]| [-x, y, z]);
                }
                Frame { rows, shift: times(shift, unit) }
            }
        }
    }

    /// A CL point on the machine.
    pub fn apply(&self, point: Point) -> Point {
        add(self.direction(point), self.shift)
    }

    /// A direction of the CL on the machine.
    pub fn direction(&self, vector: Point) -> Point {
        self.rows.map(|row| (0..3).map(|axis| row[axis] * vector[axis]).sum())
    }

    /// The rows of the matrix.
    pub fn rows(&self) -> [Point; 3] {
        self.rows
    }

    /// It turns right hands into left ones.
    pub fn mirrors(&self) -> bool {
        let [a, b, c] = self.rows;
        let cross =
            [b[1] * c[2] - b[2] * c[1], b[2] * c[0] - b[0] * c[2], b[0] * c[1] - b[1] * c[0]];
        (0..3).map(|axis| a[axis] * cross[axis]).sum::<f64>() < 0.0
    }

    /// What went counterclockwise about an axis goes clockwise about it: in its plane left is
    /// right.
    pub fn turns_over(&self, normal: Axis) -> bool {
        let [.., along] = axes(normal);
        let kept = self.rows[along][along] > 0.0;
        kept == self.mirrors()
    }
}

/// The matrix that turns by an angle about a machine axis.
fn turn(about: Axis, angle: f64) -> [Point; 3] {
    let (sine, cosine) = libm::sincos(angle.to_radians());
    let [first, second, along] = axes(about);
    let mut rows = [[0.0; 3]; 3];
    rows[along][along] = 1.0;
    rows[first][first] = cosine;
    rows[first][second] = -sine;
    rows[second][first] = sine;
    rows[second][second] = cosine;
    rows
}

/// The principal axis a direction runs along, and whether in its positive sense.
pub fn principal(direction: Point) -> Option<(Axis, bool)> {
    let named = [Axis::X, Axis::Y, Axis::Z].into_iter().zip(direction);
    named.filter(|(_, part)| part.abs() > 1.0 - 1e-6).map(|(axis, part)| (axis, part > 0.0)).next()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_turn_about_z_brings_x_to_y() {
        let trans = Trans::Matrix {
            about: Axis::Z,
            angle: 90.0,
            mirror: false,
            shift: [0.0, 0.0, 1.0],
            points_only: false,
        };
        let frame = Frame::new(&trans, 25.4);
        assert!(distance(frame.apply([2.0, 0.0, 0.0]), [0.0, 2.0, 25.4]) < 1e-12);
        assert!(!frame.mirrors());
    }
}
