//! REPLAC begins and ends, and its texts in a line.

use fil_diag::Result;

use super::{Control, texts};
use crate::errors::PostCode;

impl Control {
    /// Has texts replaced in each line from the next one on.
    ///
    /// # Errors
    /// A character that must not reach the tape.
    pub fn replace(&mut self, old: &str, new: &str) -> Result<()> {
        texts::check(old)?;
        texts::check(new)?;
        self.tape.replaced.add(old, new);
        self.straight = false;
        Ok(())
    }

    /// Ends the replacement of texts, and warns of those that stood nowhere.
    pub fn end_replacing(&mut self) {
        let ended = std::mem::take(&mut self.tape.replaced);
        for old in ended.unfound() {
            let message = format!("REPLAC: '{old}' was in no line");
            self.warnings.add(PostCode::IgnoredPart, message);
        }
    }

    /// A line of the tape with its texts replaced; nothing where only a number is left.
    pub(super) fn with_texts_replaced(&mut self, line: &str) -> String {
        let replaced = self.tape.replaced.apply(line);
        let kept = replaced.trim_end();
        let number = self.tables.numbering.slot.as_ref().map(|slot| slot.character);
        let is_number =
            kept.bytes().next() == number && kept[1..].bytes().all(|b| b.is_ascii_digit());
        if kept.is_empty() || (is_number && kept != line) { String::new() } else { kept.into() }
    }
}
