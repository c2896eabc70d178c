//! A program: a machine with its FIL, ready to run.

use std::fmt;
use std::io::{Read, Seek, Write};
#[cfg(feature = "files")]
use std::path::Path;
use std::sync::Arc;

use fil_cl::{Record, Vocabulary};
use fil_diag::{Diag, Level, Levels};
#[cfg(feature = "files")]
use fil_machine::locations::Location;
use fil_machine::post_options::PostOption;
use fil_machine::reads::Reads;
use fil_machine::{Commons, contradictions, tape_style};
use fil_text::CodePage;
use fil_vm::{FilFile, Functions, Limits, LoadOptions, Module};

use crate::blocks::Blocks;
use crate::builder::Builder;
use crate::error::Error;
use crate::granted::{Clock, Spawn};
use crate::posted::Posted;
use crate::report::Report;
use crate::run::Run;
use crate::script_files::Folders;

/// A machine with its compiled FIL, ready to post any number of CL files.
///
/// It never changes: each run starts from the same state. Clones share one
/// program, in as many threads as you like.
///
/// ```
/// use filpost::Program;
///
/// let program = Program::builder().ready("fanuc-mill").build()?;
/// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
/// let threads: Vec<_> = (0..2)
///     .map(|_| {
///         let program = program.clone();
///         std::thread::spawn(move || program.post(cl))
///     })
///     .collect();
/// for thread in threads {
///     let posted = thread.join().expect("no panic")?;
///     assert!(posted.text().contains("G1 G43 X1. Y2. Z3. F200. H1"));
/// }
/// # Ok::<(), filpost::Error>(())
/// ```
#[derive(Clone)]
pub struct Program {
    pub(crate) shared: Arc<Shared>,
}

/// What the clones of a program share.
pub(crate) struct Shared {
    /// The post as each run starts with it.
    pub prototype: fil_post::Post,
    pub module: Arc<Module>,
    /// The published words, and those that FIL names.
    pub vocabulary: Vocabulary,
    pub functions: Arc<Functions>,
    pub limits: Limits,
    /// Warnings of building.
    pub warnings: Vec<Diag>,
    pub clock: Option<Clock>,
    pub spawn: Option<Spawn>,
    pub folders: Option<Arc<Folders>>,
}

impl Program {
    /// Starts building a program.
    ///
    /// ```
    /// let fil = "CIMFIL/ON,LOADTL\nOPSTOP\nDMY=POSTF(13)\nCIMFIL/OFF\nFINI\n";
    /// let program = filpost::Program::builder()
    ///     .ready("fanuc-mill")
    ///     .set("rapid.split=0")
    ///     .fil("opstop.fil", fil)
    ///     .build()?;
    /// assert!(program.warnings().is_empty());
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn builder() -> Builder {
        Builder::new()
    }

    /// Starts a run: its options first, then its input.
    ///
    /// ```
    /// use filpost::{Event, Program};
    ///
    /// let program = Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nPPRINT / FIRST SIDE\nFINI\n";
    /// let mut messages = Vec::new();
    /// let report = program
    ///     .start()
    ///     .cl_name("part.ncl")
    ///     .observe(|event| {
    ///         if let Event::Message(text) = event {
    ///             messages.push(text.trim().to_string());
    ///         }
    ///     })
    ///     .stream(cl.as_bytes(), std::io::sink())?;
    /// assert_eq!(report.records, 4);
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn start<'o>(&self) -> Run<'o> {
        Run::new(self.clone())
    }

    /// Posts the text of a CL file without any options; see [`Run::post`].
    ///
    /// ```
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    /// let posted = program.post(cl)?;
    /// assert!(posted.text().contains("G1 G43 X1. Y2. Z3. F200. H1"));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::post`].
    pub fn post(&self, cl: impl AsRef<[u8]>) -> Result<Posted, Error> {
        self.start().post(cl)
    }

    /// Posts records from memory without any options; see [`Run::post_records`].
    ///
    /// # Errors
    /// As [`Run::post_records`].
    pub fn post_records(
        &self,
        vocabulary: Vocabulary,
        records: impl IntoIterator<Item = Record, IntoIter: Send>,
    ) -> Result<Posted, Error> {
        self.start().post_records(vocabulary, records)
    }

