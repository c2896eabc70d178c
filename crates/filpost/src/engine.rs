//! One run: records from the reader, through their sections, into the post.

use std::io::{Read, Write};
use std::path::Path;

use fil_cl::{Record, Vocabulary, reader::Reader, record::kind};
use fil_diag::Diag;
use fil_post::Origin;
use fil_vm::{Machine, SectionMode};

use crate::builder::Post;
use crate::error::{Error, RunCode};
use crate::granted::Granted;
use crate::map;
use crate::observe::WhatHappened;
use crate::outside::Outside;
use crate::report::Report;
use crate::script_files::{HeldFiles, ScriptFiles};
use crate::source::Source;

/// Bytes of finished blocks that are kept before they go to the writer.
const FLUSH: usize = 64 * 1024;

/// Fuel that a record costs which the run has read before: a section that goes
/// back each time it runs would never let the run end.
const FUEL_OF_READING_AGAIN: u64 = 100;

/// A run of a [`Post`].
pub(crate) struct Engine<'p, R: Read> {
    outside: Outside<'p, R>,
    vocabulary: Vocabulary,
    machine: Option<Machine>,
    has_sections: bool,
    /// The last record of the file that was reached, and fuel left to read it
    /// and those before it again.
    furthest: u32,
    fuel: u64,
    functions_home: &'p mut fil_vm::Functions,
    record: Record,
    started: bool,
    /// Blocks on the tape that observers have seen.
    shown: usize,
    failure: Option<Error>,
}

impl<'p, R: Read> Engine<'p, R> {
    /// A run from the start. `observed`: keep the provenance of blocks; so does
    /// a run with a map.
    pub(crate) fn new(
        post: &'p mut Post,
        reader: Reader<R>,
        observed: bool,
        map: Option<map::Writer<'p>>,
    ) -> Self {
        let functions = std::mem::take(&mut post.functions);
        let machine = Machine::new(post.module.clone(), post.limits, functions);
        let has_sections = !post.module.has_no_section();
        let mut outside = Outside {
            source: Source::new(reader, has_sections),
            module: post.module.clone(),
            post: post.prototype.clone(),
            report: Report::default(),
            observers: &mut post.observers,
            cl_name: &post.cl_name,
            ended: false,
            trace: false,
            section: None,
            map,
            granted: Granted::new(post.clock, post.spawn.as_mut(), post.folders.clone()),
        };
        if observed || outside.map.is_some() {
            outside.post.observe();
        }
        Engine {
            outside,
            vocabulary: post.vocabulary.clone(),
            machine: Some(machine),
            has_sections,
            furthest: 0,
            fuel: post.limits.fuel,
            functions_home: &mut post.functions,
            record: Record::default(),
            started: false,
            shown: 0,
            failure: None,
        }
    }

    /// Gives the embedding program's functions back to the post.
    pub(crate) fn finish(&mut self) {
        if let Some(machine) = self.machine.take() {
            *self.functions_home = machine.into_functions();
        }
    }

    /// Runs to the end; what the script wrote is not under its names yet.
    pub(crate) fn run(&mut self, nc: &mut impl Write) -> Result<(Report, HeldFiles), Error> {
        let observed = !self.outside.observers.is_empty();
        let mut more = true;
        while more {
            more = self.step()?;
            if observed {
                self.show_blocks(|_, _| {});
            }
            if !more || self.outside.post.control.tape.text.len() >= FLUSH {
                self.flush(nc)?;
            }
        }
        nc.flush().map_err(write_error)?;
        let mut report = std::mem::take(&mut self.outside.report);
        report.records = self.outside.source.records;
        report.metric = self.outside.post.control.is_metric();
        report.blocks = self.outside.post.control.tape.count;
        report.warnings.append(&mut self.outside.post.control.warnings.list);
        let held = self.take_held();
        report.script_files = held.paths().map(Path::to_path_buf).collect();
        Ok((report, held))
    }

