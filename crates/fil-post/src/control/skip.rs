//! Blocks that the operator can skip (OPSKIP).

use fil_diag::{Diag, Result};
use fil_machine::axes::AxisSet;

use super::Control;
use super::needs::Act;
use crate::control_state::Source;
use crate::errors::PostCode;

impl Control {
    /// Blocks from here on carry the skip mark, or no longer.
    ///
    /// # Errors
    /// A tool length or cutter compensation that would be begun on one side of the
    /// mark and carried out on the other.
    pub fn skip_blocks(&mut self, on: bool) -> Result<()> {
        if on == self.tape.skip.is_some() {
            return Ok(());
        }
        self.begin()?;
        self.family().skip(self, on)?;
        self.flush_waiting()?;
        self.length_waits_across(on)?;
        if on {
            self.tape.skip = Some(self.block.cause);
            self.state.skip_begins(&self.commons);
            self.tip.was_away = self.tip.is_away;
            self.tip.offset_before = self.tip.offset.map(|(offset, _)| offset);
        } else {
            self.refuse_skipped_tool()?;
            self.tape.skip = None;
            let z_counts_down = self.tables.axis(2).scale() < 0.0;
            let linear = [0, 1, 2].map(|number| self.tables.axis(number).letter);
            let rotary = AxisSet::ROTARY.and(self.tables.present()).numbers();
            let rotary: Vec<_> = rotary.map(|number| self.tables.axis(number).letter).collect();
            self.state.skip_ends(&mut self.commons, (linear, &rotary), z_counts_down);
            self.tip.is_away &= self.tip.was_away;
        }
        Ok(())
    }
}

impl Control {
    /// Refuses a tool change that tool-tip control would take the length of on both sides of the
    /// mark.
    fn refuse_skipped_tool(&self) -> Result<()> {
        let offset = self.tip.offset.map(|(offset, _)| offset);
        if !self.tables.tip_output || offset == self.tip.offset_before {
            return Ok(());
        }
        PostCode::SkippedPart.err(
            "a tool change: after OPSKIP TCPC would use the length of this tool, even if block delete left another one in the spindle",
        )
    }
}

impl Control {
    /// What any motion needs. A tool change that an author wrote within OPSKIP is a doubt.
    ///
    /// # Errors
    /// As the row of a motion; the doubt, by its level.
    #[inline]
    pub fn require_motion(&mut self) -> Result<()> {
        match self.require(Act::Motion) {
            Ok(()) => Ok(()),
            Err(refused) => self.doubt_skipped_tool(refused),
        }
    }

    #[cold]
    fn doubt_skipped_tool(&mut self, refused: Box<Diag>) -> Result<()> {
        // The post knows each tool that it changes.
        if !matches!(self.state.tools_by_block_delete(), Some([None, _])) {
            return Err(refused);
        }
        let diag = PostCode::AuthorChange.diag(
            "a block within OPSKIP changes the tool: block delete decides which one makes this \
             motion",
        );
        self.doubt(Source::Author, diag, "taken to be the tool of the blocks that are run")?;
        self.state.has_tool(None);
        self.require(Act::Motion)
    }
}

/// Refuses a motion that is right with the skipped blocks or without them, and not both.
///
/// # Errors
/// Always.
pub fn refuse_level<T>(control: &Control, number: usize) -> Result<T> {
    let letter = control.tables.axis(number).letter;
    PostCode::SkippedLevel.err(format!(
        "the position of {letter} after OPSKIP depends on block delete, and the move would be right from one of the two positions only"
    ))
}
