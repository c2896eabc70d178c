//! TRANS: the transformation of the input.

use nalgebra::{Matrix3, Matrix3x4, Point3, Vector3};

/// Largest deviation from an orthogonal matrix that counts as none.
const RIGID: f64 = 1e-6;

/// A transformation of points and, where it says so, of the tool axis.
#[derive(Clone, Debug, PartialEq)]
pub struct Transformation {
    /// 3x4, row-major: rotation and translation of points.
    pub matrix: Matrix3x4<f64>,
    /// The tool axis is turned as well.
    pub turns_axis: bool,
    /// What it is of.
    pub of: Statement,
}

/// What moves the points by a matrix.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Statement {
    /// TRANS.
    Trans,
    /// TRACUT.
    Tracut,
    /// A frame that CSYS or its like has named.
    NamedFrame,
    /// ROTABL, which has turned a table under the points.
    Table,
}

impl Transformation {
    /// The transformed point.
    pub fn point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.matrix * point.to_homogeneous())
    }

    /// The linear part, 3x3.
    pub fn linear(&self) -> Matrix3<f64> {
        self.matrix.fixed_columns::<3>(0).into_owned()
    }

    /// The tool axis as the machine gets it.
    pub fn axis(&self, axis: Vector3<f64>) -> Vector3<f64> {
        if self.turns_axis { self.linear() * axis } else { axis }
    }

    /// True when lengths and angles are kept (a mirror image counts).
    pub fn is_rigid(&self) -> bool {
        let linear = self.linear();
        (linear.transpose() * linear - Matrix3::identity()).amax() < RIGID
    }

    /// How many times longer it makes a length at the most; 1 where it keeps lengths.
    pub fn stretch(&self) -> f64 {
        if self.is_rigid() {
            return 1.0;
        }
        let linear = self.linear();
        let squares = linear.transpose() * linear;
        let sums = squares.row_iter().map(|row| row.iter().map(|part| part.abs()).sum::<f64>());
        sums.fold(0.0, f64::max).sqrt()
    }

    /// True for a mirror image.
    pub fn mirrors(&self) -> bool {
        self.linear().determinant() < 0.0
    }
}
