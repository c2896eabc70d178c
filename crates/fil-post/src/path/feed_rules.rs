//! Feed motions that are more than one block at the feed asked for: XY and Z one after
//! the other, a largest feed of each axis, inverse time, the feed at the edge of the cutter.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::locations::{self as loc, FeedInverseLength, LinearMethod};
use fil_machine::modes::FeedMode;

use super::turning_feed::TurningFeed;
use super::{Since, linearization, position};
use crate::control::family;
use crate::control_state::{Compensation, Place, modal};
use crate::errors::PostCode;
use crate::operation::motion::{Motion, PlaneArc};
use crate::operation::{Feed, Target};
use crate::post::Post;

/// Seconds of a minute.
const MINUTE: f64 = 60.0;

/// A way of this length is none, mm or inch.
const NO_WAY: f64 = 1e-9;

/// True when straight feed motions are more than one block at the feed asked for.
#[inline]
pub fn apply(post: &Post) -> bool {
    post.path.inverse_time || post.control.tables.motion.is_special
}

/// Makes a straight feed motion by these rules. `before`: where the rotary axes stood, if they
/// turn.
///
/// # Errors
/// As [`family::feed`]; inverse time of a motion whose way is not known, or of a feed a
/// revolution; a part of an arc that the machine can't make.
#[cold]
pub fn line(
    post: &mut Post,
    motion: &Motion,
    target: Target,
    before: Option<[f64; 2]>,
) -> Result<()> {
    let Some(feed) = post.path.feed else {
        return family::feed(&mut post.control, motion, None);
    };
    let way = way(post, motion);
    for axes in split_slanted(post, way)? {
        let part = motion.of(*axes);
        let length = length(post, way, *axes, target);
        if stands(post, way, length) {
            turn_on_the_spot(post, motion, feed, before)?;
            continue;
        }
        let feed = limit_to_axes(post, feed, way, length);
        let feed = put_in_force(post, feed, length)?;
        family::feed(&mut post.control, &part, Some(&feed))?;
    }
    Ok(())
}

/// How far X, Y and Z go from where the tape stands, mm or inch; `None` where that is not
/// known.
fn way(post: &Post, motion: &Motion) -> [Option<f64>; 3] {
    [0, 1, 2].map(|number| {
        let from = post.control.stands(number)?;
        Some(motion.position[number] - from)
    })
}

/// The axes that go together, in the order of the machine; warns of a slanted line that is two.
///
/// # Errors
/// A part of an arc would go in steps.
fn split_slanted(post: &mut Post, way: [Option<f64>; 3]) -> Result<&'static [AxisSet]> {
    let goes = |number: usize| {
        let axis = post.control.tables.axis(number);
        let resolution = axis.resolution();
        !axis.is_off() && way[number].is_none_or(|way| way.abs() > 0.5 * resolution)
    };
    let slanted = goes(2) && (goes(0) || goes(1));
    let parts: &[AxisSet] = match post.control.tables.motion.order {
        LinearMethod::XyThenZ if slanted => &[AxisSet::XY, AxisSet::Z],
        LinearMethod::ZThenXy if slanted => &[AxisSet::Z, AxisSet::XY],
        _ => return Ok(&[AxisSet::ALL]),
    };
    if post.path.long_arc.in_chords {
        return PostCode::WordForm.err(
            "an arc as short lines needs X, Y and Z in one block, and linear.method moves them \
             one after the other",
        );
    }
    let message = "a slanted line was written as XY and Z one after the other".to_string();
    post.warn(PostCode::LineSplit, message);
    Ok(parts)
}

