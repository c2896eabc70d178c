//! Which records of a CL file say that an operation begins.

use crate::record::Record;
use crate::words;

/// What shows that an operation begins, the weakest first. The strongest sign of a file
/// starts its operations; the weaker ones are events within them.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, PartialOrd, Ord)]
pub enum Sign {
    /// Nothing.
    #[default]
    None,
    /// LOADTL, LOAD/TOOL or TURRET.
    ToolChange,
    /// PPRINT.
    Message,
    /// FEATNO, TOOL PATH, PPRINT OPERATION NAME.
    Named,
}

/// The text of PPRINT that names an operation.
pub const NAME_OF_OPERATION: &str = "OPERATION NAME";

/// What a record says.
pub fn of(record: &Record) -> Option<Sign> {
    match record.major {
        words::FEATNO | words::TOOL_PATH => Some(Sign::Named),
        words::PPRINT if record.text.trim().starts_with(NAME_OF_OPERATION) => Some(Sign::Named),
        words::PPRINT => Some(Sign::Message),
        _ => record.takes_tool().then_some(Sign::ToolChange),
    }
}

/// The operations of a file that is read once: where each begins and ends.
#[derive(Clone, Copy, Debug, Default)]
pub struct Operations {
    /// The strongest sign so far.
    level: Sign,
    /// Motions of an operation have come, and no sign behind them.
    in_operation: bool,
}

impl Operations {
    /// Takes up a sign; true where an operation ends before it.
    pub fn sign(&mut self, sign: Sign) -> bool {
        let is_weaker = sign < self.level;
        self.level = self.level.max(sign);
        !is_weaker && self.end()
    }

    /// Takes up a motion; true where an operation begins with it.
    pub fn moves(&mut self) -> bool {
        !std::mem::replace(&mut self.in_operation, true)
    }

    /// The file ends; true where an operation does.
    pub fn end(&mut self) -> bool {
        std::mem::take(&mut self.in_operation)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_strongest_sign_begins_operations() {
        let mut operations = Operations::default();
        assert!(!operations.sign(Sign::ToolChange), "nothing has begun");
        assert!(operations.moves() && !operations.moves());
        assert!(operations.sign(Sign::ToolChange), "tools alone begin operations");
        assert!(operations.moves());
        assert!(operations.sign(Sign::Named));
        assert!(!operations.sign(Sign::ToolChange), "its tool belongs to it");
        assert!(operations.moves());
        assert!(!operations.sign(Sign::Message) && !operations.moves(), "one operation goes on");
        assert!(operations.end() && !operations.end());
    }
}
