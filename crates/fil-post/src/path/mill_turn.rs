//! Mill-turn machines: what live tools need where the main spindle is the axis C.
//!
//! A tool along Z drills at X and C; it mills by X and Y where the machine has a Y, else
//! in polar interpolation. A tool square to Z turns C to where it looks, and goes along a
//! cylinder while C turns.

mod crossing;
mod cylinder;
mod face;
pub(super) mod hole;
pub(super) mod live_tool;
mod polar;

use fil_diag::Result;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::axis_chain::Rotary;
use fil_machine::commons::{EMPTY, Kind};
use fil_machine::locations::{self as loc, MillTurnMode};
use fil_machine::modes::FeedMode;
use fil_machine::{FunctionCode, Letter, letters};
use nalgebra::{Point3, Vector3};

use super::{feed_rules, functions_of_others, position, rotary, thread};
use crate::control::Control;
use crate::control::full_turn;
use crate::control::needs::Act;
use crate::control::sinumerik::{reader, transformation};
use crate::control::word_address::{modes, spindle};
use crate::control_state::{ForeignBlock, Meaning, Rotation, Source, modal};
use crate::errors::PostCode;
use crate::operation::cycle::{CycleFeed, CycleKind};
use crate::operation::motion::Motion;
use crate::operation::{
    Arc, Feed, MotionKind, Operation, SideSpindle, Spindle, SpindleTurn, Target,
};
use crate::post::Post;
use live_tool::{CENTER, Lie, has_y, lie, position_of};

/// Takes the machine from turning to milling or back.
///
/// # Errors
/// Cutter compensation, a cycle or a thread in force; blocks that may be skipped.
pub fn switch(post: &mut Post, mills: bool) -> Result<()> {
    if post.control.tables.mills() == mills {
        return Ok(());
    }
    thread::end(post)?;
    post.control.end_compensation()?;
    post.require(Act::Mode)?;
    leave(post)?;
    let control = &mut post.control;
    control.begin()?;
    control.flush_waiting()?;
    if spindle::may_turn(control) {
        control.family().write(control, Operation::Spindle(Spindle::Off))?;
    }
    say_mode(control, mills)?;
    set_mode(control, if mills { MillTurnMode::Milling } else { MillTurnMode::Turning })?;
    if control.tables.transforms && !mills {
        modes::plane_of_turning(control)?;
    }
    control.state.set(modal::SPINDLE, Rotation::Standing);
    // Said again, as its feed depends on what turns now.
    control.state.forget(modal::FEED_MODE, Source::Post);
    (control.spindle.turning, control.spindle.turned) = (None, None);
    (control.spindle.speed, control.spindle.range) = (None, None);
    post.path.feed = None;
    post.path.rotary = None;
    post.path.interrupt();
    Ok(())
}

/// Writes once more which spindle turns while the main one is the axis C, so that the program can
/// be begun here.
///
/// # Errors
/// As a block on the tape.
pub(super) fn say_milling_again(control: &mut Control) -> Result<()> {
    // Where the live tool is the master spindle, the M code would be its own.
    match control.commons.int_opt(loc::MILL_TURN_LIVE_SPINDLE) {
        Some(_) => transformation::choose_master(control, true),
        None => say_mode(control, true),
    }
}

/// Writes that the main spindle is the axis C, or turns again.
///
/// # Errors
/// The machine has no code for it.
fn say_mode(control: &mut Control, mills: bool) -> Result<()> {
    let at = if mills { loc::MILL_TURN_MILLING_CODE } else { loc::MILL_TURN_TURNING_CODE };
    let code = control.code(at, "this mode of the main spindle")?;
    // The M code is that of the master spindle, which is the main one for both.
    if !mills {
        transformation::choose_master(control, false)?;
    }
    control.m(code);
    control.write_block()?;
    if mills {
        transformation::choose_master(control, true)?;
    }
    Ok(())
}

