//! Work offsets: G54 to G59, G54.1 P, or a word.

use fil_diag::{Diag, Result};
use fil_machine::FunctionCode;
use fil_machine::contradictions;
use fil_machine::locations::{self as loc, FixtureForm, Placement};
use fil_machine::rounding::Rounding;
use fil_machine::setting::CodeAt;

use super::cycle;
use crate::control::needs::Act;
use crate::control::{Control, Function};
use crate::control_state::{Source, WorkOffset, modal};
use crate::errors::PostCode;

/// Writes a work offset, in a block of its own or with the next motion. Where the axes
/// stand in it is not known, so that the next motion says all of them.
///
/// # Errors
/// Cutter compensation; an offset that the machine lacks.
pub fn write(control: &mut Control, number: Option<i64>) -> Result<()> {
    prepare(control)?;
    match (number, control.commons.read(loc::FIXTURE_FORM)) {
        // A control with further offsets alone (G15 H1 of an OSP) has no G54.
        (None, FixtureForm::GCode) if has_no_plain(control) => code(control, 1)?,
        (None, FixtureForm::GCode) => {
            let code = control.code(loc::FIXTURE_DEFAULT_CODE, "SET/OFSETL without a number")?;
            control.g(code);
        }
        (None, FixtureForm::Word) => {
            return PostCode::WordForm
                .err("SET/OFSETL without a number, and a word with a number chooses the offset");
        }
        (Some(number), form) => {
            let index = number + i64::from(control.commons.int_opt(loc::FIXTURE_BASE).unwrap_or(0));
            match form {
                FixtureForm::GCode => code(control, index)?,
                FixtureForm::Word => {
                    let letter = control.letter(loc::FIXTURE_ADDRESS, "a work offset")?;
                    control.word_rounded(letter, index as f64, Rounding::Exact)?;
                }
            }
        }
    }
    place(control)
}

/// Writes a work offset by its code.
///
/// # Errors
/// Cutter compensation.
pub(in crate::control) fn write_code(control: &mut Control, code: FunctionCode) -> Result<()> {
    prepare(control)?;
    control.g(code);
    place(control)
}

/// Restates the offset in force; which one the CL file asks for stays as it was.
///
/// # Errors
/// Cutter compensation.
pub(crate) fn restate(control: &mut Control, offset: WorkOffset) -> Result<()> {
    prepare(control)?;
    control.g(offset.code);
    if let Some(number) = offset.number {
        number_word(control, i64::from(number))?;
    }
    control.write_block()
}

/// Ends what a change of the work offset must not interrupt.
///
/// # Errors
/// Cutter compensation.
pub(in crate::control) fn prepare(control: &mut Control) -> Result<()> {
    control.begin()?;
    cycle::cancel(control)?;
    control.ready_for(Act::WorkOffset)?;
    control.flush_function(Function::WorkOffset)
}

/// Writes the offset in the block under construction, or keeps it for a motion.
fn place(control: &mut Control) -> Result<()> {
    let word = |letter| control.block.value(letter, &control.tables.addresses);
    let codes = || control.block.g_codes().iter().rev();
    let asked = codes().find_map(|(code, _)| control.codes.work_offset(*code, word));
    let stays = asked.is_some() && asked == control.state.get(modal::WORK_OFFSET);
    counts_anew(control, stays);
    if let Some(offset) = asked {
        control.state.set(modal::ASKED_OFFSET, offset);
    }
    match control.commons.read(loc::FIXTURE_PLACEMENT) {
        Placement::BlockOfItsOwn => {
            control.write_block()?;
            counts_anew(control, stays);
            Ok(())
        }
        placement => control.place_block(Function::WorkOffset, placement),
    }
}

/// The axes count from the zero of the offset, which is the one before it if that stays.
pub(in crate::control) fn counts_anew(control: &mut Control, stays: bool) {
    if stays { control.state.doubt_axes() } else { control.state.shift_axes(Source::Post) }
}

/// True for a control whose work offsets are further ones alone.
fn has_no_plain(control: &Control) -> bool {
    let bounds = [loc::FIXTURE_MIN_CODE, loc::FIXTURE_MAX_CODE].map(|at| control.commons.read(at));
    let has_further = control.commons.int_opt(loc::FIXTURE_EXTENDED_CODE).is_some_and(|it| it > 0);
    matches!(bounds, [Some(first), Some(last)] if last < first) && has_further
}

/// Adds the code of an offset: the n-th from the lowest one, the offset whose code the number is,
/// or a further one with its own number.
///
/// # Errors
/// The machine has no such offset.
fn code(control: &mut Control, index: i64) -> Result<()> {
    let bound = |at: CodeAt| control.commons.read(at).map(i64::from);
    let (first, last) = (bound(loc::FIXTURE_MIN_CODE), bound(loc::FIXTURE_MAX_CODE));
    let (Some(first), Some(last)) = (first, last) else {
        return PostCode::NoCode
            .err("the machine has no code for a work offset (INTCOM 3429 and 3430)");
    };
    let plain = last - first + 1;
    let named = match index {
        _ if (1..=plain).contains(&index) => Some(first + index - 1),
        _ if (first..=last).contains(&index) => Some(index),
        _ => None,
    };
    if let Some(number) = named {
        refuse_other_function(control, number)?;
        let code = i32::try_from(number).ok().and_then(FunctionCode::of_setting);
        let code = code.ok_or_else(|| unknown(index))?;
        control.g(code);
        return Ok(());
    }
    let count = i64::from(control.commons.int_opt(loc::FIXTURE_EXTENDED_COUNT).unwrap_or(0));
    let extended = control.commons.int_opt(loc::FIXTURE_EXTENDED_CODE).filter(|code| *code > 0);
    match extended {
        Some(tenths) if (1..=count).contains(&(index - plain)) => {
            further(control, tenths.unsigned_abs(), index - plain)
        }
        _ => Err(unknown(index)),
    }
}

fn unknown(index: i64) -> Box<Diag> {
    PostCode::WordForm.diag(format!("SET: the machine has no work offset {index}"))
}

/// Adds the n-th further offset: its code with the number, or a code of its own of a control that
/// has no letter for the number (G59.1 and the tenths behind it).
fn further(control: &mut Control, tenths: u32, number: i64) -> Result<()> {
    match control.commons.read(loc::FIXTURE_EXTENDED_ADDRESS) {
        Some(_) => {
            control.g(FunctionCode::tenths(tenths));
            number_word(control, number)
        }
        None => {
            control.g(FunctionCode::tenths(tenths + number as u32 - 1));
            Ok(())
        }
    }
}

/// Adds the number beside the code of a further offset.
fn number_word(control: &mut Control, number: i64) -> Result<()> {
    let letter = control.letter(loc::FIXTURE_EXTENDED_ADDRESS, "a further work offset")?;
    control.word_rounded(letter, number as f64, Rounding::Exact)
}

/// Refuses a number between those of the work offsets that means something else on this machine.
fn refuse_other_function(control: &Control, code: i64) -> Result<()> {
    let number = u16::try_from(code).ok();
    match number.and_then(|code| contradictions::other_than_a_fixture(&control.commons, code)) {
        Some(other) => {
            PostCode::WordForm.err(format!("SET would choose G{code}, which is {other}"))
        }
        None => Ok(()),
    }
}
