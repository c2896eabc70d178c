//! The section of a groove: lines and arcs in the plane XZ, from the surface of the
//! blank down to the bottom and up again.

use std::f64::consts::TAU;
use std::fmt::Write;

/// X and Z, mm.
pub type Point = [f64; 2];

/// The way from a point of the section to the next.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Step {
    /// A straight line.
    Line(Point),
    /// An arc about a center; `hollow` when the center lies on the side of the
    /// groove.
    Arc {
        /// End.
        to: Point,
        /// Center.
        center: Point,
        /// The arc is a hollow, not a hump.
        hollow: bool,
    },
}

/// A section.
#[derive(Clone, Debug)]
pub struct Section {
    /// First point.
    pub from: Point,
    /// The rest.
    pub steps: Vec<Step>,
}

impl Step {
    /// Where it ends.
    pub fn to(&self) -> Point {
        match self {
            Step::Line(to) | Step::Arc { to, .. } => *to,
        }
    }

    /// Point at a share of the way, and the unit normal into the groove.
    fn at(&self, from: Point, share: f64) -> (Point, Point) {
        match *self {
            Step::Line(to) => {
                let way = minus(to, from);
                let length = norm(way);
                (plus(from, way, share), [-way[1] / length, way[0] / length])
            }
            Step::Arc { to, center, hollow } => {
                let (start, sweep) = angles(from, to, center, hollow);
                let angle = start + sweep * share;
                let out = [angle.cos(), angle.sin()];
                let point = plus(center, out, norm(minus(from, center)));
                (point, if hollow { [-out[0], -out[1]] } else { out })
            }
        }
    }

    fn length(&self, from: Point) -> f64 {
        match *self {
            Step::Line(to) => norm(minus(to, from)),
            Step::Arc { to, center, hollow } => {
                norm(minus(from, center)) * angles(from, to, center, hollow).1.abs()
            }
        }
    }

    fn distance(&self, from: Point, point: Point) -> f64 {
        let to = self.to();
        let ends = norm(minus(point, from)).min(norm(minus(point, to)));
        match *self {
            Step::Line(_) => {
                let way = minus(to, from);
                let share = dot(minus(point, from), way) / dot(way, way);
                if (0.0..=1.0).contains(&share) {
                    norm(minus(point, plus(from, way, share)))
                } else {
                    ends
                }
            }
            Step::Arc { center, hollow, .. } => {
                let (start, sweep) = angles(from, to, center, hollow);
                let out = minus(point, center);
                let turned = (out[1].atan2(out[0]) - start) * sweep.signum();
                if turned.rem_euclid(TAU) <= sweep.abs() {
                    (norm(out) - norm(minus(from, center))).abs()
                } else {
                    ends
                }
            }
        }
    }
}

/// Start angle and signed sweep of an arc: a hollow turns counterclockwise.
fn angles(from: Point, to: Point, center: Point, hollow: bool) -> (f64, f64) {
    let angle = |p: Point| (p[1] - center[1]).atan2(p[0] - center[0]);
    let (start, end) = (angle(from), angle(to));
    let sweep = if hollow { (end - start).rem_euclid(TAU) } else { -(start - end).rem_euclid(TAU) };
    (start, sweep)
}

impl Section {
    /// A section of straight lines.
    pub fn lines(points: &[Point]) -> Self {
        let steps = points[1..].iter().map(|point| Step::Line(*point)).collect();
        Section { from: points[0], steps }
    }

    /// Straight lines whose inner corners are rounded with a radius each, 0 for a
    /// sharp one.
    pub fn rounded(points: &[Point], radii: &[f64]) -> Self {
        let mut section = Section { from: points[0], steps: Vec::new() };
        for (corner, radius) in points.windows(3).zip(radii) {
            let [before, at, after] = [corner[0], corner[1], corner[2]];
            let (back, on) = (unit(minus(before, at)), unit(minus(after, at)));
            if *radius == 0.0 {
                section.steps.push(Step::Line(at));
                continue;
            }
            let half = dot(back, on).acos() / 2.0;
            let (first, last) =
                (plus(at, back, radius / half.tan()), plus(at, on, radius / half.tan()));
            let middle = unit([back[0] + on[0], back[1] + on[1]]);
            let center = plus(at, middle, radius / half.sin());
            let hollow = back[1] * on[0] - back[0] * on[1] > 0.0;
            section.line(first);
            section.steps.push(Step::Arc { to: last, center, hollow });
        }
        section.line(points[points.len() - 1]);
        section
    }

    /// A line, unless the section is there already.
    fn line(&mut self, to: Point) {
        let at = self.steps.last().map_or(self.from, Step::to);
        if norm(minus(to, at)) > 1e-9 {
            self.steps.push(Step::Line(to));
        }
    }

    /// Left and right exchanged.
    pub fn mirrored(&self) -> Self {
        let [first, last] = self.ends();
        let turned = |point: Point| [first + last - point[0], point[1]];
        let parts: Vec<(Point, &Step)> = self.parts().collect();
        let steps = parts.iter().rev().map(|(from, step)| match **step {
            Step::Line(_) => Step::Line(turned(*from)),
            Step::Arc { center, hollow, .. } => {
                Step::Arc { to: turned(*from), center: turned(center), hollow }
            }
        });
        Section { from: turned([last, self.top()]), steps: steps.collect() }
    }

