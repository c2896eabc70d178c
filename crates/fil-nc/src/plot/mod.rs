//! Backplot: the path of a program or of a CL file as a picture.
//!
//! [`nc_trace`] and [`cl_trace`] make a [`Trace`] of tool tips in the part frame,
//! so that the path of a table that turns is seen on the part. [`svg`] draws
//! views of it, [`html`] a page of one file that zooms, turns and tells of each
//! motion what made it; [`columns`] is the path as plain columns for a viewer in three
//! dimensions.

mod columns;
mod encode;
mod html;
mod labels;
mod live_tools;
mod pack;
mod program;
mod sample;
mod simplify;
mod spelled;
mod svg;
mod time;
mod tools;
mod trace;
mod variables;
mod view;

#[cfg(test)]
mod tests;

pub use columns::columns;
pub use encode::base64;
pub use html::{html, write_html};
pub use program::nc_trace;
pub use svg::svg;
pub use tools::{ToolShape, cl_tools};
pub use trace::cl_trace;
pub use view::{Extent, View};

use std::borrow::Cow;
use std::ops::Range;

use fil_machine::Unit;

use crate::forward::Forward;
use crate::motion::{Rate, Speed, Spindle};

/// A point of the part frame, mm.
pub type Point = [f64; 3];

/// How a piece of the path is driven, and so drawn.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Stroke {
    /// Rapid traverse.
    Rapid,
    /// Straight, at feed.
    Feed,
    /// Arc or helix at feed.
    Arc,
    /// In step with the spindle.
    Thread,
}

impl Stroke {
    /// All of them, in the order in which they are drawn.
    pub const ALL: [Stroke; 4] = [Stroke::Rapid, Stroke::Feed, Stroke::Arc, Stroke::Thread];

    /// Name in a legend.
    pub fn name(self) -> &'static str {
        match self {
            Stroke::Rapid => "rapid",
            Stroke::Feed => "feed",
            Stroke::Arc => "arc",
            Stroke::Thread => "thread",
        }
    }

    /// Colour, `#rrggbb`.
    pub fn colour(self) -> &'static str {
        match self {
            Stroke::Rapid => "#d64550",
            Stroke::Feed => "#1c6dd0",
            Stroke::Arc => "#128a4a",
            Stroke::Thread => "#9a4fca",
        }
    }
}

/// Colour of a CL path that lies under a program, `#rrggbb`.
pub const CL_COLOUR: &str = "#f0a830";

/// Colour of the directions of a tilting tool, `#rrggbb`.
pub const AXIS_COLOUR: &str = "#8a94a0";

/// Part of a path that one block or CL record makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// How it is driven.
    pub stroke: Stroke,
    /// Line of the NC program or of the CL file, 1-based.
    pub line: u32,
    /// Index of its first point; the last one is the first of the next piece, or
    /// that before `end`.
    pub start: u32,
    /// One past the index of its last point.
    pub end: u32,
}

impl Piece {
    /// Where its points lie among those of the path.
    pub fn range(&self) -> Range<usize> {
        self.start as usize..self.end as usize
    }

    /// Index of its last point.
    pub fn last(&self) -> usize {
        self.end as usize - 1
    }
}

/// A tool change.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Change {
    /// Where the tip stands; where it first goes when that is not known.
    pub at: Point,
    /// Number of the tool.
    pub tool: u32,
    /// Line of the NC program or of the CL file, 1-based.
    pub line: u32,
    /// Index of the first piece after it.
    pub from: usize,
}

/// What is in force from a piece of a path on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InForce {
    /// Index of the first piece.
    pub from: usize,
    /// Number of the tool.
    pub tool: u32,
    /// Feed of pieces that are no rapids; inverse time is told as the feed that it makes, of
    /// four digits.
    pub feed: Option<Rate>,
    /// Speed of the spindle.
    pub speed: Option<Speed>,
    /// What surface speed may turn the spindle up to, rpm.
    pub speed_limit: Option<f64>,
    /// What the spindle does.
    pub spindle: Spindle,
    /// The work offset, as [`FrameModes::fixture`](crate::motion::FrameModes::fixture).
    pub fixture: Option<u32>,
}

/// Lines of a program that have no certain meaning on the machine, and are left out of a picture.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct LeftOut {
    /// The first of them, 1-based.
    pub line: u32,
    /// How many there are, one after the other, with the same reason.
    pub count: u32,
    /// The reason.
    pub why: String,
}

impl std::fmt::Display for LeftOut {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self.count {
            1 => write!(f, "not drawn: {}", self.why),
            count => write!(f, "{count} lines not drawn: {}", self.why),
        }
    }
}

