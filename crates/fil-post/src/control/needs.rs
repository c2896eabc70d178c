//! What operations need of the control and of the CL file: one row an operation.
//!
//! An operation asks once, with [`Control::require`] or [`Post::require`](crate::post::Post::require),
//! and is then safe in each of these modes. A new mode that operations must respect is a new
//! subject, and a word in the rows that it matters to.

use fil_diag::Result;

use super::Control;
use crate::control_state::Compensation;
use crate::control_state::modal::{self, Know};
use crate::errors::PostCode;
use crate::operation::Feed;

/// What an operation depends on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// Cutter compensation is off, and CUTCOM asks for none (G40).
    CompensationAsked,
    /// The same, or it ends in the line of the operation itself, which moves.
    CompensationBehind,
    /// Cutter compensation is off on the control, or ends in the next line that moves; CUTCOM may
    /// wait for its motion.
    Compensation,
    /// The same whether or not the blocks of block delete are run.
    CompensationEitherWay,
    /// No CYCLE of the CL file is active.
    Cycle,
    /// No THREAD of the CL file is active.
    Thread,
    /// No CIRCLE waits for the GOTO at its end.
    ArcEnd,
    /// No OP/THREAD waits for its two points.
    ThreadPoints,
    /// No block of block delete is open.
    BlockDelete,
    /// One tool and offset, whether or not the blocks of block delete are run.
    Tool,
    /// The rotary axes are not clamped.
    AxisClamp,
    /// The program has not ended (M2, M30).
    ProgramEnd,
}

/// One need of an operation: what it is about, and the code that refuses the operation without it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Need(pub Subject, pub PostCode);

/// An operation with needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Act {
    /// Any block.
    Block,
    /// A word that is no point of the path.
    Word,
    /// A motion that is no GOTO, such as GOHOME.
    OtherMotion,
    /// TRANS, GODLTA or another word from which points count otherwise.
    OtherPoints,
    /// A motion in the part.
    Motion,
    /// CIRCLE.
    Arc,
    /// A hole of a cycle.
    Hole,
    /// A whole thread, or its passes.
    Thread,
    /// CUTCOM/LEFT or RIGHT.
    Compensation,
    /// Another plane for arcs and compensation.
    Plane,
    /// LOADTL.
    ToolChange,
    /// TOOL CALL of Klartext, for another spindle speed.
    ToolCall,
    /// Another work offset.
    WorkOffset,
    /// A shift of the control's origin by TRANS.
    OriginShift,
    /// TRANS, TRACUT or another word that turns or stretches the path.
    Transformation,
    /// A script sets a scale of an axis.
    Scale,
    /// A move to a machine position (GOHOME, SET/MACH).
    MachinePosition,
    /// The control's own move to a machine position (G53, SUPA, M91).
    MachineFrame,
    /// A rotary axis moves with the tool axis of a point.
    RotaryMove,
    /// ROTABL.
    Table,
    /// A rotary axis at its limit goes round.
    Reposition,
    /// A clamped axis would move.
    ClampedMove,
    /// MODE of a mill-turn machine.
    Mode,
    /// Polar interpolation begins (G12.1).
    PolarOn,
    /// It ends (G13.1).
    PolarOff,
    /// Cylindrical interpolation begins (G7.1).
    CylinderOn,
    /// It ends.
    CylinderOff,
    /// A motion in polar or cylindrical interpolation.
    MillTurnMotion,
    /// A tilted work plane begins (G68.2, CYCLE800, PLANE).
    WorkPlaneOn,
    /// It ends (G69).
    WorkPlaneOff,
    /// Tool center point control begins (G43.4, TRAORI, M128).
    TcpOn,
    /// The sub-spindle becomes the master spindle, or the main spindle again.
    MasterSpindle,
    /// END or FINI.
    ProgramEnd,
}

const NOT_COMPENSATED: Need = Need(Subject::CompensationAsked, PostCode::CompensationOn);
const ENDS_COMPENSATION: Need = Need(Subject::CompensationBehind, PostCode::CompensationOn);
const NOT_SKIPPED: Need = Need(Subject::BlockDelete, PostCode::SkippedPart);
const NO_CYCLE: Need = Need(Subject::Cycle, PostCode::InCycle);
const NO_ARC: Need = Need(Subject::ArcEnd, PostCode::ArcEnd);
const NO_POINTS: Need = Need(Subject::ThreadPoints, PostCode::Thread);

