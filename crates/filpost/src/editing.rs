//! FIL macros that the post calls: _OUTPTP, _MCDWT and _LSTWT edit what it writes, _REPOS
//! says how it repositions rotary axes.
//!
//! While no section runs, the values of the script lie with the editor; a section has
//! them lent back. So a macro sees and sets the same names as sections do.

use std::sync::{Arc, Mutex, PoisonError};

use fil_cl::{Record, Vocabulary};
use fil_diag::{Diag, Result};
use fil_machine::commons::EMPTY;
use fil_machine::locations::{
    self as loc, ReposFeedMethod, ReposRapidMethod, ReposRapidRetract, RotaryKind, TapeBlockMacro,
};
use fil_machine::{Commons, Letter};
use fil_post::editing::{Editor, Ways};
use fil_vm::debug::Probe;
use fil_vm::{
    CommonKind, Edits, Host, Interpreter, OutputMacro, REPOSITION, REPOSITION_GIVEN, Site, Values,
    View,
};

use crate::debug::{self, DebugState, SharedDebugger, World};
use crate::error::RunCode;
use crate::outside::common_kind;

/// The macros that a machine has the post call.
pub(crate) fn edits(commons: &Commons) -> Edits {
    let lines = commons.read(loc::TAPE_BLOCK_MACRO);
    Edits {
        words: commons.read(loc::TAPE_EDIT_MACRO),
        tape: matches!(lines, TapeBlockMacro::Tape | TapeBlockMacro::Both),
        listing: matches!(lines, TapeBlockMacro::Listing | TapeBlockMacro::Both),
        reposition: calls_repos(commons),
    }
}

/// At the limit of a rotary axis the machine calls _REPOS, in feed motions or in rapid ones.
fn calls_repos(commons: &Commons) -> bool {
    let turns = [commons.read(loc::ROTARY_PRIMARY_KIND), commons.read(loc::ROTARY_SECONDARY_KIND)];
    let at_rapid = commons.read(loc::REPOS_RAPID_RETRACT) == ReposRapidRetract::AsInFeedMoves
        && commons.read(loc::REPOS_RAPID_METHOD) == ReposRapidMethod::CallTheMacroRepos;
    turns.iter().any(|kind| *kind != RotaryKind::None)
        && (commons.read(loc::REPOS_FEED_METHOD) == ReposFeedMethod::CallTheMacroRepos || at_rapid)
        && commons.dbl_opt(loc::REPOS_RETRACT_DISTANCE).is_some()
}

/// The machine that runs the macros, shared by the post and the run.
#[derive(Clone)]
pub(crate) struct SharedEditor(Arc<Mutex<MacroRunner>>);

struct MacroRunner {
    interpreter: Interpreter,
    vocabulary: Vocabulary,
    warnings: Vec<Diag>,
    debugger: Option<SharedDebugger>,
}

impl SharedEditor {
    /// An editor whose machine takes the place of another one of the same module.
    pub fn new(
        interpreter: Interpreter,
        vocabulary: Vocabulary,
        debugger: Option<SharedDebugger>,
    ) -> Self {
        let runner = MacroRunner { interpreter, vocabulary, warnings: Vec::new(), debugger };
        SharedEditor(Arc::new(Mutex::new(runner)))
    }

    /// The editor as the post calls it.
    pub fn boxed(&self) -> Box<dyn Editor> {
        Box::new(self.clone())
    }

    /// Lets no debugger look on any more.
    pub fn end_debugging(&self) {
        self.with(|runner| runner.debugger = None);
    }

    /// Exchanges the values with the machine of the sections.
    pub fn exchange(&self, other: &mut Interpreter) {
        self.with(|runner| runner.interpreter.exchange(other));
    }

    /// The same with one that is in the middle of a section.
    pub fn exchange_values(&self, values: &mut Values) {
        self.with(|runner| runner.interpreter.exchange_values(values));
    }

    /// Edits a line of the tape or the listing.
    ///
    /// # Errors
    /// What the macro refuses.
    pub fn edit_line(
        &self,
        what: OutputMacro,
        line: &mut String,
        commons: &Commons,
    ) -> Result<bool> {
        self.with(|runner| {
            let MacroRunner { interpreter, vocabulary, warnings, debugger } = runner;
            let host: &mut dyn Host = &mut WhileWriting { commons, warnings, debugger };
            let found = interpreter.edits(what);
            interpreter.edit_line(what, line, vocabulary, host).map(|()| found)
        })
    }

    fn with<T>(&self, act: impl FnOnce(&mut MacroRunner) -> T) -> T {
        act(&mut self.0.lock().unwrap_or_else(PoisonError::into_inner))
    }
}

