//! Functions of numbers that are more than one expression.

/// Angle of the point `x = a[1]`, `y = a[0]` in degrees.
pub(crate) fn arc_tangent(a: &[f64]) -> Option<f64> {
    (a[0] != 0.0 || a[1] != 0.0).then(|| libm::atan2(a[0], a[1]).to_degrees())
}

/// Distance of two points.
pub(crate) fn distance(a: &[f64]) -> Option<f64> {
    let (x, y, z) = (a[3] - a[0], a[4] - a[1], a[5] - a[2]);
    Some(libm::hypot(libm::hypot(x, y), z))
}

/// Sine of degrees, exact where the sine is 0, 1/2 or 1: an axis position must
/// not carry a residue of 1e-14 from the conversion to radians.
pub(crate) fn sin_degrees(x: f64) -> f64 {
    let turn = x % 360.0;
    let (sign, angle) = if turn < 0.0 { (-1.0, -turn) } else { (1.0, turn) };
    let (sign, angle) = if angle >= 180.0 { (-sign, angle - 180.0) } else { (sign, angle) };
    let angle = if angle > 90.0 { 180.0 - angle } else { angle };
    let sine = match angle {
        0.0 => return 0.0,
        30.0 => 0.5,
        _ if angle > 45.0 => libm::cos((90.0 - angle).to_radians()),
        _ => libm::sin(angle.to_radians()),
    };
    sign * sine
}

/// Cosine of degrees, as exact as the sine.
pub(crate) fn cos_degrees(x: f64) -> f64 {
    sin_degrees(90.0 - (x % 360.0).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sine_and_cosine_agree_with_radians() {
        for step in -1000..1000 {
            let angle = f64::from(step) * 0.777;
            assert!((sin_degrees(angle) - libm::sin(angle.to_radians())).abs() < 1e-14, "{angle}");
            assert!((cos_degrees(angle) - libm::cos(angle.to_radians())).abs() < 1e-14, "{angle}");
        }
    }
}
