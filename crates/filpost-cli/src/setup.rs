//! From the command line to a post: machine, FIL files, readings.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use filpost::nc::dialect::Family;
use filpost::nc::source::Source;
use filpost::select::{self, Asked, Choice, Machin};
use filpost::{Builder, Clock, CompatFile, Error, Program, files, includes, ready};

use crate::args::{Chosen, ClReading, ClockSource, Grant, Grants, RawRecords, Reading};

/// A post named by a command line, not yet built.
pub struct Named {
    /// The builder with machine and FIL files.
    pub builder: Builder,
    /// What the summary calls it.
    pub title: String,
    /// Something the user should know about the choice.
    pub note: Option<String>,
    /// All files it was read from.
    pub inputs: Vec<PathBuf>,
    /// FIL files of the post.
    fil: Vec<PathBuf>,
    /// The FIL file beside an option file.
    partner: Option<PathBuf>,
    /// Why it was chosen.
    why: Option<String>,
}

impl Named {
    fn new(builder: Builder, title: impl Into<String>) -> Named {
        Named {
            builder,
            title: title.into(),
            note: None,
            inputs: Vec::new(),
            fil: Vec::new(),
            partner: None,
            why: None,
        }
    }

    /// Adds the FIL files of `-f`; they take the place of the one beside an option
    /// file, which the summary then names.
    fn take_fil(&mut self, given: &[PathBuf]) {
        match &self.partner {
            Some(partner) if given.is_empty() => {
                self.title.push_str(&format!(" with {}", partner.display()));
                self.fil.push(partner.clone());
            }
            Some(partner) => {
                let same = |path: &PathBuf| path.canonicalize().ok() == partner.canonicalize().ok();
                let note = format!("{} is not used: -f names the FIL files", partner.display());
                self.note = (!given.iter().any(same)).then_some(note);
            }
            None => {}
        }
        if let Some(why) = &self.why {
            self.title.push_str(&format!(" ({why})"));
        }
        self.fil.extend(given.iter().cloned());
    }

    /// Adds the FIL files and lets INCLUD read files beside them.
    pub fn with_fil(mut self, encoding: Option<&str>) -> Result<Named, Error> {
        for path in &self.fil {
            let text = files::read_text(path, encoding)?;
            self.builder = self.builder.fil(&path.display().to_string(), &text);
        }
        self.builder =
            self.builder.includes(includes::beside_either(&self.fil, &self.inputs, encoding));
        self.inputs.extend(self.fil.iter().cloned());
        Ok(self)
    }
}

/// The post of `-p` or `-m`; `None` when neither is given.
///
/// # Errors
/// Files that can't be read.
pub fn named(chosen: &Chosen, encoding: Option<&str>) -> Result<Option<Named>, Error> {
    let named = match (&chosen.post, &chosen.machine) {
        (Some(post), _) if ready::find(post).is_none() && Path::new(post).is_dir() => {
            folder(Path::new(post), encoding)?
        }
        (Some(post), _) => Named::new(Program::builder().ready(post), post),
        (None, Some(machine)) => machine_file(machine, encoding)?,
        (None, None) => return Ok(None),
    };
    let named = match (&chosen.post, &chosen.machine) {
        (Some(_), Some(machine)) => over(named, machine, encoding)?,
        _ => named,
    };
    Ok(Some(with_settings(named, chosen)))
}

/// Lays the settings of `-m` over the post of `-p`.
///
/// # Errors
/// A file that can't be read.
fn over(mut named: Named, machine: &Path, encoding: Option<&str>) -> Result<Named, Error> {
    let text = files::read_text(machine, encoding)?;
    let name = machine.display().to_string();
    named.builder = named.builder.lay_over(&name, &text);
    named.title = format!("{} with {name}", named.title);
    named.inputs.push(machine.to_path_buf());
    Ok(named)
}

/// Where the post of a run comes from; equal ones give the same post.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum From {
    /// From `-p` or `-m`.
    CommandLine,
    /// From what the CL file asks for.
    ClFile(Choice, Option<Machin>),
    /// From the text of an NC program, as neither names one.
    Program(Family),
}