/// How far the tip goes in a part of a motion, mm or inch; `None` where that is not known.
fn length(post: &Post, way: [Option<f64>; 3], axes: AxisSet, target: Target) -> Option<f64> {
    // A tool change moves the axes, though settings may not let them be said again.
    let is_changed = post.path.last.since == Since::ToolChange && way.iter().any(Option::is_some);
    if is_changed || post.writes_tip() && post.control.tip.begins_unsaid {
        return None;
    }
    let known = way.iter().all(Option::is_some);
    let has_rotary = post.control.tables.chain().has_rotary();
    if known && (!has_rotary || (is_beside_the_path(post) && shows_the_tip(post))) {
        let squares = (0..3).filter(|number| axes.has(*number)).filter_map(|number| way[number]);
        return Some(squares.map(|way| way * way).sum::<f64>().sqrt());
    }
    // Behind a tool change or a text the machine may stand anywhere, and not at the last point.
    if (0..3).any(|number| is_in_doubt(post, number)) {
        return None;
    }
    let whole = axes == AxisSet::ALL;
    let from = post.path.point.filter(|_| whole)?;
    let in_part = |point| position::transformed(post, Target { point, ..target }).0;
    Some((in_part(target.point) - in_part(from)).norm())
}

/// Something has moved an axis, or another zero may have come, since the tape has said where it
/// goes.
fn is_in_doubt(post: &Post, number: usize) -> bool {
    post.control.place(number) != Place::Unsaid && post.control.stands(number).is_none()
}

/// The machine does not stand where the last point says, as behind TRANS.
fn is_beside_the_path(post: &Post) -> bool {
    post.path.rotary.is_some_and(|at| !linearization::is_where_the_path_is(post, at))
}

/// True where X, Y and Z on the tape go as far as the tip: no rotary axis turns, or they name
/// the tip.
fn shows_the_tip(post: &Post) -> bool {
    let tables = &post.control.tables;
    let stands = |n: usize| {
        let (axis, angles) = (tables.axis(n), post.path.rotary);
        let (tape, angle) = (post.control.stands(n), angles.map(|at| at[n - 3]));
        match (tape, angle) {
            (Some(tape), Some(angle)) => {
                (axis.near(tape, angle) - angle).abs() <= axis.resolution()
            }
            _ => false,
        }
    };
    let mut rotary = AxisSet::ROTARY.and(tables.present()).numbers();
    post.writes_tip() || rotary.all(stands)
}

/// True for a motion that goes nowhere: it makes no block. What the tape has rounded is no way
/// whose time a turn would be made in.
fn stands(post: &Post, way: [Option<f64>; 3], length: Option<f64>) -> bool {
    let is_rounded = |number: usize| {
        let half = 0.5 * post.control.tables.axis(number).resolution() + NO_WAY;
        way[number].is_some_and(|way| way.abs() <= half)
    };
    let turns = post.control.tables.chain().has_rotary();
    way.iter().all(Option::is_some)
        && length.is_some_and(|length| length <= NO_WAY || turns && (0..3).all(is_rounded))
}

/// Turns the rotary axes where the tip stays; without a turn there is no block. A feed a minute is
/// that of any turn under tool-tip control, no more than Y and Z may do, which follow it.
fn turn_on_the_spot(
    post: &mut Post,
    motion: &Motion,
    feed: Feed,
    before: Option<[f64; 2]>,
) -> Result<()> {
    let Some(before) = before else { return Ok(()) };
    let tables = &post.control.tables;
    let (mut from, mut to) = (motion.position, motion.position);
    for number in AxisSet::ROTARY.and(tables.present()).numbers() {
        let axis = tables.axis(number);
        from[number] = axis.on_tape(before[number - 3])?;
        to[number] = axis.on_tape(motion.position[number])?;
    }
    if from == to {
        return Ok(());
    }
    if !post.path.inverse_time {
        let feed = limit_shares(post, feed, [1.0; 2]);
        return family::feed(&mut post.control, motion, Some(&feed));
    }
    let rotary = TurningFeed::of(post)?;
    let part = rotary.between(&from, &to, 0.0);
    part.warn_if_limited(post);
    family::feed(&mut post.control, motion, Some(&part.feed))
}

