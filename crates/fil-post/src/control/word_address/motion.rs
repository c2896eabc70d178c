//! Straight motions: axis words, the motion function, the feed.

mod feed_words;
mod leads;

use fil_diag::Result;
use fil_machine::axes::{AXES, AxisSet};
use fil_machine::letters::{F, H};
use fil_machine::locations as loc;
use fil_machine::modes::Plane;
use fil_machine::rounding::Rounding;
use fil_machine::{FunctionCode, Letter};

use super::modes::{self, Own};
use crate::cause::Cause;
use crate::control::{Control, Function, full_turn, vectors};
use crate::control_state::modal::{self, Group, GroupSet};
use crate::control_state::{Compensation, CutterPath, Meaning};
use crate::errors::PostCode;
use crate::operation::motion::{Motion, RapidCode};
use crate::operation::{Feed, Lead};
pub use feed_words::{feed_mode, feed_words, leave_inverse_time};
use leads::format_leads;
pub use leads::{counted_threads, end_lead, lead_mode, lead_word, of_lead};

/// A smaller motion along an axis whose words are off the tape is none, mm, inch or
/// degrees.
const OFF_THE_TAPE: f64 = 1e-3;

/// Writes a rapid motion in one block.
///
/// # Errors
/// A value that does not fit, a missing code, a position outside the travel.
pub fn rapid(control: &mut Control, motion: &Motion, code: RapidCode, cause: Cause) -> Result<()> {
    let at = match code {
        RapidCode::Across => loc::RAPID_CODE_XY,
        RapidCode::Along => loc::RAPID_CODE_Z,
        RapidCode::Turning => loc::ROTARY_RAPID_CODE,
    };
    let code = control.code(at, "rapid move")?;
    ready(control)?;
    if axis_words(control, motion)? {
        let modal = control.commons.read(loc::RAPID_MODAL) && !says_code_of_turn(control);
        motion_code(control, code, modal, cause);
        let word = control.commons.read(loc::RAPID_ADDRESS);
        if let (Some(letter), Some(value)) = (word, control.commons.dbl_opt(loc::RAPID_VALUE)) {
            control.require_letter(letter)?;
            control.because(cause, |control| control.word(letter, value))?;
        }
        if control.commons.read(loc::RAPID_REPEAT_FEED) {
            control.state.doubt(F);
        }
        write_motion(control)?;
    }
    Ok(())
}

/// Writes a feed motion in one block.
///
/// # Errors
/// As [`rapid`]; no feed.
#[inline]
pub fn feed(control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
    ready(control)?;
    if !axis_words(control, motion)? {
        return Ok(());
    }
    let code = control.code(loc::LINEAR_CODE, "linear motion")?;
    let modal = control.commons.read(loc::LINEAR_MODAL) != loc::LinearModal::InEveryBlock
        && !says_code_of_turn(control);
    let cause = control.block.cause;
    motion_code(control, code, modal, cause);
    feed_words(control, feed)?;
    write_motion(control)
}

/// True for a block that turns a rotary axis, on a machine that has its motion code in each.
#[inline]
fn says_code_of_turn(control: &Control) -> bool {
    let turns = |number| control.block_has(control.tables.axis(number).letter);
    control.commons.read(loc::ROTARY_MOTION_CODES)
        && AxisSet::ROTARY.and(control.tables.present()).numbers().any(turns)
}

/// Writes one pass of a thread.
///
/// # Errors
/// As [`rapid`]; the machine has no thread code; a lead that the address can't hold.
pub fn thread(control: &mut Control, motion: &Motion, lead: &Lead) -> Result<()> {
    let letter = control.letter(loc::THREAD_LEAD_ADDRESS, "the lead of a thread")?;
    thread_by(control, motion, lead, letter)
}

