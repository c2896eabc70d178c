//! Words that the next motion says whether or not the control has them, and words
//! that are left out because it has them.

use fil_diag::Result;
use fil_machine::functions::Motion;
use fil_machine::modes::FeedMode;
use fil_machine::{FunctionCode, Letter, letters};

use super::Control;
use crate::cause::Cause;
use crate::control_state::{Meaning, Source, modal};
use crate::errors::PostCode;

/// Letters of axes and F: what the next motion can say again.
const OF_A_MOTION: &[u8] = b"XYZABCUVWF";

/// Letters whose word says the same as long as nothing else does.
const STAYING: &[u8] = b"XYZABCUVWFS";

impl Control {
    /// The next motion says the words of these letters; without letters those of all
    /// axes, F and its function.
    ///
    /// # Errors
    /// A letter the machine does not write, or one that no motion has.
    pub fn say_again(&mut self, chosen: &[Letter]) -> Result<()> {
        for letter in chosen {
            self.require_letter(*letter)?;
            if *letter != letters::G && !OF_A_MOTION.contains(&letter.byte()) {
                return PostCode::WordForm.err(format!(
                    "REPEAT: {letter} is no word of a motion, so NEXT has nothing to repeat"
                ));
            }
        }
        let all = OF_A_MOTION.iter().map(|letter| Letter::of(*letter)).chain([letters::G]);
        let chosen: Vec<Letter> = if chosen.is_empty() {
            all.filter(|letter| self.tables.addresses.position(*letter).is_some()).collect()
        } else {
            chosen.to_vec()
        };
        for letter in chosen {
            match letter {
                letters::G => self.state.forget(modal::MOTION, Source::Post),
                letter => self.state.doubt(letter),
            }
        }
        Ok(())
    }

    /// The words of these that the control does not have (POSTN/NORMAL): a position, F,
    /// S or motion function that it has is left out, all else is written. Nothing is left out of
    /// a block whose functions give its words another meaning: G4 X10, G53 Z0, G91 X10, G50 S2000.
    ///
    /// # Errors
    /// A value that does not fit its address.
    pub fn without_known(
        &mut self,
        words: Vec<(Letter, f64, Cause)>,
    ) -> Result<Vec<(Letter, f64, Cause)>> {
        self.begin()?;
        let of = |kind: Letter| {
            let words = words.iter().filter(move |(letter, ..)| *letter == kind);
            words.map(|(_, value, _)| FunctionCode::of_value(*value))
        };
        let is_plain = of(letters::G).all(|code| code.is_some_and(|code| self.only_moves(code)));
        // S beside M19 or M29 is another word.
        let speed_is_one =
            of(letters::M).all(|code| code.is_some_and(|code| self.codes.turns_spindle(code)));
        if !is_plain {
            return Ok(words);
        }
        let mut kept = Vec::with_capacity(words.len());
        for word in words {
            let is_speed = word.0 == letters::S;
            if is_speed && !speed_is_one || !self.has_word(word.0, word.1)? {
                kept.push(word);
            }
        }
        Ok(kept)
    }

    /// A function of a motion beside which positions, F and S are what they are anywhere: F of a
    /// thread is its lead.
    fn only_moves(&self, code: FunctionCode) -> bool {
        matches!(self.meaning(code), Meaning::Motion(kind) if kind != Motion::Thread)
    }

    fn has_word(&self, letter: Letter, value: f64) -> Result<bool> {
        if !self.state.is(modal::CYCLE, false) {
            return Ok(false);
        }
        if letter == letters::G {
            let code = FunctionCode::of_value(value);
            let is_motion =
                code.is_some_and(|code| matches!(self.meaning(code), Meaning::Motion(_)));
            return Ok(is_motion && self.state.get(modal::MOTION) == code);
        }
        let Some(format) = self.tables.addresses.format(letter) else { return Ok(false) };
        let is_time = letter == letters::F
            && !matches!(
                self.state.get(modal::FEED_MODE),
                Some(FeedMode::PerMinute | FeedMode::PerRevolution)
            );
        // U and W of many lathes are increments of X and Z.
        if is_time || self.codes.moved_by(letter) != letter {
            return Ok(false);
        }
        if !STAYING.contains(&letter.byte()) {
            return Ok(false);
        }
        let scaled = fil_machine::rounding::Rounding::of(letter)
            .scale(value, format)
            .map_err(|diag| crate::block::named(diag, letter))?;
        Ok(self.has_value(letter, format.unscale(scaled)))
    }
}