impl From {
    /// Where the post of an NC program comes from: a program whose machine neither the
    /// command line nor a CL file names is read by a post of the family of its text. A
    /// lathe's keeps the generic lathe: the other families have no ready one.
    ///
    /// # Errors
    /// A program that can't be read.
    pub fn or_text_of(self, chosen: &Chosen, nc: &Source<'_>, name: &str) -> Result<From, Error> {
        let unnamed = match &self {
            From::CommandLine => chosen.post.is_none() && chosen.machine.is_none(),
            From::ClFile(Choice::Generic { turning, .. }, _) => turning.is_none(),
            From::ClFile(..) | From::Program(_) => false,
        };
        if !unnamed {
            return Ok(self);
        }
        let family = Family::of(nc).map_err(|error| files::cant_read(name.as_ref(), &error))?;
        Ok(if family == Family::WordAddress { self } else { From::Program(family) })
    }
}

/// Where the post of a CL file comes from: what the command line names, else what
/// MACHIN asks for. `asked` looks into the CL file; it is called only in the second
/// case.
///
/// # Errors
/// A CL file that can't be read as far as MACHIN; E0714 for one that names no post.
pub fn from(
    chosen: &Chosen,
    folders: &[PathBuf],
    asked: impl FnOnce() -> Result<Asked, Error>,
) -> Result<From, Error> {
    if chosen.post.is_some() || chosen.machine.is_some() {
        return Ok(From::CommandLine);
    }
    let asked = asked()?;
    Ok(From::ClFile(select::choose(&asked, folders)?, asked.machin))
}

/// Refuses a CL file with another MACHIN than the one that its post was chosen for.
/// `machines` are those that it names; called only where the file chose the post.
///
/// # Errors
/// E0714
pub fn confirm(
    from: &From,
    machines: impl FnOnce() -> Result<Vec<(Machin, u32)>, Error>,
    cl_name: &str,
) -> Result<(), Error> {
    match from {
        From::CommandLine => Ok(()),
        From::Program(_) => select::confirm(None, &machines()?, cl_name),
        From::ClFile(_, machin) => select::confirm(machin.as_ref(), &machines()?, cl_name),
    }
}

/// Reads a post without its FIL files, with the settings of the command line.
///
/// # Errors
/// Files that can't be read.
pub fn machine(chosen: &Chosen, encoding: Option<&str>, from: &From) -> Result<Named, Error> {
    match from {
        From::CommandLine => {
            let named = named(chosen, encoding)?;
            Ok(named.unwrap_or_else(|| with_settings(generic(), chosen)))
        }
        From::ClFile(choice, machin) => {
            let named = asked_for(choice, machin.as_ref(), encoding)?;
            Ok(with_settings(named, chosen))
        }
        From::Program(family) => {
            let name = ready::generic_for(*family);
            let title = format!("{name} (the program is {}; no post is named)", family.title());
            Ok(with_settings(Named::new(Program::builder().generic(name), title), chosen))
        }
    }
}

/// Reads a post with its FIL files: those of `-f`, else those that belong to it.
///
/// # Errors
/// Files that can't be read.
pub fn for_run(
    chosen: &Chosen,
    fil: &[PathBuf],
    reading: &Reading,
    from: &From,
) -> Result<Named, Error> {
    let encoding = reading.encoding.as_deref();
    let mut named = machine(chosen, encoding, from)?;
    named.take_fil(fil);
    let mut named = named.with_fil(encoding)?;
    named.builder = named.builder.strict(reading.strict);
    named.builder = named.builder.levels(&reading.levels.levels);
    named.builder = named.builder.compat(compat(reading)?);
    named.inputs.extend(reading.compat.clone());
    Ok(named)
}

/// The post where nothing names one.
fn generic() -> Named {
    let title = format!("{} (no post is named)", ready::GENERIC_MILL);
    Named::new(Program::builder().generic(ready::GENERIC_MILL), title)
}

/// The readings of `--compat`, or the built-in ones.
///
/// # Errors
/// A compat file that can't be read or used.
pub fn compat(reading: &Reading) -> Result<CompatFile, Error> {
    let Some(path) = &reading.compat else { return Ok(CompatFile::default()) };
    let text = files::read_text(path, reading.encoding.as_deref())?;
    filpost::read_compat(&path.display().to_string(), &text).map_err(Error::Run)
}

/// A folder with `machine.toml` and `post.fil`, or other FIL files where there is none.
fn folder(folder: &Path, encoding: Option<&str>) -> Result<Named, Error> {
    let (machine, fil) = files::of_post(folder)?;
    let mut named = machine_file(&machine, encoding)?;
    named.fil.extend(fil);
    named.title = folder.display().to_string();
    Ok(named)
}

