//! What blocks of the settings switch of spindle and coolant: the machine asks for it, as INSERT
//! does. What a record has switched on and such a block around a tool change switches off may stay
//! off until the tool cuts: then a record behind the change has asked for it again, or it is
//! missing.

use fil_machine::locations::{self as loc, ControlFamily};
use fil_machine::user_blocks;

use super::ahead::Steps;
use super::lines::RAPID_PARTS;
use super::modes::Expected;
use super::settings::{Due, Settings};
use super::verifier::{LOOK_AHEAD, Verifier};
use crate::dialect::{Function, Numbered, SKIP};
use crate::interpret::sinumerik_words::{self, Value};
use crate::motion::{Event, Spindle};
use crate::text::read_block;

/// How far to look for a tool change that comes.
const EVENTS_BEFORE_CHANGE: usize = LOOK_AHEAD * RAPID_PARTS;

/// What the machine's own blocks are to switch.
#[derive(Debug, Default)]
pub(super) struct MachineBlockEffects {
    /// Tool changes so far.
    pub(super) changes: usize,
    /// Blocks that may be skipped are left out.
    leaves_out: bool,
    /// The blocks before the tool change at hand that are not taken up yet.
    awaited: Vec<String>,
}

impl Expected {
    /// Takes up what the words of a block of the settings switch of spindle and coolant.
    fn take_block(&mut self, line: &[u8], settings: &Settings) {
        let (spindle, coolant) = (self.turning(), self.coolant.asked().flatten());
        let before = self.restarts;
        for (letter, value) in switches(line, settings) {
            match letter {
                b'M' => self.insert_auxiliary(settings.dialect.auxiliary(value as i64)),
                b'S' => self.insert_speed(value, settings),
                // Another mode of speed, whose number need not be in the text.
                _ => self.spindle.speed.set(None, Due::Now),
            }
        }
        let (turns, flows) = (self.turning().is_some(), self.coolant.asked().flatten().is_some());
        self.restarts.spindle.was_on = spindle.or(before.spindle.was_on).filter(|_| !turns);
        self.restarts.coolant.was_on = coolant.or(before.coolant.was_on).filter(|_| !flows);
    }

    /// How the spindle must turn; `None` where it need not.
    fn turning(&self) -> Option<Spindle> {
        self.spindle.turn.asked().filter(|turn| *turn != Spindle::Off)
    }

    /// The tool cuts: what blocks of the settings have switched off and no record on again is
    /// missing.
    pub(super) fn resume(&mut self) {
        let (spindle, coolant) =
            (self.restarts.spindle.was_on.take(), self.restarts.coolant.was_on.take());
        if spindle.is_some() {
            self.spindle.turn.set(spindle, Due::Now);
        }
        if coolant.is_some() {
            self.coolant.require(coolant, Due::Now);
        }
    }

    /// The coolant that a tool change has switched off by its settings comes on again.
    pub(super) fn resume_coolant(&mut self, settings: &Settings) {
        if let coolant @ Some(_) = self.restarts.coolant.was_on.take() {
            self.coolant.require(coolant, settings.coolant_due());
        }
    }
}

