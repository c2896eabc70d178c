//! What the head of the program says of it: its number and name, the time, how the tool retracts, the
//! tools.

use fil_diag::Result;
use fil_machine::locations::{self as loc, HomeFrame, TapePartnoText, ToolChangeBlock};
use fil_machine::modes::Unit;

use crate::cause::Cause;
use crate::control::Control;
use crate::control::texts::{MessageMarks, clean_message};
use crate::errors::PostCode;

/// Program numbers have at most four digits.
const NUMBERS: i64 = 100_000_000;

/// What the head of the program says.
#[derive(Clone, Debug, Default)]
pub struct ProgramHead {
    /// The first whole number of the PARTNO text.
    pub number: Option<i64>,
    /// Text of PARTNO.
    pub name: String,
    /// Date and time, where the machine wants them.
    pub time: Option<String>,
    /// The tools, a line each, where the machine lists them; `None` where nobody has counted them.
    pub tools: Option<Vec<String>>,
    /// The unit that UNITS gives behind names and texts alone, for what needs one before it.
    pub unit_ahead: Option<Unit>,
    /// The PARTNO record.
    pub cause: Cause,
    /// The start of the program has been written.
    pub started: bool,
    /// The end of the tape has been written.
    pub closed: bool,
}

/// Writes the program number, with the name beside it where the machine wants that.
///
/// # Errors
/// A number of too many digits; as a line on the tape.
pub(super) fn program_number(control: &mut Control) -> Result<()> {
    let Some(letter) = control.commons.read(loc::PROGRAM_NUMBER_ADDRESS) else { return Ok(()) };
    let fixed = control.commons.read(loc::PROGRAM_NUMBER).map(i64::from);
    let number = fixed.or(control.head.number).unwrap_or(1);
    if !(0..NUMBERS).contains(&number) {
        return PostCode::ProgramNumber
            .err(format!("program number {number} has more than eight digits"));
    }
    let usual = if fixed.is_some() { 1 } else { 4 };
    let width =
        control.commons.int_opt(loc::PROGRAM_NUMBER_DIGITS).unwrap_or(usual).clamp(1, 8) as usize;
    let mut line = format!("{letter}{number:0width$}");
    if control.commons.read(loc::PROGRAM_NAME_COMMENT) && !control.head.name.is_empty() {
        let name = control.head.name.replace(['(', ')'], " ");
        let name = cleaned(control, &name, ['(', ')']);
        line.push_str(&format!(" ({name})"));
    }
    let from_part = fixed.is_none() && control.head.number.is_some();
    let cause = if from_part { control.head.cause } else { Cause::default() };
    control.because(cause, |control| control.put_line(&line, false)).map(|_| ())
}

/// Writes date and time as a comment, where the machine wants them.
pub(super) fn time_stamp(control: &mut Control) -> Result<()> {
    let Some(time) = control.head.time.clone() else { return Ok(()) };
    if !control.can().brackets_are_comments {
        return control.put_line(&format!(";{time}"), false).map(|_| ());
    }
    let marks = MessageMarks::of(control);
    control.put_line(&marks.enclose(&time), false).map(|_| ())
}

/// Writes the comments of the head: how the tool retracts, and the tools, where the machine wants
/// them.
///
/// # Errors
/// As a line on the tape.
pub fn notes(control: &mut Control) -> Result<()> {
    if control.commons.read(loc::PROGRAM_RETRACT_NOTE) {
        let note = retract_note(control);
        head_comment(control, &note)?;
    }
    if !control.commons.read(loc::PROGRAM_TOOL_LIST) {
        return Ok(());
    }
    let Some(tools) = control.head.tools.take() else {
        let message = "the list of tools (program.tool_list): the CL file can't be read twice";
        control.warnings.add(PostCode::IgnoredPart, message.to_string());
        return Ok(());
    };
    tools.iter().try_for_each(|tool| head_comment(control, tool))
}

fn head_comment(control: &mut Control, text: &str) -> Result<()> {
    let marks = MessageMarks::of(control);
    let text = cleaned(control, text, marks.both());
    let line = match control.can().brackets_are_comments {
        true => marks.enclose(&text),
        false => format!("; {text}"),
    };
    control.put_line(&line, false).map(|_| ())
}

/// How the tool retracts before a change and the end, and what that asks of the machine.
fn retract_note(control: &Control) -> String {
    let commons = &control.commons;
    let goes = commons.read(loc::TOOL_CHANGE_BLOCK) != ToolChangeBlock::None;
    let level = commons.dbl_opt(loc::CHANGE_POSITION[2]).filter(|_| goes);
    let level = level.or(commons.dbl_opt(loc::HOME_RETRACT_Z));
    match (level, commons.read(loc::HOME_FRAME)) {
        (None, _) => "NO RETRACT: Z STAYS AT THE HEIGHTS OF THE CL FILE".to_string(),
        (Some(level), HomeFrame::OfThePart) => {
            format!("RETRACT TO Z{level} OF THE PART: MUST BE CLEAR")
        }
        (Some(_), HomeFrame::OfTheMachine) => {
            format!("RETRACT BY {}: HOME THE MACHINE FIRST", control.can().machine_frame)
        }
        (Some(_), HomeFrame::ReferencePoint) => {
            "RETRACT BY G28: HOME THE MACHINE FIRST".to_string()
        }
        (Some(_), HomeFrame::SecondReferencePoint) => {
            "RETRACT BY G30: SET THAT POINT CLEAR OF THE PART".to_string()
        }
        (Some(_), HomeFrame::EndOfTravel) => {
            "RETRACT BY G16 H0 TO THE END OF THE TRAVEL".to_string()
        }
    }
}

/// Writes PARTNO as a comment before the program, where the machine wants it.
pub(super) fn part_name(control: &mut Control) -> Result<()> {
    let wanted = control.commons.read(loc::TAPE_PARTNO_TEXT) == TapePartnoText::Yes;
    if !wanted || control.head.name.is_empty() {
        return Ok(());
    }
    let marks = MessageMarks::of(control);
    let name = cleaned(control, &control.head.name.clone(), marks.both());
    let cause = control.head.cause;
    control.because(cause, |control| control.put_line(&marks.enclose(&name), false)).map(|_| ())
}

/// A text in the characters of the tape, without what must not stand in a comment between `marks`.
fn cleaned(control: &mut Control, text: &str, marks: [char; 2]) -> String {
    let text = control.in_tape_characters(text);
    clean_message(&text, marks, control.tables.style.end_of_block).0.into_owned()
}
