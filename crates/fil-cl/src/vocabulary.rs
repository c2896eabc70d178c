//! The vocabulary: words, their identities and their integer codes.

/// Identity of a vocabulary word within a run. Two words are the same word
/// exactly when their ids are equal; codes may be shared by two words.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, PartialOrd, Ord)]
pub struct WordId(pub(crate) u32);

impl WordId {
    /// The id as an index, for tables kept beside the vocabulary.
    pub fn index(self) -> usize {
        self.0 as usize
    }
}
