//! One run: its options, then the CL stream it takes through the program.

#[cfg(feature = "files")]
use std::fs::File;
#[cfg(feature = "files")]
use std::io;
use std::io::{Read, Seek, SeekFrom, Write};
use std::path::Path;
#[cfg(feature = "files")]
use std::path::PathBuf;

use fil_cl::reader::{self, Reader};
use fil_cl::{Record, Vocabulary};
use fil_machine::Unit;
use fil_machine::locations as loc;

use crate::blocks::Blocks;
use crate::cancel::CancelToken;
use crate::debug::SharedDebugger;
use crate::engine::Engine;
use crate::error::Error;
use crate::event::{Event, Observer};
use crate::files;
use crate::map;
use crate::memory::Memory;
use crate::passes::{FirstPass, Pass};
#[cfg(feature = "files")]
use crate::pending::NewFile;
use crate::pending::PendingFiles;
use crate::program::Program;
use crate::report::Report;
use crate::source::Stream;

/// A run that has not begun: options first, then one of the methods that take a
/// CL stream. Options that are left out are those of [`Program::post`].
///
/// [`Run::post`] gives a program that is whole, [`Run::post_files`] a file that appears whole.
/// The methods named `stream` write blocks as they are made, so that memory does not grow with
/// the program: after an error the writer has half a program, and the caller throws it away.
///
/// ```
/// use filpost::{CancelToken, Program};
///
/// let program = Program::builder().ready("fanuc-mill").build()?;
/// let token = CancelToken::new();
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let mut blocks = 0;
/// let report = program
///     .start()
///     .cl_name("part.ncl")
///     .cancel(&token)
///     .observe(|event| blocks += u64::from(matches!(event, filpost::Event::Block { .. })))
///     .stream(cl.as_bytes(), std::io::sink())?;
/// assert_eq!(report.blocks, blocks);
/// # Ok::<(), filpost::Error>(())
/// ```
#[must_use = "a run does nothing before it takes a CL stream"]
pub struct Run<'o> {
    pub(crate) program: Program,
    cl_name: Option<String>,
    pub(crate) reading: reader::Options,
    pub(crate) units: Option<Unit>,
    cancel: Option<CancelToken>,
    observers: Vec<Observer<'o>>,
    keeps_blocks: bool,
    debugger: Option<SharedDebugger>,
}

/// What an engine needs of a run besides its records.
pub(crate) struct Start<'o> {
    pub program: Program,
    pub cl_name: String,
    pub raw: bool,
    pub units: Option<Unit>,
    pub cancel: Option<CancelToken>,
    pub observers: Vec<Observer<'o>>,
    pub keeps_blocks: bool,
    pub map: Option<map::Writer<'o>>,
    pub pass: Pass,
    pub debugger: Option<SharedDebugger>,
}

impl<'o> Run<'o> {
    pub(crate) fn new(program: Program) -> Self {
        Run {
            program,
            cl_name: None,
            reading: reader::Options::default(),
            units: None,
            cancel: None,
            observers: Vec::new(),
            keeps_blocks: false,
            debugger: None,
        }
    }

    /// The name of the CL file in messages.
    pub fn cl_name(mut self, name: &str) -> Self {
        self.cl_name = Some(name.into());
        self
    }

