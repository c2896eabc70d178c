//! What a FIL machine reaches while it runs: records, the post, the report.

mod carry_out;
mod host;
mod taken;
mod told;

pub(crate) use host::{common_kind, option_value};
use taken::Taken;

use std::collections::HashSet;
use std::sync::Arc;

use fil_cl::vocabulary::words;
use fil_cl::{Evidence, Record, Vocabulary, record::kind};
use fil_diag::Diag;
use fil_machine::locations::{INPUT_CREO_RECORDS, PROGRAM_TIME_STAMP, PROGRAM_TOOL_LIST};
use fil_machine::{Kind, Unit};
use fil_post::stands_before_change;
use fil_vm::{Host, Module, SectionId};

use crate::blocks::Block;
use crate::cancel::CancelToken;
use crate::coming::Stretch;
use crate::debug::SharedDebugger;
use crate::editing::SharedEditor;
use crate::event::{Event, Observer};
use crate::granted::Granted;
use crate::map;
use crate::passes::Pass;
use crate::program::Program;
use crate::report::Report;
use crate::run::Start;
use crate::select;
use crate::source::{Source, Stream};
use crate::spilled::Spilled;
use crate::tally::Tally;
use crate::units;

/// Records behind a STOP, at most, before the tool change by hand that it waits for.
const STOP_AHEAD: usize = 8;

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
    /// Blocks with their causes, for a host that wants them at the end.
    pub kept: Option<Vec<Block>>,
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
    /// Motions that the section has taken.
    pub(crate) taken: Taken,
    /// The section that runs.
    pub section: Option<SectionId>,
    /// The stretch is open in which RAPIDs look ahead; `None` before the first record that may
    /// open or close it.
    in_stretch: Option<bool>,
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
    /// A warning whose level is deny.
    pub denied: Option<Box<Diag>>,
    /// The last statement of the CL file whose blocks are its author's.
    of_author: Record,
    /// The debugger knows of the error that ends the run.
    pub told_failure: bool,
}

impl<'o, 'r> Outside<'o, 'r> {
    /// Everything as it is before the first record.
    pub fn new(start: Start<'o>, records: Stream<'r>) -> Self {
        let Start {
            program,
            cl_name,
            raw,
            units,
            cancel,
            observers,
            keeps_blocks,
            map,
            mut pass,
            debugger,
        } = start;
        let shared = &program.shared;
        let counts = !observers.is_empty() || pass.counts();
        let module = Arc::clone(&shared.module);
        let mut post = shared.prototype.clone();
        if post.control.commons.read(PROGRAM_TOOL_LIST) {
            post.control.head.tools = pass.tool_list();
        }
        Outside {
            source: Source::new(records, raw || counts || !module.has_no_section()),
            module,
            post,
            report: Report { build_warnings: shared.warnings.clone(), ..Report::default() },
            careful: raw || counts,
            tally: counts.then(Box::default),
            pass,
            last_done: 0,
            observers,
            kept: keeps_blocks.then(Vec::new),
            raw,
            units,
            cancel,
            cl_name,
            ended: false,
            fini_taken: false,
            trace: false,
            map,
            idle: HashSet::new(),
            taken: Taken::default(),
            section: None,
            in_stretch: None,
            editor: None,
            granted: Granted::new(shared.clock, shared.folders.clone()),
            shown: 0,
            spilled: None,
            debugger,
            denied: None,
            of_author: Record::default(),
            told_failure: false,
            program,
        }
    }

    /// Tells the post the unit that the CL file need not say.
    ///
    /// # Errors
    /// E0715 for a unit that the machine does not take.
    pub fn begin(&mut self) -> Result<(), Box<Diag>> {
        let told = self.source.told_unit();
        self.report.unit = units::known_before(self.units, told, &self.post.control.commons)?;
        if let Some((unit, _)) = self.report.unit {
            self.post.assume_unit(unit);
        }
        self.post.control.head.unit_ahead = self.source.unit_ahead();
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

    /// Tells the post which tools come behind a record that takes one, and which tool axes behind a
    /// RAPID, where its machine asks for it; and whether a STOP is that of a tool change by hand.
    ///
    /// # Errors
    /// A file that can't be gone back in.
    #[inline(always)]
    pub fn look_ahead(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if record.kind == kind::MOTION {
            return Ok(());
        }
        if record.kind == kind::SURFACE
            && let Some(found) = self.source.recognized()
        {
            let dialect = found.dialect;
            self.post.know_arcs(dialect.proof_of_arcs().is_some(), dialect.has_exact_turns());
        }
        if self.post.looks_ahead_for_axes() {
            self.follow_stretch(record, vocabulary);
        }
        if record.takes_tool() {
            return self.look_for_tools(record, vocabulary);
        }
        match record.major {
            words::RAPID => self.look_for_axes(vocabulary),
            words::STOP | words::OPSTOP => {
                self.post.path.ahead.change_by_hand = self.looks_at_change_by_hand(vocabulary);
            }
            _ => {}
        }
        Ok(())
    }

    /// True where a stop at hand is that of a tool change by hand.
    #[cold]
    fn looks_at_change_by_hand(&mut self, vocabulary: &mut Vocabulary) -> bool {
        for index in 0..STOP_AHEAD {
            match self.source.ahead(index, vocabulary) {
                Ok(Some(next)) if next.takes_tool() => return next.has(words::MANUAL),
                Ok(Some(next)) if next.inert || stands_before_change(next, true) => {}
                _ => return false,
            }
        }
        false
    }

    #[cold]
    fn look_for_axes(&mut self, vocabulary: &mut Vocabulary) {
        if !self.post.looks_ahead_for_axes() {
            return;
        }
        let stretch = Stretch::of(&self.post.control.commons);
        if stretch.is_none() || self.in_stretch == Some(true) {
            self.post.path.ahead.motions = self.source.motions_ahead(stretch, vocabulary);
        }
    }

    /// Notes whether the stretch is open in which RAPIDs look ahead.
    #[cold]
    fn follow_stretch(&mut self, record: &Record, vocabulary: &Vocabulary) {
        let Some(stretch) = Stretch::of(&self.post.control.commons) else { return };
        let before = self.in_stretch.unwrap_or_else(|| stretch.begins_open());
        self.in_stretch = Some(stretch.is_open(before, record, vocabulary));
    }

    #[cold]
    fn look_for_tools(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<(), Box<Diag>> {
        if self.post.looks_ahead_for_tools() {
            self.post.path.ahead.tool = self.source.behind_tool(record, vocabulary)?;
        }
        Ok(())
    }
}
