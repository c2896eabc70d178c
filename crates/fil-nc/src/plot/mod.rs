//! Backplot: the path of a program or of a CL file as a picture.
//!
//! [`nc_trace`] and [`cl_trace`] make a [`Trace`] of tool tips in the part frame,
//! so that the path of a table that turns is seen on the part. [`svg`] draws
//! views of it, [`html`] a page of one file that zooms, turns and tells of each
//! motion what made it.

mod encode;
mod html;
mod sample;
mod simplify;
mod svg;
mod trace;
mod view;

#[cfg(test)]
mod tests;

pub use html::html;
pub use svg::svg;
pub use trace::{cl_trace, nc_trace};
pub use view::{Extent, View};

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
            Stroke::Thread => "#8a3ab9",
        }
    }
}

/// Colour of a CL path that lies under a program, `#rrggbb`.
pub const CL_COLOUR: &str = "#f0a830";

/// Part of a path that one block or CL record makes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Piece {
    /// How it is driven.
    pub stroke: Stroke,
    /// Line of the NC program or of the CL file, 1-based.
    pub line: u32,
    /// Index of its first point; the last one is the first of the next piece, or
    /// that before `end`.
    pub start: usize,
    /// One past the index of its last point.
    pub end: usize,
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
}

/// What is in force from a piece of a path on.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct InForce {
    /// Index of the first piece.
    pub from: usize,
    /// Number of the tool.
    pub tool: u32,
    /// Feed of pieces that are no rapids; inverse time is told as the feed that it makes, in
    /// whole mm/min.
    pub feed: Option<Rate>,
    /// Speed of the spindle.
    pub speed: Option<Speed>,
    /// What the spindle does.
    pub spindle: Spindle,
    /// The work offset, as [`Modes::fixture`](crate::motion::Modes::fixture).
    pub fixture: Option<u32>,
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
}

/// What is said of a line when its piece is pointed at.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Note {
    /// The line of the program or of the CL file.
    pub text: String,
    /// What made it: CL record, FIL line.
    pub origin: String,
}

/// All that a picture shows.
#[derive(Clone, Debug, Default)]
pub struct Drawing {
    /// Heading.
    pub title: String,
    /// The path.
    pub path: Trace,
    /// The machine turns parts: the page opens with Z to the right and X up.
    pub lathe: bool,
    /// The path under it, with which it is compared: mostly that of the CL file.
    pub under: Option<Trace>,
    /// What the path under it is called in a legend.
    pub under_name: &'static str,
    /// Notes on the lines of the path: `notes[0]` is on line 1. May be shorter than
    /// the program.
    pub notes: Vec<Note>,
    /// Notes on the lines of the path under it.
    pub under_notes: Vec<Note>,
}

impl Drawing {
    /// The box around all points; `None` without any.
    pub fn extent(&self) -> Option<Extent> {
        let under = self.under.iter().flat_map(|trace| &trace.points);
        Extent::of(self.path.points.iter().chain(under))
    }
}
