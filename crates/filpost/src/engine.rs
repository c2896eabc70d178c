//! One run: records from the reader, through their sections, into the post.

use std::collections::VecDeque;
use std::io::{Read, Write};

use fil_cl::{Record, Vocabulary, reader::Dialect, reader::Reader, record::kind};
use fil_diag::{Diag, Place};
use fil_post::{FilLine, Origin};
use fil_vm::{CommonKind, Host, Machine, Module, SectionMode, Site};

use crate::builder::Post;
use crate::error::{Error, RunCode};
use crate::observe::{Observer, SectionEvent, WhatHappened};
use crate::report::{Extents, Report};
use crate::statement::statement_text;

/// Bytes of finished blocks that are kept before they go to the writer.
const FLUSH: usize = 64 * 1024;

/// Records NEXTF looks through for the next motion.
const LOOK_AHEAD: usize = 1000;

/// Fuel that a record costs which the run has read before: a section that goes
/// back each time it runs would never let the run end.
const FUEL_OF_READING_AGAIN: u64 = 100;

/// X Y Z I J K of a motion record; without a tool axis of its own I J K are absent.
type Coordinates = [Option<f64>; 6];

/// What a FIL machine reaches while it runs: reader and post.
struct Outside<'p, R: Read> {
    reader: Reader<R>,
    /// Records NEXTF has looked at and nobody has read yet.
    ahead: VecDeque<Record>,
    /// The last two motions read, and whether the current record is the last of them.
    motions: [Option<Coordinates>; 2],
    on_motion: bool,
    keeps_motions: bool,
    module: std::sync::Arc<Module>,
    post: fil_post::Post,
    report: Report,
    observers: &'p mut Vec<Observer>,
    cl_name: &'p str,
    /// The post has carried out FINI.
    ended: bool,
    /// FIL has asked for the development listing.
    trace: bool,
}

/// A run of a [`Post`].
pub(crate) struct Engine<'p, R: Read> {
    outside: Outside<'p, R>,
    vocabulary: Vocabulary,
    machine: Option<Machine>,
    module: std::sync::Arc<Module>,
    has_sections: bool,
    /// The last record of the file that was reached, and fuel left to read it
    /// and those before it again.
    furthest: u32,
    fuel: u64,
    functions_home: &'p mut fil_vm::Functions,
    record: Record,
    started: bool,
    failure: Option<Error>,
}

impl<'p, R: Read> Engine<'p, R> {
    /// A run from the start. `observed`: keep the provenance of blocks.
    pub(crate) fn new(post: &'p mut Post, reader: Reader<R>, observed: bool) -> Self {
        let (tape, failure) = match fil_post::Post::new(post.commons.clone()) {
            Ok(post) => (post, None),
            Err(diag) => {
                let absent = fil_post::locations::default_commons();
                let spare = fil_post::Post::new(absent).expect("the default machine is a machine");
                (spare, Some(Error::Run(diag)))
            }
        };
        let functions = std::mem::take(&mut post.functions);
        let machine = Machine::new(post.module.clone(), post.limits, functions);
        let has_sections = !post.module.has_no_section();
        let mut outside = Outside {
            reader,
            ahead: VecDeque::new(),
            motions: [None; 2],
            on_motion: false,
            keeps_motions: has_sections,
            module: post.module.clone(),
            post: tape,
            report: Report::default(),
            observers: &mut post.observers,
            cl_name: &post.cl_name,
            ended: false,
            trace: false,
        };
        outside.post.tape.observe = observed;
        Engine {
            outside,
            vocabulary: post.vocabulary.clone(),
            machine: Some(machine),
            has_sections,
            furthest: 0,
            fuel: post.limits.fuel,
            module: post.module.clone(),
            functions_home: &mut post.functions,
            record: Record::default(),
            started: false,
            failure,
        }
    }

    /// Gives the embedding program's functions back to the post.
    pub(crate) fn finish(&mut self) {
        if let Some(machine) = self.machine.take() {
            *self.functions_home = machine.into_functions();
        }
    }

