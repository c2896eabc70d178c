//! NC text to blocks of words, for any control whose words are a letter and a
//! number.
//!
//! One line is one block. Read are `N10 G1 X-.5`, `G1X5.Y6.` packed, `R1=15.6`
//! (an indexed address), `/` block skip, `(comment)` and `; comment`, and lines
//! that begin with `%`. What is none of these is refused.

use std::ops::Range;

use fil_diag::{Diag, TextSpan};

use crate::errors::NcCode;

/// Digits a number may have in all; more would not fit its exact form.
const MAX_DIGITS: u32 = 18;

/// Powers of ten, all of them exact.
static POWERS: [f64; MAX_DIGITS as usize + 1] = [
    1e0, 1e1, 1e2, 1e3, 1e4, 1e5, 1e6, 1e7, 1e8, 1e9, 1e10, 1e11, 1e12, 1e13, 1e14, 1e15, 1e16,
    1e17, 1e18,
];

/// What some editors put before the first line.
const BYTE_ORDER_MARK: &[u8] = b"\xef\xbb\xbf";

/// A number exactly as written.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Number {
    /// All digits as one whole number, with the sign.
    pub digits: i64,
    /// A minus sign is written, before zero too: on a rotary axis it can be the way round.
    pub minus: bool,
    /// Digits after the point.
    pub decimals: u8,
    /// How many digits are written before the point, leading zeros too.
    pub whole: u8,
    /// A point is written.
    pub point: bool,
}

impl Number {
    /// The value as a human reads it; zero keeps its sign.
    pub fn value(self) -> f64 {
        if self.digits == 0 && self.minus {
            return -0.0;
        }
        let power = POWERS.get(usize::from(self.decimals)).copied();
        self.digits as f64 / power.unwrap_or_else(|| libm::pow(10.0, self.decimals.into()))
    }
}

/// A letter and its number.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Word {
    /// The address, `A` to `Z`.
    pub letter: u8,
    /// The index of an indexed address: 1 in `R1=15.6`.
    pub index: Option<u32>,
    /// What it is given.
    pub number: Number,
    /// It is given the end of the travel of its axis: `Z=VPSLZ` of an OSP, whose number is no number.
    pub of_travel: bool,
    /// Where in the line, bytes.
    pub range: Range<usize>,
}

/// A line of an NC program.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub struct Block {
    /// Line of the file, 1-based.
    pub line: u32,
    /// Begins with `/`: left out when the operator asks for it.
    pub skip: bool,
    /// Begins with `%`: start or end of the tape; the rest of the line is no word.
    pub tape_mark: bool,
    /// The words in order; the sequence number is one of them.
    pub words: Vec<Word>,
    /// Comments without their brackets.
    pub comments: Vec<String>,
    /// What is no word of a letter, in a language that has more than words.
    pub statement: Option<String>,
}

impl Block {
    /// The last word of a letter.
    pub fn word(&self, letter: u8) -> Option<&Word> {
        self.words.iter().rev().find(|word| word.letter == letter && word.index.is_none())
    }

    /// The number of the `N` word.
    pub fn sequence_number(&self) -> Option<i64> {
        self.word(b'N').map(|word| word.number.value() as i64)
    }
}

/// Reads a line; `name` and `line` are for messages.
///
/// # Errors
/// [`NcCode`] with the place of what can't be read.
pub fn read_block(text: &[u8], name: &str, line: u32) -> Result<Block, Box<Diag>> {
    let mut block = Block::default();
    read_block_into(&mut block, text, name, line)?;
    Ok(block)
}

/// The same into a block whose memory is used again; after an error its content
/// means nothing.
///
/// # Errors
/// As [`read_block`].
pub fn read_block_into(
    block: &mut Block,
    text: &[u8],
    name: &str,
    line: u32,
) -> Result<(), Box<Diag>> {
    let mut scan = Scan { text, at: 0, name, line };
    (block.line, block.skip, block.tape_mark) = (line, false, false);
    block.words.clear();
    block.comments.clear();
    block.statement = None;
    if line == 1 && text.starts_with(BYTE_ORDER_MARK) {
        scan.at = BYTE_ORDER_MARK.len();
    }
    scan.blanks();
    if scan.peek() == Some(b'%') {
        block.tape_mark = true;
        return Ok(());
    }
    if scan.peek() == Some(b'/') {
        block.skip = true;
        scan.at += 1;
    }
    loop {
        scan.blanks();
        if let Some(sign) = scan.message_sign(block) {
            scan.refuse_words_in_message(sign)?;
            scan.at += sign - 1;
            block.comments.push(scan.rest());
            return Ok(());
        }
        match scan.peek() {
            None => return Ok(()),
            Some(b'(') => block.comments.push(scan.bracket()?),
            Some(b';') => block.comments.push(scan.rest()),
            Some(letter) if letter.is_ascii_alphabetic() => block.words.push(scan.word()?),
            Some(_) => return Err(scan.refuse(NcCode::NotAWord, scan.at)),
        }
    }
}

