//! What the control knows: the modes it is in and the words it has, as the tape
//! says. This is the only owner of modality.
//!
//! It learns from each block at the moment the block goes to the tape, whoever
//! made it: the post, POSTN, PREFUN, INSERT, the machine's own texts. What can't
//! be told is unknown (`None`), and whoever depends on it says it again.

mod auxiliaries;
mod codes;
mod doubts;
mod learning;
mod length;
mod levels;
mod others;
mod skip;
pub(crate) mod text;

pub use auxiliaries::CALLS;
pub use codes::{Codes, Meaning, THREAD_OF_OSP, VARYING_LEADS_OF_SINUMERIK};
pub use text::{TextFrame, TextWords, read as text_words};

use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::{Commons, FunctionCode, Letter, letters};

use doubts::Doubts;
pub use doubts::Place;
pub use length::Length;
pub use levels::Levels;

/// How coordinates count.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Distance {
    /// From the zero of the program (G90).
    Absolute,
    /// From the point before (G91).
    Incremental,
}

/// On which side of the path the cutter runs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Compensation {
    /// On the path (G40).
    Off,
    /// Left of the path (G41).
    Left,
    /// Right of the path (G42).
    Right,
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
#[derive(Clone, Debug, PartialEq)]
pub struct ControlState {
    /// The code of the last motion.
    pub motion: Option<FunctionCode>,
    /// The plane of arcs, cycles and cutter compensation.
    pub plane: Option<Plane>,
    /// How coordinates count.
    pub distance: Option<Distance>,
    /// The unit of lengths.
    pub unit: Option<Unit>,
    /// What F means.
    pub feed_mode: Option<FeedMode>,
    /// Tool-tip control.
    pub tip_control: Option<bool>,
    /// X, Y and Z count in a tilted frame.
    pub tilted: Option<bool>,
    /// Cutter compensation.
    pub compensation: Option<Compensation>,
    /// A motion has been made since compensation was switched on.
    pub compensation_begun: bool,
    /// Compensation that had begun was switched off, and no motion in its plane has been made
    /// since: the control comes back to the path with the next one, which must be a line.
    pub compensation_ends: bool,
    /// A code of compensation was said since somebody asked.
    pub compensation_said: bool,
    /// A T word that changes the tool by itself was said by others since somebody asked.
    pub tool_said: bool,
    /// A canned cycle is in force: each position drills a hole.
    pub in_cycle: Option<bool>,
    /// The code of the last canned cycle.
    pub cycle: Option<FunctionCode>,
    /// Tool changes so far.
    pub tool_changes: u32,
    /// How often words or texts have named a length of the tool, or taken it off.
    pub lengths_said: u32,
    /// The tool in the spindle.
    pub tool: Option<i64>,
    /// The tools between which the skip switch has decided, or between lengths of one.
    pub tools_by_switch: Option<[Option<i64>; 2]>,
    /// The offset that was called with it.
    pub tool_offset: Option<i64>,
    /// The length of the tool, as far as functions have called it or taken it off.
    pub length: Length,
    /// The offset that it was called with last; `None` when it is not known.
    pub called_offset: Option<i64>,
    /// The code of the work offset in force; `None` when it is not known.
    pub fixture: Option<FunctionCode>,
    /// The highest speed of the spindle, turns a minute, as far as the program has said it.
    pub speed_limit: Option<f64>,
    /// The code of the spindle range in force; `None` when it is not known.
    pub range: Option<FunctionCode>,
    /// How the spindle was last told to turn.
    pub rotation: Rotation,
    /// The control counts the second spindle of a lathe, or the main one; `None` where nothing
    /// has said it.
    pub side_is_counted: Option<bool>,
    /// What has lost the axes came back to where it began: a turning cycle of others.
    pub returned: bool,
    /// Tool changes by their function before the spindle was turned last.
    turned_behind: u32,
    /// A stop of the program came since the spindle was turned: some machines stop it, too.
    pub halted: bool,
    /// A function has clamped the rotary axes, and none has released them since, or only one
    /// that may be skipped.
    pub may_be_clamped: bool,
    /// S is a surface speed; `None` where nothing has said it, or only blocks that may be skipped.
    pub surface_speed: Option<bool>,
    /// S was a surface speed when that was known last.
    pub counted_surface: bool,
    /// X counts as the post writes it: on a lathe as a diameter, in a transformation as a radius.
    pub x_is_as_written: bool,
    /// A hole cycle or an arc of a SINUMERIK has left the plane that it alone needs.
    pub in_plane_of_its_own: bool,
    /// The code of the level that cycles return to; `None` when it is not known.
    pub return_level: Option<FunctionCode>,
    /// The program has ended: M2, M30.
    pub ended: bool,
    /// Letters whose last output value is not what the control has.
    doubts: Doubts,
    /// State and last output values before the blocks that may be skipped.
    before_skip: Option<Box<(ControlState, [f64; Letter::COUNT])>>,
}

