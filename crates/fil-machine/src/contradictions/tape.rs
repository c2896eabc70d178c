//! Characters of the tape that a control would read as something else: what begins and ends lines,
//! blocks and messages.

use fil_diag::Diag;
use fil_text::CodePage;

use super::contradiction;
use crate::address::Addresses;
use crate::commons::Commons;
use crate::errors::MachineCode;
use crate::letter::Letter;
use crate::locations::{self as loc, ControlFamily, SeqnoAlign, TapeEndOfBlock, TapePartnoText};
use crate::setting::CharacterAt;

/// Characters that stand for nothing else in a program of words: no word, number, expression,
/// comment or block skip has them.
const FREE: &str = "!$&*?@\\^_`|~";

/// Characters of a line before or after the program. Letters of the tape and digits would be words,
/// parentheses comments.
const LINES: &[(CharacterAt, &str)] = &[
    (loc::TAPE_START_CHAR, "tape.start_char"),
    (loc::TAPE_END_CHAR, "tape.end_char"),
    (loc::TAPE_START_CODE, "tape.start_code"),
];

/// Marks of the tape that are asked for and not there, or mean something else, and an encoding
/// that this build lacks.
pub(super) fn check(commons: &Commons, found: &mut Vec<Diag>) {
    let encoding = commons.read(loc::TAPE_ENCODING);
    if CodePage::numbered(encoding as u16).is_none() {
        let message =
            format!("tape.encoding {}: this build has no two-byte code pages", encoding as u16);
        found.push(*MachineCode::SettingValue.diag(message));
    }
    let has_text = commons.read(loc::TAPE_PARTNO_TEXT) == TapePartnoText::Yes;
    if has_text && commons.read(loc::CONTROL_FAMILY) == ControlFamily::Sinumerik {
        found.push(contradiction(
            "tape.partno_text puts a line before the header of a SINUMERIK program".into(),
        ));
    }
    lines(commons, found);
    skip(commons, found);
    end_of_block(commons, found);
    align(commons, found);
    leader(commons, found);
    // Klartext and a SINUMERIK have one form of a message.
    if commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress {
        message(commons, found);
    }
    same_marks(commons, found);
}

fn means_something_else(name: &str, mark: char) -> Diag {
    contradiction(format!("{name} is `{mark}`, which means something else"))
}

fn lines(commons: &Commons, found: &mut Vec<Diag>) {
    let addresses = Addresses::from_commons(commons, true);
    let is_free = |mark: char| {
        let letter = u8::try_from(mark).ok().filter(u8::is_ascii_uppercase).map(Letter::of);
        letter.is_some_and(|letter| addresses.position(letter).is_none())
    };
    for (at, name) in LINES {
        let is_no_mark = |mark: &char| {
            mark.is_alphanumeric() && !is_free(*mark) || "()[]{}\"'.+-#=".contains(*mark)
        };
        if let Some(mark) = commons.read(*at).filter(is_no_mark) {
            found.push(means_something_else(name, mark));
        }
    }
}

/// What begins a block that may be skipped.
fn skip(commons: &Commons, found: &mut Vec<Diag>) {
    let is_no_mark = |mark: &char| *mark != '/' && !FREE.contains(*mark);
    if let Some(mark) = commons.read(loc::TAPE_OPSKIP_CHAR).filter(is_no_mark) {
        found.push(means_something_else("tape.opskip_char", mark));
    }
}

/// What ends each block, and parts the text of an INSERT where it is not written too.
fn end_of_block(commons: &Commons, found: &mut Vec<Diag>) {
    let mark = commons.read(loc::TAPE_END_OF_BLOCK_CHAR);
    let ends = commons.read(loc::TAPE_END_OF_BLOCK) == TapeEndOfBlock::Yes;
    let by_words = commons.read(loc::CONTROL_FAMILY) == ControlFamily::WordAddress;
    match mark {
        None if ends => found.push(contradiction(
            "tape.end_of_block needs a character, but tape.end_of_block_char is none".into(),
        )),
        // Variables, strings and operators of the others; all behind a semicolon is a comment.
        Some(mark) if ends && !by_words && mark != ';' => {
            found.push(means_something_else("tape.end_of_block_char", mark));
        }
        Some(mark) if mark != ';' && !FREE.contains(mark) => {
            found.push(means_something_else("tape.end_of_block_char", mark));
        }
        _ => {}
    }
}

