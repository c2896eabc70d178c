//! The spindle: `S1000 M3`, `SPOS=90`, `LIMS=3000`.

use fil_diag::Result;
use fil_machine::letters::F;
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;

use crate::control::Control;
use crate::control::family::refuse;
use crate::control::word_address::spindle as words;
use crate::control_state::Rotation;
use crate::operation::{Spindle, SpindleSpeed};

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
            super::put_text(control, &format!("{name}={}", plain(angle, DIGITS)))?;
            control.state.rotation = Rotation::Standing;
            control.turning = None;
            Ok(())
        }
        Spindle::Turn(turn) => {
            words::write(control, Spindle::Turn(turn))?;
            control.sinumerik.clockwise = Some(control.turned.unwrap_or(true));
            if turn.speed.is_some() {
                takes_feed_a_turn(control, turn.speed);
            }
            Ok(())
        }
        other => words::write(control, other),
    }
}

/// Says the highest speed.
///
/// # Errors
/// As a line on the tape.
pub fn limit(control: &mut Control, limit: f64) -> Result<()> {
    super::put_text(control, &format!("LIMS={}", plain(limit, DIGITS)))
}

/// G96 and G97 are feeds a turn: they stand in one group with G94 and G95.
fn takes_feed_a_turn(control: &mut Control, speed: Option<SpindleSpeed>) {
    let at = match speed {
        Some(SpindleSpeed::Revolutions(_)) => loc::SPINDLE_RPM_CODE,
        _ => loc::SPINDLE_CSS_CODE,
    };
    if control.code_if_any(at).is_some() {
        control.state.feed_mode = Some(FeedMode::PerRevolution);
        control.tables.format_feed(FeedMode::PerRevolution);
        control.state.doubt(F);
    }
}

/// Refuses a feed mode that would end a surface speed.
///
/// # Errors
/// One is in force.
pub fn check_feed_mode(control: &Control) -> Result<()> {
    if words::is_of_surface(control) {
        return refuse(
            "G94 or G95 under a surface speed: they stand in one group with G96 and would end it; \
             give the feed a turn, or SPINDL / RPM",
        );
    }
    Ok(())
}

/// A number without zeros at its end.
fn plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}
