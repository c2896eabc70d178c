//! One run: records from the reader, through their sections, into the post.

use std::io::Write;
use std::path::Path;
use std::sync::Arc;

use fil_cl::{Record, Vocabulary, record::kind};
use fil_diag::Result;
use fil_vm::{Host, Interpreter, SectionId, SectionMode};

use crate::blocks::Block;
use crate::debug::{self, DebugEvent, DebugState, World};
use crate::editing::SharedEditor;
use crate::error::{Error, RunCode};
use crate::map;
use crate::outside::Outside;
use crate::passes::FirstPass;
use crate::pending::PendingFiles;
use crate::report::Report;
use crate::run::Start;
use crate::script_files::ScriptFiles;
use crate::source::Stream;
use crate::spilled::{Shown, Spilled};

/// Bytes of finished blocks that are kept before they go to the writer.
const FLUSH: usize = 64 * 1024;

/// Fuel that a record costs which the run has read before: a section that goes
/// back each time it runs would never let the run end.
const FUEL_OF_READING_AGAIN: u64 = 100;

/// A run of a [`Program`](crate::Program).
pub(crate) struct Engine<'o, 'r> {
    pub(crate) outside: Outside<'o, 'r>,
    pub(crate) vocabulary: Vocabulary,
    machine: Interpreter,
    has_sections: bool,
    /// The last record of the file that was reached, and fuel left to read it
    /// and those before it again.
    furthest: u32,
    fuel: u64,
    pub(crate) record: Record,
    started: bool,
    failure: Option<Error>,
}

impl<'o, 'r> Engine<'o, 'r> {
    /// A run from the start. `observed`: keep the provenance of blocks; so does
    /// a run with a map.
    pub(crate) fn new(start: Start<'o>, records: Stream<'r>, observed: bool) -> Self {
        let shared = Arc::clone(&start.program.shared);
        let functions = Arc::clone(&shared.functions);
        let machine = Interpreter::new(Arc::clone(&shared.module), shared.limits, functions);
        let mut outside = Outside::new(start, records);
        if shared.module.edits_output() {
            let module = Arc::clone(&shared.module);
            let second = Interpreter::new(module, shared.limits, Arc::clone(&shared.functions));
            let debugger = outside.debugger.clone();
            let editor = SharedEditor::new(second, shared.vocabulary.clone(), debugger);
            outside.post.control.tape.editor.0 = Some(editor.boxed());
            outside.editor = Some(editor);
        }
        if observed || outside.map.is_some() {
            outside.post.observe();
        }
        let has_sections = !shared.module.has_no_section();
        if !has_sections && outside.debugger.is_none() && outside.editor.is_none() {
            outside.post.allow_lane();
        }
        Engine {
            outside,
            vocabulary: shared.vocabulary.clone(),
            machine,
            has_sections,
            furthest: 0,
            fuel: shared.limits.fuel,
            record: Record::default(),
            started: false,
            failure: None,
        }
    }

    /// Runs to the end; what the script wrote is not under its names yet.
    pub(crate) fn run(&mut self, nc: &mut dyn Write) -> Result<(Report, PendingFiles), Error> {
        let observed = !self.outside.observers.is_empty() || self.outside.kept.is_some();
        let debugged = self.outside.debugger.is_some();
        self.outside.spilled = Some(Spilled::default());
        let mut more = true;
        while more {
            let step = if debugged { self.advance_debugged() } else { self.advance() };
            let step = step.and_then(|more| self.refuse_denied(more));
            let step = step.map_err(|first| self.survey(first));
            if observed || !matches!(step, Ok(true)) {
                self.outside.note_counts();
            }
            more = step?;
            if observed {
                self.outside.show_blocks(|_| {});
                self.outside.record_done().map_err(Error::Run)?;
            }
            if !more || self.outside.post.control.tape.text.len() >= FLUSH {
                self.flush(nc)?;
            }
        }
        if let Err(diag) = self.outside.pass.check() {
            let place = self.outside.place(&self.record, &self.vocabulary);
            return Err(Error::Run(Box::new(diag.at(place))));
        }
        nc.flush().map_err(write_error)?;
        if observed {
            self.outside.run_done().map_err(Error::Run)?;
        }
        let pending = self.take_pending();
        Ok((std::mem::take(&mut self.outside.report), pending))
    }