/// Brings a feed a minute within what Y and Z may go, with a warning.
pub(super) fn limit_to_axes(
    post: &mut Post,
    feed: Feed,
    way: [Option<f64>; 3],
    length: Option<f64>,
) -> Feed {
    let length = length.unwrap_or(0.0);
    let shares = [way[1], way[2]].map(|way| match way {
        Some(way) if length > NO_WAY => (way.abs() / length).min(1.0),
        _ => 1.0,
    });
    limit_shares(post, feed, shares)
}

/// The same; Y and Z go at these shares of the feed at most.
fn limit_shares(post: &mut Post, feed: Feed, shares: [f64; 2]) -> Feed {
    let mut largest_of = post.control.tables.motion.largest_of;
    let tables = &post.control.tables;
    if tables.axis(1).is_off() || tables.is_polar() || tables.is_unrolled() {
        // A lathe has no Y, and the second axis of these planes is C.
        largest_of[0] = None;
    }
    if feed.mode != FeedMode::PerMinute || largest_of == [None; 2] {
        return feed;
    }
    let factor = post.control.upm_factor();
    let mut value = feed.value / factor;
    for (largest, share) in largest_of.into_iter().zip(shares) {
        if let Some(largest) = largest.filter(|largest| value * share > *largest) {
            value = largest / share;
            post.warn(PostCode::Clamped, "a feed was brought within that of Y or Z".to_string());
        }
    }
    Feed { value: value * factor, ..feed }
}

/// Brings a feed into the form in which the program says it on a way of this length: inverse time
/// where FEDRAT has asked for it. F then stands in each block.
///
/// # Errors
/// A way that is not known, or none; a feed a revolution.
fn put_in_force(post: &mut Post, feed: Feed, length: Option<f64>) -> Result<Feed> {
    if !post.path.inverse_time {
        return Ok(feed);
    }
    if feed.mode != FeedMode::PerMinute {
        return PostCode::WordForm.err("a feed a revolution has no inverse time");
    }
    let Some(length) = length.filter(|length| *length > NO_WAY) else {
        return PostCode::WordForm
            .err("inverse time needs the length of the motion, and its start is not known");
    };
    let asked = feed.value / post.control.upm_factor() / length;
    let commons = &post.control.commons;
    let of_time = commons.dbl_opt(loc::FEED_INVERSE_MIN_TIME).filter(|time| *time > 0.0);
    let most = commons.dbl_opt(loc::FEED_INVERSE_MAX).unwrap_or(f64::INFINITY);
    let most = of_time.map_or(most, |time| most.min(MINUTE / time));
    let least = commons.dbl_opt(loc::FEED_INVERSE_MIN).unwrap_or(0.0);
    let factor = commons.dbl_opt(loc::FEED_INVERSE_FACTOR).unwrap_or(1.0);
    let value = asked.max(least).min(most);
    if value != asked {
        post.warn(PostCode::Clamped, "an inverse time was brought within its limits".to_string());
    }
    post.control.state.doubt(fil_machine::letters::F);
    Ok(Feed { value: value * factor, mode: FeedMode::InverseTime, ..feed })
}

/// Settles the feed of an arc, or of a part of one, with what is to be warned of.
///
/// # Errors
/// As a line in inverse time.
pub fn settle_of_arc(post: &mut Post, arc: &PlaneArc) -> Result<Option<Feed>> {
    let Some(feed) = post.path.feed else { return Ok(None) };
    let mut feed = correct_at_the_edge(post, feed, arc);
    if !apply(post) {
        return Ok(Some(feed));
    }
    let along = arc.plane.normal();
    let rise = (arc.to[along] - arc.from[along]).abs();
    let length = libm::hypot(arc.sweep.to_radians() * arc.radius, rise);
    let shares = [1, 2].map(|axis| if axis == along { (rise / length).min(1.0) } else { 1.0 });
    feed = limit_shares(post, feed, shares);
    let chord = || {
        let ways = [0, 1, 2].map(|axis| arc.to[axis] - arc.from[axis]);
        ways.map(|way| way * way).iter().sum::<f64>().sqrt()
    };
    let by_chord =
        post.control.commons.read(loc::FEED_INVERSE_LENGTH) == FeedInverseLength::LengthOfTheChord;
    let length = if by_chord { chord() } else { length };
    put_in_force(post, feed, Some(length)).map(Some)
}

