//! NURBS, KNOT and CNTRL: a spline, read as lines within a tolerance.
//!
//! The knots tell the degree and how many control points belong to them, so the file says
//! its form itself; what does not agree with that is refused. Values behind the coordinates
//! of a control point are read where they change nothing: weights that are all the same, and
//! one tool axis for the whole spline.

use fil_diag::Result;

use super::Reader;
use crate::errors::ClCode;
use crate::forms::Outcome;
use crate::forms::spline::{Spline, degree_and_count};
use crate::forms::vector::{Vector, norm, sub};
use crate::layout::is_unit;
use crate::record::{Record, Word};
use crate::words;

/// A spline begins where the tool stands; CAM systems round to four decimals.
const NEAR: f64 = 1e-3;

/// A tool axis is the same as another one where no part differs by more.
const SAME_AXIS: f64 = 1e-4;

/// The tool axis before any is written.
const UPRIGHT: Vector = [0.0, 0.0, 1.0];

/// Most knots of a spline.
const MOST_KNOTS: usize = 100_000;

/// Tolerance in a file whose unit is millimetres and that names none, mm.
const TOLERANCE_MM: f64 = 1e-3;

/// Tolerance in other files that name none, in their unit.
const TOLERANCE: f64 = 1e-4;

/// Degree of the splines of NX.
const CUBIC: usize = 3;

/// The last knot of a spline of NX.
const LAST_KNOT: f64 = 1.0;

/// True for the knots that NX writes: those between the ends, and the last one once.
fn is_without_ends(knots: &[f64]) -> bool {
    let rises = knots.windows(2).all(|two| two[0] < two[1]);
    rises && knots.first().is_some_and(|first| *first > 0.0) && knots.last() == Some(&LAST_KNOT)
}

/// What is awaited while a spline is read.
const POINTS: &str = "the knots and control points of the NURBS";

/// Splines that were read as lines.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SplineCounts {
    /// Splines.
    pub splines: u32,
    /// Lines that they were made.
    pub lines: u64,
    /// The largest distance of a spline from its lines that was allowed, in the unit of the
    /// CL file.
    pub tolerance: f64,
}

/// The spline under way.
#[derive(Debug, Default)]
pub(super) struct Gathered {
    /// Line of its NURBS; 0 where there is none.
    line: u32,
    /// Records read before it.
    records: u32,
    /// Records of its own statements before the one under way.
    own: u32,
    /// Numbers of the NURBS statement.
    numbers: Vec<f64>,
    knots: Vec<f64>,
    points: Vec<Vector>,
    /// What stands behind the coordinates of its first control point.
    behind: Behind,
}

/// What stands behind the coordinates of a control point.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
enum Behind {
    #[default]
    Nothing,
    Weight(f64),
    Axis(Vector),
}

impl Behind {
    /// True where two control points say the same.
    fn agrees(self, other: Behind) -> bool {
        match (self, other) {
            (Behind::Axis(one), Behind::Axis(other)) => {
                one.iter().zip(other).all(|(a, b)| (a - b).abs() <= SAME_AXIS)
            }
            // A weight of 1 may be left out.
            (Behind::Nothing, Behind::Weight(1.0)) | (Behind::Weight(1.0), Behind::Nothing) => true,
            (one, other) => one == other,
        }
    }
}

impl Gathered {
    /// True from NURBS to the last control point.
    pub(super) fn is_under_way(&self) -> bool {
        self.line > 0
    }
}

