//! The items of a statement.

use std::ops::Range;

use fil_diag::Result;

use super::names::disguise;
use super::number::number;
use super::statement::{decoded, is_blank};
use super::{Reader, is_control};
use crate::errors::ClCode;
use crate::layout::{UNCOMPUTED, is_uncomputed, takes_text};
use crate::record::{Record, Word};
use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

/// More words than this are no vocabulary any more.
const MAX_VOCABULARY: usize = 50_000;

/// Beyond this many words, names of operations and their like are texts: a file may have any
/// number of them, and memory must not grow with it.
const MAX_NAMES: usize = 20_000;

/// A name is not longer than this; in bytes.
const MAX_NAME: usize = 64;

/// How strictly the items of a statement are read.
#[derive(Clone, Copy)]
struct Rules {
    /// What is neither number nor name is kept as a text: in pseudo-comments
    /// and in statements nobody knows.
    lenient: bool,
    /// Names of machines may begin with a digit; elsewhere only known words do,
    /// so that a mistyped number is not taken for a word.
    free_names: bool,
}

impl Reader<'_> {
    /// Sets the major word and the items of the gathered statement.
    pub(super) fn parse_items(
        &mut self,
        vocab: &mut Vocabulary,
        record: &mut Record,
        pseudo: bool,
    ) -> Result<()> {
        self.refuse_bytes(is_control)?;
        self.item_ranges.clear();
        let slash =
            memchr::memchr(b'/', &self.statement.joined).or_else(|| self.comma_as_slash(vocab));
        let length = self.statement.joined.len();
        let major = trim(&self.statement.joined, 0..slash.unwrap_or(length));
        record.major = self.parse_major(vocab, major, pseudo)?;
        self.major = Some(record.major);
        let known = vocab.is_known(record.major);
        let rules = Rules { lenient: pseudo || !known, free_names: record.major == words::MACHIN };
        let Some(slash) = slash else { return Ok(()) };
        if trim(&self.statement.joined, slash + 1..length).is_empty() {
            return Ok(());
        }
        if record.major == words::CYCLE && self.rules().blanks_in_cycles {
            part_at_blanks(&mut self.statement.joined[slash + 1..]);
        }
        let mut start = slash + 1;
        while start <= length {
            let rest = &self.statement.joined[start..];
            let end = memchr::memchr(b',', rest).map_or(length, |comma| start + comma);
            let item = trim(&self.statement.joined, start..end);
            self.item_ranges.push(item.clone());
            let word = self.parse_item(vocab, record, item, rules)?;
            record.data.push(word);
            start = end + 1;
        }
        if vocab.len() > MAX_VOCABULARY {
            let message = format!("more than {MAX_VOCABULARY} words");
            return Err(self.diag(ClCode::TooManyWords, &message, 0..length));
        }
        Ok(())
    }

    /// The first comma, where the dialect writes it in place of the slash: behind words of
    /// a shop, and behind no word that has a meaning.
    fn comma_as_slash(&self, vocab: &Vocabulary) -> Option<usize> {
        if !self.rules().comma_words {
            return None;
        }
        let comma = memchr::memchr(b',', &self.statement.joined)?;
        let name = self.statement.joined[..comma].trim_ascii().to_ascii_uppercase();
        let known = vocab.find(std::str::from_utf8(&name).ok()?);
        known.is_none_or(|id| !vocab.is_known(id)).then_some(comma)
    }

    /// The major word. Blanks within it mean nothing where the word is known
    /// without them; of `TLON,GOFWD` the first word tells.
    fn parse_major(
        &self,
        vocab: &mut Vocabulary,
        range: Range<usize>,
        pseudo: bool,
    ) -> Result<WordId> {
        let text = &self.statement.joined[range.clone()];
        let name = text.split(|byte| *byte == b',').next().unwrap_or(text).trim_ascii_end();
        let refuse = |code, message| Err(self.diag(code, message, range.clone()));
        if !is_major(name) {
            return refuse(ClCode::BadWord, "no major word");
        }
        let has_blank = name.iter().any(|byte| is_blank(*byte));
        let known = if has_blank { without_blanks(vocab, name) } else { None };
        let id = match known {
            Some(id) => id,
            _ if has_blank && !pseudo && !self.is_heading(name) => {
                return refuse(
                    ClCode::BadWord,
                    "several words where a slash or a comma is missing",
                );
            }
            _ => self.intern(vocab, name, range.clone(), pseudo)?,
        };
        if is_uncomputed(id) && !pseudo && !self.computes(id) {
            return refuse(ClCode::UncomputedMotion, UNCOMPUTED);
        }
        if name.len() < text.len() {
            return refuse(ClCode::BadWord, "a comma where the slash should be");
        }
        Ok(id)
    }

    /// A word of the dialect that has a blank in it, and no effect.
    fn is_heading(&self, name: &[u8]) -> bool {
        std::str::from_utf8(name).is_ok_and(|name| self.rules().is_without_effect(name))
    }

    fn parse_item(
        &self,
        vocab: &mut Vocabulary,
        record: &mut Record,
        range: Range<usize>,
        rules: Rules,
    ) -> Result<Word> {
        let item = &self.statement.joined[range.clone()];
        let Some(first) = item.first().copied() else { return Ok(Word::Empty) };
        let numeric = first.is_ascii_digit() || matches!(first, b'+' | b'-' | b'.');
        if numeric && let Some(value) = number(item) {
            return Ok(Word::Number(value));
        }
        if is_name(vocab, item, rules.free_names) {
            if vocab.len() > MAX_NAMES && self.is_data_name(vocab, record, item, rules) {
                return Ok(record.store_text(&decoded(item, self.options.decode)));
            }
            return Ok(Word::Minor(self.intern(vocab, item, range, rules.lenient)?));
        }
        if rules.lenient {
            return Ok(record.store_text(&decoded(item, self.options.decode)));
        }
        let shown = decoded(item, self.options.decode);
        let code = if numeric { ClCode::BadNumber } else { ClCode::BadWord };
        let what = if numeric { "a number" } else { "a number or a name" };
        let mut diag = self.diag(code, &format!("'{shown}' is not {what}"), range);
        let mut parts = item.split(|byte| is_blank(*byte)).filter(|part| !part.is_empty());
        let is_item = |part: &[u8]| number(part).is_some() || is_name(vocab, part, false);
        if parts.clone().count() > 1 && parts.all(is_item) {
            diag.hint = Some("a comma is missing between the items".to_string());
        }
        Err(diag)
    }

    /// True for a new name in a statement that informs: a pseudo-comment, a word without
    /// effect, a word that nobody knows.
    #[cold]
    fn is_data_name(&self, vocab: &Vocabulary, record: &Record, item: &[u8], rules: Rules) -> bool {
        let informs = rules.lenient || self.rules().is_without_effect(vocab.name(record.major));
        informs && is_new(vocab, item)
    }

    /// The id of a name; one that only looks like another word is refused unless the
    /// statement is one that nobody acts on.
    fn intern(
        &self,
        vocab: &mut Vocabulary,
        name: &[u8],
        range: Range<usize>,
        lenient: bool,
    ) -> Result<WordId> {
        if name.is_ascii() {
            return Ok(vocab.intern_bytes(name));
        }
        let name = decoded(name, self.options.decode);
        match disguise(vocab, &name).filter(|_| !lenient) {
            None => Ok(vocab.intern(&name)),
            Some(message) => Err(self.diag(ClCode::BadWord, &message, range)),
        }
    }
}

