//! The feed of motions in which a rotary axis turns.
//!
//! What F means there is another on each control, so the post finds the time of each
//! motion from the way of the tip in the part, and says that time in the form that the
//! machine takes (`rotary.feed`).

use fil_diag::Result;
use fil_machine::axes::Position;
use fil_machine::locations::{self as loc, RotaryFeed};
use fil_machine::modes::FeedMode;
use fil_machine::rotary_feed_rules::RotaryFeedRules;

use crate::control::Control;
use crate::control::needs;
use crate::control::word_address::dwell::known_speed;
use crate::errors::PostCode;
use crate::operation::{Feed, SpindleSpeed};
use crate::post::Post;

/// Shorter ways of the tip count as none, mm or inch.
pub(super) const STANDS: f64 = 1e-9;

/// A time may be longer by this share before it is said.
const SAME_TIME: f64 = 1e-6;

/// How the times of motions are written.
pub(super) struct TurningFeed<'a> {
    rules: &'a RotaryFeedRules,
    form: RotaryFeed,
    given: Feed,
    /// Way of the tip, mm or inch a minute.
    rate: f64,
}

/// The feed of one motion.
pub(super) struct PartFeed {
    /// As it is written.
    pub feed: Feed,
    /// A limit of the machine makes the motion slower than asked for.
    pub slowed: bool,
    /// The lowest feed of a rotary axis makes it faster.
    pub hastened: bool,
}

impl<'a> TurningFeed<'a> {
    /// The feed in force, on a machine.
    ///
    /// # Errors
    /// No feed; a feed a turn of a spindle whose speed is not known.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(super) fn of(post: &'a Post) -> Result<Self> {
        let tables = &post.control.tables;
        let rules = &tables.rotary_feed;
        let given = needs::feed(post.path.feed.as_ref())?;
        let form = if post.path.inverse_time { RotaryFeed::InverseTime } else { rules.form };
        let rate = match given.mode {
            FeedMode::PerRevolution if form != RotaryFeed::AsFedrat => {
                given.value * turns(&post.control)?
            }
            _ => given.value / rules.per_minute_factor,
        };
        Ok(TurningFeed { rules, form, given: *given, rate })
    }

    /// How many parts a way of the tip needs at least, so that F is not too small for
    /// its address.
    pub(super) fn least_parts(&self, way: f64) -> Result<u32> {
        if self.form != RotaryFeed::InverseTime {
            return Ok(1);
        }
        let least = self.rules.inverse_least;
        if way * least <= self.rate {
            return Ok(1);
        }
        let parts = (way * least / self.rate).ceil().max(1.0);
        if parts > f64::from(u16::MAX) {
            return PostCode::TooManyParts.err("inverse time can't express such a slow feed");
        }
        Ok(parts as u32)
    }

    /// The feed of a motion between two positions on the tape, in which the tip goes
    /// `way` in the part.
    #[cfg_attr(not(target_family = "wasm"), inline(always))]
    pub(super) fn between(&self, from: &Position, to: &Position, way: f64) -> PartFeed {
        if self.form == RotaryFeed::AsFedrat {
            return PartFeed { feed: self.given, slowed: false, hastened: false };
        }
        let rules = self.rules;
        let turned = [3, 4].map(|n: usize| (to[n] - from[n]).abs());
        let of_turn = turned.iter().zip(rules.most_turn).map(|(turned, most)| turned / most);
        let turn = turned[0].max(turned[1]);
        let turns_alone = (0..3).all(|n| from[n] == to[n]);
        let longest = if turns_alone { turn / rules.least_turn } else { f64::INFINITY };
        let meant = if way > STANDS { way / self.rate } else { 0.0 };
        let asked = meant.min(longest);
        // The shortest time is that of a motion in inverse time.
        let least = if self.form == RotaryFeed::InverseTime { rules.least_time } else { 0.0 };
        let mut time = of_turn.fold(asked, f64::max).max(least);
        let mut hastened = asked < meant;
        if time == 0.0 {
            hastened = turn / self.rate > longest;
            time = (turn / self.rate).min(longest);
        }
        let (value, most, factor, mode) = match self.form {
            RotaryFeed::InverseTime => {
                let value = (1.0 / time).max(rules.inverse[0]);
                (value, rules.inverse[1], rules.inverse_factor, FeedMode::InverseTime)
            }
            form => {
                let value = counted_way(form, from, to) / time;
                (value, rules.per_minute_most, rules.per_minute_factor, FeedMode::PerMinute)
            }
        };
        let slowed = value.min(most);
        let feed = Feed { value: slowed * factor, mode, ..self.given };
        let limited = asked > 0.0 && time > asked * (1.0 + SAME_TIME);
        PartFeed { feed, slowed: limited || slowed < value, hastened }
    }
}

/// The way between two positions whose length a minute F is, mm or inch and degrees.
fn counted_way(form: RotaryFeed, from: &Position, to: &Position) -> f64 {
    let square = |n: usize| (to[n] - from[n]) * (to[n] - from[n]);
    let linear = (0..3).map(square).sum::<f64>();
    let turns = (3..5).map(square).sum::<f64>();
    match form {
        RotaryFeed::LinearAxesElseRotary if linear > 0.0 => linear.sqrt(),
        RotaryFeed::LinearAxesElseRotary => turns.sqrt(),
        RotaryFeed::RotaryAxesAlone if turns > 0.0 => turns.sqrt(),
        _ => (linear + turns).sqrt(),
    }
}

impl PartFeed {
    /// Says where the machine goes slower, or faster, than the CL file asks.
    pub(super) fn warn_if_limited(&self, post: &mut Post) {
        let asked = post.path.feed.map_or(0.0, |feed| feed.value);
        if self.hastened {
            let message = format!(
                "feed {asked} is less than the lowest feed of a rotary axis; such motions are faster"
            );
            post.warn(PostCode::Clamped, message);
        }
        if !self.slowed {
            return;
        }
        let message = format!(
            "feed {asked} is more than a rotary axis, or the feed word, can follow; such motions are slower"
        );
        post.warn(PostCode::Clamped, message);
    }

    /// True in inverse time, in which each block says its own F.
    pub(super) fn is_inverse(&self) -> bool {
        self.feed.mode == FeedMode::InverseTime
    }
}

/// Turns a minute of the spindle, as S says them: the machine may have brought the speed asked for
/// within its ranges.
fn turns(control: &Control) -> Result<f64> {
    let asked = match control.spindle.speed {
        Some(SpindleSpeed::Revolutions(speed)) => Some(speed),
        _ => None,
    };
    let said = match control.commons.read(loc::SPINDLE_DIRECT_RPM) {
        true => known_speed(control),
        false => asked,
    };
    said.filter(|speed| *speed > 0.0).ok_or_else(|| {
        PostCode::RotaryFeedUnknown.diag(
            "a feed a revolution in a motion that turns the machine, and the speed of the spindle \
             is not known",
        )
    })
}
