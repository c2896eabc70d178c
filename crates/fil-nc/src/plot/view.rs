//! Views and extents.

use super::Point;

/// The box around points, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Extent {
    /// Least X, Y, Z.
    pub min: Point,
    /// Greatest X, Y, Z.
    pub max: Point,
}

impl Extent {
    /// The box around points; `None` without any.
    pub fn of<'p>(points: impl IntoIterator<Item = &'p Point>) -> Option<Extent> {
        let one = |point: &Point| Some(Extent { min: *point, max: *point });
        points.into_iter().map(one).fold(None, Extent::joined)
    }

    /// The box around two, where there are two.
    pub(super) fn joined(one: Option<Extent>, other: Option<Extent>) -> Option<Extent> {
        let (Some(a), Some(b)) = (one, other) else { return one.or(other) };
        Some(Extent {
            min: std::array::from_fn(|axis| a.min[axis].min(b.min[axis])),
            max: std::array::from_fn(|axis| a.max[axis].max(b.max[axis])),
        })
    }

    /// Length of its longest side.
    pub fn size(&self) -> f64 {
        (0..3).map(|axis| self.max[axis] - self.min[axis]).fold(0.0, f64::max)
    }

    /// Its eight corners.
    pub(super) fn corners(&self) -> [Point; 8] {
        std::array::from_fn(|corner| {
            std::array::from_fn(|axis| {
                if corner >> axis & 1 == 0 { self.min[axis] } else { self.max[axis] }
            })
        })
    }
}

/// A direction from which a path is seen.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum View {
    /// From above: X to the right, Y up.
    Xy,
    /// As at a lathe: Z to the right, X up.
    Zx,
    /// Z to the right, Y up.
    Zy,
    /// Isometric: X to the right and down, Y to the right and up, Z up.
    Isometric,
}

impl View {
    /// All views.
    pub const ALL: [View; 4] = [View::Xy, View::Isometric, View::Zx, View::Zy];

    /// Name over the picture.
    pub fn name(self) -> &'static str {
        match self {
            View::Xy => "XY",
            View::Zx => "ZX",
            View::Zy => "ZY",
            View::Isometric => "isometric",
        }
    }

    /// The directions of the part that lie to the right and up.
    pub fn axes(self) -> [Point; 2] {
        match self {
            View::Xy => [[1.0, 0.0, 0.0], [0.0, 1.0, 0.0]],
            View::Zx => [[0.0, 0.0, 1.0], [1.0, 0.0, 0.0]],
            View::Zy => [[0.0, 0.0, 1.0], [0.0, 1.0, 0.0]],
            View::Isometric => {
                let (half, sixth) = (0.5f64.sqrt(), 6.0f64.sqrt().recip());
                [[half, half, 0.0], [-sixth, sixth, 2.0 * sixth]]
            }
        }
    }

    /// Right and up of a point.
    pub fn project(self, point: &Point) -> [f64; 2] {
        self.axes().map(|axis| (0..3).map(|index| axis[index] * point[index]).sum())
    }
}
