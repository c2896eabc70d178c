//! B-splines as lines within a tolerance.
//!
//! A span between two knots is a polynomial, and so a Bezier curve. A Bezier curve lies in
//! the convex hull of its control points, so none of its points is farther from its chord
//! than the farthest control point. A span is halved until that distance is within the
//! tolerance: the bound holds for each point of the curve, not for samples of it.

use super::vector::{Vector, add, dot, norm, sub};

/// The highest degree that is read. CAM systems write cubic splines.
const HIGHEST_DEGREE: usize = 9;

/// Most lines of one spline.
const MOST_LINES: usize = 100_000;

/// Halvings of a span beyond which the tolerance is too small for its numbers.
const MOST_HALVINGS: u32 = 24;

/// A B-spline that begins at its first control point and ends at its last one.
#[derive(Debug)]
pub(crate) struct Spline {
    degree: usize,
    knots: Vec<f64>,
    points: Vec<Vector>,
}

/// Degree of the spline of these knots, and the number of its control points.
///
/// A curve from the first control point to the last one of degree `p` has its first and its
/// last knot `p + 1` times, and `p + 1` knots more than control points.
///
/// # Errors
/// Knots of no such spline.
pub(crate) fn degree_and_count(knots: &[f64]) -> Result<(usize, usize), String> {
    if let Some(at) = (1..knots.len()).find(|at| knots[*at] < knots[at - 1]) {
        return Err(format!("knot {} is {}, below the one before it", at + 1, knots[at]));
    }
    let runs: Vec<usize> = knots.chunk_by(|a, b| a == b).map(<[f64]>::len).collect();
    let [order, inner @ .., last] = &runs[..] else {
        return Err("knots that are all the same, or none".to_string());
    };
    if order != last {
        return Err(format!("the first knot comes {order} times, the last one {last} times"));
    }
    if !(2..=HIGHEST_DEGREE + 1).contains(order) {
        return Err(format!(
            "the first knot comes {order} times, which is not a degree from 1 to {HIGHEST_DEGREE}"
        ));
    }
    if inner.iter().any(|times| times >= order) {
        return Err("an inner knot is repeated so often that the curve has a gap".to_string());
    }
    Ok((order - 1, knots.len() - order))
}

impl Spline {
    /// The spline of these knots and control points.
    ///
    /// # Errors
    /// As [`degree_and_count`], and another number of control points.
    pub(crate) fn new(knots: Vec<f64>, points: Vec<Vector>) -> Result<Self, String> {
        let (degree, count) = degree_and_count(&knots)?;
        if points.len() != count {
            return Err(format!("{} control points, where {count} belong", points.len()));
        }
        Ok(Spline { degree, knots, points })
    }

    /// Where its lines end, in order. No point of the spline is farther from its line than
    /// `tolerance`.
    ///
    /// # Errors
    /// So many lines that the tolerance must be wrong.
    pub(crate) fn lines(&self, tolerance: f64) -> Result<Vec<Vector>, String> {
        let mut ends = Vec::new();
        for span in self.degree..self.points.len() {
            if self.knots[span] < self.knots[span + 1] {
                divide(&self.bezier(span), tolerance, MOST_HALVINGS, &mut ends)?;
            }
        }
        Ok(ends)
    }

    /// Control points of the Bezier curve between knot `span` and the next one: its blossom
    /// with `i` arguments at the end and the others at the start.
    fn bezier(&self, span: usize) -> Vec<Vector> {
        let (start, end) = (self.knots[span], self.knots[span + 1]);
        let control = |at_end: usize| {
            let at = |argument: usize| if argument <= self.degree - at_end { start } else { end };
            self.blossom(span, at)
        };
        (0..=self.degree).map(control).collect()
    }

