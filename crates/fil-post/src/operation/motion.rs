//! What the passes hand to a control: a motion of the machine's axes, and an arc in a plane of them.

use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::modes::Plane;

use crate::cause::Cause;

/// A motion of the machine's axes.
#[derive(Clone, Copy, Debug)]
pub struct Motion {
    /// Where to: X Y Z in mm or inch, two rotaries in degrees.
    pub position: Position,
    /// The axes that may move.
    pub axes: AxisSet,
    /// Word of the record that X repeats, Y and Z follow; 0 for none.
    pub word: u16,
    /// The scaled integers of the position, where they have been found already.
    pub scaled: Option<[i64; AXES]>,
}

impl Motion {
    /// A motion of some axes to a position; `word` is the one of the record that X repeats, 0 for
    /// none.
    #[inline]
    pub fn new(position: Position, axes: AxisSet, word: u16) -> Motion {
        Motion { position, axes, word, scaled: None }
    }

    /// A motion of one axis, to a position in mm, inch or degrees.
    pub fn along(number: usize, to: f64) -> Motion {
        let mut position = Position::default();
        position[number] = to;
        Motion::new(position, AxisSet::of(number), 0)
    }

    /// The same for some of its axes.
    pub fn of(&self, axes: AxisSet) -> Motion {
        Motion { axes: self.axes.and(axes), ..*self }
    }
}

/// Which code a rapid motion takes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum RapidCode {
    /// That of X and Y.
    Across,
    /// That of Z.
    Along,
    /// That of the rotary axes.
    Turning,
}

/// An arc, or a part of one, in a plane of the machine; lengths in mm or inch.
#[derive(Clone, Copy, Debug)]
pub struct PlaneArc {
    /// The plane.
    pub plane: Plane,
    /// Counterclockwise, seen against the plane's normal.
    pub counterclockwise: bool,
    /// The center, in the two axes of the plane.
    pub center: [f64; 2],
    /// The radius.
    pub radius: f64,
    /// Where it begins.
    pub from: Position,
    /// The same in the two axes of the plane, as the tape says it.
    pub start: [f64; 2],
    /// Where it ends.
    pub to: Position,
    /// Degrees, above 0 and at most 360.
    pub sweep: f64,
    /// Word of the record that the end repeats; 0 for none.
    pub word: u16,
    /// The CIRCLE record.
    pub cause: Cause,
}

impl PlaneArc {
    /// A point in the two axes of the plane.
    pub fn flat(&self, position: &Position) -> [f64; 2] {
        self.plane.axes().map(|number| position[number])
    }

    /// The point at a share of the way from start to end, in the axes of the plane.
    pub fn point_at(&self, share: f64) -> [f64; 2] {
        let [x, y] = self.flat(&self.from);
        let [x, y] = [x - self.center[0], y - self.center[1]];
        let turned = if self.counterclockwise { self.sweep } else { -self.sweep } * share;
        let (sine, cosine) = libm::sincos(turned.to_radians());
        [self.center[0] + x * cosine - y * sine, self.center[1] + x * sine + y * cosine]
    }
}
