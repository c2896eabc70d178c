//! What a word-address control does of what each family does in its own way.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::locations::ThreadCycle;
use fil_machine::modes::Plane;
use nalgebra::Rotation3;

use super::{arc, cycle, frame, motion, reader, thread, tip_control, tool};
use crate::cause::Cause;
use crate::control::family::Family;
use crate::control::{Control, machine_frame};
use crate::control_state::{ForeignBlock, Source};
use crate::operation::cycle::{Cycle, Hole};
use crate::operation::motion::{Motion, PlaneArc};
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Feed, Lead, Operation, Thread, ToolChange};

/// ISO 6983, Fanuc and its relatives.
#[derive(Debug)]
pub struct WordAddress;

impl Family for WordAddress {
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
        match change {
            0.0 => motion::thread(control, motion, lead),
            _ => motion::varying_thread(control, motion, lead, change),
        }
    }

    fn has_thread_cycle(&self, cycle: ThreadCycle) -> bool {
        thread::has_cycle(cycle)
    }

    fn thread_cycle(
        &self,
        control: &mut Control,
        thread: &Thread,
        shape: &Shape,
        cycle: ThreadCycle,
        ends: &Ends,
    ) -> Result<()> {
        thread::cycle(control, thread, shape, cycle, ends)
    }

    fn begin_tip_control(&self, control: &mut Control, offset: Option<(i64, Cause)>) -> Result<()> {
        offset.map_or(Ok(()), |offset| tip_control::begin(control, offset))
    }

    fn end_tip_control(&self, control: &mut Control) -> Result<()> {
        tip_control::end(control)
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

    fn has_arc(&self, _control: &Control, _plane: Plane) -> bool {
        true
    }

    fn arc(&self, control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
        arc::write(control, arc, feed)
    }

    fn cycle_code(&self, control: &Control, cycle: &Cycle) -> Option<FunctionCode> {
        cycle::code(control, cycle)
    }

    fn drills(&self, _control: &Control, _hole: &Hole) -> bool {
        true
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
        cycle::leave_by_code(control)
    }

    fn change_offset(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        tool::change_offset(control, change)
    }

    fn change_tool(&self, control: &mut Control, change: ToolChange) -> Result<()> {
        tool::change(control, change)
    }

    fn to_machine_position(&self, control: &mut Control) -> Result<()> {
        machine_frame::by_code(control, false)
    }

    fn read(&self, _control: &Control, text: &str) -> ForeignBlock {
        reader::read(text)
    }

    fn forget(&self, control: &mut Control) {
        control.state.doubt_all(Source::Author);
    }
}
