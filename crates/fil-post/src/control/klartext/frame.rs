//! Tilted planes: PLANE SPATIAL, and PLANE RESET. Tool-tip control: FUNCTION TCPM or M128.

use fil_diag::Result;
use fil_machine::letters::XYZ;
use fil_machine::locations::{self as loc, RotaryTcpm};
use nalgebra::Rotation3;

use super::line::{self, Line};
use crate::control::Control;
use crate::control_state::modal;
use crate::euler::Euler;

/// Begins a plane about the datum; the rotary axes stand there already (STAY). Says how
/// the plane lies as the line has it.
///
/// # Errors
/// A line longer than the control reads.
pub fn begin(control: &mut Control, turn: &Rotation3<f64>) -> Result<Rotation3<f64>> {
    let angles = Euler::FixedXyz.angles(turn).map(|angle| format!("{angle:+.4}"));
    let written = [0, 1, 2].map(|n| angles[n].parse::<f64>().unwrap_or(0.0));
    let [a, b, c] = angles.each_ref().map(|text| short(text));
    put(control, &format!("PLANE SPATIAL SPA{a} SPB{b} SPC{c} STAY"))?;
    Ok(Euler::FixedXyz.turn(written))
}

/// Ends the plane.
///
/// # Errors
/// As [`begin`].
pub fn end(control: &mut Control) -> Result<()> {
    put(control, "PLANE RESET STAY")
}

/// Begins tool-tip control: rotary words are positions of the axes, F is that of the tip.
///
/// # Errors
/// As [`begin`].
pub fn begin_tip_control(control: &mut Control) -> Result<()> {
    let statement = match control.commons.read(loc::ROTARY_TCPM) {
        RotaryTcpm::FunctionTcpm => "FUNCTION TCPM F TCP AXIS POS PATHCTRL AXIS",
        RotaryTcpm::M128 => "M128",
    };
    switch(control, statement, true)
}

/// Ends it.
///
/// # Errors
/// As [`begin`].
pub fn end_tip_control(control: &mut Control) -> Result<()> {
    let statement = match control.commons.read(loc::ROTARY_TCPM) {
        RotaryTcpm::FunctionTcpm => "FUNCTION RESET TCPM",
        RotaryTcpm::M128 => "M129",
    };
    switch(control, statement, false)
}

fn switch(control: &mut Control, statement: &str, on: bool) -> Result<()> {
    put(control, statement)?;
    control.state.set(modal::TCP, on);
    XYZ.into_iter().for_each(|letter| control.state.doubt(letter));
    Ok(())
}

fn put(control: &mut Control, text: &str) -> Result<()> {
    control.begin()?;
    let cause = control.block.cause;
    line::put(control, &Line::of_text(text, cause))
}

/// Without zeros at the end; zero has a plus.
fn short(text: &str) -> String {
    let text = text.trim_end_matches('0').trim_end_matches('.');
    if text == "-0" { "+0".to_string() } else { text.to_string() }
}
