//! Where the axes stand, positions of the machine in mm or inch.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::commons::{EMPTY, Kind, LAST_OUTPUT};
use fil_machine::locations::{self as loc, RapidSplit};

use super::Control;
use crate::control_state::modal::{self, Source};
use crate::control_state::{Length, Levels, Meaning, Place};
use crate::errors::PostCode;

/// Why a motion of a tool has no length.
const OF_ANOTHER_TOOL: &str = "a text has changed the tool, and nothing calls its length";

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
        self.tables.frame_output && !self.state.is(modal::WORK_PLANE, false)
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
    /// with the motion. What a position of the machine has ended is called again.
    ///
    /// # Errors
    /// A text has taken it off, or changed the tool, and nothing calls the length again: at the
    /// level of the doubt.
    #[cold]
    pub fn ready_length(&mut self) -> Result<()> {
        let is_called = self.waiting.length_offset.is_some() || self.may_name_tip();
        let message = match self.state.length() {
            Length::OfAnotherTool => OF_ANOTHER_TOOL,
            _ if is_called => return Ok(()),
            Length::Unsaid | Length::Called => return Ok(()),
            Length::Taken => "a text has taken the length of the tool off",
            Length::Ended => match self.state.get(modal::LENGTH_OFFSET) {
                Some(offset) => {
                    self.await_length(Some((offset, self.block.cause)));
                    self.state.doubt(self.tables.axis(2).letter);
                    return Ok(());
                }
                None => {
                    "a position of the machine has ended the length of the tool, and which offset \
                     it had is not known"
                }
            },
        };
        self.doubt_length(message)
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
        self.doubt(Source::Author, PostCode::LengthTaken.diag(message))?;
        // The author's word: the control has the length that the CL file means.
        self.state.set(modal::LENGTH, Length::Unsaid);
        Ok(())
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
            "a script has made the last {letter} EMPTY behind what may have moved it, and a rapid \
             motion crosses"
        );
        self.warnings.add(PostCode::ShiftedLevel, message);
    }

    /// Warns of a rapid motion across at a height that counts from another zero than before.
    ///
    /// # Errors
    /// The tool would have to go up from where it cuts, and how far is not known.
    pub fn cross_shifted(&mut self, number: usize, rises: bool) -> Result<()> {
        if rises && self.was_at_feed() {
            return match self.commons.read(loc::RAPID_SPLIT) {
                RapidSplit::OneBlock => refuse_shifted_way(self, number),
                _ => refuse_unknown(self, number),
            };
        }
        let letter = self.tables.axis(number).letter;
        let message = format!(
            "{letter} counts from another zero since the tool was brought to its height, and a \
             rapid motion crosses"
        );
        self.warnings.add(PostCode::ShiftedLevel, message);
        Ok(())
    }
}

/// Refuses a rapid motion across from a height that is not known.
///
/// # Errors
/// Always.
pub fn refuse_unknown<T>(control: &Control, number: usize) -> Result<T> {
    let letter = control.tables.axis(number).letter;
    PostCode::UnknownLevel.err(format!(
        "where {letter} stands is not known here: up first could be down, and across first could \
         go through the part"
    ))
}

/// Refuses a rapid motion of several axes in one block from a cut whose end counts from another
/// zero.
fn refuse_shifted_way<T>(control: &Control, number: usize) -> Result<T> {
    let letter = control.tables.axis(number).letter;
    PostCode::UnknownLevel.err_with(
        format!(
            "the tool stands in its cut, {letter} counts from another zero since, and all axes go \
             in one block: their way may lead through the part"
        ),
        "Go away from the part with RAPID before the change of the work offset, or put GOHOME or \
         LOADTL behind it.",
    )
}

/// Refuses a rapid motion of several axes in one block from a place that is not known.
///
/// # Errors
/// Always.
pub fn refuse_unknown_way<T>(control: &Control, number: usize) -> Result<T> {
    let letter = control.tables.axis(number).letter;
    PostCode::UnknownLevel.err(format!(
        "where {letter} stands is not known here, and all axes go in one block: their way may lead \
         through the part"
    ))
}