impl Editor for SharedEditor {
    fn words(&mut self, words: &mut Vec<(Letter, f64)>, commons: &Commons) -> Result<bool> {
        let mut plain: Vec<(u8, f64)> =
            words.iter().map(|(letter, value)| (letter.byte(), *value)).collect();
        let found = self.with(|runner| {
            let MacroRunner { interpreter, vocabulary, warnings, debugger } = runner;
            let host: &mut dyn Host = &mut WhileWriting { commons, warnings, debugger };
            let found = interpreter.edits(OutputMacro::Words);
            interpreter.edit_words(&mut plain, vocabulary, host).map(|()| found)
        })?;
        *words = plain.into_iter().map(|(letter, value)| (Letter::of(letter), value)).collect();
        Ok(found)
    }

    fn line(&mut self, line: &mut String, commons: &Commons) -> Result<bool> {
        self.edit_line(OutputMacro::Tape, line, commons)
    }

    fn repositions(&self) -> bool {
        self.with(|runner| runner.interpreter.edits(OutputMacro::Reposition))
    }

    fn reposition(&mut self, given: &[f64; 10], ways: &mut Ways, commons: &Commons) -> Result<()> {
        let flag = |on: bool| f64::from(u8::from(on));
        let number = |value: Option<f64>| value.unwrap_or(EMPTY);
        let mut values = [EMPTY; REPOSITION.len()];
        values[..REPOSITION_GIVEN].copy_from_slice(given);
        values[REPOSITION_GIVEN..].copy_from_slice(&[
            number(ways.retract),
            number(ways.retract_feed),
            number(ways.approach),
            number(ways.approach_feed),
            flag(ways.along_next),
            flag(ways.spindle_stands),
            flag(ways.coolant_off),
            flag(ways.optional_stop),
            flag(ways.stop),
        ]);
        self.with(|runner| {
            let MacroRunner { interpreter, vocabulary, warnings, debugger } = runner;
            let host: &mut dyn Host = &mut WhileWriting { commons, warnings, debugger };
            interpreter.reposition(&mut values, vocabulary, host)
        })?;
        let [.., retract, retract_feed, approach, approach_feed, axis, spindle, coolant, opt, stop] =
            values;
        let number = |value: f64| (value != EMPTY).then_some(value);
        let flag = |name: &str, value: f64| match value {
            0.0 => Ok(false),
            1.0 => Ok(true),
            _ => RunCode::WhileWriting
                .err(format!("_REPOS gives {value} for {name}, which must be 0 or 1")),
        };
        *ways = Ways {
            retract: number(retract),
            retract_feed: number(retract_feed),
            approach: number(approach),
            approach_feed: number(approach_feed),
            along_next: flag("NEWAXS", axis)?,
            spindle_stands: flag("SPNOFF", spindle)?,
            coolant_off: flag("COLOFF", coolant)?,
            optional_stop: flag("OPTSTP", opt)?,
            stop: flag("PRGSTP", stop)?,
        };
        Ok(())
    }

    fn take_warnings(&mut self) -> Vec<Diag> {
        self.with(|runner| std::mem::take(&mut runner.warnings))
    }
}

/// What a macro reaches while a block is on its way to the tape: the settings, to read.
struct WhileWriting<'a> {
    commons: &'a Commons,
    warnings: &'a mut Vec<Diag>,
    debugger: &'a Option<SharedDebugger>,
}

fn refused<T>(what: &str) -> Result<T> {
    RunCode::WhileWriting.err(format!("{what} in a macro that the post calls"))
}

impl Host for WhileWriting<'_> {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64> {
        fil_machine::in_force_at(self.commons, common_kind(kind), location)
    }

    fn set_common(&mut self, _: CommonKind, location: u32, _: f64) -> Result<Option<Box<Diag>>> {
        refused(&format!("location {location} can't be set"))
    }

    fn clear_common(&mut self, kind: CommonKind, location: u32) -> Result<Option<Box<Diag>>> {
        self.set_common(kind, location, EMPTY)
    }

    fn command(&mut self, record: &Record, vocabulary: &mut Vocabulary, _: &Site) -> Result<()> {
        refused(&format!("no {} is carried out", vocabulary.name(record.major)))
    }

    fn next_record(&mut self, _: &mut Record, _: &mut Vocabulary) -> Result<bool> {
        refused("no record is read")
    }

    fn seek_record(&mut self, _: u32, _: &mut Record, _: &mut Vocabulary) -> Result<bool> {
        refused("no record is read")
    }

    fn probe(&mut self, probe: Probe<'_>, view: &mut View<'_>) -> Result<()> {
        let Some(debugger) = self.debugger else { return Ok(()) };
        let mut state = DebugState { fil: view, world: World::Writing(self.commons) };
        debug::tell(debugger, debug::event(probe), &mut state)
    }

    fn warn(&mut self, diag: Diag) {
        self.warnings.push(diag);
    }

    fn trace(&mut self, _: bool) {}

    fn named_common(&mut self, name: &str) -> Option<Result<f64>> {
        fil_machine::in_force(self.commons, name)
    }

    fn post_option(&mut self, name: &str) -> Option<Result<fil_vm::Returned>> {
        let option = self.commons.options().find(name)?;
        Some(crate::outside::option_value(&option.value, None))
    }
}