    /// Runs to the end.
    pub(crate) fn run(&mut self, nc: &mut impl Write) -> Result<Report, Error> {
        while self.step()? {
            let tape = &self.outside.post.tape;
            if tape.observe || tape.text.len() >= FLUSH {
                self.flush(nc)?;
            }
        }
        self.flush(nc)?;
        nc.flush().map_err(write_error)?;
        let mut report = std::mem::take(&mut self.outside.report);
        report.blocks = self.outside.post.tape.count;
        report.warnings.append(&mut self.outside.post.warnings);
        Ok(report)
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
    pub(crate) fn take_blocks(&mut self, mut take: impl FnMut(&str, &Origin)) {
        let tape = &mut self.outside.post.tape;
        for block in &tape.blocks {
            let text = String::from_utf8_lossy(&tape.text[block.range.clone()]);
            take(&text, &block.origin);
            for observer in self.outside.observers.iter_mut() {
                observer(WhatHappened::Block { text: &text, origin: &block.origin });
            }
        }
        tape.blocks.clear();
        self.outside.report.bytes += tape.text.len() as u64;
        tape.text.clear();
    }

    fn flush(&mut self, nc: &mut impl Write) -> Result<(), Error> {
        nc.write_all(&self.outside.post.tape.text).map_err(write_error)?;
        self.take_blocks(|_, _| {});
        Ok(())
    }

    fn advance(&mut self) -> Result<bool, Box<Diag>> {
        if !std::mem::replace(&mut self.started, true) {
            if let Some(machine) = &mut self.machine {
                machine.run_globals(&mut self.vocabulary, &mut self.outside)?;
            }
        }
        if !self.outside.read(&mut self.record, &mut self.vocabulary)? {
            self.outside.end_of_file()?;
            return Ok(false);
        }
        self.watch_progress()?;
        let section = if self.has_sections && self.record.kind != kind::PSEUDO {
            self.module.find(&self.record, &self.vocabulary)
        } else {
            None
        };
        match (section, &mut self.machine) {
            (Some(section), Some(machine)) => {
                let number = self.record.number;
                let outcome = machine.run_section(
                    section,
                    &mut self.record,
                    &mut self.vocabulary,
                    &mut self.outside,
                )?;
                let mut swallowed = outcome.swallowed();
                if self.module.compat.section == SectionMode::Process
                    && !outcome.processed
                    && !outcome.replaced
                {
                    swallowed = false;
                    self.outside.process(&self.record, &self.vocabulary)?;
                }
                let key = self.module.section_key(section);
                self.outside.section_done(key, number, swallowed);
            }
            _ => self.outside.process(&self.record, &self.vocabulary)?,
        }
        if self.outside.ended {
            self.outside.after_fini(&mut self.record, &mut self.vocabulary)?;
            return Ok(false);
        }
        Ok(true)
    }
}

impl<R: Read> Engine<'_, R> {
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

impl<R: Read> Outside<'_, R> {
    fn read(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        let more = match self.ahead.pop_front() {
            Some(next) => {
                *record = next;
                true
            }
            None => self.reader.read(vocabulary, record)?,
        };
        if more {
            self.report.records += 1;
            if self.keeps_motions {
                self.remember(record);
            }
            self.post.tape.origin.record = record.number;
            self.post.tape.origin.line = record.line;
            for observer in self.observers.iter_mut() {
                observer(WhatHappened::Record(record, vocabulary));
            }
        }
        Ok(more)
    }

    /// Keeps the coordinates of a motion for PREVF.
    fn remember(&mut self, record: &Record) {
        self.on_motion = record.kind == kind::MOTION;
        if self.on_motion {
            self.motions = [self.motions[1], Some(coordinates(record))];
        }
    }

    /// The next motion, read ahead of the current record.
    fn next_motion(
        &mut self,
        vocabulary: &mut Vocabulary,
    ) -> Result<Option<Coordinates>, Box<Diag>> {
        for index in 0..LOOK_AHEAD {
            if index == self.ahead.len() {
                let mut next = Record::default();
                if !self.reader.read(vocabulary, &mut next)? {
                    break;
                }
                self.ahead.push_back(next);
            }
            match self.ahead[index].kind {
                kind::MOTION => return Ok(Some(coordinates(&self.ahead[index]))),
                kind::FINI => break,
                _ => {}
            }
        }
        Ok(None)
    }

