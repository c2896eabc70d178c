//! Modes of a control that settings and programs share: unit, plane, kind of feed.

use crate::commons::Commons;
use crate::locations::{UNITS_MODE, UnitsMode};

/// Unit of lengths.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub enum Unit {
    /// Millimetres.
    Mm,
    /// Inches.
    Inch,
}

/// Millimetres of an inch.
pub const INCH: f64 = 25.4;

impl Unit {
    /// The one unit that a machine takes (`units.mode`); `None` where the CL file
    /// chooses.
    #[doc(hidden)]
    pub fn of_machine(commons: &Commons) -> Option<Unit> {
        match commons.read(UNITS_MODE) {
            UnitsMode::Inch => Some(Unit::Inch),
            UnitsMode::Metric => Some(Unit::Mm),
            UnitsMode::AsTheClFile => None,
        }
    }

    /// True for millimetres.
    #[inline]
    pub fn is_metric(self) -> bool {
        self == Unit::Mm
    }

    /// Millimetres of one unit.
    pub fn in_mm(self) -> f64 {
        match self {
            Unit::Mm => 1.0,
            Unit::Inch => INCH,
        }
    }
}

impl std::fmt::Display for Unit {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(match self {
            Unit::Mm => "mm",
            Unit::Inch => "inch",
        })
    }
}

/// A plane of two linear axes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Plane {
    /// X and Y, across Z.
    Xy,
    /// Z and X, across Y.
    Zx,
    /// Y and Z, across X.
    Yz,
}

impl Plane {
    /// All planes.
    pub const ALL: [Plane; 3] = [Plane::Xy, Plane::Zx, Plane::Yz];

    /// Numbers of its axes (0 to 2 for X Y Z); first to second is counterclockwise
    /// seen against [`Plane::normal`].
    #[inline]
    pub fn axes(self) -> [usize; 2] {
        match self {
            Plane::Xy => [0, 1],
            Plane::Zx => [2, 0],
            Plane::Yz => [1, 2],
        }
    }

    /// Number of the linear axis across it.
    #[inline]
    pub fn normal(self) -> usize {
        match self {
            Plane::Xy => 2,
            Plane::Zx => 1,
            Plane::Yz => 0,
        }
    }

    /// The plane across a linear axis (0 to 2 for X Y Z).
    pub fn across(axis: usize) -> Self {
        match axis {
            0 => Plane::Yz,
            1 => Plane::Zx,
            _ => Plane::Xy,
        }
    }
}

/// How the number of an F word is meant.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum FeedMode {
    /// Units (mm or inch) a minute.
    PerMinute,
    /// Units (mm or inch) a revolution.
    PerRevolution,
    /// Motions a minute: 1 over the minutes of this one.
    InverseTime,
}

/// How coordinates count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distance {
    /// From the zero of the program (G90).
    Absolute,
    /// From the point before (G91).
    Incremental,
}

/// On which side of the path the cutter runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// On the path (G40).
    Off,
    /// Left of the path (G41).
    Left,
    /// Right of the path (G42).
    Right,
}
