//! Motions: `L` at FMAX or at feed, `CC` and `C` or `CP`.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::axes::AxisSet;
use fil_machine::letters::{F, IJK, XYZ};
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Plane};

use super::helix::{self, Helix};
use super::line::{self, Line};
use super::phrase::Head;
use super::repeat;
use crate::control::needs::{self, Act};
use crate::control::word_address::arc;
use crate::control::word_address::dwell::known_speed;
use crate::control::word_address::motion as words;
use crate::control::word_address::repeat as words_of_repeat;
use crate::control::{Control, Function};
use crate::control_state::{Compensation, Source, modal};
use crate::errors::PostCode;
use crate::noted::TEXT;
use crate::operation::Feed;
use crate::operation::motion::{Motion, PlaneArc};

/// The same in a line of Klartext.
const MACHINE_LINE: FunctionCode = FunctionCode::whole(91);

/// In a program in inches F counts tenths of an inch a minute.
const TENTHS: f64 = 10.0;

/// M136: F is a feed a turn of the spindle.
const PER_REVOLUTION: FunctionCode = FunctionCode::whole(136);

/// M137: F is a feed a minute again.
const PER_MINUTE: FunctionCode = FunctionCode::whole(137);

/// M91: the line counts in the frame of the machine.
const IN_MACHINE: FunctionCode = FunctionCode::whole(91);

/// Rapid traverse in one line.
///
/// # Errors
/// A value that does not fit, a position outside the travel.
pub fn rapid(control: &mut Control, motion: &Motion) -> Result<()> {
    if control.commons.read(loc::RAPID_ADDRESS).is_some() {
        return PostCode::Family
            .err("a word of its own for rapid moves (rapid.address): FMAX has none");
    }
    ready(control)?;
    if words::axis_words(control, motion)? {
        write_rapid(control)?;
    }
    Ok(())
}

/// Writes the block under construction as a rapid motion to a position of the machine.
///
/// # Errors
/// As the line of a motion.
pub fn to_machine_position(control: &mut Control) -> Result<()> {
    control.m(MACHINE_LINE);
    write_rapid(control)
}

/// Ends cutter compensation in a line at rapid to where Z stands; behind a feed the tool may be in
/// the cut, out of which that line would lead it sideways.
///
/// # Errors
/// As the line of a motion.
pub fn end_compensation(control: &mut Control) -> Result<()> {
    let z = control.tables.axis(2).letter;
    let Some(at) = control.last_value(z).filter(|_| !control.klartext.at_feed) else {
        return Ok(());
    };
    let waiting = control.block.take();
    control.word(z, at)?;
    write_rapid(control)?;
    control.block = waiting;
    Ok(())
}

fn write_rapid(control: &mut Control) -> Result<()> {
    control.klartext.phrase.head = Head::Line;
    control.klartext.phrase.rapid = true;
    write(control, AxisSet::NONE)
}

/// A straight line at feed.
///
/// # Errors
/// As [`rapid`]; no feed, or one that F can't say.
pub fn feed(control: &mut Control, motion: &Motion, feed: Option<&Feed>) -> Result<()> {
    ready(control)?;
    if words::axis_words(control, motion)? {
        control.klartext.phrase.head = Head::Line;
        feed_word(control, feed)?;
        write(control, AxisSet::NONE)?;
    }
    Ok(())
}

/// True for an arc or a helix about the tool axis, which is Z.
pub fn has_arc(plane: Plane) -> bool {
    plane == Plane::Xy
}

/// True when the control reads an arc or a helix from its rounded words as it is meant.
///
/// # Errors
/// A position that does not fit its address.
pub fn reads_as_meant(control: &Control, arc: &PlaneArc) -> Result<bool> {
    if helix::rises(control, arc)? {
        return Ok(helix::of(control, arc, arc.start)?.is_some());
    }
    arc::reads_as_meant(control, arc)
}

