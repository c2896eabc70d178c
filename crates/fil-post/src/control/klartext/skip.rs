//! Lines that the operator may skip: `/12 L X+10 R0 FMAX`.

use fil_diag::Result;

use crate::control::Control;
use crate::control_state::{Source, modal};
use crate::errors::PostCode;

/// The one mark that the control reads.
const MARK: char = '/';

/// Forgets what lines that may be skipped change; before they begin, what they could call.
///
/// # Errors
/// A machine with another mark.
pub fn change(control: &mut Control, on: bool) -> Result<()> {
    if on && control.tables.style.skip.is_some_and(|mark| mark != MARK) {
        return PostCode::Family
            .err("OPSKIP with another mark than /: a TNC accepts no other (tape.opskip_char)");
    }
    // A cycle that is defined on one side of the mark would be called on the other.
    control.state.forget(modal::CYCLE_CODE, Source::Post);
    control.klartext.defined.clear();
    let klartext = &mut control.klartext;
    if on {
        klartext.before_skip = (klartext.clockwise, klartext.stands);
        return Ok(());
    }
    let (clockwise, stands) = klartext.before_skip;
    if clockwise != klartext.clockwise {
        klartext.clockwise = None;
    }
    if stands != klartext.stands {
        klartext.stands = [None; 2];
    }
    Ok(())
}
