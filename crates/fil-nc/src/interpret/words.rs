//! The words of a block, each to be taken by the function that it belongs to.

use std::ops::{Deref, Range};

use super::Fault;
use crate::dialect::{Address, Auxiliary, Dialect, Function, Group, Unreadable};
use crate::errors::NcCode;
use crate::text::{Block, Number, Word};

/// A word of the block that no function has taken yet.
#[derive(Clone, Debug)]
pub(super) struct Item {
    /// Its letter in the settings, 1 to 26.
    letter: u8,
    increment: bool,
    number: Number,
    /// Its number; a fault waits until the word is taken.
    value: Result<f64, Unreadable>,
    range: Range<usize>,
}

/// X, Y, Z and two rotary axes.
const AXES: usize = 5;

/// An axis word.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisWord {
    /// 0 to 4.
    pub(super) axis: usize,
    /// As on the tape.
    pub(super) value: f64,
    /// U, V or W.
    pub(super) increment: bool,
}

/// The axis words of a block, at most one an axis, by their axes.
#[derive(Clone, Copy, Debug)]
pub(super) struct AxisWords {
    words: [AxisWord; AXES],
    count: usize,
}

impl AxisWords {
    fn new() -> Self {
        let none = AxisWord { axis: 0, value: 0.0, increment: false };
        AxisWords { words: [none; AXES], count: 0 }
    }

    /// The axes that have a word.
    pub(super) fn named(&self) -> [bool; AXES] {
        std::array::from_fn(|axis| self.iter().any(|word| word.axis == axis))
    }

    /// Adds a word of an axis that has none yet.
    fn push(&mut self, word: AxisWord) {
        self.words[self.count] = word;
        self.count += 1;
    }
}

impl Deref for AxisWords {
    type Target = [AxisWord];

    fn deref(&self) -> &[AxisWord] {
        &self.words[..self.count]
    }
}

/// A block, sorted.
#[derive(Debug, Default)]
pub(super) struct Words {
    functions: Vec<(Function, Range<usize>)>,
    pub(super) auxiliaries: Vec<(Auxiliary, Range<usize>)>,
    items: Vec<Item>,
}

/// Number of a letter, A is 1.
pub(super) const fn letter(name: u8) -> u8 {
    name - b'A' + 1
}

impl Words {
    /// Sorts the words of a block; what was sorted before is forgotten.
    pub(super) fn read(
        &mut self,
        block: &Block,
        dialect: &Dialect,
        metric: bool,
    ) -> Result<(), Fault> {
        let words = self;
        words.functions.clear();
        words.auxiliaries.clear();
        words.items.clear();
        for word in &block.words {
            match word.letter {
                _ if word.index.is_some() => {
                    return Err(no_meaning(word.letter, &word.range, "an address with an index"));
                }
                b'G' => words.add_function(word, dialect)?,
                b'M' => words.add_auxiliary(word, dialect)?,
                _ => {}
            }
        }
        // A unit function of the block holds for its other words too.
        let metric = match words.peek(Group::Units) {
            Some(Function::Units { metric }) => metric,
            _ => metric,
        };
        for word in block.words.iter().filter(|word| !matches!(word.letter, b'N' | b'G' | b'M')) {
            words.add_item(word, dialect, metric)?;
        }
        Ok(())
    }

    /// Takes of a refused block the functions that say what numbers mean; what was sorted before
    /// is forgotten.
    pub(super) fn read_meanings(&mut self, block: &Block, dialect: &Dialect) {
        self.functions.clear();
        self.auxiliaries.clear();
        self.items.clear();
        for word in block.words.iter().filter(|word| word.letter == b'G' && word.index.is_none()) {
            // A function that the machine lacks is what the block is refused for.
            let _ = self.add_function(word, dialect);
        }
        let meanings = [Group::Units, Group::Positions, Group::Feed, Group::Plane, Group::Diameter];
        self.functions.retain(|(function, _)| meanings.contains(&function.group()));
    }

