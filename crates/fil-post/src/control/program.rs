//! Start and end of the NC program.
//!
//! Start: tape start character, program number, the user's start blocks, the
//! mode codes (units, absolute, feed mode, plane). End: the user's end blocks,
//! the end code, tape end character.

mod head;

use fil_diag::Result;
use fil_machine::commons::Dbl;
use fil_machine::locations::{self as loc, ToolFormat};
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::setting::{CharacterAt, CodeAt};
use fil_machine::{Commons, FunctionCode, osp_lengths, user_blocks};

use super::{Control, family, user_texts};
use crate::cause::Cause;
use crate::control::needs::Act;
use crate::control_state::{ControlState, Distance, Source, modal};
use crate::errors::PostCode;
pub use head::{ProgramHead, notes};
use head::{part_name, program_number, time_stamp};

/// Most characters of a leader.
const LONGEST_LEADER: usize = 10_000;

/// Ends the length offset of a tool (G49).
const LENGTH_OFF: FunctionCode = FunctionCode::whole(49);

/// Modes that the program says at its start, and those the control has anyway.
const START_MODES: [(CodeAt, CodeAt); 3] = [
    (loc::MODE_POSITION, loc::MODE_POSITION_IN_FORCE),
    (loc::FEED_MODE, loc::FEED_MODE_IN_FORCE),
    (loc::CIRCLE_PLANE, loc::CIRCLE_PLANE_IN_FORCE),
];

/// What the control is taken to be in before the program says anything.
pub fn state_at_start(commons: &Commons, unit: Option<Unit>) -> ControlState {
    let starts_with = commons.read(loc::FEED_MODE);
    let per_revolution = commons.read(loc::FEED_UPR_CODE);
    let feed_mode = match starts_with {
        Some(_) if starts_with == per_revolution => FeedMode::PerRevolution,
        _ => FeedMode::PerMinute,
    };
    let code = plane_at_start(commons);
    let plane = code.and_then(|code| {
        Plane::ALL.into_iter().find(|plane| commons.read(plane_code(*plane)) == Some(code))
    });
    ControlState::at_start(feed_mode, plane, unit)
}

/// The code of the plane that a program says at its start. A lathe turns in that of Z and X,
/// whatever its file has kept from a mill: cutter compensation in another one takes the nose of
/// the tool along axes that the path does not have.
fn plane_at_start(commons: &Commons) -> Option<i32> {
    let said = commons.read(loc::CIRCLE_PLANE);
    let of_turning = commons.read(loc::CIRCLE_PLANE_ZX);
    said.map(|code| match of_turning {
        Some(of_turning) if commons.read(loc::LATHE_DIAMETER) => of_turning,
        _ => code,
    })
}

/// Location of the code of a plane.
pub fn plane_code(plane: Plane) -> CodeAt {
    match plane {
        Plane::Xy => loc::CIRCLE_PLANE_XY,
        Plane::Zx => loc::CIRCLE_PLANE_ZX,
        Plane::Yz => loc::CIRCLE_PLANE_YZ,
    }
}

/// Location of the code of a unit.
pub fn unit_code(unit: Unit) -> CodeAt {
    match unit {
        Unit::Mm => loc::UNITS_METRIC_CODE,
        Unit::Inch => loc::UNITS_INCH_CODE,
    }
}

/// Writes the start of the program, once, before the first block; the block under
/// construction waits.
///
/// # Errors
/// A program number that does not fit its address.
pub fn start(control: &mut Control) -> Result<()> {
    control.head.started = true;
    let block = control.block.take();
    control.refresh()?;
    control.because(Cause::default(), write_start)?;
    control.block = block;
    Ok(())
}

