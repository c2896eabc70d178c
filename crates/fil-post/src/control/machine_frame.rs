//! Rapid motions to positions in the frame of the machine: `G53 G0 Z0.`, `L Z+0 R0 FMAX M91`.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::commons::EMPTY;
use fil_machine::letters::{D, G, H, UVW, XYZ};
use fil_machine::locations::{self as loc, HomeFrame, HomeLatheOrder};
use fil_machine::{FunctionCode, Letter};

use super::{Control, full_turn};
use crate::cause::Cause;
use crate::control::needs::Act;
use crate::control_state::{MachineSpot, Source, modal};
use crate::errors::PostCode;
use crate::operation::motion::Motion;

/// The axes of the block go where they say in the frame of the machine.
const MACHINE: FunctionCode = FunctionCode::whole(53);

/// An OSP: axis words of the block count from the zero of the machine, which H0 names.
const TO_END_OF_TRAVEL: FunctionCode = FunctionCode::whole(16);

/// True for a machine whose home, retract and change positions are its own coordinates, or its
/// reference point.
pub fn is_meant(control: &Control) -> bool {
    control.commons.read(loc::HOME_FRAME) != HomeFrame::OfThePart
}

/// The letter of increments along an axis of a lathe, where home is the reference point.
fn of_increments(control: &Control, axis: Letter) -> Option<Letter> {
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    let number = XYZ.iter().position(|letter| *letter == axis)?;
    reference(control).filter(|_| is_lathe).map(|_| UVW[number])
}

/// The function that goes to a point that the control knows, where home is that.
fn reference(control: &Control) -> Option<FunctionCode> {
    match control.commons.read(loc::HOME_FRAME) {
        HomeFrame::OfThePart | HomeFrame::OfTheMachine => None,
        HomeFrame::ReferencePoint => Some(FunctionCode::whole(28)),
        HomeFrame::SecondReferencePoint => Some(FunctionCode::whole(30)),
        HomeFrame::EndOfTravel => Some(TO_END_OF_TRAVEL),
    }
}

/// What comes behind the motion.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Before {
    /// A tool change, which says the offset of the new tool.
    ToolChange,
    /// The end of the program: no tool is used any more.
    End,
    /// Anything else: the offset of the tool stays.
    Others,
}

/// Goes to a position of the machine, Z before X and Y before the rotary axes: where the tool
/// stands in this frame is not known, so nothing goes across before it is up. Where the
/// axes stand in the part is not known behind it.
///
/// # Errors
/// Cutter compensation; a value that does not fit; on a SINUMERIK a cutting edge that is not
/// known, and would be lost.
pub fn go(control: &mut Control, motion: &Motion, before: Before, cause: Cause) -> Result<()> {
    control.ready_for(Act::MachineFrame)?;
    let present = control.tables.present();
    if motion.axes.and(present).is_empty() {
        return Ok(());
    }
    let has_edges = control.can().cutting_edges;
    let edge = control.sinumerik.edge().filter(|_| has_edges);
    if has_edges && edge.is_none() && before == Before::Others {
        return PostCode::Family.err(
            "machine coordinates while the active cutting edge is unknown: the D word that cancels the tool length offset could not be restored",
        );
    }
    let there = if before == Before::Others { AxisSet::NONE } else { at_target(control, motion)? };
    for group in groups(control) {
        let axes = group.and(motion.axes).and(present).without(there);
        if !axes.is_empty() {
            control.because(cause, |control| block(control, &motion.of(axes)))?;
        }
    }
    match edge.filter(|_| before == Before::Others) {
        Some(edge) => control.because(cause, |control| {
            control.word(D, edge as f64)?;
            control.write_block()
        }),
        None => Ok(()),
    }
}

/// The axes that go together, in their order. Of a lathe neither axis is the one that must go first:
/// as all its rapid motions this is one block, where the settings do not say otherwise.
fn groups(control: &Control) -> [AxisSet; 4] {
    let is_lathe = control.commons.read(loc::LATHE_DIAMETER);
    match control.commons.read(loc::HOME_LATHE_ORDER) {
        _ if !is_lathe => [AxisSet::Z, AxisSet::XY, AxisSet::ROTARY, AxisSet::NONE],
        HomeLatheOrder::OneBlock => {
            [AxisSet::Z.or(AxisSet::XY), AxisSet::ROTARY, AxisSet::NONE, AxisSet::NONE]
        }
        HomeLatheOrder::XThenZ => [AxisSet::XY, AxisSet::Z, AxisSet::ROTARY, AxisSet::NONE],
        HomeLatheOrder::YThenXThenZ => {
            [AxisSet::of(1), AxisSet::of(0), AxisSet::Z, AxisSet::ROTARY]
        }
    }
}