/// Where the tool stands in X and Y behind an arc, whose words end at `on_tape`: a helix has no
/// such words.
///
/// # Errors
/// A position that does not fit its address.
pub fn end_of_arc(control: &Control, arc: &PlaneArc, on_tape: [f64; 2]) -> Result<[f64; 2]> {
    let helix =
        if helix::rises(control, arc)? { helix::of(control, arc, arc.start)? } else { None };
    Ok(helix.map_or(on_tape, |helix| helix.end))
}

/// An arc: its pole, and the line to its end; a helix turns by an angle instead.
///
/// # Errors
/// As [`feed`]; a helix that no angle turns to its end, since the line to the end of an arc has
/// no word for its rise.
pub fn arc(control: &mut Control, arc: &PlaneArc, feed: Option<&Feed>) -> Result<()> {
    ready(control)?;
    if helix::rises(control, arc)? {
        let stands = control.klartext.start(arc.start);
        return match helix::of(control, arc, stands)? {
            Some(helix) => turn(control, arc, helix, feed),
            None => PostCode::Family.err("a helix that no angle with its digits turns to its end"),
        };
    }
    let pole = pole(control, arc, arc.center)?;
    let end = Motion::new(arc.to, AxisSet::LINEAR, arc.word);
    for number in arc.plane.axes() {
        words::axis_word(control, number, &end)?;
    }
    feed_word(control, feed)?;
    line::put(control, &pole)?;
    control.klartext.phrase.head = Head::Arc { ccw: arc.counterclockwise };
    write(control, AxisSet::XY)
}

/// `CC`: the center itself, with the digits of I and J.
fn pole(control: &Control, arc: &PlaneArc, center: [f64; 2]) -> Result<Line> {
    let mut pole = Line::default();
    pole.item(TEXT, "CC", arc.cause);
    for (number, center) in arc.plane.axes().into_iter().zip(center) {
        let axis = control.tables.axis(number);
        let (text, _) = line::length(control, IJK[number], center + axis.translation())?;
        pole.item(IJK[number].byte(), &format!("{}{text}", axis.letter), arc.cause);
    }
    Ok(pole)
}

/// `CP IPA+360 IZ-1 DR+`: no word says where X and Y end, but the next motions count from
/// there.
fn turn(control: &mut Control, arc: &PlaneArc, helix: Helix, feed: Option<&Feed>) -> Result<()> {
    let mut ends = [(XYZ[2], 0.0); 3];
    for (number, end) in ends.iter_mut().enumerate() {
        let axis = control.tables.axis(number);
        axis.check(arc.to[number])?;
        *end = (axis.letter, axis.value(arc.to[number])?);
    }
    let (letter, end) = ends[2];
    let format = control.tables.addresses.format(letter).copied().unwrap_or_default();
    let from = control.last_value(letter).map_or(Ok(0), |from| format.scale(from))?;
    let rise = format.scale(end)? - from;
    let pole = pole(control, arc, helix.pole)?;
    feed_word(control, feed)?;
    line::put(control, &pole)?;
    control.klartext.phrase.head = Head::Helix { degrees: helix.angle, rise };
    write(control, AxisSet::XY)?;
    control.klartext.stands = helix.end.map(Some);
    for (letter, end) in ends {
        control.commons.set_last_output(letter, end);
    }
    Ok(())
}

/// Refuses a motion while it is not known what the control does with the radius of the
/// tool.
///
/// # Errors
/// No unit; cutter compensation that a text may have ended.
pub fn ready(control: &mut Control) -> Result<()> {
    control.begin()?;
    control.require_motion()?;
    if !control.repeat.ended.is_empty() {
        words_of_repeat::doubt_ended(control);
    }
    control.require_unit()?;
    let begun = !control.waiting.has(Function::Compensation);
    let lost = control.state.get(modal::CUTTER_COMP).is_none() && begun;
    if lost && control.compensation_asked() != Compensation::Off {
        let diag = PostCode::CompensationLost
            .diag("an unreadable foreign block during cutter compensation");
        control.doubt(Source::Author, diag, "taken to be as CUTCOM has it")?;
        control.state.set(modal::CUTTER_COMP, control.compensation_asked());
    }
    Ok(())
}

