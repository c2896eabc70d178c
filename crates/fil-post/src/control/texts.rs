//! Texts that others put on the tape: what must never get there.

use std::borrow::Cow;

use fil_diag::Result;
use fil_machine::locations as loc;

use super::Control;
use crate::errors::PostCode;

/// The characters that enclose a message.
#[derive(Clone, Copy)]
pub struct MessageMarks {
    open: char,
    /// `None` where the message ends with its line.
    close: Option<char>,
}

impl MessageMarks {
    /// Those of the machine. What `(` begins, `)` ends.
    pub fn of(control: &Control) -> Self {
        let open = control.commons.read(loc::MESSAGE_OUT_CHAR).unwrap_or('(');
        let close = control.commons.read(loc::MESSAGE_IN_CHAR);
        MessageMarks { open, close: close.or((open == '(').then_some(')')) }
    }

    /// Both, for a message that must have neither; without a second one the first alone.
    pub fn both(self) -> [char; 2] {
        [self.open, self.close.unwrap_or(self.open)]
    }

    /// A message between them.
    pub fn enclose(self, text: &str) -> String {
        let mut message = String::with_capacity(text.len() + 8);
        message.push(self.open);
        message.push_str(text);
        message.extend(self.close);
        message
    }
}

/// True for a text that begins a program or subprogram of its own: `O100`, `:100`, or
/// the head of a SINUMERIK program, `%_N_NAME_SPF`.
pub fn begins_program(text: &str) -> bool {
    let numbered = text.strip_prefix(['O', 'o', ':']);
    let digit = numbered.and_then(|rest| rest.chars().next());
    digit.is_some_and(|c| c.is_ascii_digit()) || text.starts_with("%_N_")
}

/// Refuses a text that would end the tape or that the control can't read.
///
/// # Errors
/// `%`, which begins and ends a tape, or a control character.
pub fn check(text: &str) -> Result<()> {
    let body = if begins_program(text) { &text[1..] } else { text };
    if body.contains('%') {
        return PostCode::TextCharacter.err(format!("`%` in `{text}` would end the program"));
    }
    match text.chars().find(|c| c.is_control()) {
        Some(found) => PostCode::TextCharacter.err(format!(
            "the control character U+{:04X} in `{}`",
            found as u32,
            text.escape_debug()
        )),
        None => Ok(()),
    }
}

/// A message without what must not reach the tape: the characters that enclose it,
/// `%`, what ends each block (`end`) and control characters become blanks. Says whether any did
/// besides the enclosing ones.
pub fn clean_message(text: &str, marks: [char; 2], end: Option<char>) -> (Cow<'_, str>, bool) {
    let is_harmful = |c: char| c == '%' || Some(c) == end || c.is_control();
    if !text.chars().any(|c| marks.contains(&c) || is_harmful(c)) {
        return (Cow::Borrowed(text), false);
    }
    let mut changed = false;
    let clean = text.chars().filter(|c| !marks.contains(c)).map(|c| {
        changed |= is_harmful(c);
        if is_harmful(c) { ' ' } else { c }
    });
    let clean: String = clean.collect();
    (Cow::Owned(clean), changed)
}

/// The first part of a message of at most `longest` characters, and the rest.
pub fn split_message(text: &str, longest: usize) -> (&str, &str) {
    let end = text.char_indices().nth(longest).map_or(text.len(), |(at, _)| at);
    text.split_at(end)
}

/// A text without its blanks, but for those in comments and in quoted texts.
pub fn without_blanks(text: &str) -> String {
    let mut end = None;
    let kept = text.chars().filter(|c| {
        match end {
            Some(closing) if *c == closing => end = None,
            Some(_) => return true,
            None => {
                end = match c {
                    '(' => Some(')'),
                    '"' => Some('"'),
                    ';' => Some('\n'),
                    _ => None,
                }
            }
        }
        end.is_some() || *c != ' '
    });
    kept.collect()
}

/// Refuses a comment in brackets, which these languages do not have: the control would stop
/// at it, or take it for an expression.
///
/// # Errors
/// The text is one, behind its number.
pub fn refuse_brackets(text: &str) -> Result<()> {
    let text = text.trim_start_matches(['N', 'n']).trim_start_matches(|c: char| c.is_ascii_digit());
    let text = text.trim();
    if !(text.starts_with('(') && text.ends_with(')')) {
        return Ok(());
    }
    let mut diag =
        PostCode::Family.diag(format!("`{text}`: brackets hold no comment on this control"));
    diag.hint = Some("A comment follows a semicolon, `; TEXT`; PPRINT writes one.".into());
    Err(diag)
}

#[cfg(test)]
mod tests {
    use super::without_blanks;

    #[test]
    fn blanks_go_but_in_comments_and_quotes() {
        assert_eq!(without_blanks("G91 G28 Z0 (GO HOME) M9"), "G91G28Z0(GO HOME)M9");
        assert_eq!(without_blanks("MSG ( A B"), "MSG( A B");
        assert_eq!(without_blanks("T = \"END MILL\" M6 ; a note"), "T=\"END MILL\"M6; a note");
    }
}
