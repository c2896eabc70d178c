//! Words that REPEAT adds to motion blocks.

use std::collections::BTreeMap;

use fil_machine::Letter;

use crate::cause::Cause;

/// REPEAT, as it acts on motion blocks.
#[derive(Clone, Debug, Default)]
pub struct Repeats {
    /// Words it adds to each motion block, by letter, with their causes.
    pub words: BTreeMap<Letter, (f64, Cause)>,
    /// Its words in the last motion block, by their letters.
    pub written: Vec<(Letter, f64)>,
    /// Letters whose REPEAT has ended since the last motion.
    pub ended: Vec<Letter>,
}
