//! How the machine calls and changes its tools, as `verify` expects it.

use fil_machine::effects::Effect;
use fil_machine::letter::letters;
use fil_machine::locations::{
    self as loc, ControlFamily, ControlToolOffsets, ToolChangeBlock, ToolFormat,
};

use super::{Due, Settings};
use crate::motion::unit;
use crate::verify::GivenOffset;

impl Settings<'_> {
    /// True when the tool's number is that of its diameter offset.
    pub fn offsets_diameters_by_tool(&self) -> bool {
        self.commons.read(loc::TOOL_DIAMETER_FROM_TOOL)
    }

    /// True for a lathe whose compensation takes the nose of the tool in the spindle, unless a word
    /// names that of another offset.
    pub fn takes_noses_of_tools(&self) -> bool {
        let has_own = self.has_edges() || self.calls_tools_with_offset();
        self.is_lathe() && !has_own && !self.offsets_diameters_by_tool()
    }

    /// When cutter compensation must be in force.
    pub fn compensation_due(&self, mills: bool) -> Due {
        match self.commons.read(loc::CUTCOM_WITH_MOTION) {
            false => Due::Now,
            true if self.is_lathe() && !mills => Due::WithAny,
            true => Due::InPlane,
        }
    }

    /// True when the program calls tools.
    pub fn calls_tools(&self) -> bool {
        self.commons.read(loc::TOOL_CHANGE_CODE).is_some() || self.writes(letters::T)
    }

    /// True when a tool already in the spindle is not called again.
    pub fn tool_is_modal(&self) -> bool {
        self.commons.read(loc::TOOL_MODAL)
    }

    /// True when tool and offset stand in one word, `T0101`.
    pub fn calls_tools_with_offset(&self) -> bool {
        self.commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode
    }

    /// True when the words that name a tool activate its length: the program needs them behind a
    /// change by hand too.
    pub fn calls_lengths_by_tool(&self) -> bool {
        self.calls_tools_with_offset()
            || self.commons.read(loc::CONTROL_FAMILY) != ControlFamily::WordAddress
    }

    /// True when a tool change is followed by a length offset of its own.
    pub fn calls_offsets(&self) -> bool {
        self.calls_named_offsets() && self.commons.read(loc::TOOL_LENGTH_FROM_TOOL)
    }

    /// LOADTL with OSETNO calls that offset.
    pub fn calls_named_offsets(&self) -> bool {
        !self.calls_tools_with_offset()
            && self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress
            && self.commons.read(loc::TOOL_LENGTH_CODE).is_some()
    }

    /// `[effects]` says that a text changes the tool.
    pub fn changes_tool(&self, text: &str) -> bool {
        let found = self.commons.effects().of(text);
        found.is_some_and(|found| found.rule.effect == Effect::ToolChange)
    }

    /// The length offset stands right behind the tool change.
    pub fn calls_offset_at_change(&self) -> bool {
        self.commons.read(loc::TOOL_LENGTH_AT_CHANGE)
    }

    /// D chooses a cutting edge of the tool, with length and radius.
    pub fn has_edges(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik
    }

    /// The offset that a tool comes with: that of its record, else its own number or,
    /// where D chooses an edge, the first. A compensation of its own is an edge.
    pub fn tool_offset(&self, number: u32, given: Option<GivenOffset>) -> u32 {
        let takes_compensation =
            self.has_edges() || self.commons.read(loc::TOOL_COMPENSATION_OFFSET);
        match given {
            Some(GivenOffset::Compensation(edge)) if takes_compensation => edge,
            Some(GivenOffset::OfMachine(offset)) if !self.takes_offsets_of_tools() => offset,
            _ if self.has_edges() => 1,
            _ => number,
        }
    }

    /// The numbers of offsets are left out: length and radius come with the tool.
    pub fn takes_offsets_of_tools(&self) -> bool {
        self.commons.read(loc::CONTROL_FAMILY) != ControlFamily::WordAddress
            && self.commons.read(loc::CONTROL_TOOL_OFFSETS) == ControlToolOffsets::OfTheTool
    }

    /// A tool change may bring the axes elsewhere, so that each is said again behind it.
    pub fn restates_after_change(&self) -> bool {
        self.commons.read(loc::TOOL_RESTATE)
    }

    /// Z that the length offset is called with, mm.
    pub fn offset_level(&self, metric: bool) -> Option<f64> {
        let z = self.commons.dbl_opt(loc::TOOL_LENGTH_Z).filter(|_| self.calls_offsets());
        z.map(|z| z * unit(metric))
    }

    /// Where the axes go before a tool change: X Y Z in mm, primary and secondary
    /// rotary in degrees; `None` for an axis that stays.
    pub fn change_position(&self, metric: bool) -> [Option<f64>; 5] {
        let axes = match self.commons.read(loc::TOOL_CHANGE_BLOCK) {
            ToolChangeBlock::None => 0,
            ToolChangeBlock::Xyz => 3,
            ToolChangeBlock::XyzAndRotary => 6,
        };
        let value = |common: usize| {
            let at = loc::CHANGE_POSITION[..axes].get(common)?;
            self.commons.dbl_opt(*at)
        };
        let unit = unit(metric);
        let linear = |common: usize| value(common).map(|value| value * unit);
        let rotary = |index: usize| {
            let axis = self.forward.rotaries()[index].as_ref()?;
            value(axis.axis + 3)
        };
        [linear(0), linear(1), linear(2), rotary(0), rotary(1)]
    }
}
