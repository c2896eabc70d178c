//! A CL record and its words as FIL counts them.

use crate::vocabulary::{Vocabulary, WordId};
use crate::words;

/// CLDATA record types: word 2 of a record.
pub mod kind {
    /// A `$$-> KEY / …` pseudo-comment of Creo. Not a CLDATA type: the post and
    /// observers see such a record, FIL does not, and POSTF(14) passes over it.
    pub const PSEUDO: u32 = 1;
    /// Post-processor command; word 3 is the code of the major word.
    pub const POST: u32 = 2000;
    /// Surface data; CIRCLE.
    pub const SURFACE: u32 = 3000;
    /// Motion: FROM 3, GODLTA 4, GOTO 5.
    pub const MOTION: u32 = 5000;
    /// Tolerances and cutter.
    pub const CUTTER: u32 = 6000;
    /// Axis and mode: TLAXIS 1, MULTAX 2.
    pub const MODE: u32 = 9000;
    /// FINI.
    pub const FINI: u32 = 14000;
}

/// Subtypes of motion records: word 3 when word 2 is 5000.
pub mod motion {
    /// FROM
    pub const FROM: u32 = 3;
    /// GODLTA
    pub const GODLTA: u32 = 4;
    /// GOTO
    pub const GOTO: u32 = 5;
}

/// Subtypes of mode records: word 3 when word 2 is 9000.
pub mod mode {
    /// TLAXIS
    pub const TLAXIS: u32 = 1;
    /// MULTAX
    pub const MULTAX: u32 = 2;
}

/// Surface type of a circle: words 3 and 5 of a CIRCLE record.
pub const CIRCLE_SURFACE: u32 = 4;

/// Subtype of CUTTER: word 3 when word 2 is 6000.
pub const CUTTER_SUB: u32 = 6;

/// A record never has more words than this, whatever a script asks for.
pub const MAX_WORDS: usize = 65_536;

/// Number of the first data word.
pub const FIRST_DATA: usize = 4;

/// One data word of a record.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Word {
    /// A number (mm or inch, degrees, mm/min …, as the record means it).
    Number(f64),
    /// A vocabulary word.
    Minor(WordId),
    /// A text: byte range of [`Record::text`].
    Text {
        /// First byte.
        start: u32,
        /// Length in bytes.
        len: u32,
    },
    /// A slot that holds nothing (an empty item, the name slots of a motion).
    Empty,
}

/// A CL record. Words are numbered from 1: word 1 is the record number, word 2
/// the type, word 3 the subtype or the code of the major word, words 4… are `data`.
///
/// Layouts: motion = two empty slots, x, y, z[, i, j, k] (words 6 to 8 and 9 to 11);
/// circle = modifier 0, surface type 4, count 7, two empty slots, x, y, z, i, j, k, r
/// (words 9 to 15); post command = its items in order.
#[derive(Clone, Debug, PartialEq)]
pub struct Record {
    /// Record number, 1-based: word 1.
    pub number: u32,
    /// Record type: word 2.
    pub kind: u32,
    /// Subtype: word 3 for the types other than 2000 (there word 3 is the code of `major`).
    pub sub: u32,
    /// The major word of the statement (GOTO for a motion record 5000/5).
    pub major: WordId,
    /// Words 4 and up.
    pub data: Vec<Word>,
    /// The free text of PARTNO, PPRINT, …, and storage of text words.
    pub text: String,
    /// Line of the CL file where the statement starts, 1-based; 0 for a record made by FIL.
    pub line: u32,
    /// The dialect it comes from gives it no effect on the machine: sections see it, the post
    /// passes over it.
    #[doc(hidden)]
    pub inert: bool,
}

/// What a word of a record shows to a reader of the listing.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum WordView<'a> {
    /// A number.
    Number(f64),
    /// A vocabulary word: the major word as word 3, or a minor word.
    Word {
        /// Its name, upper case.
        name: &'a str,
        /// Its integer code, without a unit.
        code: f64,
    },
    /// A text.
    Text(&'a str),
    /// A slot that holds nothing.
    Empty,
}

/// An arc as CIRCLE gives it: right-hand rule, +axis is counterclockwise.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Circle {
    /// Center, in the unit of the CL file.
    pub center: [f64; 3],
    /// Axis in the coordinates of the part, as written: a direction without a unit, not normalised.
    pub axis: [f64; 3],
    /// Radius in the unit of the CL file, where the file gives it.
    pub radius: Option<f64>,
}

impl Default for Record {
    /// A record without type and words, to be filled by a reader.
    fn default() -> Self {
        Record {
            number: 0,
            kind: 0,
            sub: 0,
            major: crate::words::GOTO,
            data: Vec::new(),
            text: String::new(),
            line: 0,
            inert: false,
        }
    }
}

impl Record {
    /// Number of the last word; 3 when there are no data.
    pub fn len(&self) -> usize {
        FIRST_DATA - 1 + self.data.len()
    }

