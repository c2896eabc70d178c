//! What the passes ask of a control, whatever its language: one trait, which each family of controls
//! implements in its folder, and a plain table of what the families have (`families`).

use fil_diag::Result;
use fil_machine::functions::WorkPlane;
use fil_machine::locations::ThreadCycle;
use fil_machine::modes::Plane;
use fil_machine::{FunctionCode, Letter};
use nalgebra::Rotation3;

use super::capabilities::Capabilities;
use super::word_address::{arc, motion as words};
use super::{Control, Function, departure, full_turn, straight_rapid, vectors};
use crate::cause::Cause;
use crate::control_state::{ForeignBlock, modal};
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, Hole};
use crate::operation::motion::{Motion, PlaneArc, RapidCode};
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Feed, Lead, Operation, Thread, ToolChange};

/// A family of controls: what its language has, and what writes it.
#[derive(Debug)]
pub struct Row {
    /// What its language has.
    pub can: Capabilities,
    /// What writes it.
    pub writer: &'static dyn Family,
}

/// What each family of controls writes in its own way. Unless a family says otherwise motions are
/// blocks of words, and what most languages lack does nothing.
pub trait Family: std::fmt::Debug + Sync {
    /// Writes an operation that does not depend on the path.
    ///
    /// # Errors
    /// A code the machine lacks, a value that does not fit, an operation at a wrong moment, what
    /// the language can't say.
    fn write(&self, control: &mut Control, operation: Operation) -> Result<()>;

    /// Writes a rapid motion in one block.
    ///
    /// # Errors
    /// A value that does not fit, a missing code, a position outside the travel.
    fn rapid(
        &self,
        control: &mut Control,
        motion: &Motion,
        code: RapidCode,
        cause: Cause,
    ) -> Result<()> {
        words::rapid(control, motion, code, cause)
    }

    /// Writes a feed motion in one block.
    ///
    /// # Errors
    /// As [`Family::rapid`]; no feed.
    fn feed(&self, control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
        words::feed(control, motion, feed)
    }

    /// Writes one pass of a thread, whose lead gains so much in each turn.
    ///
    /// # Errors
    /// As [`Family::rapid`]; the machine has no thread code.
    fn thread(
        &self,
        control: &mut Control,
        motion: &Motion,
        lead: &Lead,
        change: f64,
    ) -> Result<()>;

    /// True when the language has a cycle for whole threads.
    fn has_thread_cycle(&self, cycle: ThreadCycle) -> bool;

    /// Writes the cycle of one start of a whole thread, from where the tool stands clear; of a
    /// cycle of one pass what comes before its passes.
    ///
    /// # Errors
    /// A value that does not fit.
    fn thread_cycle(
        &self,
        control: &mut Control,
        thread: &Thread,
        shape: &Shape,
        cycle: ThreadCycle,
        ends: &Ends,
    ) -> Result<()>;

    /// Begins tool center point control, with the length offset of the tool.
    ///
    /// # Errors
    /// The machine has no code for it.
    fn begin_tip_control(&self, control: &mut Control, offset: Option<(i64, Cause)>) -> Result<()>;

    /// Ends tool center point control.
    ///
    /// # Errors
    /// As [`Family::begin_tip_control`].
    fn end_tip_control(&self, control: &mut Control) -> Result<()>;

    /// Begins a tilted work plane in which the rotary axes stand, at the higher of two positions of
    /// the machine's reference axis or at the lower one; says how it lies on the tape.
    ///
    /// # Errors
    /// The machine has no code for it; angles that can't be said.
    fn begin_frame(
        &self,
        control: &mut Control,
        turn: &Rotation3<f64>,
        higher: [bool; 2],
    ) -> Result<Rotation3<f64>>;

    /// Ends a tilted work plane.
    ///
    /// # Errors
    /// As [`Family::begin_frame`].
    fn end_frame(&self, control: &mut Control) -> Result<()>;

    /// Brings the control into the modes a motion counts on.
    ///
    /// # Errors
    /// A mode that can't be restated.
    fn ready(&self, control: &mut Control) -> Result<()> {
        words::ready(control)
    }

    /// The same for an arc in a plane.
    ///
    /// # Errors
    /// As [`Family::ready`].
    fn ready_for_arc(&self, control: &mut Control, plane: Plane) -> Result<()> {
        words::ready_for_arc(control, plane)
    }

    /// The same for a hole: the control may be in the cycle that drills it.
    ///
    /// # Errors
    /// As [`Family::ready`].
    fn ready_for_hole(&self, control: &mut Control, in_cycle: bool) -> Result<()> {
        words::ready_for_hole(control, in_cycle)
    }

    /// True when the control has arcs and helices in a plane, with the tool length offset along its
    /// normal.
    fn has_arc(&self, control: &Control, plane: Plane) -> bool;

