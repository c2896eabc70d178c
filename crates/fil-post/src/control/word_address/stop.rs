//! Stops and the end of the program.

use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::{Control, program};
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::{End, Stop};

/// Writes a stop, after all that still waits for a motion.
///
/// # Errors
/// The machine has no code for it.
pub fn stop(control: &mut Control, stop: Stop) -> Result<()> {
    control.flush_waiting()?;
    let code = match stop {
        Stop::Always => control.code(loc::PROGRAM_STOP_CODE, "STOP")?,
        Stop::Optional => control.code(loc::PROGRAM_OPSTOP_CODE, "OPSTOP")?,
    };
    control.m(code);
    control.write_block()
}

/// Ends the program once. The second END or REWIND of a CL file says nothing new;
/// it warns where it would have ended the program otherwise than the first.
///
/// # Errors
/// The machine has no such code; and as [`program::end`].
pub fn end(control: &mut Control, end: End) -> Result<()> {
    if control.state.may_be(modal::PROGRAM_END, true) {
        let word = match end {
            End::OfFile => return program::close_ended(control),
            End::Stay => return Ok(()),
            End::Rewind => "REWIND",
            End::By(_) => "AUXFUN",
        };
        let message = format!("{word}: the program has ended before");
        control.warnings.add(PostCode::IgnoredPart, message);
        return Ok(());
    }
    let code = match end {
        End::Stay => Some(control.code(loc::PROGRAM_END_CODE, "END")?),
        End::Rewind => Some(control.code(loc::PROGRAM_REWIND_CODE, "REWIND")?),
        End::By(code) => return program::end_by(control, code),
        End::OfFile => control
            .code_if_any(loc::PROGRAM_REWIND_CODE)
            .or_else(|| control.code_if_any(loc::PROGRAM_END_CODE)),
    };
    program::end(control, code)
}
