//! What the passes ask of a control, by its family: each function hands the operation
//! to the one that the machine's `control.family` names.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::locations::{ControlFamily, ThreadCycle};
use fil_machine::modes::Plane;
use nalgebra::Rotation3;

use super::word_address::motion as words;
use super::{
    Control, departure, klartext, length_plane, sinumerik, straight_rapid, vectors, word_address,
};
use crate::cause::Cause;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, Hole};
use crate::operation::motion::{Motion, PlaneArc, RapidCode};
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Dwell, Feed, Lead, Operation, Thread, ToolChange};

/// Refuses what the control's language has no word for.
///
/// # Errors
/// Always.
pub fn refuse<T>(message: impl Into<String>) -> Result<T> {
    PostCode::Family.err(message)
}

/// Writes an operation that does not depend on the path.
///
/// # Errors
/// A code the machine lacks, a value that does not fit, an operation at a wrong
/// moment, what the control's language can't say.
pub fn write(control: &mut Control, operation: Operation) -> Result<()> {
    match control.tables.family {
        ControlFamily::WordAddress => word_address::write(control, operation),
        ControlFamily::Klartext => klartext::write(control, operation),
        ControlFamily::Sinumerik => sinumerik::write(control, operation),
    }
}

/// Writes a rapid motion in one block.
///
/// # Errors
/// As [`words::rapid`].
pub fn rapid(control: &mut Control, motion: &Motion, code: RapidCode, cause: Cause) -> Result<()> {
    departure::refuse(control, motion, "a rapid motion")?;
    straight_rapid::look(control, motion)?;
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::rapid(control, motion),
        _ => words::rapid(control, motion, code, cause),
    }
}

/// Writes a feed motion in one block, or in several where it is longer than one may be.
///
/// # Errors
/// As [`words::feed`].
#[inline]
pub fn feed(control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
    if control.tables.most_departure.is_some() {
        let parts = departure::parts(control, motion)?;
        let of_part = feed.map(|feed| departure::feed_of_part(*feed, parts.len() + 1));
        for part in parts.iter().chain([motion]) {
            feed_in_one(control, part, of_part.as_ref())?;
        }
        return Ok(());
    }
    feed_in_one(control, motion, feed)
}

#[inline]
fn feed_in_one(control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
    if control.tables.family == ControlFamily::Klartext {
        return klartext::motion::feed(control, motion, feed);
    }
    words::feed(control, motion, feed)
}

/// Writes one pass of a thread.
///
/// # Errors
/// As [`words::thread`]; Klartext has none.
pub fn thread(control: &mut Control, motion: &Motion, lead: &Lead, change: f64) -> Result<()> {
    departure::refuse(control, motion, "a pass of a thread")?;
    match control.tables.family {
        ControlFamily::Klartext => refuse("Klartext has no pass of a thread"),
        ControlFamily::Sinumerik => sinumerik::thread::pass(control, motion, lead, change),
        ControlFamily::WordAddress if change != 0.0 => {
            words::varying_thread(control, motion, lead, change)
        }
        ControlFamily::WordAddress => words::thread(control, motion, lead),
    }
}

/// True when the control's language has a cycle for whole threads.
pub fn has_thread_cycle(control: &Control, cycle: ThreadCycle) -> bool {
    match control.tables.family {
        ControlFamily::WordAddress => word_address::thread::has_cycle(cycle),
        ControlFamily::Sinumerik => cycle == ThreadCycle::Cycle97OfASinumerik,
        ControlFamily::Klartext => false,
    }
}

/// Writes the cycle of one start of a whole thread, from where the tool stands clear; of a cycle of
/// one pass what comes before its passes.
///
/// # Errors
/// As [`word_address::thread::cycle`]; Klartext has no threads.
pub fn thread_cycle(
    control: &mut Control,
    thread: &Thread,
    shape: &Shape,
    cycle: ThreadCycle,
    ends: &Ends,
) -> Result<()> {
    match control.tables.family {
        ControlFamily::WordAddress => {
            word_address::thread::cycle(control, thread, shape, cycle, ends)
        }
        ControlFamily::Sinumerik => sinumerik::thread::cycle(control, thread, shape, ends),
        ControlFamily::Klartext => refuse("Klartext has no cycle for threads"),
    }
}

