//! Blocks, words and texts go to the tape, and the control learns from each of them, whoever
//! made it.

use fil_diag::Result;
use fil_machine::Letter;
use fil_machine::axes::{AXES, AxisSet};
use fil_machine::letters::{G, M};
use fil_machine::locations as loc;
use fil_machine::modes::Plane;

use super::edit::plain;
use super::left_out::{Edit, Maker};
use super::word_address::modes;
use super::{
    Compensation, Control, Function, full_turn, program, reference_way, speed_of_others, texts,
};
use crate::cause::Cause;
use crate::control::needs::Act;
use crate::control_state::modal::{self, Group, Value};
use crate::control_state::{ForeignBlock, Place, Source};
use crate::errors::PostCode;

/// The function of Klartext that goes along the tool out of the part, under tool-tip control too.
const RETRACT: &str = "M140";

/// Groups that positions under tool-tip control count in.
const FRAME: [Group; 5] =
    [Group::Plane, Group::Units, Group::WorkOffset, Group::WorkPlane, Group::Cycle];

/// What the control knew before words or texts of others, which its groups alone do not say.
#[derive(Clone, Copy, Debug)]
pub struct BeforeOthers {
    compensated: bool,
    plane: Option<Plane>,
    /// The length of the tool is taken off by the edge of none, on a SINUMERIK.
    without_edge: bool,
    /// The rotary ones may be clamped.
    clamped: bool,
    /// Where the axes stand, under compensation and with clamps.
    stood: [Option<f64>; AXES],
    /// Under tool-tip control: what counts in it.
    frame: Option<Frame>,
}

/// What positions under tool-tip control count in.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Frame {
    groups: [Option<Value>; FRAME.len()],
    shifted: bool,
    /// A rotary axis or Z stands at a position of the machine.
    of_machine: bool,
}

impl Control {
    /// Writes the block under construction and empties it; the control learns
    /// from it.
    ///
    /// # Errors
    /// As [`Tape::block`](crate::tape::Tape::block); what the start of the program refuses; a block after
    /// the end of the program.
    #[inline]
    pub fn write_block(&mut self) -> Result<()> {
        if self.block.is_empty() {
            return Ok(());
        }
        if !self.straight {
            return self.write_with_care();
        }
        if self.unit.is_none() && self.block.has_numbers() {
            self.require_unit()?;
        }
        self.require(Act::Block)?;
        if self.tables.style.divides && self.is_crowded() {
            return self.write_apart();
        }
        let result = self.tape.block(&self.block, &self.tables, &mut self.commons);
        self.state.learn_block(&self.block, &self.codes, &self.tables.addresses);
        self.block.clear();
        result
    }

    /// Writes words in the order given, whether or not their values have changed
    /// (POSTN).
    ///
    /// # Errors
    /// As [`Tape::words`](crate::tape::Tape::words).
    pub fn write_words(&mut self, words: &[(Letter, f64, Cause)]) -> Result<()> {
        self.begin()?;
        if words.iter().any(|(letter, ..)| !matches!(*letter, G | M)) {
            self.require_unit()?;
        }
        self.require(Act::Block)?;
        modes::leave_plane_of_its_own(self)?;
        let plain = plain(words);
        modes::before_others(self, &plain)?;
        self.refuse_without_length(&plain)?;
        if self.tables.style.edits_words
            && let Some(edited) = self.edited_words(words)?
        {
            return self.put_words(&edited, None);
        }
        self.put_words(words, None)
    }

