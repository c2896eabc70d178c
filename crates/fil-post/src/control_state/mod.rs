//! What the control knows: the modes it is in and the words it has, as the tape
//! says. This is the only owner of modality.
//!
//! It learns from each block at the moment the block goes to the tape, whoever
//! made it: the post, POSTN, PREFUN, INSERT, the machine's own texts. What can't
//! be told is unknown (`None`), and whoever depends on it says it again.

mod codes;
mod levels;
pub(crate) mod text;

pub use codes::{Codes, Meaning};
pub use text::{TextWords, read as text_words};

use fil_machine::address::Addresses;
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Plane, Unit};
use fil_machine::{Commons, FunctionCode, Letter, letters};

use crate::block::Block;
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

/// A set of letters.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LetterSet(u32);

impl LetterSet {
    const ALL: LetterSet = LetterSet(u32::MAX);

    /// True when the letter is in it.
    #[inline]
    pub fn has(self, letter: Letter) -> bool {
        self.0 & 1 << letter.number() != 0
    }

    /// Adds a letter.
    #[inline]
    pub fn add(&mut self, letter: Letter) {
        self.0 |= 1 << letter.number();
    }

    /// Takes a letter out.
    #[inline]
    pub fn remove(&mut self, letter: Letter) {
        self.0 &= !(1 << letter.number());
    }

