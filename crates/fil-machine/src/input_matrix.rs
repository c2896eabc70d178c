//! The matrix that each point of the input goes through before the kinematics.

use nalgebra::Matrix3x4;

use crate::commons::Commons;
use crate::locations::INPUT_MATRIX;

/// Least volume that the first three columns span; below it the points fall into a plane.
pub(crate) const FLAT: f64 = 1e-9;

/// The matrix of the machine; `None` for one that moves nothing. An absent number is that of the
/// matrix that moves nothing.
pub fn input_matrix(commons: &Commons) -> Option<Matrix3x4<f64>> {
    let none = Matrix3x4::<f64>::identity();
    let mut matrix = none;
    for (number, at) in INPUT_MATRIX.into_iter().enumerate() {
        if let Some(value) = commons.dbl_opt(at) {
            matrix[(number / 4, number % 4)] = value;
        }
    }
    (matrix != none).then_some(matrix)
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::lay_over;
    use crate::locations::default_commons;

    #[test]
    fn the_settings_are_the_rows() {
        let mut commons = default_commons();
        assert_eq!(input_matrix(&commons), None);
        let given = "[input]\nmatrix_cy = -0.5\nmatrix_dz = 7.0\n";
        lay_over(&mut commons, "machine.toml", given).expect("a machine");
        let matrix = input_matrix(&commons).expect("a matrix");
        assert_eq!(matrix[(1, 2)], -0.5);
        assert_eq!(matrix[(2, 3)], 7.0);
        assert_eq!(matrix[(0, 0)], 1.0);
    }
}
