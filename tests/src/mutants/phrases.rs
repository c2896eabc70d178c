//! What can be wrong with a line that is not made of letters and numbers alone: a phrase of
//! Klartext, a call or a named word of a SINUMERIK.

use std::ops::Range;

use super::Fault;

/// Words that a line of Klartext may have too many.
const INSERTED: [&str; 7] = ["M0", "M3", "M7", "M50", "M91", "F77", "RL"];

/// Words that are taken for each other.
const EXCHANGED: [(&str, &str); 12] = [
    ("DR+", "DR-"),
    ("R0", "RL"),
    ("RL", "RR"),
    ("FMAX", "F77"),
    ("M3", "M4"),
    ("M7", "M8"),
    ("M8", "M9"),
    ("M2", "M30"),
    ("M13", "M14"),
    ("MM", "INCH"),
    ("MB", "MOVE"),
    ("L", "C"),
];

/// A piece of a line that may be wrong by itself.
struct Piece<'l> {
    text: &'l str,
    range: Range<usize>,
}

/// The program is Klartext, whose lines are phrases.
pub(super) fn is_klartext(nc: &str) -> bool {
    nc.lines().next().is_some_and(|line| line.contains("BEGIN PGM"))
}

/// What can be wrong with a line, and the line with it.
pub(super) fn of_line(line: &str, klartext: bool) -> Vec<Fault> {
    let pieces = pieces(line);
    if pieces.is_empty() {
        return Vec::new();
    }
    let whole = |said: String, changed: String| Fault { said, changed, word: None, slight: false };
    let mut faults = vec![whole(format!("without `{line}`"), String::new())];
    let goes_on = line.contains(['~', ';', '=', '(']);
    for word in INSERTED.into_iter().filter(|_| klartext && !goes_on) {
        let letter = &word[..1];
        let has = pieces
            .iter()
            .any(|piece| piece.text == word || (letter != "M" && piece.text.starts_with(letter)));
        if !has {
            faults.push(whole(format!("`{line}` with {word}"), format!("{line} {word}")));
        }
    }
    // The number of a line steers nothing.
    let numbered = |piece: &&Piece| {
        let text = piece.text.strip_prefix('N').unwrap_or(piece.text);
        piece.range.start > 0 || !text.bytes().all(|byte| byte.is_ascii_digit())
    };
    faults.extend(pieces.iter().filter(numbered).flat_map(|piece| of_piece(line, piece)));
    faults
}

/// The pieces before a comment, divided by blanks, and the values of a call.
fn pieces(line: &str) -> Vec<Piece<'_>> {
    let code = line.split(';').next().unwrap_or(line);
    let parts = |c: char| c.is_whitespace() || c == ',' || c == '(' || c == ')';
    let mut pieces = Vec::new();
    let mut at = 0;
    for text in code.split(parts) {
        if !text.is_empty() && text != "~" {
            pieces.push(Piece { text, range: at..at + text.len() });
        }
        at += text.len() + 1;
    }
    pieces
}

fn of_piece(line: &str, piece: &Piece<'_>) -> Vec<Fault> {
    let (range, text) = (piece.range.clone(), piece.text);
    let fault = |said: String, new: &str| Fault {
        said,
        changed: format!("{}{new}{}", &line[..range.start], &line[range.end..]),
        word: axis(text),
        slight: super::is_slight(text, new),
    };
    let mut others: Vec<String> = super::pairs(&EXCHANGED, text).map(str::to_string).collect();
    others.extend(text.contains('-').then(|| text.replace('-', "")));
    let value = text.find('=').map_or(0, |at| at + 1);
    for (at, digit) in text.char_indices().filter(|(at, c)| *at >= value && c.is_ascii_digit()) {
        others.extend(super::neighbours(digit).map(|other| {
            let mut changed = text.to_string();
            changed.replace_range(at..=at, &other.to_string());
            changed
        }));
    }
    let mut faults = vec![fault(format!("`{line}` without {text}"), "")];
    faults
        .extend(others.iter().map(|other| fault(format!("{text} is {other} in `{line}`"), other)));
    faults
}

/// The letter of an axis word: `X+10`, `IX+10`, `X1=10`, `X=AC(10`.
fn axis(text: &str) -> Option<u8> {
    let text = text.strip_prefix('I').unwrap_or(text).as_bytes();
    let is_axis = text.first().is_some_and(|letter| b"XYZABCUVW".contains(letter));
    let follows = text.get(1).is_some_and(|next| next.is_ascii_digit() || b"+-.=".contains(next));
    (is_axis && follows).then(|| text[0])
}
