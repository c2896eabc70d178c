//! Work offsets: G54 to G57, then G505 to G599.

use fil_diag::Result;
use fil_machine::locations::{self as loc, FixtureForm};
use fil_machine::{Commons, FunctionCode};

use crate::control::Control;
use crate::control::word_address::fixture;
use crate::errors::PostCode;

/// The first four offsets.
const PLAIN: std::ops::RangeInclusive<i64> = 54..=57;

/// The others: offset n is G500 and n.
const FURTHER: std::ops::RangeInclusive<i64> = 505..=599;

/// Writes a work offset, in a block of its own or with the next motion.
///
/// # Errors
/// Cutter compensation; an offset that the control lacks.
pub fn write(control: &mut Control, number: Option<i64>) -> Result<()> {
    let Some(number) = number else { return fixture::write(control, None) };
    if control.commons.read(loc::FIXTURE_FORM) == FixtureForm::Word {
        return PostCode::Family.err("fixture.form: a G function chooses the work offset");
    }
    let code = code(&control.commons, number).ok_or_else(|| {
        PostCode::WordForm.diag(format!("SET: the control has no work offset {number}"))
    })?;
    fixture::write_code(control, code)
}

/// The function of an offset: the n-th one, or the one whose function is named.
fn code(commons: &Commons, number: i64) -> Option<FunctionCode> {
    let index = number + i64::from(commons.int_opt(loc::FIXTURE_BASE).unwrap_or(0));
    let code = match index {
        1..=4 => PLAIN.start() + index - 1,
        _ if PLAIN.contains(&index) || FURTHER.contains(&index) => index,
        5..=99 => 500 + index,
        _ => return None,
    };
    i32::try_from(code).ok().and_then(FunctionCode::of_setting)
}