    /// Puts words on the tape; the control learns from them. `edit` is what was done to those of a
    /// block of the post.
    pub(super) fn put_words(
        &mut self,
        words: &[(Letter, f64, Cause)],
        edit: Option<Edit<'_>>,
    ) -> Result<()> {
        if words.is_empty() {
            return Ok(());
        }
        let before = self.before_others()?;
        let start = self.tape.text.len();
        self.family().put_words(self, words)?;
        let maker = if edit.is_some() { Maker::Post } else { Maker::Words };
        if self.edit_line(start, maker)? {
            return Ok(());
        }
        let plain = plain(words);
        match edit {
            Some(edit) => self.learn_left(edit),
            None if self.learn_by_rule(start) => {}
            None => {
                reference_way::warn(self, &plain);
                self.state.learn_words(&plain, &self.codes);
            }
        }
        self.family().learn_words(self, &plain);
        if edit.is_none_or(|edit| self.changes_speed(edit)) {
            speed_of_others::learn(self, &plain, true);
        }
        self.follow_feed_mode();
        self.warn_other_offset();
        self.take_plane_back(&before);
        match edit {
            // The post has done what it wanted.
            Some(edit) if !self.brings_functions(edit) => Ok(()),
            _ => self.doubt_changes(before),
        }
    }

    /// Writes a text of the machine as a block; the control learns from it what it can read.
    ///
    /// # Errors
    /// As [`Tape::line`](crate::tape::Tape::line); a character that must not reach the tape; a block after
    /// the end of the program.
    pub fn write_text(&mut self, text: &str, numbered: bool) -> Result<()> {
        self.write_foreign(&self.read(text.to_string()), numbered)
    }

    /// The same for a block of an author that was read.
    ///
    /// # Errors
    /// As [`Control::write_text`].
    pub fn write_foreign(&mut self, block: &ForeignBlock, numbered: bool) -> Result<()> {
        self.write_read(block, numbered, Maker::Text)
    }

    /// The same for a text that the post has made: what it says can't be left out.
    ///
    /// # Errors
    /// As [`Control::write_text`]; words that were edited out of it.
    pub fn write_own_text(&mut self, text: &str) -> Result<()> {
        self.write_read(&self.read(text.to_string()), true, Maker::Post)
    }

    fn write_read(&mut self, block: &ForeignBlock, numbered: bool, maker: Maker) -> Result<()> {
        let text = block.text.as_str();
        self.begin()?;
        if texts::begins_program(text) {
            self.warn_second_program(text);
            self.state.program_begins();
        }
        self.require(Act::Block)?;
        modes::leave_plane_of_its_own(self)?;
        modes::before_others(self, block.words())?;
        texts::check(text)?;
        if maker == Maker::Text {
            self.refuse_without_length(block.words())?;
        }
        self.family().check_text(self, block)?;
        if !self.can().brackets_are_comments {
            texts::refuse_brackets(text)?;
        }
        let edited = match maker {
            Maker::Post => self.put(text, numbered, maker)?,
            _ => self.put_line(text, numbered)?,
        };
        if edited {
            return Ok(());
        }
        let mut before = self.before_others()?;
        if self.can().retract_function && block.named(&[RETRACT]).is_some() {
            before.frame = None;
        }
        self.learn(block);
        self.follow_feed_mode();
        self.warn_other_offset();
        self.take_plane_back(&before);
        self.doubt_changes(before)
    }

    /// Takes the format of F in the mode that words or texts of others have left in force.
    fn follow_feed_mode(&mut self) {
        if let Some(mode) = self.state.get(modal::FEED_MODE) {
            self.tables.format_feed(mode);
        }
    }

    /// Warns where an author's block has chosen another work offset than the CL file.
    fn warn_other_offset(&mut self) {
        let changed = self.state.groups().changed_since_foreign(modal::WORK_OFFSET);
        if !changed || self.waiting.has(Function::WorkOffset) {
            return;
        }
        let offsets = self.state.get(modal::ASKED_OFFSET).zip(self.state.get(modal::WORK_OFFSET));
        if let Some((asked, now)) = offsets.filter(|(asked, now)| asked != now) {
            let message =
                format!("the CL file asks for work offset {asked}, and a block has {now}");
            self.warnings.add(PostCode::OtherOffset, message);
        }
    }

