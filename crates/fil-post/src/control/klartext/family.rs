//! What a Klartext control does of what each family does in its own way.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::locations::ThreadCycle;
use fil_machine::modes::Plane;
use nalgebra::Rotation3;

use super::{cycle, frame, line, motion, phrase, program, reader, skip, tool};
use crate::cause::Cause;
use crate::control::Control;
use crate::control::family::Family;
use crate::control_state::ForeignBlock;
use crate::errors::PostCode;
use crate::operation::cycle::{Cycle, Hole};
use crate::operation::motion::{Motion, PlaneArc, RapidCode};
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Feed, Lead, Operation, Thread, ToolChange};

/// Heidenhain Klartext.
#[derive(Debug)]
pub struct Klartext;

impl Family for Klartext {
    fn write(&self, control: &mut Control, operation: Operation) -> Result<()> {
        super::write(control, operation)
    }

    fn rapid(
        &self,
        control: &mut Control,
        motion: &Motion,
        _code: RapidCode,
        _cause: Cause,
    ) -> Result<()> {
        motion::rapid(control, motion)
    }

    fn feed(&self, control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
        motion::feed(control, motion, feed)
    }

    fn thread(
        &self,
        _control: &mut Control,
        _motion: &Motion,
        _lead: &Lead,
        _change: f64,
    ) -> Result<()> {
        PostCode::Family.err("Klartext has no pass of a thread")
    }

    fn has_thread_cycle(&self, _cycle: ThreadCycle) -> bool {
        false
    }

    fn thread_cycle(
        &self,
        _control: &mut Control,
        _thread: &Thread,
        _shape: &Shape,
        _cycle: ThreadCycle,
        _ends: &Ends,
    ) -> Result<()> {
        PostCode::Family.err("Klartext has no cycle for threads")
    }

    fn begin_tip_control(
        &self,
        control: &mut Control,
        _offset: Option<(i64, Cause)>,
    ) -> Result<()> {
        frame::begin_tip_control(control)
    }

    fn end_tip_control(&self, control: &mut Control) -> Result<()> {
        frame::end_tip_control(control)
    }

    fn begin_frame(
        &self,
        control: &mut Control,
        turn: &Rotation3<f64>,
        _higher: [bool; 2],
    ) -> Result<Rotation3<f64>> {
        frame::begin(control, turn)
    }

    fn end_frame(&self, control: &mut Control) -> Result<()> {
        frame::end(control)
    }

    fn ready(&self, control: &mut Control) -> Result<()> {
        motion::ready(control)
    }

    fn ready_for_arc(&self, control: &mut Control, _plane: Plane) -> Result<()> {
        motion::ready(control)
    }

    fn ready_for_hole(&self, control: &mut Control, _in_cycle: bool) -> Result<()> {
        motion::ready(control)
    }

    fn has_arc(&self, _control: &Control, plane: Plane) -> bool {
        motion::has_arc(plane)
    }

    fn reads_as_meant(&self, control: &Control, arc: &PlaneArc) -> Result<bool> {
        motion::reads_as_meant(control, arc)
    }

    fn end_of_arc(&self, control: &Control, arc: &PlaneArc, on_tape: [f64; 2]) -> Result<[f64; 2]> {
        motion::end_of_arc(control, arc, on_tape)
    }

    fn arc(&self, control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
        motion::arc(control, arc, feed)
    }

    fn cycle_code(&self, control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
        cycle::code(control, cycle)
    }

    fn drills(&self, _control: &Control, hole: &Hole) -> bool {
        cycle::drills(hole)
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

    fn leave_cycle(&self, _control: &mut Control) -> Result<()> {
        Ok(())
    }

    fn take_own_offset(&self, control: &mut Control, wanted: &mut ToolChange) -> Result<()> {
        tool::take_own_offset(control, wanted)
    }

    fn change_tool(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        tool::change(control, change)
    }

    fn to_machine_position(&self, control: &mut Control) -> Result<()> {
        motion::to_machine_position(control)
    }

    fn read(&self, _control: &Control, text: &str) -> ForeignBlock {
        reader::read(text)
    }

    fn forget(&self, control: &mut Control) {
        reader::forget(control);
    }

    fn put_block(&self, control: &mut Control) -> Result<()> {
        phrase::write(control)
    }

    fn put_text(&self, control: &mut Control, text: &str, _numbered: bool) -> Result<()> {
        let cause = control.block.cause;
        line::put(control, &line::Line::of_text(text, cause))
    }

    fn start(&self, control: &mut Control, blocks: &[String]) -> Result<bool> {
        program::start(control, blocks).map(|()| true)
    }

    fn before_end(&self, control: &mut Control) -> Result<()> {
        program::shortest_path(control, program::PATH_OF_NUMBERS)
    }

    fn close(&self, control: &mut Control) -> Result<bool> {
        program::end(control).map(|()| true)
    }

    fn skip(&self, control: &mut Control, on: bool) -> Result<()> {
        skip::change(control, on)
    }

    fn end_compensation(&self, control: &mut Control) -> Result<()> {
        motion::end_compensation(control)
    }
}