    /// How CL text is read: dialect, encoding of texts, longest statement. With `raw`,
    /// sections see statements as they are written, and the post carries out what they mean.
    ///
    /// ```
    /// use filpost::Program;
    /// use filpost::records::{ClDialect, Options};
    ///
    /// let program = Program::builder().ready("fanuc-mill").build()?;
    /// let options = Options { dialect: Some(ClDialect::Creo), ..Options::default() };
    /// let posted = program.start().cl_options(options).post("UNITS / MM\nFINI\n")?;
    /// assert_eq!(posted.report().dialect.map(|found| found.dialect), Some(ClDialect::Creo));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn cl_options(mut self, options: reader::Options) -> Self {
        self.reading = options;
        self
    }

    /// The unit of a CL file that has no UNITS statement. Without it such a file
    /// needs a machine that takes one unit only. A UNITS statement that says another
    /// unit is refused (E0715).
    ///
    /// ```
    /// use filpost::{Program, Unit, UnitSource};
    ///
    /// let program = Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "LOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n".as_bytes();
    /// assert!(program.stream(cl, std::io::sink()).is_err());
    /// let report = program.start().units(Unit::Mm).stream(cl, std::io::sink())?;
    /// assert_eq!(report.unit, Some((Unit::Mm, UnitSource::Given)));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn units(mut self, unit: Unit) -> Self {
        self.units = Some(unit);
        self
    }

    /// A switch that stops the run.
    pub fn cancel(mut self, token: &CancelToken) -> Self {
        self.cancel = Some(token.clone());
        self
    }

    /// Adds an observer: it is called for each event, in the thread of the run.
    /// It may borrow what lives longer than the run.
    pub fn observe(mut self, observer: impl FnMut(Event<'_>) + Send + 'o) -> Self {
        self.observers.push(Box::new(observer));
        self
    }

    /// Keeps the blocks with what made them, for [`Posted::blocks`](crate::Posted::blocks). They
    /// need many times the memory of the program; [`Run::blocks`] hands out one after the other.
    pub fn keep_blocks(mut self) -> Self {
        self.keeps_blocks = true;
        self
    }

    /// How the CL text is read for this program: a script that takes subroutines sees them as
    /// they are written.
    pub(crate) fn options(&self) -> reader::Options {
        const SUBROUTINES: [&str; 3] = ["DEFSUB", "ENDSUB", "CALSUB"];
        let is_taken = |key: &str| SUBROUTINES.iter().any(|word| key.starts_with(word));
        let taken = self.program.shared.module.section_keys().any(is_taken);
        reader::Options {
            expand_subroutines: self.reading.expand_subroutines && !taken,
            ..self.reading
        }
    }

    /// Hands the run to a debugger, see [`crate::debug`]. Of FIL it is told in a program that
    /// was built with [`Builder::debug`](crate::Builder::debug); in any other it is told of CL
    /// records only. A first pass over the CL file is not shown to it.
    #[doc(hidden)]
    pub fn debug(mut self, debugger: &SharedDebugger) -> Self {
        self.debugger = Some(SharedDebugger::clone(debugger));
        self
    }

    /// Posts a CL stream and writes each block as it is made: **after an error half a program may
    /// have been written**, which the caller throws away. [`Run::post`] gives whole programs.
    ///
    /// The stream can't go back, so POSTF(15) and (16) are refused, and what asks for totals of
    /// the program: PROGF, TLISTF, OPERF, TOOLF(NEXT).
    ///
    /// # Errors
    /// The first thing that is wrong; what was written until then is not a
    /// program. The writer's own errors come as E0702.
    pub fn stream(self, cl: impl Read + Send, mut nc: impl Write) -> Result<Report, Error> {
        let reader = Reader::new(cl, &self.name(), self.options());
        commit(self.post_reader(reader, None, None, &mut nc).0)
    }

    /// Posts a CL stream that can go back; **after an error half a program may have been
    /// written**, as with [`Run::stream`]. Where FIL asks for totals of the program, the
    /// stream is read twice, and functions of the embedding program are called in both passes;
    /// what scripts write and the commands they run come from the second pass alone.
    ///
    /// # Errors
    /// As [`Run::stream`].
    pub fn stream_seekable(
        self,
        cl: impl Read + Seek + Send,
        nc: impl Write,
    ) -> Result<Report, Error> {
        commit(self.run_pending(cl, nc))
    }

    /// The same, with the files of scripts pending until [`PendingFiles::commit`]:
    /// for a caller that can still refuse the program.
    ///
    /// # Errors
    /// As [`Run::stream`].
    #[doc(hidden)]
    pub fn run_pending(
        self,
        mut cl: impl Read + Seek + Send,
        nc: impl Write,
    ) -> Result<(Report, PendingFiles), Error> {
        if self.program.commons().is_proven() {
            return self.run_unwatched(cl, nc);
        }
        let name = self.name();
        let cant = |error| files::cant_read(Path::new(&name), &error);
        let start = cl.stream_position().map_err(cant)?;
        let again = self.again();
        let (mut report, pending) = self.run_unwatched(&mut cl, nc)?;
        cl.seek(SeekFrom::Start(start)).map_err(cant)?;
        let mut text = Vec::new();
        cl.read_to_end(&mut text).map_err(cant)?;
        again.warn_of_undecided(&text, &mut report)?;
        Ok((report, pending))
    }

    /// The same, without a look at settings that no proven program decides.
    pub(crate) fn run_unwatched(
        self,
        mut cl: impl Read + Seek + Send,
        mut nc: impl Write,
    ) -> Result<(Report, PendingFiles), Error> {
        let first = self.first_pass(&mut cl)?;
        let reader = Reader::seekable(cl, &self.name(), self.options());
        self.post_reader(reader, first, None, &mut nc).0
    }

    /// Posts a CL file into an NC file. On any error there is no file under the
    /// output's name: an older one of that name is left as it was.
    ///
    /// ```no_run
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// program.post_files("part.ncl".as_ref(), "part.nc".as_ref())?;
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::stream`]; E0701 and E0702 for files that can't be read or written.
    #[cfg(feature = "files")]
    pub fn post_files(mut self, cl: &Path, nc: &Path) -> Result<Report, Error> {
        let input = File::open(cl).map_err(|error| files::cant_read(cl, &error))?;
        if input.metadata().is_ok_and(|found| found.is_dir()) {
            return Err(files::cant_read(cl, &io::Error::from(io::ErrorKind::IsADirectory)));
        }
        self.cl_name.get_or_insert_with(|| cl.display().to_string());
        let mut output = NewFile::create(nc)?;
        let fil = self.program.fil_files();
        let (report, mut pending) = self.run_pending(input, &mut output)?;
        pending.refuse(&[cl, nc])?;
        let read =
            fil.iter().map(Path::new).chain(report.script_reads.iter().map(PathBuf::as_path));
        files::refuse_over(nc, read.chain([cl]))?;
        pending.add(output);
        pending.commit()?;
        Ok(report)
    }

    /// Posts records from memory, in their order, and writes each block as it is made: **after an
    /// error half a program may have been written**. Records can't go back.
    ///
    /// `vocabulary` is [`Program::vocabulary`] with the words that the records add.
    /// The records are numbered from 1; one without a line gets its number as its
    /// line.
    ///
    /// ```
    /// use filpost::records::{Record, Word};
    ///
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// let mut vocabulary = program.vocabulary();
    /// let mut units = Record::command(vocabulary.intern("UNITS"));
    /// units.data.push(Word::Minor(vocabulary.intern("MM")));
    /// let mut feed = Record::command(vocabulary.intern("FEDRAT"));
    /// feed.data.extend([Word::Number(200.0), Word::Minor(vocabulary.intern("MMPM"))]);
    /// let path = (0..3).map(|x| Record::goto([f64::from(x), 0.0, 5.0], None));
    /// let records = [units, feed].into_iter().chain(path);
    /// let mut nc = Vec::new();
    /// program.stream_records(vocabulary, records, &mut nc)?;
    /// assert!(String::from_utf8_lossy(&nc).contains("X2."));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::stream`]; E0712 for a record that no statement can make, and for
    /// a vocabulary of another program.
    pub fn stream_records(
        self,
        vocabulary: Vocabulary,
        records: impl IntoIterator<Item = Record, IntoIter: Send>,
        mut nc: impl Write,
    ) -> Result<Report, Error> {
        let memory = Memory::new(records.into_iter(), vocabulary, &self.program, &self.name())?;
        self.post_memory(memory, &mut nc)
    }

    /// Posts a CL stream and writes the line map of the run. `names` is how the
    /// map calls the files; see [`map::Names::from_folder`].
    ///
    /// # Errors
    /// As [`Run::stream`]; E0702 for the map.
    #[doc(hidden)]
    pub fn run_mapped(
        self,
        cl: impl Read + Seek + Send,
        mut nc: impl Write,
        names: &map::Names,
        output: &'o mut (dyn Write + Send),
    ) -> Result<(Report, PendingFiles), Error> {
        self.mapped(cl, names, output, |run, reader, first, map| {
            let (result, map) = run.post_reader(reader, first, Some(map), &mut nc);
            Ok((result?, map))
        })
    }

    /// Posts a CL file with its line map, in which the digest of what was read comes last: `post`
    /// gets the run, the reader, what the first pass found, and the map, and gives the map back.
    pub(crate) fn mapped<T>(
        self,
        mut cl: impl Read + Seek + Send,
        names: &map::Names,
        output: &'o mut (dyn Write + Send),
        post: impl FnOnce(
            Self,
            Reader<'_>,
            Option<FirstPass>,
            map::Writer<'o>,
        ) -> Result<(T, Option<map::Writer<'o>>), Error>,
    ) -> Result<T, Error> {
        let cant = |error| files::cant_read(Path::new(&names.cl), &error);
        let first = self.first_pass(&mut cl)?;
        let mut cl = map::Digested::new(cl).map_err(cant)?;
        let reader = Reader::seekable(&mut cl, &self.name(), self.options());
        let cant_write = |error| files::cant_write(Path::new("the line map"), &error);
        let module = &self.program.shared.module;
        let map = map::Writer::new(output, names, module, self.program.nc_page());
        let (result, map) = post(self, reader, first, map)?;
        let digest = cl.finish().map_err(cant)?;
        map.map_or(Ok(()), |map| map.finish(digest)).map_err(cant_write)?;
        Ok(result)
    }

    /// The blocks of a CL stream, one by one, each with what made it.
    ///
    /// ```
    /// let program = filpost::Program::builder().ready("fanuc-mill");
    /// // A stream is read once: its tools are not known at the start.
    /// let program = program.option("tool-list", "no").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nSPINDL / RPM, 800, CLW\nFEDRAT / 200, MMPM\n\
    ///     GOTO / 1, 2, 3\nFINI\n";
    /// let mut blocks = program.blocks(cl.as_bytes());
    /// for block in &mut blocks {
    ///     let block = block?;
    ///     println!("{:<30} CL line {}", block.text, block.origin.line);
    /// }
    /// assert_eq!(blocks.report().records, 6);
    /// assert!(blocks.report().warnings.is_empty());
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn blocks(self, cl: impl Read + Send + 'o) -> Blocks<'o> {
        let reader = Reader::new(cl, &self.name(), self.options());
        let records = Stream::Cl(Box::new(reader));
        Blocks::new(Engine::new(self.begin(None, Pass::Only), records, true))
    }

    /// The name of the CL file in messages.
    pub(crate) fn name(&self) -> String {
        self.cl_name.clone().unwrap_or_else(|| "CL".into())
    }

    /// A run of another program that reads the same CL file in the same way, without observers.
    pub(crate) fn of_program<'n>(&self, program: Program) -> Run<'n> {
        Run {
            program,
            cl_name: self.cl_name.clone(),
            reading: self.reading,
            units: self.units,
            cancel: self.cancel.clone(),
            observers: Vec::new(),
            keeps_blocks: false,
            debugger: None,
        }
    }

    pub(crate) fn begin(self, map: Option<map::Writer<'o>>, pass: Pass) -> Start<'o> {
        let (cl_name, raw) = (self.name(), self.reading.raw);
        let Run { program, units, cancel, observers, keeps_blocks, debugger, .. } = self;
        Start { program, cl_name, raw, units, cancel, observers, keeps_blocks, map, pass, debugger }
    }

    /// Counts what the FIL or the tool list asks of the whole program, where they do; the input then stands
    /// where it stood.
    pub(crate) fn first_pass(
        &self,
        cl: &mut (impl Read + Seek + Send),
    ) -> Result<Option<FirstPass>, Error> {
        let shared = &self.program.shared;
        let lists_tools = shared.prototype.control.commons.read(loc::PROGRAM_TOOL_LIST);
        if !shared.module.asks_totals() && !lists_tools {
            return Ok(None);
        }
        let name = self.name();
        let cant = |error| files::cant_read(Path::new(&name), &error);
        let start = cl.stream_position().map_err(cant)?;
        let reader = Reader::seekable(&mut *cl, &name, self.options());
        let pass = Pass::First { counted: Box::default(), guessed: false };
        let first = self.of_program(self.program.clone());
        let found =
            Engine::new(first.begin(None, pass), Stream::Cl(Box::new(reader)), false).count();
        cl.seek(SeekFrom::Start(start)).map_err(cant)?;
        Ok(Some(found))
    }

    /// Posts what a reader gives. The methods above are compiled for each kind of input
    /// and output, so they do no more than hand both over.
    pub(crate) fn post_reader(
        self,
        reader: Reader<'_>,
        first: Option<FirstPass>,
        map: Option<map::Writer<'o>>,
        nc: &mut dyn Write,
    ) -> Done<'o> {
        let pass = Pass::writing(first, self.program.has_script());
        self.drive(Stream::Cl(Box::new(reader)), pass, map, nc)
    }

    /// True where somebody asks what made each block.
    pub(crate) fn is_observed(&self) -> bool {
        self.keeps_blocks || !self.observers.is_empty()
    }

    fn post_memory(self, memory: Memory<'_>, nc: &mut dyn Write) -> Result<Report, Error> {
        commit(self.drive(Stream::Memory(memory), Pass::Only, None, nc).0)
    }

    fn drive(
        self,
        records: Stream<'_>,
        pass: Pass,
        map: Option<map::Writer<'o>>,
        nc: &mut dyn Write,
    ) -> Done<'o> {
        let observed = self.is_observed();
        let mut engine = Engine::new(self.begin(map, pass), records, observed);
        let result = engine.run(nc);
        (result, engine.take_map())
    }
}

/// What a run gives: its report and the files of scripts, and the map to be ended.
type Done<'o> = (Result<(Report, PendingFiles), Error>, Option<map::Writer<'o>>);

/// Gives the files of scripts their names.
fn commit(done: Result<(Report, PendingFiles), Error>) -> Result<Report, Error> {
    let (report, pending) = done?;
    pending.commit()?;
    Ok(report)
}
