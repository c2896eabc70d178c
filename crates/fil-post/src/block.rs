//! A block under construction: words by tape position. The letters G and M can
//! stand in it several times.

use fil_diag::{Diag, Result};
use fil_machine::address::{Addresses, SLOTS, TapePosition};
use fil_machine::errors::MachineCode;
use fil_machine::letters::{G, M};
use fil_machine::rounding::Rounding;
use fil_machine::{Commons, FunctionCode, Letter};

use crate::cause::Cause;
use crate::errors::PostCode;

/// The words of one block. Values are final: scaled, translated and rounded
/// by whoever puts them here, except for the rounding of the address format.
#[derive(Clone, Debug)]
pub struct Block {
    /// The cause of the words put from now on.
    pub cause: Cause,
    /// Keep the cause of each word; off by default because it costs time.
    pub noting: bool,
    present: u64,
    scaled: [i64; SLOTS],
    causes: [Cause; SLOTS],
    g: Vec<(FunctionCode, Cause)>,
    m: Vec<(FunctionCode, Cause)>,
}

impl Default for Block {
    fn default() -> Self {
        Block {
            cause: Cause::default(),
            noting: false,
            present: 0,
            scaled: [0; SLOTS],
            causes: [Cause::default(); SLOTS],
            g: Vec::new(),
            m: Vec::new(),
        }
    }
}

impl Block {
    /// Makes the block empty again.
    #[inline]
    pub fn clear(&mut self) {
        self.present = 0;
        self.g.clear();
        self.m.clear();
    }

    /// True when no word was added.
    #[inline]
    pub fn is_empty(&self) -> bool {
        self.present == 0 && self.g.is_empty() && self.m.is_empty()
    }

    /// True when it has functions.
    #[inline]
    pub fn has_functions(&self) -> bool {
        !(self.g.is_empty() && self.m.is_empty())
    }

    /// True when it has words other than functions.
    pub fn has_numbers(&self) -> bool {
        self.present != 0
    }

    /// True when the machine writes at least one of the words.
    pub fn prints(&self, addresses: &Addresses) -> bool {
        let written = |letter, codes: &[(FunctionCode, Cause)]| {
            !codes.is_empty() && addresses.position(letter).is_some()
        };
        self.present != 0 || written(G, &self.g) || written(M, &self.m)
    }

    /// The preparatory functions, each with its cause.
    #[inline]
    pub fn g_codes(&self) -> &[(FunctionCode, Cause)] {
        &self.g
    }

    /// The auxiliary functions, each with its cause.
    #[inline]
    pub fn m_codes(&self) -> &[(FunctionCode, Cause)] {
        &self.m
    }

    /// The scaled integer at a tape position.
    pub fn scaled_at(&self, position: TapePosition) -> Option<i64> {
        (self.present & position.bit() != 0).then(|| self.scaled[position.index()])
    }

    /// The cause of the word at a tape position, where causes are noted.
    pub fn cause_at(&self, position: TapePosition) -> Cause {
        self.causes[position.index()]
    }

    /// The tape positions of its words, functions left out.
    pub fn positions(&self) -> impl Iterator<Item = TapePosition> {
        TapePosition::of_set(self.present)
    }

    /// The tape positions of its words and of its functions, in tape order.
    #[inline]
    fn positions_and_functions(&self, addresses: &Addresses) -> impl Iterator<Item = TapePosition> {
        let functions = if self.has_functions() { self.of_functions(addresses) } else { 0 };
        TapePosition::of_set(self.present | functions)
    }

    /// The set of the tape positions of its functions.
    fn of_functions(&self, addresses: &Addresses) -> u64 {
        let of = |letter, codes: &[(FunctionCode, Cause)]| {
            let position = addresses.position(letter).filter(|_| !codes.is_empty());
            position.map_or(0, TapePosition::bit)
        };
        of(G, &self.g) | of(M, &self.m)
    }