/// Begins tool-tip control, with the length offset of the tool.
///
/// # Errors
/// As [`word_address::tip_control::begin`].
pub fn begin_tip_control(control: &mut Control, offset: Option<(i64, Cause)>) -> Result<()> {
    match (control.tables.family, offset) {
        (ControlFamily::WordAddress, Some(offset)) => {
            word_address::tip_control::begin(control, offset)
        }
        (ControlFamily::WordAddress, None) => Ok(()),
        (ControlFamily::Klartext, _) => klartext::frame::begin_tip_control(control),
        (ControlFamily::Sinumerik, _) => sinumerik::swivel::begin_tip_control(control),
    }
}

/// Ends tool-tip control.
///
/// # Errors
/// As [`begin_tip_control`].
pub fn end_tip_control(control: &mut Control) -> Result<()> {
    vectors::end(control);
    match control.tables.family {
        ControlFamily::WordAddress => word_address::tip_control::end(control),
        ControlFamily::Klartext => klartext::frame::end_tip_control(control),
        ControlFamily::Sinumerik => sinumerik::swivel::end_tip_control(control),
    }
}

/// Begins a tilted frame in which the rotary axes stand, at the higher of two positions of
/// the machine's reference axis or at the lower one; says how it lies on the tape.
///
/// # Errors
/// As [`word_address::frame::begin`].
pub fn begin_frame(
    control: &mut Control,
    turn: &Rotation3<f64>,
    higher: [bool; 2],
) -> Result<Rotation3<f64>> {
    let turn = match control.tables.family {
        ControlFamily::WordAddress => word_address::frame::begin(control, turn),
        ControlFamily::Klartext => klartext::frame::begin(control, turn),
        ControlFamily::Sinumerik => {
            let higher = higher[sinumerik::swivel::reference(control)];
            sinumerik::swivel::begin(control, turn, higher)
        }
    }?;
    control.state.set(modal::WORK_PLANE, true);
    Ok(turn)
}

/// Ends a tilted frame.
///
/// # Errors
/// As [`word_address::frame::end`].
pub fn end_frame(control: &mut Control) -> Result<()> {
    match control.tables.family {
        ControlFamily::WordAddress => word_address::frame::end(control),
        ControlFamily::Klartext => klartext::frame::end(control),
        ControlFamily::Sinumerik => sinumerik::swivel::end(control),
    }
}

/// Brings the control into the modes a motion counts on.
///
/// # Errors
/// As [`words::ready`].
#[inline]
pub fn ready(control: &mut Control) -> Result<()> {
    if control.tables.family == ControlFamily::Klartext {
        return klartext::motion::ready(control);
    }
    words::ready(control)
}

/// The same for an arc in a plane.
///
/// # Errors
/// As [`ready`].
pub fn ready_for_arc(control: &mut Control, plane: Plane) -> Result<()> {
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::ready(control),
        _ => words::ready_for_arc(control, plane),
    }
}

/// The same for a hole: the control may be in the cycle that drills it.
///
/// # Errors
/// As [`ready`].
pub fn ready_for_hole(control: &mut Control, in_cycle: bool) -> Result<()> {
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::ready(control),
        _ => words::ready_for_hole(control, in_cycle),
    }
}

/// True when the control has arcs and helices in a plane, and counts the length of the tool along it
/// there.
pub fn has_arc(control: &Control, plane: Plane) -> bool {
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::has_arc(plane),
        ControlFamily::Sinumerik => length_plane::may_be(control, plane),
        ControlFamily::WordAddress => true,
    }
}

/// True when the control reads an arc from its rounded words as it is meant.
///
/// # Errors
/// A position that does not fit its address.
#[inline]
pub fn reads_as_meant(control: &Control, arc: &PlaneArc) -> Result<bool> {
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::reads_as_meant(control, arc),
        _ => word_address::arc::reads_as_meant(control, arc),
    }
}

