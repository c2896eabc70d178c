//! What comes before words of rotary axes: clamped ones do not turn, those that the post
//! clamps are released, and where positions count from 0 to 360 a word has the sign, or
//! the way, that the control takes to it.
//!
//! A motion of the post turns an axis by half a turn at most, so where the word before is
//! known, so is the way; at half a turn the angles in degrees say it.

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet, Position};
use fil_machine::locations::{self as loc, RotaryOutput, RotaryZeroSign};
use fil_machine::user_blocks;

use super::{Control, user_texts};
use crate::control::needs::Act;
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::motion::Motion;

/// Turns and clamps of the rotary axes.
#[derive(Clone, Copy, Debug, Default)]
pub(crate) struct Rotary {
    /// Where they were last brought, degrees over any number of turns, for axes whose words count
    /// within one.
    pub wound: [Option<f64>; 2],
    /// They are clamped, as far as the post has commanded it.
    pub clamped: Option<bool>,
    /// They have turned, and no rapid motion has ended since.
    pub turns: bool,
}

/// The first rotary axis by number.
const FIRST: usize = 3;

/// Half a turn may be off by this, degrees: no tape has so few digits that it could be more.
const HALF_TURN: f64 = 0.6;

/// Gives the words of a motion their signs, and says which axes stand still: a word at the
/// position where an axis stands could be a full turn.
///
/// # Errors
/// The control would turn another way.
#[cold]
pub(super) fn turn(
    control: &mut Control,
    motion: &Motion,
    present: AxisSet,
    changed: AxisSet,
    scaled: &mut [i64; AXES],
) -> Result<AxisSet> {
    if !changed.and(AxisSet::ROTARY).is_empty() {
        release(control)?;
    }
    let mut still = AxisSet::NONE;
    for number in present.and(AxisSet::ROTARY).numbers() {
        if control.tables.axis(number).full_turn() == 0 {
            continue;
        }
        let to = motion.position[number];
        if changed.has(number) && stood(control, number) != Some(scaled[number]) {
            scaled[number] = word(control, number, to, scaled[number])?;
        } else {
            control.rotary.wound[number - FIRST] = Some(to);
            still = still.or(AxisSet::of(number));
        }
    }
    Ok(still)
}

/// Refuses a turn of a rotary axis that CLAMP/ON or a text has clamped: the drive would turn
/// against its brake. A machine whose clamps the post works releases them by itself. In the
/// plane of X and C, and around a cylinder, C turns where X or Y goes.
///
/// # Errors
/// One of the axes that change turns.
#[cold]
pub(crate) fn refuse_clamped(control: &Control, changed: AxisSet) -> Result<()> {
    let tables = &control.tables;
    let turning = match () {
        () if tables.is_polar() => AxisSet::ROTARY.or(AxisSet::XY),
        () if tables.is_unrolled() => AxisSet::ROTARY.or(AxisSet::of(1)),
        () => AxisSet::ROTARY,
    };
    let turns = !changed.and(turning).is_empty();
    if turns && !tables.clamps { control.require(Act::ClampedMove) } else { Ok(()) }
}

/// Releases the rotary axes before they turn, where the post clamps them, behind the user's blocks
/// before a turn; the block under construction comes behind it.
///
/// # Errors
/// As [`Control::write_block`], and as the user's blocks, which may move nothing here.
pub(crate) fn release(control: &mut Control) -> Result<()> {
    let releases = control.tables.clamps && control.rotary.clamped != Some(false);
    let begins = !std::mem::replace(&mut control.rotary.turns, true) && control.tables.turn_texts;
    if !(releases || begins) {
        return Ok(());
    }
    let motion = control.block.take();
    if begins {
        user_texts::write_at_rest(control, user_blocks::TURN.before)?;
    }
    if releases {
        clamp(control, false)?;
        // In a block that may be left out, so may be what follows; outside of it the axes may
        // still be held.
        control.rotary.clamped = Some(false).filter(|_| !control.state.may_be_skipped());
    }
    control.block = motion;
    Ok(())
}

