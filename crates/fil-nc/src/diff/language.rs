//! Lines of the three families of controls as blocks: words, and a statement for what is
//! no word of a letter (`TOOL CALL 5 Z`, `MCALL CYCLE81(…)`).

use std::ops::Range;

use fil_diag::Diag;

use crate::dialect::Family;
use crate::interpret::sinumerik_words;
use crate::interpret::sinumerik_words::Value;
use crate::text::{Block, Number, Word, read_block_into};

/// Decimals of the exact form of a number.
const DECIMALS: u8 = 6;

/// Reads a line of a family of controls into a block whose memory is used again.
///
/// # Errors
/// What can't be read.
pub(super) fn read_into(
    family: Family,
    block: &mut Block,
    line: &[u8],
    name: &str,
    number: u32,
) -> Result<(), Box<Diag>> {
    match family {
        Family::WordAddress => return read_block_into(block, line, name, number),
        Family::Klartext => *block = klartext(line, number),
        Family::Sinumerik => *block = sinumerik(line, name, number)?,
    }
    Ok(())
}

/// `12 L X+10 R0 FMAX M3 ; over the hole`: axes, F and M are words, FMAX and its lack are
/// rapid and feed, R0, RL and RR are compensation; all else is the statement.
fn klartext(line: &[u8], number: u32) -> Block {
    let text = String::from_utf8_lossy(line).trim_end().to_string();
    let (code, comment) = match text.split_once(';') {
        Some((code, comment)) => (code.to_string(), Some(comment.trim().to_string())),
        None => (text, None),
    };
    let mut block = Block { line: number, ..Block::default() };
    block.comments.extend(comment.filter(|comment| comment.trim_end_matches('~').trim() != ""));
    let mut items = items(&code);
    if items.first().is_some_and(|(text, _)| text.bytes().all(|byte| byte.is_ascii_digit())) {
        let (text, range) = items.remove(0);
        let digits = text.parse().unwrap_or(0);
        let number = Number { digits, minus: digits < 0, decimals: 0, whole: 1, point: false };
        block.words.push(Word { letter: b'N', index: None, number, of_travel: false, range });
    }
    let head = items.first().map_or(String::new(), |(text, _)| text.clone());
    let moves = matches!(head.as_str(), "L" | "C" | "CC" | "CR" | "CP" | "CT")
        || head.starts_with('M') && word(b'M', &head[1..], &(0..0)).is_some();
    let mut statement = Vec::new();
    let rapid = items.iter().any(|(text, _)| text == "FMAX");
    for (at, (text, range)) in items.iter().enumerate() {
        if !moves {
            statement.push(text.trim_end_matches('~').to_string());
            continue;
        }
        match text.as_str() {
            "L" if at == 0 && rapid => {}
            "L" if at == 0 && items.len() > 1 => block.words.extend(word(b'G', "1", range)),
            "FMAX" => block.words.extend(word(b'G', "0", range)),
            "R0" => block.words.extend(word(b'G', "40", range)),
            "RL" => block.words.extend(word(b'G', "41", range)),
            "RR" => block.words.extend(word(b'G', "42", range)),
            _ => {
                let first = text.as_bytes()[0];
                // The coordinates of a pole are those of no position.
                let letter = match (head.as_str(), first) {
                    ("CC", b'X') => b'I',
                    ("CC", b'Y') => b'J',
                    ("CC", b'Z') => b'K',
                    _ => first,
                };
                let known = b"XYZABCUVWFMR".contains(&first) && !(at == 0 && head == "C");
                match text.get(1..).and_then(|rest| word(letter, rest, range)).filter(|_| known) {
                    Some(word) => block.words.push(word),
                    None => statement.push(text.clone()),
                }
            }
        }
    }
    let statement = statement.join(" ");
    block.statement = Some(statement).filter(|text| !text.is_empty());
    block
}

/// Items between blanks in upper case, with their bytes in the line.
fn items(code: &str) -> Vec<(String, Range<usize>)> {
    let mut items = Vec::new();
    let mut start = None;
    for (at, c) in code.char_indices().chain([(code.len(), ' ')]) {
        match (c.is_whitespace(), start) {
            (false, None) => start = Some(at),
            (true, Some(from)) => {
                items.push((code[from..at].to_ascii_uppercase(), from..at));
                start = None;
            }
            _ => {}
        }
    }
    items.retain(|(text, _)| text != "~");
    items
}

/// A word of a number as it is written; `None` for another text.
fn word(letter: u8, text: &str, range: &Range<usize>) -> Option<Word> {
    let value: f64 = text.parse().ok().filter(|value: &f64| value.is_finite())?;
    text.starts_with(|c: char| c.is_ascii_digit() || "+-.".contains(c)).then(|| Word {
        letter,
        index: None,
        number: exact(value),
        of_travel: false,
        range: range.clone(),
    })
}