/// A `machine.toml` or an option file, told by its ending or its text. The FIL file
/// beside an option file belongs to it: both have the machine's name and number.
fn machine_file(path: &Path, encoding: Option<&str>) -> Result<Named, Error> {
    let text = files::read_text(path, encoding)?;
    let name = path.display().to_string();
    let is_option_file = is_option_text(path, &text);
    let builder = if is_option_file {
        Program::builder().option_file(&name, &text)
    } else {
        Program::builder().machine(&name, &text)
    };
    let mut named = Named::new(builder, name);
    named.inputs.push(path.to_path_buf());
    named.partner = select::fil_beside(path).filter(|_| is_option_file);
    Ok(named)
}

/// A machine file is an option file and not a `machine.toml`.
///
/// # Errors
/// A file that can't be read.
pub fn is_option_file(path: &Path) -> Result<bool, Error> {
    Ok(is_option_text(path, &files::read_text(path, None)?))
}

fn is_option_text(path: &Path, text: &str) -> bool {
    let ending = path.extension().and_then(|ending| ending.to_str()).unwrap_or("");
    let digits = ending.strip_prefix(['p', 'P']).unwrap_or("");
    let numbered = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    numbered || text.lines().take(10).any(|line| line.trim_start().starts_with("INTCOM:"))
}

/// The post that a CL file asks for.
fn asked_for(
    choice: &Choice,
    machin: Option<&Machin>,
    encoding: Option<&str>,
) -> Result<Named, Error> {
    let asked = machin.map(Machin::to_string).unwrap_or_default();
    match choice {
        Choice::Ready(name) => {
            Ok(Named::new(Program::builder().ready(name), format!("{name} (for {asked})")))
        }
        Choice::OptionFile { option_file, .. } => {
            let mut named = machine_file(option_file, encoding)?;
            named.why = Some(format!("for {asked}"));
            Ok(named)
        }
        Choice::Generic { name, turning, .. } => {
            let mut why = "the CL file has no MACHIN".to_string();
            if let Some(word) = turning {
                why.push_str(&format!("; {word} says turning"));
            }
            Ok(Named::new(Program::builder().generic(name), format!("{name} ({why})")))
        }
        _ => unreachable!("select knows no other choice"),
    }
}

fn with_settings(mut named: Named, chosen: &Chosen) -> Named {
    for setting in &chosen.set {
        named.builder = named.builder.set(setting);
    }
    for (name, value) in &chosen.option {
        named.builder = named.builder.option(name, value);
    }
    named
}

/// Grants scripts what the command line says.
pub fn granted(mut builder: Builder, grants: &Grants) -> Builder {
    for grant in &grants.grant {
        builder = match grant {
            Grant::Read(folder) => builder.grant_read(folder),
            Grant::Write(folder) => builder.grant_write(folder),
        };
    }
    match (grants.set_clock, grants.clock) {
        (Some(moment), _) => builder.clock(Clock::Fixed(moment)),
        (None, Some(ClockSource::System)) => builder.clock(Clock::System),
        (None, None) => builder,
    }
}

/// The encoding `--encoding` names; the reader of CL text takes a plain
/// function, which can't carry it along.
static ENCODING: OnceLock<String> = OnceLock::new();

/// How CL text is read under `--encoding`, `--dialect` and `--raw-records`.
///
/// # Errors
/// A label that names no encoding.
pub fn cl_options(
    encoding: Option<&str>,
    reading: &ClReading,
    raw: RawRecords,
) -> Result<filpost::cl::reader::Options, Error> {
    if let Some(label) = encoding {
        filpost::syntax::decode(b"", Some(label)).map_err(|diag| Error::Run(Box::new(diag)))?;
        ENCODING.get_or_init(|| label.to_string());
    }
    let dialect = reading.dialect;
    let raw = raw.raw_records;
    Ok(filpost::cl::reader::Options { dialect, decode: decode_cl, raw, ..Default::default() })
}

/// A text of the CL file that is not UTF-8; bytes that mean nothing in the
/// named encoding are read as the guess reads them.
fn decode_cl(bytes: &[u8]) -> String {
    let label = ENCODING.get().map(String::as_str);
    filpost::syntax::decode(bytes, label)
        .or_else(|_| filpost::syntax::decode(bytes, None))
        .map_or_else(|_| filpost::cl::reader::latin1(bytes), |(text, _)| text.into_owned())
}