/// Ends a turn with the rapid motion at hand, or with the next one behind a turn at feed: the rotary axes
/// are clamped again, where the machine does so, and the user's blocks stand behind that.
///
/// # Errors
/// As [`clamp`] and as the blocks.
#[inline]
pub(super) fn end_turn(control: &mut Control) -> Result<()> {
    match std::mem::take(&mut control.rotary.turns) {
        true => at_rest(control),
        false => Ok(()),
    }
}

#[cold]
fn at_rest(control: &mut Control) -> Result<()> {
    let is_free = control.rotary.clamped == Some(false);
    if control.tables.clamps_turns && is_free {
        clamp(control, true)?;
    }
    match control.tables.turn_texts {
        true => user_texts::write(control, user_blocks::TURN.after),
        false => Ok(()),
    }
}

/// Clamps the rotary axes, or releases them.
///
/// # Errors
/// The machine has no code for it; as [`Control::write_block`].
pub(crate) fn clamp(control: &mut Control, on: bool) -> Result<()> {
    let (at, what) = match on {
        true => (loc::ROTARY_CLAMP_CODE, "clamped rotary axes"),
        false => (loc::ROTARY_UNCLAMP_CODE, "rotary axes that turn"),
    };
    let code = control.code(at, what)?;
    control.m(code);
    control.write_block()?;
    control.rotary.clamped = Some(on);
    Ok(())
}

/// The word of an axis that goes to a position, degrees, from what it is within a turn.
///
/// # Errors
/// The control would turn another way.
pub(super) fn word(control: &mut Control, number: usize, to: f64, scaled: i64) -> Result<i64> {
    let before = control.rotary.wound[number - FIRST].replace(to);
    let form = control.commons.read(loc::ROTARY_OUTPUT);
    let Some(turn) = turn_on_tape(control, number, before, to, scaled)? else {
        return Ok(scaled);
    };
    let full = control.tables.axis(number).full_turn();
    match form {
        RotaryOutput::ShortestPathWithinATurn if 2 * turn.abs() == full => {
            refuse(control, number, "moves by 180 degrees, and both directions are equally short")
        }
        RotaryOutput::SignWithinATurn => signed(control, number, scaled, turn < 0),
        _ => Ok(scaled),
    }
}

/// Where an axis stands within a turn, as a scaled integer; `None` where that is not known. The
/// control may have to be told its position again, but not by a word that could be a full turn.
fn stood(control: &Control, number: usize) -> Option<i64> {
    let axis = control.tables.axis(number);
    let value = control.state.stands(axis.letter, control.commons.last_output(axis.letter))?;
    axis.within_a_turn(value)
}

/// How far an axis turns on the tape; `None` where the control's position is not known.
fn turn_on_tape(
    control: &Control,
    number: usize,
    before: Option<f64>,
    to: f64,
    scaled: i64,
) -> Result<Option<i64>> {
    let axis = control.tables.axis(number);
    let full = axis.full_turn();
    let Some(last) = stood(control, number) else { return Ok(None) };
    let ahead = (scaled - last).rem_euclid(full);
    if 2 * ahead != full {
        return Ok(Some(if 2 * ahead < full { ahead } else { ahead - full }));
    }
    let turn = before.map(|before| (to - before) * axis.scale());
    match turn.map(|turn| turn - 360.0 * (turn / 360.0).trunc()) {
        Some(turn) if (turn.abs() - 180.0).abs() < HALF_TURN => {
            Ok(Some(if turn > 0.0 { ahead } else { ahead - full }))
        }
        _ => refuse(control, number, "moves by 180 degrees in an unknown direction"),
    }
}