/// The settings and tables of a mode; what the letter of C meant before it is forgotten.
fn set_mode(control: &mut Control, mode: MillTurnMode) -> Result<()> {
    let number = match mode {
        MillTurnMode::Turning => 0.0,
        MillTurnMode::Milling => 1.0,
        MillTurnMode::PolarInterpolation => 2.0,
        MillTurnMode::CylindricalInterpolationByTracyl => 3.0,
    };
    for axis in [1, 3] {
        let letter = control.tables.axis(axis).letter;
        control.commons.set_last_output(letter, EMPTY);
    }
    control.commons.set(Kind::Int, loc::MILL_TURN_MODE.number.into(), number)?;
    control.refresh()?;
    control.state.doubt_axes();
    Ok(())
}

/// Ends polar and cylindrical interpolation, where they are on.
///
/// # Errors
/// Cutter compensation, blocks that may be skipped.
fn leave(post: &mut Post) -> Result<()> {
    polar::end(post)?;
    cylinder::end(post)
}

/// Refuses a transformation in which C goes wherever X and Y ask it to, while its travel ends.
fn refuse_travel_of_c(control: &Control, code: PostCode) -> Result<()> {
    let c = control.tables.chain().rotaries[0].as_ref();
    match c.is_some_and(Rotary::is_limited) {
        true => code.err("the travel of C is limited, and how far C turns in it is not followed"),
        false => Ok(()),
    }
}

/// A feed in a plane of X and C, or around a cylinder, at which Z goes no faster than it may.
fn limit_to_axes(post: &mut Post, feed: Feed, to: &Position) -> Feed {
    let way = [0, 1, 2].map(|number| post.control.stands(number).map(|at| to[number] - at));
    let length = way.iter().try_fold(0.0, |sum, way| way.map(|way| sum + way * way));
    feed_rules::limit_to_axes(post, feed, way, length.map(f64::sqrt))
}

/// What a motion of a live tool asks for before it is made; true where that made the
/// motion itself.
///
/// # Errors
/// A thread, a feed a turn, and what polar interpolation refuses.
#[cold]
pub(super) fn prepare(post: &mut Post, target: Target, kind: MotionKind) -> Result<bool> {
    let (point, axis) = position::transformed(post, target);
    let axial = lie(axis)? == Lie::Axial;
    match kind {
        MotionKind::Thread(_) => return PostCode::MillTurn.err("a thread by a live tool"),
        MotionKind::Feed => {
            refuse_feed_a_turn(post.path.feed.map(|feed| feed.mode))?;
            refuse_unknown_c(post)?;
            if spindle::stands(&post.control) {
                let message = "a feed move: the live tool is stopped".to_string();
                post.warn(PostCode::SpindleStands, message);
            }
        }
        MotionKind::Rapid(_) => cylinder::end(post)?,
    }
    if post.control.tables.is_polar() {
        if axial {
            polar::line(post, target, point, kind)?;
            return Ok(true);
        }
        polar::end(post)?;
    }
    if post.control.tables.is_unrolled() {
        match axial {
            true => cylinder::end(post)?,
            false if cylinder::stands(post, point, axis)? => {
                cylinder::along(post, target)?;
                return Ok(true);
            }
            false => {}
        }
    }
    let by_polar = axial
        && post.path.cycle.is_none()
        && !has_y(&post.control)
        && live_tool::has_polar(&post.control);
    match kind {
        MotionKind::Rapid(_) if by_polar && turns(post, point) => {
            polar::begin(post, target, point, kind)?;
            Ok(true)
        }
        MotionKind::Rapid(cause) if !axial => {
            let (position, solution) = position_of(post, point, axis)?;
            rotary::establish(post, solution)?;
            let word = position::word_of(post, target);
            let motion = Motion::new(position, AxisSet::ALL, word);
            crossing::rapid(&mut post.control, &motion, cause)?;
            post.path.arrive(target);
            Ok(true)
        }
        _ => Ok(false),
    }
}

/// C must turn for an axial tool to come to a point, or X is not known.
fn turns(post: &Post, point: Point3<f64>) -> bool {
    let Some(here) = post.path.point.filter(|_| post.path.rotary.is_some()) else { return true };
    let here = position::transformed(post, Target { point: here, axis: Vector3::z(), word: 0 }).0;
    (here - point).xy().norm() > CENTER
}

