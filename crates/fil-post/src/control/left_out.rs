//! Words that somebody takes out of a block of the post or changes in it, on its way to the tape
//! (INTCOM 4667 and 1920, REPLAC): the post goes on from what is left. What it can say again it
//! says with the next motion; what it can't is refused, as it would go on as if the word stood.

use fil_diag::{Diag, Result};
use fil_machine::functions::{Group, LengthOffset, Motion, Origin, SpeedMode, Spindle};
use fil_machine::letters::{F, G, H, M, N, R, S, T};
use fil_machine::locations::{self as loc, CycleReturnCodes, FixtureForm};
use fil_machine::modes::FeedMode;
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter, letters};

use super::{Control, Function};
use crate::control_state::{Compensation, Length, Meaning, Rotation, Source, modal};
use crate::errors::PostCode;

/// A word of a block.
pub(super) type Word = (Letter, f64);

/// Who has made the block that is edited.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Maker {
    /// The post, which counts on its words.
    Post,
    /// POSTN: what is left is learned as if it had said no more.
    Words,
    /// A text: the same, and none of its words was put on the tape by its value.
    Text,
}

/// What the post takes for granted of a word that an edit has taken out.
const AS_MEANT: &str = "taken to be in force by other means";

/// A block of the post before and behind the edit.
#[derive(Clone, Copy)]
pub(super) struct Edit<'w> {
    pub before: &'w [Word],
    pub after: &'w [Word],
}

impl<'w> Edit<'w> {
    /// Words that are gone: functions by their number, others by their letter.
    fn lost(self) -> impl Iterator<Item = Word> + 'w {
        let stays = move |word: &Word| match word.0 {
            G | M => self.after.contains(word),
            letter => has(self.after, letter),
        };
        self.before.iter().copied().filter(move |word| !stays(word))
    }

    /// Words that have another value, or are new: functions left out.
    fn changed(self) -> impl Iterator<Item = Word> + 'w {
        let is_new =
            move |word: &&Word| !matches!(word.0, G | M | N) && !self.before.contains(word);
        self.after.iter().filter(is_new).copied()
    }

    /// Functions that are new.
    fn put_in(self, letter: Letter) -> impl Iterator<Item = FunctionCode> + 'w {
        let new = self.after.iter().filter(move |word| !self.before.contains(word));
        functions(new, letter)
    }

    /// A function of the block as it was made.
    fn had(self, is: impl Fn(FunctionCode) -> bool) -> bool {
        functions(self.before.iter(), G).any(is)
    }
}

fn has(words: &[Word], letter: Letter) -> bool {
    words.iter().any(|word| word.0 == letter)
}

fn functions<'w>(
    words: impl Iterator<Item = &'w Word>,
    letter: Letter,
) -> impl Iterator<Item = FunctionCode> {
    words.filter(move |word| word.0 == letter).filter_map(|word| FunctionCode::of_value(word.1))
}

impl Control {
    /// Refuses a word of the post that was taken out or changed, and that it can't say again.
    ///
    /// # Errors
    /// There is one.
    pub(super) fn refuse_left_out(&mut self, edit: Edit<'_>) -> Result<()> {
        let text = |(letter, value): Word| format!("{letter}{value}");
        if let Some(word) = edit.lost().find(|word| !self.may_miss(*word, edit)) {
            let diag = PostCode::EditedWord.diag(format!(
                "{} is removed from its block, and the post would continue as if it had been output",
                text(word)
            ));
            self.doubt_edited(word, edit, diag)?;
        }
        if let Some(word) = edit.changed().find(|word| self.counts_on_value(*word, edit)) {
            let diag = PostCode::EditedWord
                .diag(format!("{} is in a block whose values the post relies on", text(word)));
            self.doubt(Source::Author, diag, AS_MEANT)?;
        }
        Ok(())
    }

