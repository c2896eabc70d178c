//! PPRINT text: a message to the operator, as a comment on the tape.

use fil_cl::Record;
use fil_cl::vocabulary::Vocabulary;
use fil_diag::Diag;

use crate::locations as loc;
use crate::post::Post;

/// Writes the text between the control-out and control-in characters, broken
/// at the machine's longest message.
///
/// # Errors
/// As `Post::write_line`.
pub fn handle(post: &mut Post, record: &Record, _: &Vocabulary) -> Result<(), Box<Diag>> {
    if !post.commons.flag(loc::MESSAGE_TO_TAPE) {
        return Ok(());
    }
    message(post, record.text.trim())
}

/// Writes a message.
///
/// # Errors
/// As `Post::write_line`.
pub fn message(post: &mut Post, text: &str) -> Result<(), Box<Diag>> {
    let character = |location, default| {
        let code = post.commons.int_opt(location).and_then(|code| u8::try_from(code).ok());
        char::from(code.filter(u8::is_ascii_graphic).unwrap_or(default))
    };
    let (open, close) =
        (character(loc::MESSAGE_OUT_CHAR, b'('), character(loc::MESSAGE_IN_CHAR, b')'));
    let longest = post.commons.int(loc::MESSAGE_MAX_CHARS).clamp(1, 120) as usize;
    let numbered = matches!(post.commons.int(loc::SEQNO_ON_TEXT), 2 | 3);
    let clean: Vec<char> = text.chars().filter(|c| *c != open && *c != close).collect();
    for part in clean.chunks(longest) {
        let part: String = part.iter().collect();
        post.write_line(&format!("{open}{part}{close}"), numbered)?;
    }
    Ok(())
}
