//! Records made in memory, for a program that has its tool path as data and not as text.

use crate::errors::ClCode;
use crate::layout::{ShapeError, takes_text, takes_texts_as_items};
use crate::record::{Record, Word};
use crate::vocabulary::WordId;
use crate::words;

/// An item of a statement.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Item<'a> {
    /// A number, in the unit that the word means.
    Number(f64),
    /// A vocabulary word.
    Word(WordId),
    /// A text: the whole text of PPRINT and its like, a name elsewhere.
    Text(&'a str),
    /// An item that is left out between two commas.
    Empty,
}

impl From<f64> for Item<'_> {
    fn from(value: f64) -> Self {
        Item::Number(value)
    }
}

impl From<i32> for Item<'_> {
    fn from(value: i32) -> Self {
        Item::Number(f64::from(value))
    }
}

impl From<WordId> for Item<'_> {
    fn from(word: WordId) -> Self {
        Item::Word(word)
    }
}

impl<'a> From<&'a str> for Item<'a> {
    fn from(text: &'a str) -> Self {
        Item::Text(text)
    }
}

/// Collects the items of a statement; see [`Record::builder`].
#[derive(Clone, Debug)]
pub struct RecordBuilder {
    record: Record,
}

impl RecordBuilder {
    /// One more item.
    pub fn item<'a>(mut self, item: impl Into<Item<'a>>) -> Self {
        let word = match item.into() {
            Item::Number(value) => Word::Number(value + 0.0),
            Item::Word(id) => Word::Minor(id),
            Item::Text(text) => self.record.store_text(text),
            Item::Empty => Word::Empty,
        };
        self.record.data.push(word);
        self
    }

    /// A minor word and its value.
    pub fn couplet<'a>(self, word: WordId, value: impl Into<Item<'a>>) -> Self {
        self.item(word).item(value)
    }

    /// The line of the host's own text that the record comes from, 1-based, for messages.
    /// Without it the record points to no line.
    pub fn line(mut self, line: u32) -> Self {
        self.record.line = line;
        self
    }

    /// The record.
    ///
    /// # Errors
    /// A number that is not finite; coordinates of a wrong number or kind; a tool axis or a
    /// circle's axis whose length is not 1; a text where the word takes none.
    pub fn build(mut self) -> Result<Record, ShapeError> {
        let data = &self.record.data;
        if let Some(item) = data.iter().position(is_not_finite) {
            let message = "a number that is not finite".to_string();
            return Err(ShapeError { code: ClCode::BadNumber, message, item });
        }
        self.check_texts()?;
        self.record.check_axis()?;
        self.record.arrange()?;
        Ok(self.record)
    }

    fn check_texts(&self) -> Result<(), ShapeError> {
        let Record { major, data, .. } = &self.record;
        let is_text = |word: &Word| matches!(word, Word::Text { .. });
        let refuse = |message: &str, item| {
            Err(ShapeError { code: ClCode::BadWord, message: message.to_string(), item })
        };
        if takes_text(*major) {
            let is_one = matches!(data[..], [Word::Text { .. }]);
            return if is_one { Ok(()) } else { refuse("one text is needed, and nothing else", 0) };
        }
        match data.iter().position(is_text) {
            Some(item) if !takes_texts_as_items(*major) => refuse("the word takes no text", item),
            _ => Ok(()),
        }
    }
}

fn is_not_finite(word: &Word) -> bool {
    matches!(word, Word::Number(value) if !value.is_finite())
}

impl Record {
    /// Starts the record of a statement.
    ///
    /// ```
    /// use fil_cl::{Record, words};
    ///
    /// // CYCLE / DEEP, DEPTH, 12.5, STEP, 3, MMPM, 80, CLEAR, 2
    /// let cycle = Record::builder(words::CYCLE)
    ///     .item(words::DEEP)
    ///     .couplet(words::DEPTH, 12.5)
    ///     .couplet(words::STEP, 3.0)
    ///     .couplet(words::MMPM, 80.0)
    ///     .couplet(words::CLEAR, 2.0)
    ///     .build()?;
    /// assert_eq!(cycle.number_after(words::STEP), Some(3.0));
    /// assert!(Record::builder(words::GOTO).item(1.0).item(f64::NAN).item(0.0).build().is_err());
    /// # Ok::<(), fil_cl::ShapeError>(())
    /// ```
    pub fn builder(major: WordId) -> RecordBuilder {
        RecordBuilder { record: Record { major, ..Record::default() } }
    }

    /// The record of the statement `major / items`, as the reader makes it.
    ///
    /// ```
    /// use fil_cl::{Record, words};
    ///
    /// let feed = Record::post(words::FEDRAT, [400.0.into(), words::MMPM.into()])?;
    /// let note = Record::post(words::PPRINT, ["ROUGHING".into()])?;
    /// let rapid = Record::post(words::RAPID, [])?;
    /// assert_eq!((feed.len(), note.text.as_str(), rapid.len()), (5, "ROUGHING", 3));
    /// # Ok::<(), fil_cl::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// As [`RecordBuilder::build`].
    pub fn post<'a>(
        major: WordId,
        items: impl IntoIterator<Item = Item<'a>>,
    ) -> Result<Record, ShapeError> {
        items.into_iter().fold(Record::builder(major), RecordBuilder::item).build()
    }

    /// A GOTO to a point in the unit of the program, with the tool axis (a vector of length
    /// 1 from the tip into the holder) if there is one.
    ///
    /// ```
    /// use fil_cl::Record;
    ///
    /// let tilted = Record::motion([10.0, 0.0, 5.0], Some([0.0, 0.6, 0.8]))?;
    /// assert_eq!(tilted.axis(), Some([0.0, 0.6, 0.8]));
    /// assert!(Record::motion([10.0, 0.0, 5.0], Some([0.0, 0.0, 0.0])).is_err());
    /// # Ok::<(), fil_cl::ShapeError>(())
    /// ```
    ///
    /// # Errors
    /// As [`RecordBuilder::build`].
    pub fn motion(point: [f64; 3], axis: Option<[f64; 3]>) -> Result<Record, ShapeError> {
        let values = point.into_iter().chain(axis.into_iter().flatten());
        Record::post(words::GOTO, values.map(Item::Number))
    }
}
