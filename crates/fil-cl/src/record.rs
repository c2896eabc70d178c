//! A CL record and its words as FIL counts them.

use crate::vocabulary::WordId;

/// CLDATA record types: word 2 of a record.
pub mod kind {
    /// A `$$-> KEY / …` pseudo-comment of Creo. Not a CLDATA type: FIL sees such
    /// a record only through a section for its key, and POSTF(14) passes over it.
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
#[derive(Clone, Debug)]
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
}
