//! `filpost test --init`: a case from a CL file, a post and a proven program.

use std::fmt::Write as _;
use std::path::{Path, PathBuf};

use filpost::case::Case;
use filpost::map::Names;
use filpost::{Diag, Error, PendingFiles, files, select};

use crate::args::{Chosen, TestArgs};
use crate::errors::CommandCode;
use crate::{Status, output, setup};

/// Most that is copied of a folder that scripts read: a case is kept with the scripts.
const MOST_FILES: usize = 1000;
const MOST_BYTES: u64 = 64 << 20;

/// Makes a folder with the CL file, the program and a case.toml, and runs the case. It names the
/// post's own files where they are: the case then tests what becomes of them.
///
/// # Errors
/// E0804 for a folder that has a case already; files that can't be read or
/// written; a post that can't be built.
pub fn run(folder: &Path, args: &TestArgs) -> Result<Status, Error> {
    if folder.join("case.toml").exists() {
        let message = format!("{} has a case.toml", folder.display());
        return Err(Error::Run(Box::new(Diag::new(CommandCode::CaseExists, message))));
    }
    let mut making = Making { folder, copies: Vec::new() };
    let toml = making.describe(args)?;
    making.refuse_others(folder)?;
    std::fs::create_dir_all(folder).map_err(|error| files::cant_write(folder, &error))?;
    let mut pending = PendingFiles::default();
    for (name, from) in &making.copies {
        let to = folder.join(name);
        if lies_there(&to, from) {
            continue;
        }
        let parent = to.parent().unwrap_or(folder);
        std::fs::create_dir_all(parent).map_err(|error| files::cant_write(&to, &error))?;
        pending.add(output::new_file(&to, &files::read(from)?)?);
    }
    pending.add(output::new_file(&folder.join("case.toml"), toml.as_bytes())?);
    pending.commit()?;
    report(folder)
}

/// True when a file of the case lies where it belongs already.
fn lies_there(to: &Path, from: &Path) -> bool {
    to.canonicalize().is_ok_and(|to| from.canonicalize().is_ok_and(|from| from == to))
}

fn report(folder: &Path) -> Result<Status, Error> {
    let outcome = Case::load(folder)?.outcome();
    let mut text = format!("{} is made; ", folder.display());
    match &outcome.failure {
        None => text.push_str("its program is what this run gives\n"),
        Some(failure) => {
            let _ = write!(text, "it fails now:\n{}\n", failure.trim_end());
        }
    }
    output::print(text.as_bytes())?;
    Ok(if outcome.failure.is_none() { Status::Done } else { Status::Failed })
}

/// A case to be.
struct Making<'a> {
    folder: &'a Path,
    /// Names in the case, and where they come from.
    copies: Vec<(String, PathBuf)>,
}

