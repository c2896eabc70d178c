//! The order of a rapid motion: XY, rotary, then Z; Z first where it retracts.

use fil_diag::Result;
use fil_machine::axes::AxisSet;
use fil_machine::commons::EMPTY;
use fil_machine::locations::{self as loc, RapidSplit};

use super::rapid_lean::{self, Lie, UPRIGHT};
use super::rapid_turn;
use crate::cause::Cause;
use crate::control::Control;
use crate::control::family;
use crate::control::place::{cross_unknown, cross_unknown_way};
use crate::control::skip::refuse_level;
use crate::control::word_address::repeat;
use crate::control_state::{Levels, Place, modal};
use crate::operation::motion::{Motion, RapidCode};

/// Values of the tape nearer than this are one, mm, inch or degrees.
const SAME: f64 = 1e-6;

/// Makes a rapid motion in the order the machine asks for.
///
/// # Errors
/// As [`family::rapid`].
pub fn rapid(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    in_order(control, motion, cause, true)
}

/// The same; `warns` of a tip that comes below its line, where nothing has been said of it.
fn in_order(control: &mut Control, motion: &Motion, cause: Cause, warns: bool) -> Result<()> {
    if control.state.is(modal::TCP, true) {
        return family::rapid(control, motion, RapidCode::Across, cause);
    }
    if control.commons.read(loc::RAPID_SPLIT) == RapidSplit::OneBlock {
        look_where_it_begins(control, motion)?;
        if warns {
            rapid_turn::warn_of_dip(control, motion, &[AxisSet::ALL]);
        }
        return family::rapid(control, motion, RapidCode::Across, cause);
    }
    in_parts(control, motion, cause, warns)
}

/// Makes a rapid motion out of a cut: where it turns the machine the tool goes up along itself
/// before, to the height of the end, as the tip sweeps aside in the turn.
///
/// # Errors
/// As [`rapid`].
pub(super) fn out_of_cut(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let Some(from) = rapid_turn::turns_from(control, motion) else {
        return rapid(control, motion, cause);
    };
    let lie = match control.commons.read(loc::RAPID_SPLIT) {
        RapidSplit::OneBlock => None,
        _ => Some(Lie::of(control, motion)),
    };
    let rises = match lie {
        None => false,
        Some(Lie::Along { number, up }) => decide_first(control, motion, number, up)?,
        // It goes up along the tool in any case.
        Some(Lie::Leaning) => true,
    };
    let over = rapid_lean::over_start(control, &from, &motion.position).filter(|_| !rises);
    if let Some(over) = over {
        control.tables.check_travel(&over, AxisSet::LINEAR)?;
        let axes = AxisSet::LINEAR.and(control.tables.present());
        family::rapid(control, &Motion::new(over, axes, 0), RapidCode::Across, cause)?;
    }
    let from = over.unwrap_or(from);
    let ends = match lie {
        None => vec![motion.position],
        Some(Lie::Along { number, .. }) => {
            let blocks = order(control, number, rises).map(|(axes, _)| axes);
            rapid_turn::ends_of(control, motion, &blocks, &from)
        }
        Some(Lie::Leaning) => {
            let mut ends = rapid_lean::stops(control, &from, &motion.position);
            ends.push(motion.position);
            ends
        }
    };
    let is_said = rapid_turn::warn_of_sweep(control, &from, &ends);
    in_order(control, motion, cause, !is_said)
}

/// Looks where a rapid motion of several axes in one block begins: no order of them is safe on
/// a lathe, whose tool may stand before the part or in its bore.
///
/// # Errors
/// An axis may stand anywhere.
fn look_where_it_begins(control: &mut Control, motion: &Motion) -> Result<()> {
    let axes = motion.axes.and(control.tables.present()).and(AxisSet::LINEAR);
    for number in [2, 0, 1].into_iter().filter(|number| axes.has(*number)) {
        let place = control.place_on_tape(number);
        let in_doubt = matches!(place, Place::Unknown | Place::Shifted(_) | Place::LeftToScript(_));
        if !in_doubt || !goes_with_others(control, motion, number)? {
            continue;
        }
        match place {
            Place::Unknown | Place::LeftToScript(_) if control.state.axes_returned() => {}
            Place::Unknown => cross_unknown_way(control, number)?,
            Place::Shifted(_) => return control.cross_shifted(number, true),
            _ => {
                control.cross_forgotten(number);
                return Ok(());
            }
        }
    }
    Ok(())
}