    /// True when the record has no data words.
    pub fn is_empty(&self) -> bool {
        self.data.is_empty()
    }

    /// Word `n` (from 1) for display; `None` past the end.
    pub fn word<'a>(&'a self, n: usize, vocab: &'a Vocabulary) -> Option<WordView<'a>> {
        let named = |id| WordView::Word { name: vocab.name(id), code: vocab.code(id) };
        match n {
            1 => Some(WordView::Number(f64::from(self.number))),
            2 => Some(WordView::Number(f64::from(self.kind))),
            3 if self.has_major_code() => Some(named(self.major)),
            3 => Some(WordView::Number(f64::from(self.sub))),
            _ => self.data_word(n).map(|word| match word {
                Word::Number(value) => WordView::Number(value),
                Word::Minor(id) => named(id),
                Word::Text { .. } => WordView::Text(self.text_of(word)),
                Word::Empty => WordView::Empty,
            }),
        }
    }

    /// Word `n` (from 1) as a number: a vocabulary word gives its code; `None`
    /// for a text, an empty slot and past the end. Its unit is that of the statement.
    pub fn value(&self, n: usize, vocab: &Vocabulary) -> Option<f64> {
        match n {
            1 => Some(f64::from(self.number)),
            2 => Some(f64::from(self.kind)),
            3 if self.has_major_code() => Some(vocab.code(self.major)),
            3 => Some(f64::from(self.sub)),
            _ => match self.data_word(n)? {
                Word::Number(value) => Some(value),
                Word::Minor(id) => Some(vocab.code(id)),
                Word::Text { .. } | Word::Empty => None,
            },
        }
    }

    /// The vocabulary word that word `n` is: the major word as word 3, or a minor word.
    pub fn vocabulary_word(&self, n: usize) -> Option<WordId> {
        match n {
            3 if self.has_major_code() => Some(self.major),
            _ => match self.data_word(n)? {
                Word::Minor(id) => Some(id),
                _ => None,
            },
        }
    }

    /// Class of word `n`: 0 nothing there, 1 number, 2 minor word, 3 text.
    #[doc(hidden)]
    pub fn class(&self, n: usize) -> u8 {
        match n {
            1..FIRST_DATA => 1,
            _ => match self.data_word(n) {
                None | Some(Word::Empty) => 0,
                Some(Word::Number(_)) => 1,
                Some(Word::Minor(_)) => 2,
                Some(Word::Text { .. }) => 3,
            },
        }
    }

    /// Data word `n`, `n` from 4.
    pub fn data_word(&self, n: usize) -> Option<Word> {
        self.data.get(n.checked_sub(FIRST_DATA)?).copied()
    }

    /// The text of a text word; empty for the others.
    pub fn text_of(&self, word: Word) -> &str {
        match word {
            Word::Text { start, len } => {
                let start = start as usize;
                self.text.get(start..start + len as usize).unwrap_or("")
            }
            _ => "",
        }
    }

    /// Number of the first word at or after word `from` that is this minor word.
    pub fn find_minor(&self, from: usize, id: WordId) -> Option<usize> {
        let from = from.saturating_sub(FIRST_DATA);
        let data = self.data.get(from..)?;
        data.iter().position(|word| *word == Word::Minor(id)).map(|at| at + from + FIRST_DATA)
    }

    /// True when the minor word stands anywhere in the record.
    pub fn has(&self, id: WordId) -> bool {
        self.find_minor(FIRST_DATA, id).is_some()
    }

    /// The word after the first `id`: the value of a couplet.
    pub fn after(&self, id: WordId) -> Option<Word> {
        self.data_word(self.find_minor(FIRST_DATA, id)? + 1)
    }

    /// The first number of the record, in the unit that the statement gives it: that of the tool in LOADTL.
    pub fn first_number(&self) -> Option<f64> {
        self.data.iter().find_map(|word| match word {
            Word::Number(number) => Some(*number),
            _ => None,
        })
    }

    /// True for a record that takes a tool: LOADTL, LOAD, TURRET.
    pub fn takes_tool(&self) -> bool {
        matches!(self.major, words::LOADTL | words::LOAD | words::TURRET)
    }

    /// The number after the first `id`, in the unit that the statement gives it.
    pub fn number_after(&self, id: WordId) -> Option<f64> {
        match self.after(id)? {
            Word::Number(value) => Some(value),
            _ => None,
        }
    }

    /// Replaces word `n`; false when there is no such data word.
    pub fn set(&mut self, n: usize, word: Word) -> bool {
        let slot = n.checked_sub(FIRST_DATA).and_then(|index| self.data.get_mut(index));
        slot.map(|slot| *slot = word).is_some()
    }

    /// Number of the first data word that acts: a motion and a circle begin with slots that only
    /// name them.
    pub fn first_value(&self) -> usize {
        match (self.kind, self.sub) {
            (kind::MOTION, _) => FIRST_DATA + 2,
            (kind::SURFACE, CIRCLE_SURFACE) => FIRST_DATA + 5,
            _ => FIRST_DATA,
        }
    }

