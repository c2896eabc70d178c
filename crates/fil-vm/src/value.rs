//! The value of a FIL name: a number or a text, and the arena of texts.

use std::fmt;

/// The EMPTY value of numbers: what a post shows for "nothing here".
pub const EMPTY: f64 = 999_999.0;

/// A text in the [`Texts`] arena.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct TextId(u32);

/// What a register holds.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Value {
    /// A number; always finite.
    Number(f64),
    /// A text.
    Text(TextId),
    /// A name that was never set. It is read as EMPTY, with a warning, so it
    /// is kept apart from a name that was set to EMPTY on purpose.
    Unset,
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
    pub fn keep<'a>(&mut self, live: impl Iterator<Item = &'a mut Value>) {
        let old = std::mem::take(self);
        let mut renamed = vec![None; old.ends.len()];
        for value in live {
            if let Value::Text(id) = value {
                *id = *renamed[id.0 as usize].get_or_insert_with(|| {
                    self.bytes.push_str(old.get(*id));
                    self.ends.push(self.bytes.len() as u32);
                    TextId(self.ends.len() as u32 - 1)
                });
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
    fn a_value_is_two_words_wide() {
        assert_eq!(size_of::<Value>(), 16);
    }

    #[test]
    fn texts_nobody_refers_to_are_dropped() {
        let mut texts = Texts::default();
        let first = texts.add("first", 100).unwrap();
        texts.add("garbage", 100).unwrap();
        let third = texts.add("third", 100).unwrap();
        let mut values =
            [Value::Text(third), Value::Number(1.0), Value::Text(first), Value::Text(third)];
        texts.keep(values.iter_mut());
        assert_eq!(texts.size(), "firstthird".len() + 8);
        assert_eq!(values[0], values[3]);
        let Value::Text(kept) = values[2] else { panic!("still a text") };
        assert_eq!(texts.get(kept), "first");
    }

    #[test]
    fn the_arena_has_a_limit() {
        let mut texts = Texts::default();
        assert!(texts.add("123456", 10).is_ok());
        assert_eq!(texts.add("", 10), Err(TextsFull));
    }
}