/// Refuses a motion at feed while nobody knows where C stands: its word would turn it there at
/// feed, by any number of turns.
fn refuse_unknown_c(post: &Post) -> Result<()> {
    let known = post.path.rotary.is_some() && post.control.axis_position(3).is_some();
    if known || post.control.tables.is_polar() {
        return Ok(());
    }
    PostCode::MillTurn
        .err("a feed move while the position of C is not known; position it with RAPID")
}

fn refuse_feed_a_turn(mode: Option<FeedMode>) -> Result<()> {
    if mode == Some(FeedMode::PerRevolution) {
        return PostCode::MillTurn
            .err("feed per revolution needs the main spindle, which is a C axis now");
    }
    Ok(())
}

/// A feed motion of a live tool in which C turns.
///
/// # Errors
/// A tool along Z before polar interpolation has begun; as [`cylinder::feed`] and [`face::feed`].
pub(super) fn turning_feed(
    post: &mut Post,
    from: Position,
    to: Position,
    target: Target,
) -> Result<()> {
    let (_, axis) = position::transformed(post, target);
    if lie(axis)? == Lie::Axial {
        if live_tool::is_cut_by_c(&post.control) {
            return face::feed(post, from, to, target);
        }
        return PostCode::Polar.err_with(
            "C would turn in a feed move of a tool along Z",
            "Put RAPID before the first move: polar interpolation begins there.",
        );
    }
    cylinder::feed(post, from, to, target)
}

/// What an operation that is no straight motion asks of a machine that mills.
///
/// # Errors
/// Threads, functions that controls take in different ways, a feed a turn.
pub(super) fn before(post: &mut Post, operation: &Operation) -> Result<()> {
    if post.control.tables.mill_turn.is_some() {
        refuse_modes_of_others(&post.control, operation)?;
    }
    if !post.control.tables.mills() {
        return Ok(());
    }
    match operation {
        Operation::Thread(_) => PostCode::MillTurn.err("a thread by a live tool"),
        Operation::Hole(_) => {
            // The turns of a tap are those of the live tool.
            let drills = post.path.cycle.as_ref().filter(|cycle| cycle.kind != CycleKind::Tap);
            if let Some(CycleFeed::Feed(feed)) = drills.map(|cycle| cycle.feed) {
                refuse_feed_a_turn(Some(feed.mode))?;
            }
            leave(post)
        }
        Operation::End(_) => {
            post.path.cycle = None;
            switch(post, false)
        }
        // Its code of turns a minute is none of those that polar interpolation takes.
        Operation::Spindle(Spindle::Turn(SpindleTurn { speed: Some(_), .. }))
        | Operation::Spindle(Spindle::Side(SideSpindle { speed: Some(_), .. }))
            if !spindle::counts_turns(&post.control) =>
        {
            leave(post)
        }
        Operation::MachinePosition(_) | Operation::ToolChange(_) | Operation::WorkOffset(_) => {
            leave(post)
        }
        others if changes_plane(&post.control, others) => leave(post),
        _ => Ok(()),
    }
}

/// Functions of others that no polar or cylindrical interpolation goes on behind: another zero,
/// plane, unit or tool, a cycle, and what can't be read.
fn changes_plane(control: &Control, operation: &Operation) -> bool {
    let changes = |letter: Letter, code: FunctionCode| match letter {
        letters::G => matches!(
            control.meaning(code),
            Meaning::Origin(_)
                | Meaning::Cycle
                | Meaning::Plane(_)
                | Meaning::Unit(_)
                | Meaning::Unknown
        ),
        letters::T => true,
        letters::M => control.changes_tool(code) || control.calls_program(code),
        _ => false,
    };
    let says_more = |blocks: &[ForeignBlock]| !blocks.iter().all(ForeignBlock::is_words);
    functions_of_others::has(operation, changes)
        || matches!(operation, Operation::Text(blocks) if says_more(blocks))
}

