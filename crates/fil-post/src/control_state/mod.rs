//! What the control knows: the modes it is in and the words it has, as the tape
//! says. This is the only owner of modality.
//!
//! It learns from each block at the moment the block goes to the tape, whoever
//! made it: the post, POSTN, PREFUN, INSERT, the machine's own texts. What can't
//! be told is unknown (`None`), and whoever depends on it says it again.

mod auxiliaries;
mod codes;
mod doubts;
mod foreign;
mod learning;
mod length;
mod levels;
pub mod modal;
mod others;
mod skip;
mod work_offset;

pub use codes::{Codes, THREAD_OF_OSP, VARYING_LEADS_OF_SINUMERIK};
pub use fil_machine::functions::Meaning;
pub use fil_machine::modes::{Compensation, Distance};
pub use foreign::{Effect, ForeignBlock, TextFrame, functions};

use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::{Commons, FunctionCode, Letter, letters};

use doubts::Doubts;
pub use doubts::{MachineSpot, Place};
pub use length::Length;
pub use levels::Levels;
use modal::{
    CUTTER_COMP, CUTTER_PATH, FEED_MODE, Groups, LENGTH, MOTION, Modal, Of, PLANE, PROGRAM_END,
    SPINDLE, SURFACE_SPEED, TOOL, UNITS,
};
pub use modal::{Know, Source};
pub use work_offset::WorkOffset;

/// Where the path stands in cutter compensation.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum CutterPath {
    /// No motion has been made in its plane since G40, G41 or G42.
    Unmoved,
    /// A motion has been made since compensation was switched on.
    Moved,
    /// Compensation that had begun was switched off, and no motion in its plane has been made
    /// since: the control comes back to the path with the next one, which must be a line.
    Leaving,
}

/// Which way the spindle turns, as far as a tap depends on it.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Rotation {
    /// Nothing has said it.
    Unsaid,
    /// Clockwise, for right-hand threads.
    Clockwise,
    /// Counterclockwise, for left-hand threads.
    Counterclockwise,
    /// It turned counterclockwise, and may not any more.
    InDoubt,
    /// It stands.
    Standing,
}

impl Rotation {
    /// After something that can't be read: texts of a shop are taken not to turn a spindle
    /// that turns clockwise.
    fn doubted(self) -> Self {
        match self {
            Rotation::Counterclockwise => Rotation::InDoubt,
            Rotation::Standing => Rotation::Unsaid,
            other => other,
        }
    }

    /// What holds when one of the two may be in force.
    fn or(self, other: Self) -> Self {
        match (self, other) {
            _ if self == other => self,
            (Rotation::Standing, turning) | (turning, Rotation::Standing) => turning.doubted(),
            _ => Rotation::InDoubt,
        }
    }
}

/// The usual tool change, which may move the axes.
pub const TOOL_CHANGE: FunctionCode = FunctionCode::whole(6);

/// The letters of axes: a control may have any of them.
const AXIS_LETTERS: [Letter; 9] = [
    Letter::of(b'X'),
    Letter::of(b'Y'),
    Letter::of(b'Z'),
    Letter::of(b'A'),
    Letter::of(b'B'),
    Letter::of(b'C'),
    Letter::of(b'U'),
    Letter::of(b'V'),
    Letter::of(b'W'),
];

/// The modes of the control and the words it has.
#[derive(Clone, Debug)]
pub struct ControlState {
    groups: Groups,
    /// Letters whose last output value is not what the control has.
    doubts: Doubts,
    /// State and last output values before the blocks that may be skipped.
    before_skip: Option<Box<(ControlState, [f64; Letter::COUNT])>>,
}

impl ControlState {
    /// What a machine is taken to be in before its program says anything: modes
    /// that its settings name, no compensation, no cycle.
    pub fn at_start(feed_mode: FeedMode, plane: Option<Plane>, unit: Option<Unit>) -> Self {
        let mut groups = Groups::at_start();
        groups.set(FEED_MODE, feed_mode);
        groups.set_if_known(PLANE, plane, Source::NotCommanded);
        groups.set_if_known(UNITS, unit, Source::NotCommanded);
        ControlState { groups, doubts: Doubts::default(), before_skip: None }
    }

    /// The value of a modal group, if it is known.
    #[inline(always)]
    pub fn get<T: Modal>(&self, of: Of<T>) -> Option<T> {
        self.groups.get(of)
    }

    /// True if a modal group certainly has a value.
    #[inline]
    pub fn is<T: Modal>(&self, of: Of<T>, value: T) -> bool {
        self.groups.is(of, value)
    }