    /// Doubts a block without a word. Spindle stop and coolant lead no tool through the part, and a function in place of a cycle is the shop's own.
    fn doubt_edited(&mut self, word: Word, edit: Edit<'_>, diag: Box<Diag>) -> Result<()> {
        // The last author is whoever edits the block, and no block of his own is to be shown.
        self.warnings.author = None;
        let is_mild = match (word.0, FunctionCode::of_value(word.1)) {
            (G, Some(code)) => {
                self.meaning(code) == Meaning::Cycle && edit.put_in(G).next().is_some()
            }
            (M, Some(code)) => {
                let by_sub = self.state.is(modal::MASTER_IS_SUB, true);
                let turns = self.codes.rotation(code, by_sub);
                self.codes.auxiliaries(code).all(|row| row.restorable)
                    && turns.is_none_or(|turns| turns == Rotation::Standing)
            }
            _ => false,
        };
        match is_mild {
            true => self.mild_doubt(diag, AS_MEANT),
            false => self.doubt(Source::Author, diag, AS_MEANT),
        }
    }

    /// Refuses a word that is taken out of the block, too, in which it is said again; all but the
    /// functions of coolant, which the program goes on without as it does with them.
    ///
    /// # Errors
    /// There is one.
    pub(super) fn refuse_left_out_again(&mut self, edit: Edit<'_>) -> Result<()> {
        self.are_said(edit.after);
        for word in edit.lost().filter(|word| matches!(word.0, G | M | S)) {
            let code = FunctionCode::of_value(word.1);
            let is_coolant = word.0 == M && code.is_some_and(|code| self.codes.is_coolant(code));
            let is_replaced = edit.put_in(word.0).next().is_some();
            if self.left_out.contains(&word) && !is_coolant && !is_replaced {
                let diag = PostCode::EditedWord.diag(format!(
                    "{}{} is removed from its block, and again from the block that restates it",
                    word.0, word.1
                ));
                self.doubt_edited(word, edit, diag)?;
            }
            if !self.left_out.contains(&word) {
                self.left_out.push(word);
            }
        }
        Ok(())
    }

    /// Words that stand on the tape are no longer left out.
    pub(super) fn are_said(&mut self, words: &[Word]) {
        self.left_out.retain(|word| !words.contains(word));
    }

    /// True where an edit has put functions in that may do what the post does not know of.
    pub(super) fn brings_functions(&self, edit: Edit<'_>) -> bool {
        let of_m = |code| self.changes_tool(code) || self.calls_program(code);
        edit.put_in(G).next().is_some() || edit.put_in(M).any(of_m)
    }

    /// True where S is another one, or counts otherwise.
    pub(super) fn changes_speed(&self, edit: Edit<'_>) -> bool {
        self.brings_functions(edit) || edit.changed().any(|(letter, _)| letter == S)
    }

    fn may_miss(&self, (letter, value): Word, edit: Edit<'_>) -> bool {
        match (letter, FunctionCode::of_value(value)) {
            (N, _) => true,
            (G, Some(code)) => self.may_miss_g(code, edit),
            (M, Some(code)) => self.may_miss_m(code, edit),
            (T, _) => self.only_prepares(edit),
            _ => self.may_miss_word(letter, edit),
        }
    }

    /// T names the next tool, which the block of its change names again.
    fn only_prepares(&self, edit: Edit<'_>) -> bool {
        let commons = &self.commons;
        commons.read(loc::TOOL_PRESELECT)
            && !commons.read(loc::TOOL_SEPARATE_BLOCKS)
            && !self.codes.tool_word_changes
            && !has(edit.before, M)
    }

