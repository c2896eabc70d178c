//! What the control does by auxiliary functions, whoever writes them: the spindle, the clamp of the
//! rotary axes, tool changes, calls and the end of the program.

use fil_machine::functions::{Call, ProgramEnd};
use fil_machine::{FunctionCode, Letter};

use super::codes::Codes;
use super::modal::{
    AXIS_CLAMP, GEAR, MASTER_IS_SUB, PROGRAM_END, SPINDLE, SPINDLE_HALTED, TOOL_CHANGED,
};
use super::{ControlState, Meaning, Rotation, Source};

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

    /// Learns what an auxiliary function does, in a block with these words. A call of a subprogram may
    /// do anything.
    pub fn learn_auxiliary(
        &mut self,
        code: FunctionCode,
        codes: &Codes,
        source: Source,
        word: impl Fn(Letter) -> Option<f64>,
    ) {
        let meanings = codes.auxiliaries(code).map(|row| row.meaning);
        if meanings.clone().next().is_none() {
            return;
        }
        let does = |does| meanings.clone().any(|meaning| meaning == does);
        // The end of a subprogram; in a main program it begins again. With P it goes on elsewhere.
        let returns = does(Meaning::Call(Call::Return)) && word(Letter::of(b'P')).is_none();
        if does(Meaning::ProgramEnd(ProgramEnd::Program)) || returns {
            self.set(PROGRAM_END, true);
        }
        if does(Meaning::MasterSpindle) {
            // Which one is counted then, and how it turns, says who writes the code.
            self.forget(MASTER_IS_SUB, source);
            self.set(SPINDLE, Rotation::InDoubt);
        }
        if let Some(rotation) = codes.rotation(code, self.is(MASTER_IS_SUB, true)) {
            self.turns(rotation);
        }
        if does(Meaning::Stop) {
            self.set(SPINDLE_HALTED, true);
        }
        if let Some(clamps) = codes.clamps(code) {
            self.set(AXIS_CLAMP, clamps);
        }
        if does(Meaning::Gear) {
            self.set(GEAR, code);
        }
        if does(Meaning::ToolChange) {
            self.has_tool(None);
            // A machine changes a tool with the spindle standing, and leaves it so.
            self.set(SPINDLE, Rotation::Standing);
            self.set(TOOL_CHANGED, true);
        }
        if meanings.clone().any(|meaning| matches!(meaning, Meaning::Call(_))) {
            self.doubt_all(source);
        }
    }
}
