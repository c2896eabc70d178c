//! The motions behind a RAPID, for a post that chooses its rotary positions by them.

use fil_cl::record::{kind, motion};
use fil_cl::{Vocabulary, words};
use fil_post::path::Coming;

use crate::source::{Source, changes_tool};

/// Most records that are looked through.
const MOST: usize = 2000;

impl Source<'_> {
    /// The motions behind the current record up to the next RAPID or tool. Nothing is consumed,
    /// and what is wrong with a record is said when it is read.
    pub fn motions_ahead(&mut self, vocabulary: &mut Vocabulary) -> Vec<Coming> {
        let mut coming = Vec::new();
        for index in 0..MOST {
            let Ok(Some(record)) = self.ahead(index, vocabulary) else { break };
            match record.kind {
                kind::MOTION => {
                    let point = record.point().filter(|_| record.sub != motion::GODLTA);
                    coming.push(Coming { point, axis: record.axis() });
                }
                kind::FINI => break,
                _ if record.major == words::RAPID || changes_tool(record) => break,
                _ => {}
            }
        }
        coming
    }
}
