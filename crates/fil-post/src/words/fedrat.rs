//! FEDRAT/f,unit: the feed of the motions to come; value and unit in either order.

use fil_cl::vocabulary::{Vocabulary, words as w};
use fil_cl::{Record, WordId};
use fil_diag::Diag;

use super::form::Form;
use crate::errors::PostCode;
use crate::kinematics::INCH;
use crate::locations as loc;
use crate::post::Post;
use crate::state::{Feed, FeedMode};

const UNITS: &[WordId] = &[w::MMPM, w::IPM, w::FPM, w::MMPR, w::IPR, w::FPR, w::UPM, w::UPR];

/// Sets the feed.
///
/// # Errors
/// No number, a feed that is not positive, or inverse time.
pub fn handle(post: &mut Post, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
    let mut form = Form::new(record, vocabulary);
    if form.flag(w::INVERS) {
        return Err(form.error("inverse time is not supported"));
    }
    let unit = form.any_of(UNITS);
    let value = form.required("the feed")?;
    post.due_to(&form);
    if value <= 0.0 {
        return Err(form.error(format!("a feed of {value} is not positive")));
    }
    form.end()?;
    let feed = in_output_units(value, unit, post);
    post.state.feed = Some(within_limits(post, feed));
    post.state.thread = None;
    Ok(())
}

/// A feed in the unit of the CL file, per minute when no unit is given; it is
/// due to the word that the record is at.
pub fn in_output_units(value: f64, unit: Option<WordId>, post: &Post) -> Feed {
    let metric = post.state.metric;
    let (factor, mode) = match unit {
        Some(w::MMPM) => (if metric { 1.0 } else { 1.0 / INCH }, FeedMode::PerMinute),
        Some(w::IPM) => (if metric { INCH } else { 1.0 }, FeedMode::PerMinute),
        Some(w::FPM) => (if metric { 12.0 * INCH } else { 12.0 }, FeedMode::PerMinute),
        Some(w::MMPR) => (if metric { 1.0 } else { 1.0 / INCH }, FeedMode::PerRevolution),
        Some(w::IPR) => (if metric { INCH } else { 1.0 }, FeedMode::PerRevolution),
        Some(w::FPR) => (if metric { 12.0 * INCH } else { 12.0 }, FeedMode::PerRevolution),
        Some(w::UPR) => (1.0, FeedMode::PerRevolution),
        _ => (1.0, FeedMode::PerMinute),
    };
    Feed { value: value * factor, mode, cause: post.block.cause }
}

/// Brings a feed per minute within the machine's range (DBLCOM 114, 120), with
/// a warning, and into the control's unit (DBLCOM 743).
pub fn within_limits(post: &mut Post, feed: Feed) -> Feed {
    if feed.mode == FeedMode::PerRevolution {
        return feed;
    }
    let min = post.commons.dbl_opt(loc::FEED_UPM_MIN).unwrap_or(0.0);
    let max = post.commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::MAX);
    let value = feed.value.max(min).min(max);
    if value != feed.value {
        let message = format!("feed {} became {value}", feed.value);
        post.warn(PostCode::Clamped, message);
    }
    let factor = post.commons.dbl_opt(loc::FEED_UPM_FACTOR).unwrap_or(1.0);
    Feed { value: value * factor, ..feed }
}
