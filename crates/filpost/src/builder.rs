//! Building a post: machine, FIL files, limits, functions, observers.

use std::io::{Read, Seek, Write};
use std::path::{Path, PathBuf};
use std::sync::Arc;

use fil_cl::{Vocabulary, reader};
use fil_diag::Diag;
use fil_machine::{Commons, files as settings};
use fil_vm::{Argument, Compat, FilFile, Functions, Included, Limits, LoadOptions, Loader, Module};

use crate::blocks::Blocks;
use crate::engine::Engine;
use crate::error::{Error, RunCode};
use crate::files;
use crate::granted::{Clock, Spawn};
use crate::map;
use crate::observe::{Observer, WhatHappened};
use crate::ready;
use crate::report::Report;
use crate::script_files::{Folders, HeldFiles, real_folder};

/// Where the settings of the machine come from.
enum Machine {
    Ready(String),
    Toml { name: String, text: String },
    OptionFile { name: String, text: String },
    Commons(Box<Commons>),
}

/// Collects what a post is made of; see [`Post::builder`].
pub struct Builder {
    machine: Option<Machine>,
    settings: Vec<String>,
    fil: Vec<(String, String)>,
    limits: Limits,
    compat: Compat,
    strict: bool,
    functions: Functions,
    observers: Vec<Observer>,
    cl_name: String,
    options: reader::Options,
    includes: Option<Includes>,
    clock: Option<Clock>,
    spawn: Option<Spawn>,
    read: Option<PathBuf>,
    write: Option<PathBuf>,
}

/// Gives a file that INCLUD names.
type Includes = Box<dyn FnMut(&str, &str) -> Result<Included, String> + Send>;

impl Builder {
    /// A post inside the crate, by its name in [`ready::READY`].
    pub fn ready(mut self, name: &str) -> Self {
        self.machine = Some(Machine::Ready(name.into()));
        self
    }

    /// The text of a `machine.toml`; `name` is what messages show.
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
    pub fn commons(mut self, commons: Commons) -> Self {
        self.machine = Some(Machine::Commons(Box::new(commons)));
        self
    }

    /// One more setting on top, `key=value` with a key of `machine.toml`.
    pub fn set(mut self, setting: &str) -> Self {
        self.settings.push(setting.into());
        self
    }

    /// A FIL file; several are read in this order into one name space.
    pub fn fil(mut self, name: &str, text: &str) -> Self {
        self.fil.push((name.into(), text.into()));
        self
    }

    /// What a script may use up before it is stopped.
    pub fn limits(mut self, limits: Limits) -> Self {
        self.limits = limits;
        self
    }

    /// Corrected readings of POSTF numbers and sections.
    pub fn compat(mut self, compat: Compat) -> Self {
        self.compat = compat;
        self
    }

    /// Refuses extensions of filpost, so that scripts stay portable.
    pub fn strict(mut self, strict: bool) -> Self {
        self.strict = strict;
        self
    }

