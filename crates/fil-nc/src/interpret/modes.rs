//! Modal functions, tool, spindle and coolant.

use super::state::State;
use super::words::{Words, letter};
use super::{Fault, osp_thread};
use crate::dialect::{Auxiliary, Family, Function, Group, Habit, Role, ToolCall};
use crate::errors::NcCode;
use crate::motion::{Compensation, DRILLED, Event, FOOT, Modes, Speed, Spindle, StartMode};
use crate::work_offsets::{WORD_OFFSETS, numbered_offset};

pub(super) const H: u8 = letter(b'H');
const P: u8 = letter(b'P');
const Q: u8 = letter(b'Q');
const S: u8 = letter(b'S');
const T: u8 = letter(b'T');

/// M0 and M1.
const STOPS: [u32; 2] = [0, 1];

impl State<'_> {
    /// Takes up all modal functions but the motion.
    pub(super) fn modes(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some(Function::Units { metric }) = words.function(Group::Units) {
            self.certain.say(StartMode::Unit);
            if self.metric != metric {
                self.feed.word = None;
            }
            self.set_metric(metric);
        }
        if let Some(Function::Feed(mode)) = words.function(Group::Feed) {
            self.certain.say(StartMode::Feed);
            if self.feed.mode != mode {
                self.feed.word = None;
            }
            self.feed.mode = mode;
        }
        if let Some(Function::Plane(normal)) = words.function(Group::Plane) {
            self.plane = normal;
            self.say_plane(normal);
            self.certain.say(StartMode::Plane);
        }
        if let Some(Function::Positions { absolute }) = words.function(Group::Positions) {
            self.absolute = absolute;
            self.certain.say(StartMode::Positions);
        }
        if let Some(Function::Return { initial }) = words.function(Group::Return) {
            self.cycle.returns_initial = initial;
            self.certain.say(StartMode::ReturnLevel);
        }
        self.work_offset(words)?;
        if words.function(Group::PathControl).is_some() {
            self.modes.path_control = Some(self.line);
            // LinuxCNC: `G64 P0.1 Q0.05`, how far the path may leave its corners.
            if words.peek(Group::Once).is_none() {
                words.take_number(P);
                words.take_number(Q);
            }
        }
        if words.function(Group::Diameter).is_some() {
            self.certain.say(StartMode::Diameter);
        }
        self.offsets(words)
    }

    /// A work offset by its code, by its code and a number, or by a word.
    fn work_offset(&mut self, words: &mut Words) -> Result<(), Fault> {
        let function = words.function(Group::Fixture);
        match function {
            Some(Function::Fixture(code)) => self.fixture(code),
            Some(Function::NumberedFixture(tenths)) => {
                let number = words.take_whole(self.dialect.letter(Role::FixtureNumber))?;
                let missing =
                    || Fault::new(NcCode::MissingWord, "the work offset needs its number");
                self.fixture(numbered_offset(tenths, number.ok_or_else(missing)?));
            }
            _ => {}
        }
        let by_word =
            self.dialect.letter(Role::FixtureWord) > 0 && words.peek(Group::Length).is_none();
        if by_word && let Some(number) = words.take_whole(self.dialect.letter(Role::FixtureWord))? {
            if function.is_some() {
                return Err(Fault::new(NcCode::Twice, "two work offsets in one block"));
            }
            self.fixture(WORD_OFFSETS + number);
        }
        Ok(())
    }

    /// The work offset is another one than that in force, or nobody has said which that is.
    pub(super) fn moves_fixture(&self, code: u32) -> bool {
        self.modes.frame.fixture != Some(code)
    }

    /// Another work offset: where the axes stand in it is not known.
    pub(super) fn fixture(&mut self, code: u32) {
        if self.moves_fixture(code) {
            // C of a spindle that turns counts from nothing.
            let turns = self.dialect.turning.live_at_start.is_some() && !self.live.is_on;
            let counts =
                |axis: &usize| self.dialect.axes[*axis].scale.is_some() && !(turns && *axis > 2);
            for axis in (0..5).filter(counts) {
                self.known[axis] = false;
            }
        }
        self.modes.frame.fixture = Some(code);
    }

    /// Cutter compensation and tool length.
    fn offsets(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some(Function::Compensation(side)) = words.function(Group::Compensation) {
            let offset = match side {
                Compensation::Off => None,
                _ => words.take_whole(self.dialect.letter(Role::ToolOffset))?,
            };
            self.compensate(side, offset)?;
        }
        let says_length = words.function(Group::Length);
        self.modes.length.uncalled &= says_length.is_none();
        match says_length {
            Some(Function::Length(true)) => {
                let offset = words.take_whole(H)?;
                let missing = || Fault::new(NcCode::MissingWord, "the length offset needs its H");
                self.modes.length.offset = Some(offset.ok_or_else(missing)?);
                self.modes.length.stray = None;
                self.length_is_on = true;
                let along_z = self.dialect.takes_up_lengths_along_z();
                self.modes.length.plane = self.plane_but(DRILLED).filter(|_| along_z);
            }
            Some(Function::TipControl) => self.begin_tip_control(words, false)?,
            Some(Function::TipControlByDirection) => self.begin_tip_control(words, true)?,
            Some(_) => {
                words.take_whole(H)?;
                self.modes.length.offset = None;
                self.modes.length.stray = None;
                self.modes.length.plane = None;
                self.end_tip_control();
            }
            // A tool change may end the function: then H alone is not certain to act.
            // In a threading cycle H counts passes, or is the height; beside G16 it is a zero.
            None if matches!(
                words.peek(Group::Once),
                Some(
                    Function::ThreadPassesByPitch
                        | Function::ThreadPassesByHeight
                        | Function::EndOfTravel
                )
            ) => {}
            None if self.modes.length.offset.is_some() && words.has(H) => {
                let offset = words.take_whole(H)?;
                self.modes.length.offset = offset.filter(|_| self.length_is_on);
                self.modes.length.stray = offset.filter(|_| !self.length_is_on);
            }
            None => {}
        }
        Ok(())
    }

    /// Speed, tool and M words. S is the speed of the live tool where the main spindle is
    /// an axis.
    pub(super) fn tool_and_spindle(&mut self, words: &mut Words) -> Result<(), Fault> {
        if let Some(Function::Surface(on)) = words.function(Group::Surface) {
            if on != self.surface {
                self.modes.spindle.speed = None;
            }
            self.surface = on;
            self.certain.say(StartMode::Surface);
            let letter = self.dialect.letter(Role::SpeedLimit);
            if on && letter > 0 {
                self.modes.spindle.speed_limit = words.take(letter)?;
            }
        }
        if words.peek(Group::Once) == Some(Function::SpeedLimit) {
            words.function(Group::Once);
            self.limit_speed(words)?;
        }
        let orients = words.auxiliaries.iter().any(|(a, _)| *a == Auxiliary::Orient);
        let orientation = match self.dialect.letter(Role::Orientation) {
            letter if orients && letter > 0 => words.take(letter)?,
            _ => None,
        };
        let stops = words.auxiliaries.iter().any(|(a, _)| *a == Auxiliary::SpindleOff);
        let oriented = orients || stops;
        if let Some(speed) = words.take(S)?.filter(|_| !oriented) {
            self.modes.spindle.speed = Some(match self.surface {
                true => Speed::Surface(speed * if self.metric { 1.0 } else { FOOT }),
                false => Speed::Turns(speed),
            });
        }
        self.live_speed(words)?;
        self.tool(words)?;
        self.check_choice(words)?;
        let of_live_tool = self.selects_live_tool(words)?;
        for (auxiliary, _) in &words.auxiliaries {
            match auxiliary {
                Auxiliary::Clockwise if of_live_tool => {
                    self.turn_live_tool(Spindle::Clockwise)?;
                }
                Auxiliary::Counterclockwise if of_live_tool => {
                    self.turn_live_tool(Spindle::Counterclockwise)?;
                }
                Auxiliary::SpindleOff if of_live_tool => self.turn_live_tool(Spindle::Off)?,
                Auxiliary::Counts(side) => self.count(*side)?,
                Auxiliary::Side(turn) => self.turn_one(true, *turn),
                Auxiliary::CAxis(on, code) => self.change_spindle(*on, *code)?,
                Auxiliary::Live(turn) => self.turn_live_tool(*turn)?,
                Auxiliary::Clockwise if self.live.is_on => self.turn_main(Spindle::Clockwise)?,
                Auxiliary::Counterclockwise if self.live.is_on => {
                    self.turn_main(Spindle::Counterclockwise)?;
                }
                Auxiliary::SpindleOff if self.live.is_on => self.turn_main(Spindle::Off)?,
                Auxiliary::Clockwise => self.turn_one(false, Spindle::Clockwise),
                Auxiliary::Counterclockwise => self.turn_one(false, Spindle::Counterclockwise),
                Auxiliary::SpindleOff => self.turn_one(false, Spindle::Off),
                Auxiliary::Orient => {
                    self.turn_spindle(Spindle::Off);
                    self.modes.spindle.orientation = orientation;
                }
                Auxiliary::SpindleRange(range) => self.modes.spindle.range = Some(*range),
                Auxiliary::Coolant { code, .. } => self.cool(Some(*code)),
                Auxiliary::CoolantOff(code) => self.cool_off(*code),
                _ => {}
            }
        }
        Ok(())
    }

    /// The highest speed by S. X and Z beside the function place the zero: where the axes stand in
    /// it is not followed.
    fn limit_speed(&mut self, words: &mut Words) -> Result<(), Fault> {
        let placed = words.take_axes(self.dialect)?;
        for word in placed.iter() {
            self.known[word.axis] = false;
        }
        if !placed.is_empty() {
            self.modes.frame.moved_zero = Some(self.line);
        }
        let missing = || Fault::new(NcCode::MissingWord, "the speed limit needs its S");
        match words.take(S)? {
            Some(limit) => self.modes.spindle.speed_limit = Some(limit),
            None if placed.is_empty() => return Err(missing()),
            None => {}
        }
        Ok(())
    }

    pub(super) fn turn_spindle(&mut self, spindle: Spindle) {
        self.modes.spindle.turn = spindle;
        self.modes.spindle.orientation = None;
        self.modes.unsaid.spindle = false;
    }

    /// Switches the coolant of a function on, or all of it off.
    pub(super) fn cool(&mut self, coolant: Option<u32>) {
        self.modes.coolant = coolant;
        self.modes.unsaid.coolant = false;
    }

    /// A function that ends coolants: one with a function of its own goes on.
    pub(super) fn cool_off(&mut self, code: u32) {
        let flowing = self.modes.coolant.map(|flowing| self.dialect.auxiliary(i64::from(flowing)));
        match flowing {
            Some(Auxiliary::Coolant { off: Some(own), .. }) if own != code => {}
            _ => self.cool(None),
        }
    }

    /// A change or a stop, where many machines stop spindle and coolant.
    fn leaves_unsaid(&mut self) {
        self.modes.unsaid.spindle = true;
        self.modes.unsaid.coolant = true;
    }

    /// An auxiliary function that is told as it is.
    pub(super) fn tell_auxiliary(&mut self, code: u32) {
        self.events.push(Event::Auxiliary { line: self.line, code });
        if STOPS.contains(&code) {
            self.leaves_unsaid();
        }
    }

    /// Switches cutter compensation.
    ///
    /// # Errors
    /// It was switched before, and nothing has moved since: controls differ in where the cutter
    /// goes then.
    pub(super) fn compensate(
        &mut self,
        side: Compensation,
        offset: Option<u32>,
    ) -> Result<(), Fault> {
        let switches = side != self.modes.compensation.side;
        if switches && side != Compensation::Off && self.since.compensation_rests {
            let message = "cutter compensation is switched twice, and nothing moves in between";
            return Err(Fault::new(NcCode::NoMeaning, message));
        }
        self.since.compensation_rests |= switches;
        self.modes.compensation.side = side;
        self.modes.compensation.offset = offset;
        Ok(())
    }

    /// Tells the auxiliary functions other than those of spindle, coolant and tool, and of a thread.
    pub(super) fn auxiliaries(&mut self, words: &Words) {
        for (auxiliary, _) in &words.auxiliaries {
            if let Auxiliary::Other(code) = auxiliary {
                if osp_thread::takes(words, *code) {
                    continue;
                }
                self.switch_way_out(*code);
                self.tell_auxiliary(*code);
            }
        }
    }

    fn tool(&mut self, words: &mut Words) -> Result<(), Fault> {
        let named = words.take_whole(T)?;
        let changes = words.auxiliaries.iter().any(|(a, _)| *a == Auxiliary::ToolChange);
        match (self.dialect.forms.tool_call, named) {
            (ToolCall::WithOffset, Some(number)) => {
                let (nose, number) = match self.dialect.has(Habit::NamesNoses) {
                    true => (number / 10_000, number % 10_000),
                    false => (number % 100, number),
                };
                if nose != number % 100 {
                    let message = "T takes the nose of another offset than its own";
                    return Err(Fault::new(NcCode::NoMeaning, message));
                }
                self.modes.length.offset = Some(number % 100).filter(|offset| *offset > 0);
                self.change(number / 100);
            }
            (ToolCall::Word, Some(number)) => self.change(number),
            (ToolCall::WithCode, Some(number)) => self.next_tool = Some(number),
            (_, None) => {}
        }
        if changes && self.dialect.forms.tool_call == ToolCall::WithCode {
            let next = self.next_tool.take();
            let missing =
                || Fault::new(NcCode::MissingWord, "no T word names the tool to change to");
            self.change(next.ok_or_else(missing)?);
        }
        Ok(())
    }

    pub(super) fn change(&mut self, tool: u32) {
        let modes = Modes { cycle: self.cycle.active.is_some(), ..self.modes };
        self.events.push(Event::ToolChange { line: self.line, tool, modes });
        self.length_is_on = false;
        self.modes.length.uncalled = self.dialect.has(Habit::CallsLengths);
        if self.modes.tool != tool && self.dialect.family != Family::WordAddress {
            // The change is a program of the builder, which may leave the axes elsewhere, and
            // brings the length of the tool: its tip is not where the last one was.
            self.known[..3].fill(false);
        }
        self.modes.tool = tool;
        if self.dialect.forms.tool_call == ToolCall::WithCode
            || self.dialect.family == Family::Klartext
        {
            self.leaves_unsaid();
        }
    }
}
