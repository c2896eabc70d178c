//! The items of a record as a handler takes them: numbers, flags and couplets in
//! any order.
//!
//! Each item taken is crossed off. The dispatcher refuses the record when any is
//! left, so that no part of a record is ignored without a word.

use fil_cl::record::FIRST_DATA;
use fil_cl::vocabulary::Vocabulary;
use fil_cl::{Record, Word, WordId};
use fil_diag::{Diag, Result};

use crate::errors::PostCode;

/// Most items of a record that commands the machine.
const MOST: usize = 128;

/// The items of a record that are not yet taken.
pub struct Items<'a> {
    record: &'a Record,
    vocabulary: &'a Vocabulary,
    /// Bit n: item n is taken.
    taken: u128,
    /// Index of the item that was taken last.
    last: Option<usize>,
}

impl<'a> Items<'a> {
    /// All items of a record.
    ///
    /// # Errors
    /// More than 128 of them: no record that commands a machine is that long.
    #[inline]
    pub fn new(record: &'a Record, vocabulary: &'a Vocabulary) -> Result<Self> {
        if record.data.len() > MOST {
            return Err(Items::too_many(record, vocabulary));
        }
        Ok(Items { record, vocabulary, taken: 0, last: None })
    }

    #[cold]
    fn too_many(record: &'a Record, vocabulary: &'a Vocabulary) -> Box<Diag> {
        let items = Items { record, vocabulary, taken: 0, last: None };
        items.error(format!("more than {MOST} items"))
    }

    /// Crosses the first items off: the fixed head of a record.
    #[inline]
    pub fn skip(&mut self, count: usize) {
        self.taken |= first(count);
    }

    /// True when every item is taken.
    #[inline]
    pub fn all_taken(&self) -> bool {
        self.taken == first(self.len())
    }

    /// Number of items, taken or not.
    pub fn len(&self) -> usize {
        self.record.data.len()
    }

    /// True when the record has no items.
    pub fn is_empty(&self) -> bool {
        self.record.data.is_empty()
    }

    /// True when the item is this minor word.
    pub fn is_word(&self, at: usize, word: WordId) -> bool {
        self.record.data.get(at) == Some(&Word::Minor(word))
    }

    /// The word of the record that was taken last, as POSTF(7,n) counts; of a
    /// couplet its number. 0 before the first.
    pub fn last_word(&self) -> u16 {
        let word = self.last.map_or(0, |index| index + FIRST_DATA);
        u16::try_from(word).unwrap_or(0)
    }

    /// Takes a minor word wherever it stands.
    pub fn flag(&mut self, word: WordId) -> bool {
        match self.find(word) {
            Some(at) => {
                self.take(at);
                true
            }
            None => false,
        }
    }

    /// Takes the first of these minor words that is there.
    pub fn any_of(&mut self, words: &[WordId]) -> Option<WordId> {
        words.iter().copied().find(|word| self.flag(*word))
    }

    /// Takes a minor word and the one right behind it; false when they do not stand so.
    pub fn pair(&mut self, word: WordId, second: WordId) -> bool {
        let Some(at) = self.find(word).filter(|at| self.is_word(at + 1, second)) else {
            return false;
        };
        self.take(at);
        self.take(at + 1);
        true
    }

    /// Takes the minor word at an index; false when another item stands there.
    pub fn word_at(&mut self, at: usize, word: WordId) -> bool {
        let stands = self.is_word(at, word) && self.is_left(at);
        if stands {
            self.take(at);
        }
        stands
    }

    /// Takes a couplet: a minor word and the number after it. `None` when the
    /// word is absent.
    ///
    /// # Errors
    /// The word is there without a number after it.
    pub fn couplet(&mut self, word: WordId) -> Result<Option<f64>> {
        let Some(at) = self.find(word) else { return Ok(None) };
        match self.record.data.get(at + 1) {
            Some(Word::Number(value)) if self.is_left(at + 1) => {
                self.take(at);
                self.take(at + 1);
                Ok(Some(*value))
            }
            _ => Err(self.error(format!("{} needs a number after it", self.name(word)))),
        }
    }

    /// Takes the numbers that follow those taken last, without a word between them.
    pub fn further(&mut self) -> Vec<f64> {
        let next = |items: &mut Self| {
            let at = usize::from(items.last_word()) + 1 - FIRST_DATA;
            let Some(Word::Number(value)) = items.record.data.get(at) else { return None };
            items.take(at);
            Some(*value)
        };
        std::iter::from_fn(|| next(self)).collect()
    }

