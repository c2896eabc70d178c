//! Words that wait for a motion: spindle, coolant, cutter compensation and the
//! tool length.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::axes::AxisSet;
use fil_machine::locations::Placement;

use super::Control;
use crate::block::Block;
use crate::cause::Cause;
use crate::control_state::{Compensation, Length, modal};
use crate::errors::PostCode;
use crate::operation::SpindleTurn;

/// What words that wait command.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Function {
    /// The spindle.
    Spindle,
    /// The coolant.
    Coolant,
    /// Cutter compensation.
    Compensation,
    /// A function of the user's own.
    Auxiliary,
    /// The work offset.
    WorkOffset,
}

/// The motion that words wait for.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Due {
    Any,
    /// One that moves one of these axes.
    Along(AxisSet),
    /// Any, in a block of their own before it.
    BeforeAny,
}

/// A constant surface speed (G96) that waits for the first cut.
#[derive(Clone, Copy, Debug)]
pub struct SurfaceSpeed {
    /// What SPINDL asks for.
    pub turn: SpindleTurn,
    /// The highest speed that the same record names (MAXRPM), rev/min.
    pub limit: Option<f64>,
    /// The record.
    pub cause: Cause,
    /// The spindle turns at the rev/min of the approach (G97) already.
    pub leads_in: bool,
}

/// Words that wait for a motion.
#[derive(Clone, Debug, Default)]
pub struct Waiting {
    words: Vec<(Function, Due, Block)>,
    /// Tool length offset to be called with the next Z motion, with its cause.
    pub length_offset: Option<(i64, Cause)>,
    /// It waits since before the blocks of block delete that are open.
    length_is_outside: bool,
    /// A constant surface speed that begins with the first cut.
    pub surface_speed: Option<SurfaceSpeed>,
    /// How often words or texts had named a length when it began to wait.
    lengths_said: u32,
}

impl Waiting {
    /// True when nothing waits.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && self.length_offset.is_none()
    }

    /// Words that were taken out of their block come before the next motion, in a block of their
    /// own as they had; older ones of their function give way.
    pub(super) fn owe(&mut self, function: Function, block: Block) {
        self.put(function, Due::BeforeAny, block);
    }

    /// Keeps words; older ones of their function give way.
    fn put(&mut self, function: Function, due: Due, block: Block) {
        self.words.retain(|(waiting, ..)| *waiting != function);
        self.words.push((function, due, block));
    }

    /// True when words of this function wait.
    pub fn has(&self, function: Function) -> bool {
        self.words.iter().any(|(waiting, ..)| *waiting == function)
    }
}

fn refuse_length_across<T>() -> Result<T> {
    PostCode::SkippedPart
        .err("the tool length offset of the last tool change would be on the other side of OPSKIP")
}

impl Control {
    /// Cutter compensation ends in the next line that moves.
    pub fn compensation_ends(&self) -> bool {
        self.can().compensation_in_moves
            && self.compensation_asked() == Compensation::Off
            && self.waiting.has(Function::Compensation)
    }

    /// Has a tool length offset called with the next Z motion.
    pub(crate) fn await_length(&mut self, offset: Option<(i64, Cause)>) {
        self.waiting.length_offset = offset;
        self.waiting.length_is_outside = false;
        self.waiting.lengths_said = self.state.groups().written(modal::LENGTH_WORD);
    }

    /// Takes the tool length offset that waits, for the block under construction.
    ///
    /// # Errors
    /// Block delete would leave it out.
    pub(crate) fn take_length(&mut self) -> Result<Option<(i64, Cause)>> {
        let length = self.waiting.length_offset.take();
        match length.is_some() && self.waiting.length_is_outside {
            true => refuse_length_across(),
            false => Ok(length),
        }
    }

    /// Blocks of block delete begin or end: a length that waits since before them waits on.
    ///
    /// # Errors
    /// One of a tool change among them waits at their end.
    pub(super) fn length_waits_across(&mut self, begin: bool) -> Result<()> {
        let waits = self.waiting.length_offset.is_some();
        if !begin && waits && !self.waiting.length_is_outside {
            return refuse_length_across();
        }
        self.waiting.length_is_outside = begin && waits;
        Ok(())
    }

    /// Refuses words of others that move Z while the length of the tool waits for a motion of the
    /// post: the tip would go there by the length of the tool before, or the spindle nose.
    ///
    /// # Errors
    /// They do.
    pub(super) fn refuse_without_length(&self, words: &[(Letter, f64)]) -> Result<()> {
        let is_due = match self.state.length() {
            Length::Ended => true,
            _ => self.waiting.length_offset.is_some(),
        };
        let is_named = self.waiting.length_offset.is_some()
            && self.state.groups().written(modal::LENGTH_WORD) != self.waiting.lengths_said;
        let z = self.tables.axis(2).letter;
        let moves_z = words.iter().any(|(letter, _)| self.codes.moved_by(*letter) == z);
        if !is_due || is_named || !moves_z || !self.codes.moves_in_part(words) {
            return Ok(());
        }
        PostCode::LengthTaken.err_with(
            "a foreign block moves Z while the tool length offset waits for the next Z move",
            "Put the text after the move that activates the offset, activate it in the text (G43 H1), or move with RAPID and GOTO.",
        )
    }

