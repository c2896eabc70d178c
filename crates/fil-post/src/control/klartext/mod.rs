//! Heidenhain Klartext (TNC 640): lines of phrases. `L X+10 R0 FMAX M3` is a motion,
//! `CC` and `C … DR+` an arc, `TOOL CALL` a tool or a speed, `CYCL DEF` with `M99` a hole.
//!
//! Modes that words of a word-address control switch are said in each line or not at
//! all, so there is no plane, no G90, no G80: the tool axis is Z, coordinates are
//! absolute. What Klartext can't say is refused by `PostCode::Family`.

pub mod cycle;
mod datum;
pub mod family;
pub mod frame;
pub mod helix;
pub mod line;
pub mod motion;
pub mod phrase;
pub mod program;
pub mod reader;
mod repeat;
pub mod skip;
mod spindle;
pub mod tool;
mod words;

use fil_diag::Result;
use fil_machine::letters::M;
use fil_machine::locations::{self as loc, Placement};
use fil_machine::modes::Plane;
use fil_machine::{FunctionCode, Letter};

use super::word_address::dwell::seconds_of_turns;
use super::{Control, Function, own_offsets, word_address};
use crate::control_state::{Compensation, modal};
use crate::errors::PostCode;
use crate::operation::{CutterCompensation, Dwell, Operation};
use line::Line;

/// What Klartext needs besides what all controls have.
#[derive(Clone, Debug, Default)]
pub struct Klartext {
    /// Number of the next line.
    next_line: u64,
    /// What the block under construction says besides its words.
    phrase: phrase::Phrase,
    /// The lines of the cycle that was defined last.
    defined: Vec<String>,
    /// The spindle was last told to turn clockwise.
    clockwise: Option<bool>,
    /// Where a helix has left the tool in X and Y, mm or inch, within half a last digit of
    /// what the tape said last; `None` for an axis that a word has moved since.
    stands: [Option<f64>; 2],
    /// The last two before the lines that may be skipped.
    before_skip: (Option<bool>, [Option<f64>; 2]),
    /// The last line with a motion was at feed.
    pub(super) at_feed: bool,
    /// Name of the program, between BEGIN PGM and END PGM.
    name: String,
    /// END PGM stands on the tape.
    ended: bool,
}

impl Klartext {
    /// Where the tool stands in X and Y, mm or inch, as a helix may have left it there.
    pub fn start(&self, on_tape: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|axis| self.stands[axis].unwrap_or(on_tape[axis]))
    }
}

/// Writes an operation that does not depend on the path.
///
/// # Errors
/// What Klartext can't say; and as [`word_address::write`].
pub fn write(control: &mut Control, operation: Operation) -> Result<()> {
    match operation {
        Operation::Dwell(dwell) => write_dwell(control, dwell),
        Operation::Spindle(spindle) => spindle::write(control, spindle),
        Operation::Compensation(compensation) => compensate(control, compensation),
        Operation::SelectTool(tool) => tool::select(control, tool),
        Operation::Function(letter, code) => function(control, letter, code),
        Operation::WithMotion(M, code) => {
            refuse_auxiliary(code)?;
            word_address::write(control, operation)
        }
        Operation::WithMotion(letter, code) => function(control, letter, code),
        Operation::Words(words) => words::write(control, &words),
        Operation::Repeat(words) => repeat::set(control, words),
        Operation::WorkOffset(number) => datum::write(control, number),
        Operation::Message(text) => message(control, &text),
        other => word_address::write(control, other),
    }
}

/// Cycle 9 waits; it counts seconds only.
fn write_dwell(control: &mut Control, dwell: Dwell) -> Result<()> {
    let seconds = match dwell {
        Dwell::Seconds(seconds) => seconds,
        Dwell::Revolutions(turns) => seconds_of_turns(control, turns)?,
    };
    control.begin()?;
    let seconds = line::seconds(control, seconds)?;
    let cause = control.block.cause;
    line::put(control, &Line::of_text("CYCL DEF 9.0 DWELL TIME", cause))?;
    line::put(control, &Line::of_text(&format!("CYCL DEF 9.1 DWELL {seconds}"), cause))
}

/// RL, RR or R0, with the next motion of X or Y; R0 with any motion.
fn compensate(control: &mut Control, wanted: CutterCompensation) -> Result<()> {
    if wanted.plane.is_some_and(|(plane, _)| plane != Plane::Xy) {
        return PostCode::Family
            .err("CUTCOM in another plane than XY: the tool axis of TOOL CALL is Z");
    }
    if let Some((offset, _)) = wanted.offset {
        let tool = control.state.get(modal::TOOL);
        if tool.is_none_or(|tool| tool as f64 != offset) && wanted.side != Compensation::Off {
            let message = format!(
                "CUTCOM with offset {offset}: RL and RR take the radius of the tool that was called"
            );
            own_offsets::leave_out(control, tool, offset, &message)?;
        }
    }
    control.asked = wanted.side;
    if control.take_function(Function::Compensation) {
        let message = "CUTCOM: no motion came before the next CUTCOM".to_string();
        control.warnings.add(PostCode::IgnoredPart, message);
    }
    let was = control.state.get(modal::CUTTER_COMP);
    if was == Some(wanted.side) {
        return Ok(());
    }
    control.place_block(Function::Compensation, Placement::NextXyBlock)
}

/// An M function by its number.
fn function(control: &mut Control, letter: Letter, code: FunctionCode) -> Result<()> {
    control.begin()?;
    if letter != M {
        return PostCode::Family
            .err(format!("{letter}{}: Klartext has no such functions", code.value()));
    }
    refuse_auxiliary(code)?;
    let before = control.before_others()?;
    control.m(code);
    control.write_block()?;
    control.doubt_changes(before)
}

/// Refuses an M function that changes what the post counts on.
fn refuse_auxiliary(code: FunctionCode) -> Result<()> {
    match reader::meaning(code.value()) {
        reader::Auxiliary::Harmless => Ok(()),
        _ => PostCode::Family
            .err(format!("AUXFUN: M{} changes what motions or cycles do", code.value())),
    }
}

/// A comment, in lines as long as the machine allows.
fn message(control: &mut Control, text: &str) -> Result<()> {
    let longest = control.commons.int(loc::MESSAGE_MAX_CHARS).clamp(1, 120) as usize;
    let clean: Vec<char> =
        text.chars().map(|c| if c.is_control() || c == '~' { ' ' } else { c }).collect();
    if clean.iter().zip(text.chars()).any(|(clean, c)| *clean != c) {
        let message =
            format!("characters that are not allowed in a program in `{}`", text.escape_debug());
        control.warnings.add(PostCode::IgnoredPart, message);
    }
    for part in clean.chunks(longest) {
        let part: String = part.iter().collect();
        control.write_line(&format!("; {}", part.trim_end()), true)?;
    }
    Ok(())
}
