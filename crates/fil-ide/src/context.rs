//! The statement around a byte, as text: what is being typed need not parse.

use std::ops::Range;

use crate::text::Text;

/// What stands before a byte in its statement.
pub(crate) struct Before {
    /// The statement up to the byte, continuation lines joined, upper case, without label.
    pub statement: String,
    /// The byte is in a comment.
    pub comment: bool,
    /// The byte is in a text between apostrophes.
    pub quoted: bool,
}

/// A line up to its comment, and whether a text is open at its end.
pub(crate) fn code(line: &str) -> (&str, bool) {
    let mut quoted = false;
    let mut bytes = line.bytes().enumerate().peekable();
    while let Some((at, byte)) = bytes.next() {
        match byte {
            b'\'' => quoted = !quoted,
            b'$' if !quoted && bytes.peek().is_some_and(|(_, next)| *next == b'$') => {
                return (&line[..at], false);
            }
            _ => {}
        }
    }
    (line, quoted)
}

/// True when a line goes on in the next one.
fn continues(line: &str) -> bool {
    code(line).0.trim_end().ends_with('$')
}

/// The statement before a byte of a text.
pub(crate) fn before(text: &Text, byte: usize) -> Before {
    let line = text.line_of(byte);
    let mut first = line;
    while first > 0 && line - first < 200 && continues(text.line(first - 1)) {
        first -= 1;
    }
    let mut joined = String::new();
    for above in first..line {
        let kept = code(text.line(above)).0.trim_end();
        joined.push_str(kept.strip_suffix('$').unwrap_or(kept));
    }
    let start = text.line_bytes(line).start;
    let head = text.as_str().get(start..byte).unwrap_or_default();
    let (kept, quoted) = code(head);
    joined.push_str(kept);
    Before {
        statement: statement(&joined).to_ascii_uppercase(),
        comment: kept.len() < head.len(),
        quoted,
    }
}

/// The last statement of a line, behind `;`, a label and an IF with its condition.
fn statement(line: &str) -> &str {
    let mut rest = line;
    let mut quoted = false;
    let mut start = 0;
    for (at, byte) in line.bytes().enumerate() {
        match byte {
            b'\'' => quoted = !quoted,
            b';' if !quoted => start = at + 1,
            _ => {}
        }
    }
    rest = rest[start..].trim_start();
    let word = rest.find(|c: char| !c.is_ascii_alphanumeric()).unwrap_or(rest.len());
    if rest[word..].starts_with(')') {
        rest = rest[word + 1..].trim_start();
    }
    if rest.get(..2).is_some_and(|head| head.eq_ignore_ascii_case("IF"))
        && let Some(open) = rest.find('(')
        && rest[2..open].trim().is_empty()
        && let Some(close) = closing(rest, open)
    {
        rest = rest[close + 1..].trim_start();
    }
    rest
}

/// The bracket that closes one.
fn closing(text: &str, open: usize) -> Option<usize> {
    let mut depth = 0;
    let mut quoted = false;
    for (at, byte) in text.bytes().enumerate().skip(open) {
        match byte {
            b'\'' => quoted = !quoted,
            b'(' if !quoted => depth += 1,
            b')' if !quoted => {
                depth -= 1;
                if depth == 0 {
                    return Some(at);
                }
            }
            _ => {}
        }
    }
    None
}

/// The call whose arguments are being written: name, what stands between its bracket and
/// the end, by commas.
pub(crate) fn open_call(statement: &str) -> Option<(&str, Vec<&str>)> {
    let mut open = Vec::new();
    let mut quoted = false;
    for (at, byte) in statement.bytes().enumerate() {
        match byte {
            b'\'' => quoted = !quoted,
            b'(' if !quoted => open.push(at),
            b')' if !quoted => {
                open.pop();
            }
            _ => {}
        }
    }
    let at = open.pop()?;
    let name = last_word(&statement[..at]);
    (!name.is_empty()).then(|| (name, parts(&statement[at + 1..])))
}

