//! Canned cycles as single moves, for machines that have no code for them.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, CycleBoreOut};
use fil_machine::modes::INCH;

use super::rapid;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::word_address::cycle as words;
use crate::control::word_address::spindle;
use crate::control::{family, tap};
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;
use crate::operation::{Dwell, Feed, Lead, Operation, SpindleSpeed};

/// Drills one hole: rapid to it and to the R level, feed to the bottom (in
/// pecks), dwell, retract.
///
/// # Errors
/// TAP, which needs a control that couples spindle and feed, and MILL, which only the
/// control knows.
pub fn hole(control: &mut Control, cycle: &Cycle, at: &Motion, hole: &Hole) -> Result<()> {
    if cycle.kind == CycleKind::Tap {
        return tap(control, cycle, at, hole);
    }
    if cycle.kind == CycleKind::Mill {
        return PostCode::NoCode.err(
            "the machine has no code for CYCLE/MILL (cycle.mill_code), and what it does at the \
             bottom is a matter of the control",
        );
    }
    let CycleFeed::Feed(feed) = cycle.feed else { return cant_tap(control) };
    let across = without(hole.along);
    rapid::rapid(control, &at.of(across), control.block.cause)?;
    control.because(cycle.cause, |control| Moves { control, cycle, hole, feed }.down_and_up())
}

/// Taps a hole by two threading moves, on a machine that asks for it.
///
/// # Errors
/// Any other machine; a spindle that stands or turns at surface speed; a dwell.
fn tap(control: &mut Control, cycle: &Cycle, at: &Motion, hole: &Hole) -> Result<()> {
    if spindle::stands(control) || control.spindle.side_turns && !spindle::may_turn(control) {
        let usual = "a tap while the spindle is stopped; put SPINDL before it";
        return PostCode::CycleForm.err(spindle::why_it_stands(control, usual));
    }
    // A threading move counts the turns of the main spindle, not of a live tool.
    if !control.commons.read(loc::THREAD_TAP) || control.tables.mills() {
        return cant_tap(control);
    }
    if cycle.dwell > 0.0 || cycle.rigid {
        return PostCode::CycleForm.err("a tap by threading moves has no dwell and is not rigid");
    }
    let lead = lead_of(control, cycle)?;
    rapid::rapid(control, &at.of(without(hole.along)), control.block.cause)?;
    let level = |level: f64| Motion::along(hole.along, level);
    control.because(cycle.cause, |control| {
        let cause = control.block.cause;
        rapid::rapid(control, &level(hole.clear), cause)?;
        control.flush_waiting()?;
        family::thread(control, &level(hole.bottom), &lead, 0.0)?;
        spindle::turn_back(control)?;
        family::thread(control, &level(hole.clear), &lead, 0.0)?;
        spindle::turn_back(control)?;
        rapid::rapid(control, &level(hole.rest()), cause)
    })
}

/// The lead of a tap: its own, or what its feed makes of it at the speed of the spindle.
fn lead_of(control: &Control, cycle: &Cycle) -> Result<Lead> {
    let feed = match cycle.feed {
        CycleFeed::Lead(lead) => return Ok(lead),
        CycleFeed::Feed(feed) => feed,
    };
    if !matches!(control.spindle.speed, Some(SpindleSpeed::Revolutions(_))) {
        let usual = "a tap needs turns of the spindle (SPINDL / RPM)";
        return PostCode::CycleForm.err(spindle::why_it_stands(control, usual));
    }
    Ok(Lead { value: tap::pitch(control, cycle)?, cause: feed.cause })
}

fn cant_tap(control: &Control) -> Result<()> {
    PostCode::NoCode.err(words::no_tap(control))
}

/// How the tool leaves a hole that is written as single moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum WayOut {
    /// At rapid, the spindle turning.
    Rapid,
    /// At feed to the R level, the spindle turning.
    Feed,
    /// At rapid, the spindle standing.
    Standing,
}

/// The way out of a hole: that of the machine's own cycle where it has one.
///
/// # Errors
/// A bored or reamed hole whose cycle does at the bottom what single moves can't say.
pub(super) fn settle_way_out(control: &mut Control, cycle: &Cycle) -> Result<WayOut> {
    let bored = matches!(cycle.kind, CycleKind::Bore | CycleKind::Ream);
    if cycle.kind == CycleKind::Bore {
        match control.commons.read(loc::CYCLE_BORE_OUT) {
            CycleBoreOut::AtFeedSpindleRunning => return Ok(WayOut::Feed),
            CycleBoreOut::AtRapidSpindleStopped => return Ok(WayOut::Standing),
            CycleBoreOut::AsTheCycleCode => {}
        }
    }
    let code = control.commons.read(cycle.kind.code());
    match code {
        Some(85 | 89 | 201) => Ok(WayOut::Feed),
        Some(86) => Ok(WayOut::Standing),
        Some(73 | 81 | 82 | 83 | 200 | 203 | 205) => Ok(WayOut::Rapid),
        Some(code) if bored => {
            let mut diag = PostCode::CycleForm.diag(format!(
                "what cycle {code} of the control does at the bottom can't be written as single moves"
            ));
            diag.hint = Some("Set how the tool leaves a bored hole: cycle.bore_out.".into());
            Err(diag)
        }
        Some(_) => Ok(WayOut::Rapid),
        None if cycle.kind == CycleKind::Bore => {
            let message = "CYCLE/BORE: the tool leaves the hole at feed, the spindle turning";
            control.warnings.add(PostCode::BoreOut, message.to_string());
            Ok(WayOut::Feed)
        }
        None if bored => Ok(WayOut::Feed),
        None => Ok(WayOut::Rapid),
    }
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
            self.control.because(cause, |control| {
                control.family().write(control, Operation::Dwell(seconds))
            })?;
        }
        match settle_way_out(self.control, self.cycle)? {
            WayOut::Rapid => self.rapid(self.hole.rest()),
            WayOut::Feed => {
                self.feed(self.hole.clear)?;
                self.rapid(self.hole.rest())
            }
            WayOut::Standing => {
                let clockwise = spindle::stand(self.control)?;
                self.rapid(self.hole.rest())?;
                spindle::turn_on(self.control, clockwise)
            }
        }
    }

    /// DEEP comes out to the R level after each peck, BRKCHP lifts, and comes out as TIMES says.
    fn pecks(&mut self, step: f64) -> Result<()> {
        let gap = self.control.commons.dbl_opt(loc::CYCLE_PECK_GAP).unwrap_or(0.0).max(0.0);
        let gap = if self.control.is_metric() { gap } else { gap / INCH };
        let Hole { bottom, clear, .. } = *self.hole;
        let (length, out) = ((clear - bottom).abs(), (clear - bottom).signum());
        let mut reached = 0.0;
        let mut peck = 0;
        while reached + step < length - 1e-9 {
            reached += step;
            peck += 1;
            let level = clear - reached * out;
            self.feed(level)?;
            if self.cycle.leaves_after(peck) {
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
        Motion::along(self.hole.along, level)
    }
}
