//! Reading the items of a record: numbers, flags and couplets in any order.
//!
//! Each item taken is crossed off; what is left over at the end is reported,
//! so that no part of a record is ignored without a word.

use fil_cl::record::FIRST_DATA;
use fil_cl::vocabulary::Vocabulary;
use fil_cl::{Record, Word, WordId};
use fil_diag::Diag;

use crate::errors::PostCode;
use crate::post::Post;

/// The items of a record that are not yet taken.
pub struct Form<'a> {
    record: &'a Record,
    vocabulary: &'a Vocabulary,
    taken: Vec<bool>,
    /// Index of the item that was taken last.
    last: Option<usize>,
}

impl<'a> Form<'a> {
    /// All items of a record.
    pub fn new(record: &'a Record, vocabulary: &'a Vocabulary) -> Self {
        Form { record, vocabulary, taken: vec![false; record.data.len()], last: None }
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
                self.taken[at] = true;
                self.last = Some(at);
                true
            }
            None => false,
        }
    }

    /// Takes the first of these minor words that is there.
    pub fn any_of(&mut self, words: &[WordId]) -> Option<WordId> {
        words.iter().copied().find(|word| self.flag(*word))
    }

    /// Takes a couplet: a minor word and the number after it. `None` when the
    /// word is absent.
    ///
    /// # Errors
    /// The word is there without a number after it.
    pub fn couplet(&mut self, word: WordId) -> Result<Option<f64>, Box<Diag>> {
        let Some(at) = self.find(word) else { return Ok(None) };
        match self.record.data.get(at + 1) {
            Some(Word::Number(value)) if !self.taken[at + 1] => {
                self.taken[at] = true;
                self.taken[at + 1] = true;
                self.last = Some(at + 1);
                Ok(Some(*value))
            }
            _ => Err(self.error(format!("{} needs a number after it", self.name(word)))),
        }
    }

    /// Takes the first number that is left.
    pub fn number(&mut self) -> Option<f64> {
        let number = |word: &Word| match word {
            Word::Number(value) => Some(*value),
            _ => None,
        };
        let at = (0..self.taken.len())
            .find(|at| !self.taken[*at] && number(&self.record.data[*at]).is_some())?;
        self.taken[at] = true;
        self.last = Some(at);
        number(&self.record.data[at])
    }

    /// Takes the number that must be there.
    ///
    /// # Errors
    /// There is none.
    pub fn required(&mut self, what: &str) -> Result<f64, Box<Diag>> {
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
    pub fn end(self) -> Result<(), Box<Diag>> {
        match self.left() {
            Some(left) => {
                let mut diag = self.error(format!("no meaning is known for {left}"));
                diag.hint = self.meant();
                Err(diag)
            }
            None => Ok(()),
        }
    }

    /// Warns of what is left.
    pub fn finish(self, post: &mut Post) {
        if let Some(left) = self.left() {
            let major = self.name(self.record.major);
            let message = format!("{major}: no effect of {left}");
            post.warn_with(PostCode::IgnoredPart, message, || self.meant());
        }
    }

    /// The items that nobody took, as text; `None` when there are none.
    fn left(&self) -> Option<String> {
        let left: Vec<String> = self
            .taken
            .iter()
            .zip(&self.record.data)
            .filter(|(taken, _)| !**taken)
            .filter_map(|(_, word)| match word {
                Word::Number(value) => Some(value.to_string()),
                Word::Minor(word) => Some(self.name(*word).to_string()),
                Word::Text { start, len } => self
                    .record
                    .text
                    .get(*start as usize..(*start + *len) as usize)
                    .map(|text| format!("'{text}'")),
                Word::Empty => None,
            })
            .collect();
        (!left.is_empty()).then(|| left.join(", "))
    }

    /// An error about the form of this record.
    pub fn error(&self, message: impl std::fmt::Display) -> Box<Diag> {
        let major = self.name(self.record.major);
        Box::new(Diag::new(PostCode::WordForm, format!("{major}: {message}")))
    }

    /// What the first unknown word of those left was perhaps meant to be.
    fn meant(&self) -> Option<String> {
        let mut left = self.taken.iter().zip(&self.record.data).filter(|(taken, _)| !**taken);
        left.find_map(|(_, word)| match word {
            Word::Minor(word) => self.vocabulary.perhaps_meant(*word),
            _ => None,
        })
    }

    fn find(&self, word: WordId) -> Option<usize> {
        (0..self.taken.len())
            .find(|at| !self.taken[*at] && self.record.data[*at] == Word::Minor(word))
    }

    fn name(&self, word: WordId) -> &str {
        self.vocabulary.name(word)
    }
}
