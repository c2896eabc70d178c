//! The modes an operation depends on: said again where the control is not known
//! to be in them.

use fil_diag::Result;
use fil_machine::locations as loc;
use fil_machine::modes::{Plane, Unit};
use fil_machine::{FunctionCode, Letter};

use crate::control::needs::Act;
use crate::control::program::{plane_code, unit_code};
use crate::control::{Control, Function, length_plane};
use crate::control_state::modal::{self, Group, GroupSet};
use crate::control_state::{Compensation, Distance, Meaning, Source, functions};
use crate::errors::PostCode;

/// The modes that an operation brings itself, or goes on in.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Own {
    /// None of them.
    Nothing,
    /// The plane.
    Plane,
    /// The plane, and the cycle that the control is in.
    PlaneAndCycle,
}

impl Own {
    fn has_plane(self) -> bool {
        self != Own::Nothing
    }

    fn has_cycle(self) -> bool {
        self == Own::PlaneAndCycle
    }

    /// The groups that must be as motions usually need them.
    #[inline]
    fn usual(self) -> GroupSet {
        const BARE: GroupSet = GroupSet::of(&[Group::Distance, Group::DiameterMode]);
        const IN_PLANE: GroupSet = BARE.and(Group::Cycle);
        const ALL: GroupSet = IN_PLANE.and(Group::PlaneIsTemporary);
        match self {
            Own::Nothing => ALL,
            Own::Plane => IN_PLANE,
            Own::PlaneAndCycle => BARE,
        }
    }
}

/// Brings the control into the modes that motions of the post count on, but for those that the
/// operation brings itself: unit, absolute coordinates, the usual plane, no cycle, no compensation
/// but the one asked for.
///
/// # Errors
/// The machine has no code for a mode the control is known not to be in; cutter
/// compensation that can't be said again in its middle.
#[inline]
pub fn require(control: &mut Control, unit: Unit, own: Own) -> Result<()> {
    control.require_motion()?;
    let state = &control.state;
    let stands = state.groups().are_usual(own.usual())
        && state.is(modal::UNITS, unit)
        && state.get(modal::CUTTER_COMP).is_some()
        && !length_plane::is_left(control);
    if stands { Ok(()) } else { say_again(control, unit, own) }
}

#[cold]
fn say_again(control: &mut Control, unit: Unit, own: Own) -> Result<()> {
    let waiting = control.block.take();
    let mut missing = Vec::new();
    let in_cycle = !own.has_cycle() && !control.state.is(modal::CYCLE, false);
    if in_cycle && control.can().cycle_calls {
        control.family().leave_cycle(control)?;
    } else if in_cycle && !say(control, control.code_if_any(loc::CYCLE_OFF_CODE)) {
        control.state.set(modal::CYCLE, false);
    }
    if !control.state.is(modal::DIAMETER_MODE, true) {
        say_what_x_is(control)?;
    }
    if !control.state.is(modal::UNITS, unit) {
        let wrong = control.state.get(modal::UNITS).is_some();
        if !say_unit(control, unit) && wrong {
            missing.push("the unit");
        }
    }
    if !control.state.is(modal::DISTANCE, Distance::Absolute) {
        let wrong = control.state.get(modal::DISTANCE).is_some();
        if !say(control, absolute_code(control)) && wrong {
            missing.push("absolute coordinates");
        }
        control.state.set(modal::DISTANCE, Distance::Absolute);
    }
    if control.state.get(modal::CUTTER_COMP).is_none() {
        let begun = !control.waiting.has(Function::Compensation);
        if begun && control.compensation_asked() != Compensation::Off {
            let diag = PostCode::CompensationLost
                .diag("an unreadable foreign block during cutter compensation");
            control.doubt(Source::Author, diag, "taken to be as CUTCOM has it")?;
            control.state.set(modal::CUTTER_COMP, control.compensation_asked());
        } else {
            say(control, control.code_if_any(loc::CUTCOM_OFF_CODE));
            control.state.set(modal::CUTTER_COMP, Compensation::Off);
        }
    }
    if let Some(what) = missing.first() {
        return PostCode::NoCode.err(format!("the machine has no code that brings {what} back"));
    }
    control.write_block()?;
    if !own.has_plane() {
        leave_plane_of_its_own(control)?;
    }
    take_back(control)?;
    control.block = waiting;
    Ok(())
}

/// Says the usual plane again behind a hole cycle or an arc that needed another one: whoever comes
/// next, a tool or a text too, counts on it.
///
/// # Errors
/// As [`plane_of_its_own`].
pub fn leave_plane_of_its_own(control: &mut Control) -> Result<()> {
    if !control.state.may_be(modal::PLANE_IS_TEMPORARY, true)
        || !control.state.is(modal::CYCLE, false)
    {
        return Ok(());
    }
    plane_of_turning(control)
}

/// Takes a SINUMERIK back to the plane that its program begins in: the plane says along which axes
/// the lengths of a tool count (Siemens, Programming Manual Fundamentals), so that no tool may be
/// left in that of a transformation or a cycle.
///
/// # Errors
/// As [`plane_of_its_own`].
pub fn plane_of_turning(control: &mut Control) -> Result<()> {
    plane_of_its_own(control, length_plane::usual_plane(control))
}

