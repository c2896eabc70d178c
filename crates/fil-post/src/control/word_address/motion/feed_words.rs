//! The feed of a motion: the code of its mode, and F.

use fil_diag::Result;
use fil_machine::letters::F;
use fil_machine::locations as loc;
use fil_machine::modes::FeedMode;
use fil_machine::setting::CodeAt;

use super::super::spindle::{self, counted};
use crate::control::Control;
use crate::control::needs;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::Feed;

/// Adds the feed mode code and the F word where the control does not have them.
///
/// # Errors
/// No feed was given, or it does not fit its address.
#[inline]
pub fn feed_words(control: &mut Control, feed: Option<&Feed>) -> Result<()> {
    let feed = needs::feed(feed)?;
    feed_mode(control, feed)?;
    control.modal_feed(F, feed)
}

/// Adds the code of a feed's mode where the control is not in it.
///
/// # Errors
/// The machine has no such code.
#[inline]
pub fn feed_mode(control: &mut Control, feed: &Feed) -> Result<()> {
    if !control.state.is(modal::FEED_MODE, feed.mode) {
        return say_feed_mode(control, feed);
    }
    if feed.mode == FeedMode::PerRevolution { refuse_standing(control) } else { Ok(()) }
}

/// Refuses a feed a turn of a spindle that is known to stand: the control would wait for its
/// turns, or some text would turn it with the tool in the part.
///
/// # Errors
/// It stands, and the machine has no second spindle whose turns the feed may count; which one the
/// control counts is not known.
fn refuse_standing(control: &Control) -> Result<()> {
    if counted::is_unknown(control) {
        return PostCode::FeedStands.err(format!("feed per revolution: {}", counted::WHICH));
    }
    let has_other = control.code_if_any(loc::SPINDLE_SIDE_CW_CODE).is_some();
    if !spindle::stands(control) || has_other && !counted::is_chosen(control) {
        return Ok(());
    }
    if control.tables.mill_turn.is_some() {
        return PostCode::MillTurn.err(
            "feed per revolution of the main spindle, which is stopped; start it with SPINDL",
        );
    }
    PostCode::FeedStands.err("feed per revolution while the spindle is stopped")
}

#[cold]
fn say_feed_mode(control: &mut Control, feed: &Feed) -> Result<()> {
    if feed.mode == FeedMode::PerRevolution {
        refuse_standing(control)?;
    }
    if control.family().says_feed_mode(control, feed)? {
        return Ok(());
    }
    let code = control.code(feed_mode_code(feed.mode), "this feed mode")?;
    control.tables.format_feed(feed.mode);
    if control.commons.read(loc::FEED_CODE_WITH_MOTION) {
        control.block.g(code, feed.cause.whole());
        control.state.doubt(F);
        return Ok(());
    }
    let motion = control.block.take();
    control.block.g(code, feed.cause.whole());
    control.state.doubt(F);
    let with_feed = control.commons.read(loc::FEED_PRINT_WITH_CODE);
    if with_feed && feed.mode != FeedMode::InverseTime {
        control.modal_feed(F, feed)?;
    }
    control.write_block()?;
    control.block = motion;
    Ok(())
}

/// Ends inverse time, in which each block has an F of its own: whatever comes next, a
/// text of the user's too, counts on the usual feed.
///
/// # Errors
/// The machine has no code for a feed a minute.
pub fn leave_inverse_time(control: &mut Control) -> Result<()> {
    if !control.state.is(modal::FEED_MODE, FeedMode::InverseTime) {
        return Ok(());
    }
    let code = control.code(loc::FEED_UPM_CODE, "this feed mode")?;
    control.tables.format_feed(FeedMode::PerMinute);
    control.g(code);
    control.write_block()
}

/// Location of a feed mode's preparatory function.
fn feed_mode_code(mode: FeedMode) -> CodeAt {
    match mode {
        FeedMode::PerMinute => loc::FEED_UPM_CODE,
        FeedMode::PerRevolution => loc::FEED_UPR_CODE,
        FeedMode::InverseTime => loc::FEED_INVERSE_CODE,
    }
}