/// Refuses functions of others that change what C and the main spindle are: the post would not
/// know in which mode the control is.
///
/// # Errors
/// A text, POSTN, PREFUN or AUXFUN with one of them.
fn refuse_modes_of_others(control: &Control, operation: &Operation) -> Result<()> {
    if matches!(operation, Operation::Turn(..)) {
        return PostCode::MillTurn
            .err("ROTABL: C turns with the points and tool axes of live tools");
    }
    refuse_axes_of_others(control, operation)?;
    let of_g =
        [loc::MILL_TURN_POLAR_CODE, loc::MILL_TURN_POLAR_END_CODE, loc::MILL_TURN_CYLINDER_CODE];
    let of_g = of_g.map(|at| live_tool::tenths(control, at));
    let of_m = [loc::MILL_TURN_MILLING_CODE, loc::MILL_TURN_TURNING_CODE];
    // The code that stops a spindle makes it no axis where SETMS must come before it.
    let stop = control.code_if_any(loc::SPINDLE_STOP_CODE);
    let of_m = of_m.map(|at| control.code_if_any(at).filter(|code| Some(*code) != stop));
    let of_main = turns_main(control);
    let changes = |letter: Letter, code: FunctionCode| match letter {
        letters::G => of_g.contains(&Some(code)),
        letters::M => of_m.contains(&Some(code)) || of_main.contains(&Some(code)),
        _ => false,
    };
    let found = match operation {
        Operation::Text(blocks) if control.can().mode_statements => {
            let milling = control.code_if_any(loc::MILL_TURN_MILLING_CODE);
            let milling = milling.map(|code| format!("M{}", code.value()));
            let is_milling = |item: &String| Some(item) == milling.as_ref();
            blocks
                .iter()
                .any(|block| reader::transforms(block) || block.items.iter().any(is_milling))
        }
        _ => functions_of_others::has(operation, changes),
    };
    match found {
        true => PostCode::MillTurn.err(
            "a function that changes what C and the main spindle are; MODE/MILL and MODE/TURN do it",
        ),
        false => Ok(()),
    }
}

/// The functions that turn the main spindle while it is the axis C, where the live tool has
/// others.
fn turns_main(control: &Control) -> [Option<FunctionCode>; 2] {
    let main = [loc::SPINDLE_CW_CODE, loc::SPINDLE_CCW_CODE];
    let live = [loc::MILL_TURN_LIVE_CW_CODE, loc::MILL_TURN_LIVE_CCW_CODE];
    let live = live.map(|at| control.code_if_any(at));
    main.map(|at| {
        let code = control.code_if_any(at).filter(|_| control.tables.mills());
        code.filter(|code| !live.contains(&Some(*code)))
    })
}

/// Refuses axis words of others in polar interpolation and TRACYL, where they count otherwise
/// than who wrote them can know.
fn refuse_axes_of_others(control: &Control, operation: &Operation) -> Result<()> {
    if !control.tables.is_polar() && !control.tables.is_unrolled() {
        return Ok(());
    }
    let counts_otherwise = |letter: Letter| [b'X', b'Y', b'C', b'U', b'V'].contains(&letter.byte());
    let found = match operation {
        Operation::Words(words) | Operation::Repeat(words) => {
            words.iter().any(|(letter, ..)| counts_otherwise(*letter))
        }
        Operation::Text(blocks) => blocks
            .iter()
            .any(|block| block.words().iter().any(|(letter, _)| counts_otherwise(*letter))),
        _ => false,
    };
    match found {
        true => PostCode::MillTurn.err(
            "foreign axis words in polar interpolation or TRACYL, where X and its second axis are a plane or a cylinder; RAPID with another tool axis ends it",
        ),
        false => Ok(()),
    }
}

/// What an arc of a live tool asks for.
///
/// # Errors
/// A feed a turn; an arc about Z without Y and without polar interpolation.
#[cold]
pub(super) fn before_arc(post: &mut Post, arc: &Arc, target: Target) -> Result<()> {
    refuse_feed_a_turn(post.path.feed.map(|feed| feed.mode))?;
    cylinder::end(post)?;
    let axial = lie(position::transformed(post, target).1)? == Lie::Axial;
    match (axial, post.control.tables.is_polar()) {
        (true, true) => {
            full_turn::refuse_clamped(&post.control, AxisSet::XY)?;
            polar::check_arc(post, arc, target)
        }
        (false, true) => polar::end(post),
        (true, false) if !has_y(&post.control) && !live_tool::is_cut_by_c(&post.control) => {
            PostCode::Polar
                .err("an arc by a tool along Z; polar interpolation begins at a rapid move")
        }
        _ => Ok(()),
    }
}