    /// Runs through the records to find what scripts ask of the whole program; nothing is
    /// written and nobody is told.
    pub(crate) fn count(mut self) -> FirstPass {
        let failure = loop {
            match self.advance() {
                Ok(true) => {}
                Ok(false) => break None,
                Err(diag) => break Some(diag.message.clone()),
            }
            self.outside.forget_blocks();
            self.outside.report.warnings.clear();
        };
        let overview = self.outside.pass.counted().map(std::mem::take).unwrap_or_default();
        FirstPass { overview, failure }
    }

    /// What the run has to tell so far.
    pub(crate) fn report(&self) -> &Report {
        &self.outside.report
    }

    /// The blocks that were kept.
    pub(crate) fn take_kept(&mut self) -> Vec<Block> {
        self.outside.kept.take().unwrap_or_default()
    }

    /// The map of the run, to be ended.
    pub(crate) fn take_map(&mut self) -> Option<map::Writer<'o>> {
        self.outside.map.take()
    }

    /// What the script wrote, when the program is complete.
    pub(crate) fn take_pending(&mut self) -> PendingFiles {
        let files = self.outside.granted.files.take();
        let (pending, reads) = files.map(ScriptFiles::into_parts).unwrap_or_default();
        self.outside.report.script_reads = reads;
        self.outside.report.script_files = pending.paths().map(Path::to_path_buf).collect();
        pending
    }

    /// Carries out the next record; false when the program is complete.
    pub(crate) fn step(&mut self) -> Result<bool, Error> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        let debugged = self.outside.debugger.is_some();
        let result = if debugged { self.advance_debugged() } else { self.advance() };
        let result = result.and_then(|more| self.refuse_denied(more));
        let result = result.map_err(|first| self.survey(first));
        self.outside.note_counts();
        if let Err(error) = &result {
            self.failure = Some(error.clone());
        }
        result
    }

    /// Hands the finished blocks out and forgets them.
    ///
    /// # Errors
    /// As [`Outside::encode_tape`].
    pub(crate) fn take_blocks(&mut self, take: impl FnMut(Shown<'_>)) -> Result<()> {
        self.outside.show_blocks(take);
        self.outside.encode_tape()?;
        self.outside.forget_blocks();
        Ok(())
    }

    fn flush(&mut self, nc: &mut dyn Write) -> Result<(), Error> {
        self.outside.encode_tape().map_err(Error::Run)?;
        if let Some(spilled) = &mut self.outside.spilled {
            spilled.hand_out(nc).map_err(write_error)?;
        }
        nc.write_all(&self.outside.post.control.tape.text).map_err(write_error)?;
        self.outside.give_away_blocks().map_err(Error::Run)
    }

    /// Refuses a warning of the last record whose level is deny.
    fn refuse_denied(&mut self, more: bool) -> Result<bool> {
        match self.outside.denied.take() {
            Some(denied) => Err(denied),
            None => Ok(more),
        }
    }

    fn advance(&mut self) -> Result<bool> {
        if !self.next()? {
            return Ok(false);
        }
        self.carry_out()
    }

    /// Reads the next record; at the first one the global areas have run, at the end the
    /// program is complete.
    #[inline(always)]
    fn next(&mut self) -> Result<bool> {
        if !std::mem::replace(&mut self.started, true) {
            self.outside.begin()?;
            let host: &mut dyn Host = &mut self.outside;
            let done = self.machine.run_globals(&mut self.vocabulary, host);
            self.exchange_values();
            if !self.outside.pass.has_guessed() {
                done?;
            }
        }
        if !self.outside.read(&mut self.record, &mut self.vocabulary)? {
            self.outside.end_of_file(&self.vocabulary)?;
            return Ok(false);
        }
        self.watch_progress()?;
        Ok(true)
    }

    /// Carries out the record that was read; false when the program is complete.
    #[inline(always)]
    fn carry_out(&mut self) -> Result<bool> {
        match self.section() {
            Some(section) => self.run_section(section)?,
            None => {
                self.outside.look_ahead(&self.record, &mut self.vocabulary)?;
                self.outside.process(&self.record, &self.vocabulary)?;
            }
        }
        if self.outside.ended {
            self.outside.after_fini(&mut self.record, &mut self.vocabulary)?;
            return Ok(false);
        }
        Ok(true)
    }

    /// As [`Engine::advance`], with a debugger that is told of records and errors; of FIL the
    /// bytecode tells it.
    #[cold]
    #[inline(never)]
    fn advance_debugged(&mut self) -> Result<bool> {
        let done = self.next().and_then(|more| {
            if !more {
                return Ok(false);
            }
            self.tell_debugger(DebugEvent::Record)?;
            let more = self.carry_out()?;
            self.tell_debugger(DebugEvent::RecordDone)?;
            Ok(more)
        });
        if let Err(diag) = &done {
            let told = if self.outside.told_failure {
                Ok(())
            } else {
                self.tell_debugger(DebugEvent::Failed(diag))
            };
            // The run has ended: what comes behind is only looked at for further errors.
            self.outside.debugger = None;
            self.outside.editor.iter().for_each(SharedEditor::end_debugging);
            told?;
        }
        done
    }

    fn tell_debugger(&mut self, event: DebugEvent<'_>) -> Result<()> {
        let Some(debugger) = self.outside.debugger.clone() else { return Ok(()) };
        self.exchange_values();
        let mut view = self.machine.view(Some(&mut self.record), &mut self.vocabulary);
        let world = World::Post(&mut self.outside.post);
        let told = debug::tell(&debugger, event, &mut DebugState { fil: &mut view, world });
        self.exchange_values();
        told
    }

    /// The section that takes the current record.
    pub(crate) fn section(&self) -> Option<SectionId> {
        if !self.has_sections {
            return None;
        }
        self.outside.section_of(&self.record, &self.vocabulary)
    }

    /// Runs the section that takes the current record.
    pub(crate) fn run_section(&mut self, section: SectionId) -> Result<()> {
        let (number, line) = (self.record.number, self.record.line);
        self.outside.fini_taken |= self.record.kind == kind::FINI;
        self.outside.section = Some(section);
        self.outside.watch_taken(&self.record);
        self.exchange_values();
        // As `dyn`, so that the machine is compiled once for all its hosts: it asks them seldom.
        let host: &mut dyn Host = &mut self.outside;
        let outcome =
            self.machine.run_section(section, &mut self.record, &mut self.vocabulary, host);
        self.exchange_values();
        let outcome = match outcome {
            Err(_) if self.outside.pass.has_guessed() => {
                self.outside.section = None;
                return self.go_on_after_guess();
            }
            outcome => outcome?,
        };
        self.outside.section = None;
        let mut swallowed = outcome.swallowed();
        let mut taken = !outcome.processed && !outcome.replaced;
        if self.outside.module.compat.section == SectionMode::Process
            && !outcome.processed
            && !outcome.replaced
        {
            (swallowed, taken) = (false, false);
            self.outside.look_ahead(&self.record, &mut self.vocabulary)?;
            self.outside.process(&self.record, &self.vocabulary)?;
            self.outside.taken.is_posted(&self.record);
        }
        let settled = self.outside.settle_taken();
        self.at_place(settled)?;
        if taken {
            let settled = self.outside.settle_change();
            self.at_place(settled)?;
        }
        self.outside.section_done(section, (number, line), swallowed);
        Ok(())
    }

    /// A result that an error leaves with the place of the record.
    fn at_place(&self, result: Result<()>) -> Result<()> {
        result.map_err(|diag| {
            let place = self.outside.place(&self.record, &self.vocabulary);
            Box::new(diag.at(place))
        })
    }

    /// In a first pass a section may fail because it was told a number that is not the right
    /// one: the post then carries its record out, unless it has.
    #[cold]
    fn go_on_after_guess(&mut self) -> Result<()> {
        if self.outside.last_done == self.record.number {
            return Ok(());
        }
        self.outside.process(&self.record, &self.vocabulary)
    }

    /// Hands the values of the script from the sections to the macros that edit, or back.
    #[inline]
    fn exchange_values(&mut self) {
        if let Some(editor) = &self.outside.editor {
            editor.exchange(&mut self.machine);
        }
    }

    /// Refuses a run that reads the same records again and again.
    #[inline]
    pub(crate) fn watch_progress(&mut self) -> Result<()> {
        if self.record.number > self.furthest {
            self.furthest = self.record.number;
            return Ok(());
        }
        self.pay_for_reading_again()
    }

    #[cold]
    fn pay_for_reading_again(&mut self) -> Result<()> {
        if let Some(left) = self.fuel.checked_sub(FUEL_OF_READING_AGAIN) {
            self.fuel = left;
            return Ok(());
        }
        let message = format!("record {} is read again and again", self.record.number);
        let place = self.outside.place(&self.record, &self.vocabulary);
        Err(Box::new(fil_vm::errors::RunCode::OutOfFuel.diag(message).at(place)))
    }
}

fn write_error(error: std::io::Error) -> Error {
    Error::Run(RunCode::CantWrite.diag(error.to_string()))
}
