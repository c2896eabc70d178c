//! The pitch of a tap, for controls whose cycles name it.

use fil_diag::Result;
use fil_machine::modes::FeedMode;

use super::Control;
use crate::errors::PostCode;
use crate::operation::SpindleSpeed;
use crate::path::cycle::{Cycle, CycleFeed};

/// Largest share of a pitch that rounding may change.
pub(super) const SHARE: f64 = 0.0005;

/// The pitch without its sign, mm or inch: the lead, or the feed of a turn.
///
/// # Errors
/// A feed a minute without a speed.
pub fn pitch(control: &Control, cycle: &Cycle) -> Result<f64> {
    match (cycle.feed, control.spindle.speed) {
        (CycleFeed::Lead(lead), _) => Ok(lead.value),
        (CycleFeed::Feed(feed), _) if feed.mode == FeedMode::PerRevolution => Ok(feed.value),
        (CycleFeed::Feed(feed), Some(SpindleSpeed::Revolutions(speed))) if speed > 0.0 => {
            Ok(feed.value / control.upm_factor() / speed)
        }
        _ => PostCode::Family
            .err("TAP with a feed a minute before SPINDL: the cycle needs the pitch of the thread"),
    }
}

/// A pitch with so many digits after the point.
///
/// # Errors
/// One that they can't say.
pub fn text(pitch: f64, digits: usize) -> Result<String> {
    let text = format!("{pitch:.digits$}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - pitch).abs() > SHARE * pitch {
        return PostCode::Family.err(format!("a pitch of {pitch} would be written as {written}"));
    }
    Ok(text.to_string())
}
