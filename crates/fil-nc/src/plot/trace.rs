//! Pieces put together to a trace, and CL files as traces.

use fil_cl::Reader;
use fil_diag::Diag;
use fil_machine::Commons;
use fil_machine::input_matrix::input_matrix;
use fil_machine::locations as loc;
use nalgebra::{Point3, Rotation3, Unit};

use super::sample::{arc_step, shares_of};
use super::{Change, Extent, InForce, Piece, Point, Stroke, Trace};
use crate::motion::{Modes, Move, Rate, SpindleModes};
use crate::verify::{Arc, ClPath, ExpectedStep, Hole};

/// Chords of arcs leave them by this part of the size of the picture.
const FINENESS: f64 = 1.0 / 20_000.0;

/// Least chord tolerance, mm.
const LEAST: f64 = 1e-4;

/// What lies farther is not drawn, mm.
const FARTHEST: f64 = 1e12;

/// Puts pieces together.
#[derive(Default)]
pub(super) struct Builder {
    pub(super) trace: Trace,
    /// Where the pen stands; `None` while that is not known.
    pub(super) pen: Option<Point>,
    /// Tool changes before the first point.
    waiting: Vec<(u32, u32)>,
}

impl Builder {
    /// Lifts the pen to a point.
    pub(super) fn put(&mut self, to: Point) {
        self.pen = is_place(&to).then_some(to);
        if self.pen.is_none() {
            return;
        }
        let from = self.trace.pieces.len();
        for (line, tool) in std::mem::take(&mut self.waiting) {
            self.trace.changes.push(Change { at: to, tool, line, from });
        }
    }

    /// Draws through points; what has no length is left out. True when a piece was made.
    pub(super) fn draw(
        &mut self,
        stroke: Stroke,
        line: u32,
        through: impl IntoIterator<Item = Point>,
    ) -> bool {
        let Some(from) = self.pen else { return false };
        let points = &mut self.trace.points;
        if points.last() != Some(&from) {
            points.push(from);
        }
        let start = points.len() - 1;
        for point in through.into_iter().filter(is_place) {
            if points.last() != Some(&point) {
                points.push(point);
            }
        }
        let end = points.len();
        if end > start + 1 {
            self.pen = points.last().copied();
            let (start, end) = (start as u32, end as u32);
            self.trace.pieces.push(Piece { stroke, line, start, end });
            return true;
        }
        false
    }

    /// Notes what is in force at the piece that was drawn last, where it is something else.
    pub(super) fn note(&mut self, motion: &Move, axis: Point) {
        let from = self.trace.pieces.len() - 1;
        let last = self.trace.in_force.last();
        let feed = match (motion.rate, last) {
            (None, last) => last.and_then(|last| last.feed),
            (Some(Rate::Inverse(inverse)), _) => {
                Some(Rate::PerMinute(four_digits(inverse * self.trace.length(from))))
            }
            (rate, _) => rate,
        };
        let Modes { tool, spindle, frame, .. } = motion.modes;
        let SpindleModes { turn: spindle, speed, speed_limit, .. } = spindle;
        let fixture = frame.fixture;
        let now = InForce { from, tool, feed, speed, speed_limit, spindle, fixture };
        if last.is_none_or(|last| InForce { from, ..*last } != now) {
            self.trace.in_force.push(now);
        }
        self.note_axis(axis, from);
    }

    /// Notes the direction of the tool from a piece on, where it is another.
    fn note_axis(&mut self, axis: Point, from: usize) {
        let upright = [0.0, 0.0, 1.0];
        if self.trace.axes.last().map_or(upright, |(_, axis)| *axis) != axis {
            self.trace.axes.push((from, axis));
        }
    }

    /// Notes the rotary axes at the piece that was drawn last, where they are elsewhere.
    pub(super) fn note_rotary(&mut self, rotary: [f64; 2]) {
        let from = self.trace.pieces.len() - 1;
        if self.trace.rotary.last().is_none_or(|(_, last)| *last != rotary) {
            self.trace.rotary.push((from, rotary));
        }
    }

    pub(super) fn change(&mut self, line: u32, tool: u32) {
        match self.pen {
            Some(at) => {
                let from = self.trace.pieces.len();
                self.trace.changes.push(Change { at, tool, line, from });
            }
            None => self.waiting.push((line, tool)),
        }
    }
}

/// A value rounded to four digits.
fn four_digits(value: f64) -> f64 {
    let last = libm::exp10(libm::log10(value.max(f64::MIN_POSITIVE)).floor() - 3.0);
    (value / last).round() * last
}

