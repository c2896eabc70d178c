//! A trace as the script of the page reads it.

use std::io::{self, Write};

use fil_machine::Unit;

use super::encode::{Packer, columns, json};
use super::spelled::spell;
use super::{Extent, InForce, Notes, Point, Stroke, Trace};
use crate::motion::{Rate, Speed, Spindle};

/// Steps of a unit in which feeds, speeds and directions are kept.
const FINE: f64 = 1e4;

/// Most steps over the longest side of a path: the page keeps them in 32 bits.
const STEPS: f64 = 1e9;

/// Most notes on lines that are not drawn.
const LEFT_OUT: usize = 1000;

/// The grid on which the points of a page lie.
pub(super) struct Grid {
    /// Its origin, mm.
    pub(super) min: Point,
    /// Its step, mm.
    pub(super) step: f64,
    /// Decimals of a unit that it has.
    pub(super) decimals: usize,
    /// Its origin, counted in steps from zero.
    pub(super) origin: [i64; 3],
}

impl Grid {
    /// A grid of a tenth of the last digit that programs of a unit have; coarser, where a path
    /// is too long for it.
    pub(super) fn new(extent: &Extent, unit: Unit) -> Self {
        let (mut step, mut decimals) =
            if unit.is_metric() { (1e-4, 4) } else { (1e-5 * unit.in_mm(), 5) };
        let size = extent.size().min(f64::MAX);
        while size / step > STEPS {
            step *= 10.0;
            decimals = usize::saturating_sub(decimals, 1);
        }
        let origin = extent.min.map(|min| (min / step).round() as i64);
        Grid { min: extent.min, step, decimals, origin }
    }

    /// A point as counts of the step from zero.
    pub(super) fn counts(&self, point: &Point) -> [i64; 3] {
        let steps = self.steps(point);
        [0, 1, 2].map(|axis| self.origin[axis].saturating_add(steps[axis]))
    }

    fn steps(&self, point: &Point) -> [i64; 3] {
        std::array::from_fn(|axis| ((point[axis] - self.min[axis]) / self.step).round() as i64)
    }
}

/// Writes a trace with its notes, as JSON; `source` is the text of the CL file of its causes.
pub(super) fn trace(
    trace: &Trace,
    notes: &Notes<'_>,
    source: &str,
    grid: &Grid,
    out: &mut dyn Write,
) -> io::Result<()> {
    out.write_all(b"{\"points\":")?;
    columns(out, trace.points.iter().map(|point| grid.steps(point)))?;
    out.write_all(b",\n\"pieces\":")?;
    pieces(trace, out)?;
    out.write_all(b",\n\"inForce\":")?;
    columns(out, trace.in_force.iter().map(in_force))?;
    out.write_all(b",\n\"axes\":")?;
    let axes = trace.axes.iter().map(|(from, axis)| {
        let [i, j, k] = axis.map(|part| (part * FINE).round() as i64);
        [*from as i64, i, j, k]
    });
    columns(out, axes)?;
    out.write_all(b",\n\"changes\":")?;
    let changes = trace.changes.iter().map(|change| {
        let [x, y, z] = grid.steps(&change.at);
        [change.from as i64, x, y, z, change.tool.into(), change.line.into()]
    });
    columns(out, changes)?;
    out.write_all(b",\n\"text\":")?;
    let mut text = Packer::new(out)?;
    let is_spelled = spell(&notes.text, trace, grid, &mut |part| text.add(part))?;
    text.finish()?;
    out.write_all(b",\n\"ends\":")?;
    if is_spelled {
        let ([x, y, z], decimals) = (grid.origin, grid.decimals);
        write!(out, "{{\"origin\":[{x},{y},{z}],\"decimals\":{decimals}}}")?;
    } else {
        out.write_all(b"null")?;
    }
    out.write_all(b",\n\"causes\":")?;
    let causes = notes.causes.iter();
    columns(out, causes.map(|cause| [cause.line.into(), cause.stack.into()]))?;
    out.write_all(b",\n\"source\":")?;
    packed(out, source)?;
    write!(out, ",\n\"sourceName\":{},\n\"stacks\":", json(&notes.source_name))?;
    let stacks: Vec<String> = notes.stacks.iter().map(|stack| json(stack)).collect();
    packed(out, &format!("[{}]", stacks.join(",")))?;
    let left_out = trace.left_out.iter().take(LEFT_OUT);
    let left_out: Vec<String> =
        left_out.map(|left_out| json(&format!("line {}: {left_out}", left_out.line))).collect();
    write!(out, ",\n\"leftOut\":[{}]}}", left_out.join(","))
}

/// A text, packed.
fn packed(out: &mut dyn Write, text: &str) -> io::Result<()> {
    let mut packer = Packer::new(out)?;
    packer.add(text.as_bytes())?;
    packer.finish()
}

/// Pieces: number of points, whether it goes on from the one before, stroke; line.
fn pieces(trace: &Trace, out: &mut dyn Write) -> io::Result<()> {
    let ends = std::iter::once(0).chain(trace.pieces.iter().map(|piece| piece.end));
    let rows = trace.pieces.iter().zip(ends).map(|(piece, end)| {
        let goes_on = piece.start + 1 == end;
        let stroke = Stroke::ALL.iter().position(|stroke| *stroke == piece.stroke).unwrap_or(0);
        let count = i64::from(piece.end - piece.start);
        [count << 3 | i64::from(goes_on) << 2 | stroke as i64, piece.line.into()]
    });
    columns(out, rows)
}

/// What is in force: its first piece; tool; feed a minute (1), a turn (2) or none (0), and the
/// feed; speed in turns (1), at the surface (2) or none (0), and the speed; spindle off (0),
/// clockwise (1), counterclockwise (2); work offset and 1, or 0 without one; the limit of the
/// speed, or 0 without one.
fn in_force(now: &InForce) -> [i64; 9] {
    let fine = |value: f64| (value.max(0.0) * FINE).round() as i64;
    let (feed_kind, feed) = match now.feed {
        Some(Rate::PerMinute(feed)) => (1, feed),
        Some(Rate::PerTurn(feed) | Rate::Varying(feed, _)) => (2, feed),
        Some(Rate::Inverse(_)) | None => (0, 0.0),
    };
    let (speed_kind, speed) = match now.speed {
        Some(Speed::Turns(speed)) => (1, speed),
        Some(Speed::Surface(speed)) => (2, speed),
        None => (0, 0.0),
    };
    let spindle = match now.spindle {
        Spindle::Off => 0,
        Spindle::Clockwise => 1,
        Spindle::Counterclockwise => 2,
    };
    let fixture = now.fixture.map_or(0, |fixture| i64::from(fixture) + 1);
    let limit = fine(now.speed_limit.unwrap_or(0.0));
    let (from, tool) = (now.from as i64, now.tool.into());
    [from, tool, feed_kind, fine(feed), speed_kind, fine(speed), spindle, fixture, limit]
}
