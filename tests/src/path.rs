//! A tool path as plain data: what a CL file asks for and what an NC program does.

/// X, Y, Z in the unit of the path.
pub type Point = [f64; 3];

/// Unit of length of a path.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unit {
    /// Millimetre.
    Mm,
    /// Inch.
    Inch,
}

/// A principal axis: the normal of an arc's plane.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Axis {
    /// Arc in the YZ plane.
    X,
    /// Arc in the ZX plane.
    Y,
    /// Arc in the XY plane.
    Z,
}

/// An arc or a helix about a principal axis.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    /// End point.
    pub to: Point,
    /// Center; the coordinate along `normal` means nothing.
    pub center: Point,
    /// Normal of the plane.
    pub normal: Axis,
    /// Counterclockwise when seen against the normal.
    pub ccw: bool,
    /// Turns begun: 1 for an arc up to a full circle.
    pub turns: u32,
}

/// A drilled hole along Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Hole {
    /// X and Y.
    pub at: [f64; 2],
    /// Z of the bottom.
    pub bottom: f64,
    /// Z where the feed begins; above it the tool may travel.
    pub clearance: f64,
}

/// What one step does. A rate is in path units a minute; `None` where it is not
/// known or not a minute's (per revolution, inverse time).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Action {
    /// Change to this tool.
    Tool(u32),
    /// Rapid traverse in a straight line.
    Rapid(Point),
    /// Straight line at feed.
    Feed(Point, Option<f64>),
    /// Arc at feed.
    Arc(Arc, Option<f64>),
    /// Hole of a drilling cycle with the rate of its feed; NC paths have none, as
    /// the interpreter expands cycles.
    Hole(Hole, Option<f64>),
    /// Traverse to a fixed point of the machine, which no CL file asks for.
    Reference(Point),
}

/// A step and the line it comes from.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Line of the CL file or of the NC program, 1-based.
    pub line: u32,
    /// What it does.
    pub action: Action,
}

/// A tool path.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct ToolPath {
    /// The unit, where the source names it.
    pub unit: Option<Unit>,
    /// The steps in order.
    pub steps: Vec<Step>,
}

impl Unit {
    /// Length of the unit in millimetres.
    pub fn in_mm(self) -> f64 {
        match self {
            Unit::Mm => 1.0,
            Unit::Inch => 25.4,
        }
    }
}

impl Axis {
    /// Indices of the plane's two axes, in the order that makes the normal
    /// right-handed.
    pub fn plane(self) -> [usize; 2] {
        match self {
            Axis::X => [1, 2],
            Axis::Y => [2, 0],
            Axis::Z => [0, 1],
        }
    }
}

impl Action {
    /// End point of a motion; `None` for a tool change and a hole.
    pub fn end(&self) -> Option<Point> {
        match self {
            Action::Rapid(to) | Action::Feed(to, _) | Action::Reference(to) => Some(*to),
            Action::Arc(arc, _) => Some(arc.to),
            Action::Tool(_) | Action::Hole(..) => None,
        }
    }

    /// The same with all lengths multiplied.
    pub fn scaled(&self, factor: f64) -> Action {
        let point = |p: Point| p.map(|value| value * factor);
        let rate = |rate: Option<f64>| rate.map(|value| value * factor);
        match *self {
            Action::Tool(number) => Action::Tool(number),
            Action::Rapid(to) => Action::Rapid(point(to)),
            Action::Reference(to) => Action::Reference(point(to)),
            Action::Feed(to, f) => Action::Feed(point(to), rate(f)),
            Action::Arc(arc, f) => {
                Action::Arc(Arc { to: point(arc.to), center: point(arc.center), ..arc }, rate(f))
            }
            Action::Hole(hole, f) => {
                let hole = Hole {
                    at: hole.at.map(|value| value * factor),
                    bottom: hole.bottom * factor,
                    clearance: hole.clearance * factor,
                };
                Action::Hole(hole, rate(f))
            }
        }
    }
}
