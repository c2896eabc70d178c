//! The words of a block in a map: `#4 X7:6 F5:4@12,9,0`.

use std::ops::Range;

use fil_post::noted::{SEQUENCE, SKIP, TEXT};
use fil_post::{Cause, WordInfo};

/// A word of a block.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// Its letter, `A` to `Z`; `_` for a text, `/` for the block-delete character,
    /// `#` for a sequence number.
    pub letter: char,
    /// Byte range in the block, with the blank that follows.
    pub range: Range<usize>,
    /// Its cause.
    pub cause: Cause,
}

impl Word {
    /// The word as it stands in the block; empty for a block of another program.
    pub fn text<'a>(&self, block: &'a str) -> &'a str {
        block.get(self.range.clone()).unwrap_or("").trim_end()
    }
}

/// Writes the words of a block, of which each comes with its cause; the
/// text of the block is so many bytes long.
pub(super) fn write(
    words: impl Iterator<Item = (WordInfo, Cause)>,
    length: usize,
    block: Cause,
    out: &mut Vec<u8>,
) {
    let mut words = words.peekable();
    while let Some((word, cause)) = words.next() {
        let end = words.peek().map_or(length, |(next, _)| next.start());
        out.push(word.letter());
        number((end - word.start()) as i64, out);
        if cause.word != 0 {
            out.push(if cause.made_by_fil { b'*' } else { b':' });
            number(cause.word.into(), out);
        }
        if !cause.is_of_the_record(usual(word.letter(), block)) {
            out.push(b'@');
            if !cause.is_of_the_record(Cause::default()) {
                number(distance(block.line, cause.line), out);
                out.push(b',');
                number(distance(block.record, cause.record), out);
                out.push(b',');
                number(cause.stack.into(), out);
            }
        }
        if words.peek().is_some() {
            out.push(b' ');
        }
    }
}

/// What words of a letter are caused by unless they say otherwise.
fn usual(letter: u8, block: Cause) -> Cause {
    if letter == SEQUENCE { Cause::default() } else { block }
}

/// How many lines or records `to` comes after `from`.
pub(super) fn distance(from: u32, to: u32) -> i64 {
    i64::from(to) - i64::from(from)
}

/// The number that comes `distance` after `from`.
pub(super) fn moved(from: u32, distance: i64) -> Option<u32> {
    u32::try_from(i64::from(from).checked_add(distance)?).ok()
}

/// Appends a number.
pub(super) fn number(number: i64, out: &mut Vec<u8>) {
    out.extend_from_slice(itoa::Buffer::new().format(number).as_bytes());
}

/// A word as all blocks of one form have it.
#[derive(Clone, Debug)]
pub(super) struct FormWord {
    letter: char,
    range: Range<usize>,
    word: u16,
    made_by_fil: bool,
    from: Origin,
}

/// Which record caused a word, as seen from that of its block.
#[derive(Clone, Copy, Debug)]
enum Origin {
    Block,
    Nothing,
    Near { lines: i64, records: i64, stack: u32 },
}

impl FormWord {
    /// Its cause in a block; `None` for what no map says.
    pub(super) fn cause(&self, block: Cause) -> Option<Cause> {
        let record = match self.from {
            Origin::Block => block,
            Origin::Nothing => Cause::default(),
            Origin::Near { lines, records, stack } => Cause {
                line: moved(block.line, lines)?,
                record: moved(block.record, records)?,
                stack,
                ..Cause::default()
            },
        };
        Some(Cause { word: self.word, made_by_fil: self.made_by_fil, ..record })
    }

    /// The word in a block.
    pub(super) fn in_block(&self, block: Cause) -> Option<Word> {
        Some(Word { letter: self.letter, range: self.range.clone(), cause: self.cause(block)? })
    }

    /// CL lines from that of its block to its own.
    pub(super) fn lines(&self) -> i64 {
        if let Origin::Near { lines, .. } = self.from { lines } else { 0 }
    }

