//! A block under construction: words by tape position.

use crate::address::{Addresses, Output, SLOTS, letter};
use crate::commons::Commons;
use crate::errors::PostCode;
use fil_diag::Diag;

/// The letters that can stand several times in a block.
const G: u8 = letter(b'G');
const M: u8 = letter(b'M');

/// The words of one block. Values are final: scaled, translated and rounded
/// by whoever puts them here, except for the rounding of the address format.
#[derive(Clone, Debug)]
pub struct Block {
    present: u64,
    scaled: [i64; SLOTS],
    g: Vec<i32>,
    m: Vec<i32>,
}

impl Default for Block {
    fn default() -> Self {
        Block { present: 0, scaled: [0; SLOTS], g: Vec::new(), m: Vec::new() }
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
        let written =
            |letter, codes: &[i32]| !codes.is_empty() && addresses.position(letter).is_some();
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
        add(&mut self.g, code);
    }

    /// Adds an auxiliary function.
    pub fn m(&mut self, code: i32) {
        add(&mut self.m, code);
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

    /// Adds a word unless the address already stands at that value.
    ///
    /// # Errors
    /// As [`Block::word`].
    pub fn modal(
        &mut self,
        letter: u8,
        value: f64,
        addresses: &Addresses,
        commons: &Commons,
    ) -> Result<(), Box<Diag>> {
        let position = match addresses.output(letter) {
            Output::At(position) => position,
            Output::Off => return Ok(()),
            Output::Unknown => return Err(no_address(letter)),
        };
        let format = &addresses.slot(position).format;
        let scaled = format.scale(value).map_err(|diag| name(diag, letter))?;
        if format.unscale(scaled) != commons.last_output(letter) {
            self.put(position, scaled);
        }
        Ok(())
    }

    /// Adds the words of another block; a word of the same address is kept.
    pub fn merge(&mut self, other: &Block) {
        other.g.iter().for_each(|code| self.g(*code));
        other.m.iter().for_each(|code| self.m(*code));
        let mut slots = other.present & !self.present;
        while slots != 0 {
            let position = slots.trailing_zeros() as u8;
            slots &= slots - 1;
            self.put(position, other.scaled[position as usize]);
        }
    }

    /// Adds a word whose value is already scaled to its format.
    pub fn put(&mut self, position: u8, scaled: i64) {
        self.scaled[position as usize] = scaled;
        self.present |= 1 << position;
    }

    /// Writes the words in tape order and remembers the last output values.
    pub fn write(&self, addresses: &Addresses, commons: &mut Commons, out: &mut Vec<u8>) {
        let mut first = true;
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
                    separate(&mut first, addresses.blank, out);
                    out.push(slot.character);
                    let scaled = self.scaled[position as usize];
                    slot.format.write(scaled, out);
                    commons.set_last_output(slot.letter, slot.format.unscale(scaled));
                    continue;
                }
            };
            for code in codes {
                separate(&mut first, addresses.blank, out);
                out.push(slot.character);
                slot.format.write(i64::from(*code), out);
                commons.set_last_output(slot.letter, f64::from(*code));
            }
        }
    }
}

fn add(codes: &mut Vec<i32>, code: i32) {
    if !codes.contains(&code) {
        codes.push(code);
    }
}

fn separate(first: &mut bool, blank: bool, out: &mut Vec<u8>) {
    if !*first && blank {
        out.push(b' ');
    }
    *first = false;
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
