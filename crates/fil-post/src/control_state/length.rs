//! Whether Z counts from the tip of the tool.

use fil_machine::functions::LengthOffset;
use fil_machine::locations::{self as loc, ControlFamily, ToolFormat};
use fil_machine::{Commons, Letter, letters};

use super::modal::{LENGTH, LENGTH_OFFSET, LENGTH_WORD};
use super::{Codes, ControlState, Source};

/// What the length of the tool is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Length {
    /// Nothing has said it.
    Unsaid,
    /// The length of the tool is in force.
    Called,
    /// It was, and has been taken off.
    Taken,
    /// It was, and a position of the machine has ended it, while its function stays in force: on a
    /// Fanuc G53, G28 and G30 cancel the offset of the axis that they move (0i-MB, B-63844EN,
    /// 14.1.2), on a Haas G28 does.
    Ended,
    /// Words that the post has not made have changed the tool.
    OfAnotherTool,
}

impl Length {
    /// What must be reckoned with if either may be in force: what a motion may not be made with.
    pub(super) fn or(self, other: Self) -> Self {
        if matches!(other, Length::Unsaid | Length::Called) { self } else { other }
    }
}

impl ControlState {
    /// The length of the tool is called, or taken off.
    pub fn calls_length(&mut self, on: bool) {
        let length = match (on, self.length()) {
            (true, _) => Length::Called,
            (false, Length::Called | Length::Ended) => Length::Taken,
            (false, other) => other,
        };
        self.set(LENGTH, length);
    }

    /// A function of the length stands in a block. Tool-tip control takes that of the last LOADTL,
    /// whatever another function has called.
    pub(super) fn learn_length(&mut self, does: LengthOffset, codes: &Codes) {
        if self.length() != Length::OfAnotherTool || !codes.tip_control {
            self.calls_length(does == LengthOffset::Activate);
        }
    }

    /// A word of others names the offset of a length; `calls` where it stands beside the function
    /// of the length.
    pub(super) fn names_length(&mut self, value: f64, calls: bool) {
        let offset = (calls && value.fract() == 0.0).then_some(value as i64);
        self.set(LENGTH_WORD, true);
        self.groups.set_if_known(LENGTH_OFFSET, offset, Source::Author);
        self.doubt(letters::H);
    }

    /// A word of others names tool and offset in one: T0303. T0300 takes the offset off.
    pub(super) fn length_by_tool_word(&mut self, value: f64) {
        self.set(LENGTH, if value % 100.0 == 0.0 { Length::Taken } else { Length::Called });
    }

    /// LOADTL has changed the tool, whose length waits to be called; `by_its_word`: it is called
    /// already.
    pub fn length_of_new_tool(&mut self, by_its_word: bool) {
        if by_its_word || self.length() == Length::OfAnotherTool {
            self.set(LENGTH, Length::Unsaid);
        }
    }

    /// A position of the machine has been reached by axes of which `moves` is true.
    pub fn length_ends_at_machine(&mut self, codes: &Codes, moves: impl Fn(Letter) -> bool) {
        if codes.positions_end_lengths && self.length() == Length::Called && moves(letters::XYZ[2])
        {
            self.set(LENGTH, Length::Ended);
        }
    }

    /// Words of others have changed the tool, and called no length.
    pub(super) fn length_is_of_another_tool(&mut self, codes: &Codes) {
        if codes.calls_lengths {
            self.set(LENGTH, Length::OfAnotherTool);
        }
    }
}

/// LOADTL calls the length of its tool by a function with a number, in word address.
pub(super) fn are_called(commons: &Commons) -> bool {
    commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress
        && commons.read(loc::TOOL_FORMAT) == ToolFormat::TWordAndChangeCode
        && commons.read(loc::TOOL_LENGTH_FROM_TOOL)
        && commons.read(loc::TOOL_LENGTH_CODE).is_some()
}