    /// True when the control reads an arc from its rounded words as it is meant.
    ///
    /// # Errors
    /// A position that does not fit its address.
    fn reads_as_meant(&self, control: &Control, arc: &PlaneArc) -> Result<bool> {
        arc::reads_as_meant(control, arc)
    }

    /// Where an arc ends for the control whose end the tape says is `on_tape`.
    ///
    /// # Errors
    /// A position that does not fit its address.
    fn end_of_arc(
        &self,
        _control: &Control,
        _arc: &PlaneArc,
        on_tape: [f64; 2],
    ) -> Result<[f64; 2]> {
        Ok(on_tape)
    }

    /// Writes the block of an arc.
    ///
    /// # Errors
    /// A code the machine lacks, a value that does not fit, no feed.
    fn arc(&self, control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()>;

    /// The code or number of a cycle; `None` where the control has none that does all of it, so
    /// that it must be written as single moves.
    fn cycle_code(&self, control: &Control, cycle: &Cycle) -> Option<FunctionCode>;

    /// True when a cycle of the control drills a hole that lies like this one.
    fn drills(&self, control: &Control, hole: &Hole) -> bool;

    /// Writes the block of a hole.
    ///
    /// # Errors
    /// A value that does not fit.
    fn hole(
        &self,
        control: &mut Control,
        cycle: &Cycle,
        code: FunctionCode,
        at: &Motion,
        hole: &Hole,
    ) -> Result<()>;

    /// Says that no cycle is in force.
    ///
    /// # Errors
    /// The machine has no such code.
    fn leave_cycle(&self, control: &mut Control) -> Result<()>;

    /// Leaves the offset of a tool out where the tool brings its length with it.
    ///
    /// # Errors
    /// An offset that the control can't take.
    fn take_own_offset(&self, _control: &mut Control, _wanted: &mut ToolChange) -> Result<()> {
        Ok(())
    }

    /// The number that is in force with a tool: its length offset, or its cutting edge.
    fn offset_of(&self, wanted: &ToolChange) -> i64 {
        wanted.offset
    }

    /// Changes the tool.
    ///
    /// # Errors
    /// A tool or offset that does not fit, an offset the machine can't call.
    fn change_tool(&self, control: &mut Control, change: ToolChange) -> Result<()>;

    /// Takes another offset for the tool in the spindle; by calling the tool again where offsets are
    /// those of tools.
    ///
    /// # Errors
    /// As [`Family::change_tool`].
    fn change_offset(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        self.change_tool(control, change)
    }

    /// Writes the block under construction, whose words say a position of the machine, as a rapid
    /// motion to it.
    ///
    /// # Errors
    /// A code the machine lacks.
    fn to_machine_position(&self, control: &mut Control) -> Result<()>;

    /// Reads a foreign block.
    fn read(&self, control: &Control, text: &str) -> ForeignBlock;

    /// What a foreign block leaves unknown that can't be read.
    fn forget(&self, control: &mut Control);

    /// Learns from words of a foreign block what no other family does.
    fn learn_words(&self, _control: &mut Control, _words: &[(Letter, f64)]) {}

    /// The words of a line as far as they can be read.
    fn readable_words(&self, block: &ForeignBlock) -> Vec<(Letter, f64)> {
        block.words.clone()
    }

    /// Refuses a foreign block that the language would read otherwise than the post.
    ///
    /// # Errors
    /// It is one.
    fn check_text(&self, _control: &Control, _block: &ForeignBlock) -> Result<()> {
        Ok(())
    }

    /// Puts the block under construction on the tape.
    ///
    /// # Errors
    /// As the tape.
    fn put_block(&self, control: &mut Control) -> Result<()> {
        control.tape.block(&control.block, &control.tables, &mut control.commons)
    }

    /// Puts words on the tape in the order given.
    ///
    /// # Errors
    /// As the tape.
    fn put_words(&self, control: &mut Control, words: &[(Letter, f64, Cause)]) -> Result<()> {
        control.tape.words(words, &control.tables, &mut control.commons)
    }

    /// Puts a text on the tape as a line, with a number or without.
    ///
    /// # Errors
    /// As the tape.
    fn put_text(&self, control: &mut Control, text: &str, numbered: bool) -> Result<()> {
        let cause = control.block.cause;
        control.tape.line(text, cause, numbered, &control.tables, &mut control.commons)
    }

    /// Writes the whole start of a program with the blocks of the machine; false where the usual
    /// one is to be written.
    ///
    /// # Errors
    /// As a line of the tape.
    fn start(&self, _control: &mut Control, _blocks: &[String]) -> Result<bool> {
        Ok(false)
    }

    /// Ends what the start of the program has begun, before its end code.
    ///
    /// # Errors
    /// As a line of the tape.
    fn before_end(&self, _control: &mut Control) -> Result<()> {
        Ok(())
    }

    /// Writes what comes before the name of the program.
    ///
    /// # Errors
    /// As a line of the tape.
    fn head(&self, _control: &mut Control) -> Result<()> {
        Ok(())
    }

    /// Says behind the start of the program how X counts.
    ///
    /// # Errors
    /// As a line of the tape.
    fn begin_diameters(&self, _control: &mut Control) -> Result<()> {
        Ok(())
    }

    /// Restates whether X is a diameter; false where a code says it.
    ///
    /// # Errors
    /// As a line of the tape.
    fn says_diameters(&self, _control: &mut Control) -> Result<bool> {
        Ok(false)
    }

    /// Ends the text of the program; false where the tape does.
    ///
    /// # Errors
    /// As a line of the tape.
    fn close(&self, _control: &mut Control) -> Result<bool> {
        Ok(false)
    }

    /// Prepares the begin or the end of blocks that can be skipped.
    ///
    /// # Errors
    /// What the language can't keep on both sides.
    fn skip(&self, _control: &mut Control, _on: bool) -> Result<()> {
        Ok(())
    }

    /// Writes the end of cutter compensation, which waits for a motion, without one.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    fn end_compensation(&self, control: &mut Control) -> Result<()> {
        control.flush_function(Function::Compensation)
    }