    /// The map of the run, to be ended.
    pub(crate) fn take_map(&mut self) -> Option<map::Writer<'p>> {
        self.outside.map.take()
    }

    /// What the script wrote, when the program is complete.
    pub(crate) fn take_held(&mut self) -> HeldFiles {
        self.outside.granted.files.take().map(ScriptFiles::into_held).unwrap_or_default()
    }

    /// Carries out the next record; false when the program is complete.
    pub(crate) fn step(&mut self) -> Result<bool, Error> {
        if let Some(failure) = &self.failure {
            return Err(failure.clone());
        }
        let result = self.advance().map_err(Error::Run);
        if let Err(error) = &result {
            self.failure = Some(error.clone());
        }
        result
    }

    /// Hands the finished blocks out and forgets them.
    pub(crate) fn take_blocks(&mut self, take: impl FnMut(&str, &Origin)) {
        self.show_blocks(take);
        self.forget_blocks();
    }

    /// Hands out the blocks that nobody has seen yet.
    fn show_blocks(&mut self, mut take: impl FnMut(&str, &Origin)) {
        let tape = &self.outside.post.control.tape;
        let Some(noted) = &tape.noted else { return };
        for block in &noted.blocks[self.shown..] {
            let text = String::from_utf8_lossy(&tape.text[block.range.clone()]);
            let origin = tape.stacks.origin(block.cause);
            take(&text, &origin);
            for observer in self.outside.observers.iter_mut() {
                observer(WhatHappened::Block { text: &text, origin: &origin });
            }
        }
        self.shown = noted.blocks.len();
    }

    fn forget_blocks(&mut self) {
        let tape = &mut self.outside.post.control.tape;
        if let Some(noted) = &mut tape.noted {
            noted.clear();
        }
        tape.text.clear();
        self.shown = 0;
    }

    fn flush(&mut self, nc: &mut impl Write) -> Result<(), Error> {
        let tape = &mut self.outside.post.control.tape;
        nc.write_all(&tape.text).map_err(write_error)?;
        self.outside.report.bytes += tape.text.len() as u64;
        if let Some(map) = &mut self.outside.map {
            map.blocks(tape);
        }
        self.forget_blocks();
        Ok(())
    }

    fn advance(&mut self) -> Result<bool, Box<Diag>> {
        let first = !std::mem::replace(&mut self.started, true);
        if let Some(machine) = self.machine.as_mut().filter(|_| first) {
            machine.run_globals(&mut self.vocabulary, &mut self.outside)?;
        }
        if !self.outside.read(&mut self.record, &mut self.vocabulary)? {
            self.outside.end_of_file()?;
            return Ok(false);
        }
        self.watch_progress()?;
        let section = if self.has_sections && self.record.kind != kind::PSEUDO {
            self.outside.module.find(&self.record, &self.vocabulary)
        } else {
            None
        };
        match (section, &mut self.machine) {
            (Some(section), Some(machine)) => {
                let (number, line) = (self.record.number, self.record.line);
                self.outside.section = Some(section);
                let outcome = machine.run_section(
                    section,
                    &mut self.record,
                    &mut self.vocabulary,
                    &mut self.outside,
                )?;
                self.outside.section = None;
                let mut swallowed = outcome.swallowed();
                if self.outside.module.compat.section == SectionMode::Process
                    && !outcome.processed
                    && !outcome.replaced
                {
                    swallowed = false;
                    self.outside.process(&self.record, &self.vocabulary)?;
                }
                self.outside.section_done(section, (number, line), swallowed);
            }
            _ => self.outside.process(&self.record, &self.vocabulary)?,
        }
        if self.outside.ended {
            self.outside.after_fini(&mut self.record, &mut self.vocabulary)?;
            return Ok(false);
        }
        Ok(true)
    }

    /// Refuses a run that reads the same records again and again.
    fn watch_progress(&mut self) -> Result<(), Box<Diag>> {
        if self.record.number > self.furthest {
            self.furthest = self.record.number;
            return Ok(());
        }
        if let Some(left) = self.fuel.checked_sub(FUEL_OF_READING_AGAIN) {
            self.fuel = left;
            return Ok(());
        }
        let message = format!("record {} is read again and again", self.record.number);
        let place = self.outside.place(&self.record, &self.vocabulary);
        Err(Box::new(Diag::new(fil_vm::errors::RunCode::OutOfFuel, message).at(place)))
    }
}

fn write_error(error: std::io::Error) -> Error {
    Error::Run(Box::new(Diag::new(RunCode::CantWrite, error.to_string())))
}