impl Reader<'_> {
    /// The splines of the text so far that were read as lines.
    pub fn splines(&self) -> SplineCounts {
        self.spline_counts
    }

    /// Takes a statement of a spline; the last one makes the first GOTO of its lines.
    pub(super) fn take_spline(&mut self, record: &mut Record) -> Result<Outcome> {
        self.leans = self.spline.line == 0 || self.modal.point.is_none();
        let numbers = self.spline_numbers(record)?;
        if record.major == words::NURBS {
            self.refuse_expected()?;
            if self.modal.in_arc {
                return Err(self.spline_error("the CIRCLE before it has no end"));
            }
            self.spline = Gathered {
                line: record.line,
                records: self.number,
                numbers,
                ..Gathered::default()
            };
            self.modal.forms.expects = Some(POINTS);
            return Ok(Outcome::Nothing);
        }
        if !self.spline.is_under_way() {
            return Err(self.spline_error("a NURBS must come before it"));
        }
        // As they are written, the statements of a spline are records, too.
        self.spline.own += u32::from(self.keeps_meaning());
        if self.spline.records + self.spline.own != self.number {
            let message =
                format!("another statement came between it and line {}", self.spline.line);
            return Err(self.spline_error(&message));
        }
        if record.major == words::KNOT {
            return self.take_knots(&numbers);
        }
        self.take_control_point(record, &numbers)
    }

    fn spline_numbers(&self, record: &Record) -> Result<Vec<f64>> {
        let number = |(at, word): (usize, &Word)| match word {
            Word::Number(value) => Ok(*value),
            _ => Err(self.diag(ClCode::BadSpline, "a number is needed", self.item_range(at))),
        };
        record.data.iter().enumerate().map(number).collect()
    }

    fn take_knots(&mut self, numbers: &[f64]) -> Result<Outcome> {
        if !self.spline.points.is_empty() {
            return Err(self.spline_error("KNOT after CNTRL"));
        }
        if numbers.is_empty() || self.spline.knots.len() + numbers.len() > MOST_KNOTS {
            return Err(self.spline_error(&format!("from 1 to {MOST_KNOTS} knots are read")));
        }
        self.spline.knots.extend_from_slice(numbers);
        Ok(Outcome::Nothing)
    }

    fn take_control_point(&mut self, record: &mut Record, numbers: &[f64]) -> Result<Outcome> {
        let (point, behind) = match numbers[..] {
            [x, y, z] => ([x, y, z], Behind::Nothing),
            [x, y, z, weight] if weight > 0.0 => ([x, y, z], Behind::Weight(weight)),
            [x, y, z, i, j, k] if is_unit([i, j, k]) => ([x, y, z], Behind::Axis([i, j, k])),
            _ => {
                let message = "a control point has three numbers, with a weight above 0 four, \
                               with a tool axis of length 1 six";
                return Err(self.spline_error(message));
            }
        };
        if self.spline.points.is_empty() && is_without_ends(&self.spline.knots) {
            self.check_behind(point, behind)?;
            self.begin_where_the_tool_stands(behind)?;
        }
        let (degree, count) =
            degree_and_count(&self.spline.knots).map_err(|message| self.spline_error(&message))?;
        if self.spline.points.is_empty() {
            self.check_spline_begin(point, [degree, degree + 1, count, self.spline.knots.len()])?;
            self.check_behind(point, behind)?;
            self.spline.behind = behind;
        }
        if !behind.agrees(self.spline.behind) {
            let message = match behind {
                Behind::Axis(_) => {
                    "another tool axis than before: how it goes between control points is not known"
                }
                _ => {
                    "another weight than before: whether it multiplies the coordinates is not known"
                }
            };
            return Err(self.diag(ClCode::BadSpline, message, self.item_range(3)));
        }
        self.spline.points.push(point);
        if self.spline.points.len() < count {
            return Ok(Outcome::Nothing);
        }
        self.give_spline(record)
    }

    /// Adds to a cubic spline of NX what the file leaves out: the knots of its ends, and the first
    /// control point, where the tool stands.
    fn begin_where_the_tool_stands(&mut self, behind: Behind) -> Result<()> {
        let Some(start) = self.modal.point else {
            return Err(self.spline_error("a point to start from must come before the NURBS"));
        };
        let Gathered { knots, points, behind: first, .. } = &mut self.spline;
        let whole = [0.0; CUBIC + 1].into_iter().chain(knots.drain(..)).chain([LAST_KNOT; CUBIC]);
        *knots = whole.collect();
        points.push(start);
        *first = behind;
        Ok(())
    }

    /// Weights that are all the same change nothing, unless the coordinates are multiplied by
    /// them: then the first control point would not be where the tool stands. A tool axis must
    /// be the one that the tool has there.
    fn check_behind(&self, point: Vector, behind: Behind) -> Result<()> {
        let message = match behind {
            Behind::Weight(weight) if (weight - 1.0).abs() * norm(point) <= 2.0 * NEAR => {
                if weight == 1.0 {
                    return Ok(());
                }
                "whether this weight multiplies the coordinates is not known"
            }
            Behind::Axis(_) if !behind.agrees(Behind::Axis(self.modal.axis.unwrap_or(UPRIGHT))) => {
                "the spline begins with another tool axis than the tool has there"
            }
            _ => return Ok(()),
        };
        Err(self.diag(ClCode::BadSpline, message, self.item_range(3)))
    }

    /// The spline begins where the tool stands, and the numbers of its NURBS are its degree,
    /// its order, or how many control points or knots it has.
    fn check_spline_begin(&self, point: Vector, sizes: [usize; 4]) -> Result<()> {
        if let Some(number) = self
            .spline
            .numbers
            .iter()
            .find(|number| !sizes.iter().any(|size| *size as f64 == **number))
        {
            let [degree, _, points, knots] = sizes;
            let message = format!(
                "NURBS says {number}, but its knots are {knots}, for {points} control points and degree {degree}"
            );
            return Err(self.spline_error(&message));
        }
        match self.modal.point {
            Some(stands) if norm(sub(stands, point)) <= NEAR => Ok(()),
            Some(_) => {
                Err(self.spline_error("the first control point is not at the tool position"))
            }
            None => Err(self.spline_error("a point to start from must come before the NURBS")),
        }
    }

    /// The lines of the spline that is whole now, each as a GOTO. The first one goes to the
    /// first control point, so that a RAPID before the spline is rapid to there and no farther.
    fn give_spline(&mut self, record: &mut Record) -> Result<Outcome> {
        let tolerance = self.spline_tolerance();
        let Gathered { line, knots, points, behind, .. } = std::mem::take(&mut self.spline);
        self.modal.forms.expects = None;
        let start = points[0];
        let ends = Spline::new(knots, points).and_then(|spline| spline.lines(tolerance));
        let ends = ends.map_err(|message| self.spline_error(&message))?;
        if self.number >= self.splines_counted {
            self.splines_counted = self.number + 1;
            let counts = &mut self.spline_counts;
            counts.splines += 1;
            counts.lines += ends.len() as u64;
            counts.tolerance = counts.tolerance.max(tolerance);
        }
        let own = match behind {
            Behind::Axis(axis) => Some(axis),
            _ => None,
        };
        self.pending.give(&ends, own, line);
        self.modal.axis = own.or(self.modal.axis);
        *record = Record { line, ..Record::goto(start, own.or(self.axis_left_out())) };
        Ok(Outcome::Made)
    }

    /// What INTOL and OUTTOL of the file allow, the smaller one.
    fn spline_tolerance(&self) -> f64 {
        let forms = &self.modal.forms;
        let named = [forms.inner_tolerance, forms.outer_tolerance].into_iter().flatten();
        let own = if forms.is_metric { TOLERANCE_MM } else { TOLERANCE };
        named.reduce(f64::min).unwrap_or(own)
    }

    fn spline_error(&self, message: &str) -> Box<fil_diag::Diag> {
        self.diag(ClCode::BadSpline, message, 0..self.statement.joined.len())
    }

    /// INTOL/t and OUTTOL/t: how far lines may leave a curve, on either side.
    pub(super) fn keep_tolerance(&mut self, record: &Record) {
        let [Word::Number(value)] = record.data[..] else { return };
        let named = (value > 0.0).then_some(value);
        match record.major {
            words::INTOL => self.modal.forms.inner_tolerance = named,
            _ => self.modal.forms.outer_tolerance = named,
        }
    }
}
