//! The word-address control (ISO 6983, Fanuc and its relatives): blocks of words,
//! each a letter and a number. One file an operation.

pub mod arc;
pub mod compensation;
pub(crate) mod coolant;
pub mod cycle;
pub mod dwell;
pub mod family;
pub(crate) mod fixture;
pub mod frame;
mod function;
pub mod modes;
pub mod motion;
pub mod osp_thread;
pub mod reader;
pub(crate) mod repeat;
pub mod spindle;
pub(super) mod stop;
pub(super) mod text;
pub mod thread;
pub mod tip_control;
pub mod tool;

use fil_diag::Result;

use super::Control;
use crate::operation::Operation;

/// Writes an operation that does not depend on the path.
///
/// # Errors
/// A code the machine lacks, a value that does not fit, an operation at a wrong
/// moment.
pub fn write(control: &mut Control, operation: Operation) -> Result<()> {
    match operation {
        Operation::Dwell(dwell) => dwell::write(control, dwell),
        Operation::Spindle(spindle) => spindle::write(control, spindle),
        Operation::Coolant(coolant) => coolant::write(control, coolant),
        Operation::Compensation(compensation) => compensation::write(control, compensation),
        Operation::SelectTool(tool) => tool::select(control, tool),
        Operation::Function(letter, code) => function::write(control, letter, code),
        Operation::WorkOffset(number) => fixture::write(control, number),
        Operation::WithMotion(letter, code) => function::with_motion(control, letter, code),
        Operation::Words(words) => control.write_words(&words),
        Operation::Repeat(words) => repeat::set(control, words),
        Operation::Text(blocks) => text::insert(control, &blocks),
        Operation::Message(text) => text::message(control, &text),
        Operation::Stop(stop) => stop::stop(control, stop),
        Operation::End(end) => stop::end(control, end),
        Operation::Skip(_)
        | Operation::Linear(..)
        | Operation::MachinePosition(_)
        | Operation::Turn(..)
        | Operation::Arc(..)
        | Operation::Hole(_)
        | Operation::Thread(_)
        | Operation::ToolChange(_) => unreachable!("the passes take what moves, and OPSKIP"),
    }
}