struct Scan<'t> {
    text: &'t [u8],
    at: usize,
    name: &'t str,
    line: u32,
}

impl Scan<'_> {
    fn peek(&self) -> Option<u8> {
        self.text.get(self.at).copied()
    }

    fn blanks(&mut self) {
        while self.peek().is_some_and(|byte| byte.is_ascii_whitespace()) {
            self.at += 1;
        }
    }

    /// A line that is a text for the operator on controls of other systems: `MSG("text")`,
    /// `!text`, `* - text`; a control that does not know it stops there. Gives the length of
    /// its sign.
    fn message_sign(&self, block: &Block) -> Option<usize> {
        let rest = &self.text[self.at..];
        if !matches!(rest.first(), Some(b'M' | b'!' | b'*')) {
            return None;
        }
        let sign = [&b"MSG("[..], b"!", b"* -"].into_iter().find(|sign| rest.starts_with(sign));
        sign.filter(|_| block.words.iter().all(|word| word.letter == b'N')).map(<[u8]>::len)
    }

    /// Refuses a message that other controls carry out as words: `! G0 Z-50.`, or words behind
    /// `MSG("text")`.
    fn refuse_words_in_message(&self, sign: usize) -> Result<(), Box<Diag>> {
        let text = &self.text[self.at + sign..];
        let has_words = match text.iter().rposition(|byte| *byte == b')') {
            Some(end) if self.peek() == Some(b'M') => !text[end + 1..].trim_ascii().is_empty(),
            _ => read_block(text, self.name, self.line).is_ok_and(|block| !block.words.is_empty()),
        };
        if has_words { Err(self.refuse(NcCode::NotAWord, self.at)) } else { Ok(()) }
    }

    /// `(comment)`.
    fn bracket(&mut self) -> Result<String, Box<Diag>> {
        let start = self.at + 1;
        let Some(length) = self.text[start..].iter().position(|byte| *byte == b')') else {
            return Err(self.refuse(NcCode::OpenComment, self.at));
        };
        self.at = start + length + 1;
        Ok(String::from_utf8_lossy(&self.text[start..start + length]).into_owned())
    }

    /// `; comment` to the end of the line.
    fn rest(&mut self) -> String {
        let start = std::mem::replace(&mut self.at, self.text.len()) + 1;
        String::from_utf8_lossy(&self.text[start..]).trim().to_string()
    }

    /// A letter, its index with `=` where it has one, and its number.
    fn word(&mut self) -> Result<Word, Box<Diag>> {
        let start = self.at;
        let letter = self.text[start].to_ascii_uppercase();
        self.at += 1;
        self.blanks();
        if let Some(number) = self.end_of_travel(letter) {
            let range = start..self.at;
            return Ok(Word { letter, index: None, number, of_travel: true, range });
        }
        let first = self.number(start)?;
        if self.peek() != Some(b'=') {
            let range = start..self.at;
            return Ok(Word { letter, index: None, number: first, of_travel: false, range });
        }
        self.at += 1;
        let index = u32::try_from(first.digits).ok().filter(|_| !first.point);
        let index = index.ok_or_else(|| self.refuse(NcCode::BadNumber, start))?;
        let number = self.number(start)?;
        Ok(Word { letter, index: Some(index), number, of_travel: false, range: start..self.at })
    }

    /// `=VPSLZ` behind `Z`: the system variable of an OSP for the positive end of the travel. Where it
    /// lies no program says.
    fn end_of_travel(&mut self, letter: u8) -> Option<Number> {
        let rest = self.text[self.at..].strip_prefix(b"=VPSL")?.strip_prefix(&[letter])?;
        if rest.first().is_some_and(u8::is_ascii_alphanumeric) {
            return None;
        }
        self.at = self.text.len() - rest.len();
        Some(Number { digits: 0, minus: false, decimals: 0, whole: 0, point: false })
    }

    fn number(&mut self, start: usize) -> Result<Number, Box<Diag>> {
        let negative = self.peek() == Some(b'-');
        if matches!(self.peek(), Some(b'-' | b'+')) {
            self.at += 1;
        }
        let (mut digits, mut whole, mut decimals, mut point) = (0i64, 0u32, 0u32, false);
        let mut length = 0;
        for byte in &self.text[self.at..] {
            match byte {
                b'.' if !point => point = true,
                b'0'..=b'9' if whole + decimals == MAX_DIGITS => {
                    self.at += length;
                    return Err(self.refuse(NcCode::BadNumber, start));
                }
                b'0'..=b'9' => {
                    digits = digits * 10 + i64::from(byte - b'0');
                    *(if point { &mut decimals } else { &mut whole }) += 1;
                }
                _ => break,
            }
            length += 1;
        }
        self.at += length;
        if whole + decimals == 0 || self.peek() == Some(b'.') {
            return Err(self.refuse(NcCode::BadNumber, start));
        }
        let digits = if negative { -digits } else { digits };
        let (decimals, whole) = (decimals as u8, whole as u8);
        Ok(Number { digits, minus: negative, decimals, whole, point })
    }

    /// A refusal of what stands from `start` up to where the reader is.
    fn refuse(&self, code: NcCode, start: usize) -> Box<Diag> {
        let (head, tail) = self.text.split_at(start);
        let shown = &tail[..(self.at + 1 - start).clamp(1, tail.len().max(1)).min(tail.len())];
        let shown = String::from_utf8_lossy(shown).trim_end().to_string();
        let from = String::from_utf8_lossy(head).len();
        let mut place = TextSpan::line(self.name, self.line, String::from_utf8_lossy(self.text));
        place.span = from..(from + shown.len()).min(place.excerpt.len());
        Box::new(Diag::new(code, format!("`{shown}`")).at(place))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use proptest::prelude::*;

    fn read(text: &str) -> Block {
        read_block(text.as_bytes(), "test", 1).unwrap()
    }

    fn values(text: &str) -> Vec<(char, f64)> {
        let words = read(text).words;
        words.iter().map(|word| (word.letter.into(), word.number.value())).collect()
    }

    #[test]
    fn packed_and_spaced_words_are_the_same() {
        assert_eq!(values("N10G1X-.5Y6."), values("N10 G1 X-.5 Y 6."));
        assert_eq!(values("n10g1x-.5 y+6."), [('N', 10.0), ('G', 1.0), ('X', -0.5), ('Y', 6.0)]);
    }

    #[test]
    fn a_number_keeps_how_it_is_written() {
        let number = read("X-007.50").words[0].number;
        assert_eq!(
            number,
            Number { digits: -750, minus: true, decimals: 2, whole: 3, point: true }
        );
    }

    #[test]
    fn comments_marks_and_indexed_addresses() {
        let block = read("/N5 R1=15.622 (a tool) ; the rest");
        assert!(block.skip);
        assert_eq!(block.comments, ["a tool", "the rest"]);
        assert_eq!(block.words[1].index, Some(1));
        assert_eq!(block.words[1].number.value(), 15.622);
        assert_eq!(block.sequence_number(), Some(5));
        assert!(read("% O100").tape_mark);
    }

    #[test]
    fn messages_of_other_systems_are_comments() {
        for text in ["MSG(\"TURN THE PART\")", "N5 MSG(\"X1.\")", "!turn", "* - turn the part"] {
            let block = read(text);
            assert_eq!(block.comments.len(), 1, "{text}");
            assert!(block.words.iter().all(|word| word.letter == b'N'), "{text}");
        }
        assert!(read_block(b"G1 MSG(a)", "test", 1).is_err());
        for text in ["! G0 Z-50.", "!M5", "* - G0 Z-10.", "MSG(\"x\") G0 Z-50."] {
            assert!(read_block(text.as_bytes(), "test", 1).is_err(), "{text}");
        }
    }

    #[test]
    fn what_is_no_word_is_refused_with_its_place() {
        for (text, code, column) in [
            ("G1 X", "E0902", 4),
            ("G1 X1.2.3", "E0902", 4),
            ("G1 X-", "E0902", 4),
            ("G1 (open", "E0903", 4),
            ("G1 ?", "E0901", 4),
            ("X12345678901234567890", "E0902", 1),
        ] {
            let diag = read_block(text.as_bytes(), "test", 3).unwrap_err();
            assert_eq!(diag.code.name(), code, "{text}");
            assert_eq!(diag.spans[0].column(), column, "{text}");
        }
    }

    proptest! {
        #[test]
        fn any_bytes_never_panic(bytes in proptest::collection::vec(any::<u8>(), 0..60)) {
            let _ = read_block(&bytes, "test", 1);
        }
    }
}