/// Says again that X is a diameter, on a control that counts radii too, and on a SINUMERIK the
/// plane in which a lathe turns.
fn say_what_x_is(control: &mut Control) -> Result<()> {
    control.state.set(modal::DIAMETER_MODE, true);
    if control.family().says_diameters(control)? {
        if control.commons.read(loc::LATHE_DIAMETER) {
            // The lengths of a tool count along the axes of its plane.
            let usual = length_plane::usual_plane(control);
            let plane = if control.tables.is_polar() { Plane::Xy } else { usual };
            say(control, control.code_if_any(plane_code(plane)));
        }
        return Ok(());
    }
    say(control, control.code_if_any(loc::LATHE_DIAMETER_CODE));
    Ok(())
}

/// Says the unit alone, before words that are no motion of the post: the other modes are the author's.
///
/// # Errors
/// As a line on the tape.
pub fn take_unit(control: &mut Control, unit: Unit) -> Result<()> {
    match say_unit(control, unit) {
        true => control.write_block(),
        false => Ok(()),
    }
}

/// Adds the code of the unit, which is in force from here on; says whether there is one.
fn say_unit(control: &mut Control, unit: Unit) -> bool {
    let is_said = say(control, control.code_if_any(unit_code(unit)));
    control.state.set(modal::UNITS, unit);
    is_said
}

/// Adds a code; says whether there is one.
fn say(control: &mut Control, code: Option<FunctionCode>) -> bool {
    if let Some(code) = code {
        control.g_of_record(code);
    }
    code.is_some()
}

/// The code of absolute coordinates; `None` on a machine without it.
fn absolute_code(control: &Control) -> Option<FunctionCode> {
    let at_start = control.code_if_any(loc::MODE_POSITION);
    at_start.and(control.code_if_any(loc::MODE_ABSOLUTE_CODE))
}

/// Adds a plane selection unless the control is in it.
///
/// # Errors
/// The machine has no code for the plane; cutter compensation that is on.
pub fn plane(control: &mut Control, plane: Plane) -> Result<()> {
    if !control.state.is(modal::PLANE, plane) {
        if control.state.get(modal::PLANE).is_some() {
            control.ready_for(Act::Plane)?;
        }
        let code = control.code(plane_code(plane), "this plane")?;
        control.g(code);
    }
    Ok(())
}

/// The same for an arc, which may change the plane within cutter compensation where the
/// machine says so.
///
/// # Errors
/// As [`plane`].
pub fn plane_of_arc(control: &mut Control, wanted: Plane, may_change: bool) -> Result<()> {
    if may_change && !control.state.is(modal::PLANE, wanted) {
        let code = control.code(plane_code(wanted), "this plane")?;
        control.g(code);
        return Ok(());
    }
    plane(control, wanted)
}

/// Writes a plane selection in a block of its own unless the control is in it; a
/// machine without planes has only one.
///
/// # Errors
/// The control is in another plane and has no code for this one.
pub fn plane_of_its_own(control: &mut Control, wanted: Plane) -> Result<()> {
    control.begin()?;
    control.state.set(modal::PLANE_IS_TEMPORARY, false);
    if control.state.is(modal::PLANE, wanted) {
        return Ok(());
    }
    let has_code = control.code_if_any(plane_code(wanted)).is_some();
    if control.state.get(modal::PLANE).is_none() && !has_code {
        return Ok(());
    }
    let waiting = control.block.take();
    plane(control, wanted)?;
    control.write_block()?;
    control.block = waiting;
    Ok(())
}

/// Says the plane that motions need, where another one may be in force.
///
/// # Errors
/// As [`plane_of_its_own`].
pub fn take_back(control: &mut Control) -> Result<()> {
    take(control, length_plane::of_motions(control))
}

fn take(control: &mut Control, plane: Option<Plane>) -> Result<()> {
    match plane {
        Some(plane) if length_plane::may_be_another(control, plane) => {
            plane_of_its_own(control, plane)
        }
        _ => Ok(()),
    }
}

/// Says the plane in which a length is taken up along the tool, on a mill that names it by a
/// function: before the tool is changed, and before that function where another plane has come in
/// between.
///
/// # Errors
/// As [`plane_of_its_own`].
pub fn before_length(control: &mut Control) -> Result<()> {
    take(control, length_plane::of_length(control))
}

/// The same before the words of others that take up a length and say no plane.
///
/// # Errors
/// As [`plane_of_its_own`].
pub fn before_others(control: &mut Control, words: &[(Letter, f64)]) -> Result<()> {
    if !length_plane::of_length(control)
        .is_some_and(|plane| length_plane::may_be_another(control, plane))
    {
        return Ok(());
    }
    let codes = || functions(words);
    let says_plane = codes().any(|code| matches!(control.meaning(code), Meaning::Plane(_)));
    if !says_plane && codes().any(|code| control.calls_length(code)) {
        return before_length(control);
    }
    Ok(())
}
