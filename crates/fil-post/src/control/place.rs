//! Where the axes stand, positions of the machine in mm or inch.

use fil_diag::{Diag, Result};
use fil_machine::Letter;
use fil_machine::axes::AxisSet;
use fil_machine::commons::{EMPTY, Kind, LAST_OUTPUT};
use fil_machine::functions::WorkPlane;
use fil_machine::locations::{self as loc, RapidSplit};

use super::Control;
use crate::control_state::modal::{self, Source};
use crate::control_state::{Length, Levels, Meaning, Place};
use crate::errors::PostCode;

/// Why a motion of a tool has no length.
const OF_ANOTHER_TOOL: &str =
    "a foreign block changed the tool, and nothing activated its length offset";

impl Control {
    /// Where an axis stands.
    pub fn place(&self, number: usize) -> Place {
        let axis = self.tables.axis(number);
        match self.place_on_tape(number) {
            Place::At(value) => Place::At(axis.position(value)),
            Place::Shifted(value) => Place::Shifted(axis.position(value)),
            Place::LeftToScript(value) => Place::LeftToScript(axis.position(value)),
            Place::Between(levels) => {
                let (one, other) = (axis.position(levels.low), axis.position(levels.high));
                Place::Between(Levels { low: one.min(other), high: one.max(other), ..levels })
            }
            other => other,
        }
    }

    /// X, Y and Z may be those of the tip in the part: tool-tip control is on, or nobody knows.
    pub fn may_name_tip(&self) -> bool {
        self.tables.tip_output && !self.state.is(modal::TCP, false)
    }

    /// X, Y and Z may count in a tilted frame: one is in force, or nobody knows.
    pub fn may_be_tilted(&self) -> bool {
        self.tables.frame_output && !self.state.is(modal::WORK_PLANE, WorkPlane::Off)
    }

    /// Where an axis stands, values of the tape.
    pub fn place_on_tape(&self, number: usize) -> Place {
        let letter = self.tables.axis(number).letter;
        self.state.place(letter, self.commons.last_output(letter))
    }

    /// Position of an axis, whoever brought it there; `None` when it is not known.
    pub fn stands(&self, number: usize) -> Option<f64> {
        let axis = self.tables.axis(number);
        let known = self.state.stands(axis.letter, self.commons.last_output(axis.letter));
        known.map(|value| axis.position(value))
    }

    /// Where an axis may stand behind blocks that may be skipped; `None` where the switch
    /// leaves no doubt of it.
    pub fn levels_behind_skip(&self, number: usize) -> Option<Levels> {
        match self.place(number) {
            Place::Between(levels) => Some(levels),
            _ => None,
        }
    }

    /// A script sets a location. Where it is a last output value the script says where the axis
    /// stands; made EMPTY, the axis stays where it is.
    pub fn script_sets(&mut self, kind: Kind, location: u32, value: f64) {
        let first = LAST_OUTPUT as u32;
        let number = location.checked_sub(first).filter(|_| kind == Kind::Dbl);
        let letter = number.and_then(|number| Letter::numbered(i32::try_from(number).ok()?));
        let Some(letter) = letter else { return };
        let last = self.commons.last_output(letter);
        if value != EMPTY {
            self.state.last_is_said(letter);
        } else if last != EMPTY {
            self.state.last_is_emptied(letter, last);
        }
    }

    /// What must hold for a motion in the part: the length of the tool is in force, or is called
    /// with the motion. What a position of the machine or an author's block has ended is called
    /// again where its offset is known.
    ///
    /// # Errors
    /// An author's block canceled it, or changed the tool: at the level of the doubt.
    #[cold]
    pub fn ready_length(&mut self) -> Result<()> {
        let is_called = self.waiting.length_offset.is_some() || self.may_name_tip();
        let length = self.state.length();
        let what = match length {
            Length::OfAnotherTool => OF_ANOTHER_TOOL,
            _ if is_called => return Ok(()),
            Length::Unsaid | Length::Called => return Ok(()),
            Length::Taken => "a foreign block cancelled the tool length offset",
            Length::Ended => {
                "machine coordinates or a tool change cancelled the tool length offset, and its number is not known"
            }
        };
        let Some(offset) = self.offset_to_restate(length) else {
            return self.doubt_length(what);
        };
        if length != Length::Ended {
            let restated = "it is called with the next motion of Z";
            self.mild_doubt(PostCode::LengthTaken.diag(what), restated)?;
        }
        self.state.set(modal::LENGTH, Length::Ended);
        self.state.set(modal::LENGTH_OFFSET, offset);
        self.await_length(Some((offset, self.block.cause)));
        self.state.doubt(self.tables.axis(2).letter);
        Ok(())
    }

    /// What must hold before tool center point control, which takes up the length by itself: that
    /// of the tool that LOADTL has changed.
    ///
    /// # Errors
    /// A text has changed the tool: at the level of the doubt.
    #[cold]
    pub fn ready_tip_length(&mut self) -> Result<()> {
        match self.state.length() {
            Length::OfAnotherTool => self.doubt_length(OF_ANOTHER_TOOL),
            _ => Ok(()),
        }
    }

    fn doubt_length(&mut self, message: &str) -> Result<()> {
        let assumed = "taken to be the length that the CL file counts on";
        self.doubt(Source::Author, PostCode::LengthTaken.diag(message), assumed)?;
        self.state.set(modal::LENGTH, Length::Unsaid);
        Ok(())
    }

    /// LOADTL calls the length of its tool by a function with a number, outside of tool center
    /// point control.
    pub fn calls_lengths(&self) -> bool {
        self.codes.calls_lengths && !self.may_name_tip()
    }