/// Where a motion brings an axis, with the axis' word in machine coordinates.
fn target(control: &Control, motion: &Motion, number: usize) -> Result<(MachineSpot, i64)> {
    let axis = control.tables.axis(number);
    // A zero that the control has shifted does not count in this frame.
    let zero = control.tables.zero().get(number).copied().unwrap_or(0.0);
    let to = motion.position[number] + zero;
    let spot = match reference(control) {
        Some(function) => MachineSpot::Reference(function),
        None => MachineSpot::At(axis.value(to)?),
    };
    Ok((spot, axis.scaled(to)?))
}

/// The axes of a motion that stand where it brings them: an author's block, GOHOME or RETRCT has
/// been there.
fn at_target(control: &Control, motion: &Motion) -> Result<AxisSet> {
    let mut there = AxisSet::NONE;
    for number in motion.axes.numbers() {
        let letter = control.tables.axis(number).letter;
        if control.state.machine_spot(letter) == Some(target(control, motion, number)?.0) {
            there = there.or(AxisSet::of(number));
        }
    }
    Ok(there)
}

fn block(control: &mut Control, motion: &Motion) -> Result<()> {
    control.family().ready(control)?;
    if !motion.axes.and(AxisSet::ROTARY).is_empty() {
        full_turn::release(control)?;
    }
    for number in motion.axes.numbers() {
        let axis = *control.tables.axis(number);
        let Some(position) = axis.tape_position()? else { continue };
        match of_increments(control, axis.letter) {
            Some(letter) => control.word(letter, 0.0)?,
            None => control.block.put(position, target(control, motion, number)?.1),
        }
    }
    control.family().to_machine_position(control)?;
    for number in motion.axes.numbers() {
        let letter = control.tables.axis(number).letter;
        let (spot, _) = target(control, motion, number)?;
        control.commons.set_last_output(letter, EMPTY);
        control.state.clears(letter, Some(spot));
    }
    let moved = |axis| motion.axes.numbers().any(|n| control.tables.axis(n).letter == axis);
    control.state.length_ends_at_machine(&control.codes, moved);
    Ok(())
}

/// Writes the block under construction as a way to the reference point. A lathe has letters of
/// increments; a mill turns to increments and back.
fn to_reference(control: &mut Control, function: FunctionCode) -> Result<()> {
    control.g(function);
    if control.commons.read(loc::LATHE_DIAMETER) {
        return control.write_block();
    }
    let code = |control: &Control, at| control.code(at, "the way to the reference point");
    control.g(code(control, loc::MODE_INCREMENTAL_CODE)?);
    control.write_block()?;
    control.g(code(control, loc::MODE_ABSOLUTE_CODE)?);
    control.write_block()
}

/// Writes the block under construction as a rapid motion to the positive ends of the travel, which
/// system variables of an OSP name: `G16 H0 G0 Z=VPSLZ`.
fn to_end_of_travel(control: &mut Control) -> Result<()> {
    let rapid = control.code(loc::RAPID_CODE_Z, "rapid move")?;
    let axes = control.block.take().words(&control.tables.addresses);
    let functions = [(G, TO_END_OF_TRAVEL), (H, FunctionCode::whole(0)), (G, rapid)];
    let functions = functions.map(|(letter, code)| format!("{letter}{code}"));
    let axes = axes.into_iter().map(|(letter, ..)| format!("{letter}=VPSL{letter}"));
    let words: Vec<_> = functions.into_iter().chain(axes).collect();
    let between = if control.tables.addresses.blank { " " } else { "" };
    control.write_line(&words.join(between), true)?;
    control.state.forget(modal::MOTION, Source::Post);
    Ok(())
}

/// Writes the block under construction as a rapid motion to a position of the machine by its
/// function (G53), and ends the length of the cutting edge in it (D0). To the reference point it
/// goes straight, by an increment of 0 (`G28 G91 Z0.`).
///
/// # Errors
/// The machine has no code for rapid motions, or none for increments.
pub(super) fn by_code(control: &mut Control, ends_edge: bool) -> Result<()> {
    match reference(control) {
        Some(TO_END_OF_TRAVEL) => return to_end_of_travel(control),
        Some(function) => return to_reference(control, function),
        None => {}
    }
    let code = control.code(loc::RAPID_CODE_Z, "rapid move")?;
    control.g(MACHINE);
    control.g(code);
    if ends_edge {
        control.word(D, 0.0)?;
    }
    control.write_block()
}
