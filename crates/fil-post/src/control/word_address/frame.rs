//! Tilted frames: G68.2 with Euler angles, G53.1, and G69; or G254, which takes the frame from where
//! the rotary axes stand, and G255.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::letters::{IJK, XYZ};
use fil_machine::locations::{self as loc, RotaryFrameForm};
use fil_machine::rounding::Rounding;
use nalgebra::Rotation3;

use crate::control::Control;
use crate::errors::PostCode;
use crate::euler::Euler;

/// Begins a frame about the zero of the program and turns the tool along its Z; the
/// rotary axes stand there already. Says how the frame lies as the tape has it.
///
/// # Errors
/// The machine lacks a code or an address; angles that do not fit.
pub fn begin(control: &mut Control, turn: &Rotation3<f64>) -> Result<Rotation3<f64>> {
    let waiting = control.block.take();
    let frame = tenths(control, loc::ROTARY_FRAME_CODE, "rotary.frame_code")?;
    if control.commons.read(loc::ROTARY_FRAME_FORM) == RotaryFrameForm::AsTheRotaryAxesStand {
        control.g_of_record(frame);
        control.write_block()?;
        control.block = waiting;
        return Ok(*turn);
    }
    let align = tenths(control, loc::ROTARY_FRAME_ALIGN_CODE, "rotary.frame_align_code")?;
    control.g_of_record(frame);
    for letter in XYZ {
        control.word(letter, 0.0)?;
    }
    let mut written = [0.0; 3];
    for ((letter, angle), written) in IJK.into_iter().zip(Euler::Zxz.angles(turn)).zip(&mut written)
    {
        let Some(format) = control.tables.addresses.format(letter) else {
            return PostCode::NoCode.err(format!("the machine has no {letter} for its frames"));
        };
        *written = format.unscale(Rounding::Nearest.scale(angle, format)?);
        control.word(letter, *written)?;
    }
    control.write_block()?;
    control.g_of_record(align);
    control.write_block()?;
    control.block = waiting;
    Ok(Euler::Zxz.turn(written))
}

/// Ends the frame.
///
/// # Errors
/// The machine has no code for it.
pub fn end(control: &mut Control) -> Result<()> {
    let code = control.code(loc::ROTARY_FRAME_CANCEL_CODE, "the end of a tilted work plane")?;
    let waiting = control.block.take();
    control.g_of_record(code);
    control.write_block()?;
    control.block = waiting;
    Ok(())
}

fn tenths(control: &Control, at: fil_machine::commons::Int, key: &str) -> Result<FunctionCode> {
    let code = control.commons.int_opt(at).and_then(|tenths| u32::try_from(tenths).ok());
    let named = || PostCode::NoCode.diag(format!("{key} names no function"));
    code.map(FunctionCode::tenths).ok_or_else(named)
}
