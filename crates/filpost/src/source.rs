//! The CL records of a run: read one after the other, with a look at the
//! motions before and after the current record.

use std::collections::VecDeque;

use fil_cl::{
    Recognized, Record, SplineCounts, Vocabulary, WordId, reader::Reader, record::kind, words,
};
use fil_diag::Result;
use fil_machine::Unit;
use fil_post::operation::ToolAhead;

use crate::behind_tool::BehindTool;
use crate::coordinates::{Coordinates, coordinates};
use crate::memory::Memory;
use crate::units;
use crate::written::Written;

/// Records NEXTF looks through for the next motion.
const LOOK_AHEAD: usize = 1000;

/// Records of a stream that are kept to find the next tool.
const TOOLS_AHEAD: usize = 100_000;

/// Gives the records of a run in their order.
pub(crate) enum Stream<'r> {
    /// From a CL file.
    Cl(Box<Reader<'r>>),
    /// From the embedding program.
    Memory(Memory<'r>),
}

impl Stream<'_> {
    /// Puts the next record into `record`; false at the end.
    ///
    /// # Errors
    /// What is wrong with the record.
    #[inline(always)]
    fn read(&mut self, vocabulary: &mut Vocabulary, record: &mut Record) -> Result<bool> {
        match self {
            Stream::Cl(reader) => reader.read(vocabulary, record),
            Stream::Memory(memory) => memory.read(vocabulary, record),
        }
    }

    /// Makes record `number` (from 1) the next one.
    ///
    /// # Errors
    /// Records that can't go back; a number past the last record, or 0.
    fn seek(&mut self, number: u32) -> Result<()> {
        match self {
            Stream::Cl(reader) => reader.seek_record(number),
            Stream::Memory(memory) => Err(memory.cant_seek(number)),
        }
    }

    /// The CL text; `None` for records that come from no text.
    fn text(&self) -> Option<&Reader<'_>> {
        match self {
            Stream::Cl(reader) => Some(reader),
            Stream::Memory(_) => None,
        }
    }

    /// True when the last record could not be read.
    fn has_failed(&self) -> bool {
        match self {
            Stream::Cl(reader) => reader.has_failed(),
            Stream::Memory(memory) => memory.has_failed(),
        }
    }

    /// Goes on behind a record that could not be read, to find further errors; `None` when
    /// there was no such record.
    fn resume(&mut self) -> Option<Unread> {
        match self {
            Stream::Cl(reader) => {
                let (word, leans_on_earlier) = (reader.last_word(), reader.leans_on_earlier());
                reader.has_failed().then(|| {
                    let goes_on = reader.resume();
                    Unread { word, leans_on_earlier, goes_on }
                })
            }
            Stream::Memory(memory) => memory.resume(),
        }
    }
}

/// A record that could not be read.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Unread {
    /// Its major word, where that was understood.
    pub word: Option<WordId>,
    /// It lacks something that should have come before it.
    pub leans_on_earlier: bool,
    /// There are further records.
    pub goes_on: bool,
}

/// The records with their neighbourhood.
pub(crate) struct Source<'r> {
    reader: Stream<'r>,
    /// Records that were looked at and nobody has read yet.
    ahead: VecDeque<Record>,
    /// The last two motions read, and whether the current record is the last of them.
    motions: [Option<Coordinates>; 2],
    on_motion: bool,
    /// A RAPID record was read whose motion is still to come.
    rapid: bool,
    tool: Tool,
    tools: Tools,
    /// Number of the last record that was read.
    last_read: u32,
    /// Records given as they are written, with what they mean.
    pub written: Written,
    keeps_motions: bool,
    /// Records read so far.
    pub records: u64,
}

impl<'r> Source<'r> {
    /// `keeps_motions`: [`Source::previous`] will be asked for, or what records mean.
    pub fn new(reader: Stream<'r>, keeps_motions: bool) -> Self {
        Source {
            reader,
            ahead: VecDeque::new(),
            motions: [None; 2],
            on_motion: false,
            rapid: false,
            tool: Tool::default(),
            tools: Tools::default(),
            last_read: 0,
            written: Written::default(),
            keeps_motions,
            records: 0,
        }
    }

    /// The dialect of the CL text, as far as it was read.
    pub fn recognized(&self) -> Option<Recognized> {
        self.reader.text().map(Reader::recognized)
    }

    /// The unit that a CL text tells by the unit of its feeds; to be asked before it is read.
    pub fn told_unit(&mut self) -> Option<Unit> {
        let Stream::Cl(reader) = &mut self.reader else { return None };
        reader.told_unit().map(units::of_word)
    }