/// The blocks at the start; the machine's settings ask for them.
fn write_start(control: &mut Control) -> Result<()> {
    let blocks = user_texts::texts(control, user_blocks::START)?;
    let own_start = !blocks.is_empty();
    // Texts that say no unit leave a machine of both units in any.
    let of_both = control.commons.read(loc::UNITS_MODE) == loc::UnitsMode::AsTheClFile;
    let safe_start = control.commons.read(loc::PROGRAM_SAFE_START);
    let unit = control.unit.filter(|_| safe_start || !(own_start && of_both));
    control.state = state_at_start(&control.commons, unit);
    if control.family().start(control, &blocks)? {
        return if safe_start { end_planes(control) } else { Ok(()) };
    }
    tape_mark(control, loc::TAPE_START_CODE)?;
    leader(control, loc::TAPE_LEADER)?;
    tape_mark(control, loc::TAPE_START_CHAR)?;
    control.family().head(control)?;
    part_name(control)?;
    program_number(control)?;
    time_stamp(control)?;
    notes(control)?;
    if !own_start || safe_start {
        refuse_a_unit_without_code(control)?;
        if safe_start {
            safe_start_blocks(control)?
        } else {
            mode_codes(control)
        }
        control.write_block()?;
        if safe_start {
            end_planes(control)?;
        }
    }
    let at_start = Modes::of(control);
    let says_no_modes = own_start && !safe_start;
    if says_no_modes && control.commons.read(loc::LATHE_DIAMETER) {
        Modes::UNSAID.put(control);
    }
    for block in blocks {
        control.write_text(&block, true)?;
    }
    if says_no_modes {
        say_what_is_unsaid(control, at_start);
        say_diameters(control);
    }
    control.write_block()?;
    control.family().begin_diameters(control)
}

/// Writes the end of the program.
///
/// # Errors
/// Cutter compensation that is still on; a code that does not fit its address.
pub fn end(control: &mut Control, code: Option<FunctionCode>) -> Result<()> {
    finish(control)?;
    user_texts::write(control, user_blocks::END)?;
    // The blocks of the machine may end it themselves.
    if !control.state.is(modal::PROGRAM_END, true) {
        control.family().before_end(control)?;
        end_code(control, code)?;
    }
    close(control)
}

/// Writes an author's code that ends the program; subprograms may follow it.
///
/// # Errors
/// As [`end`].
pub fn end_by(control: &mut Control, code: FunctionCode) -> Result<()> {
    finish(control)?;
    end_code(control, Some(code))
}

fn end_code(control: &mut Control, code: Option<FunctionCode>) -> Result<()> {
    control.ready_for(Act::ProgramEnd)?;
    if let Some(code) = code {
        control.m(code);
    }
    control.write_block()?;
    control.state.set(modal::PROGRAM_END, true);
    Ok(())
}

/// Warns of a program for a tool changer in which nobody has called a tool or its length offset.
fn warn_without_tool(control: &mut Control) {
    let groups = control.state.groups();
    let by_nobody = groups.know(modal::TOOL).is_not_commanded()
        && groups.know(modal::NAMED_TOOL).is_not_commanded()
        && groups.know(modal::LENGTH_OFFSET).is_not_commanded();
    let changes_tools = control.commons.read(loc::PROGRAM_TOOL_LIST)
        && control.code_if_any(loc::TOOL_CHANGE_CODE).is_some();
    if changes_tools && by_nobody {
        control.warnings.add(PostCode::NoTool, "there is no LOADTL".to_string());
    }
}

/// Ends what goes on over several blocks.
fn finish(control: &mut Control) -> Result<()> {
    control.begin()?;
    warn_without_tool(control);
    super::word_address::cycle::cancel(control)?;
    let may_drill = control.state.was_in_cycle();
    control.skip_blocks(false)?;
    control.flush_waiting()?;
    if may_drill {
        control.family().leave_cycle(control)?;
    }
    Ok(())
}

