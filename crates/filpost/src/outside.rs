//! What a FIL machine reaches while it runs: records, the post, the report.

use std::cell::RefCell;
use std::collections::HashSet;
use std::sync::Arc;

use fil_cl::vocabulary::words;
use fil_cl::{Evidence, Record, Vocabulary, Word, keyed_cycle, record::kind};
use fil_diag::{Code, Diag, TextSpan};
use fil_machine::commons::EMPTY;
use fil_machine::locations::{INPUT_CREO_RECORDS, MESSAGE_TO_TAPE, PROGRAM_TIME_STAMP};
use fil_machine::{Kind, Unit, stored};
use fil_post::FilLine;
use fil_post::errors::PostCode;
use fil_vm::{
    CommonKind, Files, Host, Module, Moment, OutputMacro, SectionId, Site, TotalsOf, TotalsText,
    TotalsWord, Values, View, debug::Probe,
};

use crate::cancel::CancelToken;
use crate::debug::{self, DebugState, SharedDebugger, World};
use crate::editing::{SharedEditor, edits};
use crate::error::RunCode;
use crate::event::{Event, LineEditor, Observer, RunEnd};
use crate::granted::Granted;
use crate::listing::ListingRules;
use crate::map;
use crate::overview::Counted;
use crate::passes::Pass;
use crate::program::Program;
use crate::report::{Extents, Report};
use crate::run::Start;
use crate::select;
use crate::source::{Source, Stream, changes_tool};
use crate::spilled::Spilled;
use crate::statement::statement_text;
use crate::tally::{Before, Tally};
use crate::units::{self, UnitSource};

/// What a FIL machine reaches while it runs: reader and post.
pub(crate) struct Outside<'o, 'r> {
    /// The program of the run.
    pub program: Program,
    /// The CL records.
    pub source: Source<'r>,
    /// The compiled FIL.
    pub module: Arc<Module>,
    /// The post.
    pub post: fil_post::Post,
    /// What the run has to tell.
    pub report: Report,
    /// The embedding program's observers.
    pub observers: Vec<Observer<'o>>,
    /// Records are given to sections as they are written.
    raw: bool,
    /// Lengths and times, while somebody looks on.
    pub tally: Option<Box<Tally>>,
    /// Which pass over the CL file this is.
    pub pass: Pass,
    /// Number of the last record that the post has carried out, in a first pass.
    pub last_done: u32,
    /// Records need more than to be carried out: they are raw, or counted.
    careful: bool,
    /// The unit that whoever started the run has said.
    units: Option<Unit>,
    /// What stops the run.
    cancel: Option<CancelToken>,
    /// Name of the CL file in messages.
    cl_name: String,
    /// The post has carried out FINI.
    pub ended: bool,
    /// A section has taken FINI.
    pub fini_taken: bool,
    /// FIL has asked for the development listing.
    trace: bool,
    /// The line map of the run.
    pub map: Option<map::Writer<'o>>,
    /// Locations without effect that FIL has set.
    idle: HashSet<(Kind, u32)>,
    /// The section that runs.
    pub section: Option<SectionId>,
    /// Who edits what the post writes; `None` where FIL has no macro for it.
    pub editor: Option<SharedEditor>,
    /// Clock and files.
    pub granted: Granted,
    /// Blocks on the tape that observers have seen.
    pub shown: usize,
    /// What the current record has written beyond what is kept in memory.
    pub spilled: Option<Spilled>,
    /// Who debugs the run.
    pub debugger: Option<SharedDebugger>,
    /// The debugger knows of the error that ends the run.
    pub told_failure: bool,
}

impl<'o, 'r> Outside<'o, 'r> {
    /// Everything as it is before the first record.
    pub fn new(start: Start<'o>, records: Stream<'r>) -> Self {
        let Start { program, cl_name, raw, units, cancel, observers, map, pass, debugger } = start;
        let shared = &program.shared;
        let counts = !observers.is_empty() || !matches!(pass, Pass::Only);
        let module = Arc::clone(&shared.module);
        Outside {
            source: Source::new(records, raw || !module.has_no_section()),
            module,
            post: shared.prototype.clone(),
            report: Report::default(),
            careful: raw || counts,
            tally: counts.then(Box::default),
            pass,
            last_done: 0,
            observers,
            raw,
            units,
            cancel,
            cl_name,
            ended: false,
            fini_taken: false,
            trace: false,
            map,
            idle: HashSet::new(),
            section: None,
            editor: None,
            granted: Granted::new(shared.clock, shared.folders.clone()),
            shown: 0,
            spilled: None,
            debugger,
            told_failure: false,
            program,
        }
    }

