//! What a FIL machine reaches while it runs: records, the post, the report.

use std::io::Read;
use std::sync::Arc;

use fil_cl::vocabulary::words;
use fil_cl::{Record, Vocabulary, reader::Dialect, record::kind};
use fil_diag::{Diag, Place};
use fil_machine::locations::MESSAGE_TO_TAPE;
use fil_post::FilLine;
use fil_vm::{CommonKind, Files, Host, Module, Moment, SectionId, Site};

use crate::error::RunCode;
use crate::granted::Granted;
use crate::map;
use crate::observe::{Observer, SectionEvent, WhatHappened};
use crate::report::{Extents, Report};
use crate::source::Source;
use crate::statement::statement_text;

/// What a FIL machine reaches while it runs: reader and post.
pub(crate) struct Outside<'p, R: Read> {
    /// The CL records.
    pub source: Source<R>,
    /// The compiled FIL.
    pub module: Arc<Module>,
    /// The post.
    pub post: fil_post::Post,
    /// What the run has to tell.
    pub report: Report,
    /// The embedding program's observers.
    pub observers: &'p mut Vec<Observer>,
    /// Name of the CL file in messages.
    pub cl_name: &'p str,
    /// The post has carried out FINI.
    pub ended: bool,
    /// FIL has asked for the development listing.
    pub trace: bool,
    /// The line map of the run.
    pub map: Option<map::Writer<'p>>,
    /// The section that runs.
    pub section: Option<SectionId>,
    /// Clock, commands and files.
    pub granted: Granted<'p>,
}

impl<R: Read> Outside<'_, R> {
    /// Reads the next record; what the post writes from now on is due to it.
    pub fn read(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        let more = self.source.read(record, vocabulary)?;
        if more {
            self.post.control.tape.cause.record = record.number;
            self.post.control.tape.cause.line = record.line;
            for observer in self.observers.iter_mut() {
                observer(WhatHappened::Record(record, vocabulary));
            }
        }
        Ok(more)
    }

    /// The post carries out a record; what it says gets the place in the CL file,
    /// or in FIL for a record that FIL has made.
    pub fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        if record.major == words::PPRINT && !self.post.control.commons.read(MESSAGE_TO_TAPE) {
            for observer in self.observers.iter_mut() {
                observer(WhatHappened::Message(record.text.trim_end()));
            }
        }
        let known = self.post.control.warnings.list.len();
        let result = self.post.process(record, vocabulary);
        if result.is_err() || self.post.control.warnings.list.len() > known {
            let place = self.place(record, vocabulary);
            for warning in &mut self.post.control.warnings.list[known..] {
                warning.places.push(place.clone());
            }
            // The machine itself adds the FIL line to an error.
            let made_by_fil = self.fil_line(record).is_some();
            result.map_err(|diag| if made_by_fil { diag } else { Box::new(diag.at(place)) })?;
        }
        if let (kind::MOTION, Some(point)) = (record.kind, self.post.point()) {
            Extents::add(&mut self.report.extents, point);
        }
        self.ended |= record.kind == kind::FINI;
        Ok(())
    }

    /// The FIL line that made a record.
    fn fil_line(&self, record: &Record) -> Option<FilLine> {
        let tape = &self.post.control.tape;
        tape.stacks.lines(tape.cause.stack).first().copied().filter(|_| record.line == 0)
    }

    /// Where a record stands: in the CL file, or in FIL for one that FIL has made.
    pub fn place(&self, record: &Record, vocabulary: &Vocabulary) -> Place {
        if let Some(made) = self.fil_line(record) {
            let file = &self.module.files[usize::from(made.file)].name;
            return Place::line(file, made.line, statement_text(record, vocabulary));
        }
        let line = if record.line == 0 { self.post.control.tape.cause.line } else { record.line };
        Place::line(self.cl_name, line, statement_text(record, vocabulary))
    }

    /// Notes what a section did with its record, given by number and line.
    pub fn section_done(
        &mut self,
        section: SectionId,
        (record, line): (u32, u32),
        swallowed: bool,
    ) {
        let key = self.module.section_key(section);
        if swallowed {
            if let Some(map) = &mut self.map {
                map.taken(map::Taken { line, record, section: section.index() });
            }
            *self.report.swallowed.entry(key.to_string()).or_default() += 1;
        }
        if !self.observers.is_empty() {
            let traced = self.trace;
            let event = SectionEvent { key: key.to_string(), record, swallowed, traced };
            for observer in self.observers.iter_mut() {
                observer(WhatHappened::Section(&event));
            }
        }
    }

    /// The CL file ended without FINI; the program ends here.
    ///
    /// # Errors
    /// A record that waits for its continuation.
    pub fn end_of_file(&mut self) -> Result<(), Box<Diag>> {
        if self.source.records == 0 {
            let diag = Diag::new(RunCode::NoMotion, format!("{} holds no record", self.cl_name));
            self.report.warnings.push(diag);
        } else if !matches!(self.source.dialect(), Some(Dialect::Nx | Dialect::SolidWorksCam)) {
            let diag = Diag::new(RunCode::NoFini, format!("{} has no FINI", self.cl_name));
            self.report.warnings.push(diag);
        }
        self.post.finish()
    }

    /// Warns of records after FINI.
    ///
    /// # Errors
    /// What the reader refuses.
    pub fn after_fini(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.source.read(record, vocabulary)? {
            let place = self.place(record, vocabulary);
            let diag = Diag::new(RunCode::AfterFini, "what follows is not posted").at(place);
            self.report.warnings.push(diag);
        }
        Ok(())
    }
}

impl<R: Read> Host for Outside<'_, R> {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        self.post.control.commons.get(common_kind(kind), location)
    }

    fn set_common(&mut self, kind: CommonKind, location: u32, value: f64) -> Result<(), Box<Diag>> {
        self.post.control.commons.set(common_kind(kind), location, value)
    }

    fn clear_common(&mut self, kind: CommonKind, location: u32) -> Result<(), Box<Diag>> {
        self.post.control.commons.set(common_kind(kind), location, fil_machine::commons::EMPTY)
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
        let result = self.process(record, vocabulary);
        self.post.control.tape.cause.stack = 0;
        result
    }

    fn next_record(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        let mut next = Record::default();
        while !self.ended && self.read(&mut next, vocabulary)? {
            if next.kind != kind::PSEUDO {
                *record = next;
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
        }
        Ok(there)
    }

    fn warn(&mut self, diag: Diag) {
        self.report.warnings.push(diag);
    }

    fn trace(&mut self, on: bool) {
        self.trace = on;
    }

    fn files(&mut self) -> Option<&mut dyn Files> {
        self.granted.files.as_mut().map(|files| files as &mut dyn Files)
    }

    fn now(&mut self) -> Option<Moment> {
        self.granted.now()
    }

    fn spawn(&mut self, command: &str) -> Option<Result<f64, String>> {
        self.granted.spawn(command)
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

    fn named_common(&mut self, name: &str) -> Option<Result<f64, Box<Diag>>> {
        let row = fil_machine::locations::Location::named(&name.to_ascii_lowercase())?;
        Some(self.post.control.commons.get(row.kind, u32::from(row.number)))
    }
}

pub(crate) fn common_kind(kind: CommonKind) -> fil_machine::Kind {
    match kind {
        CommonKind::Int => fil_machine::Kind::Int,
        CommonKind::Rel => fil_machine::Kind::Rel,
        CommonKind::Dbl => fil_machine::Kind::Dbl,
    }
}
