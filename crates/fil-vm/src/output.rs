//! The macros that a post calls itself: they edit what it writes, or say how it repositions
//! rotary axes. Their names, and what a module has of them.

use crate::module::ChunkId;
use crate::ops::Reg;

/// A macro that the post calls with what it is about to write or to do.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum OutputMacro {
    /// `_OUTPTP`, also `_OUTPUT`: the words of a block.
    Words,
    /// `_MCDWT`: a line of the tape.
    Tape,
    /// `_LSTWT`: a line of the listing.
    Listing,
    /// `_REPOS`: the way out and back at the limit of a rotary axis.
    Reposition,
}

impl OutputMacro {
    /// Names of macros and what they edit.
    pub const NAMES: [(&'static str, OutputMacro); 5] = [
        ("_OUTPTP", OutputMacro::Words),
        ("_OUTPUT", OutputMacro::Words),
        ("_MCDWT", OutputMacro::Tape),
        ("_LSTWT", OutputMacro::Listing),
        ("_REPOS", OutputMacro::Reposition),
    ];

    /// What a macro of this name edits.
    pub fn named(name: &str) -> Option<OutputMacro> {
        Self::NAMES.iter().find(|(known, _)| *known == name).map(|(_, edits)| *edits)
    }

    /// The setting that has the post call it.
    pub fn setting(self) -> &'static str {
        match self {
            OutputMacro::Words => "tape.edit_macro = 1",
            OutputMacro::Tape => "tape.block_macro = 1, or 3 for the listing too",
            OutputMacro::Listing => "tape.block_macro = 2, or 3 for the tape too",
            OutputMacro::Reposition => {
                "repos.feed_method = 0 with repos.retract_distance, on a machine with rotary axes,"
            }
        }
    }
}

/// Which of these macros a machine has the post call.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Edits {
    /// `_OUTPTP`
    pub words: bool,
    /// `_MCDWT`
    pub tape: bool,
    /// `_LSTWT`
    pub listing: bool,
    /// `_REPOS`
    pub reposition: bool,
}

impl Edits {
    /// True for a macro that the post calls.
    pub fn has(self, edits: OutputMacro) -> bool {
        match edits {
            OutputMacro::Words => self.words,
            OutputMacro::Tape => self.tape,
            OutputMacro::Listing => self.listing,
            OutputMacro::Reposition => self.reposition,
        }
    }
}

/// What the parameters of `_REPOS` may be: first what it is given, then what it decides.
pub const REPOSITION: [&str; REPOSITION_GIVEN + 9] = [
    "FROM1", "FROM2", "TO1", "TO2", "TIPX", "TIPY", "TIPZ", "AXISI", "AXISJ", "AXISK", "RETDST",
    "RETFED", "APPDST", "APPFED", "NEWAXS", "SPNOFF", "COLOFF", "OPTSTP", "PRGSTP",
];

/// How many of them a macro is given and must leave as they are.
pub const REPOSITION_GIVEN: usize = 10;

/// The word of a block that a parameter of `_OUTPTP` stands for: `X`; `G` is the first
/// and `G2` the second G.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) struct WordParameter {
    pub letter: u8,
    /// How many words of the letter stand before it.
    pub before: usize,
    pub register: Reg,
}

/// The word that a parameter names; `None` for a name that is no letter with a number.
pub(crate) fn word_named(name: &str) -> Option<(u8, usize)> {
    let (letter, number) = name.split_at_checked(1)?;
    let letter = letter.bytes().next().filter(u8::is_ascii_uppercase)?;
    let number: usize = if number.is_empty() { 1 } else { number.parse().ok()? };
    let several = matches!(letter, b'G' | b'M');
    ((1..=9).contains(&number) && (several || number == 1)).then(|| (letter, number - 1))
}

/// The macros of a module that edit what is written.
#[derive(Clone, Debug, Default)]
pub(crate) struct OutputMacros {
    pub words: Option<(ChunkId, Vec<WordParameter>)>,
    pub tape: Option<(ChunkId, Reg)>,
    pub listing: Option<(ChunkId, Reg)>,
    /// The parameters by their numbers in [`REPOSITION`].
    pub reposition: Option<(ChunkId, Vec<(usize, Reg)>)>,
}

impl OutputMacros {
    /// True when there is none of them.
    pub fn is_empty(&self) -> bool {
        self.words.is_none()
            && self.tape.is_none()
            && self.listing.is_none()
            && self.reposition.is_none()
    }
}

#[cfg(test)]
mod tests {
    use super::word_named;

    #[test]
    fn parameters_name_words() {
        assert_eq!(word_named("X"), Some((b'X', 0)));
        assert_eq!(word_named("G"), Some((b'G', 0)));
        assert_eq!(word_named("M3"), Some((b'M', 2)));
        for name in ["X2", "G0", "XX", "G10", "", "FEED"] {
            assert_eq!(word_named(name), None, "{name}");
        }
    }
}
