//! The built-in functions: name, arguments, meaning, grade and arithmetic in one table.
//!
//! POSTF has a table of its own, [`postf`](crate::postf).

use crate::postf::Grade;

/// What the compiler does with a built-in function.
#[derive(Clone, Copy)]
pub enum Kind {
    /// A function of that many numbers.
    Numbers(u16, fn(&[f64]) -> Option<f64>),
    /// A function of two numbers, applied in turn to two or more.
    Fold(fn(&[f64]) -> Option<f64>),
    /// LNTHF
    TextLength,
    /// ICODEF
    WordCode,
    /// POSTF
    Postf,
    /// COUPLF
    Couplet,
    /// HASF
    HasWord,
    /// NEXTF
    NextMotion,
    /// PREVF
    PreviousMotion,
    /// LASTF
    LastWritten,
    /// COMF
    NamedCommon,
}

/// A built-in function.
pub struct Builtin {
    /// Its name.
    pub name: &'static str,
    /// Its arguments as a call shows them.
    pub arguments: &'static str,
    /// What it gives.
    pub doc: &'static str,
    /// How sure that is.
    pub grade: Grade,
    /// True for an extension of filpost, refused under `--strict`.
    pub extension: bool,
    /// What the compiler does with it.
    pub kind: Kind,
}

const fn function(
    name: &'static str,
    arguments: &'static str,
    grade: Grade,
    kind: Kind,
    doc: &'static str,
) -> Builtin {
    Builtin { name, arguments, doc, grade, extension: false, kind }
}

const fn extension(
    name: &'static str,
    arguments: &'static str,
    kind: Kind,
    doc: &'static str,
) -> Builtin {
    Builtin { name, arguments, doc, grade: Grade::Own, extension: true, kind }
}

use Grade::{Inferred, Own, Published};
use Kind::{Fold, Numbers};

/// All built-in functions. A function of numbers gives `None`, or a result that
/// is not finite, outside of its domain.
pub const BUILTINS: &[Builtin] = &[
    function("ABSF", "x", Published, Numbers(1, |a| Some(a[0].abs())), "absolute value"),
    function(
        "SQRTF",
        "x",
        Published,
        Numbers(1, |a| Some(a[0].sqrt())),
        "square root; x must not be negative",
    ),
    function(
        "SINF",
        "x",
        Inferred,
        Numbers(1, |a| Some(sin_degrees(a[0]))),
        "sine of an angle in degrees",
    ),
    function(
        "COSF",
        "x",
        Inferred,
        Numbers(1, |a| Some(cos_degrees(a[0]))),
        "cosine of an angle in degrees",
    ),
    function(
        "TANF",
        "x",
        Inferred,
        Numbers(1, |a| Some(sin_degrees(a[0]) / cos_degrees(a[0]))),
        "tangent of an angle in degrees",
    ),
    function(
        "ASINF",
        "x",
        Inferred,
        Numbers(1, |a| Some(a[0].asin().to_degrees())),
        "arc sine in degrees",
    ),
    function(
        "ACOSF",
        "x",
        Inferred,
        Numbers(1, |a| Some(a[0].acos().to_degrees())),
        "arc cosine in degrees",
    ),
    function(
        "ATANF",
        "x",
        Published,
        Numbers(1, |a| Some(a[0].atan().to_degrees())),
        "arc tangent of a ratio, in degrees",
    ),
    function(
        "ATAN2F",
        "y,x",
        Own,
        Numbers(2, arc_tangent),
        "angle of the point x,y in degrees, -180 to 180",
    ),
    function(
        "LOGF",
        "x",
        Inferred,
        Numbers(1, |a| Some(a[0].ln())),
        "natural logarithm; x must be positive",
    ),
    function(
        "LOG10F",
        "x",
        Own,
        Numbers(1, |a| Some(a[0].log10())),
        "decimal logarithm; x must be positive",
    ),
    function("EXPF", "x", Inferred, Numbers(1, |a| Some(a[0].exp())), "e to the power x"),
    function("INTF", "x", Inferred, Numbers(1, |a| Some(a[0].trunc())), "whole part, towards zero"),
    function(
        "NINTF",
        "x",
        Own,
        Numbers(1, |a| Some(a[0].round())),
        "nearest whole number, halves away from zero",
    ),
    function(
        "ROUNDF",
        "x",
        Own,
        Numbers(1, |a| Some(a[0].round())),
        "nearest whole number, halves away from zero",
    ),
    function(
        "MODF",
        "a,b",
        Own,
        Numbers(2, |a| (a[1] != 0.0).then(|| a[0] % a[1])),
        "rest of a/b with the sign of a",
    ),
    function(
        "SIGNF",
        "a,b",
        Own,
        Numbers(2, |a| Some(if a[1] < 0.0 { -a[0].abs() } else { a[0].abs() })),
        "absolute value of a with the sign of b",
    ),
    function("MAXF", "a,b,…", Own, Fold(|a| Some(a[0].max(a[1]))), "largest value"),
    function("MINF", "a,b,…", Own, Fold(|a| Some(a[0].min(a[1]))), "smallest value"),
    function("MAX1F", "a,b,…", Own, Fold(|a| Some(a[0].max(a[1]))), "largest value"),
    function("MIN1F", "a,b,…", Own, Fold(|a| Some(a[0].min(a[1]))), "smallest value"),
    function("DISTF", "x1,y1,z1,x2,y2,z2", Own, Numbers(6, distance), "distance of two points"),
    function(
        "DOTF",
        "i1,j1,k1,i2,j2,k2",
        Own,
        Numbers(6, |a| Some(a[0] * a[3] + a[1] * a[4] + a[2] * a[5])),
        "scalar product of two vectors",
    ),
    function("LNTHF", "text", Own, Kind::TextLength, "number of characters of a text"),
    function(
        "ICODEF",
        "word",
        Published,
        Kind::WordCode,
        "integer code of a vocabulary word, of user words too",
    ),
    function(
        "POSTF",
        "n,…",
        Published,
        Kind::Postf,
        "post interface; see the table of POSTF numbers",
    ),
    extension(
        "COUPLF",
        "word[,default]",
        Kind::Couplet,
        "the number after a minor word in the current record",
    ),
    extension(
        "HASF",
        "word",
        Kind::HasWord,
        "1 when the current record has that minor word, else 0",
    ),
    extension(
        "NEXTF",
        "word",
        Kind::NextMotion,
        "X, Y, Z, I, J or K of the next motion, without consuming it",
    ),
    extension("PREVF", "word", Kind::PreviousMotion, "X, Y, Z, I, J or K of the previous motion"),
    extension("LASTF", "letter", Kind::LastWritten, "last value written for a letter"),
    extension("COMF", "'name'", Kind::NamedCommon, "a common location by its name"),
];