/// A word whose sign is the way round.
fn signed(control: &Control, number: usize, scaled: i64, in_minus: bool) -> Result<i64> {
    if scaled != 0 {
        return Ok(if in_minus { -scaled } else { scaled });
    }
    let full = control.tables.axis(number).full_turn();
    if control.can().spells_way_round {
        return Ok(if in_minus { -full } else { 0 });
    }
    match control.commons.read(loc::ROTARY_ZERO_SIGN) {
        RotaryZeroSign::PlusOrMinus360 => Ok(if in_minus { -full } else { full }),
        RotaryZeroSign::ZeroInPlus if in_minus => {
            refuse(control, number, "turns to 0 in minus, and the control reads 0 as in plus")
        }
        RotaryZeroSign::ZeroInMinus if !in_minus => {
            refuse(control, number, "turns to 0 in plus, and the control reads 0 as in minus")
        }
        _ => Ok(0),
    }
}

fn refuse<T>(control: &Control, number: usize, why: &str) -> Result<T> {
    let letter = control.tables.axis(number).letter;
    PostCode::WayRound.err(format!("{letter} {why}"))
}

/// Refuses a feed motion in which an axis would not turn as it is meant: the other way round
/// where the control turns in plus only, or from where it is not known to stand.
///
/// # Errors
/// It would.
#[cold]
pub(crate) fn check_feed(control: &Control, from: [f64; 2], to: &Position) -> Result<()> {
    let form = control.commons.read(loc::ROTARY_OUTPUT);
    if form == RotaryOutput::ShortestPathWithinATurn {
        return Ok(());
    }
    for number in AxisSet::ROTARY.and(control.tables.present()).numbers() {
        let axis = control.tables.axis(number);
        let turn = (to[number] - from[number - FIRST]) * axis.scale();
        if axis.full_turn() == 0 || turn.abs() < axis.resolution() {
            continue;
        }
        if stood(control, number).is_none() {
            return refuse(
                control,
                number,
                "moves at feed from an unknown position, and the control chooses the direction",
            );
        }
        if form == RotaryOutput::PositiveWithinATurn && turn < 0.0 {
            return refuse(
                control,
                number,
                "turns in minus at feed, and the control turns it in plus only",
            );
        }
    }
    Ok(())
}

/// Refuses a motion at feed behind another zero, where the control takes one way to a position
/// within a turn: that may be nearly a full turn.
///
/// # Errors
/// An axis counts from another zero than when it was brought to where it stands.
#[cold]
pub(crate) fn check_zero(control: &Control) -> Result<()> {
    if control.commons.read(loc::ROTARY_OUTPUT) == RotaryOutput::ShortestPathWithinATurn {
        return Ok(());
    }
    let mut rotary = AxisSet::ROTARY.and(control.tables.present()).numbers();
    let is_shifted = |number: &usize| {
        let turns = control.tables.axis(*number).full_turn() != 0;
        turns && matches!(control.place(*number), Place::Shifted(_))
    };
    match rotary.find(is_shifted) {
        Some(number) => refuse(
            control,
            number,
            "counts from another zero than before, and the control takes one way round",
        ),
        None => Ok(()),
    }
}

/// The way to a position within a turn as a SINUMERIK spells it: `ACP(350)`, `ACN(10)`,
/// `DC(90)`; `None` for an axis whose positions count on. `digits` is the word's number.
#[cold]
pub(super) fn spelled(control: &Control, number: usize, digits: &str) -> Option<String> {
    let axis = control.tables.axis(number);
    if axis.full_turn() == 0 {
        return None;
    }
    let (in_minus, size) = match digits.strip_prefix('-') {
        Some(size) => (true, size),
        None => (false, digits),
    };
    let size = if size.parse() == Ok(360.0) { "0" } else { size };
    Some(match control.commons.read(loc::ROTARY_OUTPUT) {
        RotaryOutput::ShortestPathWithinATurn => format!("DC({size})"),
        RotaryOutput::SignWithinATurn if in_minus => format!("ACN({size})"),
        _ => format!("ACP({size})"),
    })
}