    /// True if a modal group may have a value.
    #[inline]
    pub fn may_be<T: Modal>(&self, of: Of<T>, value: T) -> bool {
        self.groups.may_be(of, value)
    }

    /// A block gives a modal group a value.
    #[inline]
    pub fn set<T: Modal>(&mut self, of: Of<T>, value: T) {
        self.groups.set(of, value);
    }

    /// A modal group may have any value.
    pub fn forget<T>(&mut self, of: Of<T>, source: Source) {
        self.groups.forget(of, source);
    }

    /// What is known of any modal group from here on.
    pub fn write(&mut self, group: modal::Group, know: Know<modal::Value>) {
        self.groups.write(group, know);
    }

    /// The same, or it becomes unknown.
    pub fn set_if_known<T: Modal>(&mut self, of: Of<T>, value: Option<T>, source: Source) {
        self.groups.set_if_known(of, value, source);
    }

    /// A turning cycle of an author has moved the axes, and returned to where it began.
    pub fn axes_returned(&self) -> bool {
        self.doubts.returned
    }

    /// All modal groups.
    pub fn groups(&self) -> &Groups {
        &self.groups
    }

    /// A block of an author begins: see [`Groups::changed_since_foreign`].
    pub fn foreign_begins(&mut self) {
        self.groups.foreign_begins();
    }

    /// How the spindle was last told to turn.
    pub fn rotation(&self) -> Rotation {
        self.get(SPINDLE).unwrap_or(Rotation::InDoubt)
    }

    /// Tool length offset, as far as functions have activated or canceled it.
    pub fn length(&self) -> Length {
        self.get(LENGTH).unwrap_or(Length::Unsaid)
    }

    /// True when the control is known to have the last output value of a letter.
    #[inline]
    pub fn has_last(&self, letter: Letter) -> bool {
        !self.doubts.has(letter)
    }

    /// True when some letter's last output value is in doubt.
    #[inline]
    pub fn has_doubts(&self) -> bool {
        !self.doubts.is_empty()
    }

    /// The last output value of a letter is not what the control has.
    pub fn doubt(&mut self, letter: Letter) {
        self.doubts.add(letter);
    }

    /// The control has the last output value of a letter after all.
    pub fn trust(&mut self, letter: Letter) {
        self.doubts.remove(letter);
    }

    /// Cutter compensation is on.
    #[inline]
    pub fn compensates(&self) -> bool {
        matches!(self.get(CUTTER_COMP), Some(Compensation::Left | Compensation::Right))
    }