    /// Posts a CL stream without any options and writes each block as it is made: **after an error
    /// half a program may have been written**; see [`Run::stream`].
    ///
    /// ```
    /// let program = filpost::Program::builder().ready("fanuc-mill").build()?;
    /// let cl = "UNITS / MM\nLOADTL / 1\nFEDRAT / 200, MMPM\nGOTO / 1, 2, 3\nFINI\n";
    /// let mut nc = Vec::new();
    /// let report = program.stream(cl.as_bytes(), &mut nc)?;
    /// assert_eq!((report.records, report.bytes), (5, nc.len() as u64));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// As [`Run::stream`].
    pub fn stream(&self, cl: impl Read + Send, nc: impl Write) -> Result<Report, Error> {
        self.start().stream(cl, nc)
    }

    /// Posts a CL stream that can go back, as [`Program::stream`] does; see [`Run::stream_seekable`].
    ///
    /// # Errors
    /// As [`Run::stream`].
    pub fn stream_seekable(
        &self,
        cl: impl Read + Seek + Send,
        nc: impl Write,
    ) -> Result<Report, Error> {
        self.start().stream_seekable(cl, nc)
    }

    /// Posts a CL file into an NC file; see [`Run::post_files`].
    ///
    /// # Errors
    /// As [`Run::post_files`].
    #[cfg(feature = "files")]
    pub fn post_files(&self, cl: &Path, nc: &Path) -> Result<Report, Error> {
        self.start().post_files(cl, nc)
    }

    /// Posts records from memory, as [`Program::stream`] does; see [`Run::stream_records`].
    ///
    /// # Errors
    /// As [`Run::stream_records`].
    pub fn stream_records(
        &self,
        vocabulary: Vocabulary,
        records: impl IntoIterator<Item = Record, IntoIter: Send>,
        nc: impl Write,
    ) -> Result<Report, Error> {
        self.start().stream_records(vocabulary, records, nc)
    }

