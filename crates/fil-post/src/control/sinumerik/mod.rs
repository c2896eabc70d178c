//! SINUMERIK 840D: blocks of words as those of a word-address control, with named
//! addresses (`CR=10`, `X1=5`, `SPOS=90`), calls of cycles (`MCALL CYCLE83(…)`) and
//! messages of their own.
//!
//! Modes, modality and positions are those of [`word_address`]; here is only what the
//! language says otherwise. What it can't say is refused by `PostCode::Family`.

pub mod block;
pub mod cycle;
pub mod family;
mod frame;
pub mod live_tap;
pub mod program;
pub mod reader;
pub(super) mod spindle;
pub mod swivel;
pub mod thread;
pub mod tool;
pub mod tool_names;
pub mod transformation;
pub mod translation;

use fil_diag::Result;
use fil_machine::letters::{F, S};
use fil_machine::locations::{self as loc, CircleCenter, ControlMessages};
use fil_machine::modes::Unit;
use fil_machine::rounding::Rounding;

use super::line::Line;
use super::word_address::dwell;
use super::{Control, own_offsets, word_address};
use crate::control::needs::Act;
use crate::control_state::{Compensation, modal};
use crate::errors::PostCode;
use crate::operation::{CutterCompensation, Dwell, Operation};

/// Longest text of MSG.
const LONGEST_MESSAGE: usize = 124;

/// The code of inches for lengths alone: feeds keep the unit of the machine.
const INCHES_OF_LENGTHS: u16 = 70;

/// What a SINUMERIK needs besides what all controls have.
#[derive(Clone, Debug, Default)]
pub struct Sinumerik {
    /// The cycle that MCALL calls, with the feed it takes.
    called: String,
    /// The cutting edge in force, `D`; `None` when it is not known.
    edge: Option<i64>,
    /// The spindle was last told to turn clockwise.
    clockwise: Option<bool>,
    /// What the CL file calls its tools.
    pub(crate) tool_names: tool_names::ToolNames,
}

impl Sinumerik {
    /// The cutting edge in force; `None` when it is not known.
    pub fn edge(&self) -> Option<i64> {
        self.edge
    }
}

/// Writes an operation that does not depend on the path.
///
/// # Errors
/// What the language can't say; and as [`word_address::write`].
pub fn write(control: &mut Control, operation: Operation) -> Result<()> {
    match operation {
        Operation::Dwell(dwell) => write_dwell(control, dwell),
        Operation::Spindle(spindle) => spindle::write(control, spindle),
        Operation::Compensation(compensation) => compensate(control, compensation),
        Operation::SelectTool(tool) => tool::select(control, tool),
        Operation::WorkOffset(number) => frame::write(control, number),
        Operation::Message(text) => message(control, &text),
        other => word_address::write(control, other),
    }
}

/// `G4 F1.5` waits seconds, `G4 S30` turns of the spindle; neither is a feed or a speed.
fn write_dwell(control: &mut Control, dwell: Dwell) -> Result<()> {
    let Dwell::Revolutions(turns) = dwell else {
        return word_address::write(control, Operation::Dwell(dwell));
    };
    let code = control.code(loc::DWELL_CODE, "a dwell")?;
    let turns = dwell::within(control, turns, (loc::DWELL_UPR_MIN, loc::DWELL_UPR_MAX));
    control.g_of_record(code);
    control.word_rounded(S, turns, Rounding::Rate)?;
    control.write_block()?;
    control.state.doubt(S);
    Ok(())
}

