//! The spindle: `S1000 M3`, `SPOS=90`, `LIMS=3000`.

use fil_diag::Result;
use fil_machine::locations as loc;

use crate::control::Control;
use crate::control::word_address::spindle as words;
use crate::operation::Spindle;

/// Digits after the point of an angle, degrees.
const DIGITS: usize = 3;

/// Writes the spindle's words.
///
/// # Errors
/// As [`words::write`]; a limit that is no number of turns.
pub fn write(control: &mut Control, spindle: Spindle) -> Result<()> {
    match spindle {
        Spindle::Orient(Some(angle)) => {
            control.begin()?;
            control.flush_waiting()?;
            let name = match control.commons.int_opt(loc::CONTROL_SPINDLE_INDEX) {
                Some(index) => format!("SPOS[{index}]"),
                None => "SPOS".to_string(),
            };
            super::put_text(control, &format!("{name}={}", plain(angle, DIGITS)))
        }
        Spindle::Limit(limit) => {
            control.begin()?;
            super::put_text(control, &format!("LIMS={}", plain(limit, DIGITS)))
        }
        Spindle::Turn(turn) => {
            let default = || {
                let code = control.code_if_any(loc::SPINDLE_DEFAULT_CODE);
                code != control.code_if_any(loc::SPINDLE_CCW_CODE)
            };
            control.sinumerik.clockwise = Some(turn.clockwise.unwrap_or_else(default));
            words::write(control, Spindle::Turn(turn))
        }
        other => words::write(control, other),
    }
}

/// A number without zeros at its end.
fn plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}