/// Where an arc begins for the control, in the axes of its plane: where the tape stands, but
/// behind a helix of Klartext, whose end no word says.
#[inline]
pub fn start_of_arc(control: &Control, on_tape: [f64; 2]) -> [f64; 2] {
    control.klartext.start(on_tape)
}

/// The same behind an arc whose end the tape says is `on_tape`.
///
/// # Errors
/// A position that does not fit its address.
#[inline]
pub fn end_of_arc(control: &Control, arc: &PlaneArc, on_tape: [f64; 2]) -> Result<[f64; 2]> {
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::end_of_arc(control, arc, on_tape),
        _ => Ok(on_tape),
    }
}

/// Writes the block of an arc.
///
/// # Errors
/// As [`word_address::arc::write`].
pub fn arc(control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
    departure::refuse_arc(control, arc)?;
    match control.tables.family {
        ControlFamily::Klartext => klartext::motion::arc(control, arc, feed),
        ControlFamily::Sinumerik => {
            sinumerik::check_arc(control)?;
            word_address::arc::write(control, arc, feed)?;
            control
                .state
                .set(modal::PLANE_IS_TEMPORARY, length_plane::is_of_one_motion(control, arc.plane));
            Ok(())
        }
        ControlFamily::WordAddress => word_address::arc::write(control, arc, feed),
    }
}

/// The code or number of a cycle; `None` where the control has none that does all of
/// it, so that it must be written as single moves.
pub fn cycle_code(control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
    match control.tables.family {
        ControlFamily::WordAddress => word_address::cycle::code(control, cycle),
        ControlFamily::Klartext => klartext::cycle::code(control, cycle),
        ControlFamily::Sinumerik => sinumerik::cycle::code(control, cycle),
    }
}

/// True when a cycle of the control drills a hole that lies like this one.
pub fn drills(control: &Control, hole: &Hole) -> bool {
    match control.tables.family {
        ControlFamily::WordAddress => true,
        ControlFamily::Klartext => klartext::cycle::drills(hole),
        ControlFamily::Sinumerik => sinumerik::cycle::drills(control, hole),
    }
}

/// Writes the block of a hole.
///
/// # Errors
/// As [`word_address::cycle::hole`].
pub fn hole(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    at: &Motion,
    hole: &Hole,
) -> Result<()> {
    departure::refuse(control, at, "the way to a hole")?;
    match control.tables.family {
        ControlFamily::WordAddress => word_address::cycle::hole(control, cycle, code, at, hole),
        ControlFamily::Klartext => klartext::cycle::hole(control, cycle, code, at, hole),
        ControlFamily::Sinumerik => sinumerik::cycle::hole(control, cycle, code, at, hole),
    }
}

/// Ends the control's cycle, if it may be in one.
///
/// # Errors
/// As [`word_address::cycle::cancel`].
pub fn cancel_cycle(control: &mut Control) -> Result<()> {
    word_address::cycle::cancel(control)
}

/// Writes a dwell.
///
/// # Errors
/// As [`word_address::dwell::write`].
pub fn dwell(control: &mut Control, dwell: Dwell) -> Result<()> {
    write(control, Operation::Dwell(dwell))
}

/// Leaves the offset of a tool out where the tool brings its length with it.
///
/// # Errors
/// An offset that the control can't take.
pub fn take_own_offset(control: &mut Control, wanted: &mut ToolChange) -> Result<()> {
    if control.tables.family == ControlFamily::Klartext {
        return klartext::tool::take_own_offset(control, wanted);
    }
    Ok(())
}

/// Changes the tool.
///
/// # Errors
/// As [`word_address::tool::change`].
pub fn change_tool(control: &mut Control, change: ToolChange) -> Result<()> {
    match control.tables.family {
        ControlFamily::WordAddress => word_address::tool::change(control, change),
        ControlFamily::Klartext => klartext::tool::change(control, change),
        ControlFamily::Sinumerik => sinumerik::tool::change(control, change),
    }
}