    /// Warns of a text that begins a program within the one that the post has begun.
    fn warn_second_program(&mut self, text: &str) {
        let Some(letter) = self.commons.read(loc::PROGRAM_NUMBER_ADDRESS) else { return };
        // Behind the end of the main program come its subprograms.
        if self.head.started && self.state.groups().written(modal::PROGRAM_END) == 0 {
            let message =
                format!("`{text}` after the program number that the post writes ({letter})");
            self.warnings.add(PostCode::SecondProgram, message);
        }
    }

    /// The lengths of a SINUMERIK's tool count along the axes of its plane: where others have left
    /// that of a lathe, the next motion says it again.
    fn take_plane_back(&mut self, before: &BeforeOthers) {
        let changed =
            self.state.get(modal::PLANE).is_some() && self.state.get(modal::PLANE) != before.plane;
        let is_lathe = self.can().lengths_by_plane && self.commons.read(loc::LATHE_DIAMETER);
        if changed && is_lathe {
            self.state.forget(modal::DIAMETER_MODE, Source::Post);
        }
    }

    /// What the control knows before words or texts that the post has not made.
    ///
    /// # Errors
    /// As [`Control::begin`].
    pub fn before_others(&mut self) -> Result<BeforeOthers> {
        self.begin()?;
        self.state.foreign_begins();
        self.warnings.author_writes(self.tape.cause);
        let compensated = self.is_compensated();
        let clamped = self.state.may_be(modal::AXIS_CLAMP, true);
        let stood = match compensated || clamped {
            true => std::array::from_fn(|number| self.stands(number)),
            false => [None; AXES],
        };
        Ok(BeforeOthers {
            compensated,
            plane: self.state.get(modal::PLANE),
            without_edge: self.sinumerik.edge() == Some(0),
            clamped,
            stood,
            frame: self.frame_of_tip(),
        })
    }

    fn frame_of_tip(&self) -> Option<Frame> {
        let state = &self.state;
        (state.is(modal::TCP, true)).then(|| Frame {
            groups: FRAME.map(|group| state.groups().value(group)),
            shifted: matches!(self.place(0), Place::Shifted(_)),
            of_machine: (0..5).any(|number| self.place(number) == Place::Clear),
        })
    }

    /// Texts have named a length of the tool or taken it off; on a SINUMERIK H is any function,
    /// and another edge counts from its own length.
    fn length_was_named(&self, before: &BeforeOthers) -> bool {
        match self.can().cutting_edges {
            true => (self.sinumerik.edge() == Some(0)) != before.without_edge,
            false => self.state.groups().changed_since_foreign(modal::LENGTH_WORD),
        }
    }

