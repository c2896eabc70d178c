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
    /// The settings of the machine.
    Machine,
    /// TRANS.
    Trans,
    /// TRACUT.
    Tracut,
    /// A frame that CSYS or its like has named.
    NamedFrame,
    /// ROTABL, which has turned a table under the points.
    Table,
    /// A block of an author, which has turned a table under the points.
    AuthorBlock,
}

impl Transformation {
    /// The transformed point.
    pub fn point(&self, point: Point3<f64>) -> Point3<f64> {
        Point3::from(self.matrix * point.to_homogeneous())
    }

    /// True where it undoes the turn of a table, so that the points are positions of the slides.
    pub fn undoes_tables(&self) -> bool {
        matches!(self.of, Statement::Table | Statement::AuthorBlock)
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

#[cfg(test)]
mod tests {
    use nalgebra::Rotation3;
    use proptest::prelude::*;

    use super::*;

    fn of(linear: Matrix3<f64>, shift: Vector3<f64>) -> Transformation {
        let columns =
            [linear.column(0).into(), linear.column(1).into(), linear.column(2).into(), shift];
        let matrix = Matrix3x4::from_columns(&columns);
        Transformation { matrix, turns_axis: true, of: Statement::Trans }
    }

    proptest! {
        /// A turn and a shift keep lengths; a mirror image too, and it mirrors.
        #[test]
        fn turns_keep_lengths(
            angles in [-3.0..3.0, -3.0..3.0, -3.0..3.0], shift in [-99.0..99.0, -99.0..99.0, -99.0..99.0],
            one in [-99.0..99.0, -99.0..99.0, -99.0..99.0], other in [-99.0..99.0, -99.0..99.0, -99.0..99.0],
            mirrors in any::<bool>(),
        ) {
            let turn = Rotation3::from_euler_angles(angles[0], angles[1], angles[2]).into_inner();
            let side = if mirrors { -1.0 } else { 1.0 };
            let trans = of(turn * Matrix3::from_diagonal(&Vector3::new(1.0, 1.0, side)), shift.into());
            let [one, other] = [one, other].map(Point3::from);
            let way = (trans.point(one) - trans.point(other)).norm();
            prop_assert!((way - (one - other).norm()).abs() < 1e-9);
            prop_assert!(trans.is_rigid() && trans.stretch() == 1.0);
            prop_assert_eq!(trans.mirrors(), mirrors);
        }

        /// No length grows by more than the stretch says.
        #[test]
        fn nothing_grows_beyond_the_stretch(
            rows in proptest::array::uniform9(-3.0..3.0), way in [-1.0..1.0, -1.0..1.0, -1.0..1.0],
        ) {
            let trans = of(Matrix3::from_row_slice(&rows), Vector3::zeros());
            let way = Vector3::from(way);
            prop_assert!(trans.axis(way).norm() <= trans.stretch() * way.norm() + 1e-9);
        }
    }
}
