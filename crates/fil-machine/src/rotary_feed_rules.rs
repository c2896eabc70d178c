//! What the settings say about the feed of motions in which a rotary axis turns.

use std::sync::LazyLock;

use crate::address::Addresses;
use crate::commons::{Commons, Dbl};
use crate::letter::letters;
use crate::locations::{self as loc, RotaryFeed, RotaryFeedMethod};

/// The rules of such feeds.
#[derive(Clone, Copy, Debug)]
pub struct RotaryFeedRules {
    /// How the time of a motion is written where the program does not say it.
    pub form: RotaryFeed,
    /// Most that each rotary axis may turn, degrees a minute.
    pub most_turn: [f64; 2],
    /// Least that a rotary axis turns where X, Y and Z stand, degrees a minute.
    pub least_turn: f64,
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
    /// A smaller F of inverse time, 1/min, would be changed too much by rounding.
    pub inverse_least: f64,
}

impl Default for RotaryFeedRules {
    /// Those of a machine of which nothing is said.
    fn default() -> Self {
        static UNSAID: LazyLock<RotaryFeedRules> = LazyLock::new(|| {
            RotaryFeedRules::from_commons(&Addresses::default(), &Commons::absent(), true)
        });
        *UNSAID
    }
}

/// Rounding of an inverse-time feed to its last digit changes it by no more than the share
/// that a feed may be rounded by.
const LAST_DIGITS: f64 = 50.0;

impl RotaryFeedRules {
    pub(crate) fn from_commons(addresses: &Addresses, commons: &Commons, metric: bool) -> Self {
        let positive = |at: Dbl| commons.dbl_opt(at).filter(|value| *value > 0.0);
        let factor = |at| positive(at).unwrap_or(1.0);
        let most = |at| positive(at).unwrap_or(f64::INFINITY);
        let part = positive(loc::ROTARY_VELOCITY_PERCENT).map_or(1.0, |percent| percent / 100.0);
        let own = commons.dbl_opt(loc::ROTARY_SECONDARY_FEED_MAX).is_some();
        let second = if own { loc::ROTARY_SECONDARY_FEED_MAX } else { loc::ROTARY_FEED_MAX };
        let decimals = |format: i32| if metric { format % 10 } else { format / 100 % 10 };
        let digit = match commons.int_opt(loc::FEED_INVERSE_FORMAT) {
            Some(format) => libm::exp10(-f64::from(decimals(format))),
            None => addresses.format(letters::F).map_or(1.0, |format| format.unscale(1)),
        };
        let inverse_factor = factor(loc::FEED_INVERSE_FACTOR);
        let inverse_min = commons.dbl_opt(loc::FEED_INVERSE_MIN).unwrap_or(0.0);
        RotaryFeedRules {
            form: form(commons),
            most_turn: [loc::ROTARY_FEED_MAX, second].map(|at| most(at) * part),
            least_turn: positive(loc::ROTARY_FEED_MIN).unwrap_or(0.0),
            least_time: positive(loc::FEED_INVERSE_MIN_TIME).unwrap_or(0.0) / 60.0,
            inverse: [inverse_min, most(loc::FEED_INVERSE_MAX)],
            inverse_factor,
            per_minute_factor: factor(loc::FEED_UPM_FACTOR),
            per_minute_most: most(loc::FEED_UPM_MAX),
            inverse_least: inverse_min.max(LAST_DIGITS * digit / inverse_factor),
        }
    }
}

/// The form of F in such motions: that of `rotary.feed`, else as option files say it.
fn form(commons: &Commons) -> RotaryFeed {
    let listed = listed_form(commons).unwrap_or(RotaryFeed::InverseTime);
    commons.read(loc::ROTARY_FEED).unwrap_or(listed)
}

/// The form that an option file asks for (`rotary.feed_method`).
fn listed_form(commons: &Commons) -> Option<RotaryFeed> {
    match commons.read(loc::ROTARY_FEED_METHOD) {
        RotaryFeedMethod::NotUsed => None,
        RotaryFeedMethod::LengthOfTheCombinedMove => Some(RotaryFeed::AllAxesCombined),
        RotaryFeedMethod::RotaryPartOnly => Some(RotaryFeed::RotaryAxesAlone),
    }
}

/// The forms that the two settings ask for, `rotary.feed` first, where they are not one.
pub(crate) fn two_forms(commons: &Commons) -> Option<(RotaryFeed, RotaryFeed)> {
    let (own, listed) = (commons.read(loc::ROTARY_FEED)?, listed_form(commons)?);
    (own != listed).then_some((own, listed))
}