/// G41, G42 and G40. `D` is the cutting edge, whose radius they take and whose length is
/// in force with it, so that no offset of its own can be chosen here.
fn compensate(control: &mut Control, wanted: CutterCompensation) -> Result<()> {
    if let Some((offset, _)) = wanted.offset.filter(|_| wanted.side != Compensation::Off) {
        let in_force = control.sinumerik.edge.is_some_and(|edge| edge as f64 == offset);
        if !in_force {
            let message = format!(
                "CUTCOM with offset {offset}: D{offset} would choose another cutting edge with \
                 its length; OSETNO of LOADTL chooses it"
            );
            let tool = control.state.get(modal::TOOL);
            own_offsets::leave_out(control, tool, offset, &message)?;
        }
    }
    word_address::write(
        control,
        Operation::Compensation(CutterCompensation { offset: None, ..wanted }),
    )
}

/// Refuses settings whose words the language reads otherwise.
///
/// # Errors
/// They are set.
pub fn check_arc(control: &Control) -> Result<()> {
    let commons = &control.commons;
    let form = commons.read(loc::CIRCLE_CENTER);
    let center = !matches!(
        form,
        CircleCenter::StartToCenterSigned | CircleCenter::AbsoluteCenter | CircleCenter::Radius
    );
    if center {
        return PostCode::Family
            .err("circle.center: a center counts from the start with its sign, or is absolute");
    }
    if control.helix_words {
        return PostCode::Family.err("ARCSLP: a helix has no rise per radian here");
    }
    Ok(())
}

/// Refuses a feed in inches while only lengths are in inches.
///
/// # Errors
/// They are, and the machine does not count in inches.
pub fn check_unit(control: &Control) -> Result<()> {
    let inches = control.unit == Some(Unit::Inch) && Unit::of_machine(&control.commons).is_none();
    let lengths = control.commons.read(loc::UNITS_INCH_CODE) == Some(INCHES_OF_LENGTHS.into());
    if inches && lengths {
        return PostCode::Family.err(
            "feeds in inches with G70, which switches lengths alone: take G700 \
             (units.inch_code), or units.mode of a machine that counts in inches",
        );
    }
    Ok(())
}

/// A comment behind `;`, or a message on the screen.
fn message(control: &mut Control, text: &str) -> Result<()> {
    let on_screen = control.commons.read(loc::CONTROL_MESSAGES) == ControlMessages::Msg;
    let most = if on_screen { LONGEST_MESSAGE } else { 120 };
    let longest = control.commons.int(loc::MESSAGE_MAX_CHARS).clamp(1, most as i32) as usize;
    let harmful = |c: char| c == '%' || c.is_control();
    let clean: String = control.in_tape_characters(text);
    let clean: Vec<char> = clean
        .chars()
        .map(|c| match c {
            '"' if on_screen => '\'',
            c if harmful(c) => ' ',
            c => c,
        })
        .collect();
    if text.chars().any(harmful) {
        let message =
            format!("characters that are not allowed in a program in `{}`", text.escape_debug());
        control.warnings.add(PostCode::IgnoredPart, message);
    }
    let on_text = control.commons.read(loc::SEQNO_ON_TEXT);
    let numbered =
        matches!(on_text, loc::SeqnoOnText::Pprint | loc::SeqnoOnText::Both) || on_screen;
    for part in clean.chunks(longest) {
        let part: String = part.iter().collect();
        let part = part.trim_end();
        let line = if on_screen { format!("MSG(\"{part}\")") } else { format!("; {part}") };
        control.write_line(&line, numbered)?;
    }
    Ok(())
}

/// Adds F in a block of its own where the control does not have it: a cycle takes it up.
fn feed_before(control: &mut Control, feed: &crate::operation::Feed) -> Result<()> {
    let waiting = control.block.take();
    word_address::motion::feed_mode(control, feed)?;
    control.modal_feed(F, feed)?;
    control.write_block()?;
    control.block = waiting;
    Ok(())
}

/// Puts a statement on the tape in a block of its own, with the cause of the record.
fn put_text(control: &mut Control, text: &str) -> Result<()> {
    control.begin()?;
    control.require(Act::Block)?;
    let line = Line::of_text(text, control.block.cause);
    control.tape.items(&line.text, &line.items, true, &control.tables, &mut control.commons)
}