    /// De Boor's recursion with an argument of its own, from 1, at each level.
    fn blossom(&self, span: usize, argument: impl Fn(usize) -> f64) -> Vector {
        let first = span - self.degree;
        let mut points = self.points[first..=span].to_vec();
        for level in 1..=self.degree {
            for at in (level..=self.degree).rev() {
                let low = self.knots[first + at];
                let high = self.knots[first + at + self.degree + 1 - level];
                let share = (argument(level) - low) / (high - low);
                points[at] = add(points[at - 1], sub(points[at], points[at - 1]), share);
            }
        }
        points[self.degree]
    }
}

/// Adds the ends of the lines of a Bezier curve.
fn divide(
    curve: &[Vector],
    tolerance: f64,
    halvings: u32,
    ends: &mut Vec<Vector>,
) -> Result<(), String> {
    if bulge(curve) <= tolerance {
        ends.push(curve[curve.len() - 1]);
        return if ends.len() > MOST_LINES {
            Err(format!("more than {MOST_LINES} lines for a tolerance of {tolerance}"))
        } else {
            Ok(())
        };
    }
    if halvings == 0 {
        return Err(format!("a tolerance of {tolerance} is too small for its numbers"));
    }
    let [first, second] = halves(curve);
    divide(&first, tolerance, halvings - 1, ends)?;
    divide(&second, tolerance, halvings - 1, ends)
}

/// The largest distance of a control point from the chord.
fn bulge(curve: &[Vector]) -> f64 {
    let (start, chord) = (curve[0], sub(curve[curve.len() - 1], curve[0]));
    let square = dot(chord, chord);
    let distance = |point: &Vector| {
        let out = sub(*point, start);
        let along = if square > 0.0 { (dot(out, chord) / square).clamp(0.0, 1.0) } else { 0.0 };
        norm(add(out, chord, -along))
    };
    curve.iter().map(distance).fold(0.0, f64::max)
}

