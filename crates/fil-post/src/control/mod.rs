//! The control: operations become blocks on the tape.
//!
//! [`Control`] holds what every family of controls needs: settings, tables, tape,
//! what the control knows, what waits. The blocks are made by one module a family:
//! [`word_address`] (ISO 6983, Fanuc and its relatives), [`klartext`] (Heidenhain) and
//! [`sinumerik`] (Siemens); [`family`] chooses.

mod again;
mod apart;
pub mod capabilities;
mod characters;
mod departure;
mod edit;
mod families;
pub mod family;
mod foreign;
pub(crate) mod full_turn;
pub mod heads;
pub mod klartext;
mod left_out;
pub mod length_plane;
pub(crate) mod line;
pub mod machine_frame;
pub mod needs;
mod own_offsets;
pub(crate) mod place;
pub mod program;
mod reference_way;
mod repeats;
pub mod replaced;
mod settings;
pub mod sinumerik;
pub(crate) mod skip;
mod speed_of_others;
pub mod spindle;
mod straight_rapid;
pub(crate) mod tap;
mod texts;
pub mod thread_cycle;
pub(crate) mod user_texts;
pub mod vectors;
pub(crate) mod waiting;
pub mod word_address;
mod writing;

use std::collections::BTreeMap;

use fil_diag::Result;
use fil_machine::address::no_address;
use fil_machine::commons::EMPTY;
use fil_machine::contradictions;
use fil_machine::letters::{G, M};
use fil_machine::locations as loc;
use fil_machine::modes::{FeedMode, Unit};
use fil_machine::rounding::Rounding;
use fil_machine::setting::{CodeAt, LetterAt};
use fil_machine::tables::MachineTables;
use fil_machine::{Commons, FunctionCode, Letter, mill_turn};
use nalgebra::Rotation3;

use crate::block::Block;
use crate::cause::Cause;
use crate::control_state::{Codes, Compensation, ControlState, Meaning, Source, modal};
use crate::errors::PostCode;
use crate::operation::{Feed, Stop};
use crate::tape::Tape;
use crate::warnings::Warnings;

pub use program::ProgramHead;
pub use waiting::{Function, Waiting};
pub use writing::BeforeOthers;

/// What tool-tip control begins with.
#[derive(Clone, Copy, Debug, Default)]
pub struct TipOffset {
    /// Length offset of the tool, with its cause.
    pub offset: Option<(i64, Cause)>,
    /// It has begun where the tape does not say where the axes stand: the way of the next motion
    /// has no time.
    pub begins_unsaid: bool,
    /// The length offset is called without tool-tip control.
    pub length_is_called: bool,
    /// A tool change or a position of the machine has brought the tool away from the part.
    pub is_away: bool,
    /// It was before the blocks that may be skipped.
    pub was_away: bool,
    /// Length offset of the tool before them.
    pub offset_before: Option<i64>,
    /// The motion at hand says the direction of the tool by a vector.
    pub by_vector: bool,
    /// Where the rotary axes stand since a vector has turned them, degrees.
    pub leans: Option<[f64; 2]>,
    /// Turns directions of the last tilted frame into those of the part, and where the rotary axes
    /// stand in it, degrees.
    pub frame: Option<(Rotation3<f64>, [f64; 2])>,
}

/// Tools that were changed and prepared.
#[derive(Clone, Debug, Default)]
pub(crate) struct Tools {
    /// Tool changes that were written.
    pub changes: u32,
    /// The tool that was named last as the next one, since the last change.
    pub prepared: Option<i64>,
    /// The first tool of the program.
    pub first: Option<i64>,
    /// The tool that was called last, or is about to be.
    pub loaded: Option<i64>,
    /// The work offset that SET/OFSETL named last, itself without a number.
    pub work_offset: Option<Option<i64>>,
    /// The work offset that the post has written last.
    pub written_offset: Option<Option<i64>>,
    /// The first tool of each length offset.
    pub of_offset: BTreeMap<i64, i64>,
    /// The coolant that a tool change has switched off, by its settings: it comes on again at the
    /// next point, unless COOLNT comes first.
    pub coolant: Option<CodeAt>,
    /// Messages and optional stops that wait for a tool change, with their causes.
    pub held: Vec<(Held, Cause)>,
}