    /// The next motion says all axes: they stand where they stood, as far as the post itself
    /// has brought them.
    pub fn doubt_axes(&mut self) {
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubt(letter));
    }

    /// The axes may have gone anywhere.
    pub fn lose_axes(&mut self) {
        self.doubts.returned = false;
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.lose(letter));
    }

    /// A block of an author may have brought an axis anywhere.
    pub fn loses(&mut self, letter: Letter) {
        self.doubts.lose(letter);
    }

    /// A block of the post has, which can't tell where.
    pub fn loses_by_post(&mut self, letter: Letter) {
        self.doubts.lose_by_post(letter);
    }

    /// Who has made the position of an axis unknown.
    pub fn lost_by(&self, letter: Letter) -> Source {
        if self.doubts.is_lost_by_post(letter) { Source::Post } else { Source::Author }
    }

    /// Who has given the axis of a letter another zero.
    pub fn shifted_by(&self, letter: Letter) -> Source {
        if self.doubts.is_shifted_by_author(letter) { Source::Author } else { Source::Post }
    }

    /// The last output value of a letter is about to be made EMPTY: its axis has moved.
    pub fn remember(&mut self, letter: Letter, last: f64) {
        self.doubts.remember(letter, last);
    }

    /// An axis has not moved, and counts from another zero.
    pub fn shifts(&mut self, letter: Letter, by: Source) {
        self.doubts.shift(letter, by);
    }

    /// The axes have not moved, and count from another zero.
    pub fn shift_axes(&mut self, by: Source) {
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.shift(letter, by));
    }

    /// The tool has another length: Z counts from elsewhere, but for the values behind a tool
    /// change, which are those of the tip again.
    pub fn tool_length_changes(&mut self) {
        self.doubts.shift_by_length(letters::XYZ[2]);
    }

    /// A tool change may have brought an axis clear of the part.
    pub fn tool_change_moves(&mut self, letter: Letter) {
        self.doubts.changes(letter);
    }

    /// A position of the machine, which may be known, has brought an axis clear of the part.
    pub fn clears(&mut self, letter: Letter, spot: Option<MachineSpot>) {
        self.doubts.clears(letter, spot);
    }

    /// Where the axis of a letter stands in the frame of the machine, if it is known.
    pub fn machine_spot(&self, letter: Letter) -> Option<MachineSpot> {
        self.doubts.spot(letter)
    }

    /// An axis stands at this value of the tape, which is not its last output value.
    pub fn stand(&mut self, letter: Letter, value: f64) {
        self.doubts.stand(letter, value);
    }

    /// A script says where the axis of a letter stands: at its last output value.
    pub fn last_is_said(&mut self, letter: Letter) {
        self.doubts.settle(letter);
    }

    /// The last output value of a letter, or that from before a script made it EMPTY.
    pub fn last_before_empty(&self, letter: Letter, last: f64) -> f64 {
        self.doubts.before_empty(letter, last)
    }

    /// Another frame turns the axes: where they stand in it is not known, but for those that
    /// are clear of the part.
    pub(super) fn turn_axes(&mut self, letters: impl IntoIterator<Item = Letter>) {
        for letter in letters {
            if self.doubts.is_clear(letter) {
                self.doubts.clears(letter, None);
            } else {
                self.doubts.lose(letter);
            }
        }
    }

    /// A script makes a last output value EMPTY: the axis stays where it is.
    pub fn last_is_emptied(&mut self, letter: Letter, last: f64) {
        self.doubts.empty(letter, last);
    }

    /// Value at which the axis of a letter stands, whoever brought it there; `None` when it is
    /// not known, or may be another by a tool change.
    pub fn stands(&self, letter: Letter, last: f64) -> Option<f64> {
        self.doubts.known(letter, last)
    }

    /// Where the axis of a letter stands; `last` is its last output value.
    pub fn place(&self, letter: Letter, last: f64) -> Place {
        self.doubts.place(letter, last)
    }

    /// A block that can't be read may have changed all.
    pub fn doubt_all(&mut self, source: Source) {
        self.groups.doubt_all(source);
        self.doubts.add_all();
        self.lose_axes();
        if source != Source::Author {
            AXIS_LETTERS.into_iter().for_each(|letter| self.loses_by_post(letter));
        }
    }

    /// S may be a surface speed still, or turns by now: nobody has read what came behind it.
    pub fn surface_speed_is_open(&self) -> bool {
        match self.groups.know(SURFACE_SPEED) {
            Know::Either(values) => values.contains(&Some(true)),
            _ => false,
        }
    }

    /// A tool is in the spindle now.
    pub fn has_tool(&mut self, tool: Option<i64>) {
        self.groups.set_if_known(TOOL, tool, Source::Author);
        if tool.is_some() {
            self.groups.forget(modal::NAMED_TOOL, Source::Post);
        }
    }

    /// The tools with the blocks of block delete run and with them skipped, where it decides
    /// which tool is in the spindle, or with which offset.
    pub fn tools_by_block_delete(&self) -> Option<[Option<i64>; 2]> {
        match self.groups.know(TOOL) {
            Know::Either(tools) => Some(tools),
            _ => None,
        }
    }

    /// Another program or subprogram begins: it may be called from anywhere.
    pub fn program_begins(&mut self) {
        self.set(PROGRAM_END, false);
        self.doubt_all(Source::Author);
        // The tool and its length are the caller's.
        self.set(LENGTH, Length::Unsaid);
        // Its first motions are those of any program: where the tool stands is the caller's.
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.settle(letter));
    }

    /// The control may be in a threading move of varying lead, which the next one would go on
    /// from.
    pub fn goes_on_in_varying_lead(&self, commons: &Commons) -> bool {
        let code = commons.read(loc::THREAD_VARYING_CODE).and_then(FunctionCode::of_setting);
        let is_sinumerik = commons.read(loc::CONTROL_FAMILY) == loc::ControlFamily::Sinumerik;
        let own = is_sinumerik.then_some(VARYING_LEADS_OF_SINUMERIK);
        self.get(MOTION).is_some_and(|motion| {
            code == Some(motion) || own.is_some_and(|codes| codes.contains(&motion))
        })
    }

    /// True where a tool change or a position of the machine has brought the axis of a letter away
    /// from the part, and nothing has moved it since.
    pub fn may_be_clear(&self, letter: Letter) -> bool {
        self.doubts.is_clear(letter)
    }

    /// A line has been run in the plane: compensation that was switched on has begun.
    #[inline]
    pub fn moved_in_plane(&mut self) {
        if !self.is(CUTTER_PATH, CutterPath::Moved) {
            self.set(CUTTER_PATH, CutterPath::Moved);
        }
    }
}
