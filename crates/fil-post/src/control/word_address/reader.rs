//! The small reader of texts that others put on the tape: words of a letter and a
//! number, comments, a skip mark. It is made to say "I can't" rather than guess.

use fil_machine::{Letter, letters};

use crate::control_state::ForeignBlock;

/// Reads a text. Anything but words, comments and blanks can't be read (a variable, a statement of
/// the control's language, a word without a number); the words behind it are read on.
pub fn read(text: &str) -> ForeignBlock {
    let mut block = ForeignBlock::default();
    let mut rest = text.trim();
    if let Some(after) = rest.strip_prefix('/') {
        block.skipped = true;
        rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
    }
    loop {
        rest = rest.trim_start();
        let Some(first) = rest.chars().next() else { return block };
        if first == ';' {
            // A comment on some controls, the end of a block on others.
            if names_function(&rest[1..]) {
                block.cannot_read(rest);
            }
            return block;
        }
        if first == '(' {
            let Some(end) = rest.find(')') else {
                block.cannot_read(rest);
                return block;
            };
            rest = &rest[end + 1..];
            continue;
        }
        if let Some(after) = assignment(rest) {
            rest = after;
            continue;
        }
        let behind = &rest[first.len_utf8()..];
        let letter = Letter::of_character(first);
        match letter.zip(number(behind.trim_start())) {
            Some((letter, (value, after))) => {
                block.words.push((letter, value));
                rest = after;
            }
            None => {
                block.cannot_read(rest);
                let is_variable = behind.trim_start().starts_with(['#', '=']);
                block.words.extend(letter.filter(|_| is_variable).map(|it| (it, f64::NAN)));
                rest = behind;
            }
        }
        if block.words.last().is_some_and(|(letter, _)| *letter == letters::N) {
            block.words.pop();
        }
    }
}

/// True for a text with something like G91 or M98 in it.
fn names_function(text: &str) -> bool {
    let mut pairs = text.chars().zip(text.chars().skip(1));
    pairs.any(|(letter, next)| "GMgm".contains(letter) && next.is_ascii_digit())
}

/// Variables from this number on are the control's own: tool offsets, work offsets, positions.
const SYSTEM_VARIABLES: u32 = 1000;

/// What comes after `R101=0.5` or `#101=0.5`: a parameter gets a value, and no mode
/// and no axis is touched.
fn assignment(text: &str) -> Option<&str> {
    let rest = text.strip_prefix(['R', 'r', '#'])?;
    let digits = rest.find(|c: char| !c.is_ascii_digit()).filter(|digits| *digits > 0)?;
    let number_of_variable: u32 = rest[..digits].parse().ok()?;
    if text.starts_with('#') && number_of_variable >= SYSTEM_VARIABLES {
        return None;
    }
    let value = rest[digits..].trim_start().strip_prefix('=')?;
    number(value.trim_start()).map(|(_, after)| after)
}

/// The number at the start of a text, and what comes after it.
fn number(text: &str) -> Option<(f64, &str)> {
    let sign = usize::from(text.starts_with(['+', '-']));
    let digits = text[sign..].find(|c: char| !c.is_ascii_digit() && c != '.');
    let end = digits.map_or(text.len(), |length| sign + length);
    Some((text[..end].parse().ok()?, &text[end..]))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The words of a text; `None` where it can't be read whole.
    fn words(text: &str) -> Option<String> {
        let found = read(text);
        let words = found.words.iter().map(|(letter, value)| format!("{letter}{value}"));
        found.unread.is_none().then(|| words.collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn words_are_read_packed_and_apart() {
        assert_eq!(words("G90G80G40G00").unwrap(), "G90 G80 G40 G0");
        assert_eq!(words(" g 91 (a G90) x-1.5 ;").unwrap(), "G91 X-1.5");
        assert_eq!(words("M3 S1000 ; spindle on").unwrap(), "M3 S1000");
        assert_eq!(words("M8;G91"), None);
        assert_eq!(words("N10 M98 P+100").unwrap(), "M98 P100");
        assert_eq!(words("(only a comment)").unwrap(), "");
        assert_eq!(words("R101=0.123 R5=-1. #100=5 X1").unwrap(), "X1");
        assert!(read("/2 M8").skipped);
    }

    #[test]
    fn what_is_not_words_is_not_read() {
        for text in [
            "#100=#101",
            "R1=R2+1",
            "G1 X#101",
            "GOTO 100",
            "(open",
            "CYCLE83(1)",
            "G",
            "X1=10",
            "G1.2.3",
        ] {
            assert_eq!(words(text), None, "{text}");
        }
    }
}
