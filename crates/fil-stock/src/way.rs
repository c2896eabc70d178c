//! The ways of a tool tip: straight lines and level arcs, and how low a tool comes over a point on
//! its way.

use crate::tool::Shape;

/// Halvings that find where a bull-nose or flat cone on a ramp is lowest.
const HALVINGS: usize = 22;

/// Length in XY below which a line is vertical, mm.
const VERTICAL: f64 = 1e-9;

/// The way of a tool tip, mm.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Way {
    /// A straight line.
    Line(Line),
    /// An arc at one height.
    Arc(Arc),
}

/// A straight line from a point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Line {
    from: [f64; 3],
    to: [f64; 3],
    /// Direction in XY; 0, 0 of a vertical line.
    direction: [f64; 2],
    /// Length in XY, mm.
    length: f64,
    /// Z for a mm in XY; 0 of a vertical line.
    slope: f64,
}

/// An arc in a plane across Z.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Arc {
    center: [f64; 2],
    height: f64,
    radius: f64,
    /// Direction of the start, radians.
    start: f64,
    /// Radians, above 0 counterclockwise.
    sweep: f64,
    ends: [[f64; 2]; 2],
}

impl Way {
    /// A straight line.
    pub fn line(from: [f64; 3], to: [f64; 3]) -> Way {
        let [x, y] = [to[0] - from[0], to[1] - from[1]];
        let length = libm::hypot(x, y);
        let (direction, length, slope) = if length < VERTICAL {
            ([0.0; 2], 0.0, 0.0)
        } else {
            ([x / length, y / length], length, (to[2] - from[2]) / length)
        };
        Way::Line(Line { from, to, direction, length, slope })
    }

    /// An arc at one height about a center, from a point by degrees, above 0 counterclockwise.
    pub fn arc(from: [f64; 3], center: [f64; 2], degrees: f64) -> Way {
        let [x, y] = [from[0] - center[0], from[1] - center[1]];
        let (start, sweep, radius) = (libm::atan2(y, x), degrees.to_radians(), libm::hypot(x, y));
        let (sine, cosine) = libm::sincos(start + sweep);
        let end = [center[0] + radius * cosine, center[1] + radius * sine];
        let ends = [[from[0], from[1]], end];
        Way::Arc(Arc { center, height: from[2], radius, start, sweep, ends })
    }

    /// True when only Z changes, or nothing.
    pub fn is_vertical(&self) -> bool {
        matches!(self, Way::Line(line) if line.length == 0.0)
    }

    /// True when it goes straight down.
    pub fn is_plunge(&self) -> bool {
        matches!(self, Way::Line(line) if line.length == 0.0 && line.to[2] < line.from[2])
    }

    /// The lowest Z of the tip, mm.
    pub fn lowest_tip(&self) -> f64 {
        match self {
            Way::Line(line) => line.from[2].min(line.to[2]),
            Way::Arc(arc) => arc.height,
        }
    }

    /// The same way, higher by a length.
    pub(crate) fn raised(&self, by: f64) -> Way {
        let mut way = *self;
        match &mut way {
            Way::Line(line) => {
                line.from[2] += by;
                line.to[2] += by;
            }
            Way::Arc(arc) => arc.height += by,
        }
        way
    }

    /// Least and greatest X and Y of the tip, mm.
    pub(crate) fn bounds(&self) -> [[f64; 2]; 2] {
        match self {
            Way::Line(line) => [0, 1].map(|axis| {
                let (a, b) = (line.from[axis], line.to[axis]);
                [a.min(b), a.max(b)]
            }),
            Way::Arc(arc) => arc.bounds(),
        }
    }

    /// Least and greatest X at which a tool of a radius may touch what has this Y.
    pub(crate) fn reach(&self, y: f64, radius: f64) -> [f64; 2] {
        let Way::Line(line) = self else {
            let [x, _] = self.bounds();
            return [x[0] - radius, x[1] + radius];
        };
        let rise = line.to[1] - line.from[1];
        let (mut low, mut high) = (0.0f64, 1.0f64);
        if rise.abs() > VERTICAL {
            let shares = [-radius, radius].map(|off| (y + off - line.from[1]) / rise);
            low = low.max(shares[0].min(shares[1]));
            high = high.min(shares[0].max(shares[1]));
        }
        let at = |share: f64| line.from[0] + (line.to[0] - line.from[0]) * share.clamp(0.0, 1.0);
        let (a, b) = (at(low), at(high));
        [a.min(b) - radius, a.max(b) + radius]
    }

    /// How low the surface of a tool comes over a point on its way, mm; `None` where it does not
    /// get there.
    pub fn lowest(&self, shape: &Shape, at: [f64; 2]) -> Option<f64> {
        self.lowest_below(shape, at, f64::INFINITY)
    }

