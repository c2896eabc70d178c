//! What the control does by auxiliary functions, whoever writes them: the spindle, the clamp of the
//! rotary axes, tool changes, calls and the end of the program.

use fil_machine::FunctionCode;

use super::codes::Codes;
use super::modal::{
    AXIS_CLAMP, GEAR, MASTER_IS_SUB, PROGRAM_END, SPINDLE, SPINDLE_HALTED, TOOL_CHANGED,
};
use super::{ControlState, Rotation, Source, TOOL_CHANGE};

/// They call a program, or come back from one.
pub const CALLS: [FunctionCode; 4] = [
    FunctionCode::whole(97),
    FunctionCode::whole(98),
    FunctionCode::whole(99),
    FunctionCode::whole(198),
];

impl ControlState {
    /// A tool change by its function came since the spindle was turned: many machines stop it.
    pub fn tool_is_changed_since_turned(&self) -> bool {
        self.groups.written(TOOL_CHANGED) > self.groups.written(SPINDLE)
    }

    /// The spindle has been told how to turn.
    pub fn turns(&mut self, rotation: Rotation) {
        self.set(SPINDLE, rotation);
        self.set(SPINDLE_HALTED, false);
    }

    /// Learns what an auxiliary function does. A call of a subprogram may do anything.
    pub fn learn_auxiliary(&mut self, code: FunctionCode, codes: &Codes, source: Source) {
        const END: [FunctionCode; 2] = [FunctionCode::whole(2), FunctionCode::whole(30)];
        if END.contains(&code) {
            self.set(PROGRAM_END, true);
        }
        if codes.chooses_spindle(code) {
            // Which one is counted then, and how it turns, says who writes the code.
            self.forget(MASTER_IS_SUB, source);
            self.set(SPINDLE, Rotation::InDoubt);
        }
        if let Some(rotation) = codes.rotation(code, self.is(MASTER_IS_SUB, true)) {
            self.turns(rotation);
        }
        if codes.stops_program(code) {
            self.set(SPINDLE_HALTED, true);
        }
        if let Some(clamps) = codes.clamps(code) {
            self.set(AXIS_CLAMP, clamps);
        }
        if codes.is_spindle_range(code) {
            self.set(GEAR, code);
        }
        if code == TOOL_CHANGE {
            self.has_tool(None);
            // A machine changes a tool with the spindle standing, and leaves it so.
            self.set(SPINDLE, Rotation::Standing);
            self.set(TOOL_CHANGED, true);
        }
        if CALLS.contains(&code) {
            self.doubt_all(source);
        }
    }
}
