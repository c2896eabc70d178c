//! A block with several functions on a control that takes one G or one M in a block.

use fil_diag::Result;
use fil_machine::functions::Acts;
use fil_machine::letters::{G, M, S, T};
use fil_machine::{FunctionCode, locations as loc};

use super::Control;
use crate::cause::Cause;
use crate::control_state::{Compensation, Meaning};
use crate::errors::PostCode;

impl Control {
    /// True when the block under construction has more functions than the control takes.
    pub(super) fn is_crowded(&self) -> bool {
        let style = &self.tables.style;
        (!style.several_g && self.block.g_codes().len() > 1)
            || (!style.several_m && self.block.m_codes().len() > 1)
    }

    /// Writes the block under construction as several: modes first, then what M switches
    /// on, the words with one G and one M, and what M switches off.
    ///
    /// # Errors
    /// Two preparatory functions that both need the words of the block.
    #[cold]
    pub(super) fn write_apart(&mut self) -> Result<()> {
        let mut block = self.block.take();
        if !self.tables.style.several_g && block.g_codes().len() > 1 {
            let codes = block.g_codes().to_vec();
            let modes: Vec<_> =
                codes.iter().copied().filter(|(code, _)| self.is_mode(*code)).collect();
            let others = codes.len() - modes.len();
            if others > 1 && block.has_numbers() {
                let names: Vec<String> =
                    codes.iter().map(|(code, _)| format!("G{}", code.value())).collect();
                return PostCode::Crowded.err(format!("{} in one block", names.join(" ")));
            }
            // The last one keeps the words, if it is not the only thing that a mode needs.
            let alone = if others > 0 { modes } else { codes[..codes.len() - 1].to_vec() };
            for (code, cause) in alone {
                block.remove(G, code);
                self.block.g(code, cause);
                self.move_offset(code, &mut block);
                self.write_block()?;
            }
            if others > 1 {
                return self.each_alone(block);
            }
        }
        let codes = block.m_codes().to_vec();
        if self.tables.style.several_m || codes.len() < 2 {
            self.block = block;
            return self.write_block();
        }
        let keeper = self.keeper(&block, &codes);
        let others: Vec<_> = codes.into_iter().filter(|(code, _)| *code != keeper).collect();
        let (after, before): (Vec<_>, Vec<_>) =
            others.into_iter().partition(|(code, _)| self.acts_after(*code));
        for (code, _) in before.iter().chain(&after) {
            block.remove(M, *code);
        }
        self.each_m(&before)?;
        self.block = block;
        self.write_block()?;
        self.each_m(&after)
    }

    /// Writes the preparatory functions of a block without words, one a block.
    fn each_alone(&mut self, block: crate::block::Block) -> Result<()> {
        for (code, cause) in block.g_codes() {
            self.block.g(*code, *cause);
            self.write_block()?;
        }
        self.each_m(block.m_codes())
    }

    fn each_m(&mut self, codes: &[(FunctionCode, Cause)]) -> Result<()> {
        for (code, cause) in codes {
            self.block.m(*code, *cause);
            self.write_block()?;
        }
        Ok(())
    }

    /// The auxiliary function that stays with the words: the one they belong to, else the
    /// last that acts before them, else the first.
    fn keeper(&self, block: &crate::block::Block, codes: &[(FunctionCode, Cause)]) -> FunctionCode {
        let addresses = &self.tables.addresses;
        let change = codes.iter().find(|(code, _)| self.changes_tool(*code));
        let changes = change.filter(|_| block.has(T, addresses));
        let turn = codes.iter().find(|(code, _)| self.codes.turns_spindle(*code));
        let turns = turn.filter(|_| block.has(S, addresses));
        let before = codes.iter().rev().find(|(code, _)| !self.acts_after(*code));
        changes.or(turns).or(before).unwrap_or(&codes[0]).0
    }

    /// True for an M code that acts when the rest of its block has been carried out.
    fn acts_after(&self, code: FunctionCode) -> bool {
        self.codes.auxiliaries(code).any(|row| row.acts == Acts::After)
    }

    /// True for a mode that can stand in a block of its own.
    fn is_mode(&self, code: FunctionCode) -> bool {
        self.codes.function(code).is_some_and(|row| row.acts == Acts::Before)
    }

    /// The offset of a compensation stands in the block of its code.
    fn move_offset(&mut self, code: FunctionCode, from: &mut crate::block::Block) {
        let begins = [Compensation::Left, Compensation::Right].map(Meaning::Compensation);
        if !begins.contains(&self.meaning(code)) {
            return;
        }
        let letter = self.commons.read(loc::CUTCOM_ADDRESS);
        if let Some(position) = letter.and_then(|at| self.tables.addresses.position(at)) {
            from.move_word(position, &mut self.block);
        }
    }
}
