//! Canned cycles as single moves, for machines that have no code for them.

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations as loc;
use fil_machine::modes::INCH;

use super::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use super::rapid;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control::word_address::motion::Motion;
use crate::errors::PostCode;
use crate::operation::{Dwell, Feed};

/// Drills one hole: rapid to it and to the R level, feed to the bottom (in
/// pecks), dwell, retract.
///
/// # Errors
/// TAP, which needs a control that couples spindle and feed.
pub fn hole(control: &mut Control, cycle: &Cycle, at: &Motion, hole: &Hole) -> Result<()> {
    let CycleFeed::Feed(feed) = cycle.feed else { return cant_tap() };
    if cycle.kind == CycleKind::Tap {
        return cant_tap();
    }
    let across = without(hole.along);
    rapid::rapid(control, &at.of(across), control.block.cause)?;
    control.because(cycle.cause, |control| Moves { control, cycle, hole, feed }.down_and_up())
}

fn cant_tap() -> Result<()> {
    PostCode::NoCode
        .err("the machine has no tapping cycle, and a tap can't be written as single moves")
}

/// All axes but one.
pub(super) fn without(axis: usize) -> AxisSet {
    AxisSet::ALL
        .numbers()
        .filter(|number| *number != axis)
        .fold(AxisSet::NONE, |set, number| set.or(AxisSet::of(number)))
}

/// The moves of a hole along its axis, which the CYCLE record asks for.
struct Moves<'a> {
    control: &'a mut Control,
    cycle: &'a Cycle,
    hole: &'a Hole,
    feed: Feed,
}

impl Moves<'_> {
    fn down_and_up(mut self) -> Result<()> {
        self.rapid(self.hole.clear)?;
        match self.cycle.step {
            Some(step) => self.pecks(step)?,
            None => self.feed(self.hole.bottom)?,
        }
        if self.cycle.dwell > 0.0 {
            let seconds = Dwell::Seconds(self.cycle.dwell);
            let cause = self.cycle.due_to(self.cycle.words.dwell);
            self.control.because(cause, |control| family::dwell(control, seconds))?;
        }
        if matches!(self.cycle.kind, CycleKind::Bore | CycleKind::Ream) {
            self.feed(self.hole.clear)?;
        }
        self.rapid(self.hole.rest())
    }

    /// DEEP comes out to the R level after each peck, BRKCHP only lifts.
    fn pecks(&mut self, step: f64) -> Result<()> {
        let gap = self.control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
        let gap = if self.control.is_metric() { gap } else { gap / INCH };
        let Hole { bottom, clear, .. } = *self.hole;
        let (length, out) = ((clear - bottom).abs(), (clear - bottom).signum());
        let mut reached = 0.0;
        while reached + step < length - 1e-9 {
            reached += step;
            let level = clear - reached * out;
            self.feed(level)?;
            if self.cycle.kind == CycleKind::Deep {
                self.rapid(clear)?;
            }
            self.rapid(clear - (reached - gap).max(0.0) * out)?;
        }
        self.feed(bottom)
    }

    fn rapid(&mut self, level: f64) -> Result<()> {
        let cause: Cause = self.control.block.cause;
        rapid::rapid(self.control, &self.to(level), cause)
    }

    fn feed(&mut self, level: f64) -> Result<()> {
        family::feed(self.control, &self.to(level), Some(&self.feed))
    }

    /// A motion along the axis of the hole.
    fn to(&self, level: f64) -> Motion {
        let mut position = Position::default();
        position[self.hole.along] = level;
        Motion { position, axes: AxisSet::of(self.hole.along), word: 0 }
    }
}