/// The same with the letter of its lead.
///
/// # Errors
/// As [`thread`].
pub fn thread_by(
    control: &mut Control,
    motion: &Motion,
    lead: &Lead,
    letter: Letter,
) -> Result<()> {
    let code = control.code(loc::THREAD_CODE, "a thread")?;
    pass_by(control, motion, code, &[(letter, lead.value)], lead.cause)
}

/// A pass whose lead gains as much in each turn as `change` says, and loses below zero.
///
/// # Errors
/// As [`thread`]; the machine has no code for such a pass.
pub fn varying_thread(
    control: &mut Control,
    motion: &Motion,
    lead: &Lead,
    change: f64,
) -> Result<()> {
    let letter = control.letter(loc::THREAD_LEAD_ADDRESS, "the lead of a thread")?;
    let of_change = control.letter(loc::THREAD_CHANGE_ADDRESS, "the change of a lead")?;
    let words = [(letter, lead.value), (of_change, change)];
    let code = control.code(loc::THREAD_VARYING_CODE, "a thread")?;
    pass_by(control, motion, code, &words, lead.cause)
}

/// One pass by a function with the words of its lead.
///
/// # Errors
/// As [`rapid`]; a word that its address can't hold.
pub fn pass_by(
    control: &mut Control,
    motion: &Motion,
    code: FunctionCode,
    words: &[(Letter, f64)],
    cause: Cause,
) -> Result<()> {
    ready(control)?;
    if !axis_words(control, motion)? {
        return Ok(());
    }
    if !control.can().speed_modes_say_feed && words.iter().any(|(letter, _)| *letter == F) {
        lead_mode(control, cause)?;
    }
    motion_code(control, code, false, cause.whole());
    let letters: Vec<Letter> = words.iter().map(|(letter, _)| *letter).collect();
    let usual = format_leads(control, &letters);
    control
        .because(cause, |control| {
            words.iter().try_for_each(|(letter, value)| {
                control.word_rounded(*letter, *value, Rounding::Lead)
            })
        })
        .map_err(of_lead)?;
    write_motion(control)?;
    for (letter, format) in letters.into_iter().zip(usual) {
        control.state.doubt(letter);
        format.into_iter().for_each(|format| control.tables.addresses.set_format(letter, format));
    }
    end_lead(control);
    Ok(())
}

/// Brings the control into the modes a motion counts on.
///
/// # Errors
/// No unit; and as [`modes::require`].
#[inline]
pub fn ready(control: &mut Control) -> Result<()> {
    ready_with(control, Own::Nothing)
}

/// The same for an operation that brings some of them itself.
///
/// # Errors
/// As [`ready`].
#[inline]
fn ready_with(control: &mut Control, own: Own) -> Result<()> {
    if !control.head.started {
        control.begin()?;
    }
    if !control.repeat.ended.is_empty() {
        super::repeat::doubt_ended(control);
    }
    let unit = control.require_unit()?;
    modes::require(control, unit, own)
}

/// The same for an arc: the control may be in its plane, behind another arc.
///
/// # Errors
/// As [`ready`].
pub fn ready_for_arc(control: &mut Control, plane: Plane) -> Result<()> {
    let stays = control.state.is(modal::PLANE, plane);
    ready_with(control, if stays { Own::Plane } else { Own::Nothing })
}

/// The same for a hole: the control may be in the cycle that drills it.
///
/// # Errors
/// As [`ready`].
pub fn ready_for_hole(control: &mut Control, in_cycle: bool) -> Result<()> {
    // A cycle says its plane itself; a hole of single moves needs none.
    let stays = in_cycle && control.state.is(modal::CYCLE, true);
    ready_with(control, if stays { Own::PlaneAndCycle } else { Own::Plane })
}

