//! What authors write: each block is read once, by the reader of the control's family, and the
//! control learns from what was read.

use fil_machine::locations::{self as loc};

use super::texts::without_blanks;
use super::{Control, klartext, sinumerik, speed_of_others};
use crate::control_state::{Effect, ForeignBlock, Know, Source};

impl Control {
    /// The blocks of an INSERT, as they go to the tape. The machine's end-of-block character
    /// parts them.
    pub fn read_insert(&self, text: &str) -> Vec<ForeignBlock> {
        let end_of_block = self.commons.read(loc::TAPE_END_OF_BLOCK_CHAR);
        let keeps_blanks = self.commons.read(loc::MESSAGE_KEEP_BLANKS);
        let blocks = text.split(|c| Some(c) == end_of_block).map(str::trim);
        blocks
            .filter(|block| !block.is_empty())
            .map(|block| match keeps_blanks {
                true => self.read(block.to_string()),
                false => self.read(without_blanks(block)),
            })
            .collect()
    }

    /// Reads a text as a block.
    pub fn read(&self, text: String) -> ForeignBlock {
        let mut block = self.family().read(self, &text);
        block.text = text;
        block
    }

    /// Learns from a text that has gone to the tape.
    pub(super) fn learn(&mut self, block: &ForeignBlock) {
        if block.skipped && self.can().skipped_is_unknown {
            // What a block does that may be skipped is known in no case that matters.
            self.state.doubt_all(Source::Author);
        } else {
            block.effects.iter().for_each(|effect| self.take_effect(*effect));
            if block.unread.is_none() {
                self.family().learn_words(self, &block.words);
                self.state.learn_text(block, &self.codes, self.unit);
            }
        }
        let is_certain = !block.skipped && block.unread.is_none();
        speed_of_others::learn(self, block.certain_words(), is_certain);
    }

    fn take_effect(&mut self, effect: Effect) {
        let state = &mut self.state;
        match effect {
            Effect::Set(group, value) => state.write(group, Know::Known(value)),
            Effect::Forget(group) => state.write(group, Know::Unknown(Source::Author)),
            Effect::Doubt(letter) => state.doubt(letter),
            Effect::DoubtAxes => state.doubt_axes(),
            Effect::LoseAxes => state.lose_axes(),
            Effect::ShiftAxes => state.shift_axes(),
            Effect::Clears(letter) => state.clears(letter),
            Effect::Stands(letter, value) => state.stand(letter, value),
            Effect::ToolChangeMoves => klartext::reader::tool_change_moves(self),
            Effect::Auxiliary(number) => klartext::reader::learn_function(self, number),
            Effect::EndsProgramText => klartext::reader::ends_program_text(self),
            Effect::Edge(value) => sinumerik::reader::edge(self, value),
            Effect::OtherCall => sinumerik::reader::other_call(self),
            Effect::Unread => self.family().forget(self),
        }
    }
}

#[cfg(test)]
mod tests;