    /// What an author's block has changed that tool center point control counts on, which goes
    /// on: controls differ in what that does.
    fn changed_under_tip_control(&self, before: &BeforeOthers) -> Option<&'static str> {
        let frame = before.frame?;
        let changed = self.state.groups().changed_since_foreign(modal::TOOL_CHANGED);
        if changed || self.length_was_named(before) {
            return Some(
                "under tool center point control the block changes the tool, or names or cancels a \
                 tool length offset",
            );
        }
        let is_other = self.frame_of_tip().is_some_and(|now| now != frame);
        is_other.then_some(
            "under tool center point control the block changes the plane, the unit, the origin or \
             the frame, goes to a machine position or begins a cycle",
        )
    }

    /// What an author's block has changed that cutter compensation counts on.
    fn changed_in_compensation(&self, before: &BeforeOthers) -> Option<&'static str> {
        let groups = self.state.groups();
        if self.waiting.has(Function::Compensation)
            && groups.changed_since_foreign(modal::CUTTER_COMP)
        {
            return Some(
                "the block switches cutter compensation while CUTCOM waits for its motion, which \
                 switches it again",
            );
        }
        if !before.compensated {
            return None;
        }
        if groups.changed_since_foreign(modal::TOOL_CHANGED)
            || groups.changed_since_foreign(modal::TOOL_WORD)
        {
            return Some("the block changes the tool while cutter compensation is on");
        }
        if [3, 4].iter().any(|number| self.stands(*number) != before.stood[*number]) {
            return Some("the block turns the machine while cutter compensation is on");
        }
        let plane = self.state.get(modal::PLANE);
        let is_other = before.plane.zip(plane).is_some_and(|(one, other)| one != other);
        is_other.then_some("the block changes the plane while cutter compensation is on")
    }

    /// Refuses a turn of clamped axes by a block of an author or of the settings.
    fn refuse_turn_in_clamp(&self, before: &BeforeOthers) -> Result<()> {
        if !before.clamped {
            return Ok(());
        }
        let moved = |number: &usize| {
            self.stands(*number).is_some_and(|now| before.stood[*number] != Some(now))
        };
        let moved = AxisSet::ALL.numbers().filter(moved).map(AxisSet::of);
        full_turn::refuse_clamped(self, moved.fold(AxisSet::NONE, AxisSet::or))
    }

    /// Doubts what an author's block has changed within cutter compensation or tool center point
    /// control, which go on behind it.
    ///
    /// # Errors
    /// The doubt, by its level; a turn of what is clamped.
    pub fn doubt_changes(&mut self, before: BeforeOthers) -> Result<()> {
        self.refuse_turn_in_clamp(&before)?;
        let changed = self.changed_in_compensation(&before);
        match changed.or_else(|| self.changed_under_tip_control(&before)) {
            Some(what) => {
                let diag = PostCode::AuthorChange.diag(what);
                self.doubt(Source::Author, diag, "the mode is assumed to continue")
            }
            None => Ok(()),
        }
    }

    /// Cutter compensation is on, or waits for its motion.
    pub fn is_compensated(&self) -> bool {
        self.state.compensates() || self.compensation_asked() != Compensation::Off
    }

    /// Writes a line that is no block of words: a comment, or what its writer keeps account of.
    ///
    /// # Errors
    /// As [`Control::write_text`].
    pub fn write_line(&mut self, text: &str, numbered: bool) -> Result<()> {
        self.begin()?;
        self.require(Act::Block)?;
        texts::check(text)?;
        self.put_line(text, numbered).map(|_| ())
    }

    /// Writes a line as it is; says whether it was edited, so that the control has learned
    /// from it.
    pub(super) fn put_line(&mut self, text: &str, numbered: bool) -> Result<bool> {
        let maker = Maker::Text;
        let Some(words) = self.behind_skip_mark(text) else {
            return self.put(text, numbered, maker);
        };
        let outer = self.tape.skip;
        self.tape.skip = outer.or(Some(self.block.cause));
        let edited = self.put(words, numbered, maker);
        self.tape.skip = outer;
        edited
    }

    /// The words of a text that begins with the mark of OPSKIP, which stands before the number of
    /// its block: behind it many controls refuse it. `None` for another text, for one of the levels
    /// of a mark (`/2`), and for one with a number of its own.
    fn behind_skip_mark<'t>(&self, text: &'t str) -> Option<&'t str> {
        let words = text.trim_start().strip_prefix(self.tables.style.skip?)?.trim_start();
        let begins = words.starts_with(|first: char| first.is_ascii_alphabetic());
        (begins && !words.starts_with(['N', 'n'])).then_some(words)
    }

    fn put(&mut self, text: &str, numbered: bool, maker: Maker) -> Result<bool> {
        self.warn_of_letters(text);
        let start = self.tape.text.len();
        self.family().put_text(self, text, numbered)?;
        if self.can().edits_lines { self.edit_line(start, maker) } else { Ok(false) }
    }

    /// Warns of letters of a text that the control may not read.
    pub(super) fn warn_of_letters(&mut self, text: &str) {
        if !text.is_ascii() && self.tables.style.page.is_utf8() {
            self.warnings.add(PostCode::TapeText, format!("`{text}`"));
        }
    }

    /// Writes the start of the program if it is still due. Whoever asks for what
    /// the control knows calls it first.
    ///
    /// # Errors
    /// As [`program::start`].
    #[inline]
    pub fn begin(&mut self) -> Result<()> {
        if self.head.started {
            return Ok(());
        }
        program::start(self)
    }
}
