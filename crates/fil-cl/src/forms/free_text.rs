//! INSERT of systems that write notes with it, and blocks for the tape.

use crate::errors::ClCode;
use crate::forms::FormError;
use crate::record::Record;
use crate::words;

/// What the text of an INSERT is.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Kind {
    /// A block for the tape.
    Block,
    /// A note for people.
    Note,
    /// Either.
    Unclear,
}

/// Makes an INSERT that holds a note a PPRINT; one that reads as a block stays.
pub(crate) fn insert_or_note(record: &mut Record) -> Result<(), FormError> {
    if record.major != words::INSERT {
        return Ok(());
    }
    match kind(&record.text) {
        Kind::Block => {}
        Kind::Note => record.major = words::PPRINT,
        Kind::Unclear => {
            let message = format!("'{}' may be an NC block or a note", record.text.trim());
            let hint = "write a note as PPRINT / text; --dialect generic writes each INSERT to the program as it is";
            return Err(FormError::new(ClCode::UnclearText, 0, message).hint(hint));
        }
    }
    Ok(())
}

/// Tells blocks from notes. A block holds a G word, or an M word without a word of an axis,
/// and nothing else but words and comments; a note holds something that is no word, and no
/// words that command a machine.
fn kind(text: &str) -> Kind {
    let text = text.trim();
    let text = text.strip_prefix('/').unwrap_or(text);
    if text.is_empty() {
        return Kind::Note;
    }
    if text.starts_with('%') {
        return Kind::Unclear;
    }
    let bare = without_comments(text);
    let mut found = Found::default();
    for part in bare.split_whitespace() {
        found.add(part);
    }
    let commands = found.g || found.m && !found.axis;
    match (found.words, found.others) {
        (false, false) => Kind::Note,
        (true, false) if commands => Kind::Block,
        (_, true) if !(found.g || found.m && found.axis) => Kind::Note,
        _ => Kind::Unclear,
    }
}

/// What the parts of a text are.
#[derive(Default)]
struct Found {
    words: bool,
    others: bool,
    g: bool,
    m: bool,
    axis: bool,
}

impl Found {
    /// Adds a part without blanks.
    fn add(&mut self, part: &str) {
        let Some(letters) = letters_of_words(part) else {
            self.others = true;
            return;
        };
        self.words = true;
        if letters == *b"MX" {
            // The size of a thread, M6x1.0, or a block: the other parts tell.
            return;
        }
        for letter in letters {
            self.g |= letter == b'G';
            self.m |= letter == b'M';
            self.axis |= b"XYZUVWABCIJKRF".contains(&letter);
        }
    }
}

/// The letters of the NC words that a part consists of, in upper case; `None` when it holds
/// anything else.
fn letters_of_words(part: &str) -> Option<Vec<u8>> {
    let bytes = part.as_bytes();
    let mut letters = Vec::new();
    let mut at = 0;
    while at < bytes.len() {
        letters.push(bytes[at].is_ascii_alphabetic().then(|| bytes[at].to_ascii_uppercase())?);
        at += 1;
        if matches!(bytes.get(at), Some(b'+' | b'-')) {
            at += 1;
        }
        let digits = bytes[at..].iter().take_while(|byte| byte.is_ascii_digit() || **byte == b'.');
        let length = digits.count();
        let points = bytes[at..at + length].iter().filter(|byte| **byte == b'.').count();
        if length == points || points > 1 {
            return None;
        }
        at += length;
    }
    Some(letters)
}

/// The text without what stands in parentheses.
fn without_comments(text: &str) -> String {
    let mut depth = 0_usize;
    let outside = text.chars().map(|c| {
        match c {
            '(' => depth += 1,
            ')' if depth > 0 => {
                depth -= 1;
                return ' ';
            }
            _ => {}
        }
        if depth > 0 { ' ' } else { c }
    });
    outside.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn notes_and_blocks() {
        for (text, expected) in [
            ("[HOLDER=C40-32ERP412] 6MM X 60DEG HSS CENTERDRILL", Kind::Note),
            ("14MM CRB 4FL 32 LOC", Kind::Note),
            ("Stock Size X85. Y38. Z48.", Kind::Note),
            ("M6x1.0 TAP", Kind::Note),
            ("", Kind::Note),
            ("(a remark)", Kind::Note),
            ("G53 Z0", Kind::Block),
            ("N10G0G90X0Y0 (home)", Kind::Block),
            ("/ G28 G91 Z0.", Kind::Block),
            ("M8", Kind::Block),
            ("S1200 M3", Kind::Block),
            ("g0 x-.5", Kind::Block),
            ("M10X1.5", Kind::Unclear),
            ("T5", Kind::Unclear),
            ("D10 R2", Kind::Unclear),
            ("G54 FIXTURE", Kind::Unclear),
            ("L Z+100 R0 FMAX M91", Kind::Unclear),
            ("%", Kind::Unclear),
        ] {
            assert_eq!(kind(text), expected, "{text}");
        }
    }
}
