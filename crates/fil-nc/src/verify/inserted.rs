//! What a block of INSERT switches, the CL file asks for.

use super::ahead::Steps;
use super::delayed::DelayedMode;
use super::modes::Expected;
use super::settings::{Due, Settings};
use super::verifier::Verifier;
use crate::dialect::{Auxiliary, Family, Function, Role};
use crate::interpret::sinumerik_words::{self, Value};
use crate::motion::{Compensation, Speed, Spindle};
use crate::text::{Block, Word, read_block};
use crate::work_offsets::numbered_offset;

/// The T word of a turning tool is its number times this, and its offset.
const TOOLS_STEP: i64 = 100;

impl<C: Steps> Verifier<'_, C> {
    /// A block of words that the CL file names may be here.
    pub(super) fn may_have(&mut self, words: &str) {
        self.pass_own();
        let next = self.nc.line(self.next).unwrap_or(u32::MAX);
        self.own.may_have(words, [self.last_line(), next]);
    }

    /// The auxiliary functions among words of the user's own must be there.
    pub(super) fn ask_words(&mut self, cl_line: u32, text: &str) {
        self.may_have(text);
        let Ok(block) = read_block(text.as_bytes(), "POSTN", 1) else { return };
        for word in block.words.iter().filter(|word| word.letter == b'M') {
            let code = word.number.digits;
            let Auxiliary::Other(code) = self.settings.dialect.auxiliary(code) else { continue };
            self.ask_auxiliary(cl_line, Some(code));
        }
    }
}

impl Expected {
    /// Takes up what the words of a text switch; of a text that can't be read the program
    /// is refused anyway.
    pub(super) fn insert(&mut self, text: &str, settings: &Settings) {
        let mut line = settings.dialect.text.marks.read(text.as_bytes()).into_owned();
        match settings.dialect.family {
            Family::WordAddress => {}
            Family::Klartext => line = functions_of_klartext(&line),
            Family::Sinumerik => line = self.insert_statements(&line),
        }
        let Ok(block) = read_block(&line, "INSERT", 1) else { return };
        self.insert_change(&block, text, settings);
        for word in &block.words {
            let number = word.number;
            match word.letter {
                b'G' => {
                    let tenths = (number.value() * 10.0).round() as i64;
                    if let Some(function) = settings.dialect.function(tenths) {
                        self.insert_function(function, &block, settings);
                    }
                }
                b'M' if number.decimals == 0 => {
                    self.insert_auxiliary(settings.dialect.auxiliary(number.digits));
                }
                // The offset of a turning tool stands in its T word.
                b'T' if settings.calls_tools_with_offset() => {
                    let offset = u32::try_from(number.digits % TOOLS_STEP).ok();
                    self.length.require(offset.filter(|offset| *offset > 0), Due::Now);
                }
                b'S' => self.insert_speed(number.value(), settings),
                _ => {}
            }
        }
    }

    /// The length offset of the tool that a text changes to has its number, where the text calls
    /// no other.
    fn insert_change(&mut self, block: &Block, text: &str, settings: &Settings) {
        let changes = |word: &Word| {
            word.letter == b'M'
                && settings.dialect.auxiliary(word.number.digits) == Auxiliary::ToolChange
        };
        let tool = block.words.iter().find(|word| word.letter == b'T');
        let tool = tool.and_then(|word| u32::try_from(word.number.digits).ok());
        let changes = block.words.iter().any(changes) || settings.changes_tool(text);
        if settings.calls_offsets() && tool.is_some() && changes {
            self.length.require(tool, Due::WithZ);
        }
    }

    /// S of a text.
    pub(super) fn insert_speed(&mut self, speed: f64, settings: &Settings) {
        // Turns or surface speed: the text need not say it.
        let is_either = settings.dialect.has_surface_speed();
        self.spindle.speed.set(Some(Speed::Turns(speed)).filter(|_| !is_either), Due::Now);
        self.naming.has_speed = true;
    }

    /// Takes up what a SINUMERIK says by names, and functions that no setting names; gives the
    /// words of one letter.
    fn insert_statements(&mut self, line: &[u8]) -> Vec<u8> {
        let mut plain = Vec::new();
        for word in sinumerik_words::read(line).unwrap_or_default() {
            match (word.name.as_str(), &word.value) {
                ("T", Some(_)) => self.length.require(None, Due::Now),
                ("D", Some(Value::Number(0.0))) => self.give_length_up(),
                ("D", Some(Value::Number(edge))) => {
                    self.tool.loaded_offset = None;
                    self.length.require(Some(*edge as u32), Due::Now);
                }
                ("LIMS", Some(Value::Number(limit))) => {
                    self.spindle.speed_limit = Some(Some(*limit))
                }
                (name, Some(_)) if name.starts_with("SPOS") => self.insert_stop(),
                ("G", Some(Value::Number(500.0))) => self.fixture.must = Some(Some(500)),
                ("M", Some(Value::Number(70.0))) => self.insert_stop(),
                _ => {}
            }
            if word.name.len() == 1 && !word.assigned {
                plain.extend_from_slice(&line[word.range]);
            }
        }
        plain
    }