    /// The section as a CL file of so many decimals has it.
    pub fn cut_off(&self, decimals: i32) -> Self {
        let unit = 10_f64.powi(decimals);
        let cut = |point: Point| point.map(|value| (value * unit).round() / unit);
        let steps = self.steps.iter().map(|step| match *step {
            Step::Line(to) => Step::Line(cut(to)),
            Step::Arc { to, center, hollow } => {
                Step::Arc { to: cut(to), center: cut(center), hollow }
            }
        });
        Section { from: cut(self.from), steps: steps.collect() }
    }

    /// Z of the surface of the blank.
    pub fn top(&self) -> f64 {
        self.from[1]
    }

    /// X of both ends.
    pub fn ends(&self) -> [f64; 2] {
        [self.from[0], self.steps.last().map_or(self.from, Step::to)[0]]
    }

    /// The records of the section in a CL file.
    pub fn cl(&self) -> String {
        let mut text = format!("GOTO / {}, 0, {}\n", self.from[0], self.from[1]);
        for (from, step) in self.parts() {
            if let Step::Arc { center, hollow, .. } = step {
                let turn = if *hollow { -1 } else { 1 };
                let radius = norm(minus(from, *center));
                let _ = writeln!(
                    text,
                    "CIRCLE / {}, 0, {}, 0, {turn}, 0, {radius}",
                    center[0], center[1]
                );
            }
            let _ = writeln!(text, "GOTO / {}, 0, {}", step.to()[0], step.to()[1]);
        }
        text
    }

    /// Each step with its start.
    fn parts(&self) -> impl Iterator<Item = (Point, &Step)> {
        let starts = std::iter::once(self.from).chain(self.steps.iter().map(Step::to));
        starts.zip(&self.steps)
    }

    /// Distance of a point from the section.
    pub fn distance(&self, point: Point) -> f64 {
        self.parts().map(|(from, step)| step.distance(from, point)).fold(f64::INFINITY, f64::min)
    }

    /// Distance of a point from the section, negative in the finished part.
    pub fn signed(&self, point: Point) -> f64 {
        let distance = self.distance(point);
        if point[1] < self.height(point[0]) { -distance } else { distance }
    }

    /// Points of the section about `spacing` apart with their normals into the groove.
    pub fn samples(&self, spacing: f64) -> Vec<(Point, Point)> {
        let mut samples = Vec::new();
        for (from, step) in self.parts() {
            let count = (step.length(from) / spacing).ceil().max(1.0);
            for index in 0..=count as usize {
                samples.push(step.at(from, index as f64 / count));
            }
        }
        samples
    }

    /// Height of the finished part at an X: the section, and the surface beside it.
    pub fn height(&self, x: f64) -> f64 {
        let spans = |from: Point, to: Point| from[0] <= x && x < to[0];
        let Some((from, step)) = self.parts().find(|(from, step)| spans(*from, step.to())) else {
            return self.top();
        };
        match *step {
            Step::Line(to) => from[1] + (to[1] - from[1]) * (x - from[0]) / (to[0] - from[0]),
            Step::Arc { center, hollow, .. } => {
                let out = minus(from, center);
                let rise = (dot(out, out) - (x - center[0]).powi(2)).max(0.0).sqrt();
                if hollow { center[1] - rise } else { center[1] + rise }
            }
        }
    }
}

/// Length.
pub fn norm(a: Point) -> f64 {
    a[0].hypot(a[1])
}

/// Difference.
pub fn minus(a: Point, b: Point) -> Point {
    [a[0] - b[0], a[1] - b[1]]
}

/// `a` and `share` times `b`.
pub fn plus(a: Point, b: Point, share: f64) -> Point {
    [a[0] + b[0] * share, a[1] + b[1] * share]
}

fn dot(a: Point, b: Point) -> f64 {
    a[0] * b[0] + a[1] * b[1]
}

fn unit(a: Point) -> Point {
    let length = norm(a);
    [a[0] / length, a[1] / length]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_rounded_corner_lies_between_its_lines() {
        let section =
            Section::rounded(&[[0.0, 10.0], [0.0, 4.0], [8.0, 4.0], [8.0, 10.0]], &[2.0, 3.0]);
        assert_eq!(section.steps.len(), 5);
        assert!((section.height(4.0) - 4.0).abs() < 1e-12);
        assert!((section.height(0.5) - (6.0 - 1.75_f64.sqrt())).abs() < 1e-12);
        assert!((section.distance([2.0, 6.0]) - 2.0).abs() < 1e-12);
        assert!((section.distance([5.0, 7.0]) - 3.0).abs() < 1e-12);
        for (point, normal) in section.samples(0.1) {
            assert!(section.distance(point) < 1e-12);
            let inside = plus(point, normal, 0.01);
            assert!(section.height(inside[0]) < inside[1] + 1e-12, "{point:?}");
        }
    }

    #[test]
    fn a_rounded_lip_is_a_hump() {
        let section =
            Section::rounded(&[[0.0, 10.0], [2.0, 10.0], [4.0, 4.0], [8.0, 10.0]], &[1.0, 0.0]);
        assert!(matches!(section.steps[1], Step::Arc { hollow: false, .. }));
    }
}
