//! Holes of live tools by the cycles of a lathe's control: G83 and G84 along Z, G87 and G88
//! along X.
//!
//! The tool stands on the R level before the block, so that R is 0: controls differ in
//! whether it is a radius there, and the level that they return to is the same one. Pecks
//! stay single moves unless the machine file says what the control's parameters make of Q.

use fil_diag::Result;
use fil_machine::FunctionCode;
use fil_machine::locations::{self as loc, MillTurnPeckForm, MillTurnSidePeck};
use fil_machine::modes::FeedMode;
use fil_machine::setting::CodeAt;

use crate::control::Control;
use crate::control::sinumerik::live_tap;
use crate::control::tap;
use crate::control::word_address::cycle as words;
use crate::control_state::Rotation;
use crate::errors::PostCode;
use crate::operation::Feed;
use crate::operation::cycle::{Cycle, CycleFeed, CycleKind, Hole};
use crate::operation::motion::Motion;
use crate::path::{expand, rapid};

/// The code of a hole of a live tool; `None` where the machine has none, or the hole is
/// none of the kinds that it drills.
pub fn code(control: &Control, cycle: &Cycle, hole: &Hole) -> Option<FunctionCode> {
    if !control.tables.mills() {
        return None;
    }
    let at = match (cycle.kind, hole.along) {
        (CycleKind::Tap, along) => {
            let [right, left] = taps(along)?;
            let turns_left = control.state.rotation() == Rotation::Counterclockwise;
            return control.code_if_any(left).filter(|_| turns_left).or(control.code_if_any(right));
        }
        (_, along @ 2) if drills(control, cycle, along) => loc::MILL_TURN_FACE_DRILL_CODE,
        (_, along @ 0) if drills(control, cycle, along) => loc::MILL_TURN_SIDE_DRILL_CODE,
        _ => return None,
    };
    control.code_if_any(at)
}

/// The codes of right-hand and left-hand taps along an axis.
fn taps(along: usize) -> Option<[CodeAt; 2]> {
    match along {
        2 => Some([loc::MILL_TURN_FACE_TAP_CODE, loc::MILL_TURN_FACE_TAP_LEFT_CODE]),
        0 => Some([loc::MILL_TURN_SIDE_TAP_CODE, loc::MILL_TURN_SIDE_TAP_LEFT_CODE]),
        _ => None,
    }
}

/// In one go to the bottom, or in pecks as the control makes them, and out at rapid.
fn drills(control: &Control, cycle: &Cycle, along: usize) -> bool {
    use CycleKind::{Brkchp, Csink, Deep, Drill, Face, Thru};
    if cycle.step.is_none() {
        return matches!(cycle.kind, Drill | Csink | Face | Thru);
    }
    let counts = along == 2
        || control.commons.read(loc::MILL_TURN_SIDE_PECK) != MillTurnSidePeck::SingleMoves;
    counts
        && match control.commons.read(loc::MILL_TURN_PECK_FORM) {
            MillTurnPeckForm::SingleMoves => false,
            MillTurnPeckForm::OutOfTheHole => cycle.kind == Deep,
            MillTurnPeckForm::ChipBreaking => cycle.kind == Brkchp,
        }
}

/// Drills or taps a hole.
///
/// # Errors
/// A tap whose live tool does not turn the way of its cycle, or whose lead is not known; a
/// value that does not fit its address.
pub fn drill(
    control: &mut Control,
    cycle: &Cycle,
    at: &Motion,
    hole: &Hole,
    code: FunctionCode,
) -> Result<()> {
    let feed = match cycle.kind {
        CycleKind::Tap => feed_of_tap(control, cycle, hole.along)?,
        _ => match cycle.feed {
            CycleFeed::Feed(feed) => feed,
            CycleFeed::Lead(_) => {
                return PostCode::CycleForm.err("a lead of a hole that is no tap");
            }
        },
    };
    from_its_level(control, cycle, at, hole, |control| {
        words::live_hole(control, cycle, &feed, hole, code)?;
        words::cancel(control)
    })
}

/// Taps a hole on a SINUMERIK.
///
/// # Errors
/// As [`live_tap::tap`].
pub fn tap_in_step(control: &mut Control, cycle: &Cycle, at: &Motion, hole: &Hole) -> Result<()> {
    from_its_level(control, cycle, at, hole, |control| live_tap::tap(control, cycle, hole))
}

/// Brings the tool over a hole and down to its R level, where the control makes the hole and comes
/// back to, and up from there.
fn from_its_level(
    control: &mut Control,
    cycle: &Cycle,
    at: &Motion,
    hole: &Hole,
    make: impl FnOnce(&mut Control) -> Result<()>,
) -> Result<()> {
    let across = at.of(expand::without(hole.along));
    rapid::rapid(control, &across, control.block.cause)?;
    control.because(cycle.cause, |control| {
        let cause = control.block.cause;
        rapid::rapid(control, &Motion::along(hole.along, hole.clear), cause)?;
        control.flush_waiting()?;
        make(control)?;
        words::stands_at(control, hole.along, hole.clear)?;
        rapid::rapid(control, &Motion::along(hole.along, hole.rest()), cause)
    })
}

/// The lead of a tap times the turns of the live tool.
fn feed_of_tap(control: &mut Control, cycle: &Cycle, along: usize) -> Result<Feed> {
    let has_left = taps(along).is_some_and(|[_, left]| control.code_if_any(left).is_some());
    match control.state.rotation() {
        Rotation::Clockwise => {}
        Rotation::Standing | Rotation::Unsaid => {
            return PostCode::CycleForm
                .err("a tap while the live tool is stopped; put SPINDL before it");
        }
        Rotation::Counterclockwise if has_left => {}
        Rotation::Counterclockwise => {
            return PostCode::NoCode.err(
                "the live tool turns counterclockwise, and the machine has no cycle of live \
                 tools for left-hand threads",
            );
        }
        Rotation::InDoubt => {
            return PostCode::NoCode.err(
                "the direction of the live tool is not known here; put SPINDL before the tap",
            );
        }
    }
    let cause = match cycle.feed {
        CycleFeed::Lead(lead) => lead.cause,
        CycleFeed::Feed(feed) => feed.cause,
    };
    let value = tap::a_minute(control, cycle)?;
    Ok(Feed { value, asked: value, mode: FeedMode::PerMinute, cause })
}