    /// The unit that UNITS gives behind nothing but names and texts; to be asked before it is read.
    pub fn unit_ahead(&mut self) -> Option<Unit> {
        let Stream::Cl(reader) = &mut self.reader else { return None };
        reader.unit_ahead().map(units::of_word)
    }

    /// The splines that were read as lines so far.
    pub fn splines(&self) -> SplineCounts {
        self.reader.text().map(Reader::splines).unwrap_or_default()
    }

    /// True when the last record could be read.
    pub fn is_sound(&self) -> bool {
        !self.reader.has_failed()
    }

    /// As [`Stream::resume`].
    pub fn resume(&mut self) -> Option<Unread> {
        self.reader.resume()
    }

    /// Reads the next record; false at the end.
    ///
    /// # Errors
    /// What the reader refuses.
    #[inline(always)]
    pub fn read(&mut self, record: &mut Record, vocabulary: &mut Vocabulary) -> Result<bool> {
        let more = match self.ahead.pop_front() {
            Some(next) => {
                *record = next;
                true
            }
            None => {
                let more = self.reader.read(vocabulary, record)?;
                if self.keeps_motions && more {
                    self.written.keep(record, self.reader.text().and_then(Reader::meaning));
                }
                more
            }
        };
        if more {
            self.records += 1;
            if self.keeps_motions {
                self.remember(record);
            }
        }
        Ok(more)
    }

    /// Goes to a record, so that the next read gives it.
    ///
    /// # Errors
    /// A stream that can't go back; a number past the last record, or 0.
    pub fn seek(&mut self, number: u32) -> Result<()> {
        self.reader.seek(number)?;
        self.ahead.clear();
        self.motions = [None; 2];
        self.on_motion = false;
        self.rapid = false;
        self.tool = self.tools.before(number, self.last_read);
        Ok(())
    }

    /// The motion after the current record; nothing is consumed.
    ///
    /// # Errors
    /// What the reader refuses.
    pub fn next(&mut self, vocabulary: &mut Vocabulary) -> Result<Option<Coordinates>> {
        let (mut rapid, before) = (self.rapid, self.motions[1]);
        for index in 0..LOOK_AHEAD {
            let Some(record) = self.ahead(index, vocabulary)? else { break };
            match record.kind {
                kind::MOTION => return Ok(Some(coordinates(record, rapid, before))),
                kind::FINI => break,
                _ => rapid |= record.major == words::RAPID,
            }
            let number = record.number;
            let meant = self.written.meaning_of(number).iter();
            if let Some(motion) = meant.clone().find(|record| record.kind == kind::MOTION) {
                return Ok(Some(coordinates(motion, rapid, before)));
            }
        }
        Ok(None)
    }

    /// The record so many places behind the next one; nothing is consumed.
    pub(crate) fn ahead(
        &mut self,
        index: usize,
        vocabulary: &mut Vocabulary,
    ) -> Result<Option<&Record>> {
        if index == self.ahead.len() {
            let mut next = Record::default();
            if !self.reader.read(vocabulary, &mut next)? {
                return Ok(None);
            }
            self.written.keep(&next, self.reader.text().and_then(Reader::meaning));
            self.ahead.push_back(next);
        }
        Ok(self.ahead.get(index))
    }

    /// Diameter of the tool in use, as the CL file gives it. Before the first motion of a
    /// tool it may come behind the current record, as Creo writes it.
    ///
    /// # Errors
    /// What the reader refuses.
    pub fn tool_diameter(&mut self, vocabulary: &mut Vocabulary) -> Result<Option<f64>> {
        let mut found = self.tool.diameter;
        if self.tool.has_moved {
            return Ok(found);
        }
        for index in 0..LOOK_AHEAD {
            let Some(record) = self.ahead(index, vocabulary)? else { break };
            if matches!(record.kind, kind::MOTION | kind::FINI) || record.takes_tool() {
                break;
            }
            found = record.tool_diameter().or(found);
        }
        Ok(found)
    }

    /// Diameter of the tool in use, as far as the records that were read give it.
    pub fn diameter(&self) -> Option<f64> {
        self.tool.diameter
    }

    /// Corner radius of the tool in use, as far as the records that were read give it.
    pub fn corner(&self) -> Option<f64> {
        self.tool.corner
    }