/// True when an item is read as a text where texts are allowed.
pub(crate) fn reads_as_text(vocab: &Vocabulary, item: &str) -> bool {
    let breaks = |c: char| matches!(c, ',' | '$') || c.is_control();
    let is_whole = !item.is_empty() && item.trim() == item && !item.contains(breaks);
    let is_text = !is_name(vocab, item.as_bytes(), false)
        || vocab.len() > MAX_NAMES && is_new(vocab, item.as_bytes());
    is_whole && number(item.as_bytes()).is_none() && is_text
}

/// True for a name that the run has not met.
fn is_new(vocab: &Vocabulary, name: &[u8]) -> bool {
    std::str::from_utf8(name).map_or(true, |name| vocab.find(name).is_none())
}

/// True for an item that is a name. One that begins with a digit, as 1STPECK,
/// must be known, unless `free` allows any.
fn is_name(vocab: &Vocabulary, item: &[u8], free: bool) -> bool {
    let is_known = || {
        let id = std::str::from_utf8(item).ok().and_then(|name| vocab.find(name));
        id.is_some_and(|id| vocab.is_known(id))
    };
    item.len() <= MAX_NAME
        && item.iter().all(|byte| is_name_byte(*byte))
        && item.first().is_some_and(|first| {
            starts_name(*first) || first.is_ascii_digit() && (free || is_known())
        })
}

/// True for what can stand before the slash; blanks may be in it.
fn is_major(name: &[u8]) -> bool {
    name.len() <= MAX_NAME
        && name.first().is_some_and(|byte| starts_name(*byte))
        && name.iter().all(|byte| is_name_byte(*byte) || is_blank(*byte))
}

/// The known word that a name is without its blanks. The text words are no
/// such words: whether blanks belong to their text cannot be told.
fn without_blanks(vocab: &Vocabulary, name: &[u8]) -> Option<WordId> {
    let compact: Vec<u8> = name.iter().copied().filter(|byte| !is_blank(*byte)).collect();
    let id = vocab.find(std::str::from_utf8(&compact).ok()?)?;
    (vocab.is_known(id) && !takes_text(id)).then_some(id)
}

fn starts_name(byte: u8) -> bool {
    byte.is_ascii_alphabetic() || byte == b'_' || !byte.is_ascii()
}

/// Bytes of a name: letters, digits, and what file and machine names have.
fn is_name_byte(byte: u8) -> bool {
    byte.is_ascii_alphanumeric() || b"_-.#@&:+".contains(&byte) || !byte.is_ascii()
}

/// A range without the blanks at its ends.
fn trim(text: &[u8], range: Range<usize>) -> Range<usize> {
    let part = &text[range.clone()];
    let start = part.iter().position(|byte| !is_blank(*byte)).unwrap_or(part.len());
    let end = part.iter().rposition(|byte| !is_blank(*byte)).map_or(start, |at| at + 1);
    range.start + start..range.start + end
}

/// Puts a comma for a blank that parts two items.
fn part_at_blanks(items: &mut [u8]) {
    let mut at = 0;
    while let Some(blank) = items[at..].iter().position(|byte| is_blank(*byte)) {
        let blank = at + blank;
        let Some(length) = items[blank..].iter().position(|byte| !is_blank(*byte)) else { return };
        at = blank + length;
        if blank > 0 && items[blank - 1] != b',' && items[at] != b',' {
            items[blank] = b',';
        }
    }
}
