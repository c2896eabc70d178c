//! From the command line to a post: machine, FIL files, readings.

use std::path::{Path, PathBuf};
use std::sync::OnceLock;

use filpost::select::{self, Choice, Machin};
use filpost::{Builder, Clock, Compat, Error, Program, files, includes, ready};

use crate::args::{Chosen, ClReading, ClockSource, Grant, Grants, Reading};

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
    fil: Vec<PathBuf>,
}

impl Named {
    fn new(builder: Builder, title: impl Into<String>) -> Named {
        Named { builder, title: title.into(), note: None, inputs: Vec::new(), fil: Vec::new() }
    }

    /// Adds the FIL files and lets INCLUD read files beside them.
    fn with_fil(mut self, encoding: Option<&str>) -> Result<Named, Error> {
        for path in &self.fil {
            let text = files::read_text(path, encoding)?;
            self.builder = self.builder.fil(&path.display().to_string(), &text);
        }
        self.builder = self.builder.includes(includes::beside(&self.fil, encoding));
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
    Ok(Some(with_settings(named, &chosen.set)))
}

/// Where the post of a run comes from; equal ones give the same post.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub enum From {
    /// From `-p` or `-m`.
    CommandLine,
    /// From what the CL file asks for.
    ClFile(Choice, Option<Machin>),
}

/// The post of `filpost post`: what the command line names, else what MACHIN
/// in the CL file asks for. `machin` is called only in the second case.
///
/// # Errors
/// A CL file that can't be read as far as MACHIN.
pub fn from(
    chosen: &Chosen,
    folders: &[PathBuf],
    machin: impl FnOnce() -> Result<Option<Machin>, Error>,
) -> Result<From, Error> {
    if chosen.post.is_some() || chosen.machine.is_some() {
        return Ok(From::CommandLine);
    }
    let machin = machin()?;
    Ok(From::ClFile(select::for_machin(machin.as_ref(), folders), machin))
}

/// Reads that post with its FIL files.
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
    let mut named = match from {
        From::CommandLine => named(chosen, encoding)?.unwrap_or_else(generic),
        From::ClFile(choice, machin) => asked(chosen, choice, machin.as_ref(), encoding)?,
    };
    if *from != From::CommandLine && !fil.is_empty() {
        named.fil.clear();
    }
    named.fil.extend(fil.iter().cloned());
    if named.fil.is_empty() {
        named.note = named.note.or_else(|| unused_fil(chosen.machine.as_deref()?));
    }
    let mut named = named.with_fil(encoding)?;
    named.builder = named.builder.strict(reading.strict);
    for code in &reading.allow {
        named.builder = named.builder.allow(code);
    }
    named.builder = named.builder.compat(compat(reading)?);
    named.inputs.extend(reading.compat.clone());
    Ok(named)
}

/// The post that MACHIN asks for, with the settings of the command line.
///
/// # Errors
/// Files that can't be read.
pub fn asked(
    chosen: &Chosen,
    choice: &Choice,
    machin: Option<&Machin>,
    encoding: Option<&str>,
) -> Result<Named, Error> {
    Ok(with_settings(asked_for(choice, machin, encoding)?, &chosen.set))
}

/// The post where nothing names one.
fn generic() -> Named {
    Named::new(Program::builder().ready(ready::GENERIC_MILL), ready::GENERIC_MILL)
}

/// The readings of `--compat`, or the built-in ones.
///
/// # Errors
/// A compat file that can't be read or used.
pub fn compat(reading: &Reading) -> Result<Compat, Error> {
    let Some(path) = &reading.compat else { return Ok(Compat::default()) };
    let text = files::read_text(path, reading.encoding.as_deref())?;
    filpost::read_compat(&path.display().to_string(), &text).map_err(Error::Run)
}

/// A folder with `machine.toml` and, where there is one, `post.fil`.
fn folder(folder: &Path, encoding: Option<&str>) -> Result<Named, Error> {
    let mut named = machine_file(&folder.join("machine.toml"), encoding)?;
    let fil = folder.join("post.fil");
    if fil.is_file() {
        named.fil.push(fil);
    }
    named.title = folder.display().to_string();
    Ok(named)
}

/// A `machine.toml` or an option file, told by its ending or its text.
fn machine_file(path: &Path, encoding: Option<&str>) -> Result<Named, Error> {
    let text = files::read_text(path, encoding)?;
    let name = path.display().to_string();
    let builder = if is_option_text(path, &text) {
        Program::builder().option_file(&name, &text)
    } else {
        Program::builder().machine(&name, &text)
    };
    let mut named = Named::new(builder, name);
    named.inputs.push(path.to_path_buf());
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

/// A word about the FIL file beside an option file that is given without one.
fn unused_fil(option_file: &Path) -> Option<String> {
    let fil = select::fil_beside(option_file)?;
    Some(format!("{0} beside the option file is not used; give it with -f {0}", fil.display()))
}

/// The post MACHIN asks for.
fn asked_for(
    choice: &Choice,
    machin: Option<&Machin>,
    encoding: Option<&str>,
) -> Result<Named, Error> {
    let asked = machin.map(|machin| format!("MACHIN/{},{}", machin.name, machin.number));
    match choice {
        Choice::Ready(name) => {
            let why = match &asked {
                Some(asked) if machin.is_some_and(|machin| ready::find(&machin.name).is_some()) => {
                    format!("for {asked}")
                }
                Some(asked) => format!("no post found for {asked}"),
                None => "the CL file has no MACHIN".into(),
            };
            Ok(Named::new(Program::builder().ready(name), format!("{name} ({why})")))
        }
        Choice::OptionFile { option_file, fil } => {
            let mut named = machine_file(option_file, encoding)?;
            if let Some(fil) = fil {
                named.title.push_str(&format!(" with {}", fil.display()));
            }
            named.title.push_str(&format!(" (for {})", asked.unwrap_or_default()));
            named.fil.extend(fil.clone());
            Ok(named)
        }
    }
}

fn with_settings(mut named: Named, settings: &[String]) -> Named {
    for setting in settings {
        named.builder = named.builder.set(setting);
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

/// How CL text is read under `--encoding` and `--dialect`.
///
/// # Errors
/// A label that names no encoding.
pub fn cl_options(
    encoding: Option<&str>,
    reading: &ClReading,
) -> Result<filpost::cl::reader::Options, Error> {
    if let Some(label) = encoding {
        filpost::syntax::decode(b"", Some(label)).map_err(|diag| Error::Run(Box::new(diag)))?;
        ENCODING.get_or_init(|| label.to_string());
    }
    let dialect = reading.dialect;
    Ok(filpost::cl::reader::Options { dialect, decode: decode_cl, ..Default::default() })
}

/// A text of the CL file that is not UTF-8; bytes that mean nothing in the
/// named encoding are read as the guess reads them.
fn decode_cl(bytes: &[u8]) -> String {
    let label = ENCODING.get().map(String::as_str);
    filpost::syntax::decode(bytes, label)
        .or_else(|_| filpost::syntax::decode(bytes, None))
        .map_or_else(|_| filpost::cl::reader::latin1(bytes), |(text, _)| text.into_owned())
}