    /// True when no letter is in it.
    #[inline]
    pub fn is_empty(self) -> bool {
        self.0 == 0
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
    /// A canned cycle is in force: each position drills a hole.
    pub in_cycle: Option<bool>,
    /// The code of the last canned cycle.
    pub cycle: Option<FunctionCode>,
    /// Tool changes so far.
    pub tool_changes: u32,
    /// The tool in the spindle.
    pub tool: Option<i64>,
    /// The offset that was called with it.
    pub tool_offset: Option<i64>,
    /// The highest speed of the spindle, turns a minute, as far as the program has said it.
    pub speed_limit: Option<f64>,
    /// The code of the spindle range in force; `None` when it is not known.
    pub range: Option<FunctionCode>,
    /// How the spindle was last told to turn.
    pub rotation: Rotation,
    /// The code of the level that cycles return to; `None` when it is not known.
    pub return_level: Option<FunctionCode>,
    /// The program has ended: M2, M30.
    pub ended: bool,
    /// Letters whose last output value is not what the control has.
    doubtful: LetterSet,
    /// Axes that a text or POSTN has sent to a point of the machine (G28, G30, G53), as far as
    /// they are in doubt: their last output values are no positions in the program.
    at_machine_point: LetterSet,
    /// State and last output values before the blocks that may be skipped.
    before_skip: Option<Box<(ControlState, [f64; Letter::COUNT])>>,
    /// Where X, Y and Z may stand behind blocks that may be skipped.
    levels: [Option<Levels>; 3],
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
            in_cycle: Some(false),
            cycle: None,
            tool_changes: 0,
            tool: None,
            tool_offset: None,
            speed_limit: None,
            range: None,
            rotation: Rotation::Unsaid,
            return_level: None,
            ended: false,
            doubtful: LetterSet::default(),
            at_machine_point: LetterSet::default(),
            before_skip: None,
            levels: [None; 3],
        }
    }

    /// True when the control is known to have the last output value of a letter.
    #[inline]
    pub fn has_last(&self, letter: Letter) -> bool {
        !self.doubtful.has(letter)
    }

    /// True when some letter's last output value is in doubt.
    #[inline]
    pub fn has_doubts(&self) -> bool {
        !self.doubtful.is_empty()
    }

    /// The last output value of a letter is not what the control has.
    pub fn doubt(&mut self, letter: Letter) {
        if !self.doubtful.has(letter) {
            self.at_machine_point.remove(letter);
        }
        self.doubtful.add(letter);
    }

    /// An axis was last sent to a point of the machine, and has no position in the program.
    pub fn is_at_machine_point(&self, letter: Letter) -> bool {
        self.at_machine_point.has(letter) && self.doubtful.has(letter)
    }

    /// Axes that a block has sent to a point of the machine.
    fn sent_to_machine_point(&mut self, letters: impl Iterator<Item = Letter>) {
        for letter in letters.filter(|letter| AXIS_LETTERS.contains(letter)) {
            self.doubt(letter);
            self.at_machine_point.add(letter);
        }
    }

    /// Every letter is in doubt.
    fn doubt_all(&mut self) {
        self.at_machine_point.0 &= self.doubtful.0;
        self.doubtful = LetterSet::ALL;
    }

    /// The control has the last output value of a letter after all.
    pub fn trust(&mut self, letter: Letter) {
        self.doubtful.remove(letter);
    }

    /// Cutter compensation is on.
    pub fn compensates(&self) -> bool {
        matches!(self.compensation, Some(Compensation::Left | Compensation::Right))
    }

    /// Where the axes stand is not known.
    pub fn doubt_axes(&mut self) {
        AXIS_LETTERS.into_iter().for_each(|letter| self.doubt(letter));
    }

    /// Nothing is known any more.
    pub fn forget(&mut self) {
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
            in_cycle: None,
            cycle: None,
            tool_changes: self.tool_changes,
            tool: None,
            tool_offset: None,
            speed_limit: self.speed_limit,
            range: None,
            rotation: self.rotation.doubted(),
            return_level: None,
            ended: self.ended,
            doubtful: LetterSet::ALL,
            at_machine_point: LetterSet(self.at_machine_point.0 & self.doubtful.0),
            before_skip: self.before_skip.take(),
            levels: self.levels,
        };
    }

    /// Another program or subprogram begins: it may be called from anywhere.
    pub fn program_begins(&mut self) {
        self.ended = false;
        self.forget();
    }

    /// Learns from a block of words.
    #[inline]
    pub fn learn_block(&mut self, block: &Block, codes: &Codes, addresses: &Addresses) {
        if !block.g_codes().is_empty() {
            for (code, _) in block.g_codes() {
                self.learn_code(*code, codes);
            }
        }
        for (code, _) in block.m_codes() {
            self.learn_auxiliary(*code, codes);
        }
        if !self.doubtful.is_empty() {
            self.trust_words(block, addresses);
        }
        if self.distance != Some(Distance::Absolute) {
            self.doubt_axes();
        }
    }

    /// The control has the words of a block.
    fn trust_words(&mut self, block: &Block, addresses: &Addresses) {
        let letters = block.positions().filter_map(|at| addresses.slot(at).letter);
        letters.for_each(|letter| self.doubtful.remove(letter));
    }

    /// Learns from words that were written one after the other (POSTN). In a cycle they
    /// may have changed its data.
    pub fn learn_words(
        &mut self,
        words: impl Iterator<Item = (Letter, f64)> + Clone,
        codes: &Codes,
    ) {
        let mut frame = false;
        let cycle = self.in_cycle != Some(false);
        for (letter, value) in words.clone() {
            match (letter, FunctionCode::of_value(value)) {
                (letters::G, Some(code)) => {
                    frame |= matches!(codes.meaning(code), Meaning::Frame | Meaning::Tilt);
                    self.learn_code(code, codes);
                }
                (letters::M, Some(code)) => {
                    frame |= code == TOOL_CHANGE;
                    self.learn_auxiliary(code, codes);
                }
                (letters::T, _) => self.tool = None,
                _ if cycle => self.doubt(letter),
                _ => self.trust(letter),
            }
        }
        let has =
            |letters: &[u8]| words.clone().any(|(letter, _)| letters.contains(&letter.byte()));
        let cycle = cycle || self.in_cycle != Some(false);
        // In a cycle a position drills, and its level can be one too.
        let drills = cycle && has(b"XYZABCR");
        if frame || drills || has(b"UVW") || self.distance != Some(Distance::Absolute) {
            self.doubt_axes();
        }
        if words.clone().any(goes_to_machine_point) {
            self.sent_to_machine_point(words.map(|(letter, _)| letter));
        }
    }

    /// Learns what a preparatory function does.
    #[inline]
    pub fn learn_code(&mut self, code: FunctionCode, codes: &Codes) {
        match codes.meaning(code) {
            Meaning::Motion => {
                self.motion = Some(code);
                if codes.motion_ends_cycle() {
                    self.in_cycle = Some(false);
                } else if self.in_cycle == Some(true) && !codes.keeps_cycles() {
                    // Some controls leave the cycle, some don't.
                    self.in_cycle = None;
                }
            }
            Meaning::Plane(plane) => self.plane = Some(plane),
            Meaning::Distance(distance) => self.distance = Some(distance),
            Meaning::Unit(unit) => {
                if self.unit != Some(unit) {
                    self.doubt_all();
                }
                self.unit = Some(unit);
            }
            Meaning::FeedMode(mode) => {
                // Some controls forget F even when the mode stays.
                self.doubt(letters::F);
                self.feed_mode = Some(mode);
            }
            Meaning::Compensation(side) => {
                self.compensation = Some(side);
                self.compensation_begun = false;
            }
            Meaning::Cycle => {
                self.in_cycle = Some(true);
                self.cycle = Some(code);
                self.motion = None;
            }
            Meaning::CycleOff => {
                self.in_cycle = Some(false);
                self.motion = None;
            }
            Meaning::OneBlock => {}
            Meaning::ReturnLevel => {
                self.return_level = Some(code);
                self.doubt(letters::R);
            }
            Meaning::Turning => {
                self.motion = None;
                self.doubt_axes();
                self.doubt(letters::F);
            }
            Meaning::ToolLength => {
                self.doubt(letters::XYZ[2]);
                if self.tip_control != Some(false) {
                    self.tip_control = Some(false);
                    self.doubt_axes();
                }
            }
            Meaning::TipControl => {
                self.tip_control = Some(true);
                self.doubt_axes();
            }
            Meaning::Frame => self.doubt_axes(),
            Meaning::Tilt => {
                self.tilted = None;
                self.doubt_axes();
            }
            Meaning::Unknown => self.forget(),
        }
    }

    /// The control may be in a threading move of varying lead, which the next one would go on
    /// from.
    pub fn goes_on_in_varying_lead(&self, commons: &Commons) -> bool {
        let code = commons.read(loc::THREAD_VARYING_CODE).and_then(FunctionCode::of_setting);
        code.is_some() && self.motion == code
    }

    /// Learns what an auxiliary function does. A call of a subprogram may do anything.
    pub fn learn_auxiliary(&mut self, code: FunctionCode, codes: &Codes) {
        const END: [FunctionCode; 2] = [FunctionCode::whole(2), FunctionCode::whole(30)];
        const CALLS: [FunctionCode; 4] = [
            FunctionCode::whole(97),
            FunctionCode::whole(98),
            FunctionCode::whole(99),
            FunctionCode::whole(198),
        ];
        self.ended |= END.contains(&code);
        if let Some(rotation) = codes.rotation(code) {
            self.rotation = rotation;
        }
        if codes.is_spindle_range(code) {
            self.range = Some(code);
        }
        if code == TOOL_CHANGE {
            self.tool = None;
            self.tool_changes += 1;
        }
        if CALLS.contains(&code) {
            self.forget();
        }
    }

    /// Learns from a text that was written as it is; what can't be read makes all
    /// unknown.
    pub fn learn_text(&mut self, text: &str, codes: &Codes) {
        match text::read(text) {
            Some(words) => self.learn_text_words(&words, codes),
            None => self.forget(),
        }
    }

    /// Learns from the words of a text.
    pub(crate) fn learn_text_words(&mut self, words: &text::TextWords, codes: &Codes) {
        let before = words.skipped.then(|| self.clone());
        if words.calls_subprogram() {
            self.forget();
        }
        for (letter, value) in &words.words {
            match (*letter, FunctionCode::of_value(*value)) {
                (letters::G, Some(code)) => self.learn_code(code, codes),
                (letters::G | letters::M, None) => self.forget(),
                (letters::M, Some(code)) => {
                    if code == TOOL_CHANGE {
                        self.doubt_axes();
                    }
                    self.learn_auxiliary(code, codes);
                }
                (letters::T, _) => self.tool = None,
                (letter, _) if AXIS_LETTERS.contains(&letter) => self.doubt_axes(),
                (letter, _) => self.doubt(letter),
            }
        }
        if words.words.iter().copied().any(goes_to_machine_point) {
            self.sent_to_machine_point(words.words.iter().map(|(letter, _)| *letter));
        }
        if let Some(before) = before {
            self.agree_with(&before);
        }
    }

    /// A line has been run in the plane: compensation that was switched on has begun.
    #[inline]
    pub fn moved_in_plane(&mut self) {
        self.compensation_begun = true;
    }

    /// The blocks from here on may be skipped.
    pub fn skip_begins(&mut self, commons: &Commons) {
        let before = (self.clone(), last_values(commons));
        self.before_skip = Some(Box::new(before));
    }

    /// The blocks that may be skipped are over: what they changed is unknown. `linear` are
    /// the letters of X, Y and Z, whose levels with those blocks and without are kept. Of
    /// two levels of Z the lower one counts as the last value, so that a rapid motion goes
    /// up before it goes across; on an axis that counts downwards the higher one does.
    pub fn skip_ends(&mut self, commons: &mut Commons, linear: [Letter; 3], z_counts_down: bool) {
        let Some(before) = self.before_skip.take() else { return };
        let (state, values) = *before;
        let now = last_values(commons);
        let levels = linear.map(|letter| {
            let at = |state: &ControlState, values: &[f64]| {
                let value = values[letter.index() - 1];
                state.levels(letter, value).unwrap_or(Levels::of(letter, value))
            };
            at(self, &now).or(at(&state, &values))
        });
        for (letter, (now, then)) in Letter::all().zip(now.iter().zip(values)) {
            if *now != then {
                self.doubt(letter);
            }
        }
        if let Some(last) = levels[2].lowest(z_counts_down) {
            commons.set_last_output(linear[2], last);
        }
        self.agree_with(&state);
        self.levels = levels.map(|levels| levels.behind(commons));
    }

    /// Where an axis may stand behind blocks that may be skipped, values of the tape;
    /// `None` where the switch leaves no doubt of it. `last` is its last output value.
    pub fn levels(&self, letter: Letter, last: f64) -> Option<Levels> {
        if self.has_last(letter) {
            return None;
        }
        let mut levels = self.levels.iter().flatten();
        levels.find(|levels| levels.letter == letter && levels.counts_from(last)).copied()
    }

    /// True while blocks may be skipped.
    pub fn may_be_skipped(&self) -> bool {
        self.before_skip.is_some()
    }

    /// Keeps what is the same in another state; the rest is unknown.
    fn agree_with(&mut self, other: &ControlState) {
        fn agree<T: PartialEq>(value: &mut Option<T>, other: &Option<T>) {
            if *value != *other {
                *value = None;
            }
        }
        agree(&mut self.motion, &other.motion);
        agree(&mut self.plane, &other.plane);
        agree(&mut self.distance, &other.distance);
        agree(&mut self.unit, &other.unit);
        agree(&mut self.feed_mode, &other.feed_mode);
        agree(&mut self.tip_control, &other.tip_control);
        agree(&mut self.tilted, &other.tilted);
        agree(&mut self.compensation, &other.compensation);
        agree(&mut self.in_cycle, &other.in_cycle);
        agree(&mut self.cycle, &other.cycle);
        agree(&mut self.tool, &other.tool);
        agree(&mut self.tool_offset, &other.tool_offset);
        agree(&mut self.speed_limit, &other.speed_limit);
        agree(&mut self.range, &other.range);
        agree(&mut self.return_level, &other.return_level);
        self.rotation = self.rotation.or(other.rotation);
        self.compensation_begun &= other.compensation_begun;
        let of_both = other.at_machine_point.0 & other.doubtful.0;
        self.at_machine_point.0 &= self.doubtful.0 & of_both;
        self.doubtful.0 |= other.doubtful.0;
    }
}

/// The functions that go to a point of the machine: its home and other points, and its frame.
fn goes_to_machine_point((letter, value): (Letter, f64)) -> bool {
    letter == letters::G && [28.0, 30.0, 53.0].contains(&value)
}

fn last_values(commons: &Commons) -> [f64; Letter::COUNT] {
    let mut values = [0.0; Letter::COUNT];
    for (value, letter) in values.iter_mut().zip(Letter::all()) {
        *value = commons.last_output(letter);
    }
    values
}
