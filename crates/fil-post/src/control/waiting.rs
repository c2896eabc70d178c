//! Words that wait for a motion: spindle, coolant, cutter compensation and the
//! tool length.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{ControlFamily, Placement};

use super::Control;
use crate::block::Block;
use crate::cause::Cause;
use crate::errors::PostCode;

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
    Xy,
    Z,
}

/// Words that wait for a motion.
#[derive(Clone, Debug, Default)]
pub struct Waiting {
    words: Vec<(Function, Due, Block)>,
    /// Tool length offset to be called with the next Z motion, with its cause.
    pub length_offset: Option<(i64, Cause)>,
}

impl Waiting {
    /// True when nothing waits.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.words.is_empty() && self.length_offset.is_none()
    }

    /// True when words of this function wait.
    pub fn has(&self, function: Function) -> bool {
        self.words.iter().any(|(waiting, ..)| *waiting == function)
    }
}

impl Control {
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
                let message = "CUTCOM: no motion came before the next CUTCOM".to_string();
                self.warnings.add(PostCode::IgnoredPart, message);
            } else {
                self.block = old;
                self.write_block()?;
            }
        }
        self.block = block;
        let due = match placement {
            Placement::BlockOfItsOwn => return self.write_block(),
            Placement::NextXyBlock => Due::Xy,
            Placement::NextZBlock => Due::Z,
        };
        let block = self.block.take();
        self.waiting.words.push((function, due, block));
        Ok(())
    }

    /// Lets the words of a function come with the next motion, whichever axis moves.
    pub fn comes_with_any_motion(&mut self, function: Function) {
        for (_, due, _) in self.waiting.words.iter_mut().filter(|(of, ..)| *of == function) {
            *due = Due::Any;
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

    /// Writes the words that still wait for a motion, each in a block of its own.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    pub fn flush_waiting(&mut self) -> Result<()> {
        if self.tables.family == ControlFamily::Klartext {
            super::klartext::motion::refuse_unbegun(self)?;
        }
        let cause = self.block.cause;
        for (_, _, words) in std::mem::take(&mut self.waiting.words) {
            self.block = words;
            self.write_block()?;
        }
        self.block.cause = cause;
        Ok(())
    }

    /// Writes a work offset before the motion in the block, where that motion does not
    /// bring it along: nothing may move in the offset before.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    pub(crate) fn work_offset_first(&mut self, turning: AxisSet) -> Result<()> {
        let due =
            self.waiting.words.iter().find(|(function, ..)| *function == Function::WorkOffset);
        let Some((_, due, _)) = due else { return Ok(()) };
        let moves = |number| turning.has(number) || self.block_has(self.tables.axis(number).letter);
        let comes_along = match due {
            Due::Any => true,
            Due::Xy => moves(0) || moves(1),
            Due::Z => moves(2),
        };
        if comes_along { Ok(()) } else { self.flush_function(Function::WorkOffset) }
    }

    /// Adds the words that wait for the motion in the block; `turning` are the axes that
    /// it moves with or without a word: those of an arc, whose end may be its start.
    pub(crate) fn take_waiting(&mut self, turning: AxisSet) {
        let moves = |control: &Control, number| {
            turning.has(number) || control.block_has(control.tables.axis(number).letter)
        };
        let moves_xy = moves(self, 0) || moves(self, 1);
        let moves_z = moves(self, 2);
        let mut words = std::mem::take(&mut self.waiting.words);
        words.retain(|(_, due, words)| {
            let due = match due {
                Due::Any => true,
                Due::Xy => moves_xy,
                Due::Z => moves_z,
            };
            if due {
                self.block.merge(words);
            }
            !due
        });
        self.waiting.words = words;
    }

    /// Takes away the words of a function that wait; says whether there were any.
    pub(crate) fn take_function(&mut self, function: Function) -> bool {
        let before = self.waiting.words.len();
        self.waiting.words.retain(|(waiting, ..)| *waiting != function);
        self.waiting.words.len() != before
    }
}