/// Adds the words of the axes that move; says whether any does.
///
/// # Errors
/// A value that does not fit its address, or lies outside the travel.
#[inline]
pub fn axis_words(control: &mut Control, motion: &Motion) -> Result<bool> {
    let mut scaled = [0; AXES];
    let mut changed = AxisSet::NONE;
    let mut present = motion.axes.and(control.tables.present());
    let doubts = control.state.has_doubts();
    for number in present.numbers() {
        let axis = control.tables.axis(number);
        axis.check(motion.position[number])?;
        if axis.is_off() {
            warn_off_the_tape(control, number, motion.position[number]);
        } else {
            scaled[number] = match &motion.scaled {
                Some(known) => known[number],
                None => axis.scaled(motion.position[number])?,
            };
            let due = axis.changes(scaled[number], &control.commons)
                || (doubts && !control.state.has_last(axis.letter));
            if due {
                changed = changed.or(AxisSet::of(number));
            }
        }
    }
    if control.state.may_be(modal::AXIS_CLAMP, true) {
        full_turn::refuse_clamped(control, changed)?;
    }
    if control.tables.watches_turns {
        if vectors::are_due(control, motion) {
            let written = vectors::axis_words(control, motion, changed, &scaled)?;
            note_axis_words(control, written, motion.word);
            return Ok(true);
        }
        if !changed.and(AxisSet::ROTARY).is_empty() {
            vectors::turned_by_words(control)?;
        }
        let still = full_turn::turn(control, motion, present, changed, &mut scaled)?;
        present = present.without(still);
        changed = changed.without(still);
    }
    if changed.is_empty() {
        return Ok(false);
    }
    let written = if control.commons.read(loc::MOTION_MODAL) { changed } else { present };
    for number in written.numbers() {
        if let Some(position) = control.tables.axis(number).tape_position()? {
            control.block.put(position, scaled[number]);
            if control.block.noting && motion.word != 0 && AxisSet::LINEAR.has(number) {
                control.block.note_word(position, motion.word + number as u16);
            }
        }
    }
    Ok(true)
}

/// Warns of a motion along an axis whose words are off the tape: the machine would not
/// make it.
#[cold]
fn warn_off_the_tape(control: &mut Control, number: usize, position: f64) {
    let at = control.axis_position(number).unwrap_or(0.0);
    if (position - at).abs() > OFF_THE_TAPE {
        let letter = control.tables.axis(number).letter;
        let message = format!("{letter} is not output, but the path goes to {letter}{position:.3}");
        control.warnings.add(PostCode::IgnoredPart, message);
    }
}

/// Adds one axis word, whether or not it has changed.
///
/// # Errors
/// As [`axis_words`].
pub fn axis_word(control: &mut Control, number: usize, motion: &Motion) -> Result<()> {
    let axis = *control.tables.axis(number);
    axis.check(motion.position[number])?;
    if let Some(position) = axis.tape_position()? {
        let mut scaled = axis.scaled(motion.position[number])?;
        if axis.full_turn() != 0 {
            scaled = full_turn::word(control, number, motion.position[number], scaled)?;
        }
        control.block.put(position, scaled);
        note_axis_words(control, AxisSet::of(number), motion.word);
    }
    Ok(())
}

/// Notes which words of the record the words of axes repeat.
#[inline]
fn note_axis_words(control: &mut Control, written: AxisSet, first: u16) {
    if !control.block.noting || first == 0 {
        return;
    }
    for number in written.and(AxisSet::LINEAR).numbers() {
        if let Ok(Some(position)) = control.tables.axis(number).tape_position() {
            control.block.note_word(position, first + number as u16);
        }
    }
}

/// Adds a motion function unless the control has it.
#[inline]
pub fn motion_code(control: &mut Control, code: FunctionCode, modal: bool, cause: Cause) {
    control.check_forgotten();
    if !modal || !control.state.is(modal::MOTION, code) {
        control.block.g(code, cause);
    }
}

/// Writes a motion block: adds the words that wait for it and those of REPEAT.
///
/// # Errors
/// As [`Control::write_block`].
#[inline]
pub fn write_motion(control: &mut Control) -> Result<()> {
    write_turning(control, AxisSet::NONE)
}