    /// The FIL call stack that it names besides that of its block.
    pub(super) fn stack(&self) -> u32 {
        if let Origin::Near { stack, .. } = self.from { stack } else { 0 }
    }
}

/// Reads the words of a form; `None` for a text of another kind.
pub(super) fn read(text: &str) -> Option<Vec<FormWord>> {
    let mut start = 0usize;
    let words = text.split(' ').filter(|_| !text.is_empty());
    words
        .map(|word| {
            let mut characters = word.chars();
            let letter = characters.next().filter(|letter| known(*letter))?;
            let (shape, from) = match characters.as_str().split_once('@') {
                Some((shape, record)) => (shape, origin(record)?),
                None if letter as u8 == SEQUENCE => (characters.as_str(), Origin::Nothing),
                None => (characters.as_str(), Origin::Block),
            };
            let made_by_fil = shape.contains('*');
            let (length, item) = match shape.split_once([':', '*']) {
                Some((length, item)) => (length, plain(item)?),
                None => (shape, 0),
            };
            let end = start.checked_add(usize::try_from(plain(length)?).ok()?)?;
            let range = std::mem::replace(&mut start, end)..end;
            let word = u16::try_from(item).ok()?;
            Some(FormWord { letter, range, word, made_by_fil, from })
        })
        .collect()
}

fn known(letter: char) -> bool {
    letter.is_ascii_uppercase() || [TEXT, SKIP, SEQUENCE].map(char::from).contains(&letter)
}

fn origin(text: &str) -> Option<Origin> {
    if text.is_empty() {
        return Some(Origin::Nothing);
    }
    let mut parts = text.split(',');
    let (lines, records) = (parts.next()?.parse().ok()?, parts.next()?.parse().ok()?);
    let stack = plain(parts.next()?)?;
    parts.next().is_none().then_some(Origin::Near { lines, records, stack })
}

/// A number of digits alone.
fn plain(text: &str) -> Option<u32> {
    text.bytes().all(|byte| byte.is_ascii_digit()).then(|| text.parse().ok())?
}

#[cfg(test)]
mod tests {
    use fil_post::Noted;
    use proptest::prelude::*;

    use super::*;

    fn cause() -> impl Strategy<Value = Cause> {
        let parts = (0u32..3, 0u32..3, 0u32..3, 0u16..3, any::<bool>());
        parts.prop_map(|(record, line, stack, word, made_by_fil)| Cause {
            record,
            line,
            stack,
            word,
            made_by_fil: made_by_fil && word > 0,
        })
    }

    fn letter() -> impl Strategy<Value = u8> {
        prop_oneof![b'A'..=b'Z', Just(TEXT), Just(SKIP), Just(SEQUENCE)]
    }

    proptest! {
        #[test]
        fn words_are_read_as_they_were_written(
            block in cause(), words in prop::collection::vec((letter(), 1usize..2000, cause()), 0..9)
        ) {
            let mut noted = Noted::default();
            let mut wanted = Vec::new();
            let mut start = 0;
            for (letter, length, cause) in words {
                noted.word(letter, start, cause, block);
                wanted.push((char::from(letter), start, cause));
                start += length;
            }
            noted.block(70..70 + start, block);
            let mut text = Vec::new();
            write(noted.words_of(&noted.blocks[0]), start, block, &mut text);
            let form = read(std::str::from_utf8(&text).unwrap()).unwrap();
            let found: Vec<_> = form.iter().map(|word| word.in_block(block).unwrap()).collect();
            let shown: Vec<_> =
                found.iter().map(|word| (word.letter, word.range.start, word.cause)).collect();
            prop_assert_eq!(shown, wanted);
            prop_assert_eq!(found.last().map_or(0, |word| word.range.end), start);
        }

        #[test]
        fn no_text_is_too_strange(text in "[XN_/#0-9:*@, é]{0,30}") {
            for word in read(&text).iter().flatten() {
                word.in_block(Cause::default());
            }
        }
    }
}
