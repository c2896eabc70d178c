//! The address table: which letter stands where in a block and how it writes
//! its numbers. It is derived from INTCOM 1 to 211 and made anew when a
//! setting has changed.
//!
//! INTCOM 1–26 hold the tape position of the letters A–Z, 27–52 those of
//! a second set of the same letters, 53 means not used; 53–105 the character of
//! position p (52+p), 106–158 its format (105+p), 159–211 its specification (158+p).

use fil_diag::{Diag, Result};

use crate::commons::{Commons, Int, NA};
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, TapeBlank, TapeDecimalRule};
use crate::number::NumberFormat;

/// Number of tape positions, the one that means "off" included; slot 0 is free.
pub const SLOTS: usize = 54;

/// INTCOM value of a letter whose output is switched off.
pub const OFF: i32 = 53;

/// INTCOM location before that of the character of tape position 1.
pub(crate) const CHARACTERS: u32 = 52;

/// The same of the formats.
pub(crate) const FORMATS: u32 = 105;

/// The same of the specifications.
pub(crate) const SPECIFICATIONS: u32 = 158;

/// The last location of the tables of letters and tape positions.
pub(crate) const LAST_CELL: u32 = 211;

/// Where a word stands in a block, 1 to 52.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct TapePosition(u8);

impl TapePosition {
    /// The position of an INTCOM value.
    pub fn numbered(number: i32) -> Option<Self> {
        (1..OFF).contains(&number).then_some(TapePosition(number as u8))
    }

    /// Its number, as an index below [`SLOTS`].
    #[inline]
    pub fn index(self) -> usize {
        usize::from(self.0)
    }

    /// The positions of a set, lowest first: bit n is position n.
    #[inline]
    pub fn of_set(mut set: u64) -> impl Iterator<Item = TapePosition> {
        std::iter::from_fn(move || {
            let number = set.trailing_zeros() as u8;
            set &= set.wrapping_sub(1);
            (usize::from(number) < SLOTS).then_some(TapePosition(number))
        })
    }

    /// The set of this position alone.
    #[inline]
    pub fn bit(self) -> u64 {
        1 << self.0
    }
}

/// Where the words of a letter go.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Output {
    /// To this tape position.
    At(TapePosition),
    /// Nowhere: the machine's settings suppress them (INTCOM value 53).
    Off,
    /// The machine does not know the letter.
    Unknown,
}

/// What is printed at a tape position.
#[derive(Clone, Copy, Debug)]
pub struct Slot {
    /// The letter whose value stands here; `None` for a free slot.
    pub letter: Option<Letter>,
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
    /// Output of letter n.
    outputs: [Output; Letter::COUNT + 1],
    /// A blank stands between two words.
    pub blank: bool,
}

impl Default for Addresses {
    fn default() -> Self {
        Addresses { slots: Vec::new(), outputs: [Output::Unknown; Letter::COUNT + 1], blank: true }
    }
}

impl Addresses {
    /// The table the commons describe, with the formats for mm or for inches.
    pub fn from_commons(commons: &Commons, metric: bool) -> Self {
        let rule = commons.read(loc::TAPE_DECIMAL_RULE);
        let (outputs, letters) = letters_of(commons);
        let slots = (0..SLOTS).map(|slot| slot_of(commons, slot, letters[slot], metric, rule));
        let blank = commons.read(loc::TAPE_BLANK) == TapeBlank::BlankBeforeEachAddress;
        Addresses { slots: slots.collect(), outputs, blank }
    }

    /// Where the words of a letter go.
    #[inline]
    pub fn output(&self, letter: Letter) -> Output {
        self.outputs[letter.index()]
    }

    /// Tape position of a letter, `None` when it is not written.
    #[inline]
    pub fn position(&self, letter: Letter) -> Option<TapePosition> {
        match self.output(letter) {
            Output::At(position) => Some(position),
            Output::Off | Output::Unknown => None,
        }
    }

    /// Tape position of a letter; `None` when its output is switched off.
    ///
    /// # Errors
    /// The machine has no such address.
    #[inline]
    pub fn required(&self, letter: Letter) -> Result<Option<TapePosition>> {
        match self.output(letter) {
            Output::At(position) => Ok(Some(position)),
            Output::Off => Ok(None),
            Output::Unknown => Err(no_address(letter)),
        }
    }

    /// The slot at a tape position.
    #[inline]
    pub fn slot(&self, position: TapePosition) -> &Slot {
        &self.slots[position.index()]
    }

    /// Gives a letter another format; nothing for one that is not written.
    pub fn set_format(&mut self, letter: Letter, format: NumberFormat) {
        if let Some(position) = self.position(letter) {
            self.slots[position.index()].format = format;
        }
    }

    /// How a letter writes its numbers, `None` when it is not written.
    pub fn format(&self, letter: Letter) -> Option<&NumberFormat> {
        self.position(letter).map(|position| &self.slot(position).format)
    }
}

/// The error for a letter without tape position.
#[cold]
pub fn no_address(letter: Letter) -> Box<Diag> {
    MachineCode::NoAddress.diag(format!("the machine has no address {letter}"))
}

/// Where each letter goes, and which letter each tape position holds. A letter of
/// the first set wins over one of the second.
fn letters_of(commons: &Commons) -> ([Output; Letter::COUNT + 1], [Option<Letter>; SLOTS]) {
    let mut outputs = [Output::Unknown; Letter::COUNT + 1];
    let mut letters = [None; SLOTS];
    for second in [true, false] {
        for letter in Letter::all() {
            let offset = if second { Letter::COUNT as u16 } else { 0 };
            let number = commons.int(Int(u16::from(letter.number()) + offset));
            let output = match TapePosition::numbered(number) {
                Some(position) => {
                    letters[position.index()] = Some(letter);
                    Output::At(position)
                }
                None if number == OFF => Output::Off,
                None => Output::Unknown,
            };
            if !second {
                outputs[letter.index()] = output;
            }
        }
    }
    (outputs, letters)
}

fn slot_of(
    commons: &Commons,
    slot: usize,
    letter: Option<Letter>,
    metric: bool,
    rule: TapeDecimalRule,
) -> Slot {
    let at = |base: u32| commons.int(Int(base as u16 + slot as u16));
    let known = |value: i32| if value == NA { 0 } else { value };
    Slot {
        letter,
        character: printable(at(CHARACTERS)).unwrap_or(letter.map_or(b' ', Letter::byte)),
        format: NumberFormat::from_commons(
            known(at(FORMATS)),
            known(at(SPECIFICATIONS)),
            metric,
            rule,
        ),
    }
}

fn printable(code: i32) -> Option<u8> {
    u8::try_from(code).ok().filter(u8::is_ascii_graphic)
}