fn exact(value: f64) -> Number {
    let digits = (value * libm::exp10(DECIMALS.into())).round() as i64;
    Number { digits, minus: value.is_sign_negative(), decimals: DECIMALS, whole: 1, point: true }
}

/// Words of a SINUMERIK: `CR=` is the radius, `X1=` a word with an index, calls and
/// what has no number are the statement.
fn sinumerik(line: &[u8], name: &str, number: u32) -> Result<Block, Box<Diag>> {
    let mut block = Block { line: number, ..Block::default() };
    let text = String::from_utf8_lossy(line).trim_end().to_string();
    let trimmed = text.trim_start();
    if trimmed.starts_with('%') || trimmed.starts_with(";$") {
        block.statement = Some(trimmed.to_string());
        return Ok(block);
    }
    block.skip = trimmed.starts_with('/');
    block.comments.extend(comment(&text));
    let placed = |fault: crate::interpret::Fault| fault.place(name, number, line);
    block.words.extend(sequence_number(&text));
    let mut statement = Vec::new();
    for one in sinumerik_words::read(line).map_err(placed)? {
        let (letters, index) =
            one.name.split_at(one.name.bytes().take_while(u8::is_ascii_alphabetic).count());
        let address = match letters {
            "CR" => Some((b'R', None)),
            _ if letters.len() == 1 => {
                let index = Some(index).filter(|index| !index.is_empty());
                Some((letters.as_bytes()[0], index.and_then(|index| index.parse().ok())))
            }
            _ => None,
        };
        match (address, &one.value) {
            (Some((letter, index)), Some(Value::Number(value))) => {
                let number = exact(*value);
                block.words.push(Word {
                    letter,
                    index,
                    number,
                    of_travel: false,
                    range: one.range,
                });
            }
            _ => {
                let text = text.get(one.range.clone()).unwrap_or(&one.name);
                statement.push(text.split_whitespace().collect::<String>().to_ascii_uppercase());
            }
        }
    }
    block.statement = Some(statement.join(" ")).filter(|text| !text.is_empty());
    Ok(block)
}

/// The comment behind `;`, outside of texts.
fn comment(text: &str) -> Option<String> {
    let mut quoted = false;
    let at = text.find(|c| {
        quoted ^= c == '"';
        c == ';' && !quoted
    })?;
    Some(text[at + 1..].trim().to_string())
}

fn sequence_number(text: &str) -> Option<Word> {
    let from = text.len() - text.trim_start_matches(['/', ' ']).len();
    let rest = text[from..].strip_prefix(['N', 'n'])?;
    let digits = rest.bytes().take_while(u8::is_ascii_digit).count();
    let number = Number {
        digits: rest[..digits].parse().ok()?,
        minus: false,
        decimals: 0,
        whole: 1,
        point: false,
    };
    let range = from..from + 1 + digits;
    Some(Word { letter: b'N', index: None, number, of_travel: false, range })
}

/// True for statements that differ in nothing but numbers within the tolerance.
pub(super) fn same_statement(one: &str, two: &str, tolerance: f64) -> bool {
    let (one, two) = (parts(one), parts(two));
    one.len() == two.len()
        && one.iter().zip(&two).all(|pair| match pair {
            (Part::Number(one), Part::Number(two)) => (one - two).abs() <= tolerance + 1e-9,
            (one, two) => one == two,
        })
}

#[derive(Debug, PartialEq)]
enum Part<'t> {
    Text(&'t str),
    Number(f64),
}

/// A statement as texts and the numbers between them. A number that belongs to a name
/// (`CYCLE81`, `Q200`) is part of it.
fn parts(text: &str) -> Vec<Part<'_>> {
    let mut parts = Vec::new();
    let (mut from, mut at) = (0, 0);
    let bytes = text.as_bytes();
    while let Some(letter) = text[at..].chars().next() {
        let named = at > 0 && bytes[at - 1].is_ascii_alphanumeric();
        let end = at
            + bytes[at..].iter().take_while(|b| b.is_ascii_digit() || b"+-.".contains(b)).count();
        match text[at..end].parse::<f64>() {
            Ok(value) if end > at && !named => {
                parts.push(Part::Text(&text[from..at]));
                parts.push(Part::Number(value));
                (from, at) = (end, end);
            }
            _ => at = end.max(at + letter.len_utf8()),
        }
    }
    parts.push(Part::Text(&text[from..]));
    parts
}

#[cfg(test)]
mod tests {
    use super::*;