/// A place that can be drawn: programs may hold numbers that are too large for one.
pub(super) fn is_place(point: &Point) -> bool {
    point.iter().all(|value| value.abs() < FARTHEST)
}

/// How far chords of arcs may leave them, in a picture of this extent.
pub(super) fn tolerance(extent: Option<Extent>) -> f64 {
    (extent.map_or(0.0, |extent| extent.size()) * FINENESS).max(LEAST)
}

/// The trace of a CL file; `name` is for messages, `unit` that of a file which does not
/// say it itself; with the settings of a machine its points are moved as the machine moves them.
///
/// # Errors
/// What the CL reader refuses; a file whose unit nobody says.
pub fn cl_trace(
    cl: Reader<'_>,
    name: &str,
    unit: Option<fil_machine::Unit>,
    commons: Option<&Commons>,
) -> Result<Trace, Box<Diag>> {
    let mut steps = Vec::new();
    let shift = loc::INPUT_TRANSLATE.map(|at| commons.and_then(|it| it.dbl_opt(at)).unwrap_or(0.0));
    let path = ClPath::new(cl, name, shift).through(commons.and_then(input_matrix));
    for step in path.in_unit(unit) {
        steps.push(step?);
    }
    let ends: Vec<Point> = steps
        .iter()
        .filter_map(|step| Some(step.what.end()?.tip.into()))
        .filter(is_place)
        .collect();
    let tolerance = tolerance(Extent::of(&ends));
    let mut builder = Builder::default();
    let mut drilling = None;
    for step in &steps {
        if let Some(first) = step.what.end().filter(|_| builder.pen.is_none()) {
            builder.put(first.tip.into());
        }
        let pieces = builder.trace.pieces.len();
        match &step.what {
            // A path of both units would need two scales: the first one is told.
            ExpectedStep::Metric(metric) if pieces == 0 => builder.trace.inch = !metric,
            ExpectedStep::Rapid(to) => {
                builder.draw(Stroke::Rapid, step.line, [to.tip.into()]);
            }
            ExpectedStep::Feed(to, _) => {
                builder.draw(Stroke::Feed, step.line, [to.tip.into()]);
            }
            ExpectedStep::Thread(to, _) => {
                builder.draw(Stroke::Thread, step.line, [to.tip.into()]);
            }
            ExpectedStep::Arc(arc, _) => {
                builder.draw(Stroke::Arc, step.line, along(arc, tolerance));
            }
            ExpectedStep::Hole(hole) => {
                let before = *drilling.get_or_insert(builder.pen);
                drill(&mut builder, hole, before, step.line);
            }
            ExpectedStep::CycleEnd => drilling = None,
            ExpectedStep::Tool { number, .. } => builder.change(step.line, *number),
            _ => {}
        }
        if let Some(end) = step.what.end().filter(|_| builder.trace.pieces.len() > pieces) {
            builder.note_axis(end.axis.into(), pieces);
        }
    }
    Ok(builder.trace)
}

/// Points of an arc without its start.
fn along(arc: &Arc, tolerance: f64) -> Vec<Point> {
    let count = (arc.sweep / arc_step(arc.radius(), tolerance)).ceil().clamp(1.0, 720.0) as u32;
    let spoke = arc.spoke(arc.start);
    let base = arc.start - spoke;
    let rise = arc.normal * arc.normal.dot(&(arc.end.tip - arc.start));
    let axis = Unit::new_normalize(arc.normal);
    let across = axis.cross(&spoke);
    let spokes: [(f64, f64); 3] = std::array::from_fn(|n| (spoke[n], across[n]));
    shares_of(count, &spokes, arc.sweep)
        .into_iter()
        .map(|share| {
            if share >= 1.0 {
                return arc.end.tip.into();
            }
            let turn = Rotation3::from_axis_angle(&axis, (arc.sweep * share).to_radians());
            Point::from(base + turn * spoke + rise * share)
        })
        .collect()
}

/// A hole: to the level above it, down, and up again.
fn drill(builder: &mut Builder, hole: &Hole, before: Option<Point>, line: u32) {
    let (start, axis) = (hole.start.tip, hole.start.axis);
    let level = |height: f64| Point::from(start + axis * height);
    let clear = hole.clear.unwrap_or(0.0);
    let entry = match (hole.retract, before) {
        (Some(0.0), Some(before)) => axis.dot(&(Point3::from(before) - start)).max(clear),
        (Some(height), _) => height.max(clear),
        (None, _) => clear,
    };
    builder.draw(Stroke::Rapid, line, [level(entry), level(clear)]);
    builder.draw(Stroke::Feed, line, [level(-hole.depth)]);
    builder.draw(Stroke::Rapid, line, [level(entry)]);
}
