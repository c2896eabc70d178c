//! Tilted planes: CYCLE800. Tool-tip control: TRAORI.

use fil_diag::Result;
use fil_machine::letters::XYZ;
use fil_machine::locations::{self as loc, RotarySwivelReference};
use nalgebra::Rotation3;

use super::put_text;
use crate::control::Control;
use crate::control_state::modal;
use crate::euler::Euler;

/// Turns about X, the new Y and the new Z, axis by axis.
const X_Y_Z: u32 = 57;

/// Begins a plane about the zero of the program; the rotary axes stand there already.
/// `higher`: they stand at the higher one of two positions of the reference axis. Says
/// how the plane lies as the block has it.
///
/// # Errors
/// A block longer than the control reads.
pub fn begin(control: &mut Control, turn: &Rotation3<f64>, higher: bool) -> Result<Rotation3<f64>> {
    let waiting = control.block.take();
    let texts = Euler::MovingXyz.angles(turn).map(|angle| format!("{angle:.5}"));
    let written = [0, 1, 2].map(|n| texts[n].parse::<f64>().unwrap_or(0.0));
    let [a, b, c] = texts.each_ref().map(|text| short(text));
    let record = control.commons.int_opt(loc::ROTARY_SWIVEL_RECORD).unwrap_or(1);
    let direction = if higher { 1 } else { -1 };
    let call =
        format!("CYCLE800(0,\"TC{record}\",0,{X_Y_Z},0,0,0,{a},{b},{c},0,0,0,{direction},0)");
    put_text(control, &call)?;
    control.block = waiting;
    Ok(Euler::MovingXyz.turn(written))
}

/// Ends the plane.
///
/// # Errors
/// As [`begin`].
pub fn end(control: &mut Control) -> Result<()> {
    let waiting = control.block.take();
    put_text(control, "CYCLE800()")?;
    control.block = waiting;
    Ok(())
}

/// Begins tool-tip control: TRAORI.
///
/// # Errors
/// As [`begin`].
pub fn begin_tip_control(control: &mut Control) -> Result<()> {
    switch(control, "TRAORI", true)
}

/// Ends it: TRAFOOF.
///
/// # Errors
/// As [`begin`].
pub fn end_tip_control(control: &mut Control) -> Result<()> {
    switch(control, "TRAFOOF", false)
}

fn switch(control: &mut Control, statement: &str, on: bool) -> Result<()> {
    let waiting = control.block.take();
    put_text(control, statement)?;
    control.block = waiting;
    control.state.set(modal::TCP, on);
    XYZ.into_iter().for_each(|letter| control.state.doubt(letter));
    Ok(())
}

/// The rotary axis, 0 or 1, whose positions the direction compares.
pub fn reference(control: &Control) -> usize {
    match control.commons.read(loc::ROTARY_SWIVEL_REFERENCE) {
        RotarySwivelReference::FirstRotaryAxis => 0,
        RotarySwivelReference::SecondRotaryAxis => 1,
    }
}

/// Without zeros at the end, and without the sign of zero.
fn short(text: &str) -> &str {
    match text.trim_end_matches('0').trim_end_matches('.') {
        "-0" => "0",
        text => text,
    }
}