/// Closes the tape of a program that a text, POSTN or AUXFUN has ended; warns of end
/// blocks that the machine wants before its end.
///
/// # Errors
/// As a line on the tape.
pub fn close_ended(control: &mut Control) -> Result<()> {
    if control.head.closed {
        return Ok(());
    }
    if !user_blocks::END.read(&control.commons).is_empty() {
        let message = "the end blocks of the machine: the program was ended before them";
        control.warnings.add(PostCode::IgnoredPart, message.to_string());
    }
    close(control)
}

fn close(control: &mut Control) -> Result<()> {
    control.head.closed = true;
    control.end_replacing();
    if control.family().close(control)? {
        return Ok(());
    }
    control.because(Cause::default(), |control| {
        tape_mark(control, loc::TAPE_END_CHAR)?;
        leader(control, loc::TAPE_TRAILER)
    })
}

/// Refuses a program whose unit the control can't be told, where it can be told the other.
///
/// # Errors
/// The machine takes the unit of the CL file, and has a code for the other unit alone.
fn refuse_a_unit_without_code(control: &Control) -> Result<()> {
    let Some(unit) = control.unit else { return Ok(()) };
    let (other, name) = match unit {
        Unit::Mm => (Unit::Inch, "millimetres"),
        Unit::Inch => (Unit::Mm, "inches"),
    };
    let takes_both = control.commons.read(loc::UNITS_MODE) == loc::UnitsMode::AsTheClFile;
    let has = |unit| control.code_if_any(unit_code(unit)).is_some();
    if !takes_both || has(unit) || !has(other) {
        return Ok(());
    }
    PostCode::NoCode
        .err(format!("the machine has a code for the other unit, and none for {name} (units.mode)"))
}

/// Adds the mode codes a control must be in. A machine with start blocks of
/// its own says them there; what they leave open is taken from the settings.
fn mode_codes(control: &mut Control) {
    let in_force = control.code_if_any(loc::UNITS_IN_FORCE);
    let unit = control.unit.and_then(|unit| control.code_if_any(unit_code(unit)));
    if let Some(code) = unit.filter(|code| in_force != Some(*code)) {
        control.g(code);
    }
    say_diameters(control);
    START_MODES.into_iter().for_each(|mode| say_mode(control, mode));
}

/// Writes the modes with the ends of what an interrupted program has left in force, then the unit.
///
/// # Errors
/// As a block on the tape.
fn safe_start_blocks(control: &mut Control) -> Result<()> {
    START_MODES.into_iter().for_each(|mode| say_mode(control, mode));
    let by_functions = control.can().length_functions;
    let calls = control.code_if_any(loc::TOOL_LENGTH_CODE).is_some_and(|_| by_functions);
    let one_word = control.commons.read(loc::TOOL_FORMAT) != ToolFormat::TWordAndChangeCode;
    let length = calls && !one_word && !osp_lengths::are_meant(&control.commons);
    let ends = [
        control.code_if_any(loc::CUTCOM_OFF_CODE),
        length.then_some(LENGTH_OFF),
        control.code_if_any(loc::CYCLE_OFF_CODE).filter(|_| !control.can().cycle_calls),
    ];
    ends.into_iter().flatten().for_each(|code| control.g(code));
    control.write_block()?;
    let unit = control.unit.and_then(|unit| control.code_if_any(unit_code(unit)));
    if let Some(code) = unit {
        control.g(code);
    }
    say_diameters(control);
    Ok(())
}

/// Ends what an interrupted program may have left active of tool center point control, where G49 does
/// not end it, and of a tilted work plane.
///
/// # Errors
/// As a block on the tape.
pub fn end_planes(control: &mut Control) -> Result<()> {
    if control.tables.tip_output && !control.can().length_functions {
        family::end_tip_control(control)?;
    }
    match control.tables.frame_output {
        true => control.family().end_frame(control),
        false => Ok(()),
    }
}