/// True when the motion has a word of another axis than this one.
fn goes_with_others(control: &Control, motion: &Motion, number: usize) -> Result<bool> {
    for other in motion.axes.and(control.tables.present()).numbers().filter(|n| *n != number) {
        let axis = control.tables.axis(other);
        let in_doubt = !control.state.has_last(axis.letter);
        let moves = axis.changes(axis.scaled(motion.position[other])?, &control.commons);
        if !axis.is_off() && (in_doubt || moves) {
            return Ok(true);
        }
    }
    Ok(false)
}

/// Makes a rapid motion X and Y, then the rotary axes, then Z; Z first where it goes up. On a
/// machine whose tool lies along another axis, that is the one that goes first or last.
///
/// # Errors
/// As [`family::rapid`].
fn in_parts(control: &mut Control, motion: &Motion, cause: Cause, warns: bool) -> Result<()> {
    let (number, up) = match Lie::of(control, motion) {
        Lie::Along { number, up } => (number, up),
        Lie::Leaning if rapid_lean::is_away(control) => (2, true),
        Lie::Leaning => return rapid_lean::rapid(control, motion, cause),
    };
    let tool_first = motion.axes.has(number) && decide_first(control, motion, number, up)?;
    if warns {
        let blocks = order(control, number, tool_first).map(|(axes, _)| axes);
        rapid_turn::warn_of_dip(control, motion, &blocks);
    }
    split(control, motion, number, tool_first, cause)
}

/// Turns the machine between the way out and the way back of a repositioning, in the same order;
/// how far the tool is out its settings say.
///
/// # Errors
/// As [`family::rapid`].
pub(super) fn turn_away(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    match Lie::of(control, motion) {
        Lie::Along { number, up } => {
            let tool_first = decide_first(control, motion, number, up)?;
            let blocks = order(control, number, tool_first).map(|(axes, _)| axes);
            rapid_turn::warn_of_dip_when_out(control, motion, &blocks);
            split(control, motion, number, tool_first, cause)
        }
        Lie::Leaning => {
            rapid_turn::warn_of_dip_when_out(control, motion, &[AxisSet::ALL]);
            family::rapid(control, motion, RapidCode::Across, cause)
        }
    }
}

/// Makes a rapid motion to a position of the machine, as [`rapid`] does; from a level of
/// Z that is not known Z goes first, since nothing may turn or go across beside the part.
///
/// # Errors
/// As [`family::rapid`].
pub fn to_machine_position(control: &mut Control, motion: &Motion, cause: Cause) -> Result<()> {
    let one_may_be_unknown = control.levels_behind_skip(2).filter(|levels| levels.unknown);
    let goes_down = |levels: &Levels| motion.position[2] < levels.high;
    if one_may_be_unknown.as_ref().is_some_and(goes_down) && motion.axes.has(2) {
        return refuse_level(control, 2);
    }
    let place = control.place(2);
    rapid_lean::refuse_unknown_lean(control)?;
    if Lie::of(control, motion) != UPRIGHT {
        let rises = rapid_lean::go_up_to(control, motion, cause)?;
        return split(control, motion, 2, rises, cause);
    }
    let known = matches!(place, Place::At(_) | Place::Between(Levels { unknown: false, .. }));
    if known || control.commons.read(loc::RAPID_SPLIT) == RapidSplit::OneBlock {
        return rapid(control, motion, cause);
    }
    split(control, motion, 2, true, cause)
}

/// Refuses a motion of Z and other axes that ends between two levels at which the tool may
/// stand behind blocks that may be skipped: up first would be down with the one, and across
/// first beside the part with the other.
///
/// # Errors
/// Such a motion; one above a level, where the other one is not known.
pub(super) fn refuse_between_levels(control: &Control, to: &Motion) -> Result<()> {
    let Some(levels) = control.levels_behind_skip(2) else { return Ok(()) };
    let others = to.axes.without(AxisSet::Z).and(control.tables.present());
    let end = to.position[2];
    let between = levels.low < end && (end < levels.high || levels.unknown);
    if between && !others.is_empty() {
        return refuse_level(control, 2);
    }
    Ok(())
}