    /// The same where it may be below a height; `None` where it is not, if that is quickly seen.
    pub(crate) fn lowest_below(&self, shape: &Shape, at: [f64; 2], below: f64) -> Option<f64> {
        match self {
            Way::Line(line) => line.lowest(shape, at, below),
            Way::Arc(arc) => {
                let distance = arc.distance(at);
                (distance <= shape.radius()).then(|| arc.height + shape.height(distance))
            }
        }
    }

    /// How far along its way in XY the tip is nearest to a point, mm.
    pub(crate) fn along(&self, at: [f64; 2]) -> f64 {
        match self {
            Way::Line(line) => line.split(at).0.clamp(0.0, line.length),
            Way::Arc(arc) => arc.angle(at).min(arc.sweep.abs()) * arc.radius,
        }
    }
}

impl Line {
    /// A point as length along the line and distance from it.
    fn split(&self, at: [f64; 2]) -> (f64, f64) {
        let [x, y] = [at[0] - self.from[0], at[1] - self.from[1]];
        if self.length == 0.0 {
            return (0.0, libm::hypot(x, y));
        }
        let [along, across] = self.direction;
        (x * along + y * across, (y * along - x * across).abs())
    }

    fn lowest(&self, shape: &Shape, at: [f64; 2], below: f64) -> Option<f64> {
        let (along, distance) = self.split(at);
        let radius = shape.radius();
        let half = radius * radius - distance * distance;
        if half < 0.0 {
            return None;
        }
        if self.length == 0.0 {
            return Some(self.from[2].min(self.to[2]) + shape.height(distance));
        }
        let beyond = along - along.clamp(0.0, self.length);
        let nearest = (distance * distance + beyond * beyond).sqrt();
        if nearest > radius || self.from[2].min(self.to[2]) + shape.height(nearest) >= below {
            return None;
        }
        let half = half.sqrt();
        let (first, last) = ((along - half).max(0.0), (along + half).min(self.length));
        if first > last {
            return None;
        }
        // The height over the point is a convex function of the length along the line: where it
        // is least lies on the side that goes down, and beyond the ends of the line at them.
        let off = if self.slope == 0.0 {
            0.0
        } else {
            lowest_off(shape, distance, half, self.slope.abs())
        };
        let best = if self.slope > 0.0 { along - off } else { along + off };
        let best = best.clamp(first, last);
        let gap = best - along;
        let away = (distance * distance + gap * gap).sqrt().min(radius);
        Some(self.from[2] + self.slope * best + shape.height(away))
    }
}

/// How far beside the nearest point of a falling line the tool comes lowest: where its surface
/// rises as steeply as the line falls. `half` is the most.
fn lowest_off(shape: &Shape, distance: f64, half: f64, slope: f64) -> f64 {
    let flat = shape.flat();
    let begin = (flat * flat - distance * distance).max(0.0).sqrt().min(half);
    match *shape {
        Shape::Round { corner: 0.0, .. } => half,
        Shape::Round { corner, .. } if flat == 0.0 => {
            let reach = (corner * corner - distance * distance).max(0.0).sqrt();
            slope * reach / (1.0 + slope * slope).sqrt()
        }
        Shape::Cone { tip: 0.0, rise, .. } => {
            if slope >= rise {
                half
            } else {
                slope * distance / (rise * rise - slope * slope).sqrt()
            }
        }
        _ => {
            let is_steep = |off: f64| {
                let away = (distance * distance + off * off).sqrt();
                away > 0.0 && shape.slope(away) * off / away >= slope
            };
            let (mut low, mut high) = (begin, half);
            for _ in 0..HALVINGS {
                let middle = (low + high) / 2.0;
                if is_steep(middle) { high = middle } else { low = middle }
            }
            (low + high) / 2.0
        }
    }
}

impl Arc {
    /// Least and greatest X and Y: those of its ends, and of the circle where it goes through.
    fn bounds(&self) -> [[f64; 2]; 2] {
        let [start, end] = self.ends;
        let mut bounds =
            [0, 1].map(|axis| [start[axis].min(end[axis]), start[axis].max(end[axis])]);
        for (axis, side, sign) in [(0, 1, 1.0), (0, 0, -1.0), (1, 1, 1.0), (1, 0, -1.0)] {
            let mut at = self.center;
            at[axis] += sign * self.radius;
            if self.angle(at) <= self.sweep.abs() {
                bounds[axis][side] = at[axis];
            }
        }
        bounds
    }