    /// What comes behind the current record, which takes a tool; nothing is consumed.
    /// Records that can't go back are kept, up to [`TOOLS_AHEAD`] of them. What is wrong with
    /// a record is said when it is read.
    ///
    /// # Errors
    /// A file that can't be gone back in after all.
    pub fn behind_tool(
        &mut self,
        record: &Record,
        vocabulary: &mut Vocabulary,
    ) -> Result<ToolAhead> {
        let mut seen = BehindTool::of(record);
        if self.ahead.iter().any(|record| seen.take(record)) {
            return Ok(seen.found());
        }
        if self.reader.text().is_some_and(Reader::can_go_back) {
            return self.read_on_behind_tool(seen, vocabulary);
        }
        for at in self.ahead.len()..TOOLS_AHEAD {
            match self.ahead(at, vocabulary) {
                Ok(None) => {
                    seen.end();
                    break;
                }
                Ok(Some(record)) if !seen.take(record) => {}
                Ok(Some(_)) | Err(_) => break,
            }
        }
        Ok(seen.found())
    }

    /// Reads on and goes back.
    fn read_on_behind_tool(
        &mut self,
        mut seen: BehindTool,
        vocabulary: &mut Vocabulary,
    ) -> Result<ToolAhead> {
        let mut record = Record::default();
        let mut first = None;
        loop {
            match self.reader.read(vocabulary, &mut record) {
                Ok(true) => {}
                Ok(false) => {
                    seen.end();
                    break;
                }
                Err(_) => break,
            }
            first.get_or_insert(record.number);
            if seen.take(&record) {
                break;
            }
        }
        if let Some(first) = first {
            self.reader.seek(first)?;
        }
        Ok(seen.found())
    }

    /// The motion before the current record.
    pub fn previous(&self) -> Option<Coordinates> {
        self.motions[usize::from(!self.on_motion)]
    }

    fn remember(&mut self, record: &Record) {
        let is_motion = record.kind == kind::MOTION;
        // An arc by geometry, a spline: the motion is in what the record means.
        let meant = if is_motion { &[] } else { self.written.meaning_of(record.number) };
        let motion = meant.iter().rfind(|record| record.kind == kind::MOTION);
        let last = if is_motion { Some(record) } else { motion };
        self.on_motion = last.is_some();
        let before = self.tool;
        if let Some(last) = last {
            let rapid = std::mem::take(&mut self.rapid);
            let before = self.motions[1];
            self.motions = [before, Some(coordinates(last, rapid, before))];
            self.tool.has_moved = true;
        } else {
            self.tool.take(record);
        }
        if self.tool != before {
            self.tools.keep(record.number, self.tool);
        }
        self.last_read = self.last_read.max(record.number);
        self.rapid |= record.major == words::RAPID;
    }
}

/// What the CL file has said of the tool in use.
#[derive(Clone, Copy, Default, PartialEq)]
struct Tool {
    diameter: Option<f64>,
    corner: Option<f64>,
    /// A motion came since the tool was changed or described.
    has_moved: bool,
}

impl Tool {
    /// The tool behind records that nobody has read.
    const UNKNOWN: Tool = Tool { diameter: None, corner: None, has_moved: true };

    /// A diameter before a tool change is that of the new tool, unless a motion came between.
    fn take(&mut self, record: &Record) {
        if record.takes_tool() {
            if self.has_moved {
                (self.diameter, self.corner) = (None, None);
            }
            self.has_moved = false;
        } else if let Some(diameter) = record.tool_diameter() {
            let corner = record.tool_corner();
            *self = Tool { diameter: Some(diameter), corner, has_moved: false };
        }
    }
}

/// Changes of the tool that are kept, to go back to.
const TOOLS_KEPT: usize = 4096;

/// The tool after each record that changed what is known of it, in the order of the records.
#[derive(Default)]
struct Tools {
    after: VecDeque<(u32, Tool)>,
    /// Changes were forgotten.
    is_cut: bool,
}

impl Tools {
    #[cold]
    fn keep(&mut self, number: u32, tool: Tool) {
        if self.after.len() == TOOLS_KEPT {
            self.after.pop_front();
            self.is_cut = true;
        }
        self.after.push_back((number, tool));
    }

    /// Goes to a record and gives the tool before it. `last_read`: records beyond it nobody has
    /// looked at.
    fn before(&mut self, number: u32, last_read: u32) -> Tool {
        if number > last_read.saturating_add(1) {
            self.keep(last_read.saturating_add(1), Tool::UNKNOWN);
            return Tool::UNKNOWN;
        }
        while self.after.back().is_some_and(|(changed, _)| *changed >= number) {
            self.after.pop_back();
        }
        match self.after.back() {
            Some((_, tool)) => *tool,
            None if self.is_cut => Tool::UNKNOWN,
            None => Tool::default(),
        }
    }
}
