//! Building a program: machine, FIL files, limits, functions, grants.

#[cfg(feature = "files")]
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fil_cl::Vocabulary;
use fil_diag::{Code, Diag, Level, Levels};
use fil_machine::Commons;
use fil_machine::locations::INPUT_CREO_RECORDS;
use fil_machine::post_options::GivenOption;
use fil_post::FilLine;
use fil_post::warnings::AllowedLines;
use fil_vm::{
    Argument, Edits, FilFile, Functions, Included, Limits, LoadOptions, Loader, MachineFacts,
    Module, Returned,
};

use crate::allow::LevelOf;
use crate::compat::CompatFile;
use crate::editing;
use crate::error::Error;
#[cfg(feature = "files")]
use crate::files;
use crate::granted::{Clock, Spawn};
#[cfg(feature = "files")]
use crate::includes;
use crate::machine::{self, Layers, Machine};
use crate::program::{Program, Shared};
use crate::script_files::Folders;

/// Collects what a program is made of; see [`Program::builder`].
#[must_use = "a builder makes no program before `build`"]
pub struct Builder {
    machine: Option<Machine>,
    /// Name and text of each machine.toml laid over the machine.
    over: Vec<(String, String)>,
    settings: Vec<String>,
    options: Vec<GivenOption>,
    fil: Vec<(String, String)>,
    limits: Limits,
    compat: CompatFile,
    strict: bool,
    levels: Levels,
    functions: Functions,
    includes: Option<Includes>,
    clock: Option<Clock>,
    spawn: Option<Spawn>,
    #[cfg(feature = "files")]
    read: Option<PathBuf>,
    #[cfg(feature = "files")]
    write: Option<PathBuf>,
    debug: bool,
}

/// Gives a file that INCLUD names.
type Includes = Box<dyn FnMut(&str, &str) -> Result<Included, String> + Send>;

impl Builder {
    pub(crate) fn new() -> Self {
        Builder {
            machine: None,
            over: Vec::new(),
            settings: Vec::new(),
            options: Vec::new(),
            fil: Vec::new(),
            limits: Limits::default(),
            compat: CompatFile::default(),
            strict: false,
            levels: Levels::default(),
            functions: Functions::new(),
            includes: None,
            clock: None,
            spawn: None,
            #[cfg(feature = "files")]
            read: None,
            #[cfg(feature = "files")]
            write: None,
            debug: false,
        }
    }

    /// A post inside the crate, by its name in [`crate::ready::READY`].
    pub fn ready(mut self, name: &str) -> Self {
        self.machine = Some(Machine::Ready(name.into()));
        self
    }

    /// The same where nothing names a post: it writes the plain form of a program unless options
    /// ask for another.
    pub fn generic(mut self, name: &str) -> Self {
        self.machine = Some(Machine::Generic(name.into()));
        self
    }

    /// The text of a `machine.toml`; `name` is what messages show. Its `base` may name a
    /// post inside the crate.
    pub fn machine(mut self, name: &str, text: &str) -> Self {
        self.machine = Some(Machine::Toml { name: name.into(), text: text.into() });
        self
    }

    /// The text of an option file (UNCX01.Pnn).
    pub fn option_file(mut self, name: &str, text: &str) -> Self {
        self.machine = Some(Machine::OptionFile { name: name.into(), text: text.into() });
        self
    }

    /// Settings made in the program itself.
    #[doc(hidden)]
    pub fn commons(mut self, commons: Commons) -> Self {
        self.machine = Some(Machine::Commons(Box::new(commons)));
        self
    }

    /// The text of a `machine.toml` whose settings are laid over the machine; of several
    /// the later one wins. `name` is what messages show.
    pub fn lay_over(mut self, name: &str, text: &str) -> Self {
        self.over.push((name.into(), text.into()));
        self
    }

    /// One more setting on top, `key=value` with a key of `machine.toml`.
    pub fn set(mut self, setting: &str) -> Self {
        self.settings.push(setting.into());
        self
    }