/// What waits for a tool change.
#[derive(Clone, Debug, PartialEq)]
pub enum Held {
    /// A message to the operator.
    Message(String),
    /// A stop, which the tool change makes behind its retract.
    Stop(Stop),
}

/// The output side of the post.
#[derive(Clone)]
pub struct Control {
    /// The settings.
    pub commons: Commons,
    /// The output.
    pub tape: Tape,
    /// Warnings not yet taken away.
    pub warnings: Warnings,
    /// Tables derived from the settings.
    pub tables: MachineTables,
    /// What the control knows.
    pub state: ControlState,
    /// Words that wait for a motion.
    pub waiting: Waiting,
    /// What tool-tip control begins with.
    pub tip: TipOffset,
    /// Words of the post that an edit has taken out and that do not stand on the tape since.
    left_out: Vec<left_out::Word>,
    /// REPEAT.
    pub(crate) repeat: repeats::Repeats,
    /// The block under construction.
    pub block: Block,
    /// The program has begun, its blocks are words, and nobody edits them.
    pub(crate) straight: bool,
    /// Number of blocks behind the last motion in the plane of cutter compensation.
    pub(crate) moved_in_plane_behind: u64,
    /// Turns and clamps of the rotary axes.
    pub(crate) rotary: full_turn::Rotary,
    /// Number and name of the program.
    pub head: ProgramHead,
    /// What Klartext needs besides.
    pub(crate) klartext: klartext::Klartext,
    /// What a SINUMERIK needs besides.
    pub(crate) sinumerik: sinumerik::Sinumerik,
    /// What the CL file has asked of the spindles.
    pub spindle: spindle::SpindleAsked,
    /// The location of the coolant that flows, as COOLNT asked for it.
    pub(crate) coolant: Option<CodeAt>,
    /// Tools that were changed and prepared.
    pub(crate) tools: Tools,
    /// The compensation the CL file asks for.
    asked: Compensation,
    /// ARCSLP is on: blocks of a helix say how far it rises.
    pub helix_words: bool,
    /// Number of blocks when the last arc had been written; 0 before the first.
    pub(crate) last_arc: u64,
    /// Unit of the CL file and of the program; `None` before anything says it.
    pub unit: Option<Unit>,
    codes: Codes,
    family: &'static family::Row,
}

impl Control {
    /// The output side of a machine.
    ///
    /// # Errors
    /// Settings that make no machine.
    pub fn new(commons: Commons) -> Result<Self> {
        contradictions::check(&commons)?;
        mill_turn::check_start(&commons)?;
        let mut tables = MachineTables::default();
        tables.refresh(&commons, true)?;
        let unit = Unit::of_machine(&commons);
        let family = families::row(tables.family);
        let state = program::state_at_start(&commons, unit);
        Ok(Control {
            codes: Codes::from_commons(&commons),
            family,
            commons,
            tape: Tape::default(),
            warnings: Warnings::default(),
            tables,
            state,
            waiting: Waiting::default(),
            tip: TipOffset::default(),
            left_out: Vec::new(),
            repeat: repeats::Repeats::default(),
            rotary: full_turn::Rotary::default(),
            spindle: spindle::SpindleAsked::default(),
            tools: Tools::default(),
            block: Block::default(),
            straight: false,
            moved_in_plane_behind: 0,
            head: ProgramHead::default(),
            klartext: klartext::Klartext::default(),
            sinumerik: sinumerik::Sinumerik::default(),
            coolant: None,
            asked: Compensation::Off,
            helix_words: false,
            last_arc: 0,
            unit,
        })
    }

    /// Brings tables and codes up to date with the settings.
    ///
    /// # Errors
    /// As [`MachineTables::refresh`].
    #[inline]
    pub fn refresh(&mut self) -> Result<()> {
        if self.tables.refresh(&self.commons, self.is_metric())? {
            self.follow_unit_of_machine()?;
            contradictions::check(&self.commons)?;
            self.codes = Codes::from_commons(&self.commons);
            self.family = families::row(self.tables.family);
            self.tables
                .format_feed(self.state.get(modal::FEED_MODE).unwrap_or(FeedMode::PerMinute));
            self.straight = false;
        }
        Ok(())
    }