/// The word of `WORD/…`, and its items so far.
pub(crate) fn slash(statement: &str) -> Option<(&str, Vec<&str>)> {
    let (word, rest) = statement.split_once('/')?;
    let word = word.trim();
    let is_name = !word.is_empty() && word.bytes().all(|byte| byte.is_ascii_alphanumeric());
    // NAME=TEXT/… and NAME=MACRO/…
    let assigned = word.rsplit_once('=').map(|(_, word)| word.trim());
    match assigned {
        Some(word @ ("TEXT" | "MACRO")) => Some((word, parts(rest))),
        None if is_name => Some((word, parts(rest))),
        _ => None,
    }
}

/// Parts between commas that stand in no bracket and no text.
pub(crate) fn parts(text: &str) -> Vec<&str> {
    let mut found = Vec::new();
    let (mut depth, mut quoted, mut start) = (0i32, false, 0);
    for (at, byte) in text.bytes().enumerate() {
        match byte {
            b'\'' => quoted = !quoted,
            b'(' if !quoted => depth += 1,
            b')' if !quoted => depth -= 1,
            b',' if !quoted && depth == 0 => {
                found.push(&text[start..at]);
                start = at + 1;
            }
            _ => {}
        }
    }
    found.push(&text[start..]);
    found
}

/// The word at the end of a text.
pub(crate) fn last_word(text: &str) -> &str {
    let start = text
        .rfind(|c: char| !c.is_ascii_alphanumeric())
        .map_or(0, |at| at + text[at..].chars().next().map_or(0, char::len_utf8));
    &text[start..]
}

/// A call of POSTF as it is written in a text: the bytes of its arguments.
pub(crate) struct PostfCall {
    /// Each argument.
    pub arguments: Vec<Range<usize>>,
}

/// All calls of POSTF of a text.
pub(crate) fn postf_calls(text: &Text) -> Vec<PostfCall> {
    let mut found = Vec::new();
    for line in 0..text.line_count() {
        let bytes = text.line_bytes(line);
        let (kept, _) = code(text.line(line));
        let upper = kept.to_ascii_uppercase();
        for (at, _) in upper.match_indices("POSTF(") {
            let open = at + "POSTF".len();
            let close = closing(&upper, open).unwrap_or(upper.len());
            let mut start = open + 1;
            let mut arguments = Vec::new();
            for part in parts(&upper[start..close]) {
                let shift = part.len() - part.trim_start().len();
                let from = bytes.start + start + shift;
                arguments.push(from..from + part.trim().len());
                start += part.len() + 1;
            }
            found.push(PostfCall { arguments });
        }
    }
    found
}

/// The statements of a text, each with its first byte, without labels and the conditions
/// before them. Comments and the ends of lines that go on are blanks.
pub(crate) fn statements(text: &Text) -> Vec<(usize, String)> {
    let mut found = Vec::new();
    let mut line = 0;
    while line < text.line_count() {
        let mut from = text.line_bytes(line).start;
        let mut joined = String::new();
        loop {
            let own = text.line(line);
            let kept = code(own).0;
            let is_last = !continues(own) || line + 1 == text.line_count();
            if is_last {
                joined.push_str(kept);
                break;
            }
            let kept = kept.trim_end();
            joined.push_str(kept.strip_suffix('$').unwrap_or(kept));
            line += 1;
            let before = text.line_bytes(line).start - from;
            joined.extend(std::iter::repeat_n(' ', before - joined.len()));
        }
        for piece in split_at_semicolons(&joined) {
            let own = statement(piece);
            found.push((from + piece.len() - own.len(), own.to_string()));
            from += piece.len() + 1;
        }
        line += 1;
    }
    found
}

/// Pieces between semicolons that stand in no text.
fn split_at_semicolons(text: &str) -> impl Iterator<Item = &str> {
    let mut quoted = false;
    text.split(move |character| {
        quoted ^= character == '\'';
        character == ';' && !quoted
    })
}