/// Adds F where the control does not have it.
fn feed_word(control: &mut Control, feed: Option<&Feed>) -> Result<()> {
    let feed = *needs::feed(feed)?;
    let value = match feed.mode {
        FeedMode::PerMinute => spelled(control, feed.value),
        FeedMode::PerRevolution if control.is_metric() => feed.value,
        FeedMode::PerRevolution => spelled(control, a_minute(control, feed.value)?),
        FeedMode::InverseTime => return PostCode::Family.err("inverse time: F is a feed here"),
    };
    let is_metric = control.is_metric();
    say_mode(control, if is_metric { feed.mode } else { FeedMode::PerMinute });
    control.modal_feed(F, &Feed { value, ..feed })
}

/// A feed a turn of the spindle as one a minute, at the speed that it has. What M136 counts
/// in inches is not known, and cycles know no other feeds.
///
/// # Errors
/// How fast the spindle turns is not known.
pub(super) fn a_minute(control: &Control, feed: f64) -> Result<f64> {
    match known_speed(control) {
        Some(speed) => Ok(feed * speed * control.upm_factor()),
        None => PostCode::Family.err("feed per revolution while the spindle speed is not known"),
    }
}

/// Says whether F is a feed a minute or a turn, where the control may take it otherwise.
pub(super) fn say_mode(control: &mut Control, mode: FeedMode) {
    if !control.state.is(modal::FEED_MODE, mode) {
        control.m(if mode == FeedMode::PerRevolution { PER_REVOLUTION } else { PER_MINUTE });
        control.state.set(modal::FEED_MODE, mode);
        control.state.doubt(F);
    }
}

/// A feed a minute as the language counts it.
pub(super) fn spelled(control: &Control, feed: f64) -> f64 {
    if control.is_metric() { feed } else { feed * TENTHS }
}

/// Writes the line of a motion with the words that wait for it.
pub(super) fn write(control: &mut Control, turning: AxisSet) -> Result<()> {
    let moves = |control: &Control, number| {
        turning.has(number) || control.block_has(control.tables.axis(number).letter)
    };
    let in_plane = moves(control, 0) || moves(control, 1);
    if control.waiting.has(Function::Compensation) {
        let off = control.compensation_asked() == Compensation::Off;
        if (off || in_plane) && control.take_function(Function::Compensation) {
            control.klartext.phrase.side = Some(control.compensation_asked());
        }
    } else if control.state.get(modal::CUTTER_COMP).is_none() {
        control.klartext.phrase.side = Some(Compensation::Off);
    }
    if !control.waiting.is_empty() {
        if !control.klartext.phrase.rapid {
            control.comes_with_any_motion(Function::Spindle);
        }
        control.take_waiting(turning)?;
    }
    control.klartext.at_feed = !control.klartext.phrase.rapid;
    for number in [0, 1] {
        if control.block_has(control.tables.axis(number).letter) {
            control.klartext.stands[number] = None;
        }
    }
    // Words of others have no place in the frame of the machine.
    let of_machine = control.block.m_codes().iter().any(|(code, _)| *code == IN_MACHINE);
    let kept = if control.repeat.words.is_empty() || of_machine {
        Vec::new()
    } else {
        repeat::add(control)?
    };
    if control.block.is_empty() {
        // A helix may have no word that the block counts.
        control.require(Act::Block)?;
        super::phrase::write(control)?;
    } else {
        control.write_block()?;
    }
    for (letter, value) in kept {
        control.commons.set_last_output(letter, value);
    }
    if in_plane && control.state.compensates() {
        control.state.moved_in_plane();
    }
    Ok(())
}
