//! How a finished block is put on the tape: skip mark, case, end of the block, end
//! of the line, longest block.

use fil_text::CodePage;

use crate::commons::Commons;
use crate::locations::{self as loc, TapeBlockMacro, TapeEndOfBlock, TapeLetterCase, TapeLineEnd};

/// The looks of a block. The default is a block as the words make it, with LF.
#[derive(Clone, Debug)]
pub struct TapeStyle {
    /// Nothing is to be done to a block but to end its line with LF.
    pub is_plain: bool,
    /// Before a block that the operator can skip; `None` when the machine has no mark.
    pub skip: Option<char>,
    /// Case of all letters, comments included.
    pub letter_case: TapeLetterCase,
    /// After each block.
    pub end_of_block: Option<char>,
    /// What ends a line.
    pub line_end: TapeLineEnd,
    /// A block may have several preparatory functions.
    pub several_g: bool,
    /// A block may have several auxiliary functions.
    pub several_m: bool,
    /// One of both is false.
    pub divides: bool,
    /// How the bytes of the program are read; texts are kept in UTF-8 until they leave.
    pub page: CodePage,
    /// Most characters of a block, its line end left out, and most bytes in another encoding
    /// than UTF-8; `None` for any number.
    pub longest: Option<usize>,
    /// Someone edits the words of blocks (the macro _OUTPTP).
    pub edits_words: bool,
    /// Someone edits the lines of the tape (the macro _MCDWT).
    pub edits_lines: bool,
}

impl Default for TapeStyle {
    fn default() -> Self {
        TapeStyle {
            is_plain: true,
            skip: Some('/'),
            letter_case: TapeLetterCase::default(),
            end_of_block: None,
            line_end: TapeLineEnd::default(),
            several_g: true,
            several_m: true,
            divides: false,
            page: CodePage::UTF_8,
            longest: None,
            edits_words: false,
            edits_lines: false,
        }
    }
}

impl TapeStyle {
    pub(crate) fn from_commons(commons: &Commons) -> Self {
        let ends = commons.read(loc::TAPE_END_OF_BLOCK) == TapeEndOfBlock::Yes;
        let longest = commons.read(loc::TAPE_MAX_BLOCK).filter(|most| *most > 0);
        let several = [commons.read(loc::MODE_SEVERAL_G), commons.read(loc::MODE_SEVERAL_M)];
        let style = TapeStyle {
            is_plain: false,
            several_g: several[0],
            several_m: several[1],
            divides: several != [true; 2],
            skip: commons.read(loc::TAPE_OPSKIP_CHAR),
            letter_case: commons.read(loc::TAPE_LETTER_CASE),
            end_of_block: commons.read(loc::TAPE_END_OF_BLOCK_CHAR).filter(|_| ends),
            line_end: commons.read(loc::TAPE_LINE_END),
            page: page(commons),
            longest: longest.map(|most| most as usize),
            edits_words: commons.read(loc::TAPE_EDIT_MACRO),
            edits_lines: matches!(
                commons.read(loc::TAPE_BLOCK_MACRO),
                TapeBlockMacro::Tape | TapeBlockMacro::Both
            ),
        };
        let is_plain = style.letter_case == TapeLetterCase::AsWritten
            && style.end_of_block.is_none()
            && style.line_end == TapeLineEnd::Lf
            && style.page.is_utf8()
            && style.longest.is_none();
        TapeStyle { is_plain, ..style }
    }

    /// Brings the letters of a block into the case of the tape and adds what ends it.
    /// `start` is its first byte in `text`.
    pub fn finish(&self, text: &mut Vec<u8>, start: usize) {
        match self.letter_case {
            TapeLetterCase::AsWritten => {}
            TapeLetterCase::Upper => text[start..].make_ascii_uppercase(),
            TapeLetterCase::Lower => text[start..].make_ascii_lowercase(),
        }
        if let Some(end) = self.end_of_block {
            text.extend_from_slice(end.encode_utf8(&mut [0; 4]).as_bytes());
        }
    }

    /// The bytes that end a line.
    pub fn line_end(&self) -> &'static [u8] {
        match self.line_end {
            TapeLineEnd::Lf => b"\n",
            TapeLineEnd::CrLf => b"\r\n",
        }
    }
}

/// The encoding of the programs of a machine.
pub fn page(commons: &Commons) -> CodePage {
    CodePage::numbered(commons.read(loc::TAPE_ENCODING) as u16).unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::locations::Location;

    #[test]
    fn each_encoding_of_the_table_is_a_page_of_that_name() {
        let row = Location::named("tape.encoding").expect("a setting");
        let rows: Vec<(u16, &str)> =
            row.choice_list().into_iter().map(|(number, name)| (number as u16, name)).collect();
        let pages: Vec<(u16, &str)> =
            CodePage::all().map(|page| (page.number(), page.name())).collect();
        let is_whole = CodePage::numbered(932).is_some();
        let here = |row: &(u16, &str)| is_whole || !(932..=950).contains(&row.0);
        assert_eq!(rows.into_iter().filter(here).collect::<Vec<_>>(), pages);
    }
}