    /// The blocks of a CL stream, one by one; see [`Run::blocks`].
    pub fn blocks<'o>(&self, cl: impl Read + Send + 'o) -> Blocks<'o> {
        self.start().blocks(cl)
    }

    /// True where FIL may change what a record, a block or the program becomes.
    pub(crate) fn has_script(&self) -> bool {
        let module = &self.shared.module;
        module.asks_totals() || module.edits_output() || !module.has_no_section()
    }

    /// Warnings of building: settings without effect, forgiven FIL.
    pub fn warnings(&self) -> &[Diag] {
        &self.shared.warnings
    }

    /// The settings of the machine.
    #[doc(hidden)]
    pub fn commons(&self) -> &Commons {
        &self.shared.prototype.control.commons
    }

    /// The encoding of its NC programs, `tape.encoding` of the machine: what a run writes are
    /// bytes in it, as they go to the control.
    ///
    /// ```
    /// use filpost::Program;
    ///
    /// let builder = Program::builder().ready("fanuc-mill");
    /// let program = builder.set("tape.encoding=windows-1252").build()?;
    /// let posted = program.post("UNITS / MM\nPPRINT / FRÄSER\nFINI\n")?;
    /// assert!(posted.bytes().windows(8).any(|bytes| bytes == b"(FR\xC4SER)"));
    /// assert!(posted.text().contains("(FRÄSER)"));
    /// assert_eq!(program.nc_page().name(), "windows-1252");
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn nc_page(&self) -> CodePage {
        tape_style::page(self.commons())
    }

    /// The words of this program, for records from memory: a word that a record
    /// names is looked up or added here, and [`Run::stream_records`] takes the result.
    pub fn vocabulary(&self) -> Vocabulary {
        self.shared.vocabulary.clone()
    }

    /// The same FIL on a machine with a setting at its default.
    ///
    /// # Errors
    /// Without the setting the others are refused, or contradict each other.
    #[cfg(feature = "files")]
    pub(crate) fn without(&self, setting: &Location) -> Result<Program, Error> {
        let mut commons = self.commons().clone();
        let (number, value) = (u32::from(setting.number), setting.default_value());
        commons.set(setting.kind, number, value).map_err(|diag| Error::Setup(vec![*diag]))?;
        self.with_machine(commons)
    }

    /// The same FIL with the same levels on another machine, without reading any file again: for
    /// many trials of settings. Scripts of such a program run no commands.
    ///
    /// ```
    /// use filpost::{Kind, Program};
    ///
    /// let program = Program::builder().ready("fanuc-mill").build()?;
    /// let mut machine = program.commons().clone();
    /// let code = filpost::locations::Location::named("program.rewind_code").expect("a setting");
    /// machine.set(code.kind, code.number.into(), 2.0).map_err(|diag| filpost::Error::Run(diag))?;
    /// let mut nc = Vec::new();
    /// program.with_machine(machine)?.stream("UNITS / MM\nFINI\n".as_bytes(), &mut nc)?;
    /// assert!(String::from_utf8_lossy(&nc).contains("M2\n"));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    ///
    /// # Errors
    /// Settings that contradict each other.
    #[doc(hidden)]
    pub fn with_machine(&self, commons: Commons) -> Result<Program, Error> {
        let wrong = contradictions::all(&commons);
        if !wrong.is_empty() {
            return Err(Error::Setup(wrong));
        }
        self.on_machine(commons)
    }

    /// The same program, whose runs note the settings that they read. The notes begin with what a
    /// run reads before its first record; only one run at a time should note in them.
    ///
    /// # Errors
    /// None for a machine that was built.
    #[doc(hidden)]
    pub fn with_reads(&self) -> Result<(Program, Reads), Error> {
        let mut commons = self.commons().clone();
        let reads = commons.note_reads();
        Ok((self.on_machine(commons)?, reads))
    }

    fn on_machine(&self, commons: Commons) -> Result<Program, Error> {
        let shared = &self.shared;
        let mut prototype =
            fil_post::Post::new(commons).map_err(|diag| Error::Setup(vec![*diag]))?;
        let warnings = &shared.prototype.control.warnings;
        prototype.control.warnings.levels = warnings.levels.clone();
        prototype.control.warnings.allowed_lines = Arc::clone(&warnings.allowed_lines);
        let shared = Shared {
            prototype,
            module: Arc::clone(&shared.module),
            vocabulary: shared.vocabulary.clone(),
            functions: Arc::clone(&shared.functions),
            limits: shared.limits,
            warnings: shared.warnings.clone(),
            clock: shared.clock,
            spawn: None,
            folders: shared.folders.clone(),
        };
        Ok(Program { shared: Arc::new(shared) })
    }

    /// The same machine without scripts, where records of these sections have no effect and no
    /// doubt stops a run: what is doubtful without the script may be right with it.
    ///
    /// # Errors
    /// A key that no section can have.
    pub(crate) fn without_scripts(&self, sections: &[String]) -> Result<Program, Error> {
        let mut levels = Levels::default();
        levels.set_all(Level::Allow);
        let sections = sections.iter().map(|key| format!("CIMFIL/ON,{key}\nCIMFIL/OFF\n"));
        let text: String = sections.chain(["FINI\n".to_string()]).collect();
        let file = FilFile { name: "", text: &text };
        let files = if text.starts_with("FINI") { Vec::new() } else { vec![file] };
        let mut vocabulary = Vocabulary::new();
        let options = LoadOptions { levels: levels.clone(), ..LoadOptions::default() };
        let loaded = fil_vm::load(&files, &mut vocabulary, options).map_err(Error::Setup)?;
        let mut prototype = self.shared.prototype.clone();
        prototype.control.warnings.levels = levels;
        prototype.control.warnings.allowed_lines = Arc::default();
        let shared = Shared {
            prototype,
            module: Arc::new(loaded.module),
            vocabulary,
            functions: Arc::default(),
            limits: self.shared.limits,
            warnings: Vec::new(),
            clock: None,
            spawn: None,
            folders: None,
        };
        Ok(Program { shared: Arc::new(shared) })
    }

    /// The options of the post, with their values.
    pub fn options(&self) -> &[PostOption] {
        self.commons().options().all()
    }

    /// Name and text of the FIL files, by the numbers in [`crate::FilLine::file`].
    pub fn fil_texts(&self) -> Vec<(String, Arc<str>)> {
        let files = self.shared.module.files.iter();
        files.map(|file| (file.name.clone(), Arc::clone(&file.text))).collect()
    }

    /// What a debug build can tell of; empty for any other.
    #[doc(hidden)]
    pub fn outline(&self) -> crate::debug::Outline {
        self.shared.module.outline()
    }

    /// Names of the FIL files, by the numbers in [`crate::FilLine::file`].
    pub fn fil_files(&self) -> Vec<String> {
        self.shared.module.files.iter().map(|file| file.name.clone()).collect()
    }
}

impl fmt::Debug for Program {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Program").field("fil_files", &self.fil_files()).finish_non_exhaustive()
    }
}
