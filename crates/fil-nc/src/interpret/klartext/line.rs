//! A line of Klartext as words: its number, comments and the sign that it goes on are
//! left out.

use std::ops::Range;

use super::super::Fault;
use super::super::program::may_be_skipped;
use crate::errors::NcCode;

/// A word with its place in the line, bytes.
#[derive(Clone, Debug, PartialEq, Eq)]
pub(super) struct Word {
    /// In upper case.
    pub(super) text: String,
    pub(super) range: Range<usize>,
}

impl Word {
    /// The number behind a name: `10` of `X+10` for `X`.
    pub(super) fn value(&self, name: &str) -> Option<Result<f64, Fault>> {
        let rest = self.text.strip_prefix(name)?;
        let starts = rest.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c));
        starts.then(|| {
            rest.parse::<f64>().ok().filter(|value| value.is_finite()).ok_or_else(|| {
                Fault::new(NcCode::BadNumber, format!("`{}`", self.text)).at(&self.range)
            })
        })
    }

    /// The number of an M function.
    pub(super) fn function(&self) -> Result<Option<i64>, Fault> {
        let Some(value) = self.value("M") else { return Ok(None) };
        let value = value?;
        if value.fract() != 0.0 || !(0.0..10_000.0).contains(&value) {
            return Err(self.no_meaning());
        }
        Ok(Some(value as i64))
    }

    pub(super) fn no_meaning(&self) -> Fault {
        Fault::new(NcCode::NoMeaning, format!("`{}`: nothing takes it", self.text)).at(&self.range)
    }
}

/// The words of a line.
#[derive(Clone, Debug, Default, PartialEq, Eq)]
pub(super) struct Line {
    pub(super) words: Vec<Word>,
    /// It goes on with the definition of a cycle: `Q200=+2`.
    pub(super) continues: bool,
    /// It begins with the mark of blocks that may be skipped.
    pub(super) skipped: bool,
}

impl Line {
    pub(super) fn read(text: &[u8]) -> Result<Line, Fault> {
        let code = text.split(|byte| *byte == b';').next().unwrap_or(text);
        let mut line = Line { skipped: may_be_skipped(code), ..Line::default() };
        let mark = code.iter().position(|byte| *byte == b'/').filter(|_| line.skipped);
        let mut at = mark.map_or(0, |mark| mark + 1);
        while at < code.len() {
            let start =
                at + code[at..].iter().take_while(|byte| byte.is_ascii_whitespace()).count();
            let end =
                start + code[start..].iter().take_while(|byte| !byte.is_ascii_whitespace()).count();
            if end > start {
                let text = String::from_utf8_lossy(&code[start..end]).to_ascii_uppercase();
                line.words.push(Word { text, range: start..end });
            }
            at = end;
        }
        line.words.retain(|word| word.text != "~");
        if let Some(last) = line.words.last_mut() {
            last.text = last.text.trim_end_matches('~').to_string();
        }
        let numbered = |word: &Word| word.text.bytes().all(|byte| byte.is_ascii_digit());
        if line.words.first().is_some_and(numbered) {
            line.words.remove(0);
        }
        if line.words.first().is_some_and(|word| word.text.starts_with('*')) {
            line.words.clear();
        }
        line.join();
        line.continues = line.words.first().is_some_and(|word| {
            word.text.strip_prefix('Q').is_some_and(|q| {
                let digits = q.bytes().take_while(u8::is_ascii_digit).count();
                digits > 0 && q[digits..].starts_with('=')
            })
        });
        Ok(line)
    }

    /// Joins a letter and the number behind a blank, and `F MAX`.
    fn join(&mut self) {
        let mut joined: Vec<Word> = Vec::new();
        for word in std::mem::take(&mut self.words) {
            let number = word.text.parse::<f64>().is_ok();
            let open = joined.last().is_some_and(|last| {
                let axis = last.text.len() == 1 && "XYZABCUVWFSR".contains(&last.text);
                let of_arc = last.text == "C" && joined.len() == 1;
                (axis && !of_arc && number)
                    || (last.text == "F" && word.text == "MAX")
                    || (last.text.ends_with('=') && (number || word.text == "MAX"))
            });
            match joined.last_mut().filter(|_| open) {
                Some(last) => {
                    last.text.push_str(&word.text);
                    last.range.end = word.range.end;
                }
                None => joined.push(word),
            }
        }
        self.words = joined;
    }

    pub(super) fn texts(&self) -> Vec<&str> {
        self.words.iter().map(|word| word.text.as_str()).collect()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn read(text: &str) -> String {
        Line::read(text.as_bytes()).unwrap().texts().join("|")
    }

    #[test]
    fn numbers_comments_and_blanks_are_left_out() {
        assert_eq!(read("12 L X+10 Y-2.5 R0 F MAX M3 ; over the hole"), "L|X+10|Y-2.5|R0|FMAX|M3");
        assert_eq!(read("L Z 25.000 FMAX"), "L|Z25.000|FMAX");
        assert_eq!(read("  Q208= MAX ;RETRACTION ~"), "Q208=MAX");
        assert_eq!(read("18 CYCL DEF 203 UNIVERSAL DRILLING~"), "CYCL|DEF|203|UNIVERSAL|DRILLING");
        assert_eq!(read("4 * - heading"), "");
        assert_eq!(read("7 C X+1 Y+2 DR+"), "C|X+1|Y+2|DR+");
    }

    #[test]
    fn lines_that_go_on_are_told() {
        assert!(Line::read(b"  Q200=+2 ;SET-UP CLEARANCE ~").unwrap().continues);
        assert!(!Line::read(b"5 L X+1").unwrap().continues);
    }

    #[test]
    fn the_skip_mark_is_told_and_left_out() {
        for text in ["/12 L X+1", "/ 12 L X+1", " /L X+1"] {
            let line = Line::read(text.as_bytes()).unwrap();
            assert!(line.skipped, "{text}");
            assert_eq!(line.texts(), ["L", "X+1"], "{text}");
        }
        assert!(!Line::read(b"12 L X+1 ; a/b").unwrap().skipped);
    }
}