/// What stands in place of N at the blocks of seqno.align: real files have `:` and O.
fn align(commons: &Commons, found: &mut Vec<Diag>) {
    if commons.read(loc::SEQNO_ALIGN) != SeqnoAlign::ToolChanges {
        return;
    }
    let Some(mark) = commons.read(loc::TAPE_ALIGN_CHAR) else {
        found.push(contradiction(
            "seqno.align needs a character, but tape.align_char is none".into(),
        ));
        return;
    };
    let letter = Letter::of_character(mark);
    if letter.is_some() && commons.read(loc::PROGRAM_NUMBER_ADDRESS) == letter {
        found.push(contradiction(format!(
            "{mark} is both tape.align_char and the letter of a program number"
        )));
    } else if !(":NO".contains(mark.to_ascii_uppercase()) || FREE.contains(mark)) {
        found.push(means_something_else("tape.align_char", mark));
    }
}

/// What a leader and a trailer are made of.
fn leader(commons: &Commons, found: &mut Vec<Diag>) {
    let length = |at| commons.dbl_opt(at).unwrap_or(0.0);
    let [leads, trails] = [loc::TAPE_LEADER, loc::TAPE_TRAILER].map(|at| length(at) != 0.0);
    let is_written = !commons.read(loc::TAPE_DNC);
    match commons.read(loc::TAPE_LEADER_CHAR) {
        None if is_written && leads => found
            .push(contradiction("tape.leader has a length, but tape.leader_char is none".into())),
        Some(mark) if is_written && (leads || trails) => {
            // A percent sign before the program would be its start.
            let begins = mark == '%' && leads;
            if begins || mark.is_alphanumeric() || "()[]{}\"'+-#=:".contains(mark) {
                found.push(means_something_else("tape.leader_char", mark));
            }
        }
        _ => {}
    }
}

/// A message stands between parentheses or brackets, or behind a semicolon to the end of its line.
fn message(commons: &Commons, found: &mut Vec<Diag>) {
    let open = commons.read(loc::MESSAGE_OUT_CHAR).unwrap_or('(');
    let close = commons.read(loc::MESSAGE_IN_CHAR).unwrap_or(')');
    let ends = commons.read(loc::TAPE_END_OF_BLOCK) == TapeEndOfBlock::Yes;
    let end = commons.read(loc::TAPE_END_OF_BLOCK_CHAR).filter(|_| ends);
    match (open, close) {
        (';', _) if end == Some(';') => found.push(contradiction(
            "message.out_char is `;`, which ends blocks (tape.end_of_block_char)".into(),
        )),
        ('(', ')') | ('[', ']') | (';', _) => {}
        _ => found.push(contradiction(format!(
            "message.out_char is `{open}` and message.in_char `{close}`, but comments need ( and ), [ and ], or ; alone"
        ))),
    }
    let goes_on = commons.read(loc::TAPE_CONTINUATION_CHAR);
    if let Some(mark) = goes_on.filter(|mark| [Some(open), Some(close), end].contains(&Some(*mark)))
    {
        found.push(means_something_else("tape.continuation_char", mark));
    }
}

/// Marks of a block are different characters.
fn same_marks(commons: &Commons, found: &mut Vec<Diag>) {
    let ends = commons.read(loc::TAPE_END_OF_BLOCK) == TapeEndOfBlock::Yes;
    let aligns = commons.read(loc::SEQNO_ALIGN) == SeqnoAlign::ToolChanges;
    let marks = [
        (commons.read(loc::TAPE_OPSKIP_CHAR), "tape.opskip_char"),
        (commons.read(loc::TAPE_END_OF_BLOCK_CHAR).filter(|_| ends), "tape.end_of_block_char"),
        (commons.read(loc::TAPE_ALIGN_CHAR).filter(|_| aligns), "tape.align_char"),
    ];
    for (index, (mark, name)) in marks.iter().enumerate() {
        let other = marks[..index].iter().find(|(other, _)| mark.is_some() && other == mark);
        if let (Some(mark), Some((_, other))) = (mark, other) {
            found.push(contradiction(format!("{name} is `{mark}`, and so is {other}")));
        }
    }
}