    fn add_function(&mut self, word: &Word, dialect: &Dialect) -> Result<(), Fault> {
        let tenths = (word.number.value() * 10.0).round();
        let exact = (tenths / 10.0 - word.number.value()).abs() < 1e-9;
        let function = Some(tenths as i64)
            .filter(|_| exact && word.number.digits >= 0)
            .and_then(|code| dialect.function(code))
            .ok_or_else(|| foreign('G', word))?;
        let group = function.group();
        if self.peek(group).is_some() {
            return Err(twice("two G words of one group".to_string(), &word.range));
        }
        self.functions.push((function, word.range.clone()));
        Ok(())
    }

    fn add_auxiliary(&mut self, word: &Word, dialect: &Dialect) -> Result<(), Fault> {
        if word.number.value().fract() != 0.0 || word.number.digits < 0 {
            return Err(foreign('M', word));
        }
        let auxiliary = dialect.auxiliary(word.number.value() as i64);
        if auxiliary == Auxiliary::Flow {
            return Err(foreign('M', word));
        }
        if self.auxiliaries.iter().any(|(other, _)| other.excludes(auxiliary)) {
            return Err(twice("two M words of one kind".to_string(), &word.range));
        }
        self.auxiliaries.push((auxiliary, word.range.clone()));
        Ok(())
    }

    fn add_item(&mut self, word: &Word, dialect: &Dialect, metric: bool) -> Result<(), Fault> {
        let of_calls = matches!(word.letter, b'L' | b'P').then(|| Address::plain(word.letter));
        let Some(address) = dialect.address(word.letter).copied().or(of_calls) else {
            return Err(no_meaning(
                word.letter,
                &word.range,
                "an address the machine does not have",
            ));
        };
        let goes_to_end = self.peek(Group::Once) == Some(Function::EndOfTravel);
        if word.of_travel != (goes_to_end && dialect.axis(address.letter).is_some()) {
            let what = match word.of_travel {
                true => "the end of the travel, which goes with G16 H0",
                false => "a position of the machine in numbers, which no setting places",
            };
            return Err(no_meaning(word.letter, &word.range, what));
        }
        let item = Item {
            letter: address.letter,
            increment: address.increment,
            number: word.number,
            value: match word.of_travel {
                true => Ok(0.0),
                false => address.value(word.number, metric),
            },
            range: word.range.clone(),
        };
        let same = |other: &Item| (other.letter, other.increment) == (item.letter, item.increment);
        if self.items.iter().any(same) {
            return Err(twice(format!("two words of {}", char::from(word.letter)), &word.range));
        }
        self.items.push(item);
        Ok(())
    }

    /// Takes the function of a group.
    pub(super) fn function(&mut self, group: Group) -> Option<Function> {
        let at = self.functions.iter().position(|(function, _)| function.group() == group)?;
        Some(self.functions.swap_remove(at).0)
    }

    /// The functions that nothing has taken, and where they stand.
    pub(super) fn functions(&self) -> impl Iterator<Item = (Function, &Range<usize>)> {
        self.functions.iter().map(|(function, range)| (*function, range))
    }

    /// Looks at the function of a group.
    pub(super) fn peek(&self, group: Group) -> Option<Function> {
        self.functions.iter().map(|(function, _)| *function).find(|f| f.group() == group)
    }

    /// Takes the word of a letter (1 to 26).
    pub(super) fn take(&mut self, letter: u8) -> Result<Option<f64>, Fault> {
        match self.take_number(letter) {
            Some(item) => item.read().map(Some),
            None => Ok(None),
        }
    }

    /// Takes a whole number at or above zero.
    pub(super) fn take_whole(&mut self, letter: u8) -> Result<Option<u32>, Fault> {
        let Some(item) = self.take_number(letter) else { return Ok(None) };
        let value = item.read()?;
        if value.fract() != 0.0 || !(0.0..=4e9).contains(&value) {
            let message = format!("{value} is no whole number");
            return Err(Fault::new(NcCode::BadNumber, message).at(&item.range));
        }
        Ok(Some(value as u32))
    }

    /// Takes a number without decimals as it is written, whatever the format of the
    /// address.
    pub(super) fn take_plain(&mut self, letter: u8) -> Result<Option<u32>, Fault> {
        let Some(item) = self.take_number(letter) else { return Ok(None) };
        let plain = Some(item.number.digits).filter(|_| item.number.decimals == 0);
        let plain = plain.and_then(|digits| u32::try_from(digits).ok());
        let wrong = || Fault::new(NcCode::BadNumber, "a whole number is needed").at(&item.range);
        plain.map(Some).ok_or_else(wrong)
    }

