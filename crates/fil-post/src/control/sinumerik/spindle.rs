//! The spindle: `S1000 M3`, `SPOS=90`, `LIMS=3000`.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::letters::{F, S};
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;

use crate::control::Control;
use crate::control::word_address::spindle as words;
use crate::control_state::{Rotation, modal};
use crate::errors::PostCode;
use crate::operation::{Feed, Spindle, SpindleSpeed};

/// Digits after the point of an angle, degrees.
const DIGITS: usize = 3;

/// A surface speed with feeds a turn, and the same with feeds a minute (Siemens, Programming Manual
/// Fundamentals: G96, G961).
const A_TURN: FunctionCode = FunctionCode::whole(96);
const A_MINUTE: FunctionCode = FunctionCode::whole(961);

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
            control.state.set(modal::SPINDLE, Rotation::Standing);
            control.spindle.turning = None;
            Ok(())
        }
        Spindle::Turn(turn) => {
            words::write(control, Spindle::Turn(turn))?;
            control.sinumerik.clockwise = Some(control.spindle.turned.unwrap_or(true));
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

/// Makes the second spindle of a lathe the master spindle, or the main one again: S and M without a
/// number, threads, feeds a turn and surface speeds are those of the master spindle (Siemens,
/// SINUMERIK ONE Programming Manual, 2.15.1.3).
///
/// # Errors
/// As a line on the tape.
pub fn choose_master(control: &mut Control, number: i32, is_side: bool) -> Result<()> {
    let statement = if is_side { format!("SETMS({number})") } else { "SETMS".to_string() };
    control.sinumerik.clockwise = None;
    super::put_text(control, &statement)
}

/// G97 stands alone in a block, and is a feed a turn, too.
pub fn counts_turns(control: &mut Control) {
    takes_feed_a_turn(control, Some(SpindleSpeed::Revolutions(0.0)));
}

/// G96 and G97 are feeds a turn: they stand in one group with G94 and G95.
fn takes_feed_a_turn(control: &mut Control, speed: Option<SpindleSpeed>) {
    let at = match speed {
        Some(SpindleSpeed::Revolutions(_)) => loc::SPINDLE_RPM_CODE,
        _ => loc::SPINDLE_CSS_CODE,
    };
    if control.code_if_any(at).is_some() {
        control.state.set(modal::FEED_MODE, FeedMode::PerRevolution);
        control.tables.format_feed(FeedMode::PerRevolution);
        control.state.doubt(F);
    }
}

/// Says a feed mode under a surface speed, in a block of its own: G94 and G95 stand in one group with
/// G96 and would end it, and G961 is G96 with feeds a minute. False where no surface speed is in
/// force.
///
/// # Errors
/// A text has given the surface speed, so that its S is not known; a machine that says it otherwise
/// than by G96; inverse time.
pub fn says_feed_mode(control: &mut Control, feed: &Feed) -> Result<bool> {
    if !words::is_of_surface(control) {
        return refuse_in_doubt(control).map(|()| false);
    }
    let of_surface =
        |speed: &SpindleSpeed| matches!(speed, SpindleSpeed::Meters(_) | SpindleSpeed::Feet(_));
    let usual = control.code_if_any(loc::SPINDLE_CSS_CODE).filter(|code| *code == A_TURN);
    let code = match feed.mode {
        FeedMode::PerMinute => Some(A_MINUTE),
        FeedMode::PerRevolution => Some(A_TURN),
        FeedMode::InverseTime => None,
    };
    let (Some(speed), Some(_), Some(code)) =
        (control.spindle.speed.filter(of_surface), usual, code)
    else {
        return PostCode::Family.err(
            "G94 or G95 at constant surface speed: they are in one modal group with G96 and would end it; give the feed per revolution, or SPINDL / RPM",
        );
    };
    let motion = control.block.take();
    control.block.g(code, feed.cause.whole());
    control.state.doubt(S);
    let value = words::value_of(control, speed);
    control.word(S, value)?;
    control.write_block()?;
    control.block = motion;
    control.tables.format_feed(feed.mode);
    Ok(true)
}

/// Refuses G94 and G95 where a surface speed may be in force still, with an S that nobody has read:
/// they would end it, and the spindle would go on at any speed.
fn refuse_in_doubt(control: &Control) -> Result<()> {
    if !control.state.surface_speed_is_open() || control.spindle.speed.is_some() {
        return Ok(());
    }
    PostCode::Family.err_with(
        "G94 or G95 after an unreadable foreign block with S, at constant surface speed: they are in one modal group with G96 and would end it",
        "Put SPINDL with SMM or RPM after the text.",
    )
}

/// A number without zeros at its end.
fn plain(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$}");
    text.trim_end_matches('0').trim_end_matches('.').to_string()
}
