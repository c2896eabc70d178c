//! What scripts ask for while they run.

use fil_cl::vocabulary::words;
use fil_cl::{Record, Vocabulary, Word, keyed_cycle, record::kind};
use fil_diag::Diag;
use fil_machine::commons::EMPTY;
use fil_machine::modes::INCH;
use fil_machine::post_options::OptionValue;
use fil_machine::{Unit, stored};
use fil_post::FilLine;
use fil_vm::{
    CommonKind, Files, Host, Moment, Returned, SectionId, Site, TotalsOf, TotalsText, TotalsWord,
    Values, View, debug::Probe,
};

use super::Outside;
use crate::cancel::CancelToken;
use crate::debug::{self, DebugState, World};

impl Host for Outside<'_, '_> {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        fil_machine::in_force_at(&self.post.control.commons, common_kind(kind), location)
    }

    fn set_common(
        &mut self,
        kind: CommonKind,
        location: u32,
        value: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        let kind = common_kind(kind);
        self.post.control.check_setting(kind, location, value)?;
        self.post.control.script_sets(kind, location, value);
        self.post.control.commons.set(kind, location, value)?;
        let is_first = !stored::acts(kind, location) && self.idle.insert((kind, location));
        Ok(is_first.then(|| Box::new(stored::without_effect(&[(kind, location)]))))
    }

    fn clear_common(
        &mut self,
        kind: CommonKind,
        location: u32,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        self.set_common(kind, location, EMPTY)
    }

    fn command(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
        site: &Site,
    ) -> Result<(), Box<Diag>> {
        let tape = &mut self.post.control.tape;
        let section = self.section.map(SectionId::index);
        let lines = site.stack().map(|(file, line)| FilLine { file, line });
        tape.cause.stack = tape.stacks.number(section, lines);
        let looked = self.look_ahead(record, vocabulary);
        let result = looked.and_then(|()| match keyed(record)? {
            Some(keyed) => self.process(&keyed, vocabulary),
            None => self.process(record, vocabulary),
        });
        self.post.control.tape.cause.stack = 0;
        result?;
        if record.line != 0 {
            self.taken.is_posted(record);
        }
        self.spill()
    }

    fn exchange_values(&mut self, values: &mut Values) {
        if let Some(editor) = &self.editor {
            editor.exchange_values(values);
        }
    }

    fn next_record(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        let mut next = Record::default();
        while !self.ended && self.read(&mut next, vocabulary)? {
            self.fini_taken |= next.kind == kind::FINI;
            if next.kind != kind::PSEUDO || self.section_of(&next, vocabulary).is_some() {
                *record = next;
                self.taken.is_current(record, &self.post);
                return Ok(true);
            }
            self.process(&next, vocabulary)?;
        }
        Ok(false)
    }

    fn seek_record(
        &mut self,
        number: u32,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        self.source.seek(number)?;
        let mut found = Record::default();
        let there = self.read(&mut found, vocabulary)?;
        if there {
            *record = found;
            self.taken.is_current(record, &self.post);
        }
        Ok(there)
    }

    fn probe(&mut self, probe: Probe<'_>, view: &mut View<'_>) -> Result<(), Box<Diag>> {
        let Some(debugger) = &self.debugger else { return Ok(()) };
        self.told_failure |= matches!(probe, Probe::Failed(_));
        let mut state = DebugState { fil: view, world: World::Post(&mut self.post) };
        debug::tell(debugger, debug::event(probe), &mut state)
    }

    fn check_cancelled(&mut self) -> Result<(), Box<Diag>> {
        self.cancel.as_ref().map_or(Ok(()), CancelToken::check)
    }

    fn warn(&mut self, diag: Diag) {
        self.tell(diag);
    }

    fn trace(&mut self, on: bool) {
        self.trace = on;
    }

    #[cfg(feature = "files")]
    fn files(&mut self) -> Option<&mut dyn Files> {
        self.granted.files.as_mut().map(|files| files as &mut dyn Files)
    }

    #[cfg(not(feature = "files"))]
    fn files(&mut self) -> Option<&mut dyn Files> {
        None
    }

    fn now(&mut self) -> Option<Moment> {
        self.granted.now()
    }

    fn spawn(&mut self, command: &str) -> Option<Result<f64, String>> {
        let run = self.program.shared.spawn.as_ref()?;
        if self.pass.is_first() {
            // A command runs once, in the pass that writes the program.
            self.pass.guess();
            return Some(Ok(0.0));
        }
        Some(run(command))
    }

    fn totals(&mut self, of: TotalsOf, word: TotalsWord) -> Result<Option<f64>, Box<Diag>> {
        self.pass.number(of, word)
    }

    fn totals_text(&mut self, of: TotalsText) -> Result<String, Box<Diag>> {
        self.pass.text(of)
    }

    fn next_tool(&mut self) -> Result<Option<f64>, Box<Diag>> {
        self.pass.tool_after(self.post.control.tape.cause.record)
    }

    fn neighbour(
        &mut self,
        next: bool,
        coordinate: usize,
        vocabulary: &mut Vocabulary,
    ) -> Result<Option<f64>, Box<Diag>> {
        let found = if next { self.source.next(vocabulary)? } else { self.source.previous() };
        Ok(found.and_then(|motion| motion[coordinate]))
    }

    fn tool_diameter(&mut self, vocabulary: &mut Vocabulary) -> Result<Option<f64>, Box<Diag>> {
        self.source.tool_diameter(vocabulary)
    }

    fn named_common(&mut self, name: &str) -> Option<Result<f64, Box<Diag>>> {
        fil_machine::in_force(&self.post.control.commons, name)
    }

    fn post_option(&mut self, name: &str) -> Option<Result<Returned, Box<Diag>>> {
        let option = self.post.control.commons.options().find(name)?;
        Some(option_value(&option.value, self.post.unit()))
    }
}

/// What OPTIONF gives for a value; `unit` is that of the CL file, as far as it is known.
///
/// # Errors
/// A length before the unit is known.
pub(crate) fn option_value(value: &OptionValue, unit: Option<Unit>) -> Result<Returned, Box<Diag>> {
    Ok(match (value, unit) {
        (OptionValue::Bool(is_on), _) => Returned::Number(f64::from(u8::from(*is_on))),
        (OptionValue::Integer(number), _) => Returned::Number(*number as f64),
        (OptionValue::Length(length), Some(Unit::Mm)) => Returned::Number(*length),
        (OptionValue::Length(length), Some(Unit::Inch)) => Returned::Number(length / INCH),
        (OptionValue::Length(_), None) => {
            return fil_vm::errors::RunCode::Missing
                .err("the unit of the CL file is not known here, so a length has no value yet");
        }
        (OptionValue::Choice(text) | OptionValue::Text(text), _) => Returned::Text(text.clone()),
    })
}

/// A cycle that the script has written by position, as couplets; `None` for any other record.
fn keyed(record: &Record) -> Result<Option<Record>, Box<Diag>> {
    let is_by_position = matches!(record.data.get(1), Some(Word::Number(_)));
    if record.major != words::CYCLE || record.line != 0 || !is_by_position {
        return Ok(None);
    }
    let mut keyed = record.clone();
    keyed_cycle(&mut keyed)?;
    Ok(Some(keyed))
}

pub(crate) fn common_kind(kind: CommonKind) -> fil_machine::Kind {
    match kind {
        CommonKind::Int => fil_machine::Kind::Int,
        CommonKind::Rel => fil_machine::Kind::Rel,
        CommonKind::Dbl => fil_machine::Kind::Dbl,
    }
}
