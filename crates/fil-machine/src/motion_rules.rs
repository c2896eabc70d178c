//! What the settings say about straight motions at feed, and how F is written.

use crate::address::Addresses;
use crate::commons::Commons;
use crate::letter::letters::F;
use crate::locations::{self as loc, LinearMethod};
use crate::modes::FeedMode;
use crate::number::NumberFormat;

/// The rules of straight motions at feed.
#[derive(Clone, Copy, Debug, Default)]
pub struct MotionRules {
    /// Which axes go first.
    pub order: LinearMethod,
    /// Largest feed a minute of Y and of Z, mm or inch, where it is below that of the
    /// machine.
    pub largest_of: [Option<f64>; 2],
    /// A motion is more than one block at the feed asked for.
    pub is_special: bool,
}

impl MotionRules {
    pub(crate) fn from_commons(commons: &Commons) -> Self {
        let order = commons.read(loc::LINEAR_METHOD);
        let largest = commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::INFINITY);
        let largest_of = [loc::FEED_UPM_MAX_Y, loc::FEED_UPM_MAX_Z]
            .map(|at| commons.dbl_opt(at).filter(|of_axis| *of_axis < largest));
        let is_special = order != LinearMethod::XyzInOneBlock || largest_of != [None; 2];
        MotionRules { order, largest_of, is_special }
    }
}

/// How F is written in each feed mode.
#[derive(Clone, Copy, Debug, Default)]
pub struct FeedFormats {
    of_address: Option<NumberFormat>,
    a_minute: Option<NumberFormat>,
    inverse: Option<NumberFormat>,
}

impl FeedFormats {
    pub(crate) fn from_commons(addresses: &Addresses, commons: &Commons, metric: bool) -> Self {
        let of_address = addresses.format(F).copied();
        let with = |at| {
            let digits = commons.int_opt(at)?;
            Some(of_address?.with_digits(digits, metric))
        };
        FeedFormats {
            of_address,
            a_minute: with(loc::FEED_UPM_FORMAT),
            inverse: with(loc::FEED_INVERSE_FORMAT),
        }
    }

    /// The format in a mode; `None` where F is not written.
    pub(crate) fn of(&self, mode: FeedMode) -> Option<NumberFormat> {
        let own = match mode {
            FeedMode::PerMinute => self.a_minute,
            FeedMode::InverseTime => self.inverse,
            FeedMode::PerRevolution => None,
        };
        own.or(self.of_address)
    }
}