    /// Its words in tape order, each with its value and its cause.
    pub fn words(&self, addresses: &Addresses) -> Vec<(Letter, f64, Cause)> {
        let mut words = Vec::new();
        for position in self.positions_and_functions(addresses) {
            let slot = addresses.slot(position);
            let Some(letter) = slot.letter else { continue };
            let codes = match letter {
                G => &self.g,
                M => &self.m,
                _ => {
                    let value = slot.format.unscale(self.scaled[position.index()]);
                    words.push((letter, value, self.causes[position.index()]));
                    continue;
                }
            };
            words.extend(codes.iter().map(|(code, cause)| (letter, code.value(), *cause)));
        }
        words
    }

    /// True when a word of this letter is in the block.
    pub fn has(&self, letter: Letter, addresses: &Addresses) -> bool {
        match letter {
            G => !self.g.is_empty(),
            M => !self.m.is_empty(),
            _ => addresses.position(letter).is_some_and(|at| self.present & at.bit() != 0),
        }
    }

    /// The value of a word that is no function.
    pub fn value(&self, letter: Letter, addresses: &Addresses) -> Option<f64> {
        let position = addresses.position(letter)?;
        let format = addresses.slot(position).format;
        self.scaled_at(position).map(|scaled| format.unscale(scaled))
    }

    /// Adds a preparatory function with its cause.
    pub fn g(&mut self, code: FunctionCode, cause: Cause) {
        add(&mut self.g, (code, cause));
    }

    /// Adds an auxiliary function with its cause.
    pub fn m(&mut self, code: FunctionCode, cause: Cause) {
        add(&mut self.m, (code, cause));
    }

    /// Adds a word, whether or not its value has changed. Gives its tape position;
    /// `None` for a function, and where the machine suppresses the letter.
    ///
    /// # Errors
    /// The machine has no such address, the value does not fit its format, or the block has
    /// another value of the letter, which would be lost.
    pub fn word(
        &mut self,
        letter: Letter,
        value: f64,
        rounding: Rounding,
        addresses: &Addresses,
    ) -> Result<Option<TapePosition>> {
        let Some(position) = addresses.required(letter)? else { return Ok(None) };
        match letter {
            G => self.g(function(letter, value)?, self.cause),
            M => self.m(function(letter, value)?, self.cause),
            _ => {
                let format = &addresses.slot(position).format;
                let scaled = rounding.scale(value, format).map_err(|diag| named(diag, letter))?;
                if self.scaled_at(position).is_some_and(|before| before != scaled) {
                    return Err(two_values(letter));
                }
                self.put(position, scaled);
                return Ok(Some(position));
            }
        }
        Ok(None)
    }

    /// Adds the words of another block, each with its cause.
    ///
    /// # Errors
    /// Both have a word of one letter with different values.
    pub fn merge(&mut self, other: &Block, addresses: &Addresses) -> Result<()> {
        let differs = |at: &TapePosition| self.scaled_at(*at) != other.scaled_at(*at);
        let shared = TapePosition::of_set(other.present & self.present);
        if let Some(letter) = shared.filter(differs).find_map(|at| addresses.slot(at).letter) {
            return Err(two_values(letter));
        }
        other.g.iter().for_each(|code| add(&mut self.g, *code));
        other.m.iter().for_each(|code| add(&mut self.m, *code));
        for position in TapePosition::of_set(other.present & !self.present) {
            self.put(position, other.scaled[position.index()]);
            self.causes[position.index()] = other.causes[position.index()];
        }
        Ok(())
    }

    /// Takes a function out.
    pub fn remove(&mut self, letter: Letter, code: FunctionCode) {
        let codes = if letter == G { &mut self.g } else { &mut self.m };
        codes.retain(|known| known.0 != code);
    }

    /// Moves a word with its cause to another block; none, where the block has none.
    pub fn move_word(&mut self, position: TapePosition, to: &mut Block) {
        if let Some(scaled) = self.scaled_at(position) {
            self.present &= !position.bit();
            to.put(position, scaled);
            to.causes[position.index()] = self.causes[position.index()];
        }
    }

