//! What authors write: each block is read once, by the reader of the control's family, and the
//! control learns from what was read.

use fil_machine::effects::Effect as Rule;
use fil_machine::locations as loc;
use fil_machine::{FunctionCode, Letter, letters};

use super::texts::without_blanks;
use super::{Control, klartext, reference_way, sinumerik, speed_of_others};
use crate::control_state::{Effect, ForeignBlock, Know, Meaning, Source, modal};
use crate::errors::PostCode;

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
        self.take_rule(&mut block);
        block
    }

    /// Puts what `[effects]` says of a block in the place of what was read.
    fn take_rule(&self, block: &mut ForeignBlock) {
        // What block delete may skip is no certain change.
        if block.skipped {
            return;
        }
        let Some(found) = self.commons.effects().of(&block.text) else { return };
        let named = block.words.iter().rev().find(|(letter, _)| *letter == letters::T);
        let effect = match found.rule.effect {
            Rule::ToolChange => Some(Effect::ChangesTool(named.map(|(_, tool)| *tool))),
            Rule::ReturnsClear => Some(Effect::ReturnsClear),
            Rule::KeepsPosition => Some(Effect::KeepsPosition),
            Rule::Coolant | Rule::Nothing => None,
        };
        if found.is_function {
            let is_it = |(letter, value): &(Letter, f64)| {
                *letter == letters::M && FunctionCode::of_value(*value) == found.rule.function()
            };
            block.words.retain(|word| !is_it(word));
        } else {
            let text = std::mem::take(&mut block.text);
            *block = ForeignBlock { text, skipped: block.skipped, ..ForeignBlock::default() };
        }
        block.effects.extend(effect);
        block.is_said = true;
        block.pattern = found.rule.is_pattern().then(|| found.rule.said.clone());
    }

    /// Learns from words of an author (POSTN) whose line on the tape begins at `start`, where
    /// `[effects]` says what they do; false where it says nothing.
    pub(super) fn learn_by_rule(&mut self, start: usize) -> bool {
        if self.commons.effects().is_empty() {
            return false;
        }
        let line = self.tape.last_line(start, &self.tables);
        if self.commons.effects().of(&line).is_none() {
            return false;
        }
        let block = self.read(line);
        if block.is_said {
            self.learn(&block);
        }
        block.is_said
    }

    /// Learns from a text that has gone to the tape.
    pub(super) fn learn(&mut self, block: &ForeignBlock) {
        if let Some(pattern) = &block.pattern {
            let message = format!("`{}` matches `{pattern}` of [effects]", block.text);
            self.warnings.add_once(PostCode::EffectPattern, pattern, message);
        }
        if self.is_unread(block) {
            self.warnings.unread_block = Some(block.text.clone());
        }
        if block.skipped && self.can().skipped_is_unknown {
            // What a block does that may be skipped is known in no case that matters.
            self.state.doubt_all(Source::Author);
        } else {
            block.effects.iter().for_each(|effect| self.take_effect(*effect));
            if block.unread.is_none() {
                reference_way::warn(self, &block.words);
                self.family().learn_words(self, &block.words);
                self.state.learn_text(block, &self.codes, self.unit);
            }
        }
        let is_certain = !block.skipped && block.unread.is_none();
        speed_of_others::learn(self, block.certain_words(), is_certain);
    }

    /// A block that can't be read whole, calls a program, or has a G function of the shop.
    fn is_unread(&self, block: &ForeignBlock) -> bool {
        let is_open = |letter, code| match letter {
            letters::M => self.codes.calls_program(code),
            letters::G => self.codes.meaning(code) == Meaning::Unknown,
            _ => false,
        };
        block.unread.is_some() || block.calls_subprogram() || block.has_function(is_open)
    }

    fn take_effect(&mut self, effect: Effect) {
        let state = &mut self.state;
        match effect {
            Effect::Set(group, value) => state.write(group, Know::Known(value)),
            Effect::Forget(group) => state.write(group, Know::Unknown(Source::Author)),
            Effect::Doubt(letter) => state.doubt(letter),
            Effect::DoubtAxes => state.doubt_axes(),
            Effect::LoseAxes => state.lose_axes(),
            Effect::ShiftAxes => state.shift_axes(Source::Author),
            Effect::Clears(letter, spot) => state.clears(letter, spot),
            Effect::Stands(letter, value) => state.stand(letter, value),
            Effect::ToolChangeMoves => self.tool_change_moves(),
            Effect::Auxiliary(number) => klartext::reader::learn_function(self, number),
            Effect::EndsProgramText => klartext::reader::ends_program_text(self),
            Effect::Edge(value) => sinumerik::reader::edge(self, value),
            Effect::ChangesTool(tool) => {
                state.learn_said_change(tool.filter(|tool| tool.fract() == 0.0), &self.codes);
                self.tool_change_moves();
            }
            Effect::ReturnsClear => self.returns_clear(),
            Effect::KeepsPosition => state.keeps_position(),
            Effect::OtherCall => sinumerik::reader::other_call(self),
            Effect::Unread => self.family().forget(self),
        }
    }
}

impl Control {
    /// A call of the shop has brought all axes clear of the part.
    fn returns_clear(&mut self) {
        for number in self.tables.present().numbers() {
            self.state.clears(self.tables.axis(number).letter, None);
        }
        self.state.length_ends_at_machine(&self.codes, |_| true);
        self.state.forget(modal::MOTION, Source::Author);
    }
}

#[cfg(test)]
mod tests;
