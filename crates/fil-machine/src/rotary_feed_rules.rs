//! What the settings say about the feed of motions in which a rotary axis turns.

use crate::commons::{Commons, Dbl};
use crate::locations::{self as loc, RotaryFeed};

/// The rules of such feeds.
#[derive(Clone, Copy, Debug, Default)]
pub struct RotaryFeedRules {
    /// How the time of a motion is written where the program does not say it.
    pub form: RotaryFeed,
    /// Most that each rotary axis may turn, degrees a minute.
    pub most_turn: [f64; 2],
    /// Least time of a motion, minutes.
    pub least_time: f64,
    /// Smallest and largest F of inverse time, 1/min.
    pub inverse: [f64; 2],
    /// Factor of F in inverse time.
    pub inverse_factor: f64,
    /// Factor of a feed a minute.
    pub per_minute_factor: f64,
    /// Largest feed a minute, mm or inch.
    pub per_minute_most: f64,
    /// Smallest step of F in inverse time; `None` for that of its address.
    pub inverse_digit: Option<f64>,
}

impl RotaryFeedRules {
    pub(crate) fn from_commons(commons: &Commons, metric: bool) -> Self {
        let positive = |at: Dbl| commons.dbl_opt(at).filter(|value| *value > 0.0);
        let factor = |at| positive(at).unwrap_or(1.0);
        let most = |at| positive(at).unwrap_or(f64::INFINITY);
        let own = commons.dbl_opt(loc::ROTARY_SECONDARY_FEED_MAX).is_some();
        let second = if own { loc::ROTARY_SECONDARY_FEED_MAX } else { loc::ROTARY_FEED_MAX };
        let decimals = |format: i32| if metric { format % 10 } else { format / 100 % 10 };
        let inverse_format = commons.int_opt(loc::FEED_INVERSE_FORMAT);
        RotaryFeedRules {
            form: commons.read(loc::ROTARY_FEED),
            most_turn: [most(loc::ROTARY_FEED_MAX), most(second)],
            least_time: positive(loc::FEED_INVERSE_MIN_TIME).unwrap_or(0.0) / 60.0,
            inverse: [
                commons.dbl_opt(loc::FEED_INVERSE_MIN).unwrap_or(0.0),
                most(loc::FEED_INVERSE_MAX),
            ],
            inverse_factor: factor(loc::FEED_INVERSE_FACTOR),
            per_minute_factor: factor(loc::FEED_UPM_FACTOR),
            per_minute_most: most(loc::FEED_UPM_MAX),
            inverse_digit: inverse_format.map(|format| libm::exp10(-f64::from(decimals(format)))),
        }
    }
}
