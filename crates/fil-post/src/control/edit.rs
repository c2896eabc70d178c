//! Blocks that someone else edits on their way to the tape: their words (INTCOM 4667)
//! and their lines (INTCOM 1920). The control learns from what is left on the tape.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::letters::{self, G, M};

use super::left_out::{Edit, Maker, Word};
use super::{Control, speed_of_others, texts};
use crate::cause::Cause;
use crate::control::needs::Act;
use crate::control_state::ForeignBlock;
use crate::errors::PostCode;

/// A word with its cause.
type CausedWord = (Letter, f64, Cause);

impl Control {
    /// Writes the block under construction where the program has not begun, someone edits
    /// blocks, or the control's blocks are no words.
    ///
    /// # Errors
    /// As [`Control::write_block`]; what the editor refuses.
    #[cold]
    #[inline(never)]
    pub(super) fn write_with_care(&mut self) -> Result<()> {
        self.begin()?;
        let style = &self.tables.style;
        let edits_words = style.edits_words;
        let edits_lines = style.edits_lines || !self.tape.replaced.is_empty();
        self.straight = !edits_words && !edits_lines && self.can().plain_words;
        if self.straight {
            return self.write_block();
        }
        if self.block.has_numbers() {
            self.require_unit()?;
        }
        self.require(Act::Block)?;
        if !self.can().edits_lines {
            return self.family().put_block(self);
        }
        if edits_words {
            let words = self.block.words(&self.tables.addresses);
            if let Some(edited) = self.edited_words(&words)? {
                return self.put_edited(&plain(&words), &edited);
            }
        }
        if self.tables.style.divides && self.is_crowded() {
            return self.write_apart();
        }
        let start = self.tape.text.len();
        self.family().put_block(self)?;
        if edits_lines && self.edit_line(start, Maker::Post)? {
            self.block.clear();
            return Ok(());
        }
        if !self.left_out.is_empty() {
            let words = plain(&self.block.words(&self.tables.addresses));
            self.are_said(&words);
        }
        self.state.learn_block(&self.block, &self.codes, &self.tables.addresses);
        self.block.clear();
        Ok(())
    }

    /// Puts a block of the post on the tape as an editor has left it.
    fn put_edited(&mut self, before: &[Word], edited: &[CausedWord]) -> Result<()> {
        let after = plain(edited);
        let edit = Edit { before, after: &after };
        self.refuse_left_out(edit)?;
        self.refuse_left_out_again(edit)?;
        self.block.clear();
        self.put_words(edited, Some(edit))?;
        self.miss_left_out(edit);
        Ok(())
    }

    /// The words as an editor leaves them; `None` where it changes nothing. Words that it
    /// adds stand where the tape order has them.
    pub(super) fn edited_words(&mut self, words: &[CausedWord]) -> Result<Option<Vec<CausedWord>>> {
        let before: Vec<(Letter, f64)> = words.iter().map(|word| (word.0, word.1)).collect();
        let mut after = before.clone();
        let Some(editor) = &mut self.tape.editor.0 else {
            self.warn_no_macro("tape.edit_macro", "_OUTPTP");
            return Ok(None);
        };
        let found = editor.words(&mut after, &self.commons)?;
        let warnings = editor.take_warnings();
        self.warnings.extend(warnings);
        if !found {
            self.warn_no_macro("tape.edit_macro", "_OUTPTP");
        }
        if after == before {
            return Ok(None);
        }
        let cause = self.block.cause.whole();
        let mut kept: Vec<CausedWord> = Vec::with_capacity(after.len());
        let mut old = words.iter().peekable();
        for (letter, value) in after {
            // Words keep their order, so the next one of this letter is the same word.
            let same = old.clone().position(|word| word.0 == letter);
            if let Some(skipped) = same {
                let word = old.nth(skipped);
                kept.push((letter, value, word.map_or(cause, |word| word.2)));
            } else {
                let place = self.place_in_tape_order(&kept, letter);
                kept.insert(place, (letter, value, cause));
            }
        }
        Ok(Some(kept))
    }

    fn place_in_tape_order(&self, words: &[CausedWord], letter: Letter) -> usize {
        let position = |letter: Letter| self.tables.addresses.position(letter);
        let later = |word: &CausedWord| position(word.0) > position(letter);
        words.iter().position(later).unwrap_or(words.len())
    }