    /// Adds a FIL function of this program. An `Err` stops the run with that
    /// sentence and the FIL line.
    pub fn function(
        mut self,
        name: &str,
        arity: u16,
        body: impl FnMut(&[Argument<'_>]) -> Result<f64, String> + Send + 'static,
    ) -> Self {
        self.functions.add(name, arity, body);
        self
    }

    /// Adds an observer of records, sections and blocks.
    pub fn observe(mut self, observer: impl FnMut(WhatHappened<'_>) + Send + 'static) -> Self {
        self.observers.push(Box::new(observer));
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
    pub fn grant_read(mut self, folder: impl Into<PathBuf>) -> Self {
        self.read = Some(folder.into());
        self
    }

    /// Lets scripts write and delete files of a folder and below it. What they
    /// write appears only when the run went well.
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
        run: impl FnMut(&str) -> Result<f64, String> + Send + 'static,
    ) -> Self {
        self.spawn = Some(Box::new(run));
        self
    }

    /// The name of the CL file in messages.
    pub fn cl_name(mut self, name: &str) -> Self {
        self.cl_name = name.into();
        self
    }

    /// How CL text is read: dialect, encoding of texts, longest statement.
    pub fn cl_options(mut self, options: reader::Options) -> Self {
        self.options = options;
        self
    }

    /// Builds the post; the machine is the generic mill when none was given.
    ///
    /// # Errors
    /// All that is wrong with the machine, or with the FIL files; E0701 for a
    /// granted folder that is not there.
    pub fn build(self) -> Result<Post, Error> {
        let (mut commons, mut warnings) = commons_of(self.machine)?;
        for setting in &self.settings {
            settings::apply_setting(&mut commons, setting).map_err(Error::setup)?;
        }
        let folders = folders(self.read.as_deref(), self.write.as_deref())?;
        let prototype = fil_post::Post::new(commons).map_err(Error::setup)?;
        let mut vocabulary = Vocabulary::new();
        let files: Vec<FilFile<'_>> =
            self.fil.iter().map(|(name, text)| FilFile { name, text }).collect();
        let mut includes = self.includes;
        let loaded = fil_vm::load(
            &files,
            &mut vocabulary,
            LoadOptions {
                compat: self.compat,
                limits: self.limits,
                strict: self.strict,
                functions: Some(&self.functions),
                loader: includes.as_mut().map(|loader| loader as Loader<'_>),
                ..LoadOptions::default()
            },
        )
        .map_err(Error::Setup)?;
        warnings.extend(loaded.warnings);
        Ok(Post {
            prototype,
            module: Arc::new(loaded.module),
            vocabulary,
            functions: self.functions,
            limits: self.limits,
            observers: self.observers,
            cl_name: self.cl_name,
            options: self.options,
            warnings,
            clock: self.clock,
            spawn: self.spawn,
            folders,
        })
    }
}

/// The granted folders; `None` without any.
fn folders(read: Option<&Path>, write: Option<&Path>) -> Result<Option<Arc<Folders>>, Error> {
    let folders = Folders {
        read: read.map(real_folder).transpose()?,
        write: write.map(real_folder).transpose()?,
    };
    let any = folders.read.is_some() || folders.write.is_some();
    Ok(any.then(|| Arc::new(folders)))
}

fn commons_of(machine: Option<Machine>) -> Result<(Commons, Vec<Diag>), Error> {
    let machine = machine.unwrap_or(Machine::Ready(ready::GENERIC_MILL.into()));
    match machine {
        Machine::Commons(commons) => Ok((*commons, Vec::new())),
        Machine::Toml { name, text } => settings::read_toml(&name, &text).map_err(Error::setup),
        Machine::OptionFile { name, text } => settings::read_option_file(&name, &text)
            .map(|file| (file.commons, file.warnings))
            .map_err(Error::setup),
        Machine::Ready(name) => {
            let post = ready::find(&name).ok_or_else(|| {
                let names: Vec<&str> = ready::READY.iter().map(|post| post.name).collect();
                let diag = Diag::new(RunCode::NoReadyPost, format!("no ready post `{name}`"))
                    .hint(format!("there are {}", names.join(", ")));
                Error::setup(diag)
            })?;
            settings::read_toml(post.name, post.machine).map_err(Error::setup)
        }
    }
}

/// A machine with its FIL, ready to post any number of CL files. Each run
/// starts from the same state.
pub struct Post {
    /// The post as each run starts with it.
    pub(crate) prototype: fil_post::Post,
    pub(crate) module: Arc<Module>,
    pub(crate) vocabulary: Vocabulary,
    pub(crate) functions: Functions,
    pub(crate) limits: Limits,
    pub(crate) observers: Vec<Observer>,
    pub(crate) cl_name: String,
    pub(crate) options: reader::Options,
    pub(crate) warnings: Vec<Diag>,
    pub(crate) clock: Option<Clock>,
    pub(crate) spawn: Option<Spawn>,
    pub(crate) folders: Option<Arc<Folders>>,
}

impl Post {
    /// Starts building a post.
    pub fn builder() -> Builder {
        Builder {
            machine: None,
            settings: Vec::new(),
            fil: Vec::new(),
            limits: Limits::default(),
            compat: Compat::default(),
            strict: false,
            functions: Functions::new(),
            observers: Vec::new(),
            cl_name: "CL".into(),
            options: reader::Options::default(),
            includes: None,
            clock: None,
            spawn: None,
            read: None,
            write: None,
        }
    }

    /// Warnings of building: settings without effect, forgiven FIL.
    pub fn warnings(&self) -> &[Diag] {
        &self.warnings
    }

    /// The settings.
    pub fn commons(&self) -> &Commons {
        &self.prototype.control.commons
    }

    /// Sets the name of the CL file in messages.
    pub fn name_cl(&mut self, name: &str) {
        self.cl_name = name.into();
    }

    /// Names of the FIL files, by the numbers in [`crate::FilLine::file`].
    pub fn fil_files(&self) -> Vec<String> {
        self.module.files.iter().map(|file| file.name.clone()).collect()
    }

    /// Posts a CL stream. The stream can't go back, so POSTF(15) and (16) are
    /// refused.
    ///
    /// # Errors
    /// The first thing that is wrong; what was written until then is not a
    /// program. The writer's own errors come as E0702.
    pub fn run(&mut self, cl: impl Read, nc: impl Write) -> Result<Report, Error> {
        let reader = reader::Reader::new(cl, &self.cl_name, self.options);
        let (report, held) = self.drive(reader, nc, None).0?;
        held.keep()?;
        Ok(report)
    }

    /// Posts a CL file that can go back.
    ///
    /// # Errors
    /// As [`Post::run`].
    pub fn run_seekable(&mut self, cl: impl Read + Seek, nc: impl Write) -> Result<Report, Error> {
        let (report, held) = self.run_held(cl, nc)?;
        held.keep()?;
        Ok(report)
    }

    /// The same, with the files of scripts held back until [`HeldFiles::keep`]: for
    /// a caller that can still refuse the program.
    ///
    /// # Errors
    /// As [`Post::run`].
    pub fn run_held(
        &mut self,
        cl: impl Read + Seek,
        nc: impl Write,
    ) -> Result<(Report, HeldFiles), Error> {
        let reader = reader::Reader::seekable(cl, &self.cl_name, self.options);
        self.drive(reader, nc, None).0
    }

    /// The same, with the line map of the run. `names` is how the map calls the
    /// files; see [`map::Names::from_folder`].
    ///
    /// # Errors
    /// As [`Post::run`]; E0702 for the map.
    pub fn run_mapped(
        &mut self,
        cl: impl Read + Seek,
        nc: impl Write,
        names: &map::Names,
        mut output: impl Write,
    ) -> Result<(Report, HeldFiles), Error> {
        let cant = |error| files::cant_read(Path::new(&names.cl), &error);
        let mut cl = map::Digested::new(cl).map_err(cant)?;
        let reader = reader::Reader::seekable(&mut cl, &self.cl_name, self.options);
        let cant_write = |error| files::cant_write(Path::new("the line map"), &error);
        let module = self.module.clone();
        let map = map::Writer::new(&mut output, names, &module).map_err(cant_write)?;
        let (result, map) = self.drive(reader, nc, Some(map));
        let result = result?;
        let digest = cl.finish().map_err(cant)?;
        map.map_or(Ok(()), |map| map.finish(digest)).map_err(cant_write)?;
        Ok(result)
    }

    /// The blocks of a CL stream, one by one, each with what made it.
    pub fn records<R: Read>(&mut self, cl: R) -> Blocks<'_, R> {
        let reader = reader::Reader::new(cl, &self.cl_name, self.options);
        Blocks::new(Engine::new(self, reader, true, None))
    }

    fn drive<'p, R: Read>(
        &'p mut self,
        reader: reader::Reader<R>,
        mut nc: impl Write,
        map: Option<map::Writer<'p>>,
    ) -> (Result<(Report, HeldFiles), Error>, Option<map::Writer<'p>>) {
        let observed = !self.observers.is_empty();
        let mut engine = Engine::new(self, reader, observed, map);
        let result = engine.run(&mut nc);
        engine.finish();
        (result, engine.take_map())
    }
}