    /// Takes the first number that is left.
    pub fn number(&mut self) -> Option<f64> {
        let at = (0..self.len())
            .find(|at| self.is_left(*at) && matches!(self.record.data[*at], Word::Number(_)))?;
        self.take(at);
        match self.record.data[at] {
            Word::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Takes the number that must be there.
    ///
    /// # Errors
    /// There is none.
    pub fn required(&mut self, what: &str) -> Result<f64> {
        self.number().ok_or_else(|| self.error(format!("{what} is missing")))
    }

    /// Takes all numbers that are left.
    pub fn numbers(&mut self) -> Vec<f64> {
        std::iter::from_fn(|| self.number()).collect()
    }

    /// The same, each with its word as POSTF(7,n) counts.
    pub fn numbered(&mut self) -> Vec<(f64, u16)> {
        std::iter::from_fn(|| self.number().map(|number| (number, self.last_word()))).collect()
    }

    /// Refuses what is left: in a record that commands the machine, an item
    /// without meaning leaves the rest in doubt too.
    ///
    /// # Errors
    /// Items are left.
    #[inline]
    pub fn deny_rest(&self) -> Result<()> {
        if self.all_taken() { Ok(()) } else { self.deny_left() }
    }

    /// Refuses a word that is left where only numbers can stand, as a script that takes the wrong
    /// word of a record makes it.
    pub fn deny_words(&self) -> Result<()> {
        let word = (0..self.len()).find_map(|at| match self.record.data[at] {
            Word::Minor(word) if self.is_left(at) => Some(word),
            _ => None,
        });
        let Some(word) = word else { return Ok(()) };
        let name = self.name(word);
        let mut diag = self.error(format!("{name} is a word, and a number is needed"));
        diag.hint = diag.hint.or_else(|| {
            Some(format!(
                "POSTF(6,n) is 2 for a word of a record; COUPLF({name}) is the number after {name}."
            ))
        });
        Err(diag)
    }

    fn deny_left(&self) -> Result<()> {
        match self.left() {
            Some(left) => Err(self.error(format!("no meaning is known for {left}"))),
            None => Ok(()),
        }
    }

    /// The items that nobody took, as text; `None` when there are none.
    fn left(&self) -> Option<String> {
        let left: Vec<String> = (0..self.len())
            .filter(|at| self.is_left(*at))
            .map(|at| match self.record.data[at] {
                Word::Number(value) => value.to_string(),
                Word::Minor(word) => self.name(word).to_string(),
                word @ Word::Text { .. } => format!("'{}'", self.record.text_of(word)),
                Word::Empty => "an empty item".to_string(),
            })
            .collect();
        (!left.is_empty()).then(|| left.join(", "))
    }

    /// An error about the form of this record.
    pub fn error(&self, message: impl std::fmt::Display) -> Box<Diag> {
        let major = self.name(self.record.major);
        let mut diag = PostCode::WordForm.diag(format!("{major}: {message}"));
        diag.hint = self.meant();
        diag
    }

    /// The text of the record, without blanks around it.
    pub fn text(&mut self) -> &'a str {
        for at in 0..self.len() {
            if matches!(self.record.data[at], Word::Text { .. }) {
                self.take(at);
            }
        }
        self.record.text.trim()
    }

    /// Takes all texts that are left.
    pub fn texts(&mut self) -> Vec<&'a str> {
        let texts = (0..self.len()).filter(|at| self.is_left(*at));
        let texts: Vec<usize> =
            texts.filter(|at| matches!(self.record.data[*at], Word::Text { .. })).collect();
        texts.iter().for_each(|at| self.take(*at));
        texts.into_iter().map(|at| self.record.text_of(self.record.data[at])).collect()
    }

    /// The arc of a CIRCLE record; its head is crossed off.
    pub fn circle(&mut self) -> Option<fil_cl::Circle> {
        const HEAD: usize = 12;
        let circle = self.record.circle()?;
        self.skip(HEAD.min(self.len()));
        Some(circle)
    }

    /// True when a minor word is left.
    pub fn has(&self, word: WordId) -> bool {
        self.find(word).is_some()
    }

    /// What the first unknown word of those left was perhaps meant to be.
    fn meant(&self) -> Option<String> {
        (0..self.len()).filter(|at| self.is_left(*at)).find_map(|at| match self.record.data[at] {
            Word::Minor(word) => self.vocabulary.perhaps_meant(word),
            _ => None,
        })
    }

    /// Line of the record in the CL file; 0 for one that FIL has made.
    pub fn line(&self) -> u32 {
        self.record.line
    }

    /// The major word of the record.
    pub fn major(&self) -> WordId {
        self.record.major
    }

    /// The name of a word.
    pub fn name(&self, word: WordId) -> &str {
        self.vocabulary.name(word)
    }

    fn find(&self, word: WordId) -> Option<usize> {
        (0..self.len()).find(|at| self.is_left(*at) && self.record.data[*at] == Word::Minor(word))
    }

    fn is_left(&self, at: usize) -> bool {
        self.taken & 1 << at == 0
    }

    fn take(&mut self, at: usize) {
        self.taken |= 1 << at;
        self.last = Some(at);
    }
}

/// The set of the first items.
#[inline]
fn first(count: usize) -> u128 {
    match count {
        0 => 0,
        1..MOST => (1 << count) - 1,
        _ => u128::MAX,
    }
}