impl ControlState {
    /// What a machine is taken to be in before its program says anything: modes
    /// that its settings name, no compensation, no cycle.
    pub fn at_start(feed_mode: FeedMode, plane: Option<Plane>, unit: Option<Unit>) -> Self {
        ControlState {
            motion: None,
            plane,
            distance: Some(Distance::Absolute),
            unit,
            feed_mode: Some(feed_mode),
            tip_control: Some(false),
            tilted: Some(false),
            compensation: Some(Compensation::Off),
            compensation_begun: false,
            compensation_ends: false,
            compensation_said: false,
            tool_said: false,
            in_cycle: Some(false),
            cycle: None,
            tool_changes: 0,
            lengths_said: 0,
            tool: None,
            tools_by_switch: None,
            tool_offset: None,
            length: Length::Unsaid,
            called_offset: None,
            fixture: None,
            speed_limit: None,
            range: None,
            rotation: Rotation::Unsaid,
            side_is_counted: None,
            returned: false,
            turned_behind: 0,
            halted: false,
            may_be_clamped: false,
            surface_speed: None,
            counted_surface: false,
            x_is_as_written: true,
            in_plane_of_its_own: false,
            return_level: None,
            ended: false,
            doubts: Doubts::default(),
            before_skip: None,
        }
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
    pub fn compensates(&self) -> bool {
        matches!(self.compensation, Some(Compensation::Left | Compensation::Right))
    }

    /// The next motion says all axes: they stand where they stood, as far as the post itself
    /// has brought them.
    pub fn doubt_axes(&mut self) {
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubt(letter));
    }

    /// The axes may have gone anywhere.
    pub fn lose_axes(&mut self) {
        self.returned = false;
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.lose(letter));
    }

    /// An axis may have gone anywhere.
    pub fn loses(&mut self, letter: Letter) {
        self.doubts.lose(letter);
    }

    /// The last output value of a letter is about to be made EMPTY: its axis has moved.
    pub fn remember(&mut self, letter: Letter, last: f64) {
        self.doubts.remember(letter, last);
    }

    /// An axis has not moved, and counts from another zero.
    pub fn shifts(&mut self, letter: Letter) {
        self.doubts.shift(letter);
    }

    /// The axes have not moved, and count from another zero.
    pub fn shift_axes(&mut self) {
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.shift(letter));
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

    /// A position of the machine has brought an axis clear of the part.
    pub fn clears(&mut self, letter: Letter) {
        self.doubts.clears(letter);
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
    pub(super) fn turn_axes(&mut self) {
        for letter in AXIS_LETTERS {
            if self.doubts.is_clear(letter) {
                self.doubts.clears(letter);
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

    /// Nothing is known any more.
    pub fn forget(&mut self) {
        let mut doubts = std::mem::take(&mut self.doubts);
        doubts.add_all();
        AXIS_LETTERS.into_iter().for_each(|letter| doubts.lose(letter));
        *self = ControlState {
            motion: None,
            plane: None,
            distance: None,
            unit: None,
            feed_mode: None,
            tip_control: None,
            tilted: None,
            compensation: None,
            compensation_begun: self.compensation_begun,
            compensation_ends: self.compensation_ends,
            compensation_said: self.compensation_said,
            tool_said: self.tool_said,
            in_cycle: None,
            cycle: None,
            tool_changes: self.tool_changes,
            lengths_said: self.lengths_said,
            tool: None,
            tools_by_switch: self.tools_by_switch,
            tool_offset: None,
            length: self.length,
            called_offset: self.called_offset,
            fixture: None,
            speed_limit: self.speed_limit,
            range: None,
            rotation: self.rotation.doubted(),
            side_is_counted: None,
            returned: false,
            turned_behind: self.turned_behind,
            halted: self.halted,
            may_be_clamped: self.may_be_clamped,
            surface_speed: None,
            counted_surface: self.counted_surface,
            x_is_as_written: false,
            in_plane_of_its_own: self.in_plane_of_its_own,
            return_level: None,
            ended: self.ended,
            doubts,
            before_skip: self.before_skip.take(),
        };
    }

    /// S may be a surface speed still, or turns by now: nobody has read what came behind it.
    pub fn surface_speed_is_open(&self) -> bool {
        self.surface_speed.is_none() && self.counted_surface
    }

    /// A tool is in the spindle now.
    pub fn has_tool(&mut self, tool: Option<i64>) {
        self.tool = tool;
        self.tools_by_switch = None;
    }

    /// Another program or subprogram begins: it may be called from anywhere.
    pub fn program_begins(&mut self) {
        self.ended = false;
        self.forget();
        // Its first motions are those of any program: where the tool stands is the caller's.
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubts.settle(letter));
    }

    /// The control may be in a threading move of varying lead, which the next one would go on
    /// from.
    pub fn goes_on_in_varying_lead(&self, commons: &Commons) -> bool {
        let code = commons.read(loc::THREAD_VARYING_CODE).and_then(FunctionCode::of_setting);
        let is_sinumerik = commons.read(loc::CONTROL_FAMILY) == loc::ControlFamily::Sinumerik;
        let own = is_sinumerik.then_some(VARYING_LEADS_OF_SINUMERIK);
        self.motion.is_some_and(|motion| {
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
        self.compensation_begun = true;
        self.compensation_ends = false;
    }
}
