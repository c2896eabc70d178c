//! A rotation as three angles, as the controls name the directions of a tilted frame.

use nalgebra::{Matrix3, Rotation3, Vector3};

/// A tilt whose sine is below this leaves two of the angles to be one turn.
const POLE: f64 = 1e-9;

/// Which three turns the angles are.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Euler {
    /// About Z, the new X and the new Z (G68.2).
    Zxz,
    /// About X, Y and Z of the part, one after the other (PLANE SPATIAL).
    FixedXyz,
    /// About X, the new Y and the new Z (CYCLE800, axis by axis).
    MovingXyz,
}

impl Euler {
    /// The angles of a rotation, degrees.
    pub fn angles(self, turn: &Rotation3<f64>) -> [f64; 3] {
        let m = turn.matrix();
        let radians = match self {
            Euler::Zxz => zxz(m),
            Euler::FixedXyz => fixed_xyz(m),
            Euler::MovingXyz => moving_xyz(m),
        };
        radians.map(f64::to_degrees)
    }

    /// The rotation of three angles in degrees.
    pub fn turn(self, degrees: [f64; 3]) -> Rotation3<f64> {
        let [one, two, three] = degrees.map(f64::to_radians);
        let about = |axis, angle| Rotation3::from_axis_angle(&axis, angle);
        let (x, y, z) = (Vector3::x_axis(), Vector3::y_axis(), Vector3::z_axis());
        match self {
            Euler::Zxz => about(z, one) * about(x, two) * about(z, three),
            Euler::FixedXyz => about(z, three) * about(y, two) * about(x, one),
            Euler::MovingXyz => about(x, one) * about(y, two) * about(z, three),
        }
    }
}

fn zxz(m: &Matrix3<f64>) -> [f64; 3] {
    let sine = libm::hypot(m[(0, 2)], m[(1, 2)]);
    let tilt = libm::atan2(sine, m[(2, 2)]);
    if sine < POLE {
        return [libm::atan2(m[(1, 0)], m[(0, 0)]), tilt, 0.0];
    }
    [libm::atan2(m[(0, 2)], -m[(1, 2)]), tilt, libm::atan2(m[(2, 0)], m[(2, 1)])]
}

fn fixed_xyz(m: &Matrix3<f64>) -> [f64; 3] {
    let cosine = libm::hypot(m[(0, 0)], m[(1, 0)]);
    let second = libm::atan2(-m[(2, 0)], cosine);
    if cosine < POLE {
        return [libm::atan2(second.signum() * m[(0, 1)], m[(1, 1)]), second, 0.0];
    }
    [libm::atan2(m[(2, 1)], m[(2, 2)]), second, libm::atan2(m[(1, 0)], m[(0, 0)])]
}

fn moving_xyz(m: &Matrix3<f64>) -> [f64; 3] {
    let cosine = libm::hypot(m[(0, 0)], m[(0, 1)]);
    let second = libm::atan2(m[(0, 2)], cosine);
    if cosine < POLE {
        return [libm::atan2(m[(2, 1)], m[(1, 1)]), second, 0.0];
    }
    [libm::atan2(-m[(1, 2)], m[(2, 2)]), second, libm::atan2(-m[(0, 1)], m[(0, 0)])]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn angles_give_the_rotation_back() {
        let steps = [-180.0, -135.0, -90.0, -33.3, 0.0, 1e-7, 12.5, 90.0, 135.0, 180.0];
        for (a, b, c) in steps
            .into_iter()
            .flat_map(|a| steps.into_iter().flat_map(move |b| steps.map(move |c| (a, b, c))))
        {
            let turn = Euler::Zxz.turn([a, b, c]);
            for euler in [Euler::Zxz, Euler::FixedXyz, Euler::MovingXyz] {
                let back = euler.turn(euler.angles(&turn));
                assert!((back.matrix() - turn.matrix()).amax() < 1e-8, "{euler:?} {a} {b} {c}");
            }
        }
    }

    /// By hand: a plane that leans to +Y, and one that leans to +X.
    #[test]
    fn the_angles_are_those_of_the_manuals() {
        let leans_to_y = Rotation3::from_axis_angle(&Vector3::x_axis(), -0.5f64);
        let degrees = 0.5f64.to_degrees();
        let near = |angles: [f64; 3], by_hand: [f64; 3]| {
            angles.iter().zip(by_hand).all(|(a, b)| (a - b).abs() < 1e-9)
        };
        assert!(
            near(Euler::Zxz.angles(&leans_to_y), [180.0, degrees, -180.0])
                || near(Euler::Zxz.angles(&leans_to_y), [-180.0, degrees, 180.0])
                || near(Euler::Zxz.angles(&leans_to_y), [180.0, degrees, 180.0])
        );
        assert!(near(Euler::FixedXyz.angles(&leans_to_y), [-degrees, 0.0, 0.0]));
        assert!(near(Euler::MovingXyz.angles(&leans_to_y), [-degrees, 0.0, 0.0]));
        let leans_to_x = Rotation3::from_axis_angle(&Vector3::y_axis(), 0.5f64);
        assert!(near(Euler::Zxz.angles(&leans_to_x), [90.0, degrees, -90.0]));
        assert!(near(Euler::MovingXyz.angles(&leans_to_x), [0.0, degrees, 0.0]));
    }
}
