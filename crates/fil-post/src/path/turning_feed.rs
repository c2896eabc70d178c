//! The feed of motions in which a rotary axis turns.
//!
//! What F means there is another on each control, so the post finds the time of each
//! motion from the way of the tip in the part, and says that time in the form that the
//! machine takes (`rotary.feed`).

use fil_diag::Result;
use fil_machine::axes::Position;
use fil_machine::letters::F;
use fil_machine::locations::{self as loc, RotaryFeed};
use fil_machine::modes::FeedMode;

use crate::control::Control;
use crate::errors::PostCode;
use crate::operation::{Feed, SpindleSpeed};
use crate::post::Post;

/// Rounding of an inverse-time feed to its last digit changes it by no more than the
/// share that a feed may be rounded by.
const LAST_DIGITS: f64 = 50.0;

/// Shorter ways of the tip count as none, mm or inch.
const STANDS: f64 = 1e-9;

/// A time may be longer by this share before it is said.
const SAME_TIME: f64 = 1e-6;

/// How the times of motions are written.
pub(super) struct TurningFeed {
    form: RotaryFeed,
    given: Feed,
    /// Way of the tip, mm or inch a minute.
    rate: f64,
    /// Most that each rotary axis may turn, degrees a minute.
    most_turn: [f64; 2],
    /// Least time of a motion, minutes.
    least_time: f64,
    inverse: [f64; 2],
    inverse_factor: f64,
    per_minute_factor: f64,
    per_minute_most: f64,
    /// Smallest step of F.
    digit: f64,
}

/// The feed of one motion.
pub(super) struct PartFeed {
    /// As it is written.
    pub feed: Feed,
    /// A limit of the machine makes the motion slower than asked for.
    pub slowed: bool,
}

impl TurningFeed {
    /// The feed in force, on a machine.
    ///
    /// # Errors
    /// No feed; a feed a turn of a spindle whose speed is not known.
    pub(super) fn of(post: &Post) -> Result<Self> {
        let commons = &post.control.commons;
        let given = post.path.feed;
        let given =
            given.ok_or_else(|| PostCode::NoFeed.diag("no FEDRAT came before this motion"))?;
        let form = match post.path.inverse_time {
            true => RotaryFeed::InverseTime,
            false => commons.read(loc::ROTARY_FEED),
        };
        let factor = |at| commons.dbl_opt(at).filter(|factor| *factor > 0.0).unwrap_or(1.0);
        let per_minute_factor = factor(loc::FEED_UPM_FACTOR);
        let rate = match given.mode {
            FeedMode::PerRevolution if form != RotaryFeed::AsFedratSays => {
                given.value * turns(&post.control)?
            }
            _ => given.value / per_minute_factor,
        };
        let most = |at| commons.dbl_opt(at).filter(|most| *most > 0.0).unwrap_or(f64::INFINITY);
        let digits = inverse_digit(&post.control);
        let own = commons.dbl_opt(loc::ROTARY_SECONDARY_FEED_MAX).is_some();
        let second = if own { loc::ROTARY_SECONDARY_FEED_MAX } else { loc::ROTARY_FEED_MAX };
        Ok(TurningFeed {
            form,
            given,
            rate,
            most_turn: [most(loc::ROTARY_FEED_MAX), most(second)],
            least_time: commons.dbl_opt(loc::FEED_INVERSE_MIN_TIME).unwrap_or(0.0).max(0.0) / 60.0,
            inverse: [
                commons.dbl_opt(loc::FEED_INVERSE_MIN).unwrap_or(0.0),
                most(loc::FEED_INVERSE_MAX),
            ],
            inverse_factor: factor(loc::FEED_INVERSE_FACTOR),
            per_minute_factor,
            per_minute_most: most(loc::FEED_UPM_MAX),
            digit: digits,
        })
    }

    /// How many parts a way of the tip needs at least, so that F is not too small for
    /// its address.
    pub(super) fn least_parts(&self, way: f64) -> Result<u32> {
        if self.form != RotaryFeed::InverseTime {
            return Ok(1);
        }
        let least = self.inverse[0].max(LAST_DIGITS * self.digit / self.inverse_factor);
        let parts = (way * least / self.rate).ceil().max(1.0);
        if parts > f64::from(u16::MAX) {
            return PostCode::TooManyParts.err("inverse time can't say so slow a feed");
        }
        Ok(parts as u32)
    }

    /// The feed of a motion between two positions on the tape, in which the tip goes
    /// `way` in the part.
    pub(super) fn between(&self, from: &Position, to: &Position, way: f64) -> Result<PartFeed> {
        if self.form == RotaryFeed::AsFedratSays {
            return Ok(PartFeed { feed: self.given, slowed: false });
        }
        let turned = [3, 4].map(|n: usize| (to[n] - from[n]).abs());
        let of_turn = turned.iter().zip(self.most_turn).map(|(turned, most)| turned / most);
        let asked = if way > STANDS { way / self.rate } else { 0.0 };
        let mut time = of_turn.fold(asked, f64::max).max(self.least_time);
        if time == 0.0 {
            time = turned[0].max(turned[1]) / self.rate;
        }
        let square = |n: usize| (to[n] - from[n]) * (to[n] - from[n]);
        let linear = (0..3).map(square).sum::<f64>();
        let turns = (3..5).map(square).sum::<f64>();
        let (value, most, mode) = match self.form {
            RotaryFeed::InverseTime => {
                ((1.0 / time).max(self.inverse[0]), self.inverse[1], FeedMode::InverseTime)
            }
            RotaryFeed::LinearWayElseTheTurn => {
                let way = if linear > 0.0 { linear } else { turns };
                (way.sqrt() / time, self.per_minute_most, FeedMode::PerMinute)
            }
            _ => ((linear + turns).sqrt() / time, self.per_minute_most, FeedMode::PerMinute),
        };
        let slowed = value.min(most);
        let factor = match mode {
            FeedMode::InverseTime => self.inverse_factor,
            _ => self.per_minute_factor,
        };
        let feed = Feed { value: slowed * factor, mode, cause: self.given.cause };
        let limited = asked > 0.0 && time > asked * (1.0 + SAME_TIME);
        Ok(PartFeed { feed, slowed: limited || slowed < value })
    }

    /// Says that the machine goes slower than the CL file asks.
    pub(super) fn warn_slowed(&self, post: &mut Post) {
        let message = format!(
            "feed {} is more than a rotary axis, or the feed word, can follow; such motions are slower",
            self.given.value
        );
        post.warn(PostCode::Clamped, message);
    }
}

impl PartFeed {
    /// In inverse time, true, each block says its own F.
    pub(super) fn after(&self, control: &mut Control) -> bool {
        let inverse = self.feed.mode == FeedMode::InverseTime;
        if inverse {
            control.state.doubt(F);
        }
        inverse
    }
}

/// Turns a minute of the spindle.
fn turns(control: &Control) -> Result<f64> {
    match control.speed {
        Some(SpindleSpeed::Revolutions(speed)) if speed > 0.0 => Ok(speed),
        _ => PostCode::RotaryFeedUnknown.err(
            "a feed a revolution in a motion that turns the machine, and the speed of the spindle \
             is not known",
        ),
    }
}

/// Last digit of F in inverse time.
fn inverse_digit(control: &Control) -> f64 {
    match control.commons.int_opt(loc::FEED_INVERSE_FORMAT) {
        Some(format) if control.is_metric() => libm::exp10(-f64::from(format % 10)),
        Some(format) => libm::exp10(-f64::from(format / 100 % 10)),
        None => control.tables.addresses.format(F).map_or(1.0, |format| format.unscale(1)),
    }
}
