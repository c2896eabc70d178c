//! A tool change with what is around it: the user's blocks, the way to the machine's
//! change position, the preparation of the next tool.

use fil_diag::Result;
use fil_machine::Commons;
use fil_machine::axes::{AxisSet, Position};
use fil_machine::locations::{self as loc, ToolChangeBlock};
use fil_machine::user_blocks::{self, Around, UserBlocks};

use super::{frame, frame_end, rapid, rapid_lean, tip_control, turned_apart, way_home};
use crate::cause::Cause;
use crate::control::Control;
use crate::control::machine_frame::{self, Before};
use crate::control::user_texts;
use crate::control::word_address::tool::{self, Changes};
use crate::control_state::Place;
use crate::errors::PostCode;
use crate::operation::motion::Motion;
use crate::operation::{NextTools, Operation, ToolChange};
use crate::post::Post;

/// True for a machine whose tool changes depend on those behind them.
pub fn looks_ahead(commons: &Commons) -> bool {
    let last = user_blocks::LAST_CHANGE;
    commons.read(loc::TOOL_PRESELECT)
        || commons.read(loc::TOOL_CALL_SPEED)
        || last.before.is_on(commons)
        || last.after.is_on(commons)
}

/// Refuses the change to a tool that blocks behind the skip switch may have brought already: the
/// machine then stays where it is, and else comes from its change position.
fn refuse_change_by_switch(control: &Control, tool: i64) -> Result<()> {
    let may_be_in =
        control.state.tools_by_block_delete().is_some_and(|tools| tools.contains(&Some(tool)));
    match may_be_in && matches!(control.place(2), Place::Between(_)) {
        true => PostCode::SkippedPart.err(format!(
            "block delete decides if tool {tool} is in the spindle, so the tool is at the end of the skipped blocks or at the change position"
        )),
        false => Ok(()),
    }
}

/// Goes to the change position and changes the tool, between the user's blocks; then
/// prepares the next tool.
///
/// # Errors
/// As [`tool::prepare`], `change_tool` of the family and a rapid motion; a block of the user
/// that the tape refuses.
pub fn change(post: &mut Post, mut wanted: ToolChange) -> Result<()> {
    let control = &mut post.control;
    control.family().take_own_offset(control, &mut wanted)?;
    refuse_change_by_switch(control, wanted.tool)?;
    match tool::prepare(control, &wanted)? {
        Changes::Tool => {}
        Changes::Offset => return change_offset(control, wanted),
        Changes::Nothing => return way_home::write_held(control),
    }
    turned_apart::warn_of_length(control);
    leave_part(post)?;
    let control = &mut post.control;
    tip_control::end(control)?;
    frame::end(control)?;
    let around = around(control, &wanted);
    let is_first = control.tools.changes == 0;
    control.tools.changes += 1;
    control.tools.prepared = None;
    control.tools.loaded = Some(wanted.tool);
    if !wanted.by_hand {
        control.tools.first.get_or_insert(wanted.tool);
    }
    let cause = wanted.causes[0].whole();
    user_texts::write(control, around[0])?;
    control.because(cause, |control| {
        way_home::switch_off_for_change(control, wanted.by_hand, is_first)?;
        control.tip.is_away |= go_to_change_position(control, cause)? || !wanted.by_hand;
        match (wanted.by_hand, is_first) {
            (true, _) => way_home::stop_for_operator(control, wanted.tool),
            (false, true) => Ok(()),
            (false, false) => way_home::stop_at_change(control),
        }
    })?;
    way_home::write_held(control)?;
    control.tape.align();
    control.family().change_tool(control, wanted)?;
    user_texts::write(control, around[1])?;
    prepare_next(control, &wanted)?;
    control.because(cause, way_home::restate)
}

/// Takes another offset for the tool in the spindle, where it is.
///
/// # Errors
/// As `change_offset` of the family.
fn change_offset(control: &mut Control, wanted: ToolChange) -> Result<()> {
    tip_control::end(control)?;
    frame::end(control)?;
    way_home::write_held(control)?;
    control.family().change_offset(control, wanted)
}

