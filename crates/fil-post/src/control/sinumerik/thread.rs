//! One pass of a thread: `G33 Z K`, across `G33 X I`.

use fil_diag::Result;
use fil_machine::letters::IJK;

use crate::control::Control;
use crate::control::family::refuse;
use crate::control::word_address::motion::{self as words, Motion};
use crate::operation::Lead;

/// Writes one pass. Its lead is the word of the axis that goes the longer way: I for X, K
/// for Z.
///
/// # Errors
/// An axis whose position is not known; as [`words::thread_by`].
pub fn pass(control: &mut Control, motion: &Motion, lead: &Lead) -> Result<()> {
    let way = |number: usize| {
        let from = control.axis_position(number)?;
        Some((motion.position[number] - from).abs())
    };
    let (Some(x), Some(z)) = (way(0), way(2)) else {
        return refuse("a pass of a thread, and where it begins is not known");
    };
    let letter = if x > z { IJK[0] } else { IJK[2] };
    words::thread_by(control, motion, lead, letter)
}
