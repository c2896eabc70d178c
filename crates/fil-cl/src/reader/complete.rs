//! Is the statement all there?

use fil_diag::Result;

use super::Reader;
use crate::errors::ClCode;
use crate::layout::needs_items;
use crate::record::{Record, Word};
use crate::vocabulary::Vocabulary;

impl Reader<'_> {
    /// Refuses a known word without the items it needs, and a list that ends in a comma
    /// where the dialect writes none: the line after it was perhaps lost.
    pub(super) fn check_complete(&self, vocab: &Vocabulary, record: &Record) -> Result<()> {
        let whole = 0..self.statement.joined.len();
        if record.data.is_empty() && needs_items(record.major) {
            let message = format!("{0} needs items: {0} / item, …", vocab.name(record.major));
            return Err(self.diag(ClCode::MissingItem, &message, whole));
        }
        let ends_in_comma = record.data.last() == Some(&Word::Empty);
        if ends_in_comma && vocab.is_known(record.major) && !self.rules().trailing_comma {
            let message = "nothing follows the last comma";
            let end = self.item_ranges.last().map_or(whole.end, |range| range.start);
            let comma = memchr::memrchr(b',', &self.statement.joined[..end]).unwrap_or(whole.start);
            return Err(self.diag(ClCode::MissingItem, message, comma..comma + 1));
        }
        Ok(())
    }

    /// Refuses a last statement without a line end that may go on: more digits, more items,
    /// more text.
    pub(super) fn check_end(&self, vocab: &Vocabulary, record: &Record) -> Result<()> {
        if !self.lines.is_open() || record.inert {
            return Ok(());
        }
        let is_whole = match record.data.last() {
            None => true,
            Some(Word::Minor(id)) => vocab.is_known(*id),
            Some(_) => false,
        };
        if is_whole {
            return Ok(());
        }
        let whole = 0..self.statement.joined.len();
        let range = self.item_ranges.last().cloned().unwrap_or(whole);
        Err(self.diag(ClCode::LineCutOff, "the file ends within this line", range))
    }
}
