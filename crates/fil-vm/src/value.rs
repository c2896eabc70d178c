//! The value of a FIL name: a number or a text, and the arena of texts.

use std::fmt;

use fil_cl::WordId;

/// The EMPTY value as a number, as commons and comparisons have it: "nothing here".
pub const EMPTY: f64 = 999_999.0;

/// A text in the [`Texts`] arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextId(u32);

/// What a name holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number; always finite.
    Number(f64),
    /// A text.
    Text(TextId),
    /// A word of a record. It compares as its code, and is no quantity.
    Word(WordId),
    /// EMPTY: nothing here. It compares as 999999, and is no quantity.
    Empty,
    /// A name that was never set. It is read as EMPTY, with a warning, so it
    /// is kept apart from a name that was set to EMPTY on purpose.
    Unset,
}

impl Value {
    /// The value of a number of the post, where 999999 is EMPTY.
    pub(crate) fn of(number: f64) -> Self {
        if number == EMPTY { Value::Empty } else { Value::Number(number) }
    }
}

/// A value as registers and arrays keep it, in 8 bytes: a number as it is, all
/// else as a NaN, which no number of FIL is.
///
/// Arithmetic on a NaN gives a NaN. So the machine computes first, and a result
/// that is finite says that the operands were numbers too.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct Slot(u64);

impl Slot {
    /// A name that was never set.
    pub const UNSET: Slot = Slot(0x7FF8_0001_0000_0000);

    /// EMPTY.
    const EMPTY: Slot = Slot(0x7FF8_0003_0000_0000);

    /// Upper half of a text; the lower half is its id.
    const TEXT: u64 = 0x7FF8_0002;

    /// Upper half of a word; the lower half is its id.
    const WORD: u64 = 0x7FF8_0004;

    /// The number; a NaN where there is none.
    #[inline]
    pub fn number(self) -> f64 {
        f64::from_bits(self.0)
    }

    /// What it holds.
    #[inline]
    pub fn value(self) -> Value {
        match self {
            Slot::UNSET => Value::Unset,
            Slot::EMPTY => Value::Empty,
            Slot(bits) if bits >> 32 == Slot::WORD => Value::Word(WordId::from_index(bits as u32)),
            Slot(bits) if bits >> 32 == Slot::TEXT => Value::Text(TextId(bits as u32)),
            _ => Value::Number(self.number()),
        }
    }
}

impl From<f64> for Slot {
    #[inline]
    fn from(number: f64) -> Self {
        Slot(number.to_bits())
    }
}

impl From<Value> for Slot {
    #[inline]
    fn from(value: Value) -> Self {
        match value {
            Value::Number(number) => Slot::from(number),
            Value::Text(id) => Slot(Slot::TEXT << 32 | u64::from(id.0)),
            Value::Word(id) => Slot(Slot::WORD << 32 | id.index() as u64),
            Value::Empty => Slot::EMPTY,
            Value::Unset => Slot::UNSET,
        }
    }
}

/// All texts a machine holds, one after the other in one buffer.
///
/// Texts are never changed. [`Texts::keep`] drops those no register refers to,
/// so a long run does not grow.
#[derive(Clone, Debug, Default)]
pub struct Texts {
    bytes: String,
    ends: Vec<u32>,
}

/// The arena would grow past its limit.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextsFull;

impl Texts {
    /// Adds a text; refused when the arena would hold more than `limit` bytes.
    pub fn add(&mut self, text: &str, limit: usize) -> Result<TextId, TextsFull> {
        // The table of ends is counted too, or empty texts would be free.
        let cost = self.size() + text.len() + size_of::<u32>();
        if cost > limit || u32::try_from(cost).is_err() {
            return Err(TextsFull);
        }
        self.bytes.push_str(text);
        self.ends.push(self.bytes.len() as u32);
        Ok(TextId(self.ends.len() as u32 - 1))
    }

    /// The text of an id.
    pub fn get(&self, id: TextId) -> &str {
        let index = id.0 as usize;
        let start = if index == 0 { 0 } else { self.ends[index - 1] as usize };
        &self.bytes[start..self.ends[index] as usize]
    }

    /// Bytes in use.
    pub fn size(&self) -> usize {
        self.bytes.len() + self.ends.len() * size_of::<u32>()
    }

    /// Keeps only the texts the given values refer to and renames these.
    pub(crate) fn keep<'a>(&mut self, live: impl Iterator<Item = &'a mut Slot>) {
        let old = std::mem::take(self);
        let mut renamed = vec![None; old.ends.len()];
        for slot in live {
            if let Value::Text(id) = slot.value() {
                let kept = *renamed[id.0 as usize].get_or_insert_with(|| {
                    self.bytes.push_str(old.get(id));
                    self.ends.push(self.bytes.len() as u32);
                    TextId(self.ends.len() as u32 - 1)
                });
                *slot = Value::Text(kept).into();
            }
        }
    }
}

/// A number as FIL texts and messages show it: shortest form, EMPTY by name.
pub struct Shown(pub f64);

impl fmt::Display for Shown {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        // Adding 0 makes a -0 plain.
        if self.0 == EMPTY { f.write_str("EMPTY") } else { write!(f, "{}", self.0 + 0.0) }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slot_gives_back_what_it_was_made_of() {
        assert_eq!(size_of::<Slot>(), 8);
        let numbers = [0.0, -0.0, EMPTY, f64::MIN_POSITIVE, f64::MAX, f64::MIN];
        for number in numbers {
            let slot = Slot::from(Value::Number(number));
            assert_eq!(slot, Slot::from(number));
            assert_eq!(slot.value(), Value::Number(number));
            assert_eq!(slot.number().to_bits(), number.to_bits());
        }
        let ids = [0, 1, u32::MAX];
        let words = ids.map(|index| Value::Word(WordId::from_index(index)));
        let texts = ids.map(|id| Value::Text(TextId(id)));
        for value in [Value::Unset, Value::Empty].into_iter().chain(words).chain(texts) {
            assert_eq!(Slot::from(value).value(), value);
            assert!(Slot::from(value).number().is_nan());
        }
    }

    #[test]
    fn a_result_that_is_no_number_is_not_taken_for_a_text() {
        for number in [f64::INFINITY, f64::NEG_INFINITY, f64::NAN, -f64::NAN] {
            assert!(matches!(Slot::from(number).value(), Value::Number(_)));
        }
    }

    #[test]
    fn texts_nobody_refers_to_are_dropped() {
        let mut texts = Texts::default();
        let first = texts.add("first", 100).unwrap();
        texts.add("garbage", 100).unwrap();
        let third = texts.add("third", 100).unwrap();
        let mut values =
            [Value::Text(third), Value::Number(1.0), Value::Text(first), Value::Text(third)]
                .map(Slot::from);
        texts.keep(values.iter_mut());
        assert_eq!(texts.size(), "firstthird".len() + 8);
        assert_eq!(values[0], values[3]);
        let Value::Text(kept) = values[2].value() else { panic!("still a text") };
        assert_eq!(texts.get(kept), "first");
    }

    #[test]
    fn the_arena_has_a_limit() {
        let mut texts = Texts::default();
        assert!(texts.add("123456", 10).is_ok());
        assert_eq!(texts.add("", 10), Err(TextsFull));
    }
}