impl Act {
    /// All operations.
    #[cfg(test)]
    const ALL: [Act; 33] = [
        Act::Block,
        Act::Word,
        Act::OtherMotion,
        Act::OtherPoints,
        Act::Motion,
        Act::Arc,
        Act::Hole,
        Act::Thread,
        Act::Compensation,
        Act::Plane,
        Act::ToolChange,
        Act::ToolCall,
        Act::WorkOffset,
        Act::OriginShift,
        Act::Transformation,
        Act::Scale,
        Act::MachinePosition,
        Act::MachineFrame,
        Act::RotaryMove,
        Act::Table,
        Act::Reposition,
        Act::ClampedMove,
        Act::Mode,
        Act::PolarOn,
        Act::PolarOff,
        Act::CylinderOn,
        Act::CylinderOff,
        Act::MillTurnMotion,
        Act::WorkPlaneOn,
        Act::WorkPlaneOff,
        Act::TcpOn,
        Act::MasterSpindle,
        Act::ProgramEnd,
    ];

    /// The table.
    #[inline(always)]
    pub const fn needs(self) -> &'static [Need] {
        match self {
            Act::Block => &[Need(Subject::ProgramEnd, PostCode::AfterEnd)],
            Act::Word => &[NO_POINTS],
            Act::OtherMotion => &[NO_ARC],
            Act::OtherPoints => &[NO_ARC, NO_POINTS],
            Act::Motion => &[Need(Subject::Tool, PostCode::SkippedPart)],
            Act::Arc => &[Need(Subject::Thread, PostCode::Thread), NO_CYCLE],
            Act::Hole => &[Need(Subject::CompensationBehind, PostCode::InCycle)],
            Act::Thread => &[NO_CYCLE, Need(Subject::CompensationAsked, PostCode::Thread)],
            Act::Compensation => &[NO_CYCLE],
            Act::ToolChange => &[Need(Subject::Compensation, PostCode::CompensationOn)],
            Act::MachineFrame => &[Need(Subject::Compensation, PostCode::CompensationOn)],
            Act::Plane
            | Act::ToolCall
            | Act::WorkOffset
            | Act::Transformation
            | Act::Scale
            | Act::TcpOn => &[NOT_COMPENSATED],
            Act::MachinePosition | Act::RotaryMove | Act::Table | Act::Reposition => {
                &[ENDS_COMPENSATION]
            }
            Act::OriginShift | Act::MillTurnMotion | Act::WorkPlaneOff | Act::MasterSpindle => {
                &[NOT_SKIPPED]
            }
            Act::ClampedMove => &[Need(Subject::AxisClamp, PostCode::TurnsClamped)],
            Act::Mode => &[NO_CYCLE, NOT_COMPENSATED, NOT_SKIPPED],
            Act::PolarOn
            | Act::PolarOff
            | Act::CylinderOn
            | Act::CylinderOff
            | Act::WorkPlaneOn => &[NOT_COMPENSATED, NOT_SKIPPED],
            Act::ProgramEnd => {
                &[NOT_COMPENSATED, Need(Subject::CompensationEitherWay, PostCode::CompensationOn)]
            }
        }
    }

    /// Where, in words.
    const fn place(self) -> &'static str {
        match self {
            Act::Block => "before this block",
            Act::Word => "before this word",
            Act::OtherMotion => "before another motion",
            Act::OtherPoints => "before points that count otherwise",
            Act::Motion => "before this motion",
            Act::Arc => "at CIRCLE",
            Act::Hole => "at a hole",
            Act::Thread => "at a thread",
            Act::Compensation => "at CUTCOM",
            Act::Plane => "at a change of the plane",
            Act::ToolChange => "at a tool change",
            Act::ToolCall => "at TOOL CALL",
            Act::WorkOffset => "at a change of the work offset",
            Act::OriginShift => {
                "at a shift of the control's origin, from which later motions count"
            }
            Act::Transformation => "where the path is turned or stretched",
            Act::Scale => "where a script sets the scale of an axis",
            Act::MachinePosition | Act::MachineFrame => "at a move to a machine position",
            Act::RotaryMove => "at a rotary move",
            Act::Table => "where ROTABL turns a table",
            Act::Reposition => "where a rotary axis is at its limit",
            Act::ClampedMove => "at a rotary move",
            Act::Mode => "at MODE",
            Act::PolarOn => "where polar interpolation begins",
            Act::PolarOff => "where polar interpolation ends",
            Act::CylinderOn => "where cylindrical interpolation begins",
            Act::CylinderOff => "where cylindrical interpolation ends",
            Act::MillTurnMotion => "at a motion in polar or cylindrical interpolation",
            Act::WorkPlaneOn => "where a tilted work plane begins",
            Act::WorkPlaneOff => "where a tilted work plane ends",
            Act::TcpOn => "where tool center point control begins",
            Act::MasterSpindle => "where another spindle becomes the master spindle",
            Act::ProgramEnd => "at the end of the program",
        }
    }
}