    /// The angle from the start to a point in the direction of the arc, radians from 0.
    fn angle(&self, at: [f64; 2]) -> f64 {
        let direction = libm::atan2(at[1] - self.center[1], at[0] - self.center[0]);
        let turned = if self.sweep < 0.0 { self.start - direction } else { direction - self.start };
        let full = std::f64::consts::TAU;
        turned - full * (turned / full).floor()
    }

    /// Distance of a point from the arc, mm.
    fn distance(&self, at: [f64; 2]) -> f64 {
        let [x, y] = [at[0] - self.center[0], at[1] - self.center[1]];
        let to_circle = ((x * x + y * y).sqrt() - self.radius).abs();
        if self.angle(at) <= self.sweep.abs() {
            return to_circle;
        }
        let to = |end: [f64; 2]| libm::hypot(at[0] - end[0], at[1] - end[1]);
        to(self.ends[0]).min(to(self.ends[1]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::tool::Shape;
    use proptest::prelude::*;

    fn shapes() -> impl Strategy<Value = Shape> {
        let round = (0.5..20.0f64, prop_oneof![Just(0.0), Just(1.0), 0.0..=1.0f64])
            .prop_map(|(radius, share)| Shape::Round { radius, corner: radius * share });
        let cone = (0.5..20.0f64, prop_oneof![Just(0.0), 0.0..0.9f64], 0.1..3.0f64)
            .prop_map(|(radius, share, rise)| Shape::Cone { radius, tip: radius * share, rise });
        prop_oneof![round, cone]
    }

    fn point() -> impl Strategy<Value = [f64; 3]> {
        proptest::array::uniform3(-15.0..15.0f64)
    }

    proptest! {
        /// No sample of the way is lower than what is found, and one is about as low.
        #[test]
        fn a_line_is_lowest_where_samples_are(
            shape in shapes(), from in point(), to in point(), at in proptest::array::uniform2(-20.0..20.0f64),
        ) {
            let found = Way::line(from, to).lowest(&shape, at);
            let mut least = f64::INFINITY;
            let mut nearest = f64::INFINITY;
            for step in 0..=4000 {
                let share = f64::from(step) / 4000.0;
                let tip = [0, 1, 2].map(|axis| from[axis] + (to[axis] - from[axis]) * share);
                let away = libm::hypot(at[0] - tip[0], at[1] - tip[1]);
                nearest = nearest.min(away);
                if away <= shape.radius() {
                    least = least.min(tip[2] + shape.height(away));
                }
            }
            match found {
                None => prop_assert!(nearest >= shape.radius() - 1e-9),
                Some(found) => {
                    // Where the edge of the tool is as steep as the way, rounding counts most.
                    prop_assert!(found <= least + 1e-5, "{} above {}", found, least);
                    // A steep edge is met between two samples.
                    let is_at_edge = (nearest - shape.radius()).abs() < 0.02
                        || libm::hypot(to[0] - from[0], to[1] - from[1]) < 0.5;
                    let step = 0.1 + (to[2] - from[2]).abs() / 500.0;
                    prop_assert!(is_at_edge || found >= least - step, "{} below {}", found, least);
                }
            }
        }

        /// The same for arcs, whose samples are dense.
        #[test]
        fn an_arc_is_nearest_where_samples_are(
            from in point(), center in proptest::array::uniform2(-10.0..10.0f64),
            degrees in -360.0..360.0f64, at in proptest::array::uniform2(-30.0..30.0f64),
        ) {
            let Way::Arc(arc) = Way::arc(from, center, degrees) else { unreachable!() };
            let spoke = [from[0] - center[0], from[1] - center[1]];
            let sample = |step: i32| {
                let (sine, cosine) = libm::sincos((degrees * f64::from(step) / 3600.0).to_radians());
                let x = center[0] + spoke[0] * cosine - spoke[1] * sine;
                let y = center[1] + spoke[0] * sine + spoke[1] * cosine;
                libm::hypot(at[0] - x, at[1] - y)
            };
            let nearest = (0..=3600).map(sample).fold(f64::INFINITY, f64::min);
            prop_assert!((arc.distance(at) - nearest).abs() < 0.03, "{} {}", arc.distance(at), nearest);
        }

        /// A tool reaches nothing beside what `reach` says.
        #[test]
        fn nothing_is_touched_out_of_reach(
            shape in shapes(), from in point(), to in point(), at in proptest::array::uniform2(-30.0..30.0f64),
        ) {
            let way = Way::line(from, to);
            if way.lowest(&shape, at).is_some() {
                let [low, high] = way.reach(at[1], shape.radius());
                prop_assert!(low - 1e-9 <= at[0] && at[0] <= high + 1e-9);
            }
        }
    }
}
