//! What the settings of a machine make of the time of motions that turn it.

use fil_machine::locations::{self as loc, RotaryFeed, RotaryFeedMethod};

use super::settings::Settings;
use crate::motion::{Position, unit};

impl Settings<'_> {
    /// X is a diameter.
    pub fn is_lathe(&self) -> bool {
        self.commons.read(loc::LATHE_DIAMETER)
    }

    /// The live tools of a mill-turn machine turn and stop by functions of their own.
    pub fn live_has_own_codes(&self) -> bool {
        let code = |at| self.commons.read(at);
        let of_live = code(loc::MILL_TURN_LIVE_STOP_CODE);
        self.is_mill_turn() && of_live.is_some() && of_live != code(loc::SPINDLE_STOP_CODE)
    }

    /// Minutes of a motion that turns the machine: as long as asked for, but where X, Y and Z
    /// stand no longer than at the lowest feed, or as the turn of each axis (degrees) takes at
    /// least.
    pub fn turning_time(&self, asked: f64, turned: [f64; 2], turns_alone: bool) -> f64 {
        let least_feed = self.commons.dbl_opt(loc::ROTARY_FEED_MIN).filter(|_| turns_alone);
        let asked = match least_feed {
            Some(feed) if feed > 0.0 => asked.min(turned[0].max(turned[1]) / feed),
            _ => asked,
        };
        let first = self.commons.dbl_opt(loc::ROTARY_FEED_MAX);
        let second = self.commons.dbl_opt(loc::ROTARY_SECONDARY_FEED_MAX).or(first);
        let part = self.commons.dbl_opt(loc::ROTARY_VELOCITY_PERCENT).unwrap_or(100.0) / 100.0;
        let least = |(turned, most): (f64, Option<f64>)| {
            most.filter(|most| *most > 0.0).map_or(0.0, |most| turned / (most * part))
        };
        turned.into_iter().zip([first, second]).map(least).fold(asked, f64::max)
    }

    /// The way over which F counts in a motion that turns the machine, in mm: with degrees
    /// as units of length of the program; `None` where it is that of the tip.
    pub fn counted_way(&self, from: &Position, to: &Position, metric: bool) -> Option<f64> {
        let unit = unit(metric);
        let squares = |a: &[f64], b: &[f64]| a.iter().zip(b).map(|(a, b)| (a - b) * (a - b)).sum();
        let linear: f64 = squares(&from.linear, &to.linear);
        let turns: f64 = squares(&from.rotary, &to.rotary);
        let turns = turns * unit * unit;
        let listed = match self.commons.read(loc::ROTARY_FEED_METHOD) {
            RotaryFeedMethod::LengthOfTheCombinedMove => RotaryFeed::AllAxesCombined,
            RotaryFeedMethod::RotaryPartOnly => RotaryFeed::RotaryAxesAlone,
            RotaryFeedMethod::NotUsed => RotaryFeed::InverseTime,
        };
        match self.commons.read(loc::ROTARY_FEED).unwrap_or(listed) {
            RotaryFeed::InverseTime | RotaryFeed::AsFedrat => None,
            RotaryFeed::RotaryAxesAlone => Some(if turns > 0.0 { turns } else { linear }.sqrt()),
            RotaryFeed::AllAxesCombined => Some((linear + turns).sqrt()),
            RotaryFeed::LinearAxesElseRotary => {
                Some(if linear > 0.0 { linear } else { turns }.sqrt())
            }
        }
    }

    /// The longest way of one block, mm, in a program in mm or inches; `None` for any.
    pub fn most_departure(&self, metric: bool) -> Option<f64> {
        // What option files hold where there is none.
        const NONE: f64 = 9999.9998;
        let most = self.commons.dbl_opt(loc::LIMITS_MAX_DEPARTURE).filter(|most| *most != NONE)?;
        Some(most * unit(metric))
    }
}