    /// Adds a word whose value is already scaled to its format.
    #[inline]
    pub fn put(&mut self, position: TapePosition, scaled: i64) {
        self.scaled[position.index()] = scaled;
        self.present |= position.bit();
        if self.noting {
            self.causes[position.index()] = self.cause;
        }
    }

    /// Takes a word out.
    pub fn take_word(&mut self, position: TapePosition) {
        self.present &= !position.bit();
    }

    /// Notes the cause of a word.
    pub fn note_cause(&mut self, position: TapePosition, cause: Cause) {
        self.causes[position.index()] = cause;
    }

    /// Notes that a word repeats this word of its record.
    pub fn note_word(&mut self, position: TapePosition, word: u16) {
        self.causes[position.index()].word = word;
    }

    /// The words so far; what is put next has the same cause as before.
    pub fn take(&mut self) -> Block {
        let (cause, noting) = (self.cause, self.noting);
        std::mem::replace(self, Block { cause, noting, ..Block::default() })
    }

    /// Refuses a function that the machine can't write as it is.
    ///
    /// # Errors
    /// More digits than the address has, or a tenth where it writes whole numbers.
    #[inline]
    pub fn check_functions(&self, addresses: &Addresses) -> Result<()> {
        if self.has_functions() { self.check_each_function(addresses) } else { Ok(()) }
    }

    fn check_each_function(&self, addresses: &Addresses) -> Result<()> {
        for (letter, codes) in [(G, &self.g), (M, &self.m)] {
            if let Some(format) = addresses.format(letter).filter(|_| !codes.is_empty()) {
                codes.iter().try_for_each(|(code, _)| code.check(letter, format))?;
            }
        }
        Ok(())
    }

    /// Writes the words in tape order and remembers the last output values; notes
    /// letter, start in `out` and cause of each before it is written.
    pub fn write(
        &self,
        addresses: &Addresses,
        commons: &mut Commons,
        out: &mut Vec<u8>,
        mut note: impl FnMut(u8, usize, Cause),
    ) {
        let mut first = true;
        let mut begin = |letter: Letter, cause: Cause, out: &mut Vec<u8>| {
            if addresses.blank && !std::mem::replace(&mut first, false) {
                out.push(b' ');
            }
            note(letter.byte(), out.len(), cause);
        };
        for position in self.positions_and_functions(addresses) {
            let slot = addresses.slot(position);
            let Some(letter) = slot.letter else { continue };
            let codes = match letter {
                G => &self.g,
                M => &self.m,
                _ => {
                    let scaled = self.scaled[position.index()];
                    begin(letter, self.causes[position.index()], out);
                    slot.format.write_word(slot.character, scaled, out);
                    commons.set_last_output(letter, slot.format.unscale(scaled));
                    continue;
                }
            };
            for (code, cause) in codes {
                begin(letter, *cause, out);
                out.push(slot.character);
                code.write(&slot.format, out);
                commons.set_last_output(letter, code.value());
            }
        }
    }
}

fn add(codes: &mut Vec<(FunctionCode, Cause)>, code: (FunctionCode, Cause)) {
    if codes.iter().all(|known| known.0 != code.0) {
        codes.push(code);
    }
}

/// The function of a number.
///
/// # Errors
/// A number that no function has.
pub fn function(letter: Letter, value: f64) -> Result<FunctionCode> {
    FunctionCode::of_value(value).ok_or_else(|| {
        MachineCode::Inexact.diag(format!("{letter}{value} is not the number of a function"))
    })
}

fn two_values(letter: Letter) -> Box<Diag> {
    let mut diag = PostCode::WordForm.diag(format!("{letter} would have two values in one block"));
    diag.hint = Some("Give each of the words a letter of its own in the settings.".into());
    diag
}

/// Names the letter in a message about its value.
#[cold]
pub fn named(mut diag: Box<Diag>, letter: Letter) -> Box<Diag> {
    diag.message = format!("{letter}{}", diag.message);
    diag
}
