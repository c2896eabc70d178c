//! What a SINUMERIK does of what each family does in its own way.

use fil_diag::Result;
use fil_machine::locations::ThreadCycle;
use fil_machine::modes::Plane;
use fil_machine::{FunctionCode, Letter};
use nalgebra::Rotation3;

use super::{block, cycle, program, reader, spindle, swivel, thread, tool, transformation};
use crate::cause::Cause;
use crate::control::family::Family;
use crate::control::word_address::arc;
use crate::control::{Control, length_plane, machine_frame};
use crate::control_state::{ForeignBlock, modal};
use crate::operation::cycle::{Cycle, Hole};
use crate::operation::motion::{Motion, PlaneArc};
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Feed, Lead, Operation, Thread, ToolChange};

/// SINUMERIK 840D.
#[derive(Debug)]
pub struct Sinumerik;

impl Family for Sinumerik {
    fn write(&self, control: &mut Control, operation: Operation) -> Result<()> {
        super::write(control, operation)
    }

    fn thread(
        &self,
        control: &mut Control,
        motion: &Motion,
        lead: &Lead,
        change: f64,
    ) -> Result<()> {
        thread::pass(control, motion, lead, change)
    }

    fn has_thread_cycle(&self, cycle: ThreadCycle) -> bool {
        cycle == ThreadCycle::Cycle97OfASinumerik
    }

    fn thread_cycle(
        &self,
        control: &mut Control,
        thread: &Thread,
        shape: &Shape,
        _cycle: ThreadCycle,
        ends: &Ends,
    ) -> Result<()> {
        thread::cycle(control, thread, shape, ends)
    }

    fn begin_tip_control(
        &self,
        control: &mut Control,
        _offset: Option<(i64, Cause)>,
    ) -> Result<()> {
        swivel::begin_tip_control(control)
    }

    fn end_tip_control(&self, control: &mut Control) -> Result<()> {
        swivel::end_tip_control(control)
    }

    fn begin_frame(
        &self,
        control: &mut Control,
        turn: &Rotation3<f64>,
        higher: [bool; 2],
    ) -> Result<Rotation3<f64>> {
        let higher = higher[swivel::reference(control)];
        swivel::begin(control, turn, higher)
    }

    fn end_frame(&self, control: &mut Control) -> Result<()> {
        swivel::end(control)
    }

    fn has_arc(&self, control: &Control, plane: Plane) -> bool {
        length_plane::may_be(control, plane)
    }

    fn arc(&self, control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
        super::check_arc(control)?;
        arc::write(control, arc, feed)?;
        let is_temporary = length_plane::is_of_one_motion(control, arc.plane);
        control.state.set(modal::PLANE_IS_TEMPORARY, is_temporary);
        Ok(())
    }

    fn cycle_code(&self, control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
        cycle::code(control, cycle)
    }

    fn drills(&self, control: &Control, hole: &Hole) -> bool {
        cycle::drills(control, hole)
    }

    fn hole(
        &self,
        control: &mut Control,
        cycle: &Cycle,
        code: FunctionCode,
        at: &Motion,
        hole: &Hole,
    ) -> Result<()> {
        cycle::hole(control, cycle, code, at, hole)
    }

    fn leave_cycle(&self, control: &mut Control) -> Result<()> {
        cycle::cancel(control)
    }

    fn offset_of(&self, wanted: &ToolChange) -> i64 {
        tool::edge_of(wanted)
    }

    fn take_own_offset(&self, control: &mut Control, wanted: &mut ToolChange) -> Result<()> {
        tool::take_own_offset(control, wanted)
    }

    fn change_offset(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        tool::change_edge(control, change)
    }

    fn change_tool(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        tool::change(control, change)
    }

    fn to_machine_position(&self, control: &mut Control) -> Result<()> {
        // The length of the tool would count in it.
        machine_frame::by_code(control, true)
    }

    fn read(&self, control: &Control, text: &str) -> ForeignBlock {
        reader::read(text, &control.commons)
    }

    fn forget(&self, control: &mut Control) {
        reader::forget(control);
    }

    fn learn_words(&self, control: &mut Control, words: &[(Letter, f64)]) {
        reader::learn_words(control, words);
    }

    fn readable_words(&self, block: &ForeignBlock) -> Vec<(Letter, f64)> {
        reader::readable_words(block)
    }

    fn check_text(&self, control: &Control, block: &ForeignBlock) -> Result<()> {
        reader::refuse_other_diameters(control, block)
    }

    fn put_block(&self, control: &mut Control) -> Result<()> {
        block::write(control)
    }

    fn put_words(&self, control: &mut Control, words: &[(Letter, f64, Cause)]) -> Result<()> {
        block::put(control, words)
    }

    fn head(&self, control: &mut Control) -> Result<()> {
        program::head(control)
    }

    fn begin_diameters(&self, control: &mut Control) -> Result<()> {
        program::say_diameters(control)
    }

    fn says_diameters(&self, control: &mut Control) -> Result<bool> {
        transformation::say_what_x_is(control).map(|()| true)
    }

    fn skip(&self, control: &mut Control, _on: bool) -> Result<()> {
        // MCALL on one side of the mark would call the cycle on the other.
        cycle::cancel(control)
    }

    fn says_limit(&self, control: &mut Control, limit: f64) -> Result<bool> {
        spindle::limit(control, limit).map(|()| true)
    }

    fn choose_master(&self, control: &mut Control, number: i32, is_side: bool) -> Result<()> {
        spindle::choose_master(control, number, is_side)
    }

    fn counts_turns(&self, control: &mut Control) {
        spindle::counts_turns(control);
    }

    fn says_feed_mode(&self, control: &mut Control, feed: &Feed) -> Result<bool> {
        spindle::says_feed_mode(control, feed)
    }
}
