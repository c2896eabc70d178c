//! The tool axes of the motions behind a RAPID, for a post that chooses its rotary positions by
//! them.

use fil_cl::{Vocabulary, record::kind, words};

use crate::source::{Source, changes_tool};

/// Most records that are looked through.
const MOST: usize = 2000;

impl Source<'_> {
    /// Tool axes of the motions behind the current record up to the next RAPID or tool; `None`
    /// for a motion that keeps the one before. Nothing is consumed, and what is wrong with a
    /// record is said when it is read.
    pub fn axes_ahead(&mut self, vocabulary: &mut Vocabulary) -> Vec<Option<[f64; 3]>> {
        let mut axes = Vec::new();
        for index in 0..MOST {
            let Ok(Some(record)) = self.ahead(index, vocabulary) else { break };
            match record.kind {
                kind::MOTION => axes.push(record.axis()),
                kind::FINI => break,
                _ if record.major == words::RAPID || changes_tool(record) => break,
                _ => {}
            }
        }
        axes
    }
}
