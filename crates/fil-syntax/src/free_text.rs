//! Words that take the rest of their line unquoted: PPRINT and its like, and
//! the file name of INCLUD.

use std::ops::Range;

use crate::token::{FREE_TEXT_WORDS, Token};

/// Raw text found after a word; places are byte offsets from the word's end.
#[derive(Debug, PartialEq)]
pub(crate) struct Found<'s> {
    /// The text, or an empty range where a quoted one follows.
    pub(crate) text: Range<usize>,
    kind: TextKind,
    rest: &'s str,
}

#[derive(Clone, Copy, Debug, PartialEq)]
enum TextKind {
    /// The rest of the line.
    Line,
    /// A file name after `/`.
    File,
    /// A quoted text without the `/` before it.
    QuotedWithoutSlash,
}

impl<'s> Found<'s> {
    /// The tokens this stands for.
    pub(crate) fn tokens(&self) -> Vec<(Token<'s>, Range<usize>)> {
        let slice = &self.rest[self.text.clone()];
        match self.kind {
            TextKind::Line => vec![(Token::FreeText(slice), self.text.clone())],
            TextKind::File => {
                let slash = self.rest.find('/').unwrap_or(0);
                let file = (Token::FileName(slice), self.text.clone());
                vec![(Token::Slash, slash..slash + 1), file]
            }
            TextKind::QuotedWithoutSlash => vec![(Token::Slash, self.text.clone())],
        }
    }

    /// How many bytes of the text are used up.
    pub(crate) fn length(&self) -> usize {
        self.text.end
    }

    /// True for a line of text in which a `;` might be meant to end the statement.
    pub(crate) fn holds_semicolon(&self) -> bool {
        self.kind == TextKind::Line && self.rest[self.text.clone()].contains(';')
    }
}

/// Looks for raw text after a word at the start of a statement. `None` where
/// ordinary tokens follow.
pub(crate) fn after<'s>(word: &str, rest: &'s str) -> Option<Found<'s>> {
    if word.eq_ignore_ascii_case("INCLUD") {
        return file_name(rest);
    }
    let takes_text = FREE_TEXT_WORDS.iter().any(|name| name.eq_ignore_ascii_case(word));
    if takes_text { line_text(rest) } else { None }
}

fn file_name(rest: &str) -> Option<Found<'_>> {
    let slash = skip_blanks(rest, 0);
    if !rest[slash..].starts_with('/') {
        return None;
    }
    let start = skip_blanks(rest, slash + 1);
    let length = rest[start..].find([' ', '\t', '\r', '\n', ';', '$', '\'']);
    let end = length.map_or(rest.len(), |length| start + length);
    (end > start).then_some(Found { text: start..end, kind: TextKind::File, rest })
}

/// The text runs to the end of the line or to a comment. `WORD =` without a
/// second `=` sets a variable; `WORD/'…'`, `WORD/NAME,'…'` and `WORD/(TEXT/…)` are ordinary lists.
fn line_text(rest: &str) -> Option<Found<'_>> {
    let line_end = rest.find(['\r', '\n']).unwrap_or(rest.len());
    let line = &rest[..line_end];
    let line = &line[..line.find("$$").unwrap_or(line.len())];
    if !line.starts_with([' ', '\t', '/']) {
        return None;
    }
    let mut start = skip_blanks(line, 0);
    let slash = line[start..].starts_with('/');
    if slash {
        start = skip_blanks(line, start + 1);
    }
    let text = line[start..].trim_end_matches([' ', '\t', '\x0c', '\x1a']);
    let assigned = !slash && text.starts_with('=') && !text.starts_with("==");
    if text.is_empty() || text == "$" || text.starts_with(';') || assigned {
        return None;
    }
    if text.starts_with('\'') || holds_quoted_item(text) || holds_text_of_parts(text) {
        let found = Found { text: start..start, kind: TextKind::QuotedWithoutSlash, rest };
        return (!slash).then_some(found);
    }
    Some(Found { text: start..start + text.len(), kind: TextKind::Line, rest })
}