/// Names the tool that comes next, behind the last change the first one where the machine wants it.
fn prepare_next(control: &mut Control, wanted: &ToolChange) -> Result<()> {
    let first = control
        .tools
        .first
        .filter(|first| *first != wanted.tool && control.commons.read(loc::TOOL_PRESELECT_FIRST));
    let next = match wanted.next {
        NextTools::Some { by_hand: true, .. } | NextTools::Unknown => None,
        NextTools::Some { other: Some(next), .. } => Some(next),
        NextTools::Some { other: None, .. } | NextTools::None => first,
    };
    let Some(next) = next.filter(|_| control.commons.read(loc::TOOL_PRESELECT)) else {
        return Ok(());
    };
    // The number is a word of a later record.
    let cause = control.block.cause.whole();
    control.because(cause, |control| control.family().write(control, Operation::SelectTool(next)))
}

/// Leaves the part along a tool that a head leans, where the machine has a change position of Z.
///
/// # Errors
/// How far up along it that lies is not known.
fn leave_part(post: &mut Post) -> Result<()> {
    let commons = &post.control.commons;
    let Some(level) = commons.dbl_opt(loc::CHANGE_POSITION[2]) else { return Ok(()) };
    if commons.read(loc::TOOL_CHANGE_BLOCK) == ToolChangeBlock::None {
        return Ok(());
    }
    if machine_frame::is_meant(&post.control) {
        if post.path.point.is_some() {
            rapid_lean::warn_straight_up(&mut post.control);
        }
        return Ok(());
    }
    tip_control::settle_level(post)?;
    frame_end::go_up_to(post, level)
}

/// The lists of blocks before and after this change: the first, one between or the last.
fn around(control: &mut Control, wanted: &ToolChange) -> [UserBlocks; 2] {
    let last = user_blocks::LAST_CHANGE;
    let has_last = last.before.is_on(&control.commons) || last.after.is_on(&control.commons);
    if has_last && control.tools.changes > 0 && wanted.next == NextTools::Unknown {
        let message = "the blocks of the last tool change: whether a tool change is the last one \
                       can't be seen in a CL file that can't be read ahead";
        control.warnings.add(PostCode::IgnoredPart, message.to_string());
    }
    let is_last = match wanted.next {
        NextTools::None => true,
        NextTools::Some { other, .. } => control.commons.read(loc::TOOL_MODAL) && other.is_none(),
        NextTools::Unknown => false,
    };
    let own = match (control.tools.changes, is_last) {
        (0, _) => user_blocks::FIRST_CHANGE,
        (_, true) => last,
        (_, false) => user_blocks::OTHER_CHANGE,
    };
    let Around { before, after } = user_blocks::OTHER_CHANGE;
    [(own.before, before), (own.after, after)]
        .map(|(own, other)| if own.is_on(&control.commons) { own } else { other })
}

/// Goes to the machine's change position before the change (INTCOM 1872,
/// DBLCOM 604–609); coordinates that are absent stay where they are. True where Z goes there.
fn go_to_change_position(control: &mut Control, cause: Cause) -> Result<bool> {
    let axes = match control.commons.read(loc::TOOL_CHANGE_BLOCK) {
        ToolChangeBlock::None => return Ok(false),
        ToolChangeBlock::Xyz => &loc::CHANGE_POSITION[..3],
        ToolChangeBlock::XyzAndRotary => &loc::CHANGE_POSITION[..],
    };
    let mut position = Position::default();
    let mut moving = AxisSet::NONE;
    for (common, location) in axes.iter().enumerate() {
        let Some(value) = control.commons.dbl_opt(*location) else { continue };
        if let Some(number) = control.tables.axis_of_common(common) {
            position[number] = value;
            moving = moving.or(AxisSet::of(number));
        }
    }
    let motion = Motion::new(position, moving, 0);
    if machine_frame::is_meant(control) {
        machine_frame::go(control, &motion, Before::ToolChange, cause)?;
    } else {
        control.tables.check_travel(&position, moving)?;
        rapid::to_machine_position(control, &motion, cause)?;
    }
    Ok(moving.has(2))
}