    fn said(family: Family, text: &str) -> (String, Option<String>) {
        let mut block = Block::default();
        read_into(family, &mut block, text.as_bytes(), "a", 1).unwrap();
        let words = block.words.iter().map(|word| {
            let index = word.index.map_or(String::new(), |index| format!("{index}="));
            format!("{}{index}{}", char::from(word.letter), word.number.value())
        });
        (words.collect::<Vec<_>>().join(" "), block.statement)
    }

    #[test]
    fn letters_that_are_no_ascii_stand_anywhere() {
        assert!(same_statement("CYCLE81(ü5,0)", "CYCLE81(ü5.,0)", 0.0));
        assert!(!same_statement("CYCLE81(ü5,0)", "CYCLE81(ö5,0)", 0.0));
        let (words, statement) = said(Family::Klartext, "L X+1 ü+3");
        assert_eq!((words.as_str(), statement.as_deref()), ("G1 X1", Some("ü+3")));
    }

    #[test]
    fn lines_of_klartext_are_words_and_statements() {
        let read = |text: &str| said(Family::Klartext, text);
        assert_eq!(read("7 L X+10 Y-2.5 R0 FMAX M3"), ("N7 X10 Y-2.5 G40 G0 M3".into(), None));
        assert_eq!(read("8 CC X+1 Y+2"), ("N8 I1 J2".into(), Some("CC".into())));
        assert_eq!(read("9 C X+1 DR-"), ("N9 X1".into(), Some("C DR-".into())));
        assert_eq!(read("5 TOOL CALL 3 Z S900"), ("N5".into(), Some("TOOL CALL 3 Z S900".into())));
        assert_eq!(read("  Q200=+2 ;SET-UP ~"), (String::new(), Some("Q200=+2".into())));
    }

    #[test]
    fn blocks_of_a_sinumerik_are_words_and_statements() {
        let read = |text: &str| said(Family::Sinumerik, text);
        assert_eq!(read("N10 G3 X1=5 Y2 CR=4 ; A"), ("N10 G3 X1=5 Y2 R4".into(), None));
        let call = "MCALL CYCLE81(5,0,1,-3)";
        assert_eq!(read("N20 MCALL CYCLE81(5, 0,1,-3)"), ("N20".into(), Some(call.into())));
        assert_eq!(read("T=\"A\" M6"), ("M6".into(), Some("T=\"A\"".into())));
    }

    /// What the comparison of two programs says.
    fn compared(one: &str, two: &str) -> Vec<String> {
        let options = super::super::Options::default();
        let read = |text: &str| super::super::read(text.as_bytes(), "a", &options).unwrap();
        let (one, two) = (read(one), read(two));
        let found = super::super::compare(&one, &two, &options).unwrap();
        let sentence = |one_of: &_| super::super::sentence(one_of, &one, &two);
        found.differences.iter().map(sentence).collect()
    }

    #[test]
    fn programs_of_each_language_are_compared() {
        let klartext = "0 BEGIN PGM A MM\n1 TOOL CALL 3 Z\n2 L X+10 Y+5 R0 FMAX\n\
                        3 L Z-5 F100\n4 END PGM A MM\n";
        assert_eq!(compared(klartext, klartext), Vec::<String>::new());
        let deeper = klartext.replace("Z-5", "Z-6").replace("CALL 3", "CALL 4");
        assert_eq!(
            compared(klartext, &deeper),
            [
                "block N1: `TOOL CALL 4 Z` instead of `TOOL CALL 3 Z`",
                "block N3: Z deeper by 1 (-6 instead of -5)"
            ]
        );
        let siemens = "%_N_A_MPF\nN10 T3 M6\nN20 MCALL CYCLE81(5,0,1,-3)\nN30 X10 Y10\nN40 MCALL\n";
        assert_eq!(compared(siemens, siemens), Vec::<String>::new());
        assert_eq!(
            compared(siemens, &siemens.replace("-3)", "-4)")),
            ["block N20: `MCALL CYCLE81(5,0,1,-4)` instead of `MCALL CYCLE81(5,0,1,-3)`"]
        );
    }

    #[test]
    fn numbers_of_statements_have_a_tolerance() {
        assert!(same_statement("CYCLE81(5,0,1,-3)", "CYCLE81(5.0,0,1,-3.0004)", 0.001));
        assert!(!same_statement("CYCLE81(5,0,1,-3)", "CYCLE81(5,0,1,-3.1)", 0.001));
        assert!(!same_statement("CYCLE81(5)", "CYCLE82(5)", 2.0));
        assert!(same_statement("Q200=+2", "Q200=+2.0", 0.001));
        assert!(!same_statement("Q200=+2", "Q201=+2", 2.0));
    }
}
