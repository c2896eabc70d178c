//! Texts: INSERT as it is, PPRINT as a comment.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::letters::S;
use fil_machine::locations::{self as loc, SeqnoOnText};

use super::modes;
use crate::control::Control;
use crate::control::texts::{MessageMarks, clean_message, split_message};
use crate::control_state::{ForeignBlock, Meaning, functions, modal};
use crate::errors::PostCode;

/// Writes the blocks of an INSERT.
///
/// # Errors
/// As [`Control::write_foreign`].
pub fn insert(control: &mut Control, blocks: &[ForeignBlock]) -> Result<()> {
    let on_text = control.commons.read(loc::SEQNO_ON_TEXT);
    let numbered = matches!(on_text, SeqnoOnText::Insert | SeqnoOnText::Both);
    for block in blocks {
        say_what_it_counts_on(control, block.words())?;
        control.write_foreign(block, numbered)?;
    }
    Ok(())
}

/// Says what the words of a text count on where nothing has said it yet: the unit of positions
/// and feeds, and that S is turns a minute on a control that also counts a surface speed.
///
/// # Errors
/// Nothing says mm or inch.
fn say_what_it_counts_on(control: &mut Control, words: &[(Letter, f64)]) -> Result<()> {
    if words.is_empty() {
        return Ok(());
    }
    control.begin()?;
    let codes = || functions(words);
    let says = |at| control.code_if_any(at).is_some_and(|code| codes().any(|said| said == code));
    let is_said = |kind: fn(Meaning) -> bool| codes().any(|code| kind(control.meaning(code)));
    let pauses = says(loc::DWELL_CODE);
    let is_length =
        |(letter, value): &(Letter, f64)| b"XYZUVWIJKRF".contains(&letter.byte()) && *value != 0.0;
    let needs_unit = control.state.get(modal::UNITS).is_none()
        && !pauses
        && words.iter().any(is_length)
        && !is_said(|meaning| matches!(meaning, Meaning::Unit(_)));
    let needs_turns = control.state.get(modal::SURFACE_SPEED).is_none()
        && control.code_if_any(loc::SPINDLE_CSS_CODE).is_some()
        && !(pauses || says(loc::SPINDLE_MAX_CODE))
        && words.iter().any(|(letter, _)| *letter == S)
        && !is_said(|meaning| matches!(meaning, Meaning::SpeedMode(_)));
    if needs_unit {
        let unit = control.require_unit()?;
        modes::take_unit(control, unit)?;
    }
    match control.code_if_any(loc::SPINDLE_RPM_CODE).filter(|_| needs_turns) {
        Some(code) => {
            control.g_of_record(code);
            control.write_block()
        }
        None => Ok(()),
    }
}

/// Writes a message between the control-out and control-in characters, broken at
/// the machine's longest message.
///
/// # Errors
/// As [`Control::write_line`].
pub fn message(control: &mut Control, text: &str) -> Result<()> {
    let marks = MessageMarks::of(control);
    let longest = control.commons.int(loc::MESSAGE_MAX_CHARS).clamp(1, 120) as usize;
    let on_text = control.commons.read(loc::SEQNO_ON_TEXT);
    let numbered = matches!(on_text, SeqnoOnText::Pprint | SeqnoOnText::Both);
    let (clean, changed) = clean_message(text, marks.both(), control.tables.style.end_of_block);
    if changed {
        let message =
            format!("characters that are not allowed in a program in `{}`", text.escape_debug());
        control.warnings.add(PostCode::IgnoredPart, message);
    }
    let clean = control.in_tape_characters(&clean);
    let goes_on = control.commons.read(loc::TAPE_CONTINUATION_CHAR).filter(|_| longest > 1);
    let mut rest = &*clean;
    while !rest.is_empty() {
        let (mut part, mut left) = split_message(rest, longest);
        // The mark of a message that goes on is one of its characters.
        let with_mark;
        if let Some(mark) = goes_on.filter(|_| !left.is_empty()) {
            (part, left) = split_message(rest, longest - 1);
            with_mark = format!("{part}{mark}");
            part = &with_mark;
        }
        control.write_line(&marks.enclose(part), numbered)?;
        rest = left;
    }
    Ok(())
}