/// The index of a built-in function in [`BUILTINS`].
pub(crate) fn find(name: &str) -> Option<usize> {
    BUILTINS.iter().position(|builtin| builtin.name == name)
}

fn arc_tangent(a: &[f64]) -> Option<f64> {
    (a[0] != 0.0 || a[1] != 0.0).then(|| a[0].atan2(a[1]).to_degrees())
}

fn distance(a: &[f64]) -> Option<f64> {
    let (x, y, z) = (a[3] - a[0], a[4] - a[1], a[5] - a[2]);
    Some(x.hypot(y).hypot(z))
}

/// Sine of degrees, exact where the sine is 0, 1/2 or 1: an axis position must
/// not carry a residue of 1e-14 from the conversion to radians.
fn sin_degrees(x: f64) -> f64 {
    let turn = x % 360.0;
    let (sign, angle) = if turn < 0.0 { (-1.0, -turn) } else { (1.0, turn) };
    let (sign, angle) = if angle >= 180.0 { (-sign, angle - 180.0) } else { (sign, angle) };
    let angle = if angle > 90.0 { 180.0 - angle } else { angle };
    let sine = match angle {
        0.0 => return 0.0,
        30.0 => 0.5,
        _ if angle > 45.0 => (90.0 - angle).to_radians().cos(),
        _ => angle.to_radians().sin(),
    };
    sign * sine
}

fn cos_degrees(x: f64) -> f64 {
    sin_degrees(90.0 - (x % 360.0).abs())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn call(name: &str, arguments: &[f64]) -> Option<f64> {
        match BUILTINS[find(name).unwrap()].kind {
            Numbers(_, body) | Fold(body) => body(arguments).filter(|value| value.is_finite()),
            _ => panic!("{name} is not a function of numbers"),
        }
    }

    #[test]
    fn no_name_stands_twice() {
        for (index, builtin) in BUILTINS.iter().enumerate() {
            assert_eq!(find(builtin.name), Some(index));
        }
    }

    #[test]
    fn angles_are_degrees_and_round_angles_are_exact() {
        for (angle, sine) in [
            (0.0, 0.0),
            (30.0, 0.5),
            (90.0, 1.0),
            (150.0, 0.5),
            (180.0, 0.0),
            (210.0, -0.5),
            (270.0, -1.0),
            (360.0, 0.0),
            (-30.0, -0.5),
            (-90.0, -1.0),
            (390.0, 0.5),
        ] {
            assert_eq!(call("SINF", &[angle]), Some(sine), "SINF({angle})");
            assert_eq!(call("COSF", &[angle - 90.0]), Some(sine), "COSF({angle} - 90)");
        }
        assert_eq!(call("TANF", &[45.0]), Some(1.0));
        assert_eq!(call("ATANF", &[1.0]), Some(45.0));
        assert_eq!(call("ATAN2F", &[1.0, -1.0]), Some(135.0));
    }

    #[test]
    fn sine_and_cosine_agree_with_radians() {
        for step in -1000..1000 {
            let angle = f64::from(step) * 0.777;
            assert!((sin_degrees(angle) - angle.to_radians().sin()).abs() < 1e-14, "{angle}");
            assert!((cos_degrees(angle) - angle.to_radians().cos()).abs() < 1e-14, "{angle}");
        }
    }

    #[test]
    fn outside_of_the_domain_there_is_no_value() {
        assert_eq!(call("SQRTF", &[-1.0]), None);
        assert_eq!(call("LOGF", &[0.0]), None);
        assert_eq!(call("TANF", &[90.0]), None);
        assert_eq!(call("ASINF", &[1.1]), None);
        assert_eq!(call("MODF", &[1.0, 0.0]), None);
        assert_eq!(call("ATAN2F", &[0.0, 0.0]), None);
        assert_eq!(call("EXPF", &[1000.0]), None);
    }
}