    fn may_miss_g(&self, code: FunctionCode, edit: Edit<'_>) -> bool {
        let Some(function) = self.codes.function(code) else { return true };
        let (meaning, state) = (function.meaning, &self.state);
        let is_replaced = || edit.put_in(G).any(|new| self.meaning(new).group() == meaning.group());
        match meaning {
            Meaning::Compensation(Compensation::Off) => {
                state.is(modal::CUTTER_COMP, Compensation::Off)
            }
            Meaning::Compensation(_) => edit.put_in(G).any(|new| {
                matches!(self.meaning(new), Meaning::Compensation(side) if side != Compensation::Off)
            }),
            Meaning::Motion(Motion::Thread) => edit.put_in(G).any(|new| self.is_thread(new)),
            Meaning::Cycle | Meaning::TurningCycle | Meaning::Tcpc => is_replaced(),
            Meaning::CycleEnd => state.is(modal::CYCLE, false),
            Meaning::ReturnPlane => state.is(modal::RETURN_LEVEL, code),
            Meaning::SpeedMode(mode) => {
                state.is(modal::SURFACE_SPEED, mode == SpeedMode::SurfaceSpeed) || is_replaced()
            }
            Meaning::Dwell => {
                let stays = |word: &Word| !matches!(word.0, G | M | N) && has(edit.after, word.0);
                !edit.before.iter().any(stays)
            }
            Meaning::LengthOffset(LengthOffset::Cancel) => {
                matches!(state.length(), Length::Unsaid | Length::Taken)
                    && state.is(modal::TCP, false)
            }
            Meaning::LengthOffset(LengthOffset::Activate) => {
                is_replaced() || edit.put_in(G).any(|new| self.meaning(new) == Meaning::Tcpc)
            }
            Meaning::Origin(origin) if origin.is_of_machine() => {
                edit.put_in(G).any(|new| self.codes.goes_to_machine(new))
            }
            Meaning::Origin(origin) if origin.is_offset() => {
                let is_another = || edit.put_in(G).any(|new| self.chooses_offset(new));
                !self.names_offset(edit) || is_another()
            }
            _ => function.restorable,
        }
    }

    fn is_thread(&self, code: FunctionCode) -> bool {
        self.meaning(code) == Meaning::Motion(Motion::Thread)
    }

    /// A word beside its function chooses the work offset: G54.1 P2.
    fn names_offset(&self, edit: Edit<'_>) -> bool {
        let letter = self.commons.read(loc::FIXTURE_EXTENDED_ADDRESS);
        let is_named = letter.is_some_and(|letter| has(edit.before, letter));
        let by_word = Meaning::Origin(Origin::NumberedOffset);
        is_named && edit.had(|code| self.meaning(code) == by_word)
    }

    fn may_miss_m(&self, code: FunctionCode, edit: Edit<'_>) -> bool {
        if self.codes.ends_program(code) {
            return edit.put_in(M).any(|new| self.codes.ends_program(new));
        }
        // A function in its place is how the shop writes it.
        self.codes.auxiliaries(code).all(|row| row.restorable) || edit.put_in(M).next().is_some()
    }

    /// The block gives its words a meaning of its own, which none may be taken from.
    fn may_miss_word(&self, letter: Letter, edit: Edit<'_>) -> bool {
        let had = |group| edit.had(|code| self.meaning(code).group() == group);
        let is_of_block = [Group::WorkPlane, Group::Cycle, Group::TurningCycle, Group::SpeedLimit]
            .into_iter()
            .any(had)
            || edit.had(|code| self.is_other_frame(code))
            || letter == S && edit.had(|code| self.makes_another_speed(code))
            || self.is_fixed_beside_m(letter, edit);
        if is_of_block {
            return false;
        }
        let commons = &self.commons;
        let is_axis = self.tables.present().numbers().any(|n| self.tables.axis(n).letter == letter);
        let is_thread = edit.had(|code| self.is_thread(code));
        let is_offset_of_cutter = letter == letters::D && self.can().cutting_edges
            || commons.read(loc::CUTCOM_ADDRESS) == Some(letter)
                && edit.had(|code| matches!(self.meaning(code), Meaning::Compensation(_)));
        let is_offset = self.names_offset(edit)
            && commons.read(loc::FIXTURE_EXTENDED_ADDRESS) == Some(letter)
            || commons.read(loc::FIXTURE_FORM) == FixtureForm::Word
                && commons.read(loc::FIXTURE_ADDRESS) == Some(letter);
        let is_length = letter == H && (had(Group::LengthOffset) || had(Group::Tcpc));
        let is_limit = commons.read(loc::SPINDLE_MAX_ADDRESS) == Some(letter);
        let is_time = letter == F && self.is_inverse(edit);
        !(is_thread && !is_axis
            || is_offset_of_cutter
            || is_offset
            || is_length
            || is_limit
            || is_time)
    }