/// Both halves of a Bezier curve, by de Casteljau.
fn halves(curve: &[Vector]) -> [Vec<Vector>; 2] {
    let mut points = curve.to_vec();
    let (mut first, mut second) = (vec![points[0]], vec![points[points.len() - 1]]);
    while points.len() > 1 {
        points = points.windows(2).map(|two| add(two[0], sub(two[1], two[0]), 0.5)).collect();
        first.push(points[0]);
        second.push(points[points.len() - 1]);
    }
    second.reverse();
    [first, second]
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    /// The spline by its basis functions, as Cox and de Boor define them; it shares nothing
    /// with the blossom. `u` lies below the last knot.
    fn by_basis(spline: &Spline, u: f64) -> Vector {
        fn basis(knots: &[f64], i: usize, degree: usize, u: f64) -> f64 {
            let inside = knots[i] <= u && u < knots[i + degree + 1];
            if degree == 0 || !inside {
                return f64::from(u8::from(inside));
            }
            let part =
                |low: f64, high: f64, by: f64| if high > low { by / (high - low) } else { 0.0 };
            let rising = part(knots[i], knots[i + degree], u - knots[i]);
            let falling = part(knots[i + 1], knots[i + degree + 1], knots[i + degree + 1] - u);
            rising * basis(knots, i, degree - 1, u) + falling * basis(knots, i + 1, degree - 1, u)
        }
        (0..spline.points.len()).fold([0.0; 3], |sum, i| {
            add(sum, spline.points[i], basis(&spline.knots, i, spline.degree, u))
        })
    }

    fn distance(point: Vector, [from, to]: [Vector; 2]) -> f64 {
        bulge(&[from, point, to])
    }

    prop_compose! {
        /// Splines with knots that come once or several times.
        fn splines()(degree in 1..=5usize)(
            degree in Just(degree),
            steps in prop::collection::vec((0.1..3.0f64, 1..=degree), 0..8),
            last in 0.1..3.0f64,
            size in prop_oneof![Just(0.01), Just(1.0), Just(500.0)],
            points in prop::collection::vec([-1.0..1.0f64, -1.0..1.0f64, -1.0..1.0f64], 60),
        ) -> Spline {
            let mut knots = vec![-1.0; degree + 1];
            let mut knot = -1.0;
            for (step, times) in steps {
                knot += step;
                knots.extend(vec![knot; times]);
            }
            knots.extend(vec![knot + last; degree + 1]);
            let count = knots.len() - degree - 1;
            let points = points[..count].iter().map(|p| p.map(|part| part * size)).collect();
            Spline::new(knots, points).unwrap()
        }
    }

    proptest! {
        /// Each of many points of the spline lies within the tolerance of the lines, in
        /// their order, and each line ends on the spline.
        #[test]
        fn the_bound_holds(spline in splines(), tolerance in prop_oneof![Just(1e-3), Just(0.1)]) {
            let ends = spline.lines(tolerance).unwrap();
            let path: Vec<Vector> = std::iter::once(spline.points[0]).chain(ends).collect();
            prop_assert!(norm(sub(*path.last().unwrap(), *spline.points.last().unwrap())) < 1e-9);
            let (first, last) = (spline.knots[0], *spline.knots.last().unwrap());
            let count = 2000 + 20 * path.len().min(500);
            let at = |sample: usize| first + (last - first) * sample as f64 / count as f64;
            let samples: Vec<Vector> = (0..count).map(|n| by_basis(&spline, at(n))).collect();
            let mut line = 0;
            for (n, point) in samples.iter().enumerate() {
                // The lines are left behind one by one, and none is needed again.
                let near = |line: &usize| {
                    distance(*point, [path[*line], path[*line + 1]]) <= tolerance + 1e-9
                };
                let next = (line..path.len() - 1).find(near);
                prop_assert!(next.is_some(), "sample {n} of {count} is off line {line}");
                line = next.unwrap();
            }
            let gap = samples.windows(2).map(|two| norm(sub(two[1], two[0]))).fold(0.0, f64::max);
            let mut from = 0;
            for end in &path[..path.len() - 1] {
                let near = |sample: &Vector| norm(sub(*sample, *end)) <= gap + 1e-9;
                let next = samples[from..].iter().position(near);
                prop_assert!(next.is_some(), "{end:?} is not on the spline behind sample {from}");
                from += next.unwrap();
            }
        }

        #[test]
        fn a_straight_spline_is_a_line_a_span(count in 4..20usize) {
            let mut knots = vec![0.0; 4];
            knots.extend((1..count - 3).map(|knot| knot as f64));
            knots.extend(vec![(count - 3) as f64; 4]);
            let points = (0..count).map(|at| [at as f64, 0.0, 0.0]).collect();
            let spline = Spline::new(knots, points).unwrap();
            prop_assert_eq!(spline.lines(1e-6).unwrap().len(), count - 3);
        }
    }

    #[test]
    fn knots_of_no_spline() {
        for (knots, said) in [
            (&[0.0, 0.0, 1.0, 0.5, 2.0, 2.0][..], "below the one before"),
            (&[0.0, 0.0, 0.0, 1.0, 1.0], "3 times, the last one 2"),
            (&[0.0, 1.0, 2.0], "degree"),
            (&[0.0; 8], "all the same"),
            (&[], "or none"),
            (&[0.0, 0.0, 1.0, 1.0, 2.0, 2.0], "gap"),
        ] {
            let error = degree_and_count(knots).unwrap_err();
            assert!(error.contains(said), "{knots:?}: {error}");
        }
        assert_eq!(degree_and_count(&[0.0, 0.0, 0.0, 0.0, 1.0, 1.0, 1.0, 1.0]), Ok((3, 4)));
        assert!(Spline::new(vec![0.0, 0.0, 1.0, 1.0], vec![[0.0; 3]]).is_err());
    }

    #[test]
    fn a_tolerance_that_no_line_holds() {
        let bow = vec![[0.0; 3], [1e9, 1e9, 0.0], [2e9, 0.0, 0.0]];
        let spline = Spline::new(vec![0.0, 0.0, 0.0, 1.0, 1.0, 1.0], bow).unwrap();
        assert!(spline.lines(1e-6).is_err());
    }
}
