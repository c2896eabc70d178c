//! The pitch of a tap, for controls whose cycles name it.

use fil_diag::Result;
use fil_machine::modes::FeedMode;

use super::Control;
use crate::errors::PostCode;
use crate::operation::SpindleSpeed;
use crate::path::cycle::{Cycle, CycleFeed};

/// Largest share of a pitch that rounding may change.
const SHARE: f64 = 0.0005;

/// The pitch without its sign: the lead, or the feed of a turn.
///
/// # Errors
/// A feed a minute without a speed; a pitch that four digits after the point can't say.
pub fn pitch(control: &Control, cycle: &Cycle) -> Result<String> {
    let lead = match (cycle.feed, control.speed) {
        (CycleFeed::Lead(lead), _) => lead.value,
        (CycleFeed::Feed(feed), _) if feed.mode == FeedMode::PerRevolution => feed.value,
        (CycleFeed::Feed(feed), Some(SpindleSpeed::Revolutions(speed))) if speed > 0.0 => {
            feed.value / speed
        }
        _ => {
            return PostCode::Family.err(
                "TAP with a feed a minute before SPINDL: the cycle needs the pitch of the thread",
            );
        }
    };
    let text = format!("{lead:.4}");
    let text = text.trim_end_matches('0').trim_end_matches('.');
    let written: f64 = text.parse().unwrap_or(0.0);
    if (written - lead).abs() > SHARE * lead {
        return PostCode::Family.err(format!("a pitch of {lead} would be written as {written}"));
    }
    Ok(text.to_string())
}