/// The feed that an arc is cut with where the center of the cutter goes on another radius
/// (INTCOM 1859).
fn correct_at_the_edge(post: &mut Post, feed: Feed, arc: &PlaneArc) -> Feed {
    let side = match post.control.state.get(modal::CUTTER_COMP) {
        Some(Compensation::Left) => arc.counterclockwise,
        Some(Compensation::Right) => !arc.counterclockwise,
        _ => return feed,
    };
    if !post.control.commons.read(loc::CIRCLE_TRUE_RADIUS_FEED) || feed.mode != FeedMode::PerMinute
    {
        return feed;
    }
    let Some(cutter) = post.path.cutter.map(|cutter| cutter.diameter) else {
        let message = "no CUTTER gives the diameter of this tool: the feed of the arc is that of \
                       its center (circle.true_radius_feed)";
        post.warn(PostCode::IgnoredPart, message.to_string());
        return feed;
    };
    // Inside of the arc the center goes on the smaller radius.
    let of_center = if side { arc.radius - cutter / 2.0 } else { arc.radius + cutter / 2.0 };
    if of_center <= 0.0 {
        return feed;
    }
    let largest = post.control.commons.dbl_opt(loc::FEED_UPM_MAX).unwrap_or(f64::INFINITY);
    let value = (feed.value * of_center / arc.radius).min(largest * post.control.upm_factor());
    Feed { value, ..feed }
}

/// The feed of a rapid motion that is too short for one (DBLCOM 425, 426); `None` for a
/// rapid motion, as are those between the passes of a whole thread: at feed the tool would widen
/// the groove that it leaves.
#[inline]
pub fn of_short_rapid(post: &Post, motion: &Motion, target: Target) -> Option<Feed> {
    let commons = &post.control.commons;
    let short = commons.dbl_opt(loc::RAPID_SHORT_DISTANCE).filter(|short| *short > 0.0)?;
    let value = commons.dbl_opt(loc::RAPID_SHORT_FEED)? * post.control.upm_factor();
    if post.path.thread.in_whole || post.control.tables.chain().has_rotary() {
        return None;
    }
    let length = length(post, way(post, motion), AxisSet::ALL, target)?;
    let cause = post.control.block.cause;
    (length < short).then_some(Feed { value, asked: value, mode: FeedMode::PerMinute, cause })
}

#[cfg(test)]
mod tests {
    use proptest::prelude::*;

    use super::*;
    use crate::cause::Cause;
    use crate::path::trial::post;

    proptest! {
        /// No axis goes faster than its largest feed, and a feed is lowered no more than that needs.
        #[test]
        fn a_feed_is_brought_within_that_of_the_axes(
            value in 1.0..9000.0, way in [-50.0..50.0, -50.0..50.0, -50.0..50.0],
            most in [100.0..3000.0, 100.0..3000.0],
        ) {
            let [y, z] = most;
            let mut post = post(&[("feed.upm_max_y", y), ("feed.upm_max_z", z)]);
            let mode = FeedMode::PerMinute;
            let feed = Feed { value, asked: value, mode, cause: Cause::default() };
            let length = way.iter().map(|way| way * way).sum::<f64>().sqrt();
            let found = limit_to_axes(&mut post, feed, way.map(Some), Some(length)).value;
            let shares = [way[1].abs() / length, way[2].abs() / length];
            let rest = shares.iter().zip(most).map(|(share, most)| most - found * share);
            let rest = rest.fold(f64::INFINITY, f64::min);
            prop_assert!(rest > -1e-6 * value, "{rest}");
            prop_assert!(found == value || rest.abs() < 1e-6 * value, "{found} of {value}");
        }
    }
}
