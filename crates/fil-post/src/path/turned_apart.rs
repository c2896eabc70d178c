//! Positions of the axes of a turned machine hold for one tool and for one zero: the distance
//! from the pivot of a head to the tip, and from the zero of the part to the axis of a table, are
//! stated once.

use fil_diag::Result;
use fil_machine::axis_chain::Carries;
use fil_machine::locations as loc;

use super::{Transformation, frame, rapid_lean};
use crate::control::Control;
use crate::control_state::{WorkOffset, modal};
use crate::errors::PostCode;
use crate::post::Post;
use fil_machine::modes::Plane;

/// A smaller turn of a rotary axis counts as none, degrees.
const STILL: f64 = 1e-9;

/// Takes the tool and the zero with which the machine is turned first, and refuses positions of a
/// turned machine for another tool, or another zero, than those.
///
/// # Errors
/// A head leans with a second tool; a table stands turned under a second work offset.
#[inline]
pub(super) fn settle(post: &mut Post, angles: [f64; 2]) -> Result<()> {
    if angles == [0.0; 2] { Ok(()) } else { settle_turned(post, angles) }
}

fn settle_turned(post: &mut Post, angles: [f64; 2]) -> Result<()> {
    let control = &post.control;
    let chain = control.tables.chain();
    let turned = |carries: Carries| {
        chain.rotaries.iter().zip(angles).any(|(rotary, angle)| {
            let turn = angle - 360.0 * (angle / 360.0).round();
            rotary.as_ref().is_some_and(|it| it.carries == carries) && turn.abs() > STILL
        })
    };
    let by_head = chain.pivot.is_some() && turned(Carries::Head);
    let by_table = turned(Carries::Table);
    if by_head
        && !control.commons.read(loc::TOOL_IGNORE_LENGTH)
        && settle_tool(&mut post.path.turning.turned_with.tool, control.state.get(modal::TOOL))
    {
        return PostCode::TurnedApart.err_with(
            "the head tilts a second tool, but rotary.pivot_distance is for the first",
            "Post with TCPC or tilted work planes, or make one program for each tool; set tool.ignore_length = 1 if all tools have the same length.",
        );
    }
    if by_head && !post.path.turning.turned_with.lies_across {
        warn_of_length_across(post, angles);
    }
    // Points that are those of the machine hold wherever the axis of the table lies.
    let points_stay = post.path.transformation.as_ref().is_some_and(Transformation::undoes_tables);
    if by_table && !points_stay {
        let zero = zero(&post.control);
        let with = &mut post.path.turning.turned_with;
        if with.zero.is_some() && zero.is_some() && with.zero != zero {
            return PostCode::TurnedApart.err_with(
                "a table is rotated under a second work offset, but the settings give its axis from the first",
                "Post with TCPC or tilted work planes, or make one program for each work offset.",
            );
        }
        with.zero = zero.or(with.zero);
    }
    Ok(())
}

/// Takes the tool for which levels of the machine's Z are counted first while a head leans it, and
/// refuses one for another: how high the tool stands, and with it how far up along it the level lies, is counted with
/// `rotary.pivot_distance`.
///
/// # Errors
/// Such a tool.
pub(super) fn settle_level(post: &mut Post) -> Result<()> {
    let control = &post.control;
    let chain = control.tables.chain();
    let leans = |angles: [f64; 2]| frame::leans(chain, angles);
    let has_pivot = chain.pivot.is_some() && !control.commons.read(loc::TOOL_IGNORE_LENGTH);
    if !has_pivot || !rapid_lean::turned(control).is_some_and(leans) {
        return Ok(());
    }
    if settle_tool(
        &mut post.path.turning.turned_with.tool_of_levels,
        control.state.get(modal::TOOL),
    ) {
        return PostCode::TurnedApart.err_with(
            "a retract in machine Z while the head tilts a second tool: its length along the tool depends on rotary.pivot_distance, which is for the first",
            "Turn the tool upright before it with RAPID and GOTO, or set home.frame = 1; set tool.ignore_length = 1 if all tools have the same length.",
        );
    }
    Ok(())
}

/// Keeps the first tool that is known, and says whether this is another one; one that is not known
/// may be any.
fn settle_tool(first: &mut Option<i64>, tool: Option<i64>) -> bool {
    let is_other = first.is_some() && tool.is_some() && *first != tool;
    *first = first.or(tool);
    is_other
}

/// Warns where a head turns the tool across Z, along which the control counts its length.
fn warn_of_length_across(post: &mut Post, angles: [f64; 2]) {
    let control = &mut post.control;
    let tool = control.tables.chain().tool_at(angles);
    let has_tool = control.state.get(modal::TOOL).is_some();
    if has_tool && tool.z < rapid_lean::LEAST_RISE && counts_length(control) {
        say_length_lies_across(control);
        post.path.turning.turned_with.lies_across = true;
    }
}

/// The work offset in force; before the program has said one, the first that the machine has.
fn zero(control: &Control) -> Option<WorkOffset> {
    let is_unsaid = !control.state.has_doubts();
    let first =
        || control.code_if_any(loc::FIXTURE_MIN_CODE).filter(|_| is_unsaid).map(WorkOffset::plain);
    control.state.get(modal::WORK_OFFSET).or_else(first)
}

/// The control counts the length of the tool along an axis that the tool does not lie along where
/// all heads stand at zero, or may lean away from.
fn counts_length(control: &Control) -> bool {
    let chain = control.tables.chain();
    if control.can().length_functions {
        let calls = control.commons.read(loc::TOOL_LENGTH_FROM_TOOL);
        return calls && control.code_if_any(loc::TOOL_LENGTH_CODE).is_some();
    }
    let along = |plane: Plane| chain.tool[plane.normal()] >= 1.0 - PARALLEL;
    !control.can().lengths_by_plane
        || chain.has_heads()
        || control.state.get(modal::PLANE).is_none_or(|plane| !along(plane))
}

/// Warns of a length that the control counts across the tool.
fn say_length_lies_across(control: &mut Control) {
    let message = "the control applies the tool length offset along Z, but the tool lies across it";
    control.warnings.add(PostCode::LengthAcross, message.to_string());
}

/// Directions are one where the cosine between them is less than this below 1.
const PARALLEL: f64 = 1e-9;

/// Warns of a tool that lies across Z on a control that counts its length along Z, and that no
/// head turns upright.
pub(super) fn warn_of_length(control: &mut Control) {
    let chain = control.tables.chain();
    if chain.has_heads() || chain.tool.z > 1.0 - PARALLEL || !counts_length(control) {
        return;
    }
    say_length_lies_across(control);
}
