//! One pass of a thread: `G33 Z K`, across `G33 X I`; all passes: CYCLE97.

use fil_diag::Result;
use fil_machine::letters::{F, IJK};
use fil_machine::locations as loc;

use crate::control::word_address::motion as words;
use crate::control::{Control, line, tap};
use crate::control_state::{Source, VARYING_LEADS_OF_SINUMERIK, modal};
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::operation::thread_shape::{Ends, Shape};
use crate::operation::{Lead, Thread, ThreadSide};

/// Digits after the point of a lead, mm.
const LEAD_DIGITS: usize = 4;

/// Passes whose chips have the same area, outside and inside.
const EQUAL_CHIPS: [u8; 2] = [3, 4];

/// Ways along X and Z that differ less are equal, mm or inch: less than a last digit of the tape.
const EQUAL: f64 = 1e-7;

/// Writes one pass. Its lead is the word of the axis that goes the longer way by the digits of the
/// tape: I for X, K for Z, and K where the ways are equal, as both are right there. G34 and G35 take what it grows and shrinks by in each turn as F, without a sign
/// (Siemens, Programming Manual Fundamentals: thread cutting with increasing or decreasing lead).
///
/// # Errors
/// An axis whose position is not known; as [`words::thread_by`].
pub fn pass(control: &mut Control, motion: &Motion, lead: &Lead, change: f64) -> Result<()> {
    let way = |number: usize| {
        let from = control.axis_position(number)?;
        let to = control.tables.axis(number).on_tape(motion.position[number]);
        Some(to.map(|to| (to - from).abs()))
    };
    let (Some(x), Some(z)) = (way(0).transpose()?, way(2).transpose()?) else {
        return PostCode::Family.err("a pass of a thread from an unknown start point");
    };
    let letter = if x > z + EQUAL { IJK[0] } else { IJK[2] };
    if change == 0.0 {
        return words::thread_by(control, motion, lead, letter);
    }
    control.code(loc::THREAD_CODE, "a thread")?;
    let [growing, shrinking] = VARYING_LEADS_OF_SINUMERIK;
    let code = if change > 0.0 { growing } else { shrinking };
    let of_lead = [(letter, lead.value), (F, change.abs())];
    words::pass_by(control, motion, code, &of_lead, lead.cause)
}

/// Writes CYCLE97 for one start, from where the tool stands clear. Run-in and run-out are in the points of the thread, and where the cycle leaves the
/// tool is not counted on.
///
/// # Errors
/// A value that does not fit.
pub fn cycle(control: &mut Control, thread: &Thread, shape: &Shape, ends: &Ends) -> Result<()> {
    let [begin, end] = ends.crest;
    words::ready(control)?;
    control.flush_waiting()?;
    let [x, z] = [0, 2].map(|number: usize| *control.tables.axis(number));
    let length = |letter, value: f64| line::length(control, letter, value).map(|(text, _)| text);
    let diameter = length(x.letter, 2.0 * end[0])?;
    let (from, to) = (length(z.letter, z.value(begin[1])?)?, length(z.letter, z.value(end[1])?)?);
    let depth = length(x.letter, thread.depth)?;
    let back = length(x.letter, (ends.begin[0] - begin[0]).abs())?;
    let lead = tap::text(thread.lead.value, LEAD_DIGITS)?;
    let cuts = shape.cuts(thread).len();
    let kind = EQUAL_CHIPS[usize::from(thread.side == ThreadSide::Inside)];
    let call = format!(
        "CYCLE97({lead},,{from},{to},{diameter},{diameter},0,0,{depth},0,0,0,{cuts},{},{kind},1,{back})",
        thread.springs
    );
    control.because(thread.lead.cause, |control| super::put_text(control, &call))?;
    control.state.doubt_axes();
    control.state.doubt(F);
    control.state.forget(modal::MOTION, Source::Post);
    Ok(())
}
