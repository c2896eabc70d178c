//! Moves that are longer than one block may be (`limits.max_departure`): straight ones at feed are
//! divided evenly, so that the axes go as in one block, and others refused.

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet};
use fil_machine::modes::FeedMode;

use super::Control;
use crate::control_state::modal;
use crate::errors::PostCode;
use crate::operation::Feed;
use crate::operation::motion::{Motion, PlaneArc};

/// Most blocks of one motion.
const MOST_PARTS: f64 = 1000.0;

/// The parts before the last one of a straight motion, which itself is the last; none for one that
/// is short enough, or whose start is not known.
///
/// # Errors
/// Very many; one that begins or ends cutter compensation, or whose words are directions, as its
/// parts would be another motion.
pub(super) fn parts(control: &Control, motion: &Motion) -> Result<Vec<Motion>> {
    let Some((way, most)) = too_long(control, motion) else { return Ok(Vec::new()) };
    // The ends of the parts are rounded.
    let count = (way / (most - 2.0 * control.tables.axis(0).resolution())).ceil();
    if !(1.0..=MOST_PARTS).contains(&count) {
        let message = format!("a motion of {way:.3} takes more than {MOST_PARTS} blocks");
        return PostCode::TooManyParts.err(message);
    }
    let begins_or_ends = !control.state.is(modal::CUTTER_COMP, control.compensation_asked());
    if begins_or_ends || control.tables.tip_vectors {
        let what = match begins_or_ends {
            true => "a motion that begins or ends cutter compensation",
            false => "a motion with the direction of the tool",
        };
        return refuse_way(what, way, most);
    }
    let from = [0, 1, 2, 3, 4].map(|number| stands(control, motion, number));
    let count = count as u32;
    let part = |number: u32| {
        let share = f64::from(number) / f64::from(count);
        let mut position = motion.position;
        for number in 0..AXES {
            let from = from[number].unwrap_or(position[number]);
            position[number] = from + (position[number] - from) * share;
        }
        Motion::new(position, motion.axes, 0)
    };
    Ok((1..count).map(part).collect())
}

/// The feed of one of so many parts.
pub(super) fn feed_of_part(feed: Feed, parts: usize) -> Feed {
    match feed.mode {
        FeedMode::InverseTime => Feed { value: feed.value * parts as f64, ..feed },
        _ => feed,
    }
}

/// Refuses a move that can't be divided, where it is too long.
///
/// # Errors
/// It is.
pub(super) fn refuse(control: &Control, motion: &Motion, what: &str) -> Result<()> {
    match too_long(control, motion) {
        Some((way, most)) => refuse_way(what, way, most),
        None => Ok(()),
    }
}

/// Refuses an arc that is too long.
///
/// # Errors
/// It is.
pub(super) fn refuse_arc(control: &Control, arc: &PlaneArc) -> Result<()> {
    let Some(most) = control.tables.most_departure else { return Ok(()) };
    let along = arc.plane.axes();
    let rise: f64 = AxisSet::LINEAR
        .numbers()
        .filter(|number| !along.contains(number))
        .map(|number| arc.to[number] - arc.from[number])
        .sum();
    let way = libm::hypot(arc.radius * arc.sweep.to_radians(), rise);
    if way > most { refuse_way("an arc", way, most) } else { Ok(()) }
}

fn refuse_way<T>(what: &str, way: f64, most: f64) -> Result<T> {
    PostCode::Departure.err(format!("{what} of {way:.3}, and limits.max_departure is {most:.3}"))
}

/// The way of a motion over X, Y and Z, and the longest that one block may go, where that is less.
fn too_long(control: &Control, motion: &Motion) -> Option<(f64, f64)> {
    let most = control.tables.most_departure?;
    let along = |number| Some(motion.position[number] - stands(control, motion, number)?);
    let ways = AxisSet::LINEAR.numbers().filter_map(along);
    let way = ways.map(|way| way * way).sum::<f64>().sqrt();
    (way > most).then_some((way, most))
}

/// Where an axis of a motion stands, a rotary one with the turns that bring it nearest to where it
/// goes; `None` where that is not known.
fn stands(control: &Control, motion: &Motion, number: usize) -> Option<f64> {
    let axes = motion.axes.and(control.tables.present());
    let at = axes.has(number).then(|| control.stands(number)).flatten()?;
    Some(control.tables.axis(number).near(at, motion.position[number]))
}