    /// S counts turns behind it and a way before it, or the other way round: the last S would be
    /// read anew.
    fn makes_another_speed(&self, code: FunctionCode) -> bool {
        match self.meaning(code) {
            Meaning::SpeedMode(mode) => {
                !self.state.is(modal::SURFACE_SPEED, mode == SpeedMode::SurfaceSpeed)
            }
            _ => false,
        }
    }

    /// F of the block is the time of its motion.
    fn is_inverse(&self, edit: Edit<'_>) -> bool {
        let modes = || {
            functions(edit.before.iter(), G).filter_map(|code| match self.meaning(code) {
                Meaning::FeedMode(mode) => Some(mode),
                _ => None,
            })
        };
        let mode = modes().last().or(self.state.get(modal::FEED_MODE));
        mode == Some(FeedMode::InverseTime)
    }

    /// A word beside M19 or M29: an angle, or the speed of a tap.
    fn is_fixed_beside_m(&self, letter: Letter, edit: Edit<'_>) -> bool {
        let had = |meaning| functions(edit.before.iter(), M).any(|m| self.codes.does(m, meaning));
        letter == S && had(Meaning::RigidTap)
            || self.commons.read(loc::SPINDLE_ORIENT_ADDRESS) == Some(letter)
                && had(Meaning::Spindle(Spindle::Orient))
    }

    /// A function of the frame that is no work offset: G53, G28, G52, G12.1.
    fn is_other_frame(&self, code: FunctionCode) -> bool {
        matches!(self.meaning(code), Meaning::Origin(origin) if !origin.is_offset())
    }

    /// True for a word whose value the post goes on from, whatever the tape says.
    fn counts_on_value(&self, (letter, value): Word, edit: Edit<'_>) -> bool {
        let had = |meaning| edit.had(|code| self.meaning(code) == meaning);
        let moves_to_machine = edit.had(|code| self.codes.goes_to_machine(code));
        let is_frame = edit.had(|code| self.is_other_frame(code)) && !moves_to_machine;
        let takes_length =
            letter == T && self.codes.tool_word_has_offset && value.rem_euclid(100.0) == 0.0;
        edit.had(|code| matches!(self.meaning(code), Meaning::WorkPlane(_)))
            || is_frame
            || takes_length
            || letter == S && self.is_fixed_beside_m(letter, edit)
            || letter == R && had(Meaning::Cycle) && !self.returns_to_initial(edit)
    }

    /// The cycle of the block returns to the level before it, not to R.
    fn returns_to_initial(&self, edit: Edit<'_>) -> bool {
        let initial = self.code_if_any(loc::CYCLE_RETURN_INITIAL_CODE);
        let is_level = |code: &FunctionCode| self.meaning(*code) == Meaning::ReturnPlane;
        let said = functions(edit.after.iter(), G).filter(is_level).last();
        self.commons.read(loc::CYCLE_RETURN_CODES) == CycleReturnCodes::Yes
            && initial.is_some()
            && said.or(self.state.get(modal::RETURN_LEVEL)) == initial
    }

