//! Values, words of records and the faults of the oracle.

use fil_cl::{Record, Vocabulary, WordView};

/// The EMPTY value, as POSTF(4) gives it.
pub const EMPTY: f64 = 999_999.0;

/// Warning: a name that was never set is read.
pub const NEVER_SET: u16 = 309;
/// Warning: a word past the end of the record is read.
pub const PAST_END: u16 = 310;

/// What a name can hold.
#[derive(Clone, Debug, PartialEq)]
pub enum Value {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
    /// A vocabulary word by its name.
    Minor(String),
    /// EMPTY.
    Empty,
}

impl Value {
    /// The value of a number of the post.
    pub fn of(number: f64) -> Value {
        if number == EMPTY { Value::Empty } else { Value::Number(number) }
    }
}

/// A number that no two different values share the writing of: events and
/// results are compared as text.
pub fn exact(number: f64) -> String {
    format!("{number:?}")
}

impl std::fmt::Display for Value {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match self {
            Value::Number(number) => f.write_str(&exact(*number)),
            Value::Text(text) => write!(f, "'{text}'"),
            Value::Minor(word) => f.write_str(word),
            Value::Empty => f.write_str(&exact(EMPTY)),
        }
    }
}

/// Why a run stops. The number is that of the documented error code.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Class {
    /// No finite result.
    Domain = 301,
    /// Text and number mixed.
    WrongType = 302,
    /// Subscript out of range.
    Subscript = 303,
    /// Section runs too long.
    OutOfFuel = 304,
    /// A DO step of 0.
    ZeroStep = 307,
    /// A condition that is neither 0 nor 1.
    NotLogical = 308,
    /// A word number that is none.
    BadWordNumber = 311,
    /// Read past the last record.
    PastLastRecord = 312,
    /// No current record.
    NoRecord = 313,
    /// Nothing saved to restore.
    NothingSaved = 314,
    /// Bad argument of POSTF.
    BadPostf = 315,
    /// A record whose words don't fit its major word.
    BadRecord = 407,
    /// A function or form that the oracle does not know.
    Unknown = 204,
}

/// A stop with the line of its statement.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Fault {
    /// Why.
    pub class: Class,
    /// Line in the FIL file, 1-based.
    pub line: u32,
}

/// A word of a record.
#[derive(Clone, Debug, PartialEq)]
pub enum Word {
    /// A number.
    Number(f64),
    /// A vocabulary word by its name.
    Minor(String),
    /// A text.
    Text(String),
    /// Nothing.
    Empty,
}

/// A record in the oracle's own shape.
#[derive(Clone, Debug, PartialEq)]
pub struct Rec {
    /// Word 1.
    pub number: u32,
    /// Word 2.
    pub kind: u32,
    /// Word 3 where it is no code of a major word.
    pub sub: u32,
    /// The major word.
    pub major: String,
    /// Words 4 and up.
    pub data: Vec<Word>,
}

impl Rec {
    /// A record of the CL reader.
    pub fn read(record: &Record, vocab: &Vocabulary) -> Rec {
        let word = |n| match record.word(n, vocab) {
            Some(WordView::Number(number)) => Word::Number(number),
            Some(WordView::Word { name, .. }) => Word::Minor(name.to_string()),
            Some(WordView::Text(text)) => Word::Text(text.to_string()),
            Some(WordView::Empty) | None => Word::Empty,
        };
        Rec {
            number: record.number,
            kind: record.kind,
            sub: record.sub,
            major: vocab.name(record.major).to_string(),
            data: (4..=record.len()).map(word).collect(),
        }
    }

    /// Number of the last word.
    pub fn len(&self) -> usize {
        3 + self.data.len()
    }

    /// True when there are no data words.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// Word 3 is the code of the major word in post commands only.
    pub fn opens_with_word(&self) -> bool {
        self.kind == 2000
    }
}

impl std::fmt::Display for Rec {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{} {}", self.kind, self.major)?;
        for word in &self.data {
            match word {
                Word::Number(number) => write!(f, " {}", exact(*number))?,
                Word::Minor(name) => write!(f, " {name}")?,
                Word::Text(text) => write!(f, " '{text}'")?,
                Word::Empty => f.write_str(" -")?,
            }
        }
        Ok(())
    }
}