    /// Writes the block under construction at once, or keeps its words for a
    /// motion to come. Words of the same function that still wait never share a
    /// block with it: those of spindle and coolant are written now, in their own
    /// block; a compensation that no motion has begun gives way.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    pub fn place_block(&mut self, function: Function, placement: Placement) -> Result<()> {
        let block = self.block.take();
        if let Some(at) = self.waiting.words.iter().position(|(old, ..)| *old == function) {
            let (_, _, old) = self.waiting.words.remove(at);
            if function == Function::Compensation {
                let message =
                    "CUTCOM: no motion in its plane came before the next CUTCOM".to_string();
                self.warnings.add(PostCode::IgnoredPart, message);
            } else {
                self.block = old;
                self.write_block()?;
            }
        }
        self.block = block;
        let due = match placement {
            Placement::BlockOfItsOwn => return self.write_block(),
            Placement::NextXyBlock => Due::Along(AxisSet::XY),
            Placement::NextZBlock => Due::Along(AxisSet::of(2)),
        };
        let block = self.block.take();
        self.waiting.put(function, due, block);
        Ok(())
    }

    /// Lets the words of a function come with the next motion, whichever axis moves.
    pub fn comes_with_any_motion(&mut self, function: Function) {
        self.comes_with(function, Due::Any);
    }

    /// Lets them come with the next motion of one of these axes.
    pub fn comes_with_motion_of(&mut self, function: Function, axes: AxisSet) {
        self.comes_with(function, Due::Along(axes));
    }

    fn comes_with(&mut self, function: Function, motion: Due) {
        let waiting = self.waiting.words.iter_mut();
        for (_, due, _) in waiting.filter(|(of, due, _)| *of == function && *due != Due::BeforeAny)
        {
            *due = motion;
        }
    }

    /// True where the motion in the block is one that words wait for; `turning` are the axes
    /// that it moves with or without a word: those of an arc, whose end may be its start.
    fn is_due(&self, due: Due, turning: AxisSet) -> bool {
        let moves = |number| turning.has(number) || self.block_has(self.tables.axis(number).letter);
        match due {
            Due::Any | Due::BeforeAny => true,
            Due::Along(axes) => axes.numbers().any(moves),
        }
    }

    /// Writes the words of one function that still wait, in a block of their own.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    pub fn flush_function(&mut self, function: Function) -> Result<()> {
        let Some(at) = self.waiting.words.iter().position(|(old, ..)| *old == function) else {
            return Ok(());
        };
        let (_, _, words) = self.waiting.words.remove(at);
        let block = std::mem::replace(&mut self.block, words);
        self.write_block()?;
        self.block = block;
        Ok(())
    }

    /// Keeps the block under construction for the next motion, beside all that waits
    /// already.
    pub fn keep_for_motion(&mut self, function: Function) {
        let block = self.block.take();
        self.waiting.words.push((function, Due::Any, block));
    }

    /// Writes the words that still wait for a motion, each in a block of its own. The end of
    /// cutter compensation waits on where it stands in lines that move.
    ///
    /// # Errors
    /// As [`Control::write_block`]; cutter compensation that only a move can begin.
    pub fn flush_waiting(&mut self) -> Result<()> {
        let in_moves = self.can().compensation_in_moves;
        if in_moves && self.waiting.has(Function::Compensation) && !self.compensation_ends() {
            return PostCode::Family
                .err("CUTCOM without a move after it: RL and RR are output in the line of a move");
        }
        let cause = self.block.cause;
        for (function, due, words) in std::mem::take(&mut self.waiting.words) {
            if in_moves && function == Function::Compensation {
                self.waiting.words.push((function, due, words));
                continue;
            }
            self.block = words;
            self.write_block()?;
        }
        self.block.cause = cause;
        Ok(())
    }

    /// Writes a work offset before the motion in the block, where that motion does not
    /// bring it along: nothing may move in the offset before. `turning` are the axes of an arc.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    pub(crate) fn work_offset_first(&mut self, turning: AxisSet) -> Result<()> {
        let due =
            self.waiting.words.iter().find(|(function, ..)| *function == Function::WorkOffset);
        match due {
            Some((_, due, _)) if !self.is_due(*due, turning) => {
                self.flush_function(Function::WorkOffset)
            }
            _ => Ok(()),
        }
    }

    /// Adds the words that wait for the motion in the block; `turning` as for a work offset.
    ///
    /// # Errors
    /// As [`Block::merge`].
    pub(crate) fn take_waiting(&mut self, turning: AxisSet) -> Result<()> {
        self.write_owed()?;
        let words = std::mem::take(&mut self.waiting.words);
        // What is due is found before words are added that a motion could be taken from.
        let (due, later): (Vec<_>, Vec<_>) = words
            .into_iter()
            .partition(|(_, due, _)| *due != Due::BeforeAny && self.is_due(*due, turning));
        for (_, _, words) in &due {
            self.block.merge(words, &self.tables.addresses)?;
        }
        self.waiting.words = later;
        Ok(())
    }

    /// Writes the words that were taken out of their blocks; taken out again, they wait on.
    fn write_owed(&mut self) -> Result<()> {
        let words = std::mem::take(&mut self.waiting.words);
        let (owed, others): (Vec<_>, Vec<_>) =
            words.into_iter().partition(|(_, due, _)| *due == Due::BeforeAny);
        self.waiting.words = others;
        for (_, _, words) in owed {
            let block = std::mem::replace(&mut self.block, words);
            self.write_block()?;
            self.block = block;
        }
        Ok(())
    }

    /// Takes away the words of a function that wait; says whether there were any.
    pub(crate) fn take_function(&mut self, function: Function) -> bool {
        let before = self.waiting.words.len();
        self.waiting.words.retain(|(waiting, ..)| *waiting != function);
        self.waiting.words.len() != before
    }
}