    /// The control does not have what an edit has taken out: it is said again.
    pub(super) fn miss_left_out(&mut self, edit: Edit<'_>) {
        for code in edit.lost().filter(|word| word.0 == G) {
            if let Some(code) = FunctionCode::of_value(code.1) {
                self.miss_g(code, edit);
            }
        }
        let is_cycle = edit.had(|code| self.meaning(code) == Meaning::Cycle);
        if is_cycle && edit.changed().next().is_some() {
            // The next hole says all data of the cycle.
            self.state.forget(modal::CYCLE_CODE, Source::Author);
        }
        self.owe_auxiliaries(edit);
    }

    fn miss_g(&mut self, code: FunctionCode, edit: Edit<'_>) {
        let meaning = self.meaning(code);
        if functions(edit.after.iter(), G).any(|said| self.meaning(said).group() == meaning.group())
        {
            return;
        }
        let state = &mut self.state;
        match meaning {
            Meaning::Plane(_) => state.forget(modal::PLANE, Source::Author),
            Meaning::Distance(_) => state.forget(modal::DISTANCE, Source::Author),
            Meaning::Unit(_) => state.forget(modal::UNITS, Source::Author),
            Meaning::FeedMode(_) => {
                state.forget(modal::FEED_MODE, Source::Author);
                state.doubt(F);
            }
            Meaning::DiameterMode => state.forget(modal::DIAMETER_MODE, Source::Author),
            Meaning::Compensation(_) => state.forget(modal::CUTTER_COMP, Source::Author),
            Meaning::CycleEnd => state.forget(modal::CYCLE, Source::Author),
            Meaning::Origin(_) => {
                state.forget(modal::WORK_OFFSET, Source::Author);
                let cause = self.block.cause.whole();
                self.owe(Function::WorkOffset, |control| {
                    control.block.g(code, cause);
                    Ok(())
                });
            }
            _ => {}
        }
    }

    /// The next motion says the functions of spindle and coolant, and S.
    fn owe_auxiliaries(&mut self, edit: Edit<'_>) {
        let is_replaced = edit.put_in(M).next().is_some();
        let lost: Vec<Word> = edit.lost().collect();
        let codes = || functions(lost.iter(), M).filter(|_| !is_replaced);
        let by_side = self.state.is(modal::MASTER_IS_SUB, true);
        let turns = |code: &FunctionCode| {
            self.codes.rotation(*code, by_side).is_some()
                || self.codes.does(*code, Meaning::Spindle(Spindle::Default))
        };
        let turning = codes().find(turns);
        let coolant: Vec<_> = codes().filter(|code| self.codes.is_coolant(*code)).collect();
        let pauses = edit.had(|code| self.meaning(code) == Meaning::Dwell);
        let speed = lost.iter().find(|word| word.0 == S && !pauses).map(|word| word.1);
        let cause = self.block.cause.whole();
        if turning.is_some() || speed.is_some() {
            self.owe(Function::Spindle, |control| {
                turning.into_iter().for_each(|code| control.block.m(code, cause));
                speed.map_or(Ok(()), |speed| control.word_rounded(S, speed, Rounding::Rate))
            });
        }
        if !coolant.is_empty() {
            self.owe(Function::Coolant, |control| {
                coolant.into_iter().for_each(|code| control.block.m(code, cause));
                Ok(())
            });
        }
    }

    /// Has words come with the next motion, whichever it is.
    fn owe(&mut self, function: Function, put: impl FnOnce(&mut Control) -> Result<()>) {
        let block = self.block.take();
        // The value has been on its way to the tape: it fits.
        let fits = put(self).is_ok();
        let owed = std::mem::replace(&mut self.block, block);
        if fits {
            self.waiting.owe(function, owed);
        }
    }

    /// Learns from a block of the post that was edited: what was taken out of it or changed was
    /// not refused.
    pub(super) fn learn_left(&mut self, edit: Edit<'_>) {
        if self.brings_functions(edit) {
            self.state.learn_words(edit.after, &self.codes);
        } else {
            self.state.learn_own_words(edit.after, edit.before, &self.codes);
        }
    }
}