    /// A unit that POSTF(2) or PLABEL has put into `units.mode`.
    ///
    /// # Errors
    /// The program has the other one already.
    fn follow_unit_of_machine(&mut self) -> Result<()> {
        match (self.unit, Unit::of_machine(&self.commons)) {
            (Some(unit), Some(only)) if unit != only => PostCode::Units
                .err(format!("units.mode is {only} from here on, but the program is in {unit}")),
            (None, Some(only)) => {
                self.unit = Some(only);
                self.tables.refresh(&self.commons, self.is_metric()).map(|_| ())
            }
            _ => Ok(()),
        }
    }

    /// True for a program in mm, and before anything says the unit.
    #[inline]
    pub fn is_metric(&self) -> bool {
        self.unit != Some(Unit::Inch)
    }

    /// What F counts in a unit of length a minute: feeds a minute are kept multiplied by it.
    pub fn upm_factor(&self) -> f64 {
        self.commons.dbl_opt(loc::FEED_UPM_FACTOR).unwrap_or(1.0)
    }

    /// Refuses what depends on the unit before anything has said it.
    ///
    /// # Errors
    /// Neither UNITS nor the machine nor the user has.
    #[inline]
    pub fn require_unit(&self) -> Result<Unit> {
        self.unit.or(self.head.unit_ahead).ok_or_else(|| {
            PostCode::NoUnit.diag("a word with a number comes before mm or inch is set")
        })
    }

    /// A code of the machine.
    ///
    /// # Errors
    /// The code is absent or negative.
    pub fn code(&self, at: CodeAt, what: &str) -> Result<FunctionCode> {
        let code = self.code_if_any(at);
        code.ok_or_else(|| {
            PostCode::NoCode.diag(format!("the machine has no code for {what} (INTCOM {})", at.0))
        })
    }

    /// A code of the machine, where it has one.
    #[inline]
    pub fn code_if_any(&self, at: CodeAt) -> Option<FunctionCode> {
        self.commons.read(at).and_then(FunctionCode::of_setting)
    }

    /// What a preparatory function does on this machine.
    pub fn meaning(&self, code: FunctionCode) -> Meaning {
        self.codes.meaning(code)
    }

    /// True for a function that takes up the length of the tool.
    pub fn calls_length(&self, code: FunctionCode) -> bool {
        self.codes.calls_length(code)
    }

    /// True for an M code that changes the tool.
    pub fn changes_tool(&self, code: FunctionCode) -> bool {
        self.codes.does(code, Meaning::ToolChange)
    }

    /// True for an M code that calls a program, or returns from one.
    pub fn calls_program(&self, code: FunctionCode) -> bool {
        self.codes.calls_program(code)
    }

    /// True for a G function that chooses a work offset, by itself or by a word beside it.
    pub fn chooses_offset(&self, code: FunctionCode) -> bool {
        self.codes.chooses_offset(code)
    }

    /// True for an M function that ends the program.
    pub fn ends_main_program(&self, code: FunctionCode) -> bool {
        self.codes.ends_main_program(code)
    }

    /// The letter a setting names.
    ///
    /// # Errors
    /// The setting names none.
    pub fn letter(&self, at: LetterAt, what: &str) -> Result<Letter> {
        let letter = self.commons.read(at).ok_or_else(|| {
            PostCode::NoCode.diag(format!("the machine has no letter for {what} (INTCOM {})", at.0))
        })?;
        self.require_on_tape(letter, what)?;
        Ok(letter)
    }

    /// Refuses a word without which its block means something else.
    ///
    /// # Errors
    /// The machine does not write the letter.
    pub fn require_on_tape(&self, letter: Letter, what: &str) -> Result<()> {
        match self.tables.addresses.required(letter)? {
            Some(_) => Ok(()),
            None => PostCode::NoCode.err(format!(
                "{what} needs {letter}, which this machine does not output (tape position 53)"
            )),
        }
    }

    /// Warns of words that the machine does not write.
    #[cold]
    fn warn_off_tape(&mut self, letter: Letter) {
        let message = format!("{letter} has no tape position (53); its words are not output");
        self.warnings.add(PostCode::IgnoredPart, message);
    }

    /// Warns that the machine has no code for something it may do by other means.
    pub fn warn_no_code(&mut self, what: &str) {
        let message = format!("the machine has no code for {what}; nothing is written");
        self.warnings.add(PostCode::IgnoredPart, message);
    }