impl Subject {
    /// What is wrong, in words.
    const fn wrong(self) -> &'static str {
        match self {
            Subject::CompensationAsked | Subject::CompensationBehind | Subject::Compensation => {
                "cutter compensation is on"
            }
            Subject::CompensationEitherWay => {
                "cutter compensation is on with the blocks of OPSKIP or without them"
            }
            Subject::Cycle => "a CYCLE is active",
            Subject::Thread => "a THREAD is active",
            Subject::ArcEnd => "no GOTO came after CIRCLE",
            Subject::ThreadPoints => {
                "two GOTO must follow OP/THREAD with DEPTH and CUTS at once, and one is missing"
            }
            Subject::BlockDelete => "the blocks of OPSKIP are still open",
            Subject::Tool => {
                "the tool or its offset depends on block delete: OPSKIP skips a tool change"
            }
            Subject::AxisClamp => "the rotary axes are clamped",
            Subject::ProgramEnd => "the program has ended",
        }
    }
}

/// What an operation needs to know of the CL file.
#[derive(Clone, Copy, Debug, Default)]
pub struct Part {
    /// CYCLE is active.
    pub in_cycle: bool,
    /// THREAD is active.
    pub in_thread: bool,
    /// CIRCLE waits for its end.
    pub in_arc: bool,
    /// OP/THREAD waits for a point.
    pub awaits_points: bool,
}

impl Control {
    /// Refuses an operation whose needs are not met.
    ///
    /// # Errors
    /// As its row says.
    #[inline(always)]
    pub fn require(&self, act: Act) -> Result<()> {
        self.require_within(act, Part::default())
    }

    /// Makes an operation possible that cutter compensation is in the way of, as far as the CL file
    /// has ended it and only its code still waits for a motion.
    ///
    /// # Errors
    /// As [`Control::require`].
    #[inline]
    pub fn ready_for(&mut self, act: Act) -> Result<()> {
        if self.require(act).is_err() {
            self.end_compensation()?;
        }
        self.require(act)
    }

    /// Writes the code that ends cutter compensation in a block of its own, where it still waits for
    /// a motion.
    ///
    /// # Errors
    /// As [`Control::write_block`].
    #[inline]
    pub fn end_compensation(&mut self) -> Result<()> {
        match self.state.compensates() && self.compensation_asked() == Compensation::Off {
            true => self.family().end_compensation(self),
            false => Ok(()),
        }
    }

    /// The same, where CYCLE or THREAD of the CL file matter.
    ///
    /// # Errors
    /// As its row says.
    // The operation is a constant where it asks, and so the row is one comparison or two.
    #[inline(always)]
    pub fn require_within(&self, act: Act, part: Part) -> Result<()> {
        for need in act.needs() {
            if !self.has(need.0, part) {
                return refuse(act, *need);
            }
        }
        Ok(())
    }

    /// True if a subject is as operations need it.
    #[inline(always)]
    fn has(&self, subject: Subject, part: Part) -> bool {
        match subject {
            Subject::CompensationAsked => !self.is_compensated(),
            Subject::CompensationBehind => !self.is_compensated() || self.compensation_ends(),
            Subject::Compensation => !self.state.compensates() || self.compensation_ends(),
            Subject::CompensationEitherWay => self.is_uncompensated_either_way(),
            Subject::Cycle => !part.in_cycle,
            Subject::Thread => !part.in_thread,
            Subject::ArcEnd => !part.in_arc,
            Subject::ThreadPoints => !part.awaits_points,
            Subject::BlockDelete => !self.state.may_be_skipped(),
            Subject::Tool => !self.state.groups().depends_on_block_delete(modal::TOOL),
            Subject::AxisClamp => !self.state.may_be(modal::AXIS_CLAMP, true),
            Subject::ProgramEnd => !self.state.may_be(modal::PROGRAM_END, true),
        }
    }

    fn is_uncompensated_either_way(&self) -> bool {
        match self.state.groups().know(modal::CUTTER_COMP) {
            Know::Either(sides) => {
                sides.iter().all(|side| side.is_none_or(|side| side == Compensation::Off))
            }
            Know::Unknown(_) => self.compensation_asked() == Compensation::Off,
            Know::Known(_) => true,
        }
    }
}

#[cold]
fn refuse(act: Act, Need(subject, code): Need) -> Result<()> {
    code.err(format!("{}: {}", act.place(), subject.wrong()))
}

/// The feed of a feed motion.
///
/// # Errors
/// No FEDRAT came before it.
#[inline]
pub fn feed(feed: Option<&Feed>) -> Result<&Feed> {
    feed.ok_or_else(|| PostCode::NoFeed.diag("no FEDRAT came before this motion"))
}

#[cfg(test)]
mod tests {
    use fil_machine::Unit;

    use super::*;
    use crate::control_state::modal::Source;