/// True for a list of which an item is a text in quotes: `NAME,' X'`.
fn holds_quoted_item(text: &str) -> bool {
    let mut is_quoted = false;
    let items = text.split(|c: char| {
        is_quoted ^= c == '\'';
        c == ',' && !is_quoted
    });
    let mut behind_first = items.map(str::trim).skip(1);
    behind_first.any(|item| item.len() > 1 && item.starts_with('\'') && item.ends_with('\''))
}

/// True where a nested TEXT puts the text together: `(TEXT/'T',…)`, which is no comment.
fn holds_text_of_parts(text: &str) -> bool {
    text.match_indices('(').any(|(at, _)| {
        let behind = text[at + 1..].trim_start();
        let word_end = behind.find(|c: char| !c.is_ascii_alphabetic()).unwrap_or(behind.len());
        let (word, rest) = behind.split_at(word_end);
        word.eq_ignore_ascii_case("TEXT") && rest.trim_start().starts_with('/')
    })
}

/// What stands behind a `;` of a free text where that looks like a statement: a word
/// alone or with what can follow one in a statement.
pub(crate) fn statement_behind_semicolon(text: &str) -> Option<&str> {
    text.split(';').skip(1).map(str::trim).find(|part| looks_like_statement(part))
}

fn looks_like_statement(text: &str) -> bool {
    let is_part = |c: char| c.is_ascii_alphanumeric() || c == '_';
    let word_end = text.find(|c| !is_part(c)).unwrap_or(text.len());
    let (word, rest) = text.split_at(word_end);
    if !word.starts_with(|c: char| c.is_ascii_alphabetic() || c == '_') {
        return false;
    }
    let takes_text = FREE_TEXT_WORDS.iter().any(|name| name.eq_ignore_ascii_case(word));
    let rest = rest.trim_start();
    takes_text || rest.is_empty() || rest.starts_with(['/', '=', '(', ')'])
}

fn skip_blanks(text: &str, from: usize) -> usize {
    from + text[from..].find(|c| c != ' ' && c != '\t').unwrap_or(text.len() - from)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn text_after<'s>(word: &str, rest: &'s str) -> Option<&'s str> {
        after(word, rest).map(|found| &rest[found.text])
    }

    #[test]
    fn the_text_ends_at_the_line_or_a_comment() {
        assert_eq!(text_after("PPRINT", " TOOL 5, R=2 $$ note\nX"), Some("TOOL 5, R=2"));
        assert_eq!(text_after("insert", "/G5 P1\r\n"), Some("G5 P1"));
        assert_eq!(text_after("PPRINT", " == OP 10 =="), Some("== OP 10 =="));
        assert_eq!(text_after("INCLUD", "/sub\\a.fil ; X"), Some("sub\\a.fil"));
    }

    #[test]
    fn a_statement_behind_a_semicolon_is_told_from_a_remark() {
        const STATEMENTS: [&str; 7] = [
            "DMY=POSTF(13)",
            "COOLNT/OFF",
            "stop",
            "IF (A)XX=1",
            "L1) CONTIN",
            "PPRINT done",
            "T(1)=2",
        ];
        for statement in STATEMENTS {
            for text in [format!("A 5 ; {statement}"), format!("A; 1 mm;{statement}; x 1")] {
                assert_eq!(statement_behind_semicolon(&text), Some(statement));
            }
        }
        for text in ["TOOL 5; 10 mm", "G4 P1; (wait)", "A;", "no statement", "A; to be checked"] {
            assert_eq!(statement_behind_semicolon(text), None, "{text}");
        }
    }

    #[test]
    fn ordinary_statements_are_left_alone() {
        for rest in [
            "",
            "=5",
            " = 5",
            "/",
            "(1)=5",
            " ; A=1",
            "/'quoted',T",
            "/(TEXT/CONVI,T,2)",
            "/A,( text /B,2)",
        ] {
            assert_eq!(after("PPRINT", rest), None, "{rest}");
        }
        assert_eq!(after("COOLNT", "/ON"), None);
        assert_eq!(text_after("PPRINT", " 'quoted'"), Some(""));
    }
}
