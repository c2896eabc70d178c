//! The functions of numbers.

use super::value::Class;

/// The function of that name; `None` where it is none of numbers.
pub fn call(name: &str, a: &[f64]) -> Option<Result<f64, Class>> {
    let result = match (name, a) {
        ("ABSF", [x]) => x.abs(),
        ("SQRTF", [x]) => x.sqrt(),
        ("SINF", [x]) => sine(*x),
        ("COSF", [x]) => sine(90.0 - (x % 360.0).abs()),
        ("TANF", [x]) => sine(*x) / sine(90.0 - (x % 360.0).abs()),
        ("ASINF", [x]) => libm::asin(*x).to_degrees(),
        ("ACOSF", [x]) => libm::acos(*x).to_degrees(),
        ("ATANF", [x]) => libm::atan(*x).to_degrees(),
        ("ATAN2F", [y, x]) if *y == 0.0 && *x == 0.0 => f64::NAN,
        ("ATAN2F", [y, x]) => libm::atan2(*y, *x).to_degrees(),
        ("LOGF", [x]) => libm::log(*x),
        ("LOG10F", [x]) => libm::log10(*x),
        ("EXPF", [x]) => libm::exp(*x),
        ("INTF", [x]) => x.trunc(),
        ("NINTF" | "ROUNDF", [x]) => x.round(),
        ("MODF", [a, b]) => a % b,
        ("SIGNF", [a, b]) if *b < 0.0 => -a.abs(),
        ("SIGNF", [a, _]) => a.abs(),
        ("MAXF" | "MAX1F", [first, rest @ ..]) => rest.iter().fold(*first, |m, x| m.max(*x)),
        ("MINF" | "MIN1F", [first, rest @ ..]) => rest.iter().fold(*first, |m, x| m.min(*x)),
        ("DISTF", [a, b, c, x, y, z]) => libm::hypot(libm::hypot(x - a, y - b), z - c),
        ("DOTF", [a, b, c, x, y, z]) => a * x + b * y + c * z,
        _ => return None,
    };
    Some(if result.is_finite() { Ok(result) } else { Err(Class::Domain) })
}

/// Sine of degrees. The angle is brought to 0 to 45 degrees first, so that
/// round angles have their exact sines.
fn sine(degrees: f64) -> f64 {
    let turn = degrees % 360.0;
    let half = turn.abs() % 180.0;
    let below = (turn.abs() >= 180.0) != (turn < 0.0);
    let quarter = if half > 90.0 { 180.0 - half } else { half };
    let size = if quarter == 0.0 {
        return 0.0;
    } else if quarter == 30.0 {
        0.5
    } else if quarter <= 45.0 {
        libm::sin(quarter.to_radians())
    } else {
        libm::cos((90.0 - quarter).to_radians())
    };
    if below { -size } else { size }
}