    /// Takes a word as it is written.
    pub(super) fn take_number(&mut self, letter: u8) -> Option<Item> {
        let at = self.items.iter().position(|item| item.letter == letter && !item.increment)?;
        Some(self.items.swap_remove(at))
    }

    /// True when a word of this letter is left.
    pub(super) fn has(&self, letter: u8) -> bool {
        self.items.iter().any(|item| item.letter == letter)
    }

    /// True when an axis word is left.
    pub(super) fn has_axes(&self, dialect: &Dialect) -> bool {
        self.first_axis(dialect).is_some()
    }

    /// True when an axis word is left that is no increment by its letter.
    pub(super) fn has_plain_axes(&self, dialect: &Dialect) -> bool {
        let plain = |item: &Item| !item.increment && dialect.axis(item.letter).is_some();
        self.items.iter().any(plain)
    }

    /// True when a word of a rotary axis is left.
    pub(super) fn has_rotary(&self, dialect: &Dialect) -> bool {
        self.items.iter().any(|item| dialect.axis(item.letter).is_some_and(|axis| axis > 2))
    }

    /// Where the first axis word stands that is left.
    pub(super) fn first_axis(&self, dialect: &Dialect) -> Option<&Range<usize>> {
        let axis = self.items.iter().find(|item| dialect.axis(item.letter).is_some());
        axis.map(|item| &item.range)
    }

    /// Where the first word of a letter stands that is left.
    pub(super) fn range_of(&self, letter: u8) -> Option<&Range<usize>> {
        self.items.iter().find(|item| item.letter == letter).map(|item| &item.range)
    }

    /// Takes all axis words.
    pub(super) fn take_axes(&mut self, dialect: &Dialect) -> Result<AxisWords, Fault> {
        let mut axes = AxisWords::new();
        for item in &self.items {
            let Some(axis) = dialect.axis(item.letter) else { continue };
            if axes.iter().any(|word| word.axis == axis) {
                return Err(twice("two words of one axis".to_string(), &item.range));
            }
            axes.push(AxisWord { axis, value: item.read()?, increment: item.increment });
        }
        if !axes.is_empty() {
            self.items.retain(|item| dialect.axis(item.letter).is_none());
        }
        let count = axes.count;
        axes.words[..count].sort_by_key(|word| word.axis);
        Ok(axes)
    }

    /// Refuses what nothing has taken.
    pub(super) fn finish(&self) -> Result<(), Fault> {
        if let Some(item) = self.items.first() {
            return Err(no_meaning(b'A' + item.letter - 1, &item.range, "nothing takes it"));
        }
        match self.functions.first() {
            Some((_, range)) => {
                Err(Fault::new(NcCode::NoMeaning, "this function has nothing to act on").at(range))
            }
            None => Ok(()),
        }
    }
}

impl Item {
    /// Its value.
    pub(super) fn read(&self) -> Result<f64, Fault> {
        self.value.map_err(|why| {
            let message = match why {
                Unreadable::NoPoint => {
                    "without its point this can be millimetres or smallest steps"
                }
                Unreadable::NoZeros => "its zeros are dropped on both sides",
                Unreadable::Point => {
                    "the machine writes it in whole numbers; with a point controls take it for \
                     seconds or millimetres, or refuse it"
                }
            };
            Fault::new(NcCode::BadNumber, message).at(&self.range)
        })
    }

    /// A length in mm that may stand as a whole number of smallest steps.
    pub(super) fn steps(&self, inch: f64) -> f64 {
        let step = if inch == 1.0 { 1e-3 } else { 1e-4 };
        let unit = if self.number.point { 1.0 } else { step };
        self.number.value() * unit * inch
    }
}

fn foreign(letter: char, word: &Word) -> Fault {
    let message = format!("the machine has no {letter}{}", word.number.value());
    Fault::new(NcCode::ForeignCode, message).at(&word.range)
}

fn twice(message: String, range: &Range<usize>) -> Fault {
    Fault::new(NcCode::Twice, message).at(range)
}

fn no_meaning(letter: u8, range: &Range<usize>, why: &str) -> Fault {
    Fault::new(NcCode::NoMeaning, format!("{}: {why}", char::from(letter))).at(range)
}