    /// Inserts a word before word `n`, which may be one past the end; false
    /// when `n` lies elsewhere or the record is full.
    pub fn insert(&mut self, n: usize, word: Word) -> bool {
        let fits = (FIRST_DATA..=self.len() + 1).contains(&n) && self.len() < MAX_WORDS;
        if fits {
            self.data.insert(n - FIRST_DATA, word);
        }
        fits
    }

    /// Deletes word `n`; false when there is no such data word.
    pub fn delete(&mut self, n: usize) -> bool {
        let there = (FIRST_DATA..=self.len()).contains(&n);
        if there {
            self.data.remove(n - FIRST_DATA);
        }
        there
    }

    /// Cuts the record after word `n`, or extends it to `n` words with empty
    /// slots; false when `n` is below 3 or above [`MAX_WORDS`].
    pub fn resize(&mut self, n: usize) -> bool {
        let fits = (FIRST_DATA - 1..=MAX_WORDS).contains(&n);
        if fits {
            self.data.resize(n + 1 - FIRST_DATA, Word::Empty);
        }
        fits
    }

    /// Stores a text and gives the word that stands for it.
    pub fn store_text(&mut self, text: &str) -> Word {
        let start = self.text.len() as u32;
        self.text.push_str(text);
        Word::Text { start, len: text.len() as u32 }
    }

    /// X, Y, Z of a motion record in the unit of the CL file and the coordinates of the part; of a
    /// GODLTA the increments.
    #[inline]
    pub fn point(&self) -> Option<[f64; 3]> {
        if self.kind == kind::MOTION { self.numbers(6) } else { None }
    }

    /// I, J, K of a motion record that has a tool axis: from the tip to the spindle in the
    /// coordinates of the part, without a unit and as written.
    #[inline]
    pub fn axis(&self) -> Option<[f64; 3]> {
        if self.kind == kind::MOTION { self.numbers(9) } else { None }
    }

    /// The arc of a CIRCLE record.
    pub fn circle(&self) -> Option<Circle> {
        if self.kind != kind::SURFACE || self.sub != CIRCLE_SURFACE {
            return None;
        }
        let radius = match self.data_word(15) {
            Some(Word::Number(radius)) => Some(radius),
            _ => None,
        };
        Some(Circle { center: self.numbers(9)?, axis: self.numbers(12)?, radius })
    }

    /// Diameter of the tool that the record describes, in the unit of the CL file: the first
    /// value of CUTTER and of Creo's `$$-> CUTTER`, and TLDATA of a mill or drill of NX.
    pub fn tool_diameter(&self) -> Option<f64> {
        self.tool_measure(0)
    }

    /// The corner radius that the record gives a tool beside its diameter, in the unit of the file.
    pub fn tool_corner(&self) -> Option<f64> {
        self.tool_measure(1)
    }

    /// Length of the cutting part that the record gives a tool: the seventh value of CUTTER, the
    /// third of TLDATA; in the unit of the file.
    pub fn tool_length(&self) -> Option<f64> {
        self.tool_measure(if self.major == words::CUTTER { 6 } else { 2 })
    }

    /// Angle of the bottom of the tool to a plane square to its axis, degrees: 31 of a drill with
    /// a point of 118. The fifth value of CUTTER; from the point of a drill of TLDATA.
    pub fn tool_bottom_angle(&self) -> Option<f64> {
        match (self.major, self.data.first()) {
            (words::CUTTER, _) => self.tool_measure(4),
            (_, Some(Word::Minor(words::DRILL))) => {
                self.tool_measure(3).map(|point| 90.0 - point / 2.0)
            }
            _ => None,
        }
    }

    /// The values that the record gives a tool, in the unit of the file and degrees: those of
    /// CUTTER, or of TLDATA of a mill or drill; none of another record.
    pub fn tool_values(&self) -> &[Word] {
        match (self.major, self.data.first()) {
            (words::CUTTER, _) => &self.data[..],
            (words::TLDATA, Some(Word::Minor(words::MILL | words::DRILL))) => {
                let kind = self.data.iter().take_while(|word| matches!(word, Word::Minor(_)));
                &self.data[kind.count()..]
            }
            _ => &[],
        }
    }

    fn tool_measure(&self, at: usize) -> Option<f64> {
        match self.tool_values().get(at) {
            Some(Word::Number(measure)) => Some(*measure),
            _ => None,
        }
    }

    /// True when word 3 is the code of the major word, not a subtype.
    fn has_major_code(&self) -> bool {
        matches!(self.kind, kind::POST | kind::PSEUDO)
    }

    /// Three numbers from word `n` on.
    #[inline(always)]
    fn numbers(&self, n: usize) -> Option<[f64; 3]> {
        match self.data.get(n - FIRST_DATA..n - FIRST_DATA + 3)? {
            [Word::Number(x), Word::Number(y), Word::Number(z)] => Some([*x, *y, *z]),
            _ => None,
        }
    }
}