    /// The offset number with which the tool length offset can be called again.
    fn offset_to_restate(&self, length: Length) -> Option<i64> {
        let can_be_called = self.calls_lengths();
        match length {
            Length::Ended => self.state.get(modal::LENGTH_OFFSET),
            Length::OfAnotherTool => self.state.get(modal::NAMED_TOOL).filter(|_| can_be_called),
            _ => self.state.get(modal::LENGTH_OFFSET).filter(|_| can_be_called),
        }
    }

    /// A tool change may have moved all axes but those that CLAMP holds.
    pub fn tool_change_moves(&mut self) {
        let held = match !self.tables.clamps && self.state.is(modal::AXIS_CLAMP, true) {
            true => AxisSet::ROTARY,
            false => AxisSet::NONE,
        };
        let present = self.tables.present();
        for number in present.numbers().filter(|number| !held.has(*number)) {
            self.state.tool_change_moves(self.tables.axis(number).letter);
        }
    }

    /// An axis whose position is in doubt is taken to be where its last word brought it; the
    /// next motion outputs it again.
    pub fn assume_position(&mut self, number: usize) {
        let letter = self.tables.axis(number).letter;
        let last = self.state.last_before_empty(letter, self.commons.last_output(letter));
        match last == EMPTY {
            true => self.state.last_is_said(letter),
            false => self.state.stand(letter, last),
        }
    }

    /// The last motion was at feed: the tool may stand in the part.
    fn was_at_feed(&self) -> bool {
        let rapid = [loc::RAPID_CODE_XY, loc::RAPID_CODE_Z].map(|at| self.code_if_any(at));
        match self.state.get(modal::MOTION) {
            Some(code) => {
                matches!(self.meaning(code), Meaning::Motion(_)) && !rapid.contains(&Some(code))
            }
            None => self.klartext.at_feed,
        }
    }

    /// Warns of a rapid motion across from a height that a script has forgotten.
    pub fn cross_forgotten(&mut self, number: usize) {
        let letter = self.tables.axis(number).letter;
        let message = format!(
            "a script made the last {letter} EMPTY after a block that may have moved it, and a rapid move in XY follows"
        );
        self.warnings.add(PostCode::ShiftedLevel, message);
    }

    /// Who has given an axis another zero.
    fn shifted_by(&self, number: usize) -> Source {
        self.state.shifted_by(self.tables.axis(number).letter)
    }

    /// Warns of a rapid motion across at a height that counts from another zero than before.
    ///
    /// # Errors
    /// The tool would have to go up from where it cuts, and how far is not known.
    pub fn cross_shifted(&mut self, number: usize, rises: bool) -> Result<()> {
        if rises && self.was_at_feed() {
            return match self.commons.read(loc::RAPID_SPLIT) {
                RapidSplit::OneBlock => refuse_shifted_way(self, number),
                _ => unknown_height(self, number, self.shifted_by(number)),
            };
        }
        let letter = self.tables.axis(number).letter;
        let message = format!(
            "{letter} counts from another zero since the tool was brought to its height, and a \
             rapid move crosses"
        );
        self.warnings.add(PostCode::ShiftedLevel, message);
        Ok(())
    }
}

/// What the post takes for granted of an axis in doubt.
const STANDS_AS_WRITTEN: &str = "assumed to be at its last programmed position";

/// Doubts a rapid motion across from a height that an author's block left unknown: the axis is
/// taken to be where its last word brought it.
///
/// # Errors
/// The doubt, by its level.
pub fn cross_unknown(control: &mut Control, number: usize) -> Result<()> {
    let by = control.state.lost_by(control.tables.axis(number).letter);
    unknown_height(control, number, by)
}

/// An unknown level, with a way up in the words of the control.
fn unknown_level(control: &Control, message: String) -> Box<Diag> {
    Box::new(PostCode::UnknownLevel.diag(message).hint(format!(
        "Before it, put GOHOME, RETRCT, LOADTL, a block to the machine's reference point ({}), or RAPID with a GOTO straight up. Before a new work offset, retract with RAPID.",
        control.can().way_up
    )))
}

fn unknown_height(control: &mut Control, number: usize, by: Source) -> Result<()> {
    let letter = control.tables.axis(number).letter;
    let diag = unknown_level(
        control,
        format!(
            "the position of {letter} is not known here: Z first could plunge, and XY first could go through the part"
        ),
    );
    control.doubt(by, diag, STANDS_AS_WRITTEN)?;
    control.assume_position(number);
    Ok(())
}

/// Refuses a rapid motion of several axes in one block from a cut whose end counts from another
/// zero.
fn refuse_shifted_way(control: &mut Control, number: usize) -> Result<()> {
    let letter = control.tables.axis(number).letter;
    let diag = PostCode::UnknownLevel.diag(format!(
        "the tool is in its cut, the work offset of {letter} has changed since, and all axes move in one block: the path may go through the part"
    ));
    let diag =
        Box::new(diag.hint(
            "Retract with RAPID before the new work offset, or put GOHOME or LOADTL after it.",
        ));
    control.doubt(control.shifted_by(number), diag, "taken to be clear of it")
}

/// Doubts a rapid motion of several axes in one block from a position that an author's block left
/// unknown: the axis is taken to be where its last word brought it.
///
/// # Errors
/// The doubt, by its level.
pub fn cross_unknown_way(control: &mut Control, number: usize) -> Result<()> {
    let letter = control.tables.axis(number).letter;
    let diag = unknown_level(
        control,
        format!(
            "the position of {letter} is not known here, and all axes move in one block: the path may go through the part"
        ),
    );
    control.doubt(control.state.lost_by(letter), diag, STANDS_AS_WRITTEN)?;
    control.assume_position(number);
    Ok(())
}