/// Restates plane, coordinates and feed mode, so that the program can be begun here.
///
/// # Errors
/// As a block on the tape.
pub fn say_modes_again(control: &mut Control) -> Result<()> {
    let [positions, feed, plane] = START_MODES;
    [plane, positions, feed].into_iter().for_each(|mode| say_mode(control, mode));
    control.write_block()
}

/// Adds the code of a mode, but where the control is in it anyway.
fn say_mode(control: &mut Control, (at, in_force): (CodeAt, CodeAt)) {
    let in_force = control.code_if_any(in_force);
    let code = match at {
        loc::CIRCLE_PLANE => plane_at_start(&control.commons).and_then(FunctionCode::of_setting),
        at => control.code_if_any(at),
    };
    if let Some(code) = code.filter(|code| in_force != Some(*code)) {
        control.g(code);
    }
}

/// The modes of [`START_MODES`] that the control is in, as far as they are known.
#[derive(Clone, Copy)]
struct Modes(Option<Distance>, Option<FeedMode>, Option<Plane>);

impl Modes {
    /// Nothing has been said.
    const UNSAID: Modes = Modes(None, None, None);

    fn of(control: &Control) -> Self {
        Modes(
            control.state.get(modal::DISTANCE),
            control.state.get(modal::FEED_MODE),
            control.state.get(modal::PLANE),
        )
    }

    fn put(self, control: &mut Control) {
        let state = &mut control.state;
        state.set_if_known(modal::DISTANCE, self.0, Source::NotCommanded);
        state.set_if_known(modal::FEED_MODE, self.1, Source::NotCommanded);
        state.set_if_known(modal::PLANE, self.2, Source::NotCommanded);
    }
}

/// Adds the codes of modes that start blocks of a lathe do not say. What a control wakes up in
/// is seldom what a lathe turns in: a feed a turn of 0.2 would be one a minute, and arcs in ZX
/// would lie in XY.
fn say_what_is_unsaid(control: &mut Control, at_start: Modes) {
    let state = &control.state;
    // Behind a text that may have changed any mode, each is said where it is needed.
    if state.get(modal::CUTTER_COMP).is_none() || !state.is(modal::DIAMETER_MODE, true) {
        return;
    }
    let said = Modes::of(control);
    let unsaid = [said.0.is_none(), said.1.is_none(), said.2.is_none()];
    Modes(said.0.or(at_start.0), said.1.or(at_start.1), said.2.or(at_start.2)).put(control);
    for (mode, _) in START_MODES.into_iter().zip(unsaid).filter(|(_, unsaid)| *unsaid) {
        say_mode(control, mode);
    }
}

/// Adds the code that makes X a diameter. Start blocks of the machine's own do not stand for it:
/// read as radii, all words of X would be twice as far from the axis as they are meant.
fn say_diameters(control: &mut Control) {
    let by_code = !control.can().diameter_statement;
    let code = control.code_if_any(loc::LATHE_DIAMETER_CODE).filter(|_| by_code);
    if let Some(code) = code {
        control.g(code);
    }
}

/// Writes the leader or the trailer of a tape that is no direct transfer.
fn leader(control: &mut Control, length: Dbl) -> Result<()> {
    let length = control.commons.dbl_opt(length).unwrap_or(0.0) as usize;
    match control.commons.read(loc::TAPE_LEADER_CHAR) {
        Some(mark) if length > 0 && !control.commons.read(loc::TAPE_DNC) => {
            let line = mark.to_string().repeat(length.min(LONGEST_LEADER));
            control.put_line(&line, false).map(|_| ())
        }
        _ => Ok(()),
    }
}

/// Writes the character before or after the program; none in a program for direct
/// transfer (INTCOM 2479).
fn tape_mark(control: &mut Control, at: CharacterAt) -> Result<()> {
    if control.commons.read(loc::TAPE_DNC) {
        return Ok(());
    }
    match control.commons.read(at) {
        Some(mark) => control.put_line(&mark.to_string(), false).map(|_| ()),
        None => Ok(()),
    }
}