    /// Has the last line of the tape edited; says whether it was changed. The control then
    /// learns from what is left of it.
    ///
    /// # Errors
    /// What the editor refuses, and a line that must not reach the tape.
    pub(super) fn edit_line(&mut self, start: usize, maker: Maker) -> Result<bool> {
        let replaces = !self.tape.replaced.is_empty();
        if !(replaces || self.tables.style.edits_lines) || self.tape.text.len() == start {
            return Ok(false);
        }
        let before = self.tape.last_line(start, &self.tables);
        let mut after = before.clone();
        if replaces {
            after = self.with_texts_replaced(&after);
        }
        if self.tables.style.edits_lines && !after.is_empty() {
            self.edit_by_macro(&mut after)?;
        }
        if after == before {
            return Ok(false);
        }
        if !before.contains('%') {
            texts::check(&after)?;
        }
        let [made, left] = [&before, &after].map(|line| self.read(line.clone()));
        let [of_made, mut of_left] =
            [&made, &left].map(|block| self.family().readable_words(block));
        if left.skipped && !made.skipped {
            // Nothing is left for certain.
            of_left.clear();
        }
        let edit = Edit { before: &of_made, after: &of_left };
        if maker == Maker::Post {
            self.refuse_left_out(edit)?;
            self.refuse_left_out_again(edit)?;
        }
        self.tape.replace_last_line(start, &after, &self.tables)?;
        let known = self.before_others()?;
        let brings = self.brings_functions(edit);
        match maker {
            Maker::Post => {
                self.learn_edited(&made, &left, maker);
                self.miss_left_out(edit);
            }
            Maker::Words => self.learn_edited(&made, &left, maker),
            Maker::Text => self.learn(&left),
        }
        if maker != Maker::Post || brings {
            self.doubt_changes(known)?;
        }
        Ok(true)
    }

    /// Has the macro _MCDWT edit a line.
    fn edit_by_macro(&mut self, line: &mut String) -> Result<()> {
        let Some(editor) = &mut self.tape.editor.0 else {
            self.warn_no_macro("tape.block_macro", "_MCDWT");
            return Ok(());
        };
        let found = editor.line(line, &self.commons)?;
        let warnings = editor.take_warnings();
        self.warnings.extend(warnings);
        if !found {
            self.warn_no_macro("tape.block_macro", "_MCDWT");
        }
        Ok(())
    }

    /// Learns from a line of words that was edited. Words that are the same in both are on the
    /// tape as they were made; what else the line says is in doubt.
    fn learn_edited(&mut self, before: &ForeignBlock, after: &ForeignBlock, maker: Maker) {
        let is_read = before.unread.is_none() && after.unread.is_none() && !after.skipped;
        if self.can().reads_edited_lines || !is_read {
            return self.learn(after);
        }
        let (old, new) = (&before.words, &after.words);
        let edit = Edit { before: old, after: new };
        match maker {
            Maker::Post => self.learn_left(edit),
            _ => self.state.learn_words(new, &self.codes),
        }
        if maker != Maker::Post || self.changes_speed(edit) {
            speed_of_others::learn(self, new, true);
        }
        let differs = |word: &(Letter, f64), others: &[(Letter, f64)]| !others.contains(word);
        let changed = old.iter().filter(|word| differs(word, new));
        let changed = changed.chain(new.iter().filter(|word| differs(word, old)));
        for (letter, _) in changed.filter(|(letter, _)| !matches!(*letter, G | M)) {
            self.learn_edited_word(*letter, new.iter().rev().find(|(other, _)| other == letter));
        }
    }

    /// The word of a letter is another one than the post has made, or was taken out.
    fn learn_edited_word(&mut self, letter: Letter, edited: Option<&(Letter, f64)>) {
        let is_placed = self.state.has_last(letter) && letters::XYZ.contains(&letter);
        self.state.doubt(letter);
        match edited {
            Some((_, value)) if is_placed => self.state.stand(letter, *value),
            _ => self.state.loses(letter),
        }
    }

    fn warn_no_macro(&mut self, setting: &str, name: &str) {
        let message = format!("{setting} is on, and no FIL file has a macro {name}");
        self.warnings.add(PostCode::NoEditMacro, message);
    }
}

/// Words without their causes.
pub(super) fn plain(words: &[CausedWord]) -> Vec<Word> {
    words.iter().map(|(letter, value, _)| (*letter, *value)).collect()
}