/// What compensation leaves to say about a motion.
const OF_COMPENSATION: GroupSet = GroupSet::of(&[Group::CutterComp, Group::CutterPath]);

/// The same for an arc, which moves the axes of its plane even where its end is its
/// start and no word names them.
///
/// # Errors
/// As [`Control::write_block`].
#[inline]
pub fn write_turning(control: &mut Control, turning: AxisSet) -> Result<()> {
    if !control.waiting.is_empty() {
        control.work_offset_first(turning)?;
        if cuts(control) {
            control.comes_with_any_motion(Function::Spindle);
        }
        control.take_waiting(turning)?;
        length_offset_words(control)?;
    }
    let compensated = !control.state.groups().are_usual(OF_COMPENSATION)
        || control.compensation_asked() != Compensation::Off;
    let in_plane = compensated && moves_in_plane(control);
    if in_plane {
        warn_of_still_blocks(control);
    }
    if control.repeat.words.is_empty() {
        control.write_block()?;
    } else {
        super::repeat::write_with_repeats(control)?;
    }
    if in_plane {
        control.state.moved_in_plane();
        control.moved_in_plane_behind = control.tape.count;
    }
    Ok(())
}

/// So many blocks without a motion in the plane of compensation each control reads over.
const READ_OVER: u64 = 1;

/// Warns of blocks between two motions under compensation behind which a control of word address
/// may not see the second motion while it ends the first one: the cutter then goes to where the
/// path is square to it, which lies past an inside corner (Fanuc 30i, B-63944EN-2, 6.6.3).
#[cold]
fn warn_of_still_blocks(control: &mut Control) {
    let state = &control.state;
    // Behind CUTCOM/OFF no corner is left that the control would have to see.
    let goes_on = control.compensation_asked() != Compensation::Off;
    let begun = goes_on && state.compensates() && state.is(modal::CUTTER_PATH, CutterPath::Moved);
    let between = control.tape.count.saturating_sub(control.moved_in_plane_behind);
    if begun && between > READ_OVER && control.can().plain_words {
        let message = format!("{between} blocks before this motion within cutter compensation");
        control.warnings.add(PostCode::StillBlocks, message);
    }
}

/// True for a block that moves at feed: the spindle must turn in it, whichever axes move.
#[cold]
fn cuts(control: &Control) -> bool {
    let rapid = [loc::RAPID_CODE_XY, loc::RAPID_CODE_Z].map(|at| control.code_if_any(at));
    let mut said = control.block.g_codes().iter().map(|(code, _)| *code);
    let motion = said.rfind(|code| matches!(control.meaning(*code), Meaning::Motion(_)));
    let motion = motion.or(control.state.get(modal::MOTION));
    !rapid.contains(&motion)
}

/// True when the block moves an axis of the plane in force.
fn moves_in_plane(control: &Control) -> bool {
    let plane = control.state.get(modal::PLANE).unwrap_or(Plane::Xy);
    plane.axes().into_iter().any(|number| control.block_has(control.tables.axis(number).letter))
}

/// The length offset with the first Z motion after a tool change.
fn length_offset_words(control: &mut Control) -> Result<()> {
    if !control.block_has(control.tables.axis(2).letter) {
        return Ok(());
    }
    if let Some((offset, cause)) = control.take_length()? {
        modes::before_length(control)?;
        let code = control.code(loc::TOOL_LENGTH_CODE, "tool length offset")?;
        control.tip.length_is_called = true;
        control.because(cause, |control| {
            control.g_of_record(code);
            length_number(control, offset)
        })?;
    }
    Ok(())
}

/// Puts the number of the offset that a length is called with.
pub(super) fn length_number(control: &mut Control, offset: i64) -> Result<()> {
    control.state.set(modal::LENGTH_OFFSET, offset);
    control.word(H, offset as f64)
}
