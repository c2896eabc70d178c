//! FEDRAT/f,unit: the feed of the motions to come; value and unit in either order.
//! FEDRAT/INVERS,AUTO|OFF: whether they say the feed or how long they take.
//! FEDRAT/LOCK,ON|OFF: whether the operator may override it.

use fil_cl::WordId;
use fil_cl::vocabulary::words as w;
use fil_diag::Result;
use fil_machine::modes::{FeedMode, INCH, Unit};
use fil_machine::{letters, locations as loc};

use super::cycle;
use crate::errors::PostCode;
use crate::items::Items;
use crate::operation::{Feed, Operation};
use crate::path::{carry_out, thread};
use crate::post::Post;

/// Units of a feed.
pub const UNITS: &[WordId] = &[w::MMPM, w::IPM, w::FPM, w::MMPR, w::IPR, w::FPR, w::UPM, w::UPR];

/// Inches of a foot.
const FOOT: f64 = 12.0;

/// Sets the feed.
///
/// # Errors
/// No number, a feed that is not positive, inverse time on a machine without it.
pub fn handle(post: &mut Post, items: &mut Items) -> Result<()> {
    if items.flag(w::INVERS) {
        inverse_time(post, items)?;
        if items.all_taken() {
            return Ok(());
        }
    }
    if items.flag(w::LOCK) {
        lock_override(post, items)?;
        if items.all_taken() {
            return Ok(());
        }
    }
    let unit = items.any_of(UNITS);
    let value = items.required("the feed")?;
    post.due_to(items);
    if value <= 0.0 {
        return Err(items.error(format!("a feed of {value} is not positive")));
    }
    items.deny_rest()?;
    let feed = in_output_units(post, value, unit)?;
    post.path.feed = Some(within_limits(post, feed));
    warn_beside_second_spindle(post, feed);
    thread::end(post)?;
    cycle::take_feed(post)
}

/// Warns of a feed a turn while the second spindle turns on a machine that does not say which one
/// its control counts.
pub fn warn_beside_second_spindle(post: &mut Post, feed: Feed) {
    if feed.mode == FeedMode::PerRevolution && post.control.spindle.side_turns {
        post.warn(PostCode::FeedOfSpindle, "the turns may be those of the main one".to_string());
    }
}

/// LOCK,ON takes the feed override from the operator, LOCK,OFF gives it back.
fn lock_override(post: &mut Post, items: &mut Items) -> Result<()> {
    let (at, what) = match items.any_of(&[w::ON, w::OFF]) {
        Some(w::ON) => (loc::OVERRIDE_OFF_CODE, "FEDRAT/LOCK,ON"),
        Some(_) => (loc::OVERRIDE_ON_CODE, "FEDRAT/LOCK,OFF"),
        None => return Err(items.error("LOCK needs ON or OFF")),
    };
    let code = post.control.code(at, what)?;
    carry_out(post, Operation::Function(letters::M, code))
}

/// INVERS,AUTO makes the feed motions to come say how long they take; INVERS,OFF ends it.
fn inverse_time(post: &mut Post, items: &mut Items) -> Result<()> {
    post.path.inverse_time = match items.any_of(&[w::AUTO, w::ON, w::OFF]) {
        Some(word) => word != w::OFF,
        None => return Err(items.error("INVERS needs AUTO or OFF: the post computes the times")),
    };
    if post.path.inverse_time {
        post.control.code(loc::FEED_INVERSE_CODE, "inverse time")?;
    }
    Ok(())
}

/// A feed in the unit of the program, per minute when no unit is given; its cause is
/// the word that the record is at.
///
/// # Errors
/// Nothing has said the unit of the program.
pub fn in_output_units(post: &Post, value: f64, unit: Option<WordId>) -> Result<Feed> {
    let inch = match post.control.require_unit()? {
        Unit::Mm => INCH,
        Unit::Inch => 1.0,
    };
    let (factor, mode) = match unit {
        Some(w::MMPM) => (inch / INCH, FeedMode::PerMinute),
        Some(w::IPM) => (inch, FeedMode::PerMinute),
        Some(w::FPM) => (FOOT * inch, FeedMode::PerMinute),
        Some(w::MMPR) => (inch / INCH, FeedMode::PerRevolution),
        Some(w::IPR) => (inch, FeedMode::PerRevolution),
        Some(w::FPR) => (FOOT * inch, FeedMode::PerRevolution),
        Some(w::UPR) => (1.0, FeedMode::PerRevolution),
        _ => (1.0, FeedMode::PerMinute),
    };
    let value = value * factor;
    Ok(Feed { value, asked: value, mode, cause: post.control.block.cause })
}

/// Brings a feed per minute within the machine's range (DBLCOM 114, 120), with
/// a warning, and into the control's unit (DBLCOM 743).
pub fn within_limits(post: &mut Post, feed: Feed) -> Feed {
    if feed.mode == FeedMode::PerRevolution {
        return feed;
    }
    let commons = &post.control.commons;
    let min = commons.dbl_opt(loc::FEED_UPM_MIN).unwrap_or(0.0);
    let max = commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::MAX);
    let factor = commons.dbl_opt(loc::FEED_UPM_FACTOR).unwrap_or(1.0);
    let value = feed.value.max(min).min(max);
    if value != feed.value {
        post.warn(PostCode::Clamped, format!("feed {} became {value}", feed.value));
    }
    Feed { value: value * factor, asked: feed.value * factor, ..feed }
}

/// A feed per minute in the control's unit (DBLCOM 743), which the spindle binds: no limit
/// changes it.
pub fn in_unit_of_control(post: &Post, feed: Feed) -> Feed {
    if feed.mode == FeedMode::PerRevolution {
        return feed;
    }
    let value = feed.value * post.control.upm_factor();
    Feed { value, asked: value, ..feed }
}