/// A path of the tool tip in the part frame.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Trace {
    /// Points in order.
    pub points: Vec<Point>,
    /// What lies between them.
    pub pieces: Vec<Piece>,
    /// Tool changes.
    pub changes: Vec<Change>,
    /// What is in force, each from its first piece on; none for a CL file.
    pub in_force: Vec<InForce>,
    /// Directions of the tool, each from the piece on that ends with it; none where the tool
    /// always stands upright.
    pub axes: Vec<(usize, Point)>,
    /// Positions of the primary and the secondary rotary axis, degrees, each at the end of a piece
    /// and of those after it; none on a machine without them, and for a CL file.
    pub rotary: Vec<(usize, [f64; 2])>,
    /// Lines of a program that are not drawn, in the order in which they are run.
    pub left_out: Vec<LeftOut>,
    /// Lengths are told in inch, as in the program or the CL file; else in mm.
    pub inch: bool,
}

impl Trace {
    /// Length of a piece, mm.
    fn length(&self, piece: usize) -> f64 {
        let points = &self.points[self.pieces[piece].range()];
        let step = |pair: &[Point]| {
            let ways = [0, 1, 2].map(|n| pair[1][n] - pair[0][n]);
            ways.map(|way| way * way).iter().sum::<f64>().sqrt()
        };
        points.windows(2).map(step).sum()
    }

    /// The unit in which lengths are told.
    pub fn unit(&self) -> Unit {
        if self.inch { Unit::Inch } else { Unit::Mm }
    }
}

/// What made a line of a program.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LineCause {
    /// Line of the CL file, 1-based; 0 for none.
    pub line: u32,
    /// Which of [`Notes::stacks`], from 1; 0 for none.
    pub stack: u32,
}

/// What is said of lines when their pieces are pointed at.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Notes<'t> {
    /// The program or the CL file.
    pub text: Cow<'t, str>,
    /// What made each of its lines; may be shorter than the text.
    pub causes: Vec<LineCause>,
    /// What the CL file of the causes is called.
    pub source_name: String,
    /// Its text, where it is at hand.
    pub source: Option<String>,
    /// FIL lines that called one another, innermost first, a line each.
    pub stacks: Vec<String>,
}

impl Notes<'_> {
    /// The same with a text of its own.
    pub fn into_owned(self) -> Notes<'static> {
        Notes { text: self.text.into_owned().into(), ..self }
    }

    /// What made a line, 1-based: the line of the CL file, then those of FIL.
    pub fn origin(&self, line: usize) -> String {
        let Some(cause) = line.checked_sub(1).and_then(|at| self.causes.get(at)) else {
            return String::new();
        };
        let mut parts = Vec::new();
        if let Some(at) = (cause.line as usize).checked_sub(1) {
            let text = self.source.as_deref().and_then(|text| text.lines().nth(at));
            let text = text.unwrap_or_default().trim();
            let told = format!("{}:{}  {text}", self.source_name, cause.line);
            parts.push(told.trim_end().to_string());
        }
        let stack = (cause.stack as usize).checked_sub(1).and_then(|at| self.stacks.get(at));
        parts.extend(stack.cloned());
        parts.join("\n")
    }
}

/// All that a picture shows.
#[derive(Clone, Debug, Default)]
pub struct Drawing<'t> {
    /// Heading.
    pub title: String,
    /// The path.
    pub path: Trace,
    /// The machine turns parts: the page opens with Z to the right and X up.
    pub lathe: bool,
    /// Programs of the machine count X as a diameter, and so it is told.
    pub diameter: bool,
    /// The path under it, with which it is compared: mostly that of the CL file.
    pub under: Option<Trace>,
    /// What the path under it is called in a legend.
    pub under_name: &'static str,
    /// Notes on the lines of the path.
    pub notes: Notes<'t>,
    /// Notes on the lines of the path under it.
    pub under_notes: Notes<'t>,
    /// Tools whose shape is known.
    pub tools: Vec<ToolShape>,
    /// The rotary axes, primary first; `None` without any.
    pub forward: Option<Forward>,
}

impl Drawing<'_> {
    /// The same with texts of its own.
    pub fn into_owned(self) -> Drawing<'static> {
        let notes = self.notes.into_owned();
        Drawing { notes, under_notes: self.under_notes.into_owned(), ..self }
    }

    /// Takes what a program can't say from the path under it: how the live tools of a lathe lie.
    pub fn take_tool_axes(&mut self) {
        live_tools::take_axes(self);
    }

    /// The box around all points; `None` without any.
    pub fn extent(&self) -> Option<Extent> {
        let under = self.under.iter().flat_map(|trace| &trace.points);
        Extent::of(self.path.points.iter().chain(under))
    }
}