    /// One more setting on top, a whole number: flags and choices of `machine.toml` that are
    /// numbers, counts, codes.
    ///
    /// ```
    /// use filpost::Program;
    ///
    /// let builder = Program::builder().ready("fanuc-mill").set_int("seqno.increment", 5);
    /// let program = builder.set_number("feed.upm_max", 2500.0).set_text("tape.encoding", "windows-1252");
    /// assert!(program.build().is_ok());
    /// let unknown = Program::builder().set_int("seqno.incremant", 5).build();
    /// assert!(unknown.expect_err("refused").to_string().contains("seqno.increment"));
    /// ```
    pub fn set_int(self, key: &str, value: i64) -> Self {
        self.set(&format!("{key}={value}"))
    }

    /// One more setting on top, a number in the unit that `machine.toml` has for the key:
    /// lengths in the unit of the machine, degrees, per minute. One that is not finite is refused
    /// by [`Builder::build`].
    pub fn set_number(self, key: &str, value: f64) -> Self {
        self.set(&format!("{key}={value:?}"))
    }

    /// One more setting on top, a text: a letter, a name of a choice, a text of the program.
    pub fn set_text(self, key: &str, value: &str) -> Self {
        self.set(&format!("{key}={}", toml::Value::from(value)))
    }

    /// The value of an option of the post: of those given for one option the last counts, and it
    /// wins over `[options]` of a `machine.toml`.
    ///
    /// ```
    /// use filpost::Program;
    ///
    /// let machine = "base = 'fanuc-mill'\n[option.step]\ntype = 'integer'\ndefault = 10\n\
    ///                group = 'formats'\nhelp = 'Step of N'\nset = 'seqno.increment'\n";
    /// let builder = Program::builder().machine("machine.toml", machine).option("step", "5");
    /// let program = builder.build()?;
    /// let step = program.options().iter().find(|option| option.name == "step");
    /// assert_eq!(step.map(|step| step.value.to_string()).as_deref(), Some("5"));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn option(mut self, name: &str, value: &str) -> Self {
        self.options.push(GivenOption { name: name.into(), text: value.into(), place: None });
        self
    }

    /// A FIL file; several are read in this order into one name space.
    pub fn fil(mut self, name: &str, text: &str) -> Self {
        self.fil.push((name.into(), text.into()));
        self
    }

    /// The post in a folder: its `machine.toml`, and `post.fil` or, where there is none, all its
    /// FIL files by name; INCLUD finds files beside them.
    ///
    /// # Errors
    /// E0701 for a file that can't be read.
    #[cfg(feature = "files")]
    pub fn folder(self, folder: &Path) -> Result<Self, Error> {
        let (machine, fil) = files::of_post(folder)?;
        let name = |path: &Path| path.display().to_string();
        let mut builder = self.machine(&name(&machine), &files::read_text(&machine, None)?);
        for path in &fil {
            builder = builder.fil(&name(path), &files::read_text(path, None)?);
        }
        Ok(builder.includes(includes::beside_either(&fil, &[machine], None)))
    }

    /// What a script may use up before it is stopped.
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Corrected readings of POSTF numbers and sections, and words without effect: those
    /// of a [file](crate::read_compat), or the readings alone.
    pub fn compat(mut self, compat: impl Into<CompatFile>) -> Self {
        self.compat = compat.into();
        self
    }

    /// Refuses extensions of filpost, so that scripts stay portable.
    pub fn strict(mut self, strict: bool) -> Self {
        self.strict = strict;
        self
    }

    /// Makes a debug build: bytecode that tells a [`Debugger`](crate::debug::Debugger) of each
    /// statement and each outcome of a condition. It writes the same program, more slowly.
    #[doc(hidden)]
    pub fn debug(mut self, debug: bool) -> Self {
        self.debug = debug;
        self
    }

    /// Allows a code: a warning is not given, and a doubt, of a script or of the post, stops
    /// nothing. See [`crate::allowable`]; other errors are not allowed by it.
    pub fn allow(self, code: &'static Code) -> Self {
        self.level(LevelOf::Code(code), Level::Allow)
    }

    /// Sets the level of a code, or of all: those of single codes win over that of all, and
    /// both over what the machine sets.
    ///
    /// ```
    /// use filpost::{Level, LevelOf, Program};
    ///
    /// let program = Program::builder()
    ///     .ready("fanuc-mill")
    ///     .level(LevelOf::named("E0532")?, Level::Warn)
    ///     .build()?;
    /// # Ok::<(), Box<dyn std::error::Error>>(())
    /// ```
    pub fn level(mut self, of: LevelOf, level: Level) -> Self {
        of.set(&mut self.levels, level);
        self
    }

    /// Sets several levels, and the profile where these choose one.
    pub fn levels(mut self, levels: &Levels) -> Self {
        self.levels.lay_over(levels);
        self
    }

    /// Adds a function of your own to FIL. It returns a number or a text
    /// ([`Returned`]); an `Err` stops the run with that sentence and the FIL line.
    /// Runs in several threads call it at the same time.
    ///
    /// Its name must be its own: one that FIL or the CL vocabulary has is refused
    /// by [`Builder::build`] (E0229).
    ///
    /// ```
    /// use filpost::Program;
    ///
    /// let fil = "CIMFIL/ON,LOADTL\nNAME=TNAMEF(POSTF(7,4))\nPPRINT/NAME\nDMY=POSTF(13)\n\
    ///            CIMFIL/OFF\nFINI\n";
    /// let program = Program::builder()
    ///     .ready("fanuc-mill")
    ///     .fil("tools.fil", fil)
    ///     .function("TNAMEF", 1, |arguments| match arguments[0].number() {
    ///         Some(3.0) => Ok("END MILL 12"),
    ///         _ => Err("this tool is in no drawer".into()),
    ///     })
    ///     .build()?;
    /// let posted = program.post("UNITS / MM\nLOADTL / 3\nFINI\n")?;
    /// assert!(posted.text().contains("(END MILL 12)"));
    /// let refused = program.post("UNITS / MM\nLOADTL / 4\nFINI\n");
    /// assert!(refused.expect_err("refused").to_string().contains("in no drawer"));
    /// # Ok::<(), filpost::Error>(())
    /// ```
    pub fn function<T: Into<Returned>>(
        mut self,
        name: &str,
        arity: u16,
        body: impl Fn(&[Argument<'_>]) -> Result<T, String> + Send + Sync + 'static,
    ) -> Self {
        self.functions.add(name, arity, body);
        self
    }

    /// Gives the files that INCLUD names, from the name of the including file and
    /// what INCLUD says; [`crate::includes::beside`] takes them from the disk.
    /// Without it INCLUD is refused.
    pub fn includes(
        mut self,
        loader: impl FnMut(&str, &str) -> Result<Included, String> + Send + 'static,
    ) -> Self {
        self.includes = Some(Box::new(loader));
        self
    }

    /// Lets scripts read files of a folder and below it.
    #[cfg(feature = "files")]
    pub fn grant_read(mut self, folder: impl Into<PathBuf>) -> Self {
        self.read = Some(folder.into());
        self
    }

    /// Lets scripts write and delete files of a folder and below it. What they
    /// write appears only when the run went well.
    #[cfg(feature = "files")]
    pub fn grant_write(mut self, folder: impl Into<PathBuf>) -> Self {
        self.write = Some(folder.into());
        self
    }

    /// Lets scripts see a date and time.
    pub fn clock(mut self, clock: Clock) -> Self {
        self.clock = Some(clock);
        self
    }

    /// Runs the commands of SPAWNF and gives their status; an `Err` stops the run
    /// with that sentence and the FIL line. Without it SPAWNF is refused.
    pub fn allow_spawn(
        mut self,
        run: impl Fn(&str) -> Result<f64, String> + Send + Sync + 'static,
    ) -> Self {
        self.spawn = Some(Box::new(run));
        self
    }

    /// Builds the program; the machine is the generic mill when none was given.
    ///
    /// # Errors
    /// All that is wrong with the machine, the settings on top, the FIL files and the
    /// names of added functions; E0701 for a granted folder that is not there.
    pub fn build(self) -> Result<Program, Error> {
        let folders = self.folders()?;
        let post = machine::post(&self.layers(), self.machine.as_ref());
        let mut vocabulary = Vocabulary::new();
        let files: Vec<FilFile<'_>> =
            self.fil.iter().map(|(name, text)| FilFile { name, text }).collect();
        let mut includes = self.includes;
        let mut levels = Levels::default();
        if let Ok((post, _)) = &post {
            levels.lay_over(post.control.commons.levels());
        }
        levels.lay_over(&self.levels);
        let takes_creo_records =
            post.as_ref().is_ok_and(|(post, _)| post.control.commons.read(INPUT_CREO_RECORDS));
        let edits = post
            .as_ref()
            .map_or_else(|_| Edits::default(), |(post, _)| editing::edits(&post.control.commons));
        let loaded = fil_vm::load(
            &files,
            &mut vocabulary,
            LoadOptions {
                compat: self.compat.readings,
                limits: self.limits,
                strict: self.strict,
                levels: levels.clone(),
                facts: MachineFacts { takes_creo_records, edits, ..MachineFacts::default() },
                functions: Some(&self.functions),
                loader: includes.as_mut().map(|loader| loader as Loader<'_>),
                debug: self.debug,
                ..LoadOptions::default()
            },
        );
        let ((mut prototype, mut warnings), loaded) = match (post, loaded) {
            (Ok(post), Ok(loaded)) => (post, loaded),
            (post, loaded) => {
                let errors = [post.err(), loaded.err()];
                return Err(Error::Setup(errors.into_iter().flatten().flatten().collect()));
            }
        };
        warnings = at_levels(warnings, &levels)?;
        warnings.extend(loaded.warnings);
        prototype.control.warnings.levels = levels;
        prototype.control.warnings.allowed_lines = Arc::new(allowed_lines(&loaded.module));
        let shared = Shared {
            prototype,
            module: Arc::new(loaded.module),
            vocabulary,
            functions: Arc::new(self.functions),
            limits: self.limits,
            warnings,
            clock: self.clock,
            spawn: self.spawn,
            folders,
        };
        Ok(Program { shared: Arc::new(shared) })
    }

    /// The machine alone, without FIL, with the settings on top.
    ///
    /// # Errors
    /// All that is wrong with the machine and the settings.
    #[doc(hidden)]
    pub fn build_machine(self) -> Result<Commons, Error> {
        let made = machine::commons_with(&self.layers(), self.machine.as_ref());
        made.map(|(commons, _)| commons).map_err(Error::Setup)
    }

    /// What is laid over the machine.
    fn layers(&self) -> Layers<'_> {
        Layers {
            over: &self.over,
            settings: &self.settings,
            options: &self.options,
            fil: &self.fil,
            without_effect: &self.compat.without_effect,
        }
    }

    /// The granted folders; `None` without any.
    #[cfg(feature = "files")]
    fn folders(&self) -> Result<Option<Arc<Folders>>, Error> {
        let open = |folder: &Option<PathBuf>| {
            folder.as_deref().map(crate::script_files::Folder::open).transpose()
        };
        let folders = Folders { read: open(&self.read)?, write: open(&self.write)? };
        let any = folders.read.is_some() || folders.write.is_some();
        Ok(any.then(|| Arc::new(folders)))
    }

    #[cfg(not(feature = "files"))]
    fn folders(&self) -> Result<Option<Arc<Folders>>, Error> {
        Ok(None)
    }
}

/// What comments of FIL allow while the script runs.
fn allowed_lines(module: &Module) -> AllowedLines {
    let mut lines = AllowedLines::new();
    for (file, line, code) in &module.allowed {
        lines.entry(FilLine { file: *file, line: *line }).or_default().push(*code);
    }
    lines
}

/// The warnings of a machine at their levels.
///
/// # Errors
/// Those that are denied.
fn at_levels(warnings: Vec<Diag>, levels: &Levels) -> Result<Vec<Diag>, Error> {
    let at_level = |diag: Diag| {
        let level = levels.of_code(diag.code);
        diag.at_level(level)
    };
    let kept: Vec<Diag> = warnings.into_iter().filter_map(at_level).collect();
    let (errors, kept): (Vec<Diag>, Vec<Diag>) = kept.into_iter().partition(Diag::is_error);
    if errors.is_empty() { Ok(kept) } else { Err(Error::Setup(errors)) }
}
