//! Small faults put into NC programs: a changed digit, a lost sign, a dropped word,
//! another function of the same group, a missing block, a block that may be skipped, a word
//! too many.

mod phrases;

use fil_nc::text::{Block, Word, read_block};

/// A program with one fault.
pub struct Mutant {
    /// Line of the fault, from 1.
    pub line: usize,
    /// What was done to it.
    pub fault: String,
    /// Letter of the word that is changed; `None` for more than one word.
    pub word: Option<u8>,
    /// A number is another one by no more than the last digit of a length or an angle.
    pub slight: bool,
    /// The program.
    pub text: String,
}

/// Mutants of a program, from that of number `first` on each of so many; lines keep their
/// numbers.
pub fn all(nc: &str, step: usize, first: usize) -> impl Iterator<Item = Mutant> {
    let lines: Vec<&str> = nc.split('\n').collect();
    let klartext = phrases::is_klartext(nc);
    let faults = |index: usize| {
        let of_words = if klartext { None } else { of_line(lines[index]) };
        let faults = of_words.unwrap_or_else(|| phrases::of_line(lines[index], klartext));
        faults.into_iter().map(move |fault| (index, fault))
    };
    let faults: Vec<(usize, Fault)> = (0..lines.len()).flat_map(faults).collect();
    let chosen = faults.into_iter().skip(first % step).step_by(step);
    chosen.map(move |(index, fault)| {
        let mut lines = lines.clone();
        lines[index] = &fault.changed;
        Mutant {
            line: index + 1,
            text: lines.join("\n"),
            fault: fault.said,
            word: fault.word,
            slight: fault.slight,
        }
    })
}

/// What can be wrong with a line.
struct Fault {
    said: String,
    changed: String,
    word: Option<u8>,
    slight: bool,
}

/// Words that a program may have too many.
const INSERTED: [&str; 14] = [
    "M0", "M3", "M7", "M50", "S77", "F77.", "H77", "T77", "G18", "G20", "G55", "G91", "G95", "G41",
];

/// Functions that are taken for each other.
const EXCHANGED: [(&str, &str); 14] = [
    ("G2", "G3"),
    ("G02", "G03"),
    ("G0", "G1"),
    ("G17", "G18"),
    ("G20", "G21"),
    ("G41", "G42"),
    ("G54", "G55"),
    ("G90", "G91"),
    ("G94", "G95"),
    ("G96", "G97"),
    ("G98", "G99"),
    ("G81", "G82"),
    ("M7", "M8"),
    ("M2", "M30"),
];

/// What can be wrong with a line of letters and numbers, and the line with it; `None` for
/// any other line.
fn of_line(line: &str) -> Option<Vec<Fault>> {
    let block = read_block(line.as_bytes(), "nc", 1).ok()?;
    if block.words.is_empty() {
        return Some(Vec::new());
    }
    let whole = |said: String, changed: String| Fault { said, changed, word: None, slight: false };
    let mut faults = vec![whole(format!("without `{line}`"), String::new())];
    if !block.skip {
        faults.push(whole(format!("`{line}` may be skipped"), format!("/{line}")));
    }
    for word in INSERTED.into_iter().filter(|word| fits(&block, word)) {
        faults.push(whole(format!("`{line}` with {word}"), format!("{line} {word}")));
    }
    faults.extend(block.words.iter().flat_map(|word| of_word(line, word)));
    Some(faults)
}

/// What can be wrong with a word of a line.
fn of_word(line: &str, word: &Word) -> Vec<Fault> {
    let (range, text) = (word.range.clone(), &line[word.range.clone()]);
    let fault = |said: String, new: &str| Fault {
        said,
        changed: format!("{}{new}{}", &line[..range.start], &line[range.end..]),
        word: Some(word.letter),
        slight: is_slight(text, new),
    };
    let mut faults = vec![fault(format!("`{line}` without {text}"), "")];
    // A sequence number steers nothing.
    if word.letter == b'N' {
        return faults;
    }
    let mut others: Vec<String> = pairs(&EXCHANGED, text).map(str::to_string).collect();
    others.extend(text.contains('-').then(|| text.replace('-', "")));
    for (at, digit) in text.char_indices().filter(|(_, c)| c.is_ascii_digit()) {
        others.extend(neighbours(digit).map(|other| {
            let mut changed = text.to_string();
            changed.replace_range(at..=at, &other.to_string());
            changed
        }));
    }
    let is_now = |other: String| fault(format!("{text} is {other} in `{line}`"), &other);
    faults.extend(others.into_iter().map(is_now));
    faults
}

/// What a word of three decimals can be off by where both of two values are right.
const LAST_DIGIT: f64 = 0.0011;

/// Two words whose numbers are that near.
fn is_slight(one: &str, other: &str) -> bool {
    let number = |text: &str| {
        let text = text.rsplit('=').next()?;
        let start = text.find(|c: char| c.is_ascii_digit() || "+-.".contains(c))?;
        text[start..].parse::<f64>().ok()
    };
    let name = |text: &str| text.bytes().take_while(u8::is_ascii_alphabetic).count();
    name(one) == name(other)
        && number(one).zip(number(other)).is_some_and(|(a, b)| (a - b).abs() < LAST_DIGIT)
}

/// A word may be added to a block that has none like it.
fn fits(block: &Block, word: &str) -> bool {
    let letter = word.as_bytes()[0];
    let has = |other: &Word| other.letter == letter && (letter != b'G' || is(other, word));
    block.comments.is_empty() && !block.words.iter().any(has)
}

/// A word is this function.
fn is(word: &Word, function: &str) -> bool {
    function[1..].parse() == Ok(word.number.value())
}

/// The digits beside one, round the corner.
fn neighbours(digit: char) -> [char; 2] {
    [1, 9].map(|step| char::from((digit as u8 - b'0' + step) % 10 + b'0'))
}

/// The words that one is taken for.
fn pairs(exchanged: &'static [(&str, &str)], word: &str) -> impl Iterator<Item = &'static str> {
    exchanged.iter().filter_map(move |(one, other)| match word {
        _ if word == *one => Some(*other),
        _ if word == *other => Some(*one),
        _ => None,
    })
}
