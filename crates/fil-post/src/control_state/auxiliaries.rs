//! What the control does by auxiliary functions, whoever writes them: the spindle, the clamp of the
//! rotary axes, tool changes, calls and the end of the program.

use fil_machine::FunctionCode;

use super::codes::Codes;
use super::{ControlState, Rotation, TOOL_CHANGE};

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
        self.turned_behind != self.tool_changes
    }

    /// The spindle has been told how to turn.
    pub fn turns(&mut self, rotation: Rotation) {
        self.rotation = rotation;
        self.turned_behind = self.tool_changes;
        self.halted = false;
    }

    /// Learns what an auxiliary function does. A call of a subprogram may do anything.
    pub fn learn_auxiliary(&mut self, code: FunctionCode, codes: &Codes) {
        const END: [FunctionCode; 2] = [FunctionCode::whole(2), FunctionCode::whole(30)];
        self.ended |= END.contains(&code);
        if codes.chooses_spindle(code) {
            // Which one is counted then, and how it turns, says who writes the code.
            self.side_is_counted = None;
            self.rotation = Rotation::InDoubt;
        }
        if let Some(rotation) = codes.rotation(code, self.side_is_counted == Some(true)) {
            self.turns(rotation);
        }
        self.halted |= codes.stops_program(code);
        self.may_be_clamped = codes.clamps(code).unwrap_or(self.may_be_clamped);
        if codes.is_spindle_range(code) {
            self.range = Some(code);
        }
        if code == TOOL_CHANGE {
            self.has_tool(None);
            self.tool_changes += 1;
            // A machine changes a tool with the spindle standing, and leaves it so.
            self.rotation = Rotation::Standing;
        }
        if CALLS.contains(&code) {
            self.forget();
        }
    }
}