    /// A text takes the length of the tool off, as on a way to a point of the machine. What the CL
    /// file moves behind it has the length that was asked for, from the next way of Z on.
    fn give_length_up(&mut self) {
        let asked = self.length.asked().flatten();
        self.length = DelayedMode::new(Some(None));
        self.length.require(asked, Due::WithZ);
    }

    /// The spindle stands, at whatever angle.
    pub(super) fn insert_stop(&mut self) {
        self.spindle.turn_now(None);
    }

    fn insert_function(&mut self, function: Function, block: &Block, settings: &Settings) {
        let whole = |letter: u8| {
            let word = block.words.iter().find(|word| word.letter == letter)?;
            u32::try_from(word.number.digits).ok().filter(|_| word.number.decimals == 0)
        };
        let printed = |letter: u8| letter + b'A' - 1;
        match function {
            Function::Fixture(code) => self.fixture.must = Some(Some(code)),
            Function::NumberedFixture(tenths) => {
                let number = whole(printed(settings.dialect.letter(Role::FixtureNumber)));
                self.fixture.must = number.map(|number| Some(numbered_offset(tenths, number)));
            }
            Function::Compensation(side) => {
                let offset = whole(printed(settings.dialect.letter(Role::ToolOffset)));
                let offset = offset.filter(|_| side != Compensation::Off);
                self.compensation.require((side, offset), Due::Now);
            }
            Function::Plane(normal) => self.plane.named = normal,
            Function::Length(true) => self.length.require(whole(b'H'), Due::Now),
            Function::Length(false) => self.give_length_up(),
            Function::SpeedLimit => self.spindle.speed_limit = None,
            // G94 and G95 of a SINUMERIK end G96, which is one of their group.
            Function::Feed(_)
                if settings.has_edges()
                    && self.spindle.speed.asked().is_some_and(|speed| speed.turns().is_none()) =>
            {
                self.spindle.speed.set(None, Due::Now);
            }
            // The S of the other mode, which the text need not say, comes with it.
            Function::Surface(on) => {
                self.spindle.speed.set(None, Due::Now);
                if on && settings.limit_comes_with_surface() {
                    self.spindle.speed_limit = None;
                }
            }
            _ => {}
        }
    }

    /// What an auxiliary function switches, in a text or by AUXFUN.
    pub(super) fn insert_auxiliary(&mut self, auxiliary: Auxiliary) {
        self.restarts.insert(auxiliary);
        // Under a live tool with functions of its own these are of the main spindle, the axis C.
        let turns = [Auxiliary::Clockwise, Auxiliary::Counterclockwise, Auxiliary::SpindleOff];
        if self.mills() && self.mode.live_has_own_codes && turns.contains(&auxiliary) {
            return;
        }
        let spindle = &mut self.spindle;
        match auxiliary {
            Auxiliary::Clockwise => spindle.turn_now(Some(Spindle::Clockwise)),
            Auxiliary::Counterclockwise => spindle.turn_now(Some(Spindle::Counterclockwise)),
            Auxiliary::SpindleOff => spindle.turn_now(Some(Spindle::Off)),
            Auxiliary::Live(turns) => spindle.turn_now(Some(turns)),
            Auxiliary::Orient => spindle.turn_now(None),
            Auxiliary::SpindleRange(range) => spindle.range = Some(range),
            Auxiliary::Coolant { code, .. } => self.coolant.require(Some(code), Due::Now),
            Auxiliary::CoolantOff(_) => self.coolant.require(None, Due::Now),
            _ => {}
        }
    }

    /// A tool that a block of INSERT or of the settings changes to.
    pub(super) fn insert_tool(&mut self, tool: u32) {
        self.restarts.stop();
        self.tool.number = Some(tool);
        self.tool.loaded = Some(tool);
        // A post does not trust it: LOADTL of the same tool changes it again.
        self.tool.loaded_offset = None;
    }
}

/// The M functions of a line of Klartext and the speed of a TOOL CALL; none of a line with a number
/// of block delete, which is no line of it.
fn functions_of_klartext(line: &[u8]) -> Vec<u8> {
    let is_numbered = line.first() == Some(&b'/') && line.get(1).is_some_and(u8::is_ascii_digit);
    let line = line.strip_prefix(b"/").unwrap_or(line);
    let items = line.split(u8::is_ascii_whitespace).filter(|_| !is_numbered);
    let calls_tool = items.clone().next() == Some(b"TOOL");
    let is_function = |item: &&[u8]| {
        let letter = item.first();
        (letter == Some(&b'M') || calls_tool && letter == Some(&b'S'))
            && item[1..].iter().all(u8::is_ascii_digit)
    };
    items.filter(is_function).collect::<Vec<_>>().join(&b' ')
}
