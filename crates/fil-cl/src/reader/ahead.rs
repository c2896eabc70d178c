//! A look at the beginning of a text, so that its first statements are read by the rules of a
//! dialect whose sign comes after them.

use super::{Options, Reader};
use crate::dialect::Evidence;
use crate::record::Record;
use crate::vocabulary::Vocabulary;

/// Bytes that are looked at. A sign that comes later is found, too, as long as nothing was
/// read that its dialect reads otherwise.
const AHEAD: usize = 64 * 1024;

impl Reader<'_> {
    /// Takes the dialect whose sign stands in the first bytes. What is wrong with their
    /// statements, and an input that fails, is said when they are read.
    pub(super) fn recognize_ahead(&mut self) {
        if self.options.dialect.is_some() || self.is_scout {
            return;
        }
        if self.lines.fill_to(AHEAD).is_err() && self.lines.unread().is_empty() {
            return;
        }
        let unread = self.lines.unread();
        let end = memchr::memrchr(b'\n', unread).map_or(unread.len(), |end| end + 1);
        let options = Options { raw: true, ..self.options };
        let mut scout = Reader::new(&unread[..end], &self.file, options);
        scout.is_scout = true;
        scout.lines.count_from(self.lines.line());
        let (mut vocabulary, mut record) = (Vocabulary::new(), Record::default());
        while scout.recognized().evidence == Evidence::NoSign
            && matches!(scout.read(&mut vocabulary, &mut record), Ok(true))
        {}
        self.recognition = scout.recognition.begun_again();
    }
}
