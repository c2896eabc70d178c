//! An NC program that is whole, with what the run had to tell.

use std::borrow::Cow;
use std::io::Cursor;

use fil_cl::reader::{self, Reader};
use fil_cl::{Record, Vocabulary};
use fil_machine::Unit;
use fil_text::CodePage;

use crate::blocks::Block;
use crate::engine::Engine;
use crate::error::Error;
use crate::map;
use crate::memory::Memory;
use crate::passes::{FirstPass, Pass};
use crate::pending::PendingFiles;
use crate::program::Program;
use crate::report::Report;
use crate::run::Run;
use crate::source::Stream;
use crate::undecided;

/// An NC program in memory, whole, with the report of its run; see
/// [`Program::post`](crate::Program::post). There is none after an error, so half a program can't
/// be taken for one.
///
/// ```
/// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let posted = program.start().keep_blocks().post(cl)?;
/// assert!(posted.text().contains("G1 G43 X1. Y2. Z3. F200. H1"));
/// let moved = posted.blocks().iter().find(|block| block.text.contains("X1.")).expect("the motion");
/// assert_eq!(moved.origin.line, 4);
/// assert_eq!(posted.blocks().len() as u64, posted.report().blocks);
/// # Ok::<(), filpost::Error>(())
/// ```
#[derive(Clone, Debug)]
pub struct Posted {
    nc: Vec<u8>,
    code_page: CodePage,
    pub(crate) report: Report,
    blocks: Vec<Block>,
}

impl Posted {
    /// The program as it goes to the control: bytes in [`Posted::code_page`], lines ended as the
    /// machine sets it.
    pub fn bytes(&self) -> &[u8] {
        &self.nc
    }

    /// The same, handed over.
    pub fn into_bytes(self) -> Vec<u8> {
        self.nc
    }

    /// The program as text.
    pub fn text(&self) -> Cow<'_, str> {
        self.code_page.decode_all(&self.nc)
    }

    /// The code page of [`Posted::bytes`], `tape.encoding` of the machine.
    pub fn code_page(&self) -> CodePage {
        self.code_page
    }

    /// Counts, warnings, unit and extents of the run.
    pub fn report(&self) -> &Report {
        &self.report
    }

    /// The blocks in order, each with the CL record and the FIL lines that made it and its words
    /// with theirs; empty without [`Run::keep_blocks`](crate::Run::keep_blocks).
    pub fn blocks(&self) -> &[Block] {
        &self.blocks
    }
}

impl<'o> Run<'o> {
    /// Posts the text of a CL file and gives the whole program, or an error and no program. Where
    /// FIL or a list of tools asks for totals of the program, the text is gone through twice, and
    /// functions of the embedding program are called in both passes.
    ///
    /// Text and program are in memory. For files there is [`Run::post_files`], for what is larger
    /// than memory [`Run::stream_seekable`].
    ///
    /// # Errors
    /// [`Error::Refused`] with all that is wrong with the CL file; [`Error::Run`] for a script
    /// that fails, a limit, a cancelled run.
    pub fn post(self, cl: impl AsRef<[u8]>) -> Result<Posted, Error> {
        self.post_text(cl.as_ref())
    }

    /// The same for records from memory; see [`Run::stream_records`].
    ///
    /// # Errors
    /// As [`Run::post`]; E0712 for a record that no statement can make, and for
    /// a vocabulary of another program.
    pub fn post_records(
        self,
        vocabulary: Vocabulary,
        records: impl IntoIterator<Item = Record, IntoIter: Send>,
    ) -> Result<Posted, Error> {
        let memory = Memory::new(records.into_iter(), vocabulary, &self.program, &self.name())?;
        let (posted, pending, _) = self.post_whole(Stream::Memory(memory), Pass::Only, None)?;
        pending.commit()?;
        Ok(posted)
    }

    fn post_text(self, cl: &[u8]) -> Result<Posted, Error> {
        let again = self.again();
        let first = self.first_pass(&mut Cursor::new(cl))?;
        let reader = Reader::seekable(Cursor::new(cl), &self.name(), self.options());
        let (mut posted, pending, _) = self.post_text_read(reader, first, None)?;
        again.warn_of_undecided(cl, &mut posted.report)?;
        pending.commit()?;
        Ok(posted)
    }

    /// As [`Run::post_whole`], for what a reader gives.
    pub(crate) fn post_text_read(
        self,
        reader: Reader<'_>,
        first: Option<FirstPass>,
        map: Option<map::Writer<'o>>,
    ) -> Result<(Posted, PendingFiles, Option<map::Writer<'o>>), Error> {
        let pass = Pass::writing(first, self.program.has_script());
        self.post_whole(Stream::Cl(Box::new(reader)), pass, map)
    }

    /// The program, files of scripts that wait for their names, and the map to be ended.
    fn post_whole(
        self,
        records: Stream<'_>,
        pass: Pass,
        map: Option<map::Writer<'o>>,
    ) -> Result<(Posted, PendingFiles, Option<map::Writer<'o>>), Error> {
        let code_page = self.program.nc_page();
        let observed = self.is_observed();
        let mut engine = Engine::new(self.begin(map, pass), records, observed);
        let mut nc = Vec::new();
        let (report, pending) = engine.run(&mut nc)?;
        let blocks = engine.take_kept();
        Ok((Posted { nc, code_page, report, blocks }, pending, engine.take_map()))
    }

    /// What is needed to post the same input again.
    pub(crate) fn again(&self) -> Again {
        Again {
            program: self.program.clone(),
            reading: self.reading,
            units: self.units,
            name: self.name(),
        }
    }
}

/// What is needed to post an input again.
pub(crate) struct Again {
    program: Program,
    reading: reader::Options,
    units: Option<Unit>,
    name: String,
}

impl Again {
    /// Adds warnings of settings that no proven program decides and that act in this one, and of
    /// proven programs that come out differently.
    ///
    /// # Errors
    /// One whose level is deny.
    pub fn warn_of_undecided(&self, cl: &[u8], report: &mut Report) -> Result<(), Error> {
        let Again { program, reading, units, name } = self;
        if program.commons().is_proven() {
            return Ok(());
        }
        let start = |program: Program| {
            let mut run = Run::new(program).cl_options(*reading);
            run.units = *units;
            run
        };
        let levels = &program.shared.prototype.control.warnings.levels;
        for warning in undecided::warnings(program, &start, cl, name) {
            let level = levels.of_code(warning.code);
            match warning.at_level(level) {
                Some(denied) if denied.is_error() => return Err(Error::Run(Box::new(denied))),
                warning => report.warnings.extend(warning),
            }
        }
        Ok(())
    }
}
