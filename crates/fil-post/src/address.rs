//! The address table: which letter stands where in a block and how it writes
//! its numbers. It is derived from INTCOM 1 to 211 and made anew when a
//! setting has changed.
//!
//! INTCOM 1–26 hold the tape position (slot) of the letters A–Z, 27–52 those of
//! a second set of the same letters, 53 means not used; 53–105 the character of
//! slot p (52+p), 106–158 its format (105+p), 159–211 its specification (158+p).

use crate::commons::{Commons, Int, NA};
use crate::number::{DecimalRule, NumberFormat};

/// Slots are 1 to 52; 53 stands for "no address".
pub const SLOTS: usize = 53;

/// Tape position of an address whose output is switched off.
const OFF: u8 = 53;

/// Where the words of a letter go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// To this tape position.
    At(u8),
    /// Nowhere: the machine's settings suppress them (tape position 53).
    Off,
    /// The machine does not know the letter.
    Unknown,
}

/// Number of a letter, A = 1 … Z = 26.
pub const fn letter(character: u8) -> u8 {
    character - b'A' + 1
}

/// The letter of a number, `A` to `Z`.
pub const fn character(letter: u8) -> u8 {
    letter + b'A' - 1
}

/// What is printed at a tape position.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// The letter whose value stands here, 1 to 26; 0 for a free slot.
    pub letter: u8,
    /// The printed character.
    pub character: u8,
    /// How its numbers are written.
    pub format: NumberFormat,
}

/// The table.
#[derive(Clone, Debug)]
pub struct Addresses {
    /// Slots by tape position.
    slots: Vec<Slot>,
    /// Tape position of letter n; 0 when the machine has no such address,
    /// [`OFF`] when its output is switched off.
    positions: [u8; 27],
    /// A blank stands between two words.
    pub blank: bool,
    generation: Option<(u32, bool)>,
}

impl Default for Addresses {
    fn default() -> Self {
        Addresses { slots: Vec::new(), positions: [0; 27], blank: true, generation: None }
    }
}

impl Addresses {
    /// Brings the table up to date with the commons.
    pub fn refresh(&mut self, commons: &Commons, metric: bool) {
        let generation = Some((commons.generation(), metric));
        if self.generation != generation {
            *self = Self::from_commons(commons, metric);
            self.generation = generation;
        }
    }

    fn from_commons(commons: &Commons, metric: bool) -> Self {
        let rule = match commons.int(crate::locations::TAPE_DECIMAL_RULE) {
            1 => DecimalRule::WhenNeeded,
            2 => DecimalRule::OneZero,
            _ => DecimalRule::Always,
        };
        let mut positions = [0; 27];
        let mut letters = [0u8; SLOTS];
        for index in (1..=52u16).rev() {
            let slot = commons.int(Int(index));
            if (1..=SLOTS as i32).contains(&slot) {
                let letter = ((index - 1) % 26 + 1) as u8;
                if index <= 26 {
                    positions[letter as usize] = slot as u8;
                }
                if slot as u8 != OFF {
                    letters[slot as usize] = letter;
                }
            }
        }
        let slots = (0..SLOTS)
            .map(|slot| {
                let at = |base: u16| commons.int(Int(base + slot as u16));
                let (format, spec) = (at(105), at(158));
                let known = |value: i32| if value == NA { 0 } else { value };
                let own = if letters[slot] == 0 { b' ' } else { b'A' + letters[slot] - 1 };
                Slot {
                    letter: letters[slot],
                    character: printable(at(52)).unwrap_or(own),
                    format: NumberFormat::from_commons(known(format), known(spec), metric, rule),
                }
            })
            .collect();
        let blank = commons.int(crate::locations::TAPE_BLANK) == 2;
        Addresses { slots, positions, blank, generation: None }
    }

    /// Where the words of a letter go.
    pub fn output(&self, letter: u8) -> Output {
        match self.positions.get(letter as usize) {
            None | Some(0) => Output::Unknown,
            Some(&OFF) => Output::Off,
            Some(&position) => Output::At(position),
        }
    }

    /// Tape position of a letter, `None` when it is not written.
    pub fn position(&self, letter: u8) -> Option<u8> {
        match self.output(letter) {
            Output::At(position) => Some(position),
            Output::Off | Output::Unknown => None,
        }
    }

    /// The slot at a tape position.
    pub fn slot(&self, position: u8) -> &Slot {
        &self.slots[position as usize]
    }
}

fn printable(code: i32) -> Option<u8> {
    u8::try_from(code).ok().filter(u8::is_ascii_graphic)
}