    /// The post carries out a record; what it says gets the place in the CL file,
    /// or in FIL for a record that FIL has made.
    fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        let known = self.post.warnings.len();
        let result = self.post.process(record, vocabulary);
        if result.is_err() || self.post.warnings.len() > known {
            let place = self.place(record, vocabulary);
            for warning in &mut self.post.warnings[known..] {
                warning.places.push(place.clone());
            }
            // The machine itself adds the FIL line to an error.
            let made_by_fil = self.fil_line(record).is_some();
            result.map_err(|diag| if made_by_fil { diag } else { Box::new(diag.at(place)) })?;
        }
        if record.kind == kind::MOTION {
            if let Some(point) = self.post.point() {
                Extents::add(&mut self.report.extents, point);
            }
        }
        self.ended |= record.kind == kind::FINI;
        Ok(())
    }

    /// The FIL line that made a record.
    fn fil_line(&self, record: &Record) -> Option<FilLine> {
        self.post.tape.origin.fil.first().copied().filter(|_| record.line == 0)
    }

    fn place(&self, record: &Record, vocabulary: &Vocabulary) -> Place {
        if let Some(made) = self.fil_line(record) {
            let file = &self.module.files[usize::from(made.file)].name;
            return Place::line(file, made.line, statement_text(record, vocabulary));
        }
        let line = if record.line == 0 { self.post.tape.origin.line } else { record.line };
        Place::line(self.cl_name, line, statement_text(record, vocabulary))
    }

    fn section_done(&mut self, key: &str, record: u32, swallowed: bool) {
        if swallowed {
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

    /// The CL file ended without FINI.
    fn end_of_file(&mut self) -> Result<(), Box<Diag>> {
        if self.report.records == 0 {
            let diag = Diag::new(RunCode::NoMotion, format!("{} holds no record", self.cl_name));
            self.report.warnings.push(diag);
        } else if !matches!(self.reader.dialect(), Some(Dialect::Nx | Dialect::SolidWorksCam)) {
            let diag = Diag::new(RunCode::NoFini, format!("{} has no FINI", self.cl_name));
            self.report.warnings.push(diag);
        }
        self.post.finish()
    }

    fn after_fini(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.reader.read(vocabulary, record)? {
            let place = self.place(record, vocabulary);
            let diag = Diag::new(RunCode::AfterFini, "what follows is not posted").at(place);
            self.report.warnings.push(diag);
        }
        Ok(())
    }
}

impl<R: Read> Host for Outside<'_, R> {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        self.post.commons.get(common_kind(kind), location)
    }

    fn set_common(&mut self, kind: CommonKind, location: u32, value: f64) -> Result<(), Box<Diag>> {
        self.post.commons.set(common_kind(kind), location, value)
    }

    fn clear_common(&mut self, kind: CommonKind, location: u32) -> Result<(), Box<Diag>> {
        self.post.commons.set(common_kind(kind), location, fil_post::commons::EMPTY)
    }

    fn command(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
        site: &Site,
    ) -> Result<(), Box<Diag>> {
        let fil = &mut self.post.tape.origin.fil;
        fil.clear();
        fil.extend(site.stack().map(|(file, line)| FilLine { file, line }));
        let result = self.process(record, vocabulary);
        self.post.tape.origin.fil.clear();
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
        self.reader.seek_record(number)?;
        self.ahead.clear();
        self.motions = [None; 2];
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

    fn neighbour(
        &mut self,
        next: bool,
        coordinate: usize,
        vocabulary: &mut Vocabulary,
    ) -> Result<Option<f64>, Box<Diag>> {
        let found = match (next, self.on_motion) {
            (true, _) => self.next_motion(vocabulary)?,
            (false, true) => self.motions[0],
            (false, false) => self.motions[1],
        };
        Ok(found.and_then(|motion| motion[coordinate]))
    }

    fn named_common(&mut self, name: &str) -> Option<Result<f64, Box<Diag>>> {
        let row = fil_post::locations::Location::named(&name.to_ascii_lowercase())?;
        Some(self.post.commons.get(row.kind, u32::from(row.number)))
    }
}

fn coordinates(record: &Record) -> Coordinates {
    let mut found = [None; 6];
    let parts = record.point().into_iter().chain(record.axis());
    for (place, part) in parts.enumerate() {
        for (slot, value) in found[place * 3..].iter_mut().zip(part) {
            *slot = Some(value);
        }
    }
    found
}

fn common_kind(kind: CommonKind) -> fil_post::Kind {
    match kind {
        CommonKind::Int => fil_post::Kind::Int,
        CommonKind::Rel => fil_post::Kind::Rel,
        CommonKind::Dbl => fil_post::Kind::Dbl,
    }
}

fn write_error(error: std::io::Error) -> Error {
    Error::Run(Box::new(Diag::new(RunCode::CantWrite, error.to_string())))
}