/// Which axes move in which block, and by which code; `number` is the axis that the tool lies
/// along. At the machine's top the rotary axes go first, where the settings ask for turns there.
fn order(control: &Control, number: usize, tool_first: bool) -> [(AxisSet, RapidCode); 3] {
    let tool = AxisSet::of(number);
    let across = (AxisSet::LINEAR.without(tool), RapidCode::Across);
    let turning = (AxisSet::ROTARY, RapidCode::Turning);
    let along = (tool, RapidCode::Along);
    match tool_first {
        true => [along, across, turning],
        false if control.tables.turns_at_top && rapid_lean::is_away(control) => {
            [turning, across, along]
        }
        false => [across, turning, along],
    }
}

fn split(
    control: &mut Control,
    motion: &Motion,
    number: usize,
    tool_first: bool,
    cause: Cause,
) -> Result<()> {
    let present = control.tables.present();
    for (group, code) in order(control, number, tool_first) {
        if !group.and(present).is_empty() {
            family::rapid(control, &motion.of(group), code, cause)?;
        }
    }
    Ok(())
}

/// Decides whether Z goes before the other axes: up from where the tool stands.
///
/// # Errors
/// As [`decide_first`].
pub(super) fn decide_z_first(control: &mut Control, motion: &Motion) -> Result<bool> {
    decide_first(control, motion, 2, true)
}

/// Decides whether the axis that the tool lies along goes before the others: up from where the tool
/// stands, which is to higher numbers, or to lower ones. Warns where that hangs on a guess.
///
/// # Errors
/// No order is safe: the axis may stand on either side of the end, by the skip switch, or
/// anywhere.
fn decide_first(control: &mut Control, motion: &Motion, number: usize, up: bool) -> Result<bool> {
    if !control.repeat.ended.is_empty() {
        repeat::doubt_ended(control);
    }
    let axis = *control.tables.axis(number);
    let to = axis.value(motion.position[number])?;
    let sign = if up { axis.scale() } else { -axis.scale() };
    let rises_from = |from: f64| (to - from) * sign > 0.0;
    match control.place_on_tape(number) {
        // Up to the level of the end would be down beside the part, which has yet to turn.
        Place::At(_) if control.state.may_be_clear(axis.letter) && turns(control, motion) => {
            Ok(false)
        }
        Place::At(last) => Ok(rises_from(last)),
        Place::Unsaid | Place::Clear => Ok(false),
        Place::Between(_) if number != 2 || !up => refuse_level(control, number),
        Place::Between(_) => {
            refuse_between_levels(control, motion)?;
            Ok(control.levels_behind_skip(2).is_some_and(|levels| levels.low < motion.position[2]))
        }
        Place::Shifted(last) => {
            if goes_with_others(control, motion, number)? {
                control.cross_shifted(number, rises_from(last))?;
            }
            Ok(rises_from(last))
        }
        Place::Unknown => {
            let up = number == 2 && up && goes_straight_up(control, motion)?;
            if !up && goes_with_others(control, motion, number)? {
                cross_unknown(control, number)?;
                let last = control.commons.last_output(axis.letter);
                let last = control.state.last_before_empty(axis.letter, last);
                return Ok(last != EMPTY && rises_from(last));
            }
            Ok(up)
        }
        Place::LeftToScript(_) => {
            if goes_with_others(control, motion, number)? {
                control.cross_forgotten(number);
            }
            Ok(false)
        }
    }
}

/// True when the motion turns a rotary axis, or may, as nothing says where it stands.
pub(super) fn turns(control: &Control, motion: &Motion) -> bool {
    let mut rotary = motion.axes.and(AxisSet::ROTARY).and(control.tables.present()).numbers();
    rotary.any(|number| match control.place(number) {
        Place::At(at) => {
            let (axis, to) = (control.tables.axis(number), motion.position[number]);
            (axis.near(at, to) - to).abs() >= axis.resolution()
        }
        _ => true,
    })
}

/// True for a motion straight up in the CL file, by the last numbers that were said: up first
/// is what it asks for, wherever the tool stands.
fn goes_straight_up(control: &Control, motion: &Motion) -> Result<bool> {
    for number in motion.axes.and(control.tables.present()).numbers() {
        let axis = control.tables.axis(number);
        let last = control.commons.last_output(axis.letter);
        let last = control.state.last_before_empty(axis.letter, last);
        let way = axis.value(motion.position[number])? - last;
        let stays = axis.is_off() || way.abs() <= SAME;
        let rises = last != EMPTY && way * axis.scale() > SAME;
        if number == 2 && !rises || number != 2 && !stays {
            return Ok(false);
        }
    }
    Ok(true)
}