    /// Adds a preparatory function, with the cause of the block.
    pub fn g(&mut self, code: FunctionCode) {
        self.block.g(code, self.block.cause);
    }

    /// Adds a preparatory function that the record as a whole asks for.
    pub fn g_of_record(&mut self, code: FunctionCode) {
        self.block.g(code, self.block.cause.whole());
    }

    /// Adds an auxiliary function, with the cause of the block.
    pub fn m(&mut self, code: FunctionCode) {
        if self.tables.addresses.position(M).is_none() {
            self.warn_off_tape(M);
        }
        self.block.m(code, self.block.cause);
    }

    /// Adds a word, rounded as its letter allows.
    ///
    /// # Errors
    /// As [`Block::word`].
    pub fn word(&mut self, letter: Letter, value: f64) -> Result<()> {
        self.word_rounded(letter, value, Rounding::of(letter))
    }

    /// Adds a word, rounded as said.
    ///
    /// # Errors
    /// As [`Block::word`].
    pub fn word_rounded(&mut self, letter: Letter, value: f64, rounding: Rounding) -> Result<()> {
        let put = self.block.word(letter, value, rounding, &self.tables.addresses)?;
        if put.is_none() && !matches!(letter, G | M) {
            self.warn_off_tape(letter);
        }
        Ok(())
    }

    /// Adds a feed word unless the control has that value; notes its cause. In inverse time each
    /// block needs its own.
    pub(crate) fn modal_feed(&mut self, letter: Letter, feed: &Feed) -> Result<()> {
        let known = feed.mode != FeedMode::InverseTime && self.state.has_last(letter);
        if known && self.commons.last_output(letter) == feed.value {
            return Ok(());
        }
        let addresses = &self.tables.addresses;
        let Some(position) = addresses.required(letter)? else {
            self.warn_off_tape(letter);
            return Ok(());
        };
        let format = &addresses.slot(position).format;
        let scaled = Rounding::Rate.scale(feed.value, format);
        let scaled = scaled.map_err(|diag| crate::block::named(diag, letter))?;
        if !known || format.unscale(scaled) != self.commons.last_output(letter) {
            self.block.put(position, scaled);
            self.block.note_cause(position, feed.cause);
        }
        Ok(())
    }

    /// Does something whose words have another cause than the record that is
    /// carried out.
    pub fn because<T>(&mut self, cause: Cause, act: impl FnOnce(&mut Control) -> T) -> T {
        let record = std::mem::replace(&mut self.block.cause, cause);
        let result = act(self);
        self.block.cause = record;
        result
    }

    /// The compensation the CL file asks for, begun or not.
    #[inline]
    pub fn compensation_asked(&self) -> Compensation {
        self.asked
    }

    /// True when the block under construction has a word of this letter.
    pub fn block_has(&self, letter: Letter) -> bool {
        self.block.has(letter, &self.tables.addresses)
    }

    /// True when the control has this value as the last one of a letter.
    #[inline]
    pub fn has_value(&self, letter: Letter, value: f64) -> bool {
        self.state.has_last(letter) && self.commons.last_output(letter) == value
    }

    /// The last value of a letter that the control is known to have.
    pub fn last_value(&self, letter: Letter) -> Option<f64> {
        let value = self.commons.last_output(letter);
        (self.state.has_last(letter) && value != EMPTY).then_some(value)
    }

    /// Machine position of an axis by its last word; `None` when it is not known.
    pub fn axis_position(&self, number: usize) -> Option<f64> {
        let axis = self.tables.axis(number);
        self.last_value(axis.letter).map(|value| axis.position(value))
    }

    /// Refuses a letter that the machine does not write.
    ///
    /// # Errors
    /// It has no tape position.
    pub fn require_letter(&self, letter: Letter) -> Result<()> {
        match self.tables.addresses.position(letter) {
            Some(_) => Ok(()),
            None => Err(no_address(letter)),
        }
    }

    /// Forgets the motion code when FIL has emptied the last output of G.
    #[inline]
    pub fn check_forgotten(&mut self) {
        if self.commons.last_output(G) == EMPTY {
            self.state.forget(modal::MOTION, Source::Post);
        }
    }
}
