//! A tap of a live tool: `SPOS=0`, `G331 Z K S`, `G332 Z K` along Z, with X and I along X.
//!
//! The manual of the language: SPOS brings the master spindle under position control, K of G331 and
//! G332 is the lead, whose sign is the way it turns (positive as M3), and G332 turns it back. Along
//! X the lead is I. Whether it counts as a diameter where X does is not plain, so that DIAMOF makes
//! both lengths of radius for the tap.

use fil_diag::Result;
use fil_machine::letters::{F, XYZ};
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;

use super::{program, transformation};
use crate::control::word_address::{motion, spindle};
use crate::control::{Control, line, tap};
use crate::control_state::{Source, modal};
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, CycleKind, Hole};
use crate::operation::{Feed, SpindleSpeed};

/// Digits after the point of a lead, mm or inch.
const LEAD_DIGITS: usize = 5;

/// The machine taps a hole in this way.
pub fn taps(control: &Control, cycle: &Cycle, hole: &Hole) -> bool {
    control.tables.mills()
        && cycle.kind == CycleKind::Tap
        && hole.along != 1
        && control.commons.read(loc::MILL_TURN_RIGID_TAP)
}

/// Taps from the R level and back to it; the spindle turns as before behind it.
///
/// # Errors
/// A live tool that stands or whose speed is not known, a dwell, a lead that does not fit.
pub fn tap(control: &mut Control, cycle: &Cycle, hole: &Hole) -> Result<()> {
    if cycle.dwell > 0.0 {
        return PostCode::CycleForm.err("a tap by G331 has no dwell");
    }
    let Some(clockwise) = spindle::clockwise(control) else {
        return PostCode::CycleForm
            .err("a tap while the direction of the live tool is not known; put SPINDL before it");
    };
    let Some(asked @ SpindleSpeed::Revolutions(_)) = control.spindle.speed else {
        return PostCode::CycleForm.err("a tap needs the turns of the live tool (SPINDL / RPM)");
    };
    let speed = spindle::value_of(control, asked);
    let lead = tap::text(tap::pitch(control, cycle)?, LEAD_DIGITS)?;
    let sign = if clockwise { "" } else { "-" };
    let axis = *control.tables.axis(hole.along);
    let by_diameter = hole.along == 0 && control.commons.read(loc::LATHE_DIAMETER);
    let part = if by_diameter { 0.5 } else { 1.0 };
    let (letter, address) = if hole.along == 0 { ("X", "I") } else { ("Z", "K") };
    let level = |control: &Control, level: f64| {
        let value = axis.value(level)? * part;
        line::length(control, XYZ[hole.along], value).map(|(text, _)| text)
    };
    let (bottom, clear) = (level(control, hole.bottom)?, level(control, hole.clear)?);
    feed_a_minute(control, cycle)?;
    super::put_text(control, "SPOS=0")?;
    if by_diameter {
        transformation::count_radii(control)?;
    }
    let lead = format!("{address}{sign}{lead}");
    super::put_text(control, &format!("G331 {letter}{bottom} {lead} S{speed}"))?;
    super::put_text(control, &format!("G332 {letter}{clear} {lead}"))?;
    if by_diameter {
        program::say_diameters(control)?;
    }
    control.state.forget(modal::MOTION, Source::Post);
    control.state.doubt(F);
    spindle::turn_on(control, clockwise)
}

/// The spindle goes with the axis, and no feed counts its turns.
fn feed_a_minute(control: &mut Control, cycle: &Cycle) -> Result<()> {
    let feed = Feed { value: 1.0, asked: 1.0, mode: FeedMode::PerMinute, cause: cycle.cause };
    motion::feed_mode(control, &feed)?;
    control.write_block()
}
