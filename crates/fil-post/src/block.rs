//! A block under construction: words by tape position.

use crate::address::{Addresses, Output, SLOTS, Slot, character, letter};
use crate::cause::Cause;
use crate::commons::Commons;
use crate::errors::PostCode;
use crate::word_text::WordText;
use fil_diag::Diag;

/// The letters that can stand several times in a block.
const G: u8 = letter(b'G');
const M: u8 = letter(b'M');

/// The words of one block. Values are final: scaled, translated and rounded
/// by whoever puts them here, except for the rounding of the address format.
#[derive(Clone, Debug)]
pub struct Block {
    /// What the words put from now on are due to.
    pub cause: Cause,
    /// Keep what each word is due to; off by default because it costs time.
    pub noting: bool,
    present: u64,
    scaled: [i64; SLOTS],
    causes: [Cause; SLOTS],
    g: Vec<(i32, Cause)>,
    m: Vec<(i32, Cause)>,
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
    pub fn clear(&mut self) {
        self.present = 0;
        self.g.clear();
        self.m.clear();
    }

    /// True when no word was added.
    pub fn is_empty(&self) -> bool {
        self.present == 0 && self.g.is_empty() && self.m.is_empty()
    }

    /// True when the machine writes at least one of the words.
    pub fn prints(&self, addresses: &Addresses) -> bool {
        let written = |letter, codes: &[(i32, Cause)]| {
            !codes.is_empty() && addresses.position(letter).is_some()
        };
        self.present != 0 || written(G, &self.g) || written(M, &self.m)
    }

    /// True when a word of this letter is in the block.
    pub fn has(&self, letter: u8, addresses: &Addresses) -> bool {
        match letter {
            G => !self.g.is_empty(),
            M => !self.m.is_empty(),
            _ => addresses.position(letter).is_some_and(|slot| self.present & (1 << slot) != 0),
        }
    }

    /// Adds a preparatory function.
    pub fn g(&mut self, code: i32) {
        add(&mut self.g, (code, self.cause));
    }

    /// Adds a preparatory function that is due to the record as a whole.
    pub fn g_of_record(&mut self, code: i32) {
        add(&mut self.g, (code, self.cause.whole()));
    }

    /// Adds a preparatory function with what it is due to.
    pub fn g_due_to(&mut self, code: i32, cause: Cause) {
        add(&mut self.g, (code, cause));
    }

    /// Adds an auxiliary function.
    pub fn m(&mut self, code: i32) {
        add(&mut self.m, (code, self.cause));
    }

    /// Adds a word, whether or not its value has changed.
    ///
    /// # Errors
    /// The machine has no such address, or the value does not fit its format.
    pub fn word(&mut self, letter: u8, value: f64, addresses: &Addresses) -> Result<(), Box<Diag>> {
        let position = match addresses.output(letter) {
            Output::At(position) => position,
            Output::Off => return Ok(()),
            Output::Unknown => return Err(no_address(letter)),
        };
        let scaled =
            addresses.slot(position).format.scale(value).map_err(|diag| name(diag, letter))?;
        match letter {
            G => self.g(scaled as i32),
            M => self.m(scaled as i32),
            _ => self.put(position, scaled),
        }
        Ok(())
    }

    /// Adds a word unless the address already stands at that value; gives its
    /// tape position when it was added.
    ///
    /// # Errors
    /// As [`Block::word`].
    pub fn modal(
        &mut self,
        letter: u8,
        value: f64,
        addresses: &Addresses,
        commons: &Commons,
    ) -> Result<Option<u8>, Box<Diag>> {
        let position = match addresses.output(letter) {
            Output::At(position) => position,
            Output::Off => return Ok(None),
            Output::Unknown => return Err(no_address(letter)),
        };
        let format = &addresses.slot(position).format;
        let scaled = format.scale(value).map_err(|diag| name(diag, letter))?;
        let due = format.unscale(scaled) != commons.last_output(letter);
        if due {
            self.put(position, scaled);
        }
        Ok(due.then_some(position))
    }

    /// Adds the words of another block, each with its cause; a word of the same
    /// address is kept.
    pub fn merge(&mut self, other: &Block) {
        other.g.iter().for_each(|code| add(&mut self.g, *code));
        other.m.iter().for_each(|code| add(&mut self.m, *code));
        let mut slots = other.present & !self.present;
        while slots != 0 {
            let position = slots.trailing_zeros() as u8;
            slots &= slots - 1;
            self.put(position, other.scaled[position as usize]);
            self.causes[position as usize] = other.causes[position as usize];
        }
    }

    /// Adds a word whose value is already scaled to its format.
    pub fn put(&mut self, position: u8, scaled: i64) {
        self.scaled[position as usize] = scaled;
        self.present |= 1 << position;
        if self.noting {
            self.causes[position as usize] = self.cause;
        }
    }

    /// Notes what a word is due to.
    pub fn note_cause(&mut self, position: u8, cause: Cause) {
        self.causes[position as usize] = cause;
    }

    /// Notes that a word repeats this word of its record.
    pub fn note_word(&mut self, position: u8, word: u16) {
        self.causes[position as usize].word = word;
    }

    /// The words so far; what is put next is due to the same as before.
    pub fn take(&mut self) -> Block {
        let (cause, noting) = (self.cause, self.noting);
        std::mem::replace(self, Block { cause, noting, ..Block::default() })
    }

    /// Writes the words in tape order and remembers the last output values; notes
    /// letter, place in `out` and cause of each before it is written.
    pub fn write(
        &self,
        addresses: &Addresses,
        commons: &mut Commons,
        out: &mut Vec<u8>,
        mut note: impl FnMut(u8, usize, Cause),
    ) {
        let mut first = true;
        let mut write = |slot: &Slot, scaled: i64, cause: Cause| {
            let mut text = WordText::new();
            slot.format.put(scaled, &mut text);
            text.put(slot.character);
            let blank = addresses.blank && !std::mem::replace(&mut first, false);
            note(character(slot.letter), out.len() + usize::from(blank), cause);
            if blank {
                text.put(b' ');
            }
            text.append_to(out);
        };
        let mut slots = self.present;
        for (letter, codes) in [(G, &self.g), (M, &self.m)] {
            if let (Some(position), true) = (addresses.position(letter), !codes.is_empty()) {
                slots |= 1 << position;
            }
        }
        while slots != 0 {
            let position = slots.trailing_zeros() as u8;
            slots &= slots - 1;
            let slot = addresses.slot(position);
            let codes = match slot.letter {
                G => &self.g,
                M => &self.m,
                _ => {
                    let scaled = self.scaled[position as usize];
                    write(slot, scaled, self.causes[position as usize]);
                    commons.set_last_output(slot.letter, slot.format.unscale(scaled));
                    continue;
                }
            };
            for (code, cause) in codes {
                write(slot, i64::from(*code), *cause);
                commons.set_last_output(slot.letter, f64::from(*code));
            }
        }
    }
}

fn add(codes: &mut Vec<(i32, Cause)>, code: (i32, Cause)) {
    if codes.iter().all(|known| known.0 != code.0) {
        codes.push(code);
    }
}

/// The error for a letter without tape position.
pub fn no_address(letter: u8) -> Box<Diag> {
    let character = char::from(b'A' + letter.clamp(1, 26) - 1);
    Box::new(Diag::new(PostCode::NoAddress, format!("the machine has no address {character}")))
}

fn name(mut diag: Box<Diag>, letter: u8) -> Box<Diag> {
    diag.message = format!("{}{}", char::from(b'A' + letter - 1), diag.message);
    diag
}