    /// A control on which every operation is possible.
    fn ready() -> Control {
        let mut control =
            Control::new(fil_machine::locations::default_commons()).expect("the default machine");
        control.unit = Some(Unit::Mm);
        control
    }

    /// The same, and one subject is not as it should be.
    fn without(subject: Subject) -> (Control, Part) {
        let (mut control, mut part) = (ready(), Part::default());
        let state = &mut control.state;
        match subject {
            Subject::CompensationAsked | Subject::CompensationBehind => {
                control.asked = Compensation::Left;
            }
            Subject::Compensation => state.set(modal::CUTTER_COMP, Compensation::Left),
            Subject::CompensationEitherWay => {
                let (run, skipped) = (Compensation::Left, Compensation::Off);
                control.state = by_block_delete(control.state.clone(), |state, is_run| {
                    state.set(modal::CUTTER_COMP, if is_run { run } else { skipped });
                });
            }
            Subject::Tool => {
                control.state = by_block_delete(control.state.clone(), |state, is_run| {
                    state.set(modal::TOOL, if is_run { 2 } else { 1 });
                });
            }
            Subject::Cycle => part.in_cycle = true,
            Subject::Thread => part.in_thread = true,
            Subject::ArcEnd => part.in_arc = true,
            Subject::ThreadPoints => part.awaits_points = true,
            Subject::BlockDelete => state.skip_begins(&control.commons),
            Subject::AxisClamp => state.set(modal::AXIS_CLAMP, true),
            Subject::ProgramEnd => state.set(modal::PROGRAM_END, true),
        }
        (control, part)
    }

    fn by_block_delete(
        mut state: crate::control_state::ControlState,
        say: impl Fn(&mut crate::control_state::ControlState, bool),
    ) -> crate::control_state::ControlState {
        let mut commons = fil_machine::locations::default_commons();
        let linear = [b'X', b'Y', b'Z'].map(fil_machine::Letter::of);
        say(&mut state, false);
        state.skip_begins(&commons);
        say(&mut state, true);
        state.skip_ends(&mut commons, (linear, &[]), false);
        state
    }

    const SUBJECTS: [Subject; 12] = [
        Subject::CompensationAsked,
        Subject::CompensationBehind,
        Subject::Compensation,
        Subject::CompensationEitherWay,
        Subject::Cycle,
        Subject::Thread,
        Subject::ArcEnd,
        Subject::ThreadPoints,
        Subject::BlockDelete,
        Subject::Tool,
        Subject::AxisClamp,
        Subject::ProgramEnd,
    ];

    #[test]
    fn a_control_that_is_ready_is_ready_for_all() {
        for act in Act::ALL {
            assert!(ready().require(act).is_ok(), "{act:?}");
        }
    }

    /// Compensation on the control is compensation that was asked for, too.
    fn implies(wrong: Subject, subject: Subject) -> bool {
        let asked = [Subject::CompensationAsked, Subject::CompensationBehind];
        let is_asked = asked.contains(&wrong) || wrong == Subject::Compensation;
        wrong == subject || is_asked && asked.contains(&subject)
    }

    #[test]
    fn each_row_alone_refuses_its_operation_with_its_code() {
        for act in Act::ALL {
            for subject in SUBJECTS {
                let (control, part) = without(subject);
                let row = act.needs().iter().find(|need| implies(subject, need.0));
                let refusal = control.require_within(act, part).err().map(|diag| diag.code);
                let expected = row.map(|Need(_, code)| code.diag("").code);
                assert_eq!(refusal, expected, "{act:?} where {subject:?} is wrong");
            }
        }
    }

    /// The cells of the table that a machine's safety hangs on, as the papers and manuals of
    /// controls have them: a deleted cell fails here, whatever the rows say.
    #[test]
    fn cutter_compensation_stands_between_these_operations() {
        let mut control = ready();
        control.state.set(modal::CUTTER_COMP, Compensation::Right);
        let free = [Act::Block, Act::Motion, Act::Arc, Act::Compensation, Act::OriginShift];
        let words = [Act::Word, Act::OtherMotion, Act::OtherPoints];
        let other = [Act::MillTurnMotion, Act::WorkPlaneOff, Act::MasterSpindle, Act::ClampedMove];
        for act in Act::ALL {
            let may = [&free[..], &words, &other].iter().any(|acts| acts.contains(&act));
            assert_eq!(control.require(act).is_ok(), may, "{act:?}");
        }
    }

    #[test]
    fn a_text_that_cannot_be_read_asks_for_no_compensation() {
        let mut control = ready();
        control.state.forget(modal::CUTTER_COMP, Source::Author);
        assert!(control.require(Act::ProgramEnd).is_ok());
        control.asked = Compensation::Left;
        assert!(control.require(Act::ProgramEnd).is_err());
    }
}