    /// Writes the highest speed of the spindle by a statement; false where a code says it.
    ///
    /// # Errors
    /// As a line of the tape.
    fn says_limit(&self, _control: &mut Control, _limit: f64) -> Result<bool> {
        Ok(false)
    }

    /// Makes the second spindle of a lathe the one that is counted, or the main one again.
    ///
    /// # Errors
    /// The language has no statement for it.
    fn choose_master(&self, _control: &mut Control, _number: i32, _is_side: bool) -> Result<()> {
        PostCode::Family.err("no statement chooses the spindle that is counted")
    }

    /// The spindle counts turns again, by a code that was written alone.
    fn counts_turns(&self, _control: &mut Control) {}

    /// A mode of the speed says the mode of the feed too.
    ///
    /// # Errors
    /// The mode of the speed is in doubt.
    fn says_feed_mode(&self, _control: &mut Control, _feed: &Feed) -> Result<bool> {
        Ok(false)
    }
}

impl Control {
    /// What the language of the control has.
    #[inline]
    pub fn can(&self) -> &'static Capabilities {
        &self.family.can
    }

    /// What writes the language of the control.
    #[inline]
    pub fn family(&self) -> &'static dyn Family {
        self.family.writer
    }
}

/// Writes a rapid motion in one block.
///
/// # Errors
/// As [`Family::rapid`].
pub fn rapid(control: &mut Control, motion: &Motion, code: RapidCode, cause: Cause) -> Result<()> {
    departure::refuse(control, motion, "a rapid move")?;
    straight_rapid::look(control, motion)?;
    control.family().rapid(control, motion, code, cause)?;
    full_turn::end_turn(control)
}

/// Writes a feed motion in one block, or in several where it is longer than one may be.
///
/// # Errors
/// As [`Family::feed`].
#[inline]
pub fn feed(control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
    if control.tables.most_departure.is_some() {
        let parts = departure::parts(control, motion)?;
        let of_part = feed.map(|feed| departure::feed_of_part(*feed, parts.len() + 1));
        for part in parts.iter().chain([motion]) {
            control.family().feed(control, part, of_part.as_ref())?;
        }
        return Ok(());
    }
    control.family().feed(control, motion, feed)
}

/// Writes one pass of a thread.
///
/// # Errors
/// As [`Family::thread`].
pub fn thread(control: &mut Control, motion: &Motion, lead: &Lead, change: f64) -> Result<()> {
    departure::refuse(control, motion, "a pass of a thread")?;
    control.family().thread(control, motion, lead, change)
}

/// Ends tool center point control.
///
/// # Errors
/// As [`Family::end_tip_control`].
pub fn end_tip_control(control: &mut Control) -> Result<()> {
    vectors::end(control);
    control.family().end_tip_control(control)
}

/// Begins a tilted work plane.
///
/// # Errors
/// As [`Family::begin_frame`].
pub fn begin_frame(
    control: &mut Control,
    turn: &Rotation3<f64>,
    higher: [bool; 2],
) -> Result<Rotation3<f64>> {
    let turn = control.family().begin_frame(control, turn, higher)?;
    control.state.set(modal::WORK_PLANE, WorkPlane::Tilted);
    Ok(turn)
}

/// Writes the block of an arc.
///
/// # Errors
/// As [`Family::arc`].
pub fn arc(control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
    departure::refuse_arc(control, arc)?;
    control.family().arc(control, arc, feed)
}

/// Writes the block of a hole.
///
/// # Errors
/// As [`Family::hole`].
pub fn hole(
    control: &mut Control,
    cycle: &Cycle,
    code: FunctionCode,
    at: &Motion,
    hole: &Hole,
) -> Result<()> {
    departure::refuse(control, at, "the way to a hole")?;
    control.family().hole(control, cycle, code, at, hole)
}
