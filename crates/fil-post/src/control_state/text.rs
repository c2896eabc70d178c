//! The small reader of texts that others put on the tape: words of a letter and a
//! number, comments, a skip mark. It is made to say "I can't" rather than guess.

use fil_machine::{FunctionCode, Letter, letters};

/// In which frame the axis words of a text count.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum TextFrame {
    /// In the one before it.
    #[default]
    Stays,
    /// In that of the machine, in this block.
    OfTheMachine,
    /// In one with another zero, which they may say.
    Shifted,
    /// In a frame that may be turned, which they may say.
    Turned,
    /// Nobody has read them all.
    Unread,
}

/// The words of a text.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct TextWords {
    /// The control may skip the block.
    pub skipped: bool,
    /// Letters and numbers in their order.
    pub words: Vec<(Letter, f64)>,
    /// What statements of the text do to the frame.
    pub frame: TextFrame,
}

impl TextWords {
    /// True for `L400`, a SINUMERIK control's call of a subprogram: L without a motion
    /// or cycle that it could repeat.
    pub fn calls_subprogram(&self) -> bool {
        let has = |letter: u8| self.words.iter().any(|(word, _)| word.byte() == letter);
        has(b'L') && !has(b'G') && !has(b'M')
    }
}

/// The preparatory functions among words.
pub fn functions(words: &[(Letter, f64)]) -> impl Iterator<Item = FunctionCode> {
    let of_g = words.iter().filter(|(letter, _)| *letter == letters::G);
    of_g.filter_map(|(_, value)| FunctionCode::of_value(*value))
}

/// Reads a text; `None` for anything but words, comments and blanks (a variable,
/// a statement of the control's language, a word without a number).
pub fn read(text: &str) -> Option<TextWords> {
    let mut found = TextWords::default();
    let mut rest = text.trim();
    if let Some(after) = rest.strip_prefix('/') {
        found.skipped = true;
        rest = after.trim_start_matches(|c: char| c.is_ascii_digit());
    }
    loop {
        rest = rest.trim_start();
        let Some(first) = rest.chars().next() else { return Some(found) };
        if first == ';' {
            // A comment on some controls, the end of a block on others.
            return (!names_function(&rest[1..])).then_some(found);
        }
        if first == '(' {
            rest = &rest[rest.find(')')? + 1..];
            continue;
        }
        if let Some(after) = assignment(rest) {
            rest = after;
            continue;
        }
        let letter = Letter::of_character(first)?;
        let (value, after) = number(rest[1..].trim_start())?;
        found.words.push((letter, value));
        rest = after;
    }
}

/// The words of a text as far as they can be read, its number left out. A variable in place of a
/// number (`S#102`, `S=R5`) is no number (NaN); what can't be read else stands for no word.
pub fn readable_words(text: &str) -> Vec<(Letter, f64)> {
    let mut words = Vec::new();
    let mut rest = text;
    while let Some(first) = rest.chars().next() {
        match first {
            ';' => break,
            '(' => match rest.find(')') {
                Some(end) => rest = &rest[end..],
                None => break,
            },
            _ => {
                let read = || Some((Letter::of_character(first)?, number(rest[1..].trim_start())?));
                if let Some((letter, (value, after))) = read() {
                    words.push((letter, value));
                    rest = after;
                    continue;
                }
                let is_variable = rest[first.len_utf8()..].trim_start().starts_with(['#', '=']);
                if let Some(letter) = Letter::of_character(first).filter(|_| is_variable) {
                    words.push((letter, f64::NAN));
                }
            }
        }
        rest = &rest[rest.chars().next().map_or(0, char::len_utf8)..];
    }
    words.retain(|(letter, _)| *letter != letters::N);
    words
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

    fn words(text: &str) -> Option<String> {
        let found = read(text)?;
        let words = found.words.iter().map(|(letter, value)| format!("{letter}{value}"));
        Some(words.collect::<Vec<_>>().join(" "))
    }

    #[test]
    fn words_are_read_packed_and_apart() {
        assert_eq!(words("G90G80G40G00").unwrap(), "G90 G80 G40 G0");
        assert_eq!(words(" g 91 (a G90) x-1.5 ;").unwrap(), "G91 X-1.5");
        assert_eq!(words("M3 S1000 ; spindle on").unwrap(), "M3 S1000");
        assert_eq!(words("M8;G91"), None);
        assert_eq!(words("N10 M98 P+100").unwrap(), "N10 M98 P100");
        assert_eq!(words("(only a comment)").unwrap(), "");
        assert_eq!(words("R101=0.123 R5=-1. #100=5 X1").unwrap(), "X1");
        assert!(read("/2 M8").unwrap().skipped);
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
            assert_eq!(read(text), None, "{text}");
        }
    }
}