impl<C: Steps> Verifier<'_, C> {
    /// Takes up the blocks at the start of the program; those that may be skipped are left out
    /// from here on, or not.
    pub(super) fn begin_with_blocks(&mut self, leaves_out: bool) {
        self.blocks.leaves_out = leaves_out;
        self.take_blocks(&self.settings.start_blocks());
    }

    /// Takes up blocks of the settings.
    pub(super) fn take_blocks(&mut self, blocks: &[String]) {
        for block in blocks {
            let line = self.settings.dialect.text.marks.read(block.as_bytes());
            let is_skipped = line.trim_ascii_start().first() == Some(&SKIP);
            if !(is_skipped && self.blocks.leaves_out) {
                self.expected.take_block(&line, self.settings);
            }
        }
    }

    /// The blocks before the next tool change are to come.
    pub(super) fn await_blocks_before_change(&mut self) {
        let is_change = |event: &Event| matches!(event, Event::ToolChange { .. });
        let change = self.nc.from(self.next).take(EVENTS_BEFORE_CHANGE).find(is_change);
        let last = change.map_or(u32::MAX, |event| event.line());
        self.blocks.awaited =
            self.blocks_of_change(self.blocks.changes, 0, [self.moved.line, last]);
    }

    /// Takes up the blocks that are awaited where one of them stands before this line, that of
    /// the next motion.
    pub(super) fn take_awaited_blocks_before(&mut self, line: u32) {
        let mut awaited = self.blocks.awaited.iter();
        if awaited.any(|block| self.own.stands_between(block, [self.moved.line, line])) {
            self.take_awaited_blocks();
        }
    }

    pub(super) fn take_awaited_blocks(&mut self) {
        let blocks = std::mem::take(&mut self.blocks.awaited);
        self.take_blocks(&blocks);
    }

    /// Takes up the blocks after the tool change that was counted last.
    pub(super) fn take_blocks_after_change(&mut self) {
        let next = self.nc.from(self.next).find(|event| !self.own.has(event.line()));
        let lines = [self.last_line(), next.map_or(u32::MAX, |event| event.line())];
        let blocks = self.blocks_of_change(self.blocks.changes - 1, 1, lines);
        self.take_blocks(&blocks);
    }

    /// The blocks before (0) or after (1) a tool change, counted from 0, which lie between two lines.
    /// Whether it is the last one is seen in the program, which has its blocks.
    fn blocks_of_change(&self, change: usize, side: usize, lines: [u32; 2]) -> Vec<String> {
        let of = |kind| std::mem::take(&mut self.settings.blocks_around(kind)[side]);
        if change == 0 {
            return of(user_blocks::FIRST_CHANGE);
        }
        let lists = [user_blocks::OTHER_CHANGE, user_blocks::LAST_CHANGE].map(of);
        let [other, last] = &lists;
        let stands =
            |list: &[String]| list.iter().all(|block| self.own.stands_between(block, lines));
        let is_last = stands(last) && (!stands(other) || last.len() > other.len());
        let [other, last] = lists;
        if is_last { last } else { other }
    }
}

/// The words of a block that switch spindle and coolant: M and S with their numbers, and the
/// function of another mode of speed.
fn switches(line: &[u8], settings: &Settings) -> Vec<(u8, f64)> {
    match settings.commons.read(loc::CONTROL_FAMILY) {
        ControlFamily::Sinumerik => of_sinumerik(line, settings),
        ControlFamily::Klartext => of_klartext(line),
        ControlFamily::WordAddress => of_word_address(line, settings),
    }
}

fn of_word_address(line: &[u8], settings: &Settings) -> Vec<(u8, f64)> {
    let Ok(block) = read_block(line, "settings", 1) else { return Vec::new() };
    let function = |tenths: f64| settings.dialect.function(tenths.round() as i64);
    let functions = block.words.iter().filter(|word| word.letter == b'G');
    let functions: Vec<Function> =
        functions.filter_map(|word| function(word.number.value() * 10.0)).collect();
    let is_speed =
        !functions.iter().any(|one| matches!(one, Function::SpeedLimit | Function::Dwell));
    let mode = functions.iter().any(|one| matches!(one, Function::Surface(_)));
    let words = block.words.iter().filter_map(|word| match word.letter {
        b'M' if word.number.decimals == 0 => Some((b'M', word.number.value())),
        b'S' if is_speed => Some((b'S', word.number.value())),
        _ => None,
    });
    mode.then_some((b'G', 0.0)).into_iter().chain(words).collect()
}

fn of_sinumerik(line: &[u8], settings: &Settings) -> Vec<(u8, f64)> {
    let index = settings.dialect.number(Numbered::Spindle).map(|index| index.to_string());
    let words = sinumerik_words::read(line).unwrap_or_default();
    let switch = |word: &sinumerik_words::Word| {
        let Some(Value::Number(value)) = word.value else { return None };
        let letter = *word.name.as_bytes().first()?;
        let rest = &word.name[1..];
        let is_own = rest.is_empty() || index.as_deref() == Some(rest);
        let is_mode = letter == b'G' && (value == 96.0 || value == 97.0);
        (is_own && (is_mode || matches!(letter, b'M' | b'S'))).then_some((letter, value))
    };
    words.iter().filter_map(switch).collect()
}

/// The words of Klartext stand between blanks.
fn of_klartext(line: &[u8]) -> Vec<(u8, f64)> {
    let text = String::from_utf8_lossy(line).to_ascii_uppercase();
    let text = text.split(';').next().unwrap_or_default();
    let switch = |word: &str| {
        let letter = *word.as_bytes().first().filter(|letter| matches!(letter, b'M' | b'S'))?;
        Some((letter, word[1..].parse().ok()?))
    };
    text.split_ascii_whitespace().filter_map(switch).collect()
}