impl Making<'_> {
    /// Collects the files; gives the text of the case.toml.
    fn describe(&mut self, args: &TestArgs) -> Result<String, Error> {
        let mut text = String::new();
        let cl = args.cl.as_deref().unwrap_or(Path::new(""));
        let nc = args.nc.as_deref().unwrap_or(Path::new(""));
        let _ = writeln!(text, "cl = {}", quoted(&self.copy(cl)?));
        if let Some(dialect) = args.dialect {
            let _ = writeln!(text, "dialect = {}", quoted(dialect.name()));
        }
        let mut fil = args.fil.clone();
        self.machine(&args.chosen, &mut fil, &mut text)?;
        let names: Vec<String> =
            fil.iter().map(|path| self.named(path)).collect::<Result<_, _>>()?;
        list(&mut text, "fil", &names);
        list(&mut text, "set", &args.chosen.set);
        if let Some(granted) = &args.grant {
            let _ = writeln!(text, "read = {}", quoted(&self.folder(granted)?));
        }
        if let Some(moment) = args.set_clock {
            let _ = writeln!(text, "clock = {}", quoted(&moment.to_string()));
        }
        if let Some(unit) = args.units {
            let _ = writeln!(text, "units = {}", quoted(&unit.to_string()));
        }
        let _ = writeln!(text, "expect = {}", quoted(&self.copy(nc)?));
        if let Some(step) = args.tol {
            let _ = writeln!(text, "tolerance = {step:?}");
        }
        list(&mut text, "ignore", &args.ignore);
        let origin = format!("{}, proven on the machine", nc.display());
        let _ = writeln!(text, "origin = {}", quoted(&origin));
        if !args.chosen.option.is_empty() {
            text.push_str("\n[options]\n");
        }
        for (name, value) in &args.chosen.option {
            let _ = writeln!(text, "{name} = {}", quoted(value));
        }
        Ok(text)
    }

    /// The machine: a ready post by its name, anything else by its file.
    fn machine(
        &self,
        chosen: &Chosen,
        fil: &mut Vec<PathBuf>,
        text: &mut String,
    ) -> Result<(), Error> {
        let (key, path) = match (&chosen.post, &chosen.machine) {
            (Some(post), _) if Path::new(post).is_dir() => {
                let script = Path::new(post).join("post.fil");
                if script.is_file() {
                    fil.insert(0, script);
                }
                ("machine", Path::new(post).join("machine.toml"))
            }
            (Some(ready), _) => {
                let _ = writeln!(text, "ready = {}", quoted(ready));
                return Ok(());
            }
            (None, Some(path)) if setup::is_option_file(path)? => {
                // `post` takes the FIL file beside it where no other is given.
                fil.extend(select::fil_beside(path).filter(|_| fil.is_empty()));
                ("option_file", path.clone())
            }
            (None, Some(path)) => ("machine", path.clone()),
            (None, None) => return Ok(()),
        };
        let _ = writeln!(text, "{key} = {}", quoted(&self.named(&path)?));
        Ok(())
    }

    /// The name of a file of the post, from the folder of the case.
    fn named(&self, path: &Path) -> Result<String, Error> {
        files::read(path)?;
        Ok(Names::from_folder(&absolute(self.folder), &absolute(path)))
    }

    /// Notes a file that has to be copied; gives its name in the case.
    fn copy(&mut self, path: &Path) -> Result<String, Error> {
        files::read(path)?;
        let name = path.file_name().unwrap_or_default().to_string_lossy().into_owned();
        self.note(name, path)
    }

    fn note(&mut self, name: String, path: &Path) -> Result<String, Error> {
        match self.copies.iter().find(|(taken, _)| *taken == name) {
            Some((_, from)) if from == path => Ok(name),
            Some((_, from)) => {
                let message =
                    format!("{} and {} would both be {name}", from.display(), path.display());
                Err(Error::Run(Box::new(Diag::new(CommandCode::SameName, message))))
            }
            None => {
                self.copies.push((name.clone(), path.to_path_buf()));
                Ok(name)
            }
        }
    }

    /// Notes the files of a folder that scripts read, and of the folders in it; gives its name
    /// in the case.
    fn folder(&mut self, folder: &Path) -> Result<String, Error> {
        let name =
            files::real_path(folder).file_name().map(|name| name.to_string_lossy().into_owned());
        let name = name.unwrap_or_else(|| "read".to_string());
        let mut waiting = vec![(name.clone(), folder.to_path_buf())];
        let mut bytes = 0;
        while let Some((name, folder)) = waiting.pop() {
            let cant = |error| files::cant_read(&folder, &error);
            for entry in std::fs::read_dir(&folder).map_err(cant)? {
                let entry = entry.map_err(cant)?;
                let (path, found) = (entry.path(), entry.metadata().map_err(cant)?);
                let name = format!("{name}/{}", entry.file_name().to_string_lossy());
                bytes += found.len();
                if found.is_dir() {
                    waiting.push((name, path));
                } else if !found.is_file() {
                    let message = format!("{} is neither a file nor a folder", path.display());
                    return Err(Error::Run(Box::new(Diag::new(CommandCode::NotCopied, message))));
                } else {
                    self.note(name, &path)?;
                }
                if bytes > MOST_BYTES || self.copies.len() > MOST_FILES {
                    let message = format!(
                        "{} holds more than {MOST_FILES} files or {} MB",
                        folder.display(),
                        MOST_BYTES >> 20
                    );
                    return Err(Error::Run(Box::new(Diag::new(CommandCode::NotCopied, message))));
                }
            }
        }
        Ok(name)
    }

    /// Refuses a folder in which a file of the case would take the place of another one.
    fn refuse_others(&self, folder: &Path) -> Result<(), Error> {
        for (name, from) in &self.copies {
            let to = folder.join(name);
            if to.exists() && !lies_there(&to, from) && files::read(&to)? != files::read(from)? {
                let message = format!("{} is there and is not {}", to.display(), from.display());
                return Err(Error::Run(Box::new(Diag::new(CommandCode::SameName, message))));
            }
        }
        Ok(())
    }
}

/// The real path as far as there is one.
fn absolute(path: &Path) -> PathBuf {
    let path = std::path::absolute(path).unwrap_or_else(|_| path.to_path_buf());
    let there = path.ancestors().find_map(|above| Some((above, above.canonicalize().ok()?)));
    match there {
        Some((above, real)) => path.strip_prefix(above).map_or(real.clone(), |rest| {
            rest.components().fold(real, |path, part| path.join(part))
        }),
        None => path,
    }
}

fn quoted(text: &str) -> String {
    toml::Value::from(text).to_string()
}

fn list(text: &mut String, key: &str, entries: &[String]) {
    if !entries.is_empty() {
        let entries: Vec<String> = entries.iter().map(|entry| quoted(entry)).collect();
        let _ = writeln!(text, "{key} = [{}]", entries.join(", "));
    }
}