    /// Tells the post the unit that the CL file need not say.
    ///
    /// # Errors
    /// E0715 for a unit that the machine does not take.
    pub fn begin(&mut self) -> Result<(), Box<Diag>> {
        self.report.unit = units::known_before(self.units, &self.post.control.commons)?;
        if let Some((unit, _)) = self.report.unit {
            self.post.assume_unit(unit);
        }
        if self.post.control.commons.read(PROGRAM_TIME_STAMP) {
            let Some(now) = self.granted.now() else {
                return fil_vm::errors::RunCode::ClockNotGranted
                    .err("the machine writes date and time (program.time_stamp)");
            };
            self.post.control.head.time = Some(now.to_string().replace('T', " "));
        }
        if self.source.recognized().is_none_or(|found| found.evidence == Evidence::Chosen) {
            self.post.trust_arcs();
        }
        Ok(())
    }

    /// Reads the next record; what the post writes from now on is caused by it.
    #[inline(always)]
    pub fn read(
        &mut self,
        record: &mut Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<bool, Box<Diag>> {
        self.check_cancelled()?;
        let more = self.source.read(record, vocabulary)?;
        if more {
            self.post.control.tape.cause.record = record.number;
            self.post.control.tape.cause.line = record.line;
            if record.major == words::MACHIN {
                select::note(&mut self.report.machines, record, vocabulary);
            }
            if let Some(overview) = self.pass.counted() {
                overview.note(record);
            }
            for observer in self.observers.iter_mut() {
                observer(Event::Record { record, vocabulary });
            }
        }
        Ok(more)
    }

    /// The section that takes a record. One of Creo's behind `$$->` goes to sections where
    /// the machine says so; END there ends an NC sequence and not the program.
    pub fn section_of(&self, record: &Record, vocabulary: &Vocabulary) -> Option<SectionId> {
        let is_note = record.kind == kind::PSEUDO
            && (record.major == words::END || !self.post.control.commons.read(INPUT_CREO_RECORDS));
        if is_note { None } else { self.module.find(record, vocabulary) }
    }

    /// Tells the post which tools come behind a record that takes one, and which tool axes
    /// behind a RAPID, where its machine asks for it.
    ///
    /// # Errors
    /// A file that can't be gone back in.
    #[inline(always)]
    pub fn look_ahead(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if record.kind != kind::MOTION && changes_tool(record) {
            return self.look_for_tools(record, vocabulary);
        }
        if record.kind != kind::MOTION && record.major == words::RAPID {
            self.look_for_axes(vocabulary);
        }
        Ok(())
    }

    #[cold]
    fn look_for_axes(&mut self, vocabulary: &mut Vocabulary) {
        if self.post.looks_ahead_for_axes() {
            self.post.path.coming = self.source.axes_ahead(vocabulary);
        }
    }

    #[cold]
    fn look_for_tools(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.post.looks_ahead_for_tools() {
            self.post.path.next_tools = self.source.next_tools(record, vocabulary)?;
        }
        Ok(())
    }

    /// The post carries out a record, or what one means that is given as it is written.
    pub fn process(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        if self.careful {
            return self.process_carefully(record, vocabulary);
        }
        self.carry_out(record, vocabulary)
    }

    #[cold]
    fn process_carefully(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.raw && record.line != 0 {
            return self.process_written(record, vocabulary);
        }
        self.carry_out_counted(record, vocabulary)
    }

    /// Carries out a record and counts its motion, where somebody looks on.
    fn carry_out_counted(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        let before = Before::new(&self.post);
        self.last_done = record.number;
        self.carry_out(record, vocabulary)?;
        let Some(tally) = &mut self.tally else { return Ok(()) };
        let other_seconds = tally.total.other_seconds;
        let motion = tally.count(&before, record, &self.post);
        if let Some(overview) = self.pass.counted() {
            let counted = Counted {
                motion,
                other_seconds: tally.total.other_seconds - other_seconds,
                diameter: self.source.diameter(),
                unit: self.post.unit(),
            };
            overview.count(record, self.post.control.tape.cause.record, &counted);
        }
        if let Some(motion) = motion {
            for observer in self.observers.iter_mut() {
                observer(Event::Motion(motion));
            }
        }
        Ok(())
    }

    /// Tells the observers that a record and all it has caused are over.
    ///
    /// # Errors
    /// What the script's macro for lines of listings refuses.
    pub fn record_done(&mut self) -> Result<(), Box<Diag>> {
        let failure = RefCell::new(None);
        let commons = &self.post.control.commons;
        let editor = self.editor.as_ref().filter(|_| edits(commons).listing);
        let edit = |line: &mut String| {
            if let Some(editor) = editor
                && failure.borrow().is_none()
                && let Err(diag) = editor.edit_line(OutputMacro::Listing, line, commons)
            {
                *failure.borrow_mut() = Some(diag);
            }
        };
        let rules = ListingRules::of(commons);
        for observer in self.observers.iter_mut() {
            observer(Event::RecordDone { lines: LineEditor(&edit), rules });
        }
        failure.into_inner().map_or(Ok(()), Err)
    }

    /// Tells the observers what the run has counted.
    ///
    /// # Errors
    /// As [`Outside::record_done`].
    pub fn run_done(&mut self) -> Result<(), Box<Diag>> {
        if let Some(tally) = &self.tally {
            let (blocks, bytes) = (self.report.blocks, self.report.bytes);
            let end = RunEnd { tally, report: &self.report, blocks, bytes };
            for observer in self.observers.iter_mut() {
                observer(Event::End(end));
            }
        }
        self.record_done()
    }

    #[cold]
    fn process_written(
        &mut self,
        record: &Record,
        vocabulary: &Vocabulary,
    ) -> Result<(), Box<Diag>> {
        let place = |diag: Box<Diag>| {
            if diag.spans.is_empty() {
                Box::new(diag.at(self.place(record, vocabulary)))
            } else {
                diag
            }
        };
        match self.source.written.meant_by(record).map_err(place)? {
            None => self.carry_out_counted(record, vocabulary),
            Some(meant) => meant.iter().try_for_each(|one| self.carry_out_counted(one, vocabulary)),
        }
    }

    /// The post carries out a record; what it says gets the place in the CL file,
    /// or in FIL for a record that FIL has made.
    fn carry_out(&mut self, record: &Record, vocabulary: &Vocabulary) -> Result<(), Box<Diag>> {
        if record.major == words::PPRINT && !self.post.control.commons.read(MESSAGE_TO_TAPE) {
            for observer in self.observers.iter_mut() {
                observer(Event::Message(record.text.trim_end()));
            }
        }
        let result = self.post.process(record, vocabulary);
        if matches!(record.major, words::UNITS | words::UNIT) {
            self.report.unit = self.post.unit().map(|unit| (unit, UnitSource::Statement));
        }
        if result.is_err() || !self.post.control.warnings.list.is_empty() {
            let place = self.place(record, vocabulary);
            self.take_warnings(Some(&place));
            // The machine itself adds the FIL line to an error.
            let made_by_fil = self.fil_line(record).is_some();
            let result = result.map_err(|diag| self.name_dialects(diag));
            result.map_err(|diag| if made_by_fil { diag } else { Box::new(diag.at(place)) })?;
        }
        if record.kind == kind::MOTION {
            if let Some(point) = self.post.point() {
                Extents::add(&mut self.report.extents, point);
            }
        } else if matches!(record.major, words::POSTN | words::REPEAT) {
            self.report.words_beside = true;
        }
        self.ended |= record.kind == kind::FINI;
        Ok(())
    }

    /// Tells the warnings of the post, which came at this place.
    fn take_warnings(&mut self, place: Option<&TextSpan>) {
        for mut warning in std::mem::take(&mut self.post.control.warnings.list) {
            warning.spans.extend(place.cloned());
            self.tell(warning);
        }
    }

    /// Puts a warning into the report and tells the observers.
    fn tell(&mut self, warning: Diag) {
        for observer in self.observers.iter_mut() {
            observer(Event::Warning(&warning));
        }
        self.report.warnings.push(warning);
    }

    /// Notes in the report how far the run has come.
    pub fn note_counts(&mut self) {
        self.report.records = self.source.records;
        self.report.blocks = self.post.control.tape.count;
        self.report.dialect = self.source.recognized();
        self.report.splines = self.source.splines();
    }

    /// The FIL line that made a record.
    fn fil_line(&self, record: &Record) -> Option<FilLine> {
        let tape = &self.post.control.tape;
        tape.stacks.lines(tape.cause.stack).first().copied().filter(|_| record.line == 0)
    }

    /// Where a record stands: in the CL file, or in FIL for one that FIL has made.
    pub fn place(&self, record: &Record, vocabulary: &Vocabulary) -> TextSpan {
        if let Some(made) = self.fil_line(record) {
            let file = &self.module.files[usize::from(made.file)].name;
            return TextSpan::line(file, made.line, statement_text(record, vocabulary));
        }
        let line = if record.line == 0 { self.post.control.tape.cause.line } else { record.line };
        TextSpan::line(&self.cl_name, line, statement_text(record, vocabulary))
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
        for observer in self.observers.iter_mut() {
            observer(Event::Section { key, record, swallowed, traced: self.trace });
        }
    }

    /// The CL file ended without FINI; the program ends here.
    ///
    /// # Errors
    /// A record that waits for its continuation.
    pub fn end_of_file(&mut self) -> Result<(), Box<Diag>> {
        self.warn_of_other_signs();
        if self.source.records == 0 {
            self.tell(*RunCode::NoMotion.diag(format!("{} holds no record", self.cl_name)));
        } else if !self.fini_taken
            && self.source.recognized().is_none_or(|found| found.dialect.rules().writes_fini)
        {
            self.tell(*RunCode::NoFini.diag(format!("{} has no FINI", self.cl_name)));
        }
        let result = self.post.finish();
        self.take_warnings(None);
        result.map_err(|diag| self.name_dialects(diag))
    }

    /// Names the dialects that would turn the arcs the other way, where the sense of arcs is
    /// refused.
    fn name_dialects(&self, mut diag: Box<Diag>) -> Box<Diag> {
        let sense: &Code = PostCode::ArcSense.into();
        let found = self.source.recognized().map(|found| found.dialect);
        if let Some(dialect) = found.filter(|_| diag.code == sense) {
            let fitting = dialect.turning_otherwise();
            let names: Vec<String> =
                fitting.iter().map(|other| format!("--dialect {other}")).collect();
            diag.hint = Some(match &names[..] {
                [] => format!(
                    "no dialect turns the arcs of {dialect} the other way: look at them in a backplot"
                ),
                _ => format!(
                    "{} reads them the other way; --dialect {dialect} says that they are as {dialect} \
                     means them",
                    names.join(" or ")
                ),
            });
        }
        diag
    }

    /// Warns of a sign that contradicts the dialect that was chosen.
    fn warn_of_other_signs(&mut self) {
        let Some(found) = self.source.recognized() else { return };
        let Some((other, line)) = found.against else { return };
        let message =
            format!("line {line} shows that the text is from {other}, read as {}", found.dialect);
        self.tell(RunCode::OtherSigns.diag(message).at(TextSpan::line(&self.cl_name, line, "")));
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
        let more = self.source.read(record, vocabulary)?;
        self.warn_of_other_signs();
        if more {
            let place = self.place(record, vocabulary);
            self.tell(RunCode::AfterFini.diag("what follows is not posted").at(place));
        }
        Ok(())
    }
}

impl Host for Outside<'_, '_> {
    fn common(&mut self, kind: CommonKind, location: u32) -> Result<f64, Box<Diag>> {
        self.post.control.commons.get(common_kind(kind), location)
    }

    fn set_common(
        &mut self,
        kind: CommonKind,
        location: u32,
        value: f64,
    ) -> Result<Option<Box<Diag>>, Box<Diag>> {
        let kind = common_kind(kind);
        stored::check_in_run(kind, location, value)?;
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
        let row = fil_machine::locations::Location::named(&name.to_ascii_lowercase())?;
        Some(self.post.control.commons.get(row.kind, u32::from(row.number)))
    }
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
