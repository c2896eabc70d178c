//! The POSTF operations: number, signature, meaning and grade in one table.

use std::collections::BTreeMap;

/// How sure the reading of a number or function is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Grade {
    /// Seen in a published script or listing.
    Published,
    /// Inferred from published scripts.
    Inferred,
    /// Our own reading.
    Own,
}

impl Grade {
    /// The letter of the tables in the documentation.
    pub fn letter(self) -> char {
        match self {
            Grade::Published => 'P',
            Grade::Inferred => 'I',
            Grade::Own => 'O',
        }
    }
}

/// A POSTF operation, whatever number calls it.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub enum PostfOp {
    /// Value of a common.
    GetCommon,
    /// Store in a common.
    SetCommon,
    /// Make a common EMPTY.
    ClearCommon,
    /// The EMPTY value.
    Empty,
    /// Number of words in the record.
    Length,
    /// Class of a word.
    Class,
    /// A word of the record.
    Word,
    /// Replace a word.
    SetWord,
    /// Find a minor word.
    Find,
    /// Insert a word.
    Insert,
    /// Delete a word.
    Delete,
    /// Cut or extend the record.
    Resize,
    /// Process the record now.
    Process,
    /// Read the next record.
    Next,
    /// Step back one record.
    Back,
    /// Go to a record by number.
    Seek,
    /// Number of the current record.
    Number,
    /// Save the current record.
    Save,
    /// Restore the saved record.
    Restore,
    /// Development listing on or off.
    Trace,
}

/// A row of the POSTF table.
#[derive(Debug, PartialEq, Eq)]
pub struct PostfInfo {
    /// The operation.
    pub op: PostfOp,
    /// Its number unless a [`Compat`] says otherwise.
    pub number: u16,
    /// Names of the arguments after the number, as a call shows them.
    pub arguments: &'static [&'static str],
    /// What it does.
    pub doc: &'static str,
    /// How sure that is.
    pub grade: Grade,
}

const fn row(
    op: PostfOp,
    number: u16,
    arguments: &'static [&'static str],
    grade: Grade,
    doc: &'static str,
) -> PostfInfo {
    PostfInfo { op, number, arguments, doc, grade }
}

/// All operations, in the order of [`PostfOp`].
pub const POSTF: &[PostfInfo] = &[
    row(
        PostfOp::GetCommon,
        1,
        &["type", "location"],
        Grade::Inferred,
        "value of a common location: type 1 INTCOM, 2 RELCOM, 3 DBLCOM",
    ),
    row(
        PostfOp::SetCommon,
        2,
        &["type", "location", "value"],
        Grade::Published,
        "stores a value in a common location; it acts at once",
    ),
    row(
        PostfOp::ClearCommon,
        3,
        &["type", "location"],
        Grade::Published,
        "makes a common location EMPTY; on DBLCOM 355+n the next value of letter n is written again",
    ),
    row(PostfOp::Empty, 4, &[], Grade::Own, "the EMPTY value, 999999"),
    row(PostfOp::Length, 5, &[], Grade::Own, "number of words in the current record"),
    row(
        PostfOp::Class,
        6,
        &["n"],
        Grade::Own,
        "class of word n of the current record: 0 none, 1 number, 2 minor word, 3 text",
    ),
    row(
        PostfOp::Word,
        7,
        &["n"],
        Grade::Published,
        "word n of the current record: its value, or the code of a minor word; EMPTY past the end",
    ),
    row(
        PostfOp::SetWord,
        8,
        &["n", "value"],
        Grade::Inferred,
        "replaces word n of the current record; a minor word stays one when the value is the code of a minor word",
    ),
    row(
        PostfOp::Find,
        9,
        &["from", "code"],
        Grade::Own,
        "position of the first minor word with that code at or after word `from`, else 0",
    ),
    row(
        PostfOp::Insert,
        10,
        &["n", "value"],
        Grade::Own,
        "inserts a word before word n of the current record",
    ),
    row(PostfOp::Delete, 11, &["n"], Grade::Own, "deletes word n of the current record"),
    row(
        PostfOp::Resize,
        12,
        &["n"],
        Grade::Own,
        "cuts or extends the current record to n words; new words are empty",
    ),
    row(PostfOp::Process, 13, &[], Grade::Inferred, "the post processes the current record now"),
    row(
        PostfOp::Next,
        14,
        &[],
        Grade::Published,
        "reads the next record, which becomes the current one and is consumed; 0, or 1 at the end",
    ),
    row(
        PostfOp::Back,
        15,
        &[],
        Grade::Own,
        "steps back one record; 0, or 1 at the start; needs an input that can go back",
    ),
    row(
        PostfOp::Seek,
        16,
        &["number"],
        Grade::Own,
        "goes to the record of that number; 0, or 1 when there is none; needs an input that can go back",
    ),
    row(PostfOp::Number, 17, &[], Grade::Own, "number of the current record"),
    row(PostfOp::Save, 20, &[], Grade::Inferred, "saves the current record"),
    row(PostfOp::Restore, 21, &[], Grade::Inferred, "makes the saved record the current one again"),
    row(
        PostfOp::Trace,
        24,
        &["on"],
        Grade::Inferred,
        "development listing of FIL activity: 1 on, 0 off",
    ),
];

impl PostfOp {
    /// Its row of the table.
    pub fn info(self) -> &'static PostfInfo {
        &POSTF[self as usize]
    }

    /// The operation at an index of the table, as `Op::Postf` holds it.
    pub(crate) fn from_index(index: u16) -> Option<PostfOp> {
        POSTF.get(index as usize).map(|info| info.op)
    }
}

/// What happens to a record its section neither processed nor replaced.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum SectionMode {
    /// The section takes it: nothing more happens.
    #[default]
    Take,
    /// The post processes it after the section.
    Process,
}

/// Readings a site may correct without a new build.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Compat {
    /// Which number calls which operation.
    pub postf: BTreeMap<u16, PostfOp>,
    /// What happens to a record after its section.
    pub section: SectionMode,
}

impl Default for Compat {
    fn default() -> Self {
        Compat {
            postf: POSTF.iter().map(|info| (info.number, info.op)).collect(),
            section: SectionMode::Take,
        }
    }
}

impl Compat {
    /// The operation of a number as FIL gives it.
    pub fn operation(&self, number: f64) -> Option<PostfOp> {
        let whole = number as u16;
        if f64::from(whole) == number { self.postf.get(&whole).copied() } else { None }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_is_in_the_order_of_the_operations() {
        for (index, info) in POSTF.iter().enumerate() {
            assert_eq!(info.op as usize, index, "{:?}", info.op);
        }
    }

    #[test]
    fn numbers_are_exact() {
        let compat = Compat::default();
        assert_eq!(compat.operation(13.0), Some(PostfOp::Process));
        for number in [13.5, -1.0, 18.0, 65_549.0, f64::NAN] {
            assert_eq!(compat.operation(number), None, "{number}");
        }
    }
}
