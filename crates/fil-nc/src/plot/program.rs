//! Programs as traces.

use fil_diag::Diag;

use super::sample::{tip, tips};
use super::trace::{Builder, is_place, tolerance};
use super::{Extent, Stroke, Trace};
use crate::dialect::{Dialect, Habit};
use crate::forward::Forward;
use crate::interpret::interpret;
use crate::motion::{Course, Event, Move, Position};

/// The trace of a program; `name` is for messages.
///
/// Motions from or to a place that is not known are left out, and so are those to
/// points of the machine. The program is run twice, so that no more than its trace is kept.
///
/// # Errors
/// What has no sure meaning on the machine.
pub fn nc_trace(
    text: &[u8],
    name: &str,
    dialect: &Dialect,
    forward: &Forward,
) -> Result<Trace, Box<Diag>> {
    let mut survey = Survey::default();
    interpret(text, name, dialect, &mut |event| {
        if let Event::Move(motion) = event {
            survey.take(&motion, forward);
        }
    })?;
    let tolerance = tolerance(survey.extent());
    let mut builder = Builder::default();
    builder.trace.inch = survey.inch.unwrap_or(!dialect.has(Habit::Metric));
    let mut at = Position::default();
    interpret(text, name, dialect, &mut |event| match event {
        Event::Move(motion) => {
            add(&mut builder, &motion, &at, (forward, &survey, tolerance));
            at = motion.to;
        }
        Event::ToolChange { line, tool, .. } => builder.change(line, tool),
        Event::Dwell { .. }
        | Event::Auxiliary { .. }
        | Event::LeftToControl { .. }
        | Event::ToolMeasured { .. }
        | Event::End { .. } => {}
    })?;
    Ok(builder.trace)
}

/// Adds a motion from where the axes stand.
fn add(
    builder: &mut Builder,
    motion: &Move,
    at: &Position,
    (forward, survey, tolerance): (&Forward, &Survey, f64),
) {
    if motion.course == Course::Machine || !survey.knows(motion) {
        builder.pen = None;
    } else if builder.pen.is_none() {
        builder.put(tip(forward, &motion.to));
    } else {
        let points = tips(forward, (at, &motion.to), motion.arc.as_ref(), tolerance);
        if builder.draw(stroke(motion), motion.line, points) {
            builder.note(motion, forward.axis(motion.to.rotary).into());
        }
    }
}

fn stroke(motion: &Move) -> Stroke {
    match (motion.course, motion.arc) {
        (Course::Thread, _) => Stroke::Thread,
        (Course::Rapid | Course::Machine, _) => Stroke::Rapid,
        (Course::Feed, Some(_)) => Stroke::Arc,
        (Course::Feed, None) => Stroke::Feed,
    }
}

/// What must be known of a whole program before it is drawn.
#[derive(Default)]
struct Survey {
    /// Axes that a block names, a bit each. One that none names does not move: it is known
    /// well enough.
    named: usize,
    /// The ends of motions, by the axes that are not known there.
    extents: [Option<Extent>; 32],
    /// The first motion is in inch.
    inch: Option<bool>,
}

impl Survey {
    fn take(&mut self, motion: &Move, forward: &Forward) {
        let unknown = unknown(motion);
        self.named |= !unknown & 31;
        self.inch.get_or_insert(motion.modes.inch);
        let end = tip(forward, &motion.to);
        if is_place(&end) {
            self.extents[unknown] = Extent::joined(self.extents[unknown], Extent::of([&end]));
        }
    }

    fn knows(&self, motion: &Move) -> bool {
        unknown(motion) & self.named == 0
    }

    /// The box around the ends that are known.
    fn extent(&self) -> Option<Extent> {
        let known = (0..32).filter(|unknown| unknown & self.named == 0);
        known.map(|unknown| self.extents[unknown]).fold(None, Extent::joined)
    }
}

/// The axes that are not known where a motion ends, a bit each.
fn unknown(motion: &Move) -> usize {
    (0..5).map(|axis| usize::from(!motion.known[axis]) << axis).sum()
}
